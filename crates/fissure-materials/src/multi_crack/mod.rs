//! Elastic-decohesive law with several failure planes at a point [Sanchez 2010, sec. 3.5.3, 4.5].
//!
//! `ε = εᵉ + Σ_j sym(u_j ⊗ n_j)/L_j` (4.5.15), `T = C:εᵉ`, with the Biot strain, so that the law is
//! objective. What starts, opens and closes a plane is its [`Decohesion`]: [`ModeOne`] or
//! [`GeologicalFlow`] (one plane only). All planes are returned together, until every `F_j` is within round-off of
//! zero or below; the document's single pass over the planes leaves earlier ones violated by later.
//!
//! # When the coupled return is unique, and the threshold angle
//! In opening, active planes `N_j = n_j ⊗ n_j` with softening moduli `h_j = τ L_j/u₀` (any curve:
//! `h = τ² L steepest/G`) solve a system with the matrix `A_jk = N_j:C:N_k − h_j δ_jk`,
//! `N_j:C:N_k = λ + 2μ cos²θ_jk`. One plane: `λ + 2μ > h`, the band limit (4.5.17). Two planes:
//! `A` is positive definite only if `(λ + 2μ − h)² > (λ + 2μ cos²θ)²`, that is
//! ```text
//! 2μ sin²θ > h                                                      (threshold)
//! ```
//! The `N_j` span three dimensions in the plane and six in space, so more than three or six active
//! softening planes always are dependent, `A` is indefinite and the return is not unique. The law
//! therefore
//! - starts a new plane only if its normal is at least the threshold angle from all others, and
//!   refuses a threshold angle below the bound;
//! - selects the order of returns by a rule that does not see the storage order (`relax`), which in
//!   opening descends to a local minimum of the incremental potential, unique where `A` is positive
//!   definite.
//!
//! In a direction nearer than the threshold angle to a plane the stress may exceed the strength; no
//! plane starts there, nor anywhere once `N` planes are stored.
//!
//! # Variants
//! [`Planes::Fixed`] keeps the first plane alone. [`Planes::Multiple`] adds planes. [`Planes::Rotating`]
//! is one plane whose normal is the first principal direction of the strain in every step: its
//! traction has no shear by construction; where two principal strains cross, it changes direction
//! at once and the response is steep.

mod cracking;
mod decohesion;
mod dense;
mod geological_flow;
mod mode_one;
mod relax;
mod start;
mod state;
mod tangent;
#[cfg(test)]
mod tests;

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};

pub use decohesion::{Decohesion, Trial};
pub use geological_flow::GeologicalFlow;
pub use mode_one::{ModeOne, Shear, Unloading};
pub use state::{MultiCrackState, Plane};

use crate::{
    Biot, Increment, Initiation, Isotropic, Material, MaterialError, Response, Scale,
    check_parameter,
    error::{check_below, check_scaled_toughness},
    material::{DIFFERENCE_STEP, difference_tangent},
    sound::sound,
};
use relax::{elastic_strain, relax};
use tangent::coupled;

const NAME: &str = "elastic-decohesive law with several planes";

/// Least angle between planes where the bound is smaller: 15°.
const LEAST_THRESHOLD: f64 = std::f64::consts::PI / 12.0;

/// How many planes there are and whether they turn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Planes {
    /// One, with the normal with which it starts.
    #[default]
    Fixed,
    /// Up to `N`, at least this angle apart, radians, in (0, π/2]. `None`: the larger of 15° and
    /// the bound of uniqueness with a reserve of a quarter, `sin²θ = 1.25 h/(2μ)`.
    Multiple(Option<f64>),
    /// One that follows the first principal direction of the strain.
    Rotating,
}

/// The law: elasticity, what planes do, and how many there are (at most `N`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultiCrack<const N: usize, D> {
    /// Elastic constants and density.
    pub elastic: Isotropic,
    /// What starts, opens and closes a plane.
    pub decohesion: D,
    /// How many planes there are and whether they turn.
    pub planes: Planes,
}

/// What a step came to.
struct Step<const N: usize> {
    kinematics: Biot,
    strain: Sym,
    biot_stress: Sym,
    /// Where the planes started from, those that started in the step included.
    start: MultiCrackState<N>,
    state: MultiCrackState<N>,
}

impl<const N: usize, D: Decohesion> MultiCrack<N, D> {
    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            elastic: self.elastic.scaled(scale),
            decohesion: self.decohesion.scaled(scale),
            planes: self.planes,
        }
    }

    /// Largest band with a unique response of one plane, m (4.5.17).
    fn limit(&self) -> f64 {
        self.elastic.p_wave_modulus() / self.decohesion.steepest()
    }

    fn check_width(&self, width: f64) -> Result<(), MaterialError> {
        check_scaled_toughness(NAME, self.decohesion.toughness())?;
        check_below(NAME, width, self.limit())
    }

    /// `sin²` of the least angle between planes over a band of this width for which the return of
    /// two is unique, `h/(2μ)`; over 1 if no angle will do.
    pub fn unique_above(&self, width: f64) -> f64 {
        self.decohesion.steepest() * width / (2.0 * self.elastic.shear_modulus())
    }

    /// `sin²` of the threshold angle for a band of this width.
    fn threshold(&self, width: f64) -> f64 {
        match self.planes {
            Planes::Multiple(Some(angle)) => angle.sin().powi(2),
            _ => (1.25 * self.unique_above(width)).max(LEAST_THRESHOLD.sin().powi(2)),
        }
    }

    /// Most planes allowed.
    fn most(&self) -> usize {
        match self.planes {
            Planes::Fixed | Planes::Rotating => N.min(1),
            Planes::Multiple(_) => N,
        }
    }

    /// The plane that a stress asks for, if it may start.
    fn starting(
        &self,
        stress: &Sym,
        state: &MultiCrackState<N>,
        kinematics: &Biot,
        band: &Band,
    ) -> Result<Option<Plane>, MaterialError> {
        if state.planes().len() >= self.most() || self.decohesion.upper_bound(stress) <= 0.0 {
            return Ok(None);
        }
        let width_of = |normal: &Vector3<f64>| band.width(&(kinematics.rotation * normal));
        // Of two planes the wider band is the less stable.
        let threshold = |normal: &Vector3<f64>, plane: &Plane| {
            self.threshold(width_of(normal).max(plane.width))
        };
        let found = start::initiation(&self.decohesion, stress, state.planes(), threshold);
        let Some(Initiation { value, mut normal }) = found else {
            return Ok(None);
        };
        if value <= 0.0 {
            return Ok(None);
        }
        if self.planes == Planes::Rotating {
            // As in every later step, to the last bit.
            normal = kinematics.strain().spectrum().vectors[0];
        }
        let width = width_of(&normal);
        // The door saw neither this rotation nor, for a band with an edge of zero, this normal.
        self.check_width(width)?;
        let traction = self.decohesion.onset_traction(stress, &normal);
        Ok(Some(Plane::new(&normal, width, traction)))
    }

    /// The law of one particle (see [`Self::scaled`]) over a step.
    fn step(
        &self,
        f: &Matrix3<f64>,
        band: &Band,
        old: &MultiCrackState<N>,
    ) -> Result<Step<N>, MaterialError> {
        let kinematics = Biot::new(f)?;
        let strain = kinematics.strain();
        let mut start = *old;
        if self.planes == Planes::Rotating {
            turn(start.planes_mut(), &strain);
        }
        let mut state = start;
        let (elastic, decohesion) = (&self.elastic, &self.decohesion);
        loop {
            let planes = state.planes_mut();
            let stress = relax(decohesion, elastic, &strain, start.planes(), planes)?;
            let Some(plane) = self.starting(&stress, &state, &kinematics, band)? else {
                return Ok(Step {
                    kinematics,
                    strain,
                    biot_stress: stress,
                    start,
                    state,
                });
            };
            start.push(plane);
            state.push(plane);
        }
    }

    fn response(
        &self,
        step: &Step<N>,
        old: &MultiCrackState<N>,
    ) -> Result<Response<MultiCrackState<N>>, MaterialError> {
        let planes = step.state.planes();
        let elastic_strain = elastic_strain(&step.strain, planes);
        let mut stored = 0.5 * step.biot_stress.dot(&elastic_strain);
        let mut dissipated = 0.0;
        for (index, plane) in planes.iter().enumerate() {
            // A plane of before as it was, turned or not; one that started as it started.
            let before = match old.planes().get(index) {
                Some(before) => *before,
                None => step.start.planes()[index],
            };
            stored += self.decohesion.stored(&self.elastic, plane) / plane.width;
            let trial = self.trial(&step.biot_stress, plane);
            let lost = self.decohesion.dissipated(&before, plane, &trial);
            dissipated += lost / plane.width;
        }
        let stress = step.kinematics.cauchy(&step.biot_stress);
        // In units in which a square overflows the energies do before the stress.
        if !(stress.is_finite() && stored.is_finite() && dissipated.is_finite()) {
            return Err(MaterialError::NotFinite { law: NAME });
        }
        Ok(Response {
            stress,
            state: step.state,
            stored,
            dissipated,
        })
    }
}

impl<const N: usize, D: Decohesion> MultiCrack<N, D> {
    /// What a plane sees at the end of a step.
    fn trial(&self, stress: &Sym, plane: &Plane) -> Trial {
        Trial {
            elastic: self.elastic,
            stress: *stress + self.elastic.stress(&plane.strain()),
            slack: 0.0,
        }
    }

    /// `∂T/∂E`, if it is at hand.
    fn modulus(&self, step: &Step<N>, old: &MultiCrackState<N>) -> Option<Tangent> {
        let planes = step.state.planes();
        if !self.has_own_tangent(old, &step.state) {
            return None;
        }
        let mut rates = [[Sym::ZERO; 3]; N];
        for ((rate, start), plane) in rates.iter_mut().zip(step.start.planes()).zip(planes) {
            let trial = self.trial(&step.biot_stress, plane);
            *rate = self.decohesion.release_rate(start, plane, &trial)?;
        }
        coupled(&self.elastic, planes, &rates)
    }
}

/// Turns planes to the first principal direction of a strain; the opening goes along.
fn turn(planes: &mut [Plane], strain: &Sym) {
    for plane in planes {
        let normal = strain.spectrum().vectors[0];
        if plane.normal() == normal {
            continue; // a zero increment moves no bit
        }
        let traction = plane.normal().dot(&Vector3::from(plane.traction));
        plane.normal = normal.into();
        plane.traction = (normal * traction).into();
    }
}

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
        if matches!(self.planes, Planes::Multiple(_)) {
            let valid = N < 2 || self.decohesion.several();
            let rule = "1 for this decohesion";
            check_parameter(NAME, "number of planes", N as f64, valid, rule)?;
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

    fn continuous(&self) -> bool {
        self.decohesion.continuous()
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
        let law = self.scaled(&increment.external.scale);
        if old.planes().is_empty() {
            // A margin for round-off: the exact test decides at the surface.
            let accepts = |stress: &Sym| law.decohesion.upper_bound(stress) < -1e-9;
            if let Some(response) = sound(&law.elastic, &increment.f_new, accepts)? {
                return Ok(response);
            }
        }
        let step = law.step(&increment.f_new, &increment.band, old)?;
        law.response(&step, old)
    }

    /// Analytic while no plane starts and none turns, for planes whose return has a derivative;
    /// else the trait's difference quotient.
    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        let law = self.scaled(&increment.external.scale);
        let step = law.step(&increment.f_new, &increment.band, old)?;
        match law.modulus(&step, old) {
            Some(modulus) => Ok(step.kinematics.spatial_tangent(&step.biot_stress, &modulus)),
            None => difference_tangent(self, increment, old, DIFFERENCE_STEP),
        }
    }

    fn has_own_tangent(&self, old: &Self::State, new: &Self::State) -> bool {
        let kept = new.planes().len() == old.planes().len() && self.planes != Planes::Rotating;
        new.planes().is_empty() || kept
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
