//! Manufactured motions: a motion is chosen, and the body force that makes it a solution follows.
//!
//! The force belongs to the particle, by its place at the start. As a function of the present place
//! it would make a small deviation grow, since the force changes faster with the place than the
//! elastic answer does.

use std::sync::Arc;
use std::time::Instant;

use fissure::nalgebra::Matrix2;
use fissure::prelude::*;

use fissure_study::{Parameters, StudyError};

use super::nodal_force::NodalForce;
use crate::convergence::positions;
use crate::method::Method;
use crate::problem::Outcome;

/// A chosen plane-strain motion of a neo-Hookean body and the body force that it takes.
pub trait Motion: Copy + Send + Sync + 'static {
    /// Place at a time of the particle that was at `x0`, m.
    fn position(&self, x0: &Vector2<f64>, t: f64) -> Vector2<f64>;

    /// Its deformation gradient in the plane.
    fn gradient(&self, x0: &Vector2<f64>, t: f64) -> Matrix2<f64>;

    /// Its velocity at the start, m/s.
    fn first_velocity(&self, x0: &Vector2<f64>) -> Vector2<f64>;

    /// Body force per mass on the particle that was at `x0`, m/s².
    fn body_force(&self, x0: &Vector2<f64>, t: f64) -> Vector2<f64>;

    /// The material.
    fn law(&self) -> NeoHookean;
}

/// A body that is to follow a motion.
pub struct Following<M> {
    pub motion: M,
    pub scene: Scene<2>,
    pub grid: Grid<2>,
    /// When the run ends, s.
    pub end: f64,
    /// What the error of the places is relative to, m.
    pub amplitude: f64,
    /// The particles that count, by their places at the start.
    pub counts: fn(&Vector2<f64>) -> bool,
}

impl<M: Motion> Following<M> {
    /// Runs it and compares places and stresses with the exact ones at the end.
    pub fn run(mut self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let motion = self.motion;
        let first = positions(&self.scene);
        let field = Arc::new(NodalForce::new(&self.grid));
        let shared = Arc::clone(&field);
        self.scene
            .body_force(move |x, t| shared.at(x, t))
            .set_velocity("body", |x| motion.first_velocity(x))
            .map_err(StudyError::failed("setting up the motion"))?;
        let mut solver = method.build(self.grid, BandSource::default(), self.end)?;
        let mut wall_s = 0.0;
        while self.scene.time() < self.end {
            let now = self.scene.time();
            // Explicit steps ask for the forces at their start alone.
            let ahead = match method.solver.as_str() {
                "implicit" => self.end / method.steps as f64,
                _ => 0.0,
            };
            let times = [now, now + ahead];
            field.update(&self.scene, times, |id, t| motion.body_force(&first[id], t));
            let start = Instant::now();
            solver
                .step(&mut self.scene, self.end)
                .map_err(StudyError::failed(format!("running {}", case.label())))?;
            wall_s += start.elapsed().as_secs_f64();
        }
        let t = self.scene.time();
        let body = &self.scene.bodies()[0];
        let columns = body.motion();
        let (mut volumes, mut ways, mut worst) = (0.0, 0.0, 0.0_f64);
        let (mut stresses, mut exact_stresses) = (0.0, 0.0);
        let mut field = vec![0.0; columns.position.len()];
        for (row, id) in body.particles().id.iter().enumerate() {
            let x0 = first[id.0 as usize];
            let away = (columns.position[row] - motion.position(&x0, t)).norm();
            field[row] = away / self.amplitude;
            if !(self.counts)(&x0) {
                continue;
            }
            let volume = body.particles().volume[row];
            let exact = exact_stress(&motion, &x0, t)?;
            let off = columns.stress[row] - exact;
            volumes += volume;
            ways += volume * away * away;
            // `max` would drop a NaN.
            worst = if away <= worst { worst } else { away };
            stresses += volume * off.dot(&off);
            exact_stresses += volume * exact.dot(&exact);
        }
        let mut outcome = Outcome::of(self.scene, wall_s);
        outcome
            .errors
            .insert("place_l2", (ways / volumes).sqrt() / self.amplitude);
        outcome.errors.insert("place_max", worst / self.amplitude);
        outcome
            .errors
            .insert("stress_l2", (stresses / exact_stresses).sqrt());
        outcome.field = Some(("distance from the exact place over amplitude [1]", field));
        Ok(outcome)
    }
}

/// The exact Cauchy stress.
fn exact_stress<M: Motion>(motion: &M, x0: &Vector2<f64>, t: f64) -> Result<Sym, StudyError> {
    let plane = motion.gradient(x0, t);
    let mut f = Matrix3::identity();
    for i in 0..2 {
        for j in 0..2 {
            f[(i, j)] = plane[(i, j)];
        }
    }
    let response = motion.law().update(&Increment::to(f), &());
    Ok(response
        .map_err(StudyError::failed("evaluating the exact stress"))?
        .stress)
}

/// What is left of `ρ₀ ẍ − Div P − ρ₀ b` at a place and time, over the largest of its terms, by
/// central differences of the motion and of the law's stress.
#[cfg(test)]
pub(super) fn imbalance<M: Motion>(motion: &M, x0: &Vector2<f64>, t: f64) -> f64 {
    let (dx, dt) = (1e-4, 1e-4);
    let second = |x0: &Vector2<f64>| {
        let ends = motion.position(x0, t + dt) + motion.position(x0, t - dt);
        (ends - motion.position(x0, t) * 2.0) / (dt * dt)
    };
    let first_piola = |x0: &Vector2<f64>| {
        let f = motion.gradient(x0, t);
        let stress = exact_stress(motion, x0, t).unwrap();
        let sigma = Matrix2::new(stress.xx(), stress.xy(), stress.xy(), stress.yy());
        sigma * f.determinant() * f.try_inverse().unwrap().transpose()
    };
    let mut divergence = Vector2::zeros();
    for axis in 0..2 {
        let mut step = Vector2::zeros();
        step[axis] = dx;
        let change = (first_piola(&(x0 + step)) - first_piola(&(x0 - step))) / (2.0 * dx);
        divergence += change.column(axis);
    }
    let density = motion.law().density;
    let inertia = second(x0) * density;
    let force = motion.body_force(x0, t) * density;
    let largest = inertia.norm().max(divergence.norm()).max(force.norm());
    (inertia - divergence - force).norm() / largest
}
