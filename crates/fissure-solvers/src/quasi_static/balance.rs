//! The forces of a step: what the trial stresses do to the nodes, and what they leave unbalanced.

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::{Body, Scene, SolveError, SweepSettings, SweepTotals};
use nalgebra::SVector;

use super::assembly::relative;
use super::freedoms::{Freedoms, NONE};
use super::kernel::DisplacementKernel;
use super::settings::QuasiStaticSettings;
use crate::constraints::Constraints;
use crate::loads::add_loads;
use crate::to_grid::{Gift, StressForce, Sums, Transfers};

/// Trial motion, stresses and tangents for nodal displacements.
pub(super) fn strain<S: Shape<D>, const D: usize>(
    scene: &mut Scene<D>,
    transfers: &Transfers<'_, S, D>,
    displacement: &[SVector<f64, D>],
    settings: &QuasiStaticSettings,
    dt: f64,
    tangents: &mut [Vec<Tangent>],
) -> Result<SweepTotals, SolveError> {
    let (step, time) = (scene.step() + 1, scene.time());
    let mut totals = SweepTotals::default();
    for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
        let kernel = DisplacementKernel {
            transfers,
            displacement,
            half_edges: *body.half_edges(),
            dt,
        };
        let sweep = SweepSettings {
            dt,
            band: settings.band.band(transfers.shape, transfers.grid, body),
            viscosity: None,
        };
        let runs = &transfers.placement.runs[index];
        let part = body
            .sweep_with_tangents(runs, &kernel, &sweep, &mut tangents[index])
            .map_err(|failure| failure.at(body, step, time))?;
        totals = totals.merge(part);
    }
    Ok(totals)
}

/// Mass, momentum (for the predictor), body forces and loads at the nodes.
pub(super) fn external_forces<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut Sums<D>,
    time: f64,
) -> Result<(), (usize, usize)> {
    transfers.to_grid(scene, sums, |body: &Body<D>, i, _, _| {
        let particles = body.particles();
        let acceleration = scene.body_acceleration(&particles.motion.position[i], time);
        Gift {
            mass: particles.mass[i],
            velocity: particles.motion.velocity[i],
            affine: None,
            stress: None,
            acceleration: acceleration.unwrap_or_else(SVector::zeros),
        }
    })?;
    add_loads(transfers, scene, sums, time)
}

/// When internal forces are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    /// Before the step: of the present stresses.
    Start,
    /// After it: of the trial stresses, with gradients at the end of the step.
    End,
}

/// Internal forces of the stresses on the nodes.
pub(super) fn internal_forces<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut Sums<D>,
    at: At,
) -> Result<(), (usize, usize)> {
    transfers.to_grid(scene, sums, |body: &Body<D>, i, _, _| {
        let particles = body.particles();
        let motion = match at {
            At::Start => &particles.motion,
            At::End => &particles.trial,
        };
        let f_new = &motion.deformation_gradient[i];
        let f_old = &particles.motion.deformation_gradient[i];
        let volume = particles.volume[i] * f_new.determinant();
        let mut stress = StressForce::new(
            transfers.kinematics,
            &motion.stress[i],
            volume,
            &motion.position[i],
        );
        stress.on_gradient *= relative::<D>(f_new, f_old);
        Gift {
            mass: 0.0,
            velocity: SVector::zeros(),
            affine: None,
            stress: Some(stress),
            acceleration: SVector::zeros(),
        }
    })
}

/// Unbalanced force of every equation, its norm, and the norm of the reactions and loads.
pub(super) fn residual<const D: usize>(
    freedoms: &Freedoms<D>,
    internal: &Sums<D>,
    external: &Sums<D>,
) -> (Vec<f64>, f64, f64) {
    let mut right = vec![0.0; freedoms.count];
    let (mut unbalanced, mut reaction) = (0.0, 0.0);
    let sums = internal.nodes.iter().zip(&external.nodes);
    for (node, (internal, external)) in freedoms.nodes.iter().zip(sums) {
        let force = internal.internal_force + external.external_force;
        for (direction, &equation) in node.directions.iter().zip(&node.equations) {
            let component = direction.dot(&force);
            if equation != NONE {
                right[equation as usize] = component;
                unbalanced += component * component;
                let load = direction.dot(&external.external_force);
                reaction += load * load;
            } else {
                reaction += component * component;
            }
        }
    }
    (right, unbalanced.sqrt(), reaction.sqrt())
}

/// Force that each condition exerts, N.
pub(super) fn reactions<const D: usize>(
    scene: &Scene<D>,
    constraints: &Constraints<D>,
    internal: &Sums<D>,
    external: &Sums<D>,
) -> Vec<SVector<f64, D>> {
    let mut reactions = vec![SVector::zeros(); scene.conditions().len()];
    for held in &constraints.held {
        let unbalanced =
            internal.nodes[held.node].internal_force + external.nodes[held.node].external_force;
        for (condition, reaction) in held.reactions(&-unbalanced) {
            reactions[condition] += reaction;
        }
    }
    reactions
}

/// Work of nodal forces over the step, J: mean of start and end, times the way.
pub(super) fn work<const D: usize>(
    before: &[SVector<f64, D>],
    now: impl Iterator<Item = SVector<f64, D>>,
    displacement: &[SVector<f64, D>],
) -> f64 {
    let forces = before.iter().zip(now);
    let pairs = forces.zip(displacement);
    pairs
        .map(|((before, now), u)| 0.5 * (before + now).dot(u))
        .sum()
}
