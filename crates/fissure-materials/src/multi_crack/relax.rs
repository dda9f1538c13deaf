//! The planes of a point returned together, until every `F_j ≤ tol`.
//!
//! Each plane has a return of its own with the others frozen, and no plane's return depends on
//! where it is stored. The rule of selection: the plane whose return would change its traction
//! most goes first (of equals the one whose normal, signed so that its largest component is
//! positive, is first in the order of components), then the plane that now would change most, and
//! so on until none would by more than round-off. A plane may give back within a step what it took
//! in that step. For opening alone every return lowers the incremental potential
//! `½ (ε − Σ ε_j):C:(ε − Σ ε_j) + Σ (G/L_j) area(s_j)`, so the sequence ends in a local minimum of
//! it, and where the minimum is unique (see the theory of the law) in that one.

use fissure_tensor::Sym;

use super::{Decohesion, NAME, Plane, Trial};
use crate::{Isotropic, MaterialError};

/// Returns of single planes allowed in a step.
const MAXIMAL_RETURNS: usize = 5000;

/// The stress that the jumps leave of a strain, Pa.
pub(super) fn stress_of(elastic: &Isotropic, strain: &Sym, planes: &[Plane]) -> Sym {
    elastic.stress(&elastic_strain(strain, planes))
}

/// The strain without what the jumps stand for.
pub(super) fn elastic_strain(strain: &Sym, planes: &[Plane]) -> Sym {
    planes
        .iter()
        .fold(*strain, |left, plane| left - plane.strain())
}

/// Changes `planes`, which start from `old`, to the end of the step; returns the stress.
///
/// # Errors
/// [`MaterialError::NoConvergence`].
pub(super) fn relax<D: Decohesion>(
    decohesion: &D,
    elastic: &Isotropic,
    strain: &Sym,
    old: &[Plane],
    planes: &mut [Plane],
) -> Result<Sym, MaterialError> {
    let mut stress = stress_of(elastic, strain, planes);
    let (mut residual, mut size) = (f64::INFINITY, 1.0);
    for _ in 0..MAXIMAL_RETURNS {
        // Round-off of the stress: of all the strains whose difference it is. Of the planes as they
        // are now, so that a step that ends here is not taken up again by a zero increment.
        let parts: f64 = planes.iter().map(|plane| plane.strain().norm()).sum();
        size = elastic.p_wave_modulus() * (strain.norm() + parts) + decohesion.strength();
        let tolerance = 16.0 * f64::EPSILON * size;
        let mut chosen: Option<(usize, Plane)> = None;
        residual = 0.0;
        for (index, (plane, start)) in planes.iter().zip(old).enumerate() {
            let trial = Trial {
                elastic: *elastic,
                stress: stress + elastic.stress(&plane.strain()),
                slack: 4.0 * tolerance,
            };
            let next = decohesion.release(start, &trial);
            let moved = next.jump() - plane.jump();
            let change = moved.norm() * trial.normal_stiffness(plane);
            let first = |other: &Plane| order(&plane.normal) > order(&other.normal);
            let leads = match &chosen {
                None => true,
                Some((_, best)) => change > residual || (change == residual && first(best)),
            };
            if leads {
                residual = change;
                chosen = Some((index, next));
            }
        }
        // NaN ends here too, as an error.
        if residual <= tolerance || planes.is_empty() {
            for plane in planes.iter_mut() {
                plane.traction = stress.traction(&plane.normal()).into();
            }
            return Ok(stress);
        }
        if let Some((index, next)) = chosen {
            planes[index] = next;
        }
        stress = stress_of(elastic, strain, planes);
        if !stress.is_finite() {
            return Err(MaterialError::NotFinite { law: NAME });
        }
    }
    Err(MaterialError::NoConvergence {
        law: NAME,
        iterations: MAXIMAL_RETURNS,
        residual: residual / size,
    })
}

/// Components of the normal, signed so that the largest is positive: comparable whatever the
/// storage order and sign.
fn order(normal: &[f64; 3]) -> [f64; 3] {
    let largest = normal
        .iter()
        .fold(0.0_f64, |m, c| if c.abs() > m.abs() { *c } else { m });
    normal.map(|c| c * largest.signum())
}
