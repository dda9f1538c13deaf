//! One explicit step, phase by phase.

use std::sync::atomic::{AtomicBool, Ordering};

use fissure_grid::{Grid, Shape, tile_of};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::{
    Body, ConditionKind, KernelFailure, Report, Run, RunKernel, Scene, Selection, SolveError,
    Solver, SweepSettings, Viscosity,
};
use fissure_tensor::{Band, Sym};
use nalgebra::SVector;
use rayon::prelude::*;

use super::filter::filter;
use super::grid_update::{self, NodeMotion, velocity};
use super::kernels::StepKernel;
use super::settings::{BandSource, ExplicitSettings, StressUpdate, Transfer};
use crate::constraints::Constraints;
use crate::placement::{Placement, check_columns};
use crate::to_grid::{Gift, Sums, Transfers};

/// Explicit material-point solver on a grid with a shape function.
#[derive(Debug)]
pub struct Explicit<S, const D: usize> {
    grid: Grid<D>,
    shape: S,
    settings: ExplicitSettings,
    placement: Placement<D>,
    constraints: Constraints<D>,
    sums: Sums<D>,
    scratch: Sums<D>,
    nodes: Vec<NodeMotion<D>>,
    /// Fastest wave plus particle, m/s; `None` before the first step and after an edit.
    fastest: Option<f64>,
}

impl<S: Shape<D>, const D: usize> Explicit<S, D> {
    /// A solver with nothing moved yet.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn new(grid: Grid<D>, shape: S, settings: ExplicitSettings) -> Result<Self, SolveError> {
        settings.check()?;
        Ok(Self {
            grid,
            shape,
            settings,
            placement: Placement::default(),
            constraints: Constraints::default(),
            sums: Sums::default(),
            scratch: Sums::default(),
            nodes: Vec::new(),
            fastest: None,
        })
    }

    /// The grid.
    pub fn grid(&self) -> &Grid<D> {
        &self.grid
    }

    /// Where the particles and nodes are.
    pub fn placement(&self) -> &Placement<D> {
        &self.placement
    }

    /// Band of a body's cracks under the settings.
    fn band(&self, body: &Body<D>) -> Band {
        band(&self.shape, &self.grid, self.settings.band, body)
    }

    /// Checks a changed scene once; sorts if a particle left its tile.
    fn prepare(&mut self, scene: &mut Scene<D>) -> Result<(), SolveError> {
        if !self.placement.is_stale(scene) {
            return Ok(());
        }
        check_columns(scene)?;
        for body in scene.bodies() {
            let refused = |source| SolveError::Band {
                body: body.name().to_owned(),
                source,
            };
            body.check_band(&self.band(body)).map_err(refused)?;
        }
        self.placement.update(&self.grid, scene)?;
        if self.fastest.is_none() {
            self.fastest = Some(fastest(scene));
        }
        for body in scene.bodies_mut() {
            if self.settings.transfer == Transfer::Apic {
                body.particles_mut().motion.ensure_affine();
            }
        }
        Ok(())
    }

    /// Length of the next step, s.
    fn step_length(&self, scene: &Scene<D>, until: f64) -> f64 {
        let speed = self.fastest.unwrap_or(0.0);
        let stable = self.settings.cfl * self.grid.spacing() / speed;
        let left = until - scene.time();
        // A last step of almost nothing would divide round-off by itself.
        if left <= stable * (1.0 + 1e-9) {
            left
        } else if left < 2.0 * stable {
            0.5 * left
        } else {
            stable
        }
    }
}

/// Band of a body's cracks on a discretisation.
pub(crate) fn band<S: Shape<D>, const D: usize>(
    shape: &S,
    grid: &Grid<D>,
    source: BandSource,
    body: &Body<D>,
) -> Band {
    match source {
        BandSource::Discretisation => shape.band(grid.spacing()),
        BandSource::Particle => {
            let mut edges = [0.0; 3];
            for (axis, edge) in edges.iter_mut().enumerate().take(D) {
                *edge = 2.0 * body.half_edges().column(axis).norm();
            }
            Band::Section(edges)
        }
    }
}

/// Fastest wave plus fastest particle, m/s.
fn fastest<const D: usize>(scene: &Scene<D>) -> f64 {
    let mut fastest: f64 = 0.0;
    for body in scene.bodies() {
        fastest = fastest.max(body.wave_speed() + fastest_particle(body));
    }
    fastest
}

fn fastest_particle<const D: usize>(body: &Body<D>) -> f64 {
    let velocity = &body.particles().motion.velocity;
    let squares = velocity.iter().map(|v| v.norm_squared());
    squares.fold(0.0, f64::max).sqrt()
}

impl<S: Shape<D>, const D: usize> Solver<D> for Explicit<S, D> {
    fn step(&mut self, scene: &mut Scene<D>, until: f64) -> Result<Report<D>, SolveError> {
        self.prepare(scene)?;
        let dt = self.step_length(scene, until);
        let (step, time) = (scene.step() + 1, scene.time());
        let transfers = Transfers {
            grid: &self.grid,
            shape: &self.shape,
            placement: &self.placement,
            kinematics: scene.kinematics(),
        };
        let off_grid = |scene: &Scene<D>, (body, index): (usize, usize)| {
            let body = &scene.bodies()[body];
            SolveError::Outside {
                body: body.name().to_owned(),
                id: body.particles().id[index],
                position: body.motion().position[index].iter().copied().collect(),
                step,
                time,
            }
        };
        let stress_first = self.settings.stress_update == StressUpdate::First;
        let settings = &self.settings;
        let viscosity = settings.viscosity.map(|(linear, quadratic)| Viscosity {
            linear,
            quadratic,
            length: self.grid.spacing(),
        });
        let moved = AtomicBool::new(false);

        // Held nodes at the velocity they have at the end of the step.
        self.constraints
            .collect(scene, &self.grid, &self.shape, &self.placement, time + dt)?;

        // Particles to nodes; with the stress first, forces wait for the new stress.
        let mut totals = fissure_scene::SweepTotals::default();
        if stress_first {
            transfers
                .to_grid(scene, &mut self.sums, |body, i, _, _| {
                    momentum_gift(body, i, false)
                })
                .map_err(|failed| off_grid(scene, failed))?;
            self.nodes
                .resize(self.sums.nodes.len(), NodeMotion::default());
            for (node, sum) in self.nodes.iter_mut().zip(&self.sums.nodes) {
                node.straining = velocity(sum);
            }
            for held in &self.constraints.held {
                let node = &mut self.nodes[held.node];
                node.straining = held.apply(&node.straining);
            }
            totals = sweep(
                scene,
                &transfers,
                &self.nodes,
                settings,
                viscosity,
                dt,
                false,
                step,
                time,
            )?;
        }
        let time_of_force = time;
        transfers
            .to_grid(scene, &mut self.sums, |body, i, _, _| {
                let mut gift = momentum_gift(body, i, stress_first);
                gift.affine = affine_of(body, i);
                let x = &body.motion().position[i];
                if let Some(acceleration) = scene.body_acceleration(x, time_of_force) {
                    gift.acceleration = acceleration;
                }
                gift.volume_stress = Some(volume_stress(body, i, stress_first));
                gift
            })
            .map_err(|failed| off_grid(scene, failed))?;
        add_point_forces(&transfers, scene, &mut self.sums, time)
            .map_err(|failed| off_grid(scene, failed))?;

        // Nodes.
        let lightest = settings.mass_cutoff * mean_particle_mass(scene);
        let mut report = grid_update::update(
            &self.sums.nodes,
            &mut self.nodes,
            &self.constraints,
            scene,
            lightest,
            dt,
        );

        // Filtered velocities, if the transfer wants them.
        match settings.transfer {
            Transfer::Xpic { order } => filter(
                &transfers,
                scene,
                &mut self.scratch,
                &mut self.nodes,
                order,
                |node| node.start,
                None,
            ),
            Transfer::Fmpm { order } => filter(
                &transfers,
                scene,
                &mut self.scratch,
                &mut self.nodes,
                order,
                |node| node.end,
                Some(&self.constraints),
            ),
            _ => Ok(()),
        }
        .map_err(|failed| off_grid(scene, failed))?;

        // Nodes to particles, and the law.
        match settings.stress_update {
            StressUpdate::Last => {
                for node in &mut self.nodes {
                    node.straining = node.end;
                }
                totals = sweep(
                    scene,
                    &transfers,
                    &self.nodes,
                    settings,
                    viscosity,
                    dt,
                    true,
                    step,
                    time,
                )?;
            }
            StressUpdate::First => {
                move_only(scene, &transfers, &self.nodes, settings, dt, step, time)?;
            }
            StressUpdate::Musl => {
                move_only(scene, &transfers, &self.nodes, settings, dt, step, time)?;
                transfers
                    .to_grid(scene, &mut self.scratch, |body, i, _, _| {
                        let particles = body.particles();
                        Gift {
                            mass: particles.mass[i],
                            velocity: particles.trial.velocity[i],
                            affine: particles.trial.affine.get(i).copied(),
                            volume_stress: None,
                            acceleration: SVector::zeros(),
                        }
                    })
                    .map_err(|failed| off_grid(scene, failed))?;
                for (node, sum) in self.nodes.iter_mut().zip(&self.scratch.nodes) {
                    node.straining = velocity(sum);
                }
                for held in &self.constraints.held {
                    let node = &mut self.nodes[held.node];
                    node.straining = held.apply(&node.straining);
                }
                totals = sweep(
                    scene,
                    &transfers,
                    &self.nodes,
                    settings,
                    viscosity,
                    dt,
                    false,
                    step,
                    time,
                )?;
            }
        }

        // Everything succeeded: the trial becomes the present.
        for body in scene.bodies_mut() {
            body.commit()?;
        }
        left_tile(scene, &self.grid, &self.placement, &moved);
        if moved.load(Ordering::Relaxed) {
            self.placement.invalidate();
        }
        let particle_speed = scene
            .bodies()
            .iter()
            .map(fastest_particle)
            .fold(0.0, f64::max);
        self.fastest = Some(totals.wave_speed + particle_speed);
        report.energy.stored = totals.stored;
        report.energy.dissipated = totals.dissipated;
        report.energy.viscous = totals.viscous;
        report.energy.kinetic_particles = scene.bodies().iter().map(Body::kinetic_energy).sum();
        scene.record(&report);
        Ok(report)
    }

    fn memory(&self) -> Vec<f64> {
        self.fastest.into_iter().collect()
    }

    fn recall(&mut self, memory: &[f64]) {
        self.fastest = memory.first().copied();
    }
}

fn momentum_gift<const D: usize>(body: &Body<D>, i: usize, _trial: bool) -> Gift<D> {
    let particles = body.particles();
    Gift {
        mass: particles.mass[i],
        velocity: particles.motion.velocity[i],
        affine: affine_of(body, i),
        volume_stress: None,
        acceleration: SVector::zeros(),
    }
}

fn affine_of<const D: usize>(body: &Body<D>, i: usize) -> Option<nalgebra::SMatrix<f64, D, D>> {
    body.motion().affine.get(i).copied()
}

/// Current volume times Cauchy stress, J, of the present or the trial motion.
fn volume_stress<const D: usize>(body: &Body<D>, i: usize, trial: bool) -> Sym {
    let particles = body.particles();
    let motion = if trial {
        &particles.trial
    } else {
        &particles.motion
    };
    motion.stress[i] * (particles.volume[i] * motion.deformation_gradient[i].determinant())
}

fn mean_particle_mass<const D: usize>(scene: &Scene<D>) -> f64 {
    let mass: f64 = scene
        .bodies()
        .iter()
        .map(|body| body.particles().mass.iter().sum::<f64>())
        .sum();
    mass / scene.particle_count() as f64
}

/// Loads of the conditions, N, on the nodes that their particles reach.
fn add_point_forces<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
    sums: &mut Sums<D>,
    time: f64,
) -> Result<(), (usize, usize)> {
    use fissure_grid::Stencil;
    for (index, condition) in scene.conditions().iter().enumerate() {
        let (ConditionKind::Force(force), Selection::Body { body, .. }) =
            (condition.kind(), condition.selection())
        else {
            continue;
        };
        let (body_index, body) = (*body, &scene.bodies()[*body]);
        let rows = transfers.placement.selected(index);
        let volume = &body.particles().volume;
        let total: f64 = rows.iter().map(|&row| volume[row as usize]).sum();
        let force = force(time);
        for &row in rows {
            let row = row as usize;
            let x = &body.motion().position[row];
            let cell = transfers.grid.cell(x).ok_or((body_index, row))?;
            let tile = transfers
                .placement
                .tiles
                .find(tile_of(cell))
                .ok_or((body_index, row))?;
            let coordinates = transfers.placement.tiles.coordinates(tile);
            let stencil = transfers
                .stencil(body, coordinates, row)
                .ok_or((body_index, row))?;
            let lookup = crate::to_grid::NodeLookup::new(&transfers.placement.tiles, tile);
            let share = force * (volume[row] / total);
            stencil.visit_values(|entry, weight| {
                sums.nodes[lookup.node(entry)].external_force += share * weight;
            });
        }
    }
    Ok(())
}

/// Sweeps every body: deformation gradients from the nodes (and the motion, if `moves`), then the
/// law.
#[allow(clippy::too_many_arguments)] // A phase reads the whole step.
fn sweep<S: Shape<D>, const D: usize>(
    scene: &mut Scene<D>,
    transfers: &Transfers<'_, S, D>,
    nodes: &[NodeMotion<D>],
    settings: &ExplicitSettings,
    viscosity: Option<Viscosity>,
    dt: f64,
    moves: bool,
    step: u64,
    time: f64,
) -> Result<fissure_scene::SweepTotals, SolveError> {
    let mut totals = fissure_scene::SweepTotals::default();
    for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
        let kernel = StepKernel {
            transfers,
            nodes,
            half_edges: *body.half_edges(),
            transfer: settings.transfer,
            affine_inverse: transfers.shape.affine_inverse(transfers.grid.spacing()),
            dt,
            moves,
            strains: true,
        };
        let sweep = SweepSettings {
            dt,
            band: band(transfers.shape, transfers.grid, settings.band, body),
            viscosity,
        };
        let runs = &transfers.placement.runs[index];
        let part = body
            .sweep(runs, &kernel, &sweep)
            .map_err(|failure| failure.at(body, step, time))?;
        totals = totals.merge(part);
    }
    Ok(totals)
}

/// Moves the particles of every body without calling the law.
fn move_only<S: Shape<D>, const D: usize>(
    scene: &mut Scene<D>,
    transfers: &Transfers<'_, S, D>,
    nodes: &[NodeMotion<D>],
    settings: &ExplicitSettings,
    dt: f64,
    step: u64,
    time: f64,
) -> Result<(), SolveError> {
    for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
        let kernel = StepKernel {
            transfers,
            nodes,
            half_edges: *body.half_edges(),
            transfer: settings.transfer,
            affine_inverse: transfers.shape.affine_inverse(transfers.grid.spacing()),
            dt,
            moves: true,
            strains: false,
        };
        let particles = body.particles_mut();
        particles.make_trial();
        let runs = &transfers.placement.runs[index];
        let moved = move_runs(
            runs,
            &kernel,
            particles.motion.slices(),
            particles.trial.slices_mut(),
        );
        if let Err(index) = moved {
            return Err(SolveError::Outside {
                body: body.name().to_owned(),
                id: body.particles().id[index],
                position: body.motion().position[index].iter().copied().collect(),
                step,
                time,
            });
        }
    }
    Ok(())
}

/// Halves the runs until one is left; the error is the index of a particle off the grid, the
/// first in the order of the runs.
fn move_runs<const D: usize>(
    runs: &[Run],
    kernel: &dyn RunKernel<D>,
    old: MotionSlices<'_, D>,
    mut new: MotionSlicesMut<'_, D>,
) -> Result<(), usize> {
    match runs {
        [] => Ok(()),
        [run] => kernel
            .gather(run, &old, &mut new)
            .map_err(|KernelFailure { row }| run.start as usize + row),
        _ => {
            let (left, right) = runs.split_at(runs.len() / 2);
            let row = (right[0].start - left[0].start) as usize;
            let ((old_a, old_b), (new_a, new_b)) = (old.split_at(row), new.split_at(row));
            let (a, b) = rayon::join(
                || move_runs(left, kernel, old_a, new_a),
                || move_runs(right, kernel, old_b, new_b),
            );
            a.and(b)
        }
    }
}

/// Notes whether any particle has left the tile of its run.
fn left_tile<const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<D>,
    placement: &Placement<D>,
    moved: &AtomicBool,
) {
    for (body, runs) in scene.bodies().iter().zip(&placement.runs) {
        let position = &body.particles().motion.position;
        runs.par_iter().with_min_len(16).for_each(|run| {
            let home = placement.tiles.coordinates(run.tile as usize);
            let particles = &position[run.start as usize..run.end as usize];
            let stays = |x: &SVector<f64, D>| grid.cell(x).map(tile_of) == Some(home);
            if !particles.iter().all(stays) {
                moved.store(true, Ordering::Relaxed);
            }
        });
    }
}
