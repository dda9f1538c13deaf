//! How the jump of a plane changes with the stress of the trial: its part of the tangent.

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::{GeologicalFlow, opening::Opening};
use crate::multi_crack::{
    Plane, Trial,
    decohesion::{pressure, slide_rate},
};
use crate::{Softening, criteria::OnPlane};

impl<S: Softening> Opening<'_, S> {
    /// Change of the stress on the plane and of `f_n` with the opening.
    fn rate(&self, opening: f64) -> (OnPlane, f64) {
        let lateral = self.lateral_stiffness;
        let plane = OnPlane {
            normal: -self.normal_stiffness,
            shear_squared: 0.0,
            lateral_sum: -2.0 * lateral,
            lateral_determinant: lateral * (2.0 * lateral * opening - self.rest.lateral_sum),
        };
        let length = self.law.length();
        (plane, self.law.softening.slope(opening / length) / length)
    }
}

impl<S: Softening> GeologicalFlow<S> {
    /// Change of [`residual`](Self::residual) with the pressure, where it slides.
    fn residual_rate(&self, pressure: f64) -> f64 {
        if let Some(friction) = self.friction {
            return friction;
        }
        let plane = OnPlane {
            normal: -pressure,
            shear_squared: 0.0,
            lateral_sum: 0.0,
            lateral_determinant: 0.0,
        };
        let per_capacity = 0.5 * self.surface.shear_strength.powi(2) / self.residual(pressure);
        per_capacity * self.surface.partials(&plane, 0.0).normal
    }

    /// Change of the jump of a failed plane with the traction of the trial, m/Pa.
    pub(super) fn contact_rate(&self, old: &Plane, new: &Plane, trial: &Trial) -> Matrix3<f64> {
        let normal = new.normal();
        if trial.parts(new) {
            // Open: all the stress is given up.
            let across = normal * normal.transpose();
            let plane = Matrix3::identity() - across;
            return across / trial.normal_stiffness(new) + plane / trial.shear_stiffness(new);
        }
        let pressure = pressure(new, trial);
        let Some((with_traction, with_limit)) = slide_rate(old, trial, self.residual(pressure))
        else {
            return Matrix3::zeros();
        };
        if pressure > 0.0 {
            with_traction - with_limit * normal.transpose() * self.residual_rate(pressure)
        } else {
            with_traction
        }
    }

    /// Change of the jump of a plane that flows, from `F_n = 0` and the flow, differentiated at the end of the step.
    pub(super) fn flow_rate(&self, old: &Plane, new: &Plane, trial: &Trial) -> [Sym; 3] {
        let normal = new.normal();
        let held = self.held_shear(old, trial);
        let size = held.norm();
        let way = held.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        let opening = self.opening(old, trial, size);
        let (share, partials) = opening.kept(new.opening);
        // The stress on the plane changes with the opening, and with the trial as that of the trial does.
        let (per_opening, softening) = opening.rate(new.opening);
        let (there, left) = (opening.on_plane(new.opening), self.left(new.opening));
        let [sum, determinant] = OnPlane::lateral_gradients(&trial.stress, &normal);
        let lateral = opening.lateral_stiffness * new.opening;
        let gradients = [Sym::dyad(&normal), sum, determinant - sum * lateral];
        let per_part = [
            partials.normal,
            partials.lateral_sum,
            partials.lateral_determinant,
        ];
        let (mut source, mut bend_source) = (Sym::ZERO, Sym::ZERO);
        for (index, gradient) in gradients.iter().enumerate() {
            let is = |other: usize| f64::from(u8::from(index == other));
            let unit = OnPlane {
                normal: is(0),
                shear_squared: 0.0,
                lateral_sum: is(1),
                lateral_determinant: is(2),
            };
            let bend = self.surface.flow_normal_rate(&there, left, &unit, 0.0);
            source += *gradient * per_part[index];
            bend_source += *gradient * bend;
        }
        let bend = self
            .surface
            .flow_normal_rate(&there, left, &per_opening, softening);
        let slope = partials.normal * per_opening.normal
            + partials.lateral_sum * per_opening.lateral_sum
            + partials.lateral_determinant * per_opening.lateral_determinant
            + partials.softening * softening;
        // Two equations for the shear traction τ and the opening:
        //   2τ/τ_sf² dτ + slope du = −source,   N dτ + (κ τ g − (τ₀ − τ) κ bend) du = κ N dτ₀ + (τ₀ − τ) κ bend_source.
        let push = partials.normal.max(0.0);
        let (shear, rest) = (share * size, (1.0 - share) * size * share);
        let strength_squared = self.surface.shear_strength.powi(2);
        let per_shear = 2.0 * shear / strength_squared;
        let giving = 2.0 * opening.shear_stiffness / strength_squared;
        let follows = share * shear * giving - rest * bend;
        let determinant = per_shear * follows - push * slope;
        let sheared = Sym::dyad_of(&normal, &way);
        let right = sheared * (share * push) + bend_source * rest;
        let opened = (right * per_shear + source * push) * (1.0 / determinant);
        let shear_rate = (source * -follows - right * slope) * (1.0 / determinant);
        // The slip is what τ₀ is less, over the stiffness, along τ₀: along it (dτ₀ − dτ), across it as it turns.
        let flexibility = 1.0 / opening.shear_stiffness;
        let lost = sheared * share - shear_rate;
        std::array::from_fn(|i| {
            let mut across = normal * -normal[i];
            across[i] += 1.0;
            let turned = Sym::dyad_of(&normal, &across) * (1.0 - share);
            opened * normal[i] + (turned + lost * way[i]) * flexibility
        })
    }
}
