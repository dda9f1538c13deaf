//! The energy ledger over time.

use fissure_scene::{EnergyTotals, Every, Report, Scene, Watch, WatchError};

use crate::energy::{EnergyBalance, largest, ratio};

/// A watch that keeps the energy ledger, a row per step or per interval, and the worst imbalance of
/// all steps, kept or not.
///
/// ```
/// # use fissure_diagnostics::EnergyHistory;
/// # use fissure_scene::{Plane, Report, Scene, StepEnergy, Watch};
/// # let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
/// let mut energy = EnergyHistory::new().every(100);
/// // run(&mut scene, &mut solver, until, &mut [&mut energy])?;
/// # for step in 1..=200 {
/// #     let energies = StepEnergy { external: 1.0, internal: 1.0, stored: step as f64, ..StepEnergy::default() };
/// #     let report = Report { step, time: step as f64, dt: 1.0, energy: energies, ..Report::default() };
/// #     scene.record(&report);
/// #     energy.after(&scene, &report)?;
/// # }
/// assert_eq!(energy.times().len(), 2);
/// assert!(energy.worst_imbalance() < 1e-3 && energy.worst_balance() < 1e-12);
/// # Ok::<(), fissure_scene::WatchError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct EnergyHistory {
    every: Every,
    times: Vec<f64>,
    totals: Vec<EnergyTotals>,
    /// Largest |imbalance| of all steps, J.
    imbalance: f64,
    /// Largest scale of all steps, J.
    scale: f64,
    /// Largest violation of the grid's balance of all steps.
    balance: f64,
}

/// A column of the history: its label and what it takes from a ledger.
type Column = (&'static str, fn(&EnergyTotals) -> f64);

const COLUMNS: [Column; 12] = [
    ("external [J]", |e| e.external),
    ("internal [J]", |e| e.internal),
    ("stored [J]", |e| e.stored),
    ("dissipated [J]", |e| e.dissipated),
    ("viscous [J]", |e| e.viscous),
    ("contact [J]", |e| e.contact),
    ("stabilisation [J]", |e| e.stabilisation),
    ("kinetic [J]", |e| e.kinetic),
    ("half step [J]", |e| e.half_step),
    ("transfer loss [J]", |e| e.transfer_loss),
    ("imbalance [J]", EnergyTotals::imbalance),
    ("worst balance", |e| e.worst_balance),
];

impl EnergyHistory {
    /// A history without rows, with a row after each step.
    pub fn new() -> Self {
        Self::default()
    }

    /// Keeps a row only after steps whose number is a multiple of `steps`; 0 is never.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = Every::Steps(steps);
        self
    }

    /// Keeps a row only after steps that reach or pass a multiple of `interval`, s.
    #[must_use]
    pub fn every_interval(mut self, interval: f64) -> Self {
        self.every = Every::Time(interval);
        self
    }

    /// Times of the rows, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The ledgers of the rows: energies since the start of the scene.
    pub fn totals(&self) -> &[EnergyTotals] {
        &self.totals
    }

    /// The balances of the rows.
    pub fn balances(&self) -> impl Iterator<Item = EnergyBalance> {
        self.totals.iter().map(EnergyBalance::of)
    }

    /// Largest magnitude that [`EnergyBalance::imbalance`] had after any step, over the largest
    /// scale: not the largest ratio, which in the first steps is of nothing to next to nothing.
    pub fn worst_imbalance(&self) -> f64 {
        ratio(self.imbalance, self.scale)
    }

    /// Largest [`EnergyBalance::worst_balance`].
    pub fn worst_balance(&self) -> f64 {
        self.balance
    }

    /// Labels and numbers of all columns, the time first, for a table.
    pub fn columns(&self) -> impl Iterator<Item = (&'static str, Vec<f64>)> {
        let ledger = |(label, take): Column| (label, self.totals.iter().map(take).collect());
        let time = ("time [s]", self.times.clone());
        std::iter::once(time).chain(COLUMNS.into_iter().map(ledger))
    }
}

impl<const D: usize> Watch<D> for EnergyHistory {
    fn after(&mut self, scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError> {
        let balance = EnergyBalance::of(scene.energy());
        self.imbalance = largest(self.imbalance, balance.imbalance);
        self.scale = largest(self.scale, balance.scale());
        self.balance = largest(self.balance, balance.worst_balance);
        if self.every.is_due(report) {
            self.times.push(report.time);
            self.totals.push(*scene.energy());
        }
        Ok(())
    }
}
