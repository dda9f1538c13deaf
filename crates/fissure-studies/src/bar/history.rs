//! What a run of the bar leaves: load and energies against elongation.

use fissure::diagnostics::LoadCurve;

/// One row per step, and the state of rest.
#[derive(Clone, Debug)]
pub(crate) struct History {
    /// Elongation, m, and load, N: mean of both grips.
    pub curve: LoadCurve,
    /// Work of the load up to each row, J.
    pub work: Vec<f64>,
    /// Stored energy, J.
    pub stored: Vec<f64>,
    /// Dissipated energy, J.
    pub dissipated: Vec<f64>,
}

impl History {
    /// A bar at rest.
    pub(crate) fn at_rest() -> Self {
        Self {
            curve: LoadCurve::starting_at(0.0, 0.0),
            work: vec![0.0],
            stored: vec![0.0],
            dissipated: vec![0.0],
        }
    }

    /// Adds a row; the work is integrated by the trapezoidal rule.
    pub(crate) fn push(&mut self, elongation: f64, load: f64, stored: f64, dissipated: f64) {
        self.curve.push(elongation, load);
        self.work.push(self.curve.work());
        self.stored.push(stored);
        self.dissipated.push(dissipated);
    }

    /// Load at an elongation, linear between rows, N; NaN beyond them.
    pub(crate) fn load_at(&self, elongation: f64) -> f64 {
        let (x, y) = (self.curve.displacement(), self.curve.load());
        let above = x.partition_point(|x| *x < elongation);
        if above == 0 || above == x.len() {
            return f64::NAN;
        }
        let share = (elongation - x[above - 1]) / (x[above] - x[above - 1]);
        y[above - 1] + share * (y[above] - y[above - 1])
    }

    /// About `count` rows, the first and last among them.
    pub(crate) fn thinned(&self, count: usize) -> Thinned {
        let stride = self.work.len().div_ceil(count).max(1);
        let keep = |column: &[f64]| -> Vec<f64> {
            let rest = (column.len() - 1) % stride;
            let thin = column.iter().step_by(stride);
            thin.chain(column.last().filter(|_| rest > 0))
                .copied()
                .collect()
        };
        Thinned {
            elongation: keep(self.curve.displacement()),
            load: keep(self.curve.load()),
            work: keep(&self.work),
            stored: keep(&self.stored),
            dissipated: keep(&self.dissipated),
        }
    }
}

/// The columns of a history with few rows, for pictures and tables.
#[derive(Clone, Debug)]
pub(crate) struct Thinned {
    pub elongation: Vec<f64>,
    pub load: Vec<f64>,
    pub work: Vec<f64>,
    pub stored: Vec<f64>,
    pub dissipated: Vec<f64>,
}
