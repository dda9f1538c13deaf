//! A run that makes energy out of nothing is stopped.

use fissure_scene::{Report, Scene, Watch, WatchError};

/// A watch that stops a run whose motion and strain hold more energy than was put in.
///
/// Steps that are too long for their scheme make the shortest waves grow from round-off, by a factor a step: what the run says
/// afterwards is nonsense. The guard returns [`WatchError::EnergyGrowth`]. Counted as put in are the kinetic and stored energy that the guard was made with and the positive work
/// of loads and prescribed motions since. Heat, burning and edits of the scene in mid-run put in energy that no ledger
/// books: make the guard afterwards, or do without.
///
/// ```
/// # use fissure_diagnostics::EnergyGuard;
/// # use fissure_scene::{Plane, Report, Scene, StepEnergy, Watch};
/// # let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
/// let mut guard = EnergyGuard::new(&scene);
/// // run(&mut scene, &mut solver, until, &mut [&mut guard])?;
/// # let mut step = |external, stored| {
/// #     let energy = StepEnergy { external, stored, ..StepEnergy::default() };
/// #     let report = Report { step: scene.step() + 1, energy, ..Report::default() };
/// #     scene.record(&report);
/// #     guard.after(&scene, &report)
/// # };
/// # assert!(step(1.0, 0.9).is_ok());
/// # assert!(step(0.0, 9.0).is_ok());
/// # assert!(step(0.0, 11.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyGuard {
    factor: f64,
    given: f64,
    external: f64,
}

impl EnergyGuard {
    /// A guard of a scene as it is, that permits ten times the energy put in: rounding and the error of a stable step
    /// stay far below, an unstable one gets there in tens of steps.
    pub fn new<const D: usize>(scene: &Scene<D>) -> Self {
        let totals = scene.energy();
        let kinetic = scene.bodies().iter().map(|body| body.kinetic_energy());
        Self {
            factor: 10.0,
            given: kinetic.sum::<f64>() + totals.stored + totals.dissipated,
            external: totals.external,
        }
    }

    /// The same with another factor, > 1.
    #[must_use]
    pub fn factor(mut self, factor: f64) -> Self {
        self.factor = factor;
        self
    }
}

impl<const D: usize> Watch<D> for EnergyGuard {
    fn after(&mut self, scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError> {
        let totals = scene.energy();
        self.given += (totals.external - self.external).max(0.0);
        self.external = totals.external;
        let energy = totals.kinetic + totals.stored + totals.dissipated;
        // NaN is growth too.
        match energy <= self.factor * self.given {
            true => Ok(()),
            false => Err(WatchError::EnergyGrowth {
                step: report.step,
                time: report.time,
                energy,
                given: self.given,
            }),
        }
    }
}
