//! Load over displacement, with the work between them.

use crate::error::check_positive;
use crate::{CurveError, MeasureError, curve_error};

/// A curve of load over displacement that accumulates its work and keeps its peak.
///
/// ```
/// use fissure_diagnostics::LoadCurve;
///
/// let mut curve = LoadCurve::default(); // starts at rest: no displacement, no load
/// curve.push(1e-5, 900.0);
/// curve.push(3e-5, 0.0);
/// assert!((curve.work() - 0.5 * 900.0 * 3e-5).abs() < 1e-15);
/// assert_eq!((curve.peak(), curve.peak_displacement()), (900.0, 1e-5));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCurve {
    displacement: Vec<f64>,
    load: Vec<f64>,
    /// Displacement and load now, whether kept as a point or not.
    now: (f64, f64),
    work: f64,
    /// Displacement and load at the peak.
    peak: (f64, f64),
}

impl Default for LoadCurve {
    fn default() -> Self {
        Self::starting_at(0.0, 0.0)
    }
}

impl LoadCurve {
    /// A curve whose first point is this displacement (m) under this load (N): for a body that is
    /// loaded already, as after a restart.
    pub fn starting_at(displacement: f64, load: f64) -> Self {
        Self {
            displacement: vec![displacement],
            load: vec![load],
            now: (displacement, load),
            work: 0.0,
            peak: (displacement, load),
        }
    }

    /// Goes on to a displacement (m) and load (N) and keeps the point.
    pub fn push(&mut self, displacement: f64, load: f64) {
        self.advance(displacement, load);
        self.keep();
    }

    /// Goes on without keeping the point: the work and the peak take it in all the same.
    pub(crate) fn advance(&mut self, displacement: f64, load: f64) {
        self.work += 0.5 * (self.now.1 + load) * (displacement - self.now.0);
        self.now = (displacement, load);
        let below = load <= self.peak.1 || self.peak.1.is_nan();
        if !below {
            self.peak = self.now;
        }
    }

    /// Keeps where the curve is now as a point.
    pub(crate) fn keep(&mut self) {
        self.displacement.push(self.now.0);
        self.load.push(self.now.1);
    }

    /// Displacements of the points, m.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Loads of the points, N.
    pub fn load(&self) -> &[f64] {
        &self.load
    }

    /// Displacement and load now, m and N.
    pub fn now(&self) -> (f64, f64) {
        self.now
    }

    /// ∫ P dδ since the start by the trapezoidal rule, J.
    pub fn work(&self) -> f64 {
        self.work
    }

    /// Largest load, N; NaN once a load was.
    pub fn peak(&self) -> f64 {
        self.peak.1
    }

    /// Displacement at the largest load, m.
    pub fn peak_displacement(&self) -> f64 {
        self.peak.0
    }

    /// Relative L2 distance to an exact curve over a range of displacement; see [`curve_error`].
    ///
    /// # Errors
    /// As [`curve_error`].
    pub fn error(
        &self,
        exact: impl Fn(f64) -> f64,
        range: (f64, f64),
        breakpoints: &[f64],
    ) -> Result<f64, CurveError> {
        curve_error(&self.displacement, &self.load, exact, range, breakpoints)
    }

    /// Mean strain and nominal stress (Pa) of the points, for a body of this reference length (m) and
    /// section (m²).
    ///
    /// # Errors
    /// [`MeasureError::Parameter`] if either is not positive and finite.
    pub fn stress_strain(
        &self,
        length: f64,
        section: f64,
    ) -> Result<(Vec<f64>, Vec<f64>), MeasureError> {
        check_positive("length of the body", length)?;
        check_positive("section of the body", section)?;
        let strain = self.displacement.iter().map(|d| d / length);
        let stress = self.load.iter().map(|load| load / section);
        Ok((strain.collect(), stress.collect()))
    }

    /// Labels and numbers of the two columns, for a table.
    pub fn columns(&self) -> [(&'static str, &[f64]); 2] {
        [
            ("displacement [m]", &self.displacement),
            ("load [N]", &self.load),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unloading_gives_work_back_and_points_may_be_left_out() {
        let mut curve = LoadCurve::default();
        curve.push(2.0, 4.0);
        curve.advance(1.0, 2.0);
        curve.push(0.0, 0.0);
        assert_eq!((curve.work(), curve.peak()), (0.0, 4.0));
        assert_eq!(curve.displacement(), [0.0, 2.0, 0.0]);
        assert_eq!(curve.columns()[1].1, [0.0, 4.0, 0.0]);
    }

    #[test]
    fn stress_and_strain() {
        let mut curve = LoadCurve::default();
        curve.push(2e-3, 40.0);
        let curve = curve.stress_strain(0.5, 1e-4).unwrap();
        assert_eq!(curve, (vec![0.0, 4e-3], vec![0.0, 4e5]));
        assert!(LoadCurve::default().stress_strain(0.0, 1.0).is_err());
    }

    #[test]
    fn nan_stays_seen() {
        let mut curve = LoadCurve::starting_at(1.0, 5.0);
        curve.push(2.0, f64::NAN);
        curve.push(3.0, 9.0);
        assert!(curve.peak().is_nan() && curve.work().is_nan());
        assert!(curve.error(|_| 1.0, (1.0, 3.0), &[]).is_err());
    }
}
