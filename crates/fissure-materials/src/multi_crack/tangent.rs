//! The tangent of planes that were returned together.
//!
//! The return of plane `j` gives `du_j = R_j:dT_j` with `dT_j = dT + C:dε_j` the change of the
//! stress without its own jump. With `dT = C:(dε − Σ dε_k)` that is a linear system for the `du_k`,
//! solved for each of the six strains plane by plane, in the way in which the planes themselves
//! were returned, and where that is slow by elimination.
//!
//! A plane that starts in the step, or follows the strain, also turns, and its band with it: its strain then changes by
//! `dε_j` more at the same stress (`given`), a difference quotient of its closed-form return.

use fissure_tensor::{Matrix6, Sym, Tangent, Vector3, Vector6};

use super::{Decohesion, Plane, Trial, dense::Dense, turn::slope};
use crate::Isotropic;

/// Sweeps over the planes before elimination.
const MAXIMAL_SWEEPS: usize = 200;

/// `∂T/∂E`; `None` for more planes than elimination has room for, where sweeps do not converge.
pub(super) fn coupled<const N: usize>(
    elastic: &Isotropic,
    planes: &[Plane],
    rates: &[[Sym; 3]; N],
) -> Option<Tangent> {
    let mut columns = [Sym::ZERO; 6];
    for (index, column) in columns.iter_mut().enumerate() {
        let mut strain = Sym::ZERO;
        strain.mandel[index] = 1.0;
        *column = stress_rate(elastic, planes, rates, &[Sym::ZERO; N], &strain)?;
    }
    let mut matrix = Matrix6::zeros();
    for (index, column) in columns.iter().enumerate() {
        matrix.set_column(index, &Vector6::from(column.mandel));
    }
    Some(Tangent(matrix))
}

/// How a plane turns: the rates of its normal and of the width of its band, m.
#[derive(Clone, Copy, Default)]
pub(super) struct Turn {
    pub normal: Vector3<f64>,
    pub width: f64,
}

/// Change of the strain of a plane that turns, at the same stress without its jump.
pub(super) fn given<D: Decohesion>(
    decohesion: &D,
    start: &Plane,
    turn: &Turn,
    trial: &Trial,
) -> Sym {
    let rate = turn.normal.norm() + (turn.width / start.width).abs();
    if rate == 0.0 {
        return Sym::ZERO;
    }
    // The return has kinks, next to which a step may end.
    let scale = 1e-2 / rate;
    let turned = |part: f64| {
        let plane = Plane {
            normal: (start.normal() + turn.normal * (part * scale))
                .normalize()
                .into(),
            width: start.width + turn.width * (part * scale),
            ..*start
        };
        decohesion.release(&plane, trial).strain()
    };
    slope(turned) * (1.0 / scale)
}

/// `dT` for a change of strain, and of the strains of the planes besides.
pub(super) fn stress_rate<const N: usize>(
    elastic: &Isotropic,
    planes: &[Plane],
    rates: &[[Sym; 3]; N],
    given: &[Sym; N],
    strain: &Sym,
) -> Option<Sym> {
    let mut parts = [Sym::ZERO; N];
    let mut stress = elastic.stress(strain);
    let tolerance = 4.0 * f64::EPSILON * stress.norm();
    for _ in 0..MAXIMAL_SWEEPS {
        let mut moved: f64 = 0.0;
        for (((part, plane), rate), given) in parts.iter_mut().zip(planes).zip(rates).zip(given) {
            let alone = stress + elastic.stress(part);
            let jump = Vector3::from(rate.map(|row| row.dot(&alone)));
            let next = Sym::dyad_of(&jump, &plane.normal()) * (1.0 / plane.width) + *given;
            let change = elastic.stress(&(next - *part));
            moved = moved.max(change.norm());
            stress -= change;
            *part = next;
        }
        if planes.len() < 2 || moved <= tolerance {
            return Some(stress);
        }
    }
    eliminated(elastic, planes, rates, given, strain)
}

/// The same by elimination; `None` if there are too many planes.
fn eliminated<const N: usize>(
    elastic: &Isotropic,
    planes: &[Plane],
    rates: &[[Sym; 3]; N],
    given: &[Sym; N],
    strain: &Sym,
) -> Option<Sym> {
    let mut system = Dense::new(3 * planes.len())?;
    let given = &given[..planes.len()];
    let free = given.iter().fold(*strain, |left, given| left - *given);
    for (row, rate) in rates[..planes.len()].iter().enumerate() {
        let alone = elastic.stress(&(free + given[row]));
        for (axis, rate) in rate.iter().enumerate() {
            let line = 3 * row + axis;
            system.set(line, line, 1.0);
            system.set_right(line, rate.dot(&alone));
            system.set_others(line, &elastic.stress(rate), planes);
        }
    }
    system.solve();
    let mut left = free;
    for (index, plane) in planes.iter().enumerate() {
        let jump = Vector3::from_fn(|axis, _| system.right(3 * index + axis));
        left -= Sym::dyad_of(&jump, &plane.normal()) * (1.0 / plane.width);
    }
    Some(elastic.stress(&left))
}
