//! One load step: Newton's method, cut and retried until it converges.

use fissure_grid::{Grid, Shape, simd::Simd};
use fissure_materials::Tangent;
use fissure_scene::{ConditionKind, Report, Scene, SolveError, Solver, StepEnergy, SweepTotals};
use nalgebra::SVector;

use super::faces::Faces;
use super::settings::QuasiStaticSettings;
use crate::checks::{check_columns, check_until, outside};
use crate::constraints::Constraints;
use crate::crack_motion::{carried, refine};
use crate::equilibrium::balance::{
    At, external_forces, forces, internal_forces, momenta, reactions, strain, unbalanced, work,
};
use crate::equilibrium::pace::Pace;
use crate::equilibrium::system::{Jacobian, System};
use crate::linear::BlockMatrix;
use crate::nodes::NodeSums;
use crate::placement::Placement;
use crate::release::Release;
use crate::transfers::Transfers;

/// Quasi-static material-point solver on a grid with a shape function.
pub struct QuasiStatic<S, const D: usize> {
    grid: Grid<D>,
    shape: S,
    settings: QuasiStaticSettings,
    placement: Placement<D>,
    constraints: Constraints<D>,
    system: System<D>,
    faces: Faces<D>,
    release: Release<D>,
    internal: NodeSums<D>,
    displacement: Vec<SVector<f64, D>>,
    tangents: Vec<Vec<Tangent>>,
    pace: Pace,
    /// Largest reaction so far, N: what residuals are measured by.
    force_scale: f64,
    /// Nodal displacements of the last step were mapped to the particles' velocities.
    has_stepped: bool,
    /// Whether the memory was recalled from a checkpoint and the scene restored after.
    recalled: bool,
}

/// Added to the diagonal of the system, which is scaled to 1. Motions that nothing resists (a
/// fragment that has broken off, a bar on rollers) then stay where they are instead of making the
/// matrix singular. The residual is not touched, so equilibrium is exact all the same.
const LEAST_DAMPING: f64 = 1e-10;
/// What that may grow to in a step whose residual rises.
const MOST_DAMPING: f64 = 1e-1;

/// Why an attempt at a step did not end in equilibrium.
enum Failed {
    /// Residual over its scale after the last iteration.
    Residual(f64),
    /// A law or the grid refused; a shorter step may do.
    Refused(SolveError),
    /// No solution of the linear system.
    Singular,
}

/// A step in equilibrium, not yet committed.
struct Equilibrium<const D: usize> {
    totals: SweepTotals,
    reactions: Vec<SVector<f64, D>>,
    iterations: usize,
    load_work: f64,
    internal_work: f64,
    contact_work: f64,
    force_scale: f64,
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
            internal: NodeSums::default(),
            displacement: Vec::new(),
            tangents: Vec::new(),
            pace: Pace {
                next: settings.step,
            },
            force_scale: 0.0,
            has_stepped: false,
            recalled: false,
        })
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
        self.system.springs.clear();
        self.tangents.resize(scene.bodies().len(), Vec::new());
        let (band, dt) = (self.settings.band, self.settings.step);
        strain(
            scene,
            &transfers,
            &still,
            band,
            dt,
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
                self.pace.next = self.settings.step;
            }
            check_columns(scene)?;
            if !scene.contacts().is_empty() {
                return Err(SolveError::Unsupported {
                    what: "contact between bodies in a quasi-static step",
                });
            }
            self.settings.band.check(&self.shape, &self.grid, scene)?;
        }
        self.placement.update(&self.grid, scene)
    }

    /// Tries a step of length `dt`; the trial motion of the scene holds its end.
    fn attempt(
        &mut self,
        scene: &mut Scene<D>,
        dt: f64,
        predict: bool,
    ) -> Result<Equilibrium<D>, Failed> {
        let Self {
            grid,
            shape,
            settings,
            placement,
            constraints,
            system,
            faces,
            release,
            internal,
            displacement,
            tangents,
            force_scale,
            ..
        } = self;
        let end = scene.time() + dt;
        let transfers = Transfers {
            grid,
            shape,
            placement,
            kinematics: scene.kinematics(),
            simd: Simd::widest(),
        };
        let off_grid = |scene: &Scene<D>, (body, index): (usize, usize)| {
            Failed::Refused(outside(scene, body, index))
        };
        constraints
            .collect(scene, grid, shape, placement, end)
            .map_err(Failed::Refused)?;
        release.look(scene);
        faces.find(&transfers, scene, release);
        system.links.joined = faces.joined();
        system
            .find(&transfers, scene, constraints)
            .map_err(|failed| off_grid(scene, failed))?;
        // The sums hold the internal forces afterwards.
        momenta(&transfers, scene, internal).map_err(|failed| off_grid(scene, failed))?;
        let external_at = |time| {
            external_forces(&transfers, scene, internal, time)
                .map_err(|failed| off_grid(scene, failed))
        };
        let before_loads = external_at(scene.time())?;
        let external = external_at(end)?;

        displacement.clear();
        displacement.extend((0..internal.len()).map(|node| match predict {
            true => internal.velocity(node) * dt,
            false => SVector::zeros(),
        }));
        internal_forces(&transfers, scene, internal, At::Start)
            .map_err(|failed| off_grid(scene, failed))?;
        let before_stresses = forces(internal);
        let mut held = vec![SVector::zeros(); displacement.len()];
        for node in &constraints.held {
            let present = displacement[node.node] / dt;
            held[node.node] = (node.apply(&present) - present) * dt;
        }

        tangents.resize(scene.bodies().len(), Vec::new());
        let mut before: Vec<SVector<f64, D>> = Vec::new();
        let (mut error, mut last) = (f64::INFINITY, f64::INFINITY);
        let mut damping = LEAST_DAMPING;
        for iteration in 0..=settings.max_iterations {
            let totals = strain(
                scene,
                &transfers,
                displacement,
                settings.band,
                dt,
                Some(tangents),
            )
            .map_err(Failed::Refused)?;
            internal_forces(&transfers, scene, internal, At::End)
                .map_err(|failed| off_grid(scene, failed))?;
            let stresses = forces(internal);
            faces.add(&system.links, displacement, internal, &mut system.springs);
            let unbalanced = unbalanced(&system.links, &system.freedoms, internal, &external);
            // Of this state and of the steps accepted before, not of iterates that were left.
            let scale = force_scale.max(unbalanced.scale);
            error = unbalanced.residual / if scale > 0.0 { scale } else { 1.0 };
            if !scale.is_finite() {
                error = f64::INFINITY;
            }
            let placed = iteration > 0 || held.iter().all(|change| change.amax() == 0.0);
            if placed && error <= settings.tolerance {
                return Ok(Equilibrium {
                    totals,
                    reactions: reactions(scene, constraints, internal, &external),
                    iterations: iteration,
                    load_work: work(&before_loads, &external, displacement),
                    internal_work: -work(&before_stresses, &stresses, displacement),
                    contact_work: faces.work(displacement),
                    force_scale: scale,
                });
            }
            if iteration == settings.max_iterations || !error.is_finite() {
                break;
            }
            // Where a crack is open the tangent is next to nothing, and a full step runs far into
            // the other side: go back and stiffen the system, as Levenberg and Marquardt do.
            if error > last && damping < MOST_DAMPING && !faces.changed {
                damping = (damping * 1e2).clamp(1e-6, MOST_DAMPING);
                displacement.clone_from(&before);
                continue;
            }
            if error < last {
                damping = (damping * 0.1).max(LEAST_DAMPING);
            }
            last = if placed { error } else { f64::INFINITY };
            before.clone_from(displacement);
            let force = unbalanced.force;
            let jacobian = Jacobian::STATIC;
            let correction = system
                .correct(scene, &transfers, tangents, jacobian, force, &held, damping)
                .map_err(|_| Failed::Singular)?;
            system.links.add(&correction, 1.0, displacement);
            for (u, change) in displacement.iter_mut().zip(&mut held) {
                *u += *change;
                *change = SVector::zeros();
            }
        }
        Err(Failed::Residual(error))
    }

    /// Makes the trial the present and books the step.
    fn accept(
        &mut self,
        scene: &mut Scene<D>,
        dt: f64,
        equilibrium: Equilibrium<D>,
    ) -> Result<Report<D>, SolveError> {
        let Self {
            grid,
            placement,
            system,
            displacement,
            ..
        } = self;
        self.release.keep(grid, self.faces.tied(displacement));
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
        let end = scene.time() + dt;
        let mut external = equilibrium.load_work;
        for (condition, now) in scene.conditions().iter().zip(&equilibrium.reactions) {
            if let ConditionKind::Velocity { hold, speed } = condition.kind() {
                let before = scene
                    .reaction(condition.name())
                    .unwrap_or_else(SVector::zeros);
                let way = hold.direction() * (speed.at(end) * dt);
                external += (before + now).dot(&way) * 0.5;
            }
        }
        let report = Report {
            step: scene.step() + 1,
            time: end,
            dt,
            energy: StepEnergy {
                external,
                internal: equilibrium.internal_work,
                stored: equilibrium.totals.stored,
                dissipated: equilibrium.totals.dissipated,
                contact: equilibrium.contact_work,
                ..StepEnergy::default()
            },
            reactions: equilibrium.reactions,
            contact_forces: Vec::new(),
            iterations: equilibrium.iterations,
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
        let (mut cuts, mut predict) = (0, self.has_stepped);
        loop {
            let failed = match self.attempt(scene, dt, predict) {
                Ok(equilibrium) => {
                    self.pace.accepted(dt, cuts, self.settings.step);
                    return self.accept(scene, dt, equilibrium);
                }
                Err(failed) => failed,
            };
            if predict {
                // The extrapolated start may be what failed.
                predict = false;
                continue;
            }
            cuts += 1;
            if cuts > self.settings.max_cuts {
                let (step, time) = (scene.step() + 1, scene.time());
                return Err(match failed {
                    Failed::Refused(error) => error,
                    Failed::Singular => SolveError::Singular { step, time },
                    Failed::Residual(residual) => SolveError::NoConvergence {
                        step,
                        time,
                        cuts: cuts - 1,
                        residual,
                        tolerance: self.settings.tolerance,
                    },
                });
            }
            dt *= 0.5;
        }
    }

    fn memory(&self) -> Vec<f64> {
        let stepped = f64::from(u8::from(self.has_stepped));
        let mut memory = vec![self.pace.next, self.force_scale, stepped];
        memory.extend(self.release.memory());
        memory
    }

    fn recall(&mut self, memory: &[f64]) {
        if let [next_step, force_scale, stepped, ref rest @ ..] = *memory {
            self.release.recall(rest);
            self.pace.next = next_step;
            self.force_scale = force_scale;
            self.has_stepped = stepped != 0.0;
            self.recalled = true;
        }
    }
}
