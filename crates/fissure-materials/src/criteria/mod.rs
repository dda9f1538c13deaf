//! Failure criteria as values: where and how strongly a stress asks for a crack.
//!
//! A criterion is a failure function `F_n(σ)` of the stress and a direction, dimensionless,
//! positive beyond the surface; a crack starts where its maximum over all directions reaches zero,
//! with the maximising normal [Sanchez 2010, eq. 3.5.39]. [`FailureCriterion::upper_bound`] comes
//! from invariants alone and rejects most states before any spectrum.
//!
//! Where several directions attain the maximum, the choice depends on the components of the stress
//! only, never on chance: the spectrum's fixed order where principal stresses coincide, and of
//! conjugate shear planes the one nearer to the x axis, then to y. No choice is frame-indifferent
//! there; the value is.
//!
//! ```
//! use fissure_materials::{Sym, criteria::{FailureCriterion, MohrCoulomb}};
//! let sandstone = MohrCoulomb { strength: 2e6, shear_strength: 3e6 };
//! let pressed = Sym::diagonal(-1e6, -2e6, -50e6);
//! let onset = sandstone.onset(&pressed).ok_or("below the surface")?;
//! assert!(onset.normal.y.abs() < 1e-12);
//! # Ok::<(), &str>(())
//! ```

mod directions;
mod geological;
mod mohr;
mod principal;
#[cfg(test)]
mod tests;

use std::fmt::Debug;

use fissure_tensor::{Sym, Vector3};

use crate::{Initiation, MaterialError, Scale};

use directions::maximise_on_octant;
pub(crate) use directions::{Domain, maximise};
pub use geological::{Geological, OnPlane, Partials};
pub use principal::{MohrCoulomb, Rankine, TensionShear, Tresca};

/// When and across which plane a material starts to fail.
pub trait FailureCriterion: Copy + Debug + Send + Sync + 'static {
    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`].
    fn check(&self) -> Result<(), MaterialError>;

    /// The same criterion with its strengths scaled.
    #[must_use]
    fn scaled(&self, scale: &Scale) -> Self;

    /// The failure function in one direction (unit vector); stress in Pa.
    fn along(&self, stress: &Sym, normal: &Vector3<f64>) -> f64;

    /// At least the failure function in every direction, from invariants of the stress.
    fn upper_bound(&self, stress: &Sym) -> f64;

    /// The largest failure function and its direction.
    fn initiation(&self, stress: &Sym) -> Initiation;

    /// Value and normal if the surface is passed.
    #[inline]
    fn onset(&self, stress: &Sym) -> Option<Initiation> {
        if self.upper_bound(stress) <= 0.0 {
            return None;
        }
        let initiation = self.initiation(stress);
        (initiation.value > 0.0).then_some(initiation)
    }
}

/// Of directions that attain the same value, up to sign, the one nearest to the x axis, then to y;
/// the first where both tie.
fn canonical(candidates: impl IntoIterator<Item = Vector3<f64>>) -> Vector3<f64> {
    const TIE: f64 = 1e-9;
    let mut best: Option<Vector3<f64>> = None;
    for next in candidates {
        let nearer = best.is_none_or(|old| {
            let (x, y) = (next.x.abs() - old.x.abs(), next.y.abs() - old.y.abs());
            x > TIE || (x.abs() <= TIE && y > TIE)
        });
        if nearer {
            best = Some(next);
        }
    }
    best.unwrap_or_else(Vector3::x).normalize()
}
