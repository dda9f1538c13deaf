//! Length and speed of the crack against time.

/// The furthest failed particle ahead of the notch against time.
#[derive(Clone, Debug, Default)]
pub(super) struct Growth {
    /// s, where the tip moves.
    pub time: Vec<f64>,
    /// Place of the tip at rest, m.
    pub tip: Vec<f64>,
}

impl Growth {
    /// A tip at `x`, m; kept if it is further than before.
    pub(super) fn push(&mut self, time: f64, x: f64) {
        if self.tip.last().is_none_or(|tip| x > *tip) {
            self.time.push(time);
            self.tip.push(x);
        }
    }

    /// Time of the first failure, s; NaN if there was none.
    pub(super) fn onset(&self) -> f64 {
        self.time.first().copied().unwrap_or(f64::NAN)
    }

    /// Slope of the line through the tips between two places by least squares, m/s; NaN with fewer
    /// than three.
    pub(super) fn speed(&self, from: f64, to: f64) -> f64 {
        let pairs = self.time.iter().zip(&self.tip);
        let chosen: Vec<(f64, f64)> = pairs
            .filter(|(_, x)| **x >= from && **x <= to)
            .map(|(t, x)| (*t, *x))
            .collect();
        if chosen.len() < 3 {
            return f64::NAN;
        }
        let number = chosen.len() as f64;
        let mean_t = chosen.iter().map(|c| c.0).sum::<f64>() / number;
        let mean_x = chosen.iter().map(|c| c.1).sum::<f64>() / number;
        let cross: f64 = chosen.iter().map(|c| (c.0 - mean_t) * (c.1 - mean_x)).sum();
        let square: f64 = chosen.iter().map(|c| (c.0 - mean_t).powi(2)).sum();
        cross / square
    }

    /// Speed about each tip, from the tips within `reach` m of it.
    pub(super) fn speeds(&self, reach: f64) -> Vec<f64> {
        let about = |x: &f64| self.speed(x - reach, x + reach);
        self.tip.iter().map(about).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_crack_has_its_speed() {
        let mut growth = Growth::default();
        for i in 0..20 {
            growth.push(1e-6 * f64::from(i), 0.03 + 5e-4 * f64::from(i));
            growth.push(1e-6 * f64::from(i), 0.01);
        }
        assert_eq!(growth.onset(), 0.0);
        assert!((growth.speed(0.03, 0.036) / 500.0 - 1.0).abs() < 1e-9);
        assert!(growth.speed(0.0, 0.03).is_nan());
    }
}
