//! One implicit step: balanced by Newton's method, cut and retried until it is.

use fissure_grid::{Grid, Shape, simd::Simd};
use fissure_materials::Tangent;
use fissure_scene::{
    Body, NewtonStop, Report, Scene, Solution, SolveError, Solver, StepControl, StepEnergy,
};
use nalgebra::SVector;

use super::newton::{Attempt, Balanced};
use super::particles::Carried;
use super::scheme::{Scheme, Start};
use super::settings::ImplicitSettings;
use crate::checks::{check_columns, check_mesh, check_until, outside};
use crate::constraints::Constraints;
use crate::crack_motion::{NodeWay, carried, refine};
use crate::equilibrium::balance::{
    At, external_forces, forces, internal_forces, momenta, round_off,
};
use crate::equilibrium::failure::Failure;
use crate::equilibrium::pace::Pace;
use crate::equilibrium::statistics::StepStatistics;
use crate::equilibrium::system::System;
use crate::nodes::NodeSums;
use crate::placement::Placement;
use crate::transfers::Transfers;

/// By how much a step may exceed the longest stable one.
const ROUND_OFF: f64 = 1e-12;

/// Implicit material-point solver on a grid with a shape function.
pub struct Implicit<S, const D: usize> {
    grid: Grid<D>,
    shape: S,
    settings: ImplicitSettings,
    scheme: Scheme,
    placement: Placement<D>,
    constraints: Constraints<D>,
    system: System<D>,
    sums: NodeSums<D>,
    displacement: Vec<SVector<f64, D>>,
    tangents: Vec<Vec<Tangent>>,
    carried: Carried<D>,
    pace: Pace,
    /// Largest force so far, N: what residuals are measured by.
    force_scale: f64,
    /// Whether the memory was recalled from a checkpoint and the scene restored after.
    recalled: bool,
    statistics: StepStatistics,
}

impl<S: Shape<D>, const D: usize> Implicit<S, D> {
    /// A solver with nothing moved yet.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn new(grid: Grid<D>, shape: S, settings: ImplicitSettings) -> Result<Self, SolveError> {
        settings.check()?;
        Ok(Self {
            grid,
            shape,
            settings,
            scheme: Scheme::new(settings.integration),
            placement: Placement::default(),
            constraints: Constraints::default(),
            system: System::default(),
            sums: NodeSums::default(),
            displacement: Vec::new(),
            tangents: Vec::new(),
            carried: Carried::default(),
            pace: Pace {
                next: settings.step,
            },
            force_scale: 0.0,
            recalled: false,
            statistics: StepStatistics::default(),
        })
    }

    /// What the last attempt at a step took, and why it ended.
    pub fn statistics(&self) -> &StepStatistics {
        &self.statistics
    }

    fn prepare(&mut self, scene: &mut Scene<D>) -> Result<(), SolveError> {
        if self.placement.is_current(scene) && !self.placement.cracks_have_moved(&self.grid) {
            return Ok(());
        }
        if self.placement.is_edited(scene) {
            if !std::mem::take(&mut self.recalled) {
                refine(scene, &self.grid, &self.placement);
                self.force_scale = 0.0;
                self.carried.clear();
                self.pace.next = self.settings.step;
            }
            check_columns(scene)?;
            check_mesh(&self.grid, &self.shape, scene)?;
            if !scene.contacts().is_empty() {
                return Err(SolveError::Unsupported {
                    what: "contact between bodies in an implicit step",
                });
            }
            if scene.has_bonds() {
                return Err(SolveError::Unsupported {
                    what: "a law between the faces of a crack in an implicit step",
                });
            }
            // Before the particles are sorted: recalled accelerations are in their present order.
            self.carried.align(scene);
            self.settings.band.check(&self.shape, &self.grid, scene)?;
        }
        self.placement.update(&self.grid, &self.shape, scene)?;
        self.carried.align(scene);
        Ok(())
    }

    /// Refuses a step that the scheme is not stable for.
    fn check_stable(&self, scene: &Scene<D>, dt: f64) -> Result<(), SolveError> {
        let Some(share) = self.scheme.longest_step() else {
            return Ok(());
        };
        let speeds = scene.bodies().iter().map(Body::wave_speed);
        let longest = share * self.grid.spacing() / speeds.fold(0.0, f64::max);
        match dt <= longest * (1.0 + ROUND_OFF) {
            true => Ok(()),
            false => Err(SolveError::UnstableStep { step: dt, longest }),
        }
    }

    /// Tries a step of length `dt`; the trial motion of the scene holds its end.
    fn attempt(&mut self, scene: &mut Scene<D>, dt: f64) -> Result<Report<D>, Failure> {
        let off_grid = |scene: &Scene<D>, (body, index)| Failure::from(outside(scene, body, index));
        let transfers = Transfers {
            grid: &self.grid,
            shape: &self.shape,
            placement: &self.placement,
            kinematics: scene.kinematics(),
            simd: Simd::widest(),
        };
        let (time, end) = (scene.time(), scene.time() + dt);
        // Twice: for the speeds at either end.
        let mut start_speeds = Vec::new();
        for time in [time, end] {
            let held = &self.constraints.held;
            start_speeds = held.iter().map(|held| held.speeds).collect();
            self.constraints
                .collect(scene, &self.grid, &self.shape, &self.placement, time)
                .map_err(Failure::from)?;
        }
        self.system
            .find(&transfers, scene, &self.constraints)
            .map_err(|failed| off_grid(scene, failed))?;
        let sums = &mut self.sums;
        momenta(&transfers, scene, sums).map_err(|failed| off_grid(scene, failed))?;
        let masses: Vec<f64> = (0..sums.len()).map(|node| sums.mass(node)).collect();
        let external = |time| {
            external_forces(&transfers, scene, &masses, time)
                .map_err(|failed| off_grid(scene, failed))
        };
        let (external_start, external_end) = (external(time)?, external(end)?);
        let velocities: Vec<SVector<f64, D>> =
            (0..sums.len()).map(|node| sums.velocity(node)).collect();
        internal_forces(&transfers, scene, sums, At::Start)
            .map_err(|failed| off_grid(scene, failed))?;
        let internal_start = forces(sums);
        let mut starts: Vec<Start<D>> = velocities
            .into_iter()
            .map(|velocity| Start {
                velocity,
                acceleration: SVector::zeros(),
            })
            .collect();
        if self.scheme.carries() {
            let carried = self.carried.at_nodes(&self.system.links, scene, &masses);
            for (node, start) in starts.iter_mut().enumerate() {
                start.acceleration = match &carried {
                    Some(carried) => carried[node],
                    // The first step starts from the forces.
                    None if masses[node] > 0.0 => {
                        (internal_start[node] + external_start[node]) / masses[node]
                    }
                    None => SVector::zeros(),
                };
            }
        }
        self.displacement.clear();
        let predicted = |start: &Start<D>| self.scheme.predicted(start, dt);
        self.displacement.extend(starts.iter().map(predicted));
        self.tangents.resize(scene.bodies().len(), Vec::new());
        let attempt = Attempt {
            transfers,
            constraints: &self.constraints,
            start_speeds,
            settings: &self.settings,
            scheme: self.scheme,
            dt,
            masses,
            starts,
            internal_start,
            external_start,
            external_end,
            force_scale: self.force_scale,
            round_off: round_off(scene, self.grid.spacing()),
        };
        let balanced = attempt.solve(
            scene,
            &mut self.system,
            sums,
            &mut self.tangents,
            &mut self.displacement,
            &mut self.statistics,
        )?;
        let report = attempt.report(scene, sums, &self.displacement, &balanced);
        let (links, carried) = (&self.system.links, &mut self.carried);
        attempt.move_particles(scene, links, &self.displacement, carried);
        self.force_scale = balanced.force_scale;
        Ok(report)
    }

    /// Makes the trial the present and books the step.
    fn accept(
        &mut self,
        scene: &mut Scene<D>,
        mut report: Report<D>,
    ) -> Result<Report<D>, SolveError> {
        let (links, displacement) = (&self.system.links, &self.displacement);
        let cracks = carried(scene, &self.grid, &self.placement, |node| {
            links.number(node).map(|_| NodeWay::of(displacement[node]))
        })?;
        cracks.accept(scene, &mut self.placement);
        for body in scene.bodies_mut() {
            body.commit()?;
        }
        self.placement.note_moves(&self.grid, &self.shape, scene);
        report.energy.kinetic_particles = scene.bodies().iter().map(Body::kinetic_energy).sum();
        scene.record(&report);
        self.placement.accept(scene);
        Ok(report)
    }
}

impl<S: Shape<D>, const D: usize> Attempt<'_, S, D> {
    /// Forces and energies of a balanced step; `sums` holds the internal forces at its end.
    fn report(
        &self,
        scene: &Scene<D>,
        sums: &NodeSums<D>,
        displacement: &[SVector<f64, D>],
        balanced: &Balanced,
    ) -> Report<D> {
        let dt = self.dt;
        let (start_share, end_share) = self.scheme.force_shares();
        let mut energy = StepEnergy {
            stored: balanced.totals.stored,
            dissipated: balanced.totals.dissipated,
            ..StepEnergy::default()
        };
        let mut reactions = vec![SVector::zeros(); scene.conditions().len()];
        let mut held = self.constraints.held.iter().peekable();
        for (node, u) in displacement.iter().enumerate() {
            let mass = self.masses[node];
            let prescribed = held.next_if(|held| held.node == node);
            if mass <= 0.0 {
                continue;
            }
            let start = &self.starts[node].velocity;
            let end = self.end(node, u);
            let (way, (first, last)) = self.scheme.work(start, &end.velocity, u, dt);
            let internal_end = sums.internal_force(node);
            let outer = |first: f64, last: f64| {
                self.external_start[node] * first + self.external_end[node] * last
            };
            let inner =
                |first: f64, last: f64| self.internal_start[node] * first + internal_end * last;
            energy.external += outer(first, last).dot(&way);
            energy.internal -= inner(first, last).dot(&way);
            energy.kinetic_grid_start += 0.5 * mass * start.norm_squared();
            energy.kinetic_grid_end += 0.5 * mass * end.velocity.norm_squared();
            if let Some(prescribed) = prescribed {
                let balance = outer(start_share, end_share) + inner(start_share, end_share);
                let force = end.balanced * mass - balance;
                for (condition, reaction) in prescribed.reactions(&force) {
                    energy.external += reaction.dot(&way);
                    reactions[condition] += reaction;
                }
            }
        }
        Report {
            step: scene.step() + 1,
            time: scene.time() + dt,
            dt,
            energy,
            reactions,
            contact_forces: Vec::new(),
            iterations: balanced.iterations,
            solution: None,
        }
    }
}

impl<S: Shape<D>, const D: usize> Solver<D> for Implicit<S, D> {
    fn step(&mut self, scene: &mut Scene<D>, until: f64) -> Result<Report<D>, SolveError> {
        check_until(scene, until)?;
        self.prepare(scene)?;
        let mut dt = self.pace.length(until - scene.time());
        self.check_stable(scene, dt)?;
        let mut cuts = 0;
        loop {
            self.statistics = StepStatistics {
                cuts,
                ..StepStatistics::default()
            };
            let failed = match self.attempt(scene, dt) {
                Ok(report) => {
                    self.statistics.stop = Some(NewtonStop::Converged);
                    self.pace.accepted(dt, cuts, self.settings.step);
                    let report = Report {
                        solution: Some(Solution {
                            load_time: report.time,
                            load_step: dt,
                            control: StepControl::Prescribed,
                            negative_pivots: self.statistics.negative_pivots,
                            cuts,
                            stop: NewtonStop::Converged,
                        }),
                        ..report
                    };
                    return self.accept(scene, report);
                }
                Err(failed) => failed,
            };
            self.statistics.stop = Some(failed.stop);
            cuts += 1;
            if cuts > self.settings.max_cuts {
                return Err(failed.into_error(scene, cuts - 1, self.settings.tolerance));
            }
            dt *= 0.5;
        }
    }

    fn memory(&self) -> Vec<f64> {
        let mut memory = vec![self.pace.next, self.force_scale];
        memory.extend(self.carried.memory());
        memory
    }

    fn recall(&mut self, memory: &[f64]) {
        if let [next, force_scale, carried @ ..] = memory {
            self.pace.next = *next;
            self.force_scale = *force_scale;
            self.carried.recall(carried);
            self.recalled = true;
        }
    }
}
