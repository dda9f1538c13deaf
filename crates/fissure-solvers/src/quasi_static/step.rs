//! One load step: cut and retried until it converges, then booked.

use fissure_grid::{Grid, Shape, simd::Simd};
use fissure_materials::Tangent;
use fissure_scene::{
    ConditionKind, Kinematics, NewtonStop, Report, Scene, Solution, SolveError, Solver,
    StepControl, StepEnergy,
};
use nalgebra::SVector;

use super::embedded::Embedded;
use super::embedded_crack::{EmbeddedCrack, EmbeddedJump};
use super::faces::Faces;
use super::settings::{Averaging, QuasiStaticSettings};
use super::trial::Equilibrium;
use crate::checks::{check_columns, check_mesh, check_until, outside};
use crate::constraints::Constraints;
use crate::crack_motion::{NodeWay, carried, refine};
use crate::equilibrium::balance::strain;
use crate::equilibrium::one_strain::Deviations;
use crate::equilibrium::pace::Pace;
use crate::equilibrium::statistics::StepStatistics;
use crate::equilibrium::system::System;
use crate::linear::BlockMatrix;
use crate::nodes::NodeSums;
use crate::placement::Placement;
use crate::release::Release;
use crate::transfers::Transfers;

/// Quasi-static material-point solver on a grid with a shape function.
pub struct QuasiStatic<S, const D: usize> {
    pub(super) grid: Grid<D>,
    pub(super) shape: S,
    pub(super) settings: QuasiStaticSettings,
    pub(super) placement: Placement<D>,
    pub(super) constraints: Constraints<D>,
    pub(super) system: System<D>,
    pub(super) faces: Faces<D>,
    pub(super) release: Release<D>,
    pub(super) embedded: Option<Embedded<D>>,
    pub(super) deviations: Deviations<D>,
    pub(super) internal: NodeSums<D>,
    pub(super) displacement: Vec<SVector<f64, D>>,
    pub(super) tangents: Vec<Vec<Tangent>>,
    pub(super) pace: Pace,
    /// Largest reaction so far, N: what residuals are measured by.
    pub(super) force_scale: f64,
    /// Nodal displacements of the last step were mapped to the particles' velocities.
    pub(super) has_stepped: bool,
    /// Change of load time over the length of the last step.
    pub(super) load_rate: f64,
    /// Arc length of a step of full length, m; 0 before the first step.
    pub(super) arc_length: f64,
    /// What the last step held fixed.
    pub(super) last_control: StepControl,
    /// Whether it dissipated energy.
    pub(super) dissipated_before: bool,
    /// Whether the memory was recalled from a checkpoint and the scene restored after.
    pub(super) recalled: bool,
    pub(super) statistics: StepStatistics,
}

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
            faces: Faces::default(),
            release: Release::default(),
            embedded: None,
            deviations: Deviations::default(),
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

    /// Negative pivots of the last tangent factorised, its damping included: 0 on a stable branch. Of a symmetric tangent each
    /// stands for a direction in which equilibrium is not stable; of one that is not those of the symmetric part are counted,
    /// of which 0 means a stable branch too but one does not mean an unstable one. `None` where no such factor was found, and before the
    /// first.
    pub fn negative_pivots(&self) -> Option<usize> {
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
        self.system.springs.clear();
        self.tangents.resize(scene.bodies().len(), Vec::new());
        let (band, dt) = (self.settings.band, self.settings.step);
        self.system.further.clear();
        let links = &mut self.system.links;
        links.average_as(
            self.settings.averaging,
            scene,
            &self.deviations,
            still.len(),
        );
        links.increase(scene, &still);
        strain(
            scene,
            &transfers,
            &still,
            band,
            dt,
            links,
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
                refine(scene, &self.grid, &self.placement);
                (self.force_scale, self.has_stepped) = (0.0, false);
                self.arc_length = 0.0;
                self.last_control = StepControl::Prescribed;
                self.dissipated_before = false;
                self.pace.next = self.settings.step;
            }
            check_columns(scene)?;
            check_mesh(&self.grid, &self.shape, scene)?;
            if !scene.contacts().is_empty() {
                return Err(SolveError::Unsupported {
                    what: "contact between bodies in a quasi-static step",
                });
            }
            self.check_kinematics(scene)?;
            self.settings.band.check(&self.shape, &self.grid, scene)?;
        }
        self.placement.update(&self.grid, &self.shape, scene)
    }

    fn check_kinematics(&self, scene: &Scene<D>) -> Result<(), SolveError> {
        let refuse = |what| Err(SolveError::Unsupported { what });
        let kinematics = scene.kinematics();
        // In plane stress the thickness follows the stress.
        let whole = !matches!(kinematics, Kinematics::PlaneStress { .. });
        let axial = kinematics == Kinematics::Axisymmetric;
        match self.settings.averaging {
            Averaging::Volume if !whole => refuse("averaging volume changes in plane stress"),
            Averaging::Strain { .. } if axial => refuse("averaging strains in axisymmetry"),
            _ if self.embedded.is_none() => Ok(()),
            _ if axial => refuse("an embedded crack in axisymmetry"),
            _ if !scene.cracks().is_empty() => {
                refuse("an embedded crack beside cracks of the scene")
            }
            Averaging::None => Ok(()),
            _ => refuse("an embedded crack with averages over cells"),
        }
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
        self.release.keep(grid, self.faces.tied(displacement));
        self.deviations.keep(&system.links, scene, displacement);
        if let Some(embedded) = &mut self.embedded {
            embedded.keep();
        }
        let cracks = carried(scene, grid, placement, |node| {
            system
                .links
                .number(node)
                .map(|_| NodeWay::of(displacement[node]))
        })?;
        let mut glued = self.faces.glued(displacement);
        cracks.accept(scene, placement);
        glued.keep(scene);
        for body in scene.bodies_mut() {
            body.commit()?;
        }
        self.placement.note_moves(&self.grid, &self.shape, scene);
        self.has_stepped = true;
        self.force_scale = equilibrium.force_scale;
        let load_step = equilibrium.load_step;
        self.load_rate = load_step / dt;
        self.last_control = control;
        self.dissipated_before = equilibrium.totals.dissipated + glued.dissipated > 0.0;
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
                internal: equilibrium.internal_work + glued.work,
                stored: equilibrium.totals.stored + glued.stored,
                dissipated: equilibrium.totals.dissipated + glued.dissipated,
                contact: equilibrium.contact_work,
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
                negative_pivots: self.statistics.negative_pivots,
                cuts: self.statistics.cuts,
                stop: NewtonStop::Converged,
            }),
        };
        scene.record(&report);
        self.placement.accept(scene);
        Ok(report)
    }
}

impl QuasiStatic<fissure_grid::shape::Linear, 2> {
    /// The solver with a crack within the cells that a line crosses; in the plane, and without cracks of the scene.
    ///
    /// # Errors
    /// A normal that is zero or not finite, a law outside its range.
    pub fn with_embedded(mut self, crack: EmbeddedCrack) -> Result<Self, SolveError> {
        self.embedded = Some(Embedded::new(crack)?);
        Ok(self)
    }

    /// The embedded crack, cell by cell; nothing without one.
    pub fn embedded_jumps(&self) -> Vec<EmbeddedJump> {
        let embedded = self.embedded.iter();
        embedded
            .flat_map(|embedded| embedded.jumps(&self.grid))
            .collect()
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
        let mut memory = vec![
            self.pace.next,
            self.force_scale,
            flag(self.has_stepped),
            self.load_rate,
            self.arc_length,
            flag(self.last_control == StepControl::Dissipation),
            flag(self.dissipated_before),
        ];
        memory.extend(self.release.memory());
        memory.extend(self.deviations.memory());
        memory.extend(self.embedded.iter().flat_map(Embedded::memory));
        memory
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
            ref rest @ ..,
        ] = *memory
        {
            let rest = self.release.recall(rest);
            let rest = self.deviations.recall(rest);
            if let Some(embedded) = &mut self.embedded {
                embedded.recall(rest);
            }
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
