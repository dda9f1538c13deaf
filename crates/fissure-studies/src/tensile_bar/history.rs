//! What a run of the bar leaves: load, work and energies against elongation.

use super::exact::Exact;

/// One row per step.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    /// Elongation, m.
    pub elongation: Vec<f64>,
    /// Load, N: mean of both grips.
    pub load: Vec<f64>,
    /// Work of the load, J.
    pub work: Vec<f64>,
    /// Stored energy, J.
    pub stored: Vec<f64>,
    /// Dissipated energy, J.
    pub dissipated: Vec<f64>,
}

impl History {
    /// Adds a row; the work is integrated by the trapezoidal rule from rest.
    pub(super) fn push(&mut self, elongation: f64, load: f64, stored: f64, dissipated: f64) {
        let last = |column: &[f64]| column.last().copied().unwrap_or(0.0);
        let way = elongation - last(&self.elongation);
        let work = last(&self.work) + 0.5 * (load + last(&self.load)) * way;
        self.elongation.push(elongation);
        self.load.push(load);
        self.work.push(work);
        self.stored.push(stored);
        self.dissipated.push(dissipated);
    }

    /// Largest load, N; NaN if there is none.
    pub(super) fn peak(&self) -> f64 {
        let larger = |a: f64, &b: &f64| if a > b { a } else { b };
        self.load.iter().fold(f64::NAN, larger)
    }

    /// `(∫(P − P_exact)² dδ / ∫P_exact² dδ)^½` up to `end`, by the trapezoidal rule on the rows.
    pub(super) fn load_error(&self, exact: &Exact, end: f64) -> f64 {
        let (mut error, mut size) = (0.0, 0.0);
        let (mut before, mut error_before, mut size_before) = (0.0, 0.0, 0.0);
        for (&elongation, &load) in self.elongation.iter().zip(&self.load) {
            if elongation > end {
                break;
            }
            let reference = exact.load(elongation);
            let (error_now, size_now) = ((load - reference).powi(2), reference * reference);
            let way = 0.5 * (elongation - before);
            error += way * (error_now + error_before);
            size += way * (size_now + size_before);
            (before, error_before, size_before) = (elongation, error_now, size_now);
        }
        (error / size).sqrt()
    }

    /// About `count` rows, the first and last among them.
    pub(super) fn thinned(&self, count: usize) -> Self {
        let rows = self.elongation.len();
        let stride = rows.div_ceil(count).max(1);
        let keep = |column: &[f64]| -> Vec<f64> {
            let thin = column.iter().step_by(stride).copied();
            let last = column.last().filter(|_| rows % stride != 1 && stride > 1);
            thin.chain(last.copied()).collect()
        };
        Self {
            elongation: keep(&self.elongation),
            load: keep(&self.load),
            work: keep(&self.work),
            stored: keep(&self.stored),
            dissipated: keep(&self.dissipated),
        }
    }
}
