//! The energy ledger and what a step reports.

use nalgebra::SVector;
use serde::{Deserialize, Serialize};

use crate::solution::Solution;

/// Energies of one step, J.
///
/// The ledger keeps apart what is an identity from what is an approximation:
/// `external = Δkinetic_grid + internal + staggering + contact + stabilisation` holds to round-off in an explicit step (in a
/// quasi-static one to what equilibrium and the fresh grid of the next step leave);
/// `internal = Δstored + dissipated + viscous` but for little that falls with the step; what the transfer between particles and grid
/// loses is `kinetic_grid − kinetic_particles`, with the kinetic energy taken at the time of the stresses: velocities of an
/// explicit step are half a step away from it (`staggering`, `half_step`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepEnergy {
    /// Work of loads, body forces and prescribed velocities.
    pub external: f64,
    /// Work of the internal forces on the displacement that strains the particles, by their mean over the step; positive
    /// when it is stored.
    pub internal: f64,
    /// Work of the internal forces on the nodes that they accelerate, less `internal`.
    pub staggering: f64,
    /// Kinetic energy at the time of the stresses less that of the velocities, at the end of the step: half the power of
    /// the internal forces times the step.
    pub half_step: f64,
    /// Stored energy at the end of the step.
    pub stored: f64,
    /// Energy dissipated by the laws in the step.
    pub dissipated: f64,
    /// Work of artificial viscosity in the step.
    pub viscous: f64,
    /// Energy that contacts take: friction, and impacts, which have no rebound of their own.
    pub contact: f64,
    /// Work against the forces that stabilise a quasi-static step.
    pub stabilisation: f64,
    /// Kinetic energy of the grid before the nodes were accelerated.
    pub kinetic_grid_start: f64,
    /// Kinetic energy of the grid after.
    pub kinetic_grid_end: f64,
    /// Kinetic energy of the particles at the end of the step.
    pub kinetic_particles: f64,
}

/// Energies since the start of a scene, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyTotals {
    /// Work of loads, body forces and prescribed velocities.
    pub external: f64,
    /// Work of the internal forces.
    pub internal: f64,
    /// Stored energy now.
    pub stored: f64,
    /// Energy dissipated by the laws.
    pub dissipated: f64,
    /// Work of artificial viscosity.
    pub viscous: f64,
    /// Energy that contacts took.
    pub contact: f64,
    /// Work against the forces that stabilise quasi-static steps.
    pub stabilisation: f64,
    /// Kinetic energy of the particles now.
    pub kinetic: f64,
    /// Kinetic energy at the time of the stresses less `kinetic`.
    pub half_step: f64,
    /// Kinetic energy at the time of the stresses that is lost between particles and grid, both ways:
    /// `external = kinetic + half_step + internal + contact + stabilisation + transfer_loss` of a scene that starts at rest.
    pub transfer_loss: f64,
    /// Largest `|external − Δkinetic_grid − internal − staggering − contact − stabilisation|` of a step, over that step's
    /// largest term.
    pub worst_balance: f64,
}

impl EnergyTotals {
    /// Adds a step.
    pub(crate) fn add(&mut self, step: &StepEnergy) {
        self.external += step.external;
        self.internal += step.internal;
        self.stored = step.stored;
        self.dissipated += step.dissipated;
        self.viscous += step.viscous;
        self.contact += step.contact;
        self.stabilisation += step.stabilisation;
        self.transfer_loss += (self.kinetic - step.kinetic_grid_start)
            + (step.kinetic_grid_end - step.kinetic_particles)
            + (self.half_step - step.half_step + step.staggering);
        self.kinetic = step.kinetic_particles;
        self.half_step = step.half_step;
        let gain = step.kinetic_grid_end - step.kinetic_grid_start;
        let scale = step
            .external
            .abs()
            .max(step.internal.abs())
            .max((step.internal + step.staggering).abs())
            .max(step.kinetic_grid_end)
            .max(step.kinetic_grid_start);
        if scale > 0.0 {
            let taken = step.internal + step.staggering + step.contact + step.stabilisation;
            let balance = (step.external - gain - taken).abs() / scale;
            // `max` would drop a NaN.
            if !(balance <= self.worst_balance) {
                self.worst_balance = balance;
            }
        }
    }

    /// `internal − stored − dissipated − viscous`, J: the error of the time integration of the
    /// laws. A scene that starts undeformed has it at zero.
    pub fn imbalance(&self) -> f64 {
        self.internal - self.stored - self.dissipated - self.viscous
    }
}

/// What a solver says of a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report<const D: usize> {
    /// Number of the step, counted from 1.
    pub step: u64,
    /// Time at its end, s.
    pub time: f64,
    /// Its length, s.
    pub dt: f64,
    /// Its energies.
    pub energy: StepEnergy,
    /// Force that each condition exerts on the bodies, N, in the order of the scene's conditions.
    pub reactions: Vec<SVector<f64, D>>,
    /// Force that each contact exerts on its second body, N, in the order of the scene's contacts.
    pub contact_forces: Vec<SVector<f64, D>>,
    /// Newton iterations; 0 for explicit steps.
    pub iterations: usize,
    /// How the equations were solved; `None` for explicit steps.
    pub solution: Option<Solution>,
}

impl<const D: usize> Report<D> {
    /// Time for which the loads and motions were taken at the end of the step, and what it changed by, s.
    pub fn load_time(&self) -> (f64, f64) {
        self.solution.map_or((self.time, self.dt), |solution| {
            (solution.load_time, solution.load_step)
        })
    }
}
