//! The law with several planes as a [`Material`].

use fissure_tensor::{Band, Matrix3, Tangent};

use super::{Decohesion, MultiCrack, MultiCrackState, NAME, Planes};
use crate::material::{DIFFERENCE_STEP, difference_tangent};
use crate::sheet::{Thickening, flat, thinned};
use crate::{
    Biot, Increment, Material, MaterialError, Response, Scale, SheetStep, check_parameter,
};

const TURNS_WITH_SHEAR: MaterialError = MaterialError::Unsupported {
    law: NAME,
    reason: "a plane that shear or the stress along it opens cannot rotate: what it gives on turning would be lost",
};

const LEANS_OUT: MaterialError = MaterialError::Unsupported {
    law: NAME,
    reason: "a rotating plane in plane stress needs poisson >= 0: it would turn into the sheet",
};

const FLOWS_ALONG: MaterialError = MaterialError::Unsupported {
    law: NAME,
    reason: "several planes that shear or the stress along them opens do not keep their energy in plane stress",
};

impl<const N: usize, D: Decohesion> Material for MultiCrack<N, D> {
    type State = MultiCrackState<N>;
    const SPARSE: bool = true;
    const STRESS_FROM_GRADIENT: bool = true;
    /// Energies are those of opening, J/m³, at a toughness scale of 1.
    const NAMES: &'static [&'static str] = &[
        "planes",
        "failed_planes",
        "opening",
        "failed_energy",
        "unfailed_energy",
    ];

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for(NAME)?;
        self.decohesion.check()?;
        if self.planes == Planes::Rotating && !self.decohesion.opens_alone() {
            return Err(TURNS_WITH_SHEAR);
        }
        if let Planes::Multiple(Some(angle)) = self.planes {
            let valid = angle > 0.0 && angle <= std::f64::consts::FRAC_PI_2;
            check_parameter(NAME, "threshold angle", angle, valid, "in (0, π/2]")?;
        }
        Ok(())
    }

    /// The band limit of one plane, and with a threshold angle given that of two planes that far
    /// apart, `2μ sin²θ > h`.
    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        let law = self.scaled(scale);
        let width = band.max_width();
        law.check_width(width)?;
        if let Planes::Multiple(Some(angle)) = self.planes {
            let limit = width * angle.sin().powi(2) / law.unique_above(width);
            if !(width < limit) {
                return Err(MaterialError::Band {
                    law: NAME,
                    width,
                    limit,
                });
            }
        }
        Ok(())
    }

    fn started_width(&self, old: &Self::State, new: &Self::State) -> f64 {
        let started = new.planes().iter().skip(old.planes().len());
        started.map(|plane| plane.width).fold(0.0, f64::max)
    }

    fn isotropic(&self) -> bool {
        self.decohesion.isotropic()
    }

    /// Several planes without a potential may end on another branch a hair's breadth away (`relax.rs`), and a rotating plane
    /// turns over at once where principal strains cross.
    fn continuous(&self) -> bool {
        let branches = match self.planes {
            Planes::Fixed => false,
            Planes::Multiple(_) => !self.decohesion.associated(),
            Planes::Rotating => true,
        };
        self.decohesion.continuous() && !branches
    }

    fn density(&self) -> f64 {
        self.elastic.density
    }

    /// That of the sound material times the longest stretch.
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &Self::State, scale: &Scale) -> f64 {
        self.elastic.scaled(scale).p_wave_speed() * Biot::longest_stretch(f)
    }

    fn has_history(&self, state: &Self::State) -> bool {
        !state.planes().is_empty()
    }

    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        self.scaled(&increment.external.scale)
            .respond::<false>(increment, old)
    }

    /// Where planes stand across the sheet. One that turns carries no shear, so that its own choice does not count.
    ///
    /// # Errors
    /// [`MaterialError::Unsupported`] for a rotating plane and ν < 0: in a search for the thickness it would turn into the sheet.
    /// And for several planes that do not open by the traction across them alone: the search may end on another branch, and
    /// the work is not what is stored and dissipated (P6).
    fn plane_stress(
        &self,
        increment: &Increment,
        old: &Self::State,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<Self::State>>, MaterialError> {
        if self.most() > 1 && !self.decohesion.opens_alone() {
            return Err(FLOWS_ALONG);
        }
        let rotating = self.planes == Planes::Rotating;
        let across = rotating || self.decohesion.has_sheet_form();
        if !(across && self.elastic.poisson >= 0.0) {
            return if rotating { Err(LEANS_OUT) } else { Ok(None) };
        }
        let sheet = Self {
            elastic: self.elastic.sheet(),
            ..*self
        };
        let law = sheet.scaled(&increment.external.scale);
        let flat = flat(increment);
        let response = law.respond::<true>(&flat, old)?;
        let mut tangent = None;
        if with_tangent {
            let step = law.step::<true>(&flat.f_new, &flat.band, old)?;
            tangent = law.tangent_of::<true>(&step, &flat.band, old);
        }
        let measure = Thickening::Stretch;
        thinned(&flat, response, tangent, &self.elastic, measure).map(Some)
    }

    /// Analytic but for the turning of planes that start or follow the strain (see `tangent.rs`); the trait's difference
    /// quotient where the sweeps over planes do not converge, where planes were returned in turn (see `relax.rs`), and where
    /// whichever way the strain goes on another plane starts.
    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        let law = self.scaled(&increment.external.scale);
        let step = law.step::<false>(&increment.f_new, &increment.band, old)?;
        match law.tangent_of::<false>(&step, &increment.band, old) {
            Some(tangent) => Ok(tangent),
            None => difference_tangent(self, increment, old, DIFFERENCE_STEP),
        }
    }

    fn values(&self, state: &Self::State, out: &mut [f64]) {
        let planes = state.planes();
        out[0] = planes.len() as f64;
        out[1] = planes.iter().filter(|plane| plane.failed).count() as f64;
        out[2] = planes.iter().map(|plane| plane.opening).fold(0.0, f64::max);
        let energy = |failed: bool| -> f64 {
            let these = planes.iter().filter(|plane| plane.failed == failed);
            let spent = these
                .map(|plane| self.decohesion.dissipated_fraction(plane.softened) / plane.width);
            spent.sum::<f64>() * self.decohesion.toughness()
        };
        (out[3], out[4]) = (energy(true), energy(false));
    }
}
