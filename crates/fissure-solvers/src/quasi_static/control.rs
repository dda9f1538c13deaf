//! What a step of a given length holds fixed: a trial, and which iteration balances it.

use fissure_grid::{Shape, simd::Simd};
use fissure_scene::{NewtonStop, Scene, StepControl};
use nalgebra::SVector;

use super::embedded::Embedded;
use super::newton::balanced;
use super::path::{Goal, follow};
use super::settings::LoadControl;
use super::step::QuasiStatic;
use super::trial::{Equilibrium, Start, Trial};
use crate::checks::outside;
use crate::equilibrium::balance::{At, external_forces, forces, momenta, round_off, stress_forces};
use crate::equilibrium::failure::Failure;
use crate::transfers::Transfers;

/// Energy that a prescribed step may dissipate, over that of a controlled one, before control is taken.
const MOST: f64 = 1.5;
/// The same before control is given back.
const LEAST: f64 = 0.01;

impl<S: Shape<D>, const D: usize> QuasiStatic<S, D> {
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
        self.release.look(scene);
        self.faces
            .find(&transfers, scene, &self.release)
            .map_err(|failed| off_grid(scene, failed))?;
        self.system.links.joined = self.faces.joined();
        let divide = |embedded: &Embedded<D>| embedded.divide(grid, &self.placement);
        self.system.links.divide = self.embedded.as_ref().map(divide);
        self.system
            .find(&transfers, scene, &self.constraints)
            .map_err(|failed| off_grid(scene, failed))?;
        let sums = &mut self.internal;
        momenta(&transfers, scene, sums).map_err(|failed| off_grid(scene, failed))?;
        sums.extend(self.system.links.node_count(&transfers));
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
        links.average_as(self.settings.averaging, scene, &self.deviations, sums.len());
        if let Some(embedded) = &mut self.embedded {
            embedded.begin(links, scene, &self.grid, &self.placement);
        }
        stress_forces(links, &transfers, scene, sums, At::Start)
            .map_err(|failed| off_grid(scene, failed))?;
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
                round_off: round_off(scene, self.grid.spacing()),
            },
            scene,
            transfers,
            settings: &self.settings,
            constraints: &mut self.constraints,
            system: &mut self.system,
            faces: &mut self.faces,
            embedded: self.embedded.as_mut(),
            deviations: &self.deviations,
            hourglass_work: 0.0,
            stresses: Vec::new(),
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
    pub(super) fn attempt(
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
}
