//! Comparisons within one case: how many, the closest to its bound, and the first that fails.

/// Collects the comparisons of one case. A property that does not apply makes none.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Gauge {
    /// Comparisons made.
    pub count: usize,
    /// Largest measured value over its bound.
    pub worst: f64,
    /// The first comparison that failed.
    pub failure: Option<Failure>,
    /// Whether a crack softened in this case.
    pub softened: bool,
    /// Whether a crack failed in this case.
    pub failed: bool,
    /// Largest departure of a tangent from major symmetry, over the stiffness.
    pub asymmetry: f64,
    /// Difference between one step and many, over stiffness times increment.
    pub step_error: f64,
}

/// A comparison that failed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Failure {
    pub measured: f64,
    pub bound: f64,
    pub what: &'static str,
}

impl Gauge {
    /// Requires `measured ≤ bound`; NaN fails.
    pub fn check(&mut self, measured: f64, bound: f64, what: &'static str) {
        self.count += 1;
        let holds = measured <= bound;
        if holds && bound > 0.0 {
            self.worst = self.worst.max(measured / bound);
        }
        if !holds && self.failure.is_none() {
            self.failure = Some(Failure {
                measured,
                bound,
                what,
            });
        }
    }

    /// Requires a condition that has no measure.
    pub fn require(&mut self, condition: bool, what: &'static str) {
        self.check(f64::from(u8::from(!condition)), 0.0, what);
    }
}
