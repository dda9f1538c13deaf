//! One load step: Newton's method, cut and retried until it converges.

use fissure_grid::{Grid, Shape, simd::Simd};
use fissure_materials::Tangent;
use fissure_scene::{
    ConditionKind, Kinematics, NewtonStop, Report, Scene, Solution, SolveError, Solver,
    StepControl, StepEnergy,
};
use nalgebra::SVector;

use super::newton::balanced;
use super::path::{Goal, follow};
use super::settings::{LoadControl, QuasiStaticSettings, VolumeChange};
use super::trial::{Equilibrium, Start, Trial};
use crate::checks::{check_columns, check_until, outside};
use crate::constraints::Constraints;
use crate::crack_motion::{carried, refine};
use crate::equilibrium::balance::{At, external_forces, forces, internal_forces, momenta, strain};
use crate::equilibrium::failure::Failure;
use crate::equilibrium::pace::Pace;
use crate::equilibrium::statistics::StepStatistics;
use crate::equilibrium::system::System;
use crate::linear::BlockMatrix;
use crate::nodes::NodeSums;
use crate::placement::Placement;
use crate::transfers::Transfers;

/// Quasi-static material-point solver on a grid with a shape function.
pub struct QuasiStatic<S, const D: usize> {
    grid: Grid<D>,
    shape: S,
    settings: QuasiStaticSettings,
    placement: Placement<D>,
    constraints: Constraints<D>,
    system: System<D>,
    internal: NodeSums<D>,
    displacement: Vec<SVector<f64, D>>,
    tangents: Vec<Vec<Tangent>>,
    pace: Pace,
    /// Largest reaction so far, N: what residuals are measured by.
    force_scale: f64,
    /// Nodal displacements of the last step were mapped to the particles' velocities.
    has_stepped: bool,
    /// Change of load time over the length of the last step.
    load_rate: f64,
    /// Arc length of a step of full length, m; 0 before the first step.
    arc_length: f64,
    /// What the last step held fixed.
    last_control: StepControl,
    dissipated_before: bool,
    /// Whether the memory was recalled from a checkpoint and the scene restored after.
    recalled: bool,
    statistics: StepStatistics,
}

/// Energy that a prescribed step may dissipate, over that of a controlled one, before control is taken.
const MOST: f64 = 1.5;
/// The same before control is given back.
const LEAST: f64 = 0.01;

impl<S: Shape<D>, const D: usize> QuasiStatic<S, D> {
    /// A solver with nothing moved yet.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn new(grid: Grid<D>, shape: S, settings: QuasiStaticSettings) -> Result<Self, SolveError> {
        settings.check()?;
        Ok(Self {
            grid,
            shape,
            settings,
            placement: Placement::default(),
            constraints: Constraints::default(),
            system: System::default(),
            internal: NodeSums::default(),
            displacement: Vec::new(),
            tangents: Vec::new(),
            pace: Pace {
                next: settings.step,
            },
            force_scale: 0.0,
            has_stepped: false,
            load_rate: 1.0,
            arc_length: 0.0,
            last_control: StepControl::Prescribed,
            dissipated_before: false,
            recalled: false,
            statistics: StepStatistics::default(),
        })
    }

    /// What the last attempt at a step took, and why it ended.
    pub fn statistics(&self) -> &StepStatistics {
        &self.statistics
    }

    /// Negative pivots of the last tangent factorised, its damping included: 0 on a stable branch; each
    /// stands for a direction in which equilibrium is not stable. Of a tangent that is not symmetric
    /// those of the symmetric part.
    pub fn negative_pivots(&self) -> usize {
        self.system.negative_pivots()
    }

    /// The tangent stiffness of the scene as it is, without what conditions hold, and the positions of
    /// its nodes, m: a row of blocks for each node that a particle reaches.
    ///
    /// # Errors
    /// Those of a step: a law or the grid refuses. The scene keeps its present motion.
    pub fn stiffness(
        &mut self,
        scene: &mut Scene<D>,
    ) -> Result<(&BlockMatrix<D>, Vec<[f64; D]>), SolveError> {
        self.prepare(scene)?;
        let transfers = Transfers {
            grid: &self.grid,
            shape: &self.shape,
            placement: &self.placement,
            kinematics: scene.kinematics(),
            simd: Simd::widest(),
        };
        let off_grid = |(body, index)| outside(scene, body, index);
        self.system
            .find(&transfers, scene, &Constraints::default())
            .map_err(off_grid)?;
        let still = vec![SVector::zeros(); transfers.placement.node_count()];
        self.tangents.resize(scene.bodies().len(), Vec::new());
        let (band, dt) = (self.settings.band, self.settings.step);
        let links = &mut self.system.links;
        if self.settings.volume == VolumeChange::Patch {
            links.average(scene, &still);
        }
        strain(
            scene,
            &transfers,
            &still,
            band,
            dt,
            links.averages.as_ref(),
            Some(&mut self.tangents),
        )?;
        self.system.assemble(scene, &self.tangents);
        let positions = self.system.links.positions(&transfers);
        Ok((&self.system.stiffness.matrix, positions))
    }

    fn prepare(&mut self, scene: &mut Scene<D>) -> Result<(), SolveError> {
        if self.placement.is_current(scene) && !self.placement.cracks_have_moved(&self.grid) {
            return Ok(());
        }
        if self.placement.is_edited(scene) {
            if !std::mem::take(&mut self.recalled) {
                refine(scene, &self.grid);
                (self.force_scale, self.has_stepped) = (0.0, false);
                self.arc_length = 0.0;
                self.last_control = StepControl::Prescribed;
                self.dissipated_before = false;
                self.pace.next = self.settings.step;
            }
            check_columns(scene)?;
            if !scene.contacts().is_empty() {
                return Err(SolveError::Unsupported {
                    what: "contact between bodies in a quasi-static step",
                });
            }
            let averages = self.settings.volume == VolumeChange::Patch;
            let kinematics = scene.kinematics();
            if averages
                && !matches!(
                    kinematics,
                    Kinematics::PlaneStrain { .. } | Kinematics::Solid
                )
            {
                return Err(SolveError::Unsupported {
                    what: "averaging volume changes other than in plane strain and in space",
                });
            }
            self.settings.band.check(&self.shape, &self.grid, scene)?;
        }
        self.placement.update(&self.grid, scene)
    }

    /// A trial of length `dt` that goes on as the last step did, or, if not `predict`, stands still.
    fn trial<'a>(
        &'a mut self,
        scene: &'a mut Scene<D>,
        dt: f64,
        predict: bool,
    ) -> Result<Trial<'a, S, D>, Failure> {
        let transfers = Transfers {
            grid: &self.grid,
            shape: &self.shape,
            placement: &self.placement,
            kinematics: scene.kinematics(),
            simd: Simd::widest(),
        };
        let off_grid = |scene: &Scene<D>, (body, index): (usize, usize)| {
            Failure::from(outside(scene, body, index))
        };
        let load_time = scene.load_time();
        let (grid, shape) = (&self.grid, &self.shape);
        self.constraints
            .collect(scene, grid, shape, &self.placement, load_time)?;
        self.system
            .find(&transfers, scene, &self.constraints)
            .map_err(|failed| off_grid(scene, failed))?;
        let sums = &mut self.internal;
        momenta(&transfers, scene, sums).map_err(|failed| off_grid(scene, failed))?;
        let nodes = 0..sums.len();
        let masses: Vec<f64> = nodes.clone().map(|node| sums.mass(node)).collect();
        self.displacement.clear();
        self.displacement
            .extend(nodes.clone().map(|node| match predict {
                true => sums.velocity(node) * dt,
                false => SVector::zeros(),
            }));
        let stepped = self.has_stepped;
        let momenta = nodes.map(|node| match stepped {
            true => sums.momentum(node),
            false => SVector::zeros(),
        });
        let momenta = momenta.collect();
        let external = external_forces(&transfers, scene, &masses, load_time)
            .map_err(|failed| off_grid(scene, failed))?;
        let links = &mut self.system.links;
        if self.settings.volume == VolumeChange::Patch {
            let still = vec![SVector::zeros(); sums.len()];
            links.average(scene, &still);
            links.averaged_forces(scene, sums, At::Start);
        } else {
            internal_forces(&transfers, scene, sums, At::Start)
                .map_err(|failed| off_grid(scene, failed))?;
        }
        self.tangents.resize(scene.bodies().len(), Vec::new());
        self.statistics.residuals.clear();
        Ok(Trial {
            start: Start {
                load_time,
                mass: masses.iter().sum(),
                masses,
                momenta,
                external,
                internal: forces(sums),
            },
            scene,
            transfers,
            settings: &self.settings,
            constraints: &mut self.constraints,
            system: &mut self.system,
            internal: &mut self.internal,
            tangents: &mut self.tangents,
            statistics: &mut self.statistics,
            displacement: &mut self.displacement,
            load_step: if predict { self.load_rate * dt } else { 0.0 },
            dt,
            dissipated_before: self.dissipated_before,
            force_scale: self.force_scale,
        })
    }

    /// A step of length `dt` whose end has the loads and motions of its end in time.
    fn prescribed(
        &mut self,
        scene: &mut Scene<D>,
        dt: f64,
        cuts: usize,
    ) -> Result<Equilibrium<D>, Failure> {
        // The extrapolated start may be what fails.
        if self.has_stepped && cuts == 0 {
            let mut trial = self.trial(scene, dt, true)?;
            trial.load_step = dt;
            if let Ok(equilibrium) = balanced(&mut trial) {
                return Ok(equilibrium);
            }
        }
        let mut trial = self.trial(scene, dt, false)?;
        trial.load_step = dt;
        balanced(&mut trial)
    }

    /// A step of length `dt` under the control of the settings, and what it held fixed; `left` is the time to go.
    fn attempt(
        &mut self,
        scene: &mut Scene<D>,
        (dt, left): (f64, f64),
        cuts: usize,
    ) -> Result<(Equilibrium<D>, StepControl), Failure> {
        let share = dt / self.settings.step;
        match self.settings.control {
            LoadControl::ArcLength if self.arc_length > 0.0 => {
                let goal = Goal::Length(share * self.arc_length);
                let followed = follow(&mut self.trial(scene, dt, true)?, goal)?;
                Ok((followed, StepControl::ArcLength))
            }
            LoadControl::Prescribed | LoadControl::ArcLength => {
                let prescribed = self.prescribed(scene, dt, cuts)?;
                Ok((prescribed, StepControl::Prescribed))
            }
            LoadControl::Dissipation { energy } => {
                self.dissipating(scene, (dt, left), cuts, energy)
            }
        }
    }

    /// A step that dissipates its share of `energy`, or a prescribed one that dissipates little enough. What the
    /// last step was is tried first.
    fn dissipating(
        &mut self,
        scene: &mut Scene<D>,
        (dt, left): (f64, f64),
        cuts: usize,
        energy: f64,
    ) -> Result<(Equilibrium<D>, StepControl), Failure> {
        let share = energy * dt / self.settings.step;
        let controlled = self.last_control == StepControl::Dissipation;
        let most = energy * if controlled { LEAST } else { MOST };
        let mut failed = None;
        for turn in 0..2 {
            let found = if controlled == (turn == 0) {
                let goal = Goal::Energy(share);
                let followed = self.trial(scene, dt, self.has_stepped);
                let followed = followed.and_then(|mut trial| follow(&mut trial, goal));
                followed.map(|found| (found, StepControl::Dissipation))
            } else {
                // Beyond the end of a branch, which short steps have approached, a long one gets.
                let beyond = controlled && cuts == 0;
                let length = if beyond {
                    left.min(self.settings.step)
                } else {
                    dt
                };
                let prescribed = self.prescribed(scene, length, cuts);
                let little = |found: &Equilibrium<D>| found.totals.dissipated <= most;
                match prescribed {
                    Ok(found) if little(&found) => Ok((found, StepControl::Prescribed)),
                    Ok(_) => Err(Failure::at(NewtonStop::Control, 0.0)),
                    Err(failed) => Err(failed),
                }
            };
            match found {
                Ok(found) => return Ok(found),
                Err(failure) => failed = failed.or(Some(failure)),
            }
        }
        Err(failed.unwrap_or_else(|| Failure::at(NewtonStop::Control, f64::NAN)))
    }

    /// Makes the trial the present and books the step.
    fn accept(
        &mut self,
        scene: &mut Scene<D>,
        (equilibrium, control): (Equilibrium<D>, StepControl),
    ) -> Result<Report<D>, SolveError> {
        let dt = equilibrium.dt;
        let Self {
            grid,
            placement,
            system,
            displacement,
            ..
        } = self;
        let cracks = carried(scene, grid, placement, |node| {
            system.links.number(node).map(|_| (1.0, displacement[node]))
        })?;
        cracks.accept(scene, placement);
        for body in scene.bodies_mut() {
            body.commit()?;
        }
        self.placement.note_moves(&self.grid, scene);
        self.has_stepped = true;
        self.force_scale = equilibrium.force_scale;
        let load_step = equilibrium.load_step;
        self.load_rate = load_step / dt;
        self.last_control = control;
        self.dissipated_before = equilibrium.totals.dissipated > 0.0;
        if self.arc_length == 0.0 {
            self.arc_length = equilibrium.length * self.settings.step / dt;
        }
        let load_time = scene.load_time() + load_step;
        let mut external = equilibrium.load_work;
        for (condition, now) in scene.conditions().iter().zip(&equilibrium.reactions) {
            if let ConditionKind::Velocity { hold, speed } = condition.kind() {
                let before = scene
                    .reaction(condition.name())
                    .unwrap_or_else(SVector::zeros);
                let way = hold.direction() * (speed.at(load_time) * load_step);
                external += (before + now).dot(&way) * 0.5;
            }
        }
        let report = Report {
            step: scene.step() + 1,
            time: scene.time() + dt,
            dt,
            energy: StepEnergy {
                external,
                internal: equilibrium.internal_work,
                stored: equilibrium.totals.stored,
                dissipated: equilibrium.totals.dissipated,
                stabilisation: equilibrium.stabilising_work,
                ..StepEnergy::default()
            },
            reactions: equilibrium.reactions,
            contact_forces: Vec::new(),
            iterations: equilibrium.iterations,
            solution: Some(Solution {
                load_time,
                load_step,
                control,
                negative_pivots: Some(self.statistics.negative_pivots),
                cuts: self.statistics.cuts,
                stop: NewtonStop::Converged,
            }),
        };
        scene.record(&report);
        self.placement.accept(scene);
        Ok(report)
    }
}

impl<S: Shape<D>, const D: usize> Solver<D> for QuasiStatic<S, D> {
    fn step(&mut self, scene: &mut Scene<D>, until: f64) -> Result<Report<D>, SolveError> {
        check_until(scene, until)?;
        self.prepare(scene)?;
        let left = until - scene.time();
        let mut dt = self.pace.length(left);
        let mut cuts = 0;
        loop {
            self.statistics = StepStatistics {
                cuts,
                ..StepStatistics::default()
            };
            match self.attempt(scene, (dt, left), cuts) {
                Ok(found) => {
                    self.statistics.stop = Some(NewtonStop::Converged);
                    self.pace.accepted(found.0.dt, cuts, self.settings.step);
                    return self.accept(scene, found);
                }
                Err(failed) => {
                    self.statistics.stop = Some(failed.stop);
                    if cuts == self.settings.max_cuts {
                        return Err(failed.into_error(scene, cuts, self.settings.tolerance));
                    }
                }
            }
            cuts += 1;
            dt *= 0.5;
        }
    }

    fn memory(&self) -> Vec<f64> {
        let flag = |flag: bool| f64::from(u8::from(flag));
        vec![
            self.pace.next,
            self.force_scale,
            flag(self.has_stepped),
            self.load_rate,
            self.arc_length,
            flag(self.last_control == StepControl::Dissipation),
            flag(self.dissipated_before),
        ]
    }

    fn recall(&mut self, memory: &[f64]) {
        if let [
            next_step,
            force_scale,
            stepped,
            load_rate,
            arc_length,
            dissipating,
            dissipated,
        ] = *memory
        {
            self.pace.next = next_step;
            self.force_scale = force_scale;
            self.has_stepped = stepped != 0.0;
            self.load_rate = load_rate;
            self.arc_length = arc_length;
            self.last_control = match dissipating {
                0.0 => StepControl::Prescribed,
                _ => StepControl::Dissipation,
            };
            self.dissipated_before = dissipated != 0.0;
            self.recalled = true;
        }
    }
}
