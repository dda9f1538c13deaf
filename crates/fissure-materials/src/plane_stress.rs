//! Plane stress: any law with the out-of-plane stretch that leaves `σ₃₃ = 0`.
//!
//! `F₃₃` is found anew in every step (`plane_stress/balance.rs`). The tangent is condensed,
//! `c_αβγδ − c_αβ33 c_33γδ / c_3333` (de Borst 1991): with `σ₃₃ = 0` the Truesdell rate adds no
//! further term.

mod balance;
#[cfg(test)]
mod tests;

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};
use serde::{Deserialize, Serialize};

use self::balance::Solved;
pub(crate) use self::balance::with_thickness;
use crate::material::{DIFFERENCE_STEP, difference_tangent};
use crate::wrapping::{hand_on_cracking, hand_on_material};
use crate::{
    Crack, Cracking, Increment, Initiation, Material, MaterialError, Response, Scale,
    check_parameter,
};

const NAME: &str = "plane stress";
/// Mandel positions of the components that plane stress determines: zz, yz, xz.
const OUT_OF_PLANE: [usize; 3] = [2, 3, 4];

/// The law inside, in plane stress.
///
/// Only the in-plane components of a deformation gradient are read: its `F₃₃` is replaced by the
/// one that leaves no stress, and `F₁₃`, `F₂₃`, `F₃₁`, `F₃₂` by zero. Stress and tangent have no
/// out-of-plane components; the Jacobian that belongs to them holds
/// [`out_of_plane_stretch`](Material::out_of_plane_stretch).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneStress<M>(pub M);

/// History of a law in plane stress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlaneStressState<S> {
    /// History of the law inside.
    pub inner: S,
    /// Out-of-plane strain `F₃₃ − 1`.
    pub thickening: f64,
}

/// What a law that has plane stress in closed form makes of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetStep<S> {
    /// The answer; out-of-plane stresses do not count.
    pub response: Response<S>,
    /// Out-of-plane strain `F₃₃ − 1`; > −1.
    pub thickening: f64,
    /// Spatial tangent (see [`Material::tangent`]) of the in-plane components, for a `J` that goes
    /// with the thickness. `None` if it was not asked for, or is to be taken by differences.
    pub tangent: Option<Tangent>,
}

impl<M: Material> PlaneStress<M> {
    fn response(
        inner: &Response<M::State>,
        thickening: f64,
    ) -> Response<PlaneStressState<M::State>> {
        let mut stress = inner.stress;
        // What is left of σ₃₃ is round-off; the out-of-plane shears are those of the plane problem.
        for i in OUT_OF_PLANE {
            stress.mandel[i] = 0.0;
        }
        Response {
            stress,
            state: PlaneStressState {
                inner: inner.state,
                // What `F₃₃` can hold, so that a state follows from it (`without_history`); the law
                // inside has seen no more.
                thickening: (1.0 + thickening) - 1.0,
            },
            stored: inner.stored,
            dissipated: inner.dissipated,
        }
    }

    /// The band against the limit of the law inside, lowered to that of plane stress.
    fn check_relieved(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        let relief = self.relief(scale);
        self.0
            .check_band(&band.scaled(1.0 / relief), scale)
            .map_err(|error| match error {
                MaterialError::Band { law, width, limit } => MaterialError::Band {
                    law,
                    width: width * relief,
                    limit: limit * relief,
                },
                other => other,
            })
    }

    /// The step, with the bands of the cracks it started held to the limit of plane stress: the
    /// law inside has only asked for its own, wider one.
    fn checked(
        &self,
        increment: &Increment,
        old: &PlaneStressState<M::State>,
    ) -> Result<Solved<M::State>, MaterialError> {
        let solved = self.solve(increment, old)?;
        let width = self.0.started_width(&old.inner, &solved.response.state);
        if width != 0.0 {
            self.check_relieved(&Band::Uniform(width), &increment.external.scale)?;
        }
        Ok(solved)
    }

    /// Smallest ratio of the in-plane modulus at `σ₃₃ = 0` to that at `ε₃₃ = 0`, at rest; in (0, 1].
    ///
    /// The thickness gives way, so a material point snaps back at a narrower band than in plane
    /// strain, by this factor: `(1 − 2ν)/(1 − ν)²` if the law is isotropic.
    fn relief(&self, scale: &Scale) -> f64 {
        let mut rest = Increment::to(Matrix3::identity());
        rest.external.scale = *scale;
        let Ok(Tangent(c)) = self.0.tangent(&rest, &self.0.initial()) else {
            return 1.0;
        };
        let ratio = |i| 1.0 - c[(i, 2)] * c[(2, i)] / (c[(2, 2)] * c[(i, i)]);
        let smallest = f64::min(ratio(0), ratio(1));
        if smallest > 0.0 && smallest < 1.0 {
            smallest
        } else {
            1.0
        }
    }
}

/// The in-plane response at `σ₃₃ = 0`; rows and columns out of the plane are zero.
pub(crate) fn condensed(tangent: &Tangent) -> Result<Tangent, MaterialError> {
    let c = tangent.0;
    flattened(Tangent(c - c.column(2) * c.row(2) / c[(2, 2)]))
}

/// Without the rows and columns out of the plane.
fn flattened(Tangent(mut plane): Tangent) -> Result<Tangent, MaterialError> {
    for i in OUT_OF_PLANE {
        plane.row_mut(i).fill(0.0);
        plane.column_mut(i).fill(0.0);
    }
    let plane = Tangent(plane);
    plane
        .is_finite()
        .then_some(plane)
        .ok_or(MaterialError::NotFinite { law: NAME })
}

impl<M: Material> Material for PlaneStress<M> {
    type State = PlaneStressState<M::State>;
    hand_on_material!(0);

    const STEP_ERROR: f64 = M::STEP_ERROR_IN_PLANE_STRESS;
    const PLANE: bool = true;

    fn check(&self) -> Result<(), MaterialError> {
        self.0.check()?;
        // The wave speed at rest sets the tolerance of the stretch.
        let modulus = self.modulus(&Scale::default());
        check_parameter(
            NAME,
            "modulus at rest",
            modulus,
            modulus > 0.0,
            "finite and > 0",
        )?;
        // A law that has no plane stress says so at rest.
        let rest = Increment::to(Matrix3::identity());
        self.0.plane_stress(&rest, &self.0.initial(), false)?;
        Ok(())
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.check_relieved(band, scale)
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    /// That of the law inside at the stretch of the state: an upper bound, since the freedom of
    /// the thickness only softens in-plane waves.
    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64 {
        let f = with_thickness(f, state.thickening);
        self.0.wave_speed(&f, &state.inner, scale)
    }

    fn initial(&self) -> Self::State {
        PlaneStressState {
            inner: self.0.initial(),
            thickening: 0.0,
        }
    }

    fn has_history(&self, state: &Self::State) -> bool {
        self.0.has_history(&state.inner)
    }

    /// The thickness is that of the deformation gradient, to the last bit.
    fn without_history(&self, f: &Matrix3<f64>) -> Self::State {
        PlaneStressState {
            inner: self.0.without_history(f),
            thickening: f.m33 - 1.0,
        }
    }

    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        if let Some(step) = self.0.plane_stress(increment, &old.inner, false)? {
            return Ok(Self::response(&step.response, step.thickening));
        }
        let solved = self.checked(increment, old)?;
        Ok(Self::response(&solved.response, solved.thickening))
    }

    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<(Response<Self::State>, Tangent), MaterialError> {
        if let Some(step) = self.0.plane_stress(increment, &old.inner, true)? {
            let tangent = match step.tangent {
                Some(tangent) => flattened(tangent)?,
                None => difference_tangent(self, increment, old, DIFFERENCE_STEP)?,
            };
            return Ok((Self::response(&step.response, step.thickening), tangent));
        }
        let solved = self.checked(increment, old)?;
        let inner = &solved.response.state;
        let tangent = if self.0.has_own_tangent(&old.inner, inner) {
            condensed(&self.0.tangent(&solved.increment, &old.inner)?)?
        } else {
            difference_tangent(self, increment, old, DIFFERENCE_STEP)?
        };
        let response = Self::response(&solved.response, solved.thickening);
        Ok((response, tangent))
    }

    fn out_of_plane_stretch(&self, state: &Self::State) -> Option<f64> {
        Some(1.0 + state.thickening)
    }
}

impl<M: Cracking> Cracking for PlaneStress<M> {
    hand_on_cracking!(0);

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.0.critical_opening(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.0.band_limit(scale) * self.relief(scale)
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.0.failure_in_plane(stress, normal, scale)
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.0.initiation_in_plane(stress, scale)
    }

    fn cracks(&self, state: &Self::State) -> Vec<Crack> {
        self.0.cracks(&state.inner)
    }
}
