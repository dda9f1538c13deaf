//! Decohesion in tension, shear and compression: the geological `F_n` with associated flow.
//!
//! `F_n(σ, f_n) ≤ 0` with `f_n = ratio(u_n τ/G)` and `u̇ = ω̇ ∂F_n/∂τ` [Sanchez 2010, eqs 3.5.49,
//! 3.5.64, 3.5.93]. The document steps along the flow of the iterates (4.5 (3) i-ix), so that its
//! result depends on the iteration; here the flow is that of the end of the step:
//! ```text
//! Δu_n = Δω ∂F/∂τ_n,   Δu_s = Δω 2 τ_s/τ_sf²,   F_n = 0.
//! ```
//! With `N = ∂F/∂τ_n` and the shear traction `τ₀` if nothing slid, `τ_s = τ₀ − (μ/L) Δu_s` and the flow give the shear that
//! goes with an opening,
//! ```text
//! τ_s = κ τ₀,   κ = N/(N + 2 (μ/L) Δu_n/τ_sf²),
//! ```
//! and the opening fixes `τ_n = t₀ − (E₁/L) u_n`, `S = S₀ − 2(λ/L) u_n`, `M = M₀ − a S₀ + a²` with
//! `a = (λ/L) u_n`, and `f_n`. What is left is one equation for the opening, `F_n = 0`: bracketed, and found
//! between the old opening and the critical one, which always ends (a step whose root lies beyond fails
//! the plane), and differentiated implicitly for the tangent. The slip keeps the direction of the trial.
//!
//! The `F_n` that drives the jump has its cohesion `f_n − s` held at zero from below
//! ([`Geological::flow_partials`] says why), that at which the first plane starts is the printed one. A further plane starts
//! where it would move ([`Rank::Further`]).
//!
//! The opening and the slip stay on unloading. A failed plane slides by Coulomb's law if a
//! coefficient is given; the shear traction then drops to it at failure under pressure. Without one
//! it slides on the surface `F_n(f_n = 0) = 0`, which is continuous. A plane that failed under
//! pressure by dilation stays open by what it has dilated ([`Plane::seat`]).

mod opening;
mod tangent;

use fissure_tensor::{Sym, Vector3};

use self::opening::Opening;
use super::{
    Decohesion, Plane, Rank, Trial,
    decohesion::{contact, slide},
    turn::maximum_rate,
};
use crate::crossing::crossing;
use crate::{
    Initiation, MaterialError, Scale, Softening, check_parameter,
    criteria::{FailureCriterion, Geological, OnPlane},
    softening::Linear,
};

const NAME: &str = "geological decohesion";

/// Associated flow on the geological surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeologicalFlow<S = Linear> {
    /// The surface before softening.
    pub surface: Geological,
    /// Fracture energy G_f in opening, J/m²; > 0.
    pub toughness: f64,
    /// Softening curve of `f_n`.
    pub softening: S,
    /// Coefficient of friction after failure, dimensionless, ≥ 0; `None`: the surface with
    /// `f_n = 0`.
    pub friction: Option<f64>,
}

impl Rank {
    /// That of `F_n`: as printed, or as a plane moves.
    fn least_cohesion(self) -> f64 {
        match self {
            Self::First => f64::NEG_INFINITY,
            Self::Further => 0.0,
        }
    }
}

impl<S: Softening> GeologicalFlow<S> {
    fn length(&self) -> f64 {
        self.toughness / self.surface.strength
    }

    /// `f_n` at an opening.
    fn left(&self, opening: f64) -> f64 {
        self.softening.ratio(opening / self.length())
    }

    /// Shear traction that a failed plane carries under a pressure, Pa.
    fn residual(&self, pressure: f64) -> f64 {
        if let Some(friction) = self.friction {
            return friction * pressure;
        }
        // With f_n = 0 neither the stress along the plane nor P enters.
        let plane = OnPlane {
            normal: -pressure,
            shear_squared: 0.0,
            lateral_sum: 0.0,
            lateral_determinant: 0.0,
        };
        let capacity = -self.surface.value(&plane, 0.0);
        self.surface.shear_strength * capacity.max(0.0).sqrt()
    }

    /// Up to `most`, where it is beyond: the share of a stress that is on the surface on one plane. Zero for a stress that is no
    /// number.
    fn share_on_surface(&self, stress: &Sym, normal: &Vector3<f64>, most: f64, rank: Rank) -> f64 {
        let beyond = |share: f64| self.along(&(*stress * share), normal, rank);
        crossing([0.0, most], [0.0, most].map(beyond), beyond)[1]
    }

    /// The shear traction at which a failed plane that holds until then starts to slide, on the straight way from
    /// the tractions of the last step to those of the trial, Pa.
    fn where_slip_starts(&self, old: &Plane, trial: &Trial) -> Vector3<f64> {
        let (normal, last) = (old.normal(), Vector3::from(old.traction));
        let from = normal.dot(&last);
        let to = trial.normal_traction(old) - trial.normal_stiffness(old) * old.opening;
        let sheared = last - normal * from;
        let held = self.held_shear(old, trial);
        let at = |part: f64| sheared + (held - sheared) * part;
        // That of an open plane's pressure, whose root would be none.
        let round_off = 64.0 * f64::EPSILON * trial.stress.norm();
        let excess = |part: f64| {
            let pressure = -(from + (to - from) * part) - round_off;
            at(part).norm() - self.residual(pressure.max(0.0))
        };
        let ends = [0.0, 1.0];
        let values = ends.map(excess);
        if !(values[0] < 0.0) {
            return sheared;
        }
        at(crossing(ends, values, excess)[1])
    }

    /// Shear traction if nothing slid, Pa.
    fn held_shear(&self, old: &Plane, trial: &Trial) -> Vector3<f64> {
        trial.shear_traction(old) - old.slip() * trial.shear_stiffness(old)
    }

    /// The plane seen as a function of its opening, for the size of the shear traction if nothing slid.
    fn opening(&self, old: &Plane, trial: &Trial, shear: f64) -> Opening<'_, S> {
        Opening {
            law: self,
            rest: OnPlane::new(&trial.stress, &old.normal()),
            old_opening: old.opening,
            shear,
            normal_stiffness: trial.normal_stiffness(old),
            lateral_stiffness: trial.elastic.lambda() / old.width,
            shear_stiffness: trial.shear_stiffness(old),
        }
    }

    /// Whether the plane stays as it was.
    fn holds(&self, old: &Plane, trial: &Trial, stress: &Sym) -> bool {
        let plane = OnPlane::new(stress, &old.normal());
        let partials = self.surface.flow_partials(&plane, self.left(old.opening));
        let slope = partials.normal.abs()
            + 2.0 * plane.shear_squared.sqrt() * partials.shear_squared
            + partials.lateral_sum.abs()
            + partials.lateral_determinant.abs() * plane.lateral_sum.abs();
        partials.value <= trial.slack * (slope + 1.0 / self.surface.strength)
    }
}

impl<S: Softening> Decohesion for GeologicalFlow<S> {
    /// The stress along the plane enters `F_n` but does not flow.
    fn associated(&self) -> bool {
        false
    }

    /// Planes of shear come in pairs, mirror images in the principal axes.
    fn isotropic(&self) -> bool {
        false
    }

    /// Which of two planes starts may turn on a hair, and with friction the shear drops at failure.
    fn continuous(&self) -> bool {
        false
    }

    fn check(&self) -> Result<(), MaterialError> {
        self.surface.check()?;
        let toughness = self.toughness;
        let rule = "finite and > 0";
        check_parameter(NAME, "toughness", toughness, toughness > 0.0, rule)?;
        self.softening.check()?;
        let friction = self.friction.unwrap_or(0.0);
        check_parameter(
            NAME,
            "friction",
            friction,
            friction >= 0.0,
            "finite and >= 0",
        )
    }

    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            surface: self.surface.scaled(scale),
            toughness: self.toughness * scale.toughness,
            ..*self
        }
    }

    fn strength(&self) -> f64 {
        self.surface.strength
    }

    fn toughness(&self) -> f64 {
        self.toughness
    }

    fn critical(&self) -> f64 {
        self.softening.critical()
    }

    fn steepest(&self) -> f64 {
        self.surface.strength / self.length() * self.softening.steepest()
    }

    fn ratio(&self, softened: f64) -> f64 {
        self.softening.ratio(softened)
    }

    fn dissipated_fraction(&self, softened: f64) -> f64 {
        self.softening.area(softened)
    }

    fn along(&self, stress: &Sym, normal: &Vector3<f64>, rank: Rank) -> f64 {
        let plane = OnPlane::new(stress, normal);
        self.surface
            .evaluate(&plane, 1.0, rank.least_cohesion())
            .value
    }

    fn upper_bound(&self, stress: &Sym) -> f64 {
        self.surface.upper_bound(stress)
    }

    /// The value is that of the stress, the normal that of the stress shrunk to the surface: in one
    /// large step the shear term, a square, would else outgrow the others and turn the plane.
    fn initiation(&self, stress: &Sym, rank: Rank) -> Initiation {
        let initiation = |stress: &Sym| self.surface.initiation_held(stress, rank.least_cohesion());
        let reached = initiation(stress);
        if !(reached.value > 0.0) {
            return reached;
        }
        // On the plane that was farthest beyond, back to the surface; of that stress the farthest plane, and so on: the
        // share falls to that at which no plane is beyond, at last by leaps that square.
        let (mut share, mut normal) = (1.0, reached.normal);
        for _ in 0..30 {
            let next = self.share_on_surface(stress, &normal, share, rank);
            let here = initiation(&(*stress * next));
            let still = next >= share * (1.0 - 4.0 * f64::EPSILON);
            (share, normal) = (next, here.normal);
            if still || !(here.value > 0.0) {
                break;
            }
        }
        Initiation {
            value: reached.value,
            normal,
        }
    }

    /// Of the stress as it is.
    fn farthest(&self, stress: &Sym) -> Initiation {
        self.surface.initiation(stress)
    }

    fn on_plane(&self, stress: &Sym, normal: &Vector3<f64>, left: f64) -> f64 {
        let plane = OnPlane::new(stress, normal);
        self.surface.flow_partials(&plane, left).value
    }

    /// That of the stress shrunk to the surface, of which the share follows: `F_n(s σ) = 0`.
    fn normal_rate(
        &self,
        [stress, stress_rate]: [&Sym; 2],
        normal: &Vector3<f64>,
        rank: Rank,
    ) -> Vector3<f64> {
        let share = self.share_on_surface(stress, normal, 1.0, rank);
        let shrunk = *stress * share;
        let plane = OnPlane::new(&shrunk, normal);
        let partials = self.surface.evaluate(&plane, 1.0, rank.least_cohesion());
        let gradient = Geological::gradient_of(&partials, &shrunk, normal);
        let share_rate = -share * gradient.dot(stress_rate) / gradient.dot(stress);
        let shrunk_rate = *stress_rate * share + *stress * share_rate;
        let along = |stress: &Sym, normal: &Vector3<f64>| self.along(stress, normal, rank);
        maximum_rate(along, [&shrunk, &shrunk_rate], normal)
    }

    /// As on a proportional path.
    fn onset_traction(&self, stress: &Sym, normal: &Vector3<f64>, rank: Rank) -> Vector3<f64> {
        stress.traction(normal) * self.share_on_surface(stress, normal, 1.0, rank)
    }

    fn release(&self, old: &Plane, trial: &Trial) -> Plane {
        if old.failed {
            return contact(old, trial, |pressure| self.residual(pressure));
        }
        let held = trial.stress - trial.elastic.stress(&old.strain());
        if self.holds(old, trial, &held) {
            return *old;
        }
        let opening = self.opening(old, trial, self.held_shear(old, trial).norm());
        let mut plane = *old;
        let Some(found) = opening.solve() else {
            plane.failed = true;
            plane.softened = self.softening.critical();
            let critical = plane.softened * self.length();
            let pressed = trial.normal_traction(old) < opening.normal_stiffness * critical;
            plane.seat = if pressed { critical } else { 0.0 };
            return contact(&plane, trial, |pressure| self.residual(pressure));
        };
        plane.opening = found;
        plane.softened = (found / self.length()).max(old.softened);
        plane.slip = slide(old, trial, opening.kept(found).0 * opening.shear).into();
        plane
    }

    fn release_rate(&self, old: &Plane, new: &Plane, trial: &Trial) -> [Sym; 3] {
        let normal = new.normal();
        if new.failed {
            let rate = self.contact_rate(old, new, trial);
            let row = |i: usize| Sym::dyad_of(&rate.row(i).transpose(), &normal);
            return [row(0), row(1), row(2)];
        }
        if new.opening == old.opening && new.slip == old.slip {
            return [Sym::ZERO; 3];
        }
        self.flow_rate(old, new, trial)
    }

    fn stored(&self, _elastic: &crate::Isotropic, _plane: &Plane) -> f64 {
        0.0
    }

    /// `∫ τ·du`. The opening does `∫ τ_nf f_n du` exactly, less the mean of what the normal traction
    /// lacks to `τ_nf f_n` at both ends; the shear the mean of its values at both ends. A plane that
    /// was not moving starts to move on the surface at its old jump, a failed one where it no longer holds.
    fn dissipated(&self, old: &Plane, new: &Plane, trial: &Trial) -> f64 {
        let slip = new.slip() - old.slip();
        let slid = slip.norm();
        let normal = new.normal();
        let traction = Vector3::from(new.traction);
        let along = normal.dot(&traction);
        let shear = (traction - normal * along).norm();
        if old.failed {
            let Some(way) = slip.try_normalize(0.0) else {
                return 0.0;
            };
            let before = way.dot(&self.where_slip_starts(old, trial)).max(0.0);
            return 0.5 * (before + shear) * slid;
        }
        let opening = self.opening(old, trial, shear + trial.shear_stiffness(new) * slid);
        let full = self.surface.strength * self.left(old.opening);
        let (lacking, sheared) = if old.moving {
            let traction = Vector3::from(old.traction);
            let along = normal.dot(&traction);
            (full - along, (traction - normal * along).norm())
        } else {
            let start = opening.on_plane(old.opening);
            // What it carried without moving it can carry, whatever the stress along it has become.
            let carried = normal.dot(&Vector3::from(old.traction));
            let tension = self
                .surface
                .tension(&start, self.left(old.opening))
                .max(carried);
            let lacking = (full - start.normal).max(full - tension);
            (lacking, opening.shear_at_start())
        };
        let carried = if new.failed {
            0.0
        } else {
            self.left(new.opening)
        };
        let lacking_now = self.surface.strength * carried - along;
        let critical = self.critical() * self.length();
        let opened = new.opening.min(critical) - old.opening;
        let area = self.softening.area(new.softened) - self.softening.area(old.softened);
        let in_opening = self.toughness * area - 0.5 * (lacking + lacking_now) * opened;
        let in_shear = 0.5 * (sheared + shear) * slid;
        (in_opening + in_shear).max(0.0)
    }
}
