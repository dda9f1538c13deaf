//! What the law asks of one failure plane, and what all planes share: contact and friction.

use std::fmt::Debug;

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::Plane;
use crate::{Initiation, Isotropic, MaterialError, Scale};

/// One plane as seen by its return: the rest of the point is frozen.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Elastic constants of the point.
    pub elastic: Isotropic,
    /// The stress there would be if this plane had no jump, Pa.
    pub stress: Sym,
    /// Tractions closer than this are the same, Pa.
    pub slack: f64,
}

impl Trial {
    /// Normal traction without the plane's jump, Pa.
    pub fn normal_traction(&self, plane: &Plane) -> f64 {
        self.stress.normal_component(&plane.normal())
    }

    /// Shear traction without the plane's jump, Pa.
    pub fn shear_traction(&self, plane: &Plane) -> Vector3<f64> {
        let normal = plane.normal();
        let traction = self.stress.traction(&normal);
        traction - normal * normal.dot(&traction)
    }

    /// Normal traction lost per opening, `(λ + 2μ)/L`, Pa/m.
    pub fn normal_stiffness(&self, plane: &Plane) -> f64 {
        self.elastic.p_wave_modulus() / plane.width
    }

    /// Whether faces that may part freely are open beyond their seat. The opening itself does not tell: it may be off by a
    /// round-off that was not worth a return.
    pub fn parts(&self, plane: &Plane) -> bool {
        self.normal_traction(plane) > self.normal_stiffness(plane) * plane.seat
    }

    /// Shear traction lost per slip, `μ/L`, Pa/m.
    pub fn shear_stiffness(&self, plane: &Plane) -> f64 {
        self.elastic.shear_modulus() / plane.width
    }
}

/// Whether a plane is the first of its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// The first.
    First,
    /// There are others, which have been returned. Such a plane starts only where it would move: else those that do not would
    /// take all the places.
    Further,
}

/// How a failure plane starts, opens, slides and closes.
pub trait Decohesion: Copy + Debug + Send + Sync + 'static {
    /// Whether the tangent is symmetric while no plane starts.
    fn associated(&self) -> bool;

    /// Whether the plane that starts turns with the stress. Not where two planes are equally good:
    /// then no choice does.
    fn isotropic(&self) -> bool {
        true
    }

    /// Whether a small change of a step changes the stress by little.
    fn continuous(&self) -> bool {
        true
    }

    /// Whether the traction across a plane alone starts and opens it. Only such a plane may rotate: the stress along it, or
    /// shear, would change as it turns and do no work.
    fn opens_alone(&self) -> bool {
        false
    }

    /// Whether a plane across a sheet that may be sheared asks for nothing out of the sheet, neither stress nor stiffness, so
    /// that plane stress has a closed form.
    fn has_sheet_form(&self) -> bool {
        false
    }

    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`].
    fn check(&self) -> Result<(), MaterialError>;

    /// The same with the particle's factors.
    #[must_use]
    fn scaled(&self, scale: &Scale) -> Self;

    /// Tensile strength, Pa.
    fn strength(&self) -> f64;

    /// Energy per crack area to failure in opening, J/m².
    fn toughness(&self) -> f64;

    /// Dimensionless opening `u τ/G` at failure; may be infinite.
    fn critical(&self) -> f64;

    /// Largest loss of traction per opening, Pa/m.
    fn steepest(&self) -> f64;

    /// Traction over strength left at a dimensionless opening.
    fn ratio(&self, softened: f64) -> f64;

    /// Energy dissipated in opening over toughness.
    fn dissipated_fraction(&self, softened: f64) -> f64;

    /// The failure function in one direction.
    fn along(&self, stress: &Sym, normal: &Vector3<f64>, rank: Rank) -> f64;

    /// At least the failure function in every direction, from invariants.
    fn upper_bound(&self, stress: &Sym) -> f64;

    /// The direction in which a plane starts, with the largest failure function.
    fn initiation(&self, stress: &Sym, rank: Rank) -> Initiation;

    /// The largest failure function before any plane has started and its direction: that of
    /// [`initiation`](Self::initiation) on the surface, and beyond it too unless the law starts planes otherwise there.
    fn farthest(&self, stress: &Sym) -> Initiation {
        self.initiation(stress, Rank::First)
    }

    /// The failure function on a plane that has started, with what it has left of its strength: zero while it softens.
    fn on_plane(&self, stress: &Sym, normal: &Vector3<f64>, left: f64) -> f64 {
        stress.normal_component(normal) / self.strength() - left
    }

    /// Change of the normal that [`initiation`](Self::initiation) gives, with the stress, given as value and rate.
    fn normal_rate(&self, stress: [&Sym; 2], normal: &Vector3<f64>, rank: Rank) -> Vector3<f64>;

    /// Traction on a plane at the moment at which it starts, from that beyond the surface, Pa.
    fn onset_traction(&self, stress: &Sym, normal: &Vector3<f64>, rank: Rank) -> Vector3<f64>;

    /// The plane at the end of a step that started with `old`: the single one with
    /// `F ≤ 0` whose jump followed the flow. Changes `opening`, `slip`, `softened`, `seat`, `failed`.
    fn release(&self, old: &Plane, trial: &Trial) -> Plane;

    /// Change of the jump with the stress of the trial at the end of a return from `old` to `new`:
    /// `du_i = R_i:dT`, m/Pa.
    fn release_rate(&self, old: &Plane, new: &Plane, trial: &Trial) -> [Sym; 3];

    /// Energy stored in the plane, J/m².
    fn stored(&self, elastic: &Isotropic, plane: &Plane) -> f64;

    /// Energy dissipated between two states of a plane, both with their tractions, J/m²; `trial` is
    /// that of the end of the step.
    fn dissipated(&self, old: &Plane, new: &Plane, trial: &Trial) -> f64;
}

/// A failed plane: it opens freely from its seat on, and slides where the shear traction would
/// exceed `limit` of the contact pressure.
pub(super) fn contact(old: &Plane, trial: &Trial, limit: impl Fn(f64) -> f64) -> Plane {
    let mut plane = *old;
    let traction = trial.normal_traction(old);
    let stiffness = trial.normal_stiffness(old);
    plane.opening = (traction / stiffness).max(old.seat);
    plane.slip = slide(old, trial, limit(pressure(&plane, trial))).into();
    plane
}

/// What presses the faces of a plane together, Pa; exactly nothing on a failed one that is open.
pub(super) fn pressure(plane: &Plane, trial: &Trial) -> f64 {
    if plane.failed && trial.parts(plane) {
        return 0.0;
    }
    (trial.normal_stiffness(plane) * plane.opening - trial.normal_traction(plane)).max(0.0)
}

/// Change of the slip with the shear traction and with the limit, where [`slide`] slides.
pub(super) fn slide_rate(
    old: &Plane,
    trial: &Trial,
    limit: f64,
) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let (normal, stiffness) = (old.normal(), trial.shear_stiffness(old));
    let plane = Matrix3::identity() - normal * normal.transpose();
    if limit == 0.0 {
        return Some((plane / stiffness, Vector3::zeros()));
    }
    let traction = trial.shear_traction(old) - old.slip() * stiffness;
    let size = traction.norm();
    if size <= limit {
        return None;
    }
    let along = traction / size;
    let stuck = limit / size;
    let with_traction = plane * (1.0 - stuck) + along * along.transpose() * stuck;
    Some((with_traction / stiffness, along / -stiffness))
}

/// Slip after sliding down to a shear traction of `limit`, or as it was if that is not reached.
pub(super) fn slide(old: &Plane, trial: &Trial, limit: f64) -> Vector3<f64> {
    let stiffness = trial.shear_stiffness(old);
    let slip = old.slip();
    let traction = trial.shear_traction(old) - slip * stiffness;
    let size = traction.norm();
    if size <= limit + trial.slack {
        return slip;
    }
    slip + traction * ((1.0 - limit / size) / stiffness)
}
