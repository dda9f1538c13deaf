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
//!
//! Flow that does not follow from a potential may run in circles, one return undoing another. Then the planes start again,
//! and each return is kept as it comes: none gives back what it took in the step. Every one dissipates what the point has
//! stored, so they have to end; those that take too long are an error.

use fissure_tensor::{Sym, Vector3};

use super::{Decohesion, NAME, Plane, Trial, dense::Dense};
use crate::{Isotropic, MaterialError};

/// Returns of single planes allowed in a step.
const MAXIMAL_RETURNS: usize = 2000;

/// Round-off of the sum of so many returns over that of one.
const SUMMED: f64 = 1e3;

/// Returns of single planes after which those that creep are let go.
const STEADY_RETURNS: usize = 200;

/// What may be left then, over the round-off of one return: two planes nearly across each other share a shear strain, each may
/// take it, and returns shift it from one to the other by round-off while the stress stays.
const CREEP: f64 = 8.0;

/// Returns of single planes between two of all at once.
const RETURNS_BETWEEN_JUMPS: usize = 40;

/// Most planes that are returned all at once.
const MAXIMAL_JUMP: usize = 20;

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

/// Where planes have come to.
pub(super) struct Relaxed {
    /// The stress that is left, Pa.
    pub stress: Sym,
    /// Whether each return was kept as it came: the jumps then depend on the way, not on the end of the step alone.
    pub in_turn: bool,
}

/// Changes `planes`, which start from `old`, to the end of the step.
///
/// # Errors
/// [`MaterialError::NoConvergence`].
pub(super) fn relax<D: Decohesion>(
    decohesion: &D,
    elastic: &Isotropic,
    strain: &Sym,
    old: &[Plane],
    planes: &mut [Plane],
) -> Result<Relaxed, MaterialError> {
    let mut point = Point {
        decohesion,
        elastic,
        strain,
        old: Some(old),
    };
    let mut left = point.returned(planes);
    let in_turn = left.is_err() && planes.len() > 1;
    if in_turn {
        planes.copy_from_slice(old);
        point.old = None;
        left = point.returned(planes);
    }
    let stress = left.map_err(|residual| MaterialError::NoConvergence {
        law: NAME,
        iterations: MAXIMAL_RETURNS,
        residual: residual / decohesion.strength(),
    })?;
    for (plane, start) in planes.iter_mut().zip(old) {
        plane.traction = stress.traction(&plane.normal()).into();
        let moved = plane.opening != start.opening || plane.slip != start.slip;
        plane.moving = moved || (start.moving && plane.traction == start.traction);
    }
    Ok(Relaxed { stress, in_turn })
}

/// What does not change while the planes relax.
struct Point<'a, D> {
    decohesion: &'a D,
    elastic: &'a Isotropic,
    strain: &'a Sym,
    /// Where each plane starts from; `None`: from where it is.
    old: Option<&'a [Plane]>,
}

impl<D: Decohesion> Point<'_, D> {
    /// Returns planes until none would change its traction by more than round-off; the stress then, or what is left to
    /// do, Pa.
    fn returned(&self, planes: &mut [Plane]) -> Result<Sym, f64> {
        let mut residual = f64::INFINITY;
        for count in 1..=MAXIMAL_RETURNS {
            let stress = stress_of(self.elastic, self.strain, planes);
            // Of the planes as they are now, so that a step that ends here is not taken up again by a
            // zero increment.
            let tolerance = tolerance(self.decohesion, self.elastic, self.strain, planes);
            let chosen = self.next(planes, &stress, tolerance);
            residual = chosen.as_ref().map_or(0.0, |(_, _, change)| *change);
            let enough = tolerance
                * match count {
                    // What a step left is more by round-off from where it ended: a zero increment shall not take it up again.
                    1 => 2.0 * CREEP,
                    2..=STEADY_RETURNS => 1.0,
                    _ => CREEP,
                };
            // NaN goes on to the end, as an error.
            if residual <= enough {
                return Ok(stress);
            }
            if let Some((index, next, _)) = chosen {
                planes[index] = next;
            }
            if count % RETURNS_BETWEEN_JUMPS == 0 && planes.len() > 1 {
                self.jump_ahead(planes, tolerance);
            }
        }
        // Kept as they come, returns add up their round-off: what is left may be that, though it never gets below one's own.
        let stress = stress_of(self.elastic, self.strain, planes);
        let tolerance = tolerance(self.decohesion, self.elastic, self.strain, planes);
        if self.old.is_none() && residual <= SUMMED * tolerance {
            return Ok(stress);
        }
        Err(residual)
    }

    /// Where a plane starts from.
    fn start(&self, planes: &[Plane], index: usize) -> Plane {
        self.old.map_or(planes[index], |old| old[index])
    }

    /// What a plane sees. A plane that is alone sees the strain's stress, to the last bit.
    fn trial(&self, planes: &[Plane], index: usize, stress: &Sym, tolerance: f64) -> Trial {
        let stress = match planes {
            [_] => self.elastic.stress(self.strain),
            _ => *stress + self.elastic.stress(&planes[index].strain()),
        };
        Trial {
            elastic: *self.elastic,
            stress,
            slack: 4.0 * tolerance,
        }
    }

    /// The plane to be returned next, by the rule of selection: its place, what it becomes and by
    /// how much its traction would change, Pa.
    fn next(&self, planes: &[Plane], stress: &Sym, tolerance: f64) -> Option<(usize, Plane, f64)> {
        let mut chosen: Option<(usize, Plane, f64)> = None;
        for (index, plane) in planes.iter().enumerate() {
            let trial = self.trial(planes, index, stress, tolerance);
            let next = self.decohesion.release(&self.start(planes, index), &trial);
            let change = (next.jump() - plane.jump()).norm() * trial.normal_stiffness(plane);
            let leads = chosen.as_ref().is_none_or(|(best, _, largest)| {
                let first = order(&plane.normal) > order(&planes[*best].normal);
                change > *largest || (change == *largest && first) || change.is_nan()
            });
            if leads {
                chosen = Some((index, next, change));
            }
        }
        chosen
    }

    /// Where planes converge slowly, all jumps at once by Newton's method on
    /// `release_j(u) − u_j = 0`, taken if it leaves less to be done. Every plane is then returned
    /// from there, so that its state is one that a return gives.
    fn jump_ahead(&self, planes: &mut [Plane], tolerance: f64) -> Option<()> {
        let stress = stress_of(self.elastic, self.strain, planes);
        let count = planes.len();
        let mut system = Dense::new(3 * count)?;
        let old = self.old?;
        let (_, _, before) = self.next(planes, &stress, tolerance)?;
        for (row, start) in old.iter().enumerate() {
            let trial = self.trial(planes, row, &stress, tolerance);
            let next = self.decohesion.release(start, &trial);
            let rate = self.decohesion.release_rate(start, &next, &trial);
            let left = next.jump() - planes[row].jump();
            for axis in 0..3 {
                let line = 3 * row + axis;
                system.set(line, line, 1.0);
                system.set_right(line, left[axis]);
                system.set_others(line, &self.elastic.stress(&rate[axis]), planes);
            }
        }
        system.solve();
        let mut ahead = [Plane::default(); MAXIMAL_JUMP];
        let ahead = &mut ahead[..count];
        ahead.copy_from_slice(planes);
        for (index, plane) in ahead.iter_mut().enumerate() {
            let step = Vector3::from_fn(|axis, _| system.right(3 * index + axis));
            let normal = plane.normal();
            let along = normal.dot(&step);
            plane.opening += along;
            plane.slip = (plane.slip() + step - normal * along).into();
        }
        let stress = stress_of(self.elastic, self.strain, ahead);
        let mut landed = [Plane::default(); MAXIMAL_JUMP];
        let landed = &mut landed[..count];
        for (index, plane) in landed.iter_mut().enumerate() {
            let trial = self.trial(ahead, index, &stress, tolerance);
            *plane = self.decohesion.release(&old[index], &trial);
        }
        let stress = stress_of(self.elastic, self.strain, landed);
        let (_, _, after) = self.next(landed, &stress, tolerance)?;
        if after < before {
            planes.copy_from_slice(landed);
        }
        Some(())
    }
}

/// Round-off of the stress, of all the strains whose difference it is, Pa.
pub(super) fn tolerance<D: Decohesion>(
    decohesion: &D,
    elastic: &Isotropic,
    strain: &Sym,
    planes: &[Plane],
) -> f64 {
    let parts: f64 = planes.iter().map(|plane| plane.strain().norm()).sum();
    let modulus = elastic.p_wave_modulus();
    let size = modulus * (strain.norm() + parts) + decohesion.strength();
    // A softening plane amplifies round-off by 1/(1 − band/limit).
    let widest = planes.iter().map(|plane| plane.width).fold(0.0, f64::max);
    let reserve = 1.0 - widest * decohesion.steepest() / modulus;
    16.0 * f64::EPSILON * size / reserve.max(1e-3)
}

/// Components of the normal, signed so that the largest is positive: comparable whatever the
/// storage order and sign.
fn order(normal: &[f64; 3]) -> [f64; 3] {
    let largest = normal
        .iter()
        .fold(0.0_f64, |m, c| if c.abs() > m.abs() { *c } else { m });
    normal.map(|c| c * largest.signum())
}
