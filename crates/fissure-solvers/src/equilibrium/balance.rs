//! The forces of a step: what the trial stresses do to the nodes, and what they leave unbalanced.

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::{Scene, SolveError, SweepSettings, SweepTotals};
use nalgebra::SVector;

use super::freedoms::Freedoms;
use super::kernel::DisplacementKernel;
use super::links::Links;
use crate::band::BandSource;
use crate::constraints::Constraints;
use crate::linear::norm;
use crate::loads::Loads;
use crate::nodes::NodeSums;
pub(crate) use crate::transfers::At;
use crate::transfers::{Given, Transfers};

/// Trial motion and stresses for nodal displacements, as the means and increments of `links` have it, and tangents where
/// there is room for them.
pub(crate) fn strain<S: Shape<D>, const D: usize>(
    scene: &mut Scene<D>,
    transfers: &Transfers<'_, S, D>,
    displacement: &[SVector<f64, D>],
    band: BandSource,
    dt: f64,
    links: &Links<D>,
    mut tangents: Option<&mut [Vec<Tangent>]>,
) -> Result<SweepTotals, SolveError> {
    let (step, time) = (scene.step() + 1, scene.time());
    let mut totals = SweepTotals::default();
    for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
        let kernel = DisplacementKernel {
            transfers,
            displacement,
            factors: links
                .averages
                .as_ref()
                .map(|averages| averages.factors[index].as_slice()),
            increments: links.increments.get(index).map(Vec::as_slice),
            half_edges: *body.half_edges(),
            banded: band.varies(transfers.shape),
            dt,
        };
        let sweep = SweepSettings {
            dt,
            band: band.band(transfers.shape, transfers.grid, body),
            viscosity: None,
            simd: transfers.simd,
            in_place: false,
        };
        let runs = &transfers.placement.runs[index];
        let part = match tangents.as_mut() {
            Some(tangents) => body.sweep_with_tangents(runs, &kernel, &sweep, &mut tangents[index]),
            None => body.sweep(runs, &kernel, &sweep),
        };
        let part = part.map_err(|failure| failure.at(body, step, time))?;
        totals = totals.merge(part);
    }
    Ok(totals)
}

/// Masses and momenta at the nodes.
pub(crate) fn momenta<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut NodeSums<D>,
) -> Result<(), (usize, usize)> {
    transfers.spread(
        scene,
        sums,
        Given::Momentum {
            affine: false,
            by_arms: None,
            forces: false,
        },
    )
}

/// Body forces and loads at the nodes, N, from their masses.
pub(crate) fn external_forces<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    masses: &[f64],
    time: f64,
) -> Result<Vec<SVector<f64, D>>, (usize, usize)> {
    let loads = Loads::new(transfers, scene, time)?;
    let nodes = masses.iter().enumerate();
    Ok(nodes.map(|(node, &mass)| loads.at(node, mass)).collect())
}

/// Internal forces of the stresses on the nodes.
pub(crate) fn internal_forces<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut NodeSums<D>,
    at: At,
) -> Result<(), (usize, usize)> {
    transfers.spread(scene, sums, Given::Forces(at))
}

/// The same, by the links where they are not what the shape functions say.
pub(crate) fn stress_forces<S: Shape<D>, const D: usize>(
    links: &Links<D>,
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut NodeSums<D>,
    at: At,
) -> Result<(), (usize, usize)> {
    if links.are_plain() {
        return internal_forces(transfers, scene, sums, at);
    }
    links.patch_forces(scene, sums, at);
    Ok(())
}

/// What rounding leaves of the forces of balanced stresses, N: norm over all nodes, which are `spacing` apart.
///
/// A deformation gradient near 1 is known to `ε`, a stress so to `ε ρ c²`, and the force of a particle on one of its `2^D`
/// nodes to that times `V/h`. Errors of different particles add as independent ones do.
pub(crate) fn round_off<const D: usize>(scene: &Scene<D>, spacing: f64) -> f64 {
    let mut square = 0.0;
    for body in scene.bodies() {
        let masses = body.particles().mass.iter();
        square += body.wave_speed().powi(4) * masses.map(|mass| mass * mass).sum::<f64>();
    }
    let nodes = f64::from(1_u32 << D);
    f64::EPSILON / spacing * (nodes * square).sqrt()
}

/// What is out of balance.
pub(crate) struct Unbalanced {
    /// Force on every active node, component by component, N.
    pub force: Vec<f64>,
    /// Norm of what is not held of it, N.
    pub residual: f64,
    /// Norm of the reactions and of the loads on what is free, N: what residuals are measured by.
    pub scale: f64,
}

/// The forces that are out of balance.
pub(crate) fn unbalanced<const D: usize>(
    links: &Links<D>,
    freedoms: &Freedoms<D>,
    internal: &NodeSums<D>,
    external: &[SVector<f64, D>],
) -> Unbalanced {
    let mut force = Vec::with_capacity(D * links.active.len());
    let mut load = Vec::with_capacity(D * links.active.len());
    for &node in &links.active {
        let node = node as usize;
        force.extend((internal.internal_force(node) + external[node]).iter());
        load.extend(external[node].iter());
    }
    let reactions = freedoms.held_square(&force);
    let mut free = force.clone();
    freedoms.turn(&mut free);
    freedoms.turn(&mut load);
    Unbalanced {
        force,
        residual: norm(&free),
        scale: (reactions + norm(&load).powi(2)).sqrt(),
    }
}

/// Force that each condition exerts, N.
pub(crate) fn reactions<const D: usize>(
    scene: &Scene<D>,
    constraints: &Constraints<D>,
    internal: &NodeSums<D>,
    external: &[SVector<f64, D>],
) -> Vec<SVector<f64, D>> {
    let mut reactions = vec![SVector::zeros(); scene.conditions().len()];
    for held in &constraints.held {
        let unbalanced = internal.internal_force(held.node) + external[held.node];
        for (condition, reaction) in held.reactions(&-unbalanced) {
            reactions[condition] += reaction;
        }
    }
    reactions
}

/// Internal forces of all nodes, N.
pub(crate) fn forces<const D: usize>(internal: &NodeSums<D>) -> Vec<SVector<f64, D>> {
    let nodes = 0..internal.len();
    nodes.map(|node| internal.internal_force(node)).collect()
}

/// Work of nodal forces over the step, J: mean of start and end, times the way.
pub(crate) fn work<const D: usize>(
    before: &[SVector<f64, D>],
    now: &[SVector<f64, D>],
    displacement: &[SVector<f64, D>],
) -> f64 {
    let forces = before.iter().zip(now);
    let pairs = forces.zip(displacement);
    pairs
        .map(|((before, now), u)| 0.5 * (before + now).dot(u))
        .sum()
}
