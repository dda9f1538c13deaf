//! The tangent of planes that were returned together.
//!
//! The return of plane `j` gives `du_j = R_j:dT_j` with `dT_j = dT + C:dε_j` the change of the
//! stress without its own jump. With `dT = C:(dε − Σ dε_k)` that is a linear system for the `du_k`,
//! solved for each of the six strains plane by plane, in the way in which the planes themselves
//! were returned: where that converged, this does.

use fissure_tensor::{Matrix6, Sym, Tangent, Vector3, Vector6};

use super::Plane;
use crate::Isotropic;

/// Sweeps over the planes allowed.
const MAXIMAL_SWEEPS: usize = 2000;

/// `∂T/∂E`; `None` if the sweeps do not converge.
pub(super) fn coupled<const N: usize>(
    elastic: &Isotropic,
    planes: &[Plane],
    rates: &[[Sym; 3]; N],
) -> Option<Tangent> {
    let mut columns = [Sym::ZERO; 6];
    for (index, column) in columns.iter_mut().enumerate() {
        let mut strain = Sym::ZERO;
        strain.mandel[index] = 1.0;
        *column = stress_rate(elastic, planes, rates, &strain)?;
    }
    let mut matrix = Matrix6::zeros();
    for (index, column) in columns.iter().enumerate() {
        matrix.set_column(index, &Vector6::from(column.mandel));
    }
    Some(Tangent(matrix))
}

/// `dT` for a change of strain.
fn stress_rate<const N: usize>(
    elastic: &Isotropic,
    planes: &[Plane],
    rates: &[[Sym; 3]; N],
    strain: &Sym,
) -> Option<Sym> {
    let mut parts = [Sym::ZERO; N];
    let mut stress = elastic.stress(strain);
    let tolerance = 4.0 * f64::EPSILON * stress.norm();
    for _ in 0..MAXIMAL_SWEEPS {
        let mut moved: f64 = 0.0;
        for ((part, plane), rate) in parts.iter_mut().zip(planes).zip(rates) {
            let alone = stress + elastic.stress(part);
            let jump = Vector3::from(rate.map(|row| row.dot(&alone)));
            let next = Sym::dyad_of(&jump, &plane.normal()) * (1.0 / plane.width);
            let change = elastic.stress(&(next - *part));
            moved = moved.max(change.norm());
            stress -= change;
            *part = next;
        }
        if planes.len() < 2 || moved <= tolerance {
            return Some(stress);
        }
    }
    None
}
