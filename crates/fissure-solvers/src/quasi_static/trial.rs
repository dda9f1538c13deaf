//! A step in the making: displacements of the nodes and a load time, and what they leave unbalanced.
//!
//! With stabilisation at the rate `c` the residual is `R_i = f_i^ext + f_i^int − c m_i u_i/Δt`.

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::{ConditionKind, NewtonStop, Scene, SweepTotals};
use nalgebra::SVector;

use super::embedded::Embedded;
use super::faces::{Faces, Held};
use super::settings::{Averaging, QuasiStaticSettings};
use crate::checks::outside;
use crate::constraints::Constraints;
use crate::equilibrium::balance::{
    At, external_forces, forces, reactions, strain, stress_forces, unbalanced, work,
};
use crate::equilibrium::failure::Failure;
use crate::equilibrium::one_strain::Deviations;
use crate::equilibrium::statistics::StepStatistics;
use crate::equilibrium::system::{Jacobian, System};
use crate::nodes::NodeSums;
use crate::transfers::Transfers;

/// Added to the diagonal of the system, which is scaled to 1. Motions that nothing resists (a
/// fragment that has broken off, a bar on rollers) then stay where they are instead of making the
/// matrix singular. The residual is not touched, so equilibrium is exact all the same.
pub(super) const LEAST_DAMPING: f64 = 1e-10;

/// Difference of load time, over the length of a step, for the rate of the loads.
const RATE_STEP: f64 = 1e-3;

/// A step from a given state.
pub(super) struct Trial<'a, S, const D: usize> {
    pub scene: &'a mut Scene<D>,
    pub transfers: Transfers<'a, S, D>,
    pub settings: &'a QuasiStaticSettings,
    pub constraints: &'a mut Constraints<D>,
    pub system: &'a mut System<D>,
    /// Where faces of cracks may touch.
    pub faces: &'a mut Faces<D>,
    /// A crack within cells.
    pub embedded: Option<&'a mut Embedded<D>>,
    /// What particles deviate by from the strain of their cell.
    pub deviations: &'a Deviations<D>,
    /// Work that holds particles to it in the step, J.
    pub hourglass_work: f64,
    /// Forces of the trial stresses, without those of the faces, N.
    pub stresses: Vec<SVector<f64, D>>,
    pub internal: &'a mut NodeSums<D>,
    pub tangents: &'a mut Vec<Vec<Tangent>>,
    pub statistics: &'a mut StepStatistics,
    /// Displacement increments of all nodes, m.
    pub displacement: &'a mut Vec<SVector<f64, D>>,
    /// Change of load time, s.
    pub load_step: f64,
    /// Length in time, s.
    pub dt: f64,
    pub start: Start<D>,
    /// Whether the last step dissipated energy.
    pub dissipated_before: bool,
    /// Largest reaction so far, N: what residuals are measured by.
    pub force_scale: f64,
}

/// The state that a step starts from.
pub(super) struct Start<const D: usize> {
    /// Load time, s.
    pub load_time: f64,
    /// Masses of the nodes, kg, and their sum.
    pub masses: Vec<f64>,
    pub mass: f64,
    /// Momenta of the nodes, kg m/s: those of the last step.
    pub momenta: Vec<SVector<f64, D>>,
    pub external: Vec<SVector<f64, D>>,
    pub internal: Vec<SVector<f64, D>>,
    /// What rounding leaves of the forces, N.
    pub round_off: f64,
}

/// What a trial leaves unbalanced.
pub(super) struct Balance {
    pub totals: SweepTotals,
    /// On every active node, component by component, N.
    pub force: Vec<f64>,
    /// Norm of what is not held of it, over what it is measured by.
    pub error: f64,
    /// Whether that is within the tolerance, or within what rounding leaves.
    pub is_balanced: bool,
    scale: f64,
}

/// A step in equilibrium, not yet committed.
pub(super) struct Equilibrium<const D: usize> {
    pub totals: SweepTotals,
    pub reactions: Vec<SVector<f64, D>>,
    pub iterations: usize,
    /// Length in time and change of load time, s.
    pub dt: f64,
    pub load_step: f64,
    pub load_work: f64,
    pub internal_work: f64,
    pub contact_work: f64,
    pub stabilising_work: f64,
    /// Mean displacement increment, m.
    pub length: f64,
    pub force_scale: f64,
}

impl<S: Shape<D>, const D: usize> Trial<'_, S, D> {
    /// Derivative of the unbalanced forces, with its sign turned; `masses` are those of the active nodes.
    pub(super) fn jacobian<'m>(&self, masses: &'m [f64]) -> Jacobian<'m> {
        match self.settings.stabilisation {
            0.0 => Jacobian::STATIC,
            rate => Jacobian {
                stiffness: 1.0,
                inertia: rate / self.dt,
                masses,
            },
        }
    }

    /// Masses of the active nodes, kg.
    pub(super) fn active_masses(&self) -> Vec<f64> {
        let active = self.system.links.active.iter();
        active
            .map(|&node| self.start.masses[node as usize])
            .collect()
    }

    /// Loads after a change of load time, N.
    pub(super) fn loads(&self, load_step: f64) -> Result<Vec<SVector<f64, D>>, Failure> {
        let time = self.start.load_time + load_step;
        external_forces(&self.transfers, self.scene, &self.start.masses, time)
            .map_err(|(body, index)| Failure::from(outside(self.scene, body, index)))
    }

    /// Rate of the loads by load time on the active nodes, N/s, given those now.
    pub(super) fn load_rate(&self, now: &[SVector<f64, D>]) -> Result<Vec<f64>, Failure> {
        let links = &self.system.links;
        let scene = &*self.scene;
        let forced = scene.conditions().iter();
        let forced = forced.map(|condition| condition.kind());
        let mut forced = forced.filter(|kind| matches!(kind, ConditionKind::Force(_)));
        if forced.next().is_none() && !scene.has_body_force() {
            return Ok(vec![0.0; D * links.active.len()]);
        }
        let ahead = RATE_STEP * self.settings.step;
        let then = self.loads(self.load_step + ahead)?;
        let rate = |&node: &u32| (then[node as usize] - now[node as usize]) / ahead;
        let active = links.active.iter();
        Ok(active.flat_map(|node| rate(node).data.0[0]).collect())
    }

    /// What held components have to change by to have moved as the load time says, m.
    pub(super) fn held_changes(&mut self) -> Result<Vec<SVector<f64, D>>, Failure> {
        let Transfers {
            grid,
            shape,
            placement,
            ..
        } = self.transfers;
        let time = self.start.load_time + self.load_step;
        self.constraints
            .collect(self.scene, grid, shape, placement, time)?;
        let mut changes = vec![SVector::zeros(); self.displacement.len()];
        for held in &self.constraints.held {
            for (direction, speed) in held.directions[..held.count].iter().zip(held.speeds) {
                let moved = direction.dot(&self.displacement[held.node]);
                changes[held.node] += direction * (speed * self.load_step - moved);
            }
        }
        Ok(changes)
    }

    /// Velocities of held components per load time, m/s.
    pub(super) fn held_speeds(&self) -> Vec<SVector<f64, D>> {
        let mut speeds = vec![SVector::zeros(); self.displacement.len()];
        for held in &self.constraints.held {
            for (direction, speed) in held.directions[..held.count].iter().zip(held.speeds) {
                speeds[held.node] += direction * speed;
            }
        }
        speeds
    }

    /// Moves held components to where the load time has them.
    pub(super) fn place_held(&mut self) -> Result<(), Failure> {
        let changes = self.held_changes()?;
        let nodes = self.displacement.iter_mut().zip(&changes);
        nodes.for_each(|(u, change)| *u += change);
        Ok(())
    }

    /// Strains the particles; with tangents if wanted.
    pub(super) fn strain(&mut self, with_tangents: bool) -> Result<SweepTotals, Failure> {
        let tangents = with_tangents.then_some(self.tangents.as_mut_slice());
        let links = &mut self.system.links;
        if self.settings.averaging == Averaging::Volume {
            links.average(self.scene, self.displacement);
        }
        links.increase(self.scene, self.displacement);
        let (band, dt) = (self.settings.band, self.dt);
        let (transfers, u) = (&self.transfers, self.displacement.as_slice());
        Ok(strain(self.scene, transfers, u, band, dt, links, tangents)?)
    }

    /// Strains the particles and sums what is left of the forces.
    pub(super) fn balance(
        &mut self,
        loads: &[SVector<f64, D>],
        with_tangents: bool,
    ) -> Result<Balance, Failure> {
        let mut totals = self.strain(with_tangents)?;
        let links = &self.system.links;
        stress_forces(links, &self.transfers, self.scene, self.internal, At::End)
            .map_err(|(body, index)| outside(self.scene, body, index))?;
        self.stresses = forces(self.internal);
        self.hourglass_work = links.add_hourglass(
            self.scene,
            self.deviations,
            self.displacement,
            self.internal,
        );
        if let Some(embedded) = &mut self.embedded {
            embedded.add(links, self.scene, self.displacement, self.internal)?;
            embedded.energies(&mut totals);
            self.system.further = match with_tangents {
                true => embedded.blocks(links, self.scene, self.tangents),
                false => Vec::new(),
            };
        }
        let System { links, springs, .. } = &mut *self.system;
        self.faces
            .add(links, self.displacement, self.internal, springs);
        let (links, freedoms) = (&self.system.links, &self.system.freedoms);
        let outer = self.outer(loads);
        let found = unbalanced(links, freedoms, self.internal, &outer);
        // Of this state and of the steps accepted before, not of iterates that were left.
        let scale = self.force_scale.max(found.scale);
        let mut error = found.residual / if scale > 0.0 { scale } else { 1.0 };
        if !scale.is_finite() {
            error = f64::INFINITY;
        }
        // No more is asked than rounding lets be had.
        let is_balanced = error <= self.settings.tolerance
            || scale.is_finite() && found.residual <= self.start.round_off;
        Ok(Balance {
            totals,
            force: found.force,
            error,
            is_balanced,
            scale,
        })
    }

    /// Loads and stabilising forces, N.
    fn outer<'l>(&self, loads: &'l [SVector<f64, D>]) -> std::borrow::Cow<'l, [SVector<f64, D>]> {
        let rate = self.settings.stabilisation / self.dt;
        if rate == 0.0 {
            return loads.into();
        }
        let nodes = loads.iter().zip(&self.start.masses);
        let nodes = nodes.zip(self.displacement.iter());
        let outer = nodes.map(|((load, mass), u)| load - u * (rate * mass));
        outer.collect::<Vec<_>>().into()
    }

    /// Root of the mean square of a vector field, weighted by mass.
    pub(super) fn length(&self, field: &[SVector<f64, D>]) -> f64 {
        self.product(field, field).sqrt()
    }

    /// Mean product of two vector fields, weighted by mass.
    pub(super) fn product(&self, a: &[SVector<f64, D>], b: &[SVector<f64, D>]) -> f64 {
        let nodes = a.iter().zip(b).zip(&self.start.masses);
        let sum: f64 = nodes.map(|((a, b), mass)| mass * a.dot(b)).sum();
        sum / self.start.mass
    }

    /// The trial, which is balanced, as an equilibrium.
    pub(super) fn equilibrium(
        &mut self,
        balance: &Balance,
        loads: &[SVector<f64, D>],
        iterations: usize,
    ) -> Equilibrium<D> {
        let (u, start) = (self.displacement.as_slice(), &self.start);
        let outer = self.outer(loads);
        let mut stabilising_work = 0.0;
        if self.settings.stabilisation > 0.0 {
            // As all works: the mean of the forces at the start and at the end, times the way.
            let nodes = u.iter().zip(&start.masses).zip(&start.momenta);
            let work = nodes.map(|((u, mass), p)| (p + u * (mass / self.dt)).dot(u));
            stabilising_work = 0.5 * self.settings.stabilisation * work.sum::<f64>();
        }
        Equilibrium {
            totals: balance.totals,
            reactions: reactions(self.scene, self.constraints, self.internal, &outer),
            iterations,
            dt: self.dt,
            load_step: self.load_step,
            load_work: work(&start.external, loads, u),
            internal_work: -work(&start.internal, &self.stresses, u),
            contact_work: self.faces.work(u),
            stabilising_work: stabilising_work + self.hourglass_work,
            length: self.length(u),
            force_scale: balance.scale,
        }
    }

    /// Whether faces that a balanced state holds together against a pull were let go, so that it is balanced no more.
    pub(super) fn is_let_go(&mut self, balance: &Balance) -> Result<bool, Failure> {
        match self.faces.held(self.displacement, balance.scale) {
            Held::Little => Ok(false),
            Held::LetGo => Ok(true),
            // Which faces touch has not settled within the iterations.
            Held::Much => Err(Failure::at(NewtonStop::Iterations, balance.error)),
        }
    }

    /// Whether an iteration has to end without a balance, and why.
    pub(super) fn ended(&self, iteration: usize, error: f64) -> Result<(), Failure> {
        if !error.is_finite() {
            return Err(Failure::at(NewtonStop::NotFinite, error));
        }
        if iteration == self.settings.max_iterations {
            return Err(Failure::at(NewtonStop::Iterations, error));
        }
        Ok(())
    }
}
