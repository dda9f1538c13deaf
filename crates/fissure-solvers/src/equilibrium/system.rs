//! The linear system of a Newton iteration.

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::Scene;
use nalgebra::SVector;

use super::freedoms::Freedoms;
use super::links::Links;
use super::stiffness::Stiffness;
use crate::constraints::Constraints;
use crate::linear::{Direct, LinearError};
use crate::transfers::Transfers;

/// Unknowns, matrix and factorisation of a step; what depends on the pattern alone is kept while
/// it stands.
#[derive(Default)]
pub(crate) struct System<const D: usize> {
    pub links: Links<D>,
    pub freedoms: Freedoms<D>,
    pub stiffness: Stiffness<D>,
    direct: Option<Direct<D>>,
}

impl<const D: usize> System<D> {
    /// Finds the unknowns of a step.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(crate) fn find<S: Shape<D>>(
        &mut self,
        transfers: &Transfers<'_, S, D>,
        scene: &Scene<D>,
        constraints: &Constraints<D>,
    ) -> Result<(), (usize, usize)> {
        self.links.find(transfers, scene)?;
        self.freedoms.collect(&self.links, constraints);
        Ok(())
    }

    /// Sums the stiffness of the trial state.
    pub(crate) fn assemble(&mut self, scene: &Scene<D>, tangents: &[Vec<Tangent>]) {
        if !self.stiffness.prepare(&self.links) {
            self.direct = None;
        }
        self.stiffness.assemble(&self.links, scene, tangents);
    }

    /// Solves `K δu = force − K δu_held` and adds `δu` to what is free of `displacement`; `held` has
    /// the change of the held components, as vectors of all nodes.
    #[allow(clippy::too_many_arguments)] // The system is made of all of them.
    pub(crate) fn correct<S: Shape<D>>(
        &mut self,
        scene: &Scene<D>,
        transfers: &Transfers<'_, S, D>,
        tangents: &[Vec<Tangent>],
        mut force: Vec<f64>,
        held: &[SVector<f64, D>],
        damping: f64,
        displacement: &mut [SVector<f64, D>],
    ) -> Result<(), LinearError> {
        self.assemble(scene, tangents);
        let matrix = &mut self.stiffness.matrix;
        let active = &self.links.active;
        let changes: Vec<SVector<f64, D>> = active.iter().map(|&n| held[n as usize]).collect();
        if changes.iter().any(|change| change.amax() > 0.0) {
            let forces = matrix.times(&changes);
            let components = forces.iter().flat_map(|v| v.iter());
            force.iter_mut().zip(components).for_each(|(f, k)| *f -= k);
        }
        self.freedoms.take_out(matrix, &mut force);
        let direct = match &mut self.direct {
            Some(direct) => direct,
            none => {
                let positions = self.links.positions(transfers);
                none.insert(Direct::new(matrix.pattern(), &positions)?)
            }
        };
        direct.factorise(matrix, damping)?;
        direct.solve(matrix, &mut force)?;
        self.freedoms.turn_back(&mut force);
        for (&node, change) in active.iter().zip(force.chunks_exact(D)) {
            displacement[node as usize] += SVector::from_column_slice(change);
        }
        Ok(())
    }
}
