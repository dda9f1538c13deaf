//! One explicit step, phase by phase.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use fissure_grid::{Grid, Shape};
use fissure_scene::{Body, Report, Scene, SolveError, Solver, StepEnergy, SweepTotals};
use rayon::prelude::*;

use super::booking::Booking;
use super::contact::{Gap, Meetings};
use super::grid_update::Nodes;
use super::kernels::Giving;
use super::phases::{Pass, Phases, mean_particle_mass, to_grid};
use super::settings::{ExplicitSettings, StressUpdate};
use crate::checks::{check_columns, check_mesh, check_until};
use crate::constraints::Constraints;
use crate::crack_motion::{NodeWay, carried, refine};
use crate::nodes::{Field, MASSIVE, NodeSums, vector};
use crate::placement::Placement;
use crate::release::Release;
use crate::transfers::Transfers;

/// Share of the mean particle mass at which a node counts half for the faces of cracks: force over mass, and with it the
/// velocity of a node, knows no bound where only the rim of a particle reaches it.
const LIGHT: f64 = 0.01;

/// Explicit material-point solver on a grid with a shape function.
#[derive(Debug)]
pub struct Explicit<S, const D: usize> {
    grid: Grid<D>,
    shape: S,
    settings: ExplicitSettings,
    placement: Placement<D>,
    constraints: Constraints<D>,
    sums: NodeSums<D>,
    /// Whether the last step left the particles' sums at the nodes.
    summed: bool,
    /// Whether a particle has left its tile's window.
    strayed: AtomicBool,
    nodes: Nodes,
    meetings: Meetings<D>,
    release: Release<D>,
    /// kg; found when the scene was edited.
    mean_particle_mass: f64,
    /// Fastest wave plus fastest particle, m/s; `None` before the first step.
    fastest: Option<f64>,
    /// Whether `fastest` was recalled from a checkpoint and the scene restored after.
    recalled: bool,
    /// Length of the step before, s.
    dt: f64,
}

impl<S: Shape<D>, const D: usize> Explicit<S, D> {
    /// A solver with nothing moved yet.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn new(grid: Grid<D>, shape: S, settings: ExplicitSettings) -> Result<Self, SolveError> {
        settings.check::<S, D>()?;
        Ok(Self {
            grid,
            shape,
            settings,
            placement: Placement::default(),
            constraints: Constraints::default(),
            sums: NodeSums::default(),
            summed: false,
            strayed: AtomicBool::new(false),
            nodes: Nodes::default(),
            meetings: Meetings::default(),
            release: Release::default(),
            mean_particle_mass: 0.0,
            fastest: None,
            recalled: false,
            dt: 0.0,
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
        let strayed = std::mem::take(self.strayed.get_mut());
        let sorts_anew = strayed || self.placement.cracks_have_moved(&self.grid);
        if !sorts_anew && !self.placement.is_edited(scene) {
            return Ok(());
        }
        self.summed = false;
        if self.placement.is_edited(scene) {
            if !std::mem::take(&mut self.recalled) {
                refine(scene, &self.grid, &self.placement);
                self.fastest = None;
            }
            check_columns(scene)?;
            check_mesh(&self.grid, &self.shape, scene)?;
            self.mean_particle_mass = mean_particle_mass(scene);
            self.settings.band.check(&self.shape, &self.grid, scene)?;
            if self.settings.transfer.is_affine() {
                for body in scene.bodies_mut() {
                    body.particles_mut().motion.ensure_affine();
                }
            }
        }
        self.placement.update(&self.grid, &self.shape, scene)?;
        if self.fastest.is_none() {
            let waves = scene.bodies().iter().map(Body::wave_speed);
            let (_, fastest) = kinetic_energy_and_speed(scene);
            self.fastest = Some(waves.fold(0.0, f64::max) + fastest);
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

/// Particles whose energies a thread sums at a time.
const CHUNK: usize = 4096;

/// Kinetic energy of the particles, J, and the speed of the fastest, m/s.
fn kinetic_energy_and_speed<const D: usize>(scene: &Scene<D>) -> (f64, f64) {
    let (mut kinetic, mut square): (f64, f64) = (0.0, 0.0);
    for body in scene.bodies() {
        let (mass, velocity) = (&body.particles().mass, body.motion().velocity);
        let chunks = mass.par_chunks(CHUNK).zip(velocity.par_chunks(CHUNK));
        let parts: Vec<(f64, f64)> = chunks
            .map(|(mass, velocity)| {
                let squares = velocity.iter().map(|v| v.norm_squared());
                let add = |(energy, most): (f64, f64), (m, v): (&f64, f64)| {
                    (energy + 0.5 * m * v, most.max(v))
                };
                mass.iter().zip(squares).fold((0.0, 0.0), add)
            })
            .collect();
        for (energy, most) in parts {
            kinetic += energy;
            square = square.max(most);
        }
    }
    (kinetic, square.sqrt())
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
            nodes,
            strayed,
            meetings,
            release,
            mean_particle_mass,
            ..
        } = self;
        // Nodes are held at the velocities of the end of the step.
        let end = scene.time() + dt;
        constraints.collect(scene, grid, shape, placement, end)?;
        let transfers = Transfers {
            grid,
            shape,
            placement,
            kinematics: scene.kinematics(),
            simd: settings.simd,
        };
        // Two bodies that run into each other at the fastest speed.
        let margin = 2.0 * settings.cfl * grid.spacing();
        release.look(scene);
        meetings.find(&transfers, scene, release, margin)?;
        let phases = Phases {
            transfers,
            meetings,
            constraints,
            settings,
            dt,
            step: scene.step() + 1,
            time: scene.time(),
            strayed,
            mean_particle_mass: *mean_particle_mass,
        };
        let goes_on = std::mem::take(&mut self.summed);
        if !goes_on {
            to_grid(&phases.transfers, settings, scene, sums)?;
        }
        std::mem::swap(&mut nodes.before, &mut nodes.end);
        phases.meetings.bond(sums);

        let mut totals = SweepTotals::default();
        let stress_update = settings.stress_update;
        if stress_update == StressUpdate::First {
            phases.straining(sums, &mut nodes.straining, Gap::Start);
            let pass = Pass {
                field: &nodes.straining,
                carried: None,
                moves: false,
                strains: true,
                giving: Giving::AllBack,
            };
            totals = phases.sweep(scene, sums, pass)?;
            phases.meetings.bond(sums);
        }
        let mut report = phases.move_nodes(scene, sums, nodes)?;
        let mut booking = Booking::accelerated(stress_update, sums, nodes, &totals, dt);
        phases.filter(scene, sums, nodes, &mut report.reactions)?;
        let light = LIGHT * phases.mean_particle_mass;
        let carry = |scene: &Scene<D>, sums: &NodeSums<D>, end: &Field, straining: &Field| {
            carried(scene, grid, placement, |node| {
                let (mass, end) = (sums.mass(node), &end[node]);
                (end[MASSIVE] > 0.0).then(|| NodeWay {
                    weight: mass / (mass + light),
                    moved: vector(end) * dt,
                    straining: vector(&straining[node]) * dt,
                })
            })
        };
        let cracks;
        let mut pass = Pass {
            field: &nodes.end,
            carried: settings.transfer.carries().then_some(&nodes.carried),
            moves: true,
            strains: false,
            giving: Giving::MomentumOn,
        };
        match stress_update {
            StressUpdate::First => {
                cracks = carry(scene, sums, &nodes.end, &nodes.straining)?;
                phases.move_particles(scene, sums, pass)?;
            }
            StressUpdate::Last => {
                cracks = carry(scene, sums, &nodes.end, &nodes.end)?;
                pass.strains = true;
                pass.giving = Giving::AllOn;
                if !goes_on {
                    phases.prepare_undo(scene);
                }
                let swept = phases.sweep(scene, sums, pass);
                if swept.is_err() {
                    phases.undo(scene, sums, &nodes.before, self.dt)?;
                }
                totals = swept?;
            }
            StressUpdate::Musl => {
                pass.giving = Giving::MomentumBack;
                phases.move_particles(scene, sums, pass)?;
                phases.meetings.bond(sums);
                phases.straining(sums, &mut nodes.straining, Gap::End(&nodes.end));
                cracks = carry(scene, sums, &nodes.end, &nodes.straining)?;
                let pass = Pass {
                    field: &nodes.straining,
                    carried: None,
                    moves: false,
                    strains: true,
                    giving: Giving::AllOn,
                };
                totals = phases.sweep(scene, sums, pass)?;
            }
        }
        if stress_update != StressUpdate::First {
            booking.strained::<D>(stress_update, nodes, &totals, dt);
        }

        // Everything succeeded: the trial becomes the present.
        let place = |node| placement.node_position(grid, node);
        // Springs are strained as the particles are.
        let straining = match stress_update {
            StressUpdate::Last => &nodes.end,
            StressUpdate::First | StressUpdate::Musl => &nodes.straining,
        };
        release.keep(grid, meetings.tied(place, straining, dt));
        let mut glued = meetings.glued(straining, dt);
        let internal = booking.internal + glued.work;
        cracks.accept(scene, placement);
        glued.keep(scene);
        for body in scene.bodies_mut() {
            if settings.in_place::<S, D>() && body.writes_in_place() {
                body.commit_in_place(dt)?;
            } else {
                body.commit()?;
            }
        }
        self.dt = dt;
        self.summed = !*strayed.get_mut();
        let (kinetic, fastest) = match stress_update {
            // The particles were moved after the sweep.
            StressUpdate::First => kinetic_energy_and_speed(scene),
            _ => (totals.kinetic, totals.speed_squared.sqrt()),
        };
        self.fastest = Some(totals.wave_speed + fastest);
        report.energy = StepEnergy {
            internal,
            staggering: report.energy.internal - internal,
            half_step: booking.half_step,
            stored: totals.stored + glued.stored,
            dissipated: totals.dissipated + glued.dissipated,
            viscous: totals.viscous,
            kinetic_particles: kinetic,
            ..report.energy
        };
        scene.record(&report);
        self.placement.accept(scene);
        Ok(report)
    }

    fn memory(&self) -> Vec<f64> {
        let Some(fastest) = self.fastest else {
            return Vec::new();
        };
        let mut memory = vec![fastest];
        memory.extend(self.release.memory());
        if !self.strayed.load(Relaxed) {
            memory.extend(self.placement.memory());
        }
        memory
    }

    fn recall(&mut self, memory: &[f64]) {
        self.fastest = memory.first().copied();
        self.recalled = self.fastest.is_some();
        let rest = self.release.recall(memory.get(1..).unwrap_or(&[]));
        self.placement.recall(rest);
    }
}
