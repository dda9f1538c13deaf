//! External forces on the nodes: those of the conditions and the body force.

use fissure_grid::{Grid, Shape, Stencil};
use fissure_scene::{ConditionKind, Scene, Selection};
use nalgebra::SVector;

use crate::placement::Placement;
use crate::transfers::Transfers;

/// External forces at one time. Costs nothing in a scene that has none.
pub(crate) struct Loads<'a, const D: usize> {
    scene: &'a Scene<D>,
    grid: &'a Grid<D>,
    placement: &'a Placement<D>,
    time: f64,
    /// Of the conditions, by node, N; empty without any.
    forces: Vec<SVector<f64, D>>,
}

impl<'a, const D: usize> Loads<'a, D> {
    /// The loads at `time`; forces of conditions are spread by the present stencils of their
    /// particles.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(crate) fn new<S: Shape<D>>(
        transfers: &Transfers<'a, S, D>,
        scene: &'a Scene<D>,
        time: f64,
    ) -> Result<Self, (usize, usize)> {
        let mut loads = Self {
            scene,
            grid: transfers.grid,
            placement: transfers.placement,
            time,
            forces: Vec::new(),
        };
        for (index, condition) in scene.conditions().iter().enumerate() {
            if let (ConditionKind::Force(force), Selection::Body { body, .. }) =
                (condition.kind(), condition.selection())
            {
                let count = transfers.placement.node_count();
                loads.forces.resize(count, SVector::zeros());
                loads.spread(transfers, index, *body, force(time))?;
            }
        }
        Ok(loads)
    }

    /// Shares a condition's force out to its particles by volume, and on to their nodes.
    fn spread<S: Shape<D>>(
        &mut self,
        transfers: &Transfers<'_, S, D>,
        condition: usize,
        body_index: usize,
        force: SVector<f64, D>,
    ) -> Result<(), (usize, usize)> {
        let placement = transfers.placement;
        let body = &self.scene.bodies()[body_index];
        let rows = placement.selected(condition);
        let volume = &body.particles().volume;
        let total: f64 = rows.iter().map(|&row| volume[row as usize]).sum();
        for &row in rows {
            let off_grid = (body_index, row as usize);
            let window = placement.window_of_row(body_index, row).ok_or(off_grid)?;
            let stencil = transfers.stencil(body, &placement.window(window), row as usize);
            let nodes = placement.nodes(window);
            let share = force * (volume[row as usize] / total);
            stencil.ok_or(off_grid)?.visit_values(|entry, weight| {
                self.forces[nodes.node(entry)] += share * weight;
            });
        }
        Ok(())
    }

    /// External force on a node of this mass, N.
    #[inline]
    pub(crate) fn at(&self, node: usize, mass: f64) -> SVector<f64, D> {
        let mut force = SVector::zeros();
        if let Some(load) = self.forces.get(node) {
            force = *load;
        }
        // Nodes of jumps have no place, and no mass.
        if mass > 0.0 && self.scene.has_body_force() {
            let x = self.placement.node_position(self.grid, node);
            if let Some(acceleration) = self.scene.body_acceleration(&x, self.time) {
                force += acceleration * mass;
            }
        }
        force
    }
}
