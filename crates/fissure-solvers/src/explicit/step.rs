//! One explicit step, phase by phase.

use fissure_grid::{Grid, Shape};
use fissure_scene::{Body, Report, Scene, SolveError, Solver, StepEnergy, SweepTotals, Viscosity};

use super::grid_update::{self, NodeMotion};
use super::phases::Phases;
use super::settings::{ExplicitSettings, StressUpdate, Transfer};
use crate::constraints::Constraints;
use crate::placement::{Placement, check_columns, check_until};
use crate::to_grid::{Sums, Transfers};

/// Share of the mean particle mass below which a node holds round-off and feels no force.
const NO_MASS: f64 = 1e-16;

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
    /// Fastest wave plus fastest particle, m/s; `None` before the first step.
    fastest: Option<f64>,
    /// Whether `fastest` was recalled from a checkpoint and the scene restored after.
    recalled: bool,
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
            recalled: false,
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

    /// Sorts if a particle left its tile; checks a scene that its user changed.
    fn prepare(&mut self, scene: &mut Scene<D>) -> Result<(), SolveError> {
        if self.placement.is_current(scene) {
            return Ok(());
        }
        if self.placement.is_edited(scene) {
            if !std::mem::take(&mut self.recalled) {
                self.fastest = None;
            }
            check_columns(scene)?;
            self.settings.band.check(&self.shape, &self.grid, scene)?;
            if self.settings.transfer == Transfer::Apic {
                for body in scene.bodies_mut() {
                    body.particles_mut().motion.ensure_affine();
                }
            }
        }
        self.placement.update(&self.grid, scene)?;
        if self.fastest.is_none() {
            let waves = scene.bodies().iter().map(Body::wave_speed);
            self.fastest = Some(waves.fold(0.0, f64::max) + fastest_particle(scene));
        }
        Ok(())
    }

    /// Length of the next step, s: the stable one, shared out so that the last before `until` is
    /// no sliver.
    fn step_length(&self, scene: &Scene<D>, until: f64) -> f64 {
        let speed = self.fastest.unwrap_or(0.0);
        let stable = self.settings.cfl * self.grid.spacing() / speed;
        let left = until - scene.time();
        if left <= stable * (1.0 + 1e-9) {
            left
        } else if left < 2.0 * stable {
            0.5 * left
        } else {
            stable
        }
    }
}

fn fastest_particle<const D: usize>(scene: &Scene<D>) -> f64 {
    let velocities = scene.bodies().iter().map(|body| body.motion().velocity);
    let squares = velocities.flatten().map(|v| v.norm_squared());
    squares.fold(0.0, f64::max).sqrt()
}

impl<S: Shape<D>, const D: usize> Solver<D> for Explicit<S, D> {
    fn step(&mut self, scene: &mut Scene<D>, until: f64) -> Result<Report<D>, SolveError> {
        check_until(scene, until)?;
        self.prepare(scene)?;
        let dt = self.step_length(scene, until);
        let Self {
            grid,
            shape,
            settings,
            placement,
            constraints,
            sums,
            scratch,
            nodes,
            ..
        } = self;
        // Nodes are held at the velocities of the end of the step.
        let end = scene.time() + dt;
        constraints.collect(scene, grid, shape, placement, end)?;
        let phases = Phases {
            transfers: Transfers {
                grid,
                shape,
                placement,
                kinematics: scene.kinematics(),
            },
            constraints,
            settings,
            viscosity: settings.viscosity.map(|(linear, quadratic)| Viscosity {
                linear,
                quadratic,
                length: grid.spacing(),
            }),
            dt,
            step: scene.step() + 1,
            time: scene.time(),
        };

        let mut totals = SweepTotals::default();
        let stress_first = settings.stress_update == StressUpdate::First;
        if stress_first {
            phases.strain_by_particle_velocities(scene, scratch, nodes, false)?;
            totals = phases.sweep(scene, nodes, false)?;
        }
        phases.to_grid(scene, sums, stress_first)?;
        let mut report = grid_update::update(
            &sums.nodes,
            nodes,
            constraints,
            scene,
            settings.mass_cutoff.max(NO_MASS) * mean_particle_mass(scene),
            dt,
        );
        phases.filter(scene, scratch, nodes, &mut report.reactions)?;
        match settings.stress_update {
            StressUpdate::First => phases.move_particles(scene, nodes)?,
            StressUpdate::Last => {
                nodes.iter_mut().for_each(|node| node.straining = node.end);
                totals = phases.sweep(scene, nodes, true)?;
            }
            StressUpdate::Musl => {
                phases.move_particles(scene, nodes)?;
                phases.strain_by_particle_velocities(scene, scratch, nodes, true)?;
                totals = phases.sweep(scene, nodes, false)?;
            }
        }

        // Everything succeeded: the trial becomes the present.
        for body in scene.bodies_mut() {
            body.commit()?;
        }
        placement.note_moves(grid, scene);
        self.fastest = Some(totals.wave_speed + fastest_particle(scene));
        report.energy = StepEnergy {
            stored: totals.stored,
            dissipated: totals.dissipated,
            viscous: totals.viscous,
            kinetic_particles: scene.bodies().iter().map(Body::kinetic_energy).sum(),
            ..report.energy
        };
        scene.record(&report);
        Ok(report)
    }

    fn memory(&self) -> Vec<f64> {
        self.fastest.into_iter().collect()
    }

    fn recall(&mut self, memory: &[f64]) {
        self.fastest = memory.first().copied();
        self.recalled = self.fastest.is_some();
    }
}

fn mean_particle_mass<const D: usize>(scene: &Scene<D>) -> f64 {
    let bodies = scene.bodies().iter();
    let mass: f64 = bodies
        .map(|body| body.particles().mass.iter().sum::<f64>())
        .sum();
    mass / scene.particle_count() as f64
}
