//! One axis: what it is called, and where it begins and ends.

use super::scale::Scale;

/// An axis as the user asked for it.
#[derive(Debug, Clone, Default)]
pub(super) struct Axis {
    pub label: String,
    pub logarithmic: bool,
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// Whether a number can stand at this axis.
    pub fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// Whether the range set by hand can be drawn.
    pub fn range_is_sound(&self) -> bool {
        self.range
            .is_none_or(|(low, high)| low < high && self.shows(low) && self.shows(high))
    }

    /// Where the axis begins and ends: as set by hand, or around the data with some air.
    pub fn ends(&self, (low, high): (f64, f64)) -> (f64, f64) {
        if let Some(range) = self.range {
            return range;
        }
        if self.logarithmic {
            // One, two or five times a power of ten, and never less than a factor of ten apart.
            let (low, high) = (round_down(low), round_up(high));
            return if high / low < 9.99 {
                (round_down(low / 2.0), round_up(low * 5.0))
            } else {
                (low, high)
            };
        }
        let span = high - low;
        // Nine digits in, rounding is all that varies, and the ticks' labels could not tell them apart.
        if span <= 1e-9 * low.abs().max(high.abs()) {
            let around = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
            return (low - around, high + around);
        }
        // An axis that nearly reaches zero begins there.
        let near = 0.35 * span;
        let start = if (0.0..=near).contains(&low) {
            0.0
        } else {
            low - 0.04 * span
        };
        let end = if (-near..=0.0).contains(&high) {
            0.0
        } else {
            high + 0.04 * span
        };
        (start, end)
    }

    /// The power of ten taken off the numbers.
    pub fn scale(&self, data: (f64, f64)) -> Scale {
        let (low, high) = self.ends(data);
        if self.logarithmic {
            return Scale::logarithmic(low, high);
        }
        // The data and not the air around it: 0.98 of something stays below one.
        let (low, high) = self.range.unwrap_or(data);
        Scale::linear(low.abs().max(high.abs()))
    }
}

/// The next of 1, 2, 5, 10, … below a number above zero.
fn round_down(value: f64) -> f64 {
    let power = 10_f64.powf((value * (1.0 + 1e-9)).log10().floor());
    [5.0, 2.0, 1.0]
        .map(|step| step * power)
        .into_iter()
        .find(|step| *step <= value * (1.0 + 1e-9))
        .unwrap_or(power)
}

/// The next of 1, 2, 5, 10, … above a number above zero.
fn round_up(value: f64) -> f64 {
    let power = 10_f64.powf((value * (1.0 + 1e-9)).log10().floor());
    [1.0, 2.0, 5.0]
        .map(|step| step * power)
        .into_iter()
        .find(|step| *step >= value * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_holds_its_data() {
        let linear = Axis::default();
        assert_eq!(linear.ends((0.0, 1.0)), (0.0, 1.04));
        assert_eq!(linear.ends((1000.0, 1001.0)), (999.96, 1001.04));
        assert_eq!(linear.ends((-1.0, -0.1)).1, 0.0);
        assert_eq!(
            (linear.ends((2.0, 2.0)), linear.ends((0.0, 0.0))),
            ((1.0, 3.0), (-1.0, 1.0))
        );
        assert_eq!(linear.ends((1.0, 1.0 + 1e-15)).0, 0.5);
        let logarithmic = Axis {
            logarithmic: true,
            ..Axis::default()
        };
        let near = |(low, high): (f64, f64), a: f64, b: f64| {
            (low / a - 1.0).abs() < 1e-9 && (high / b - 1.0).abs() < 1e-9
        };
        assert!(near(logarithmic.ends((6.25e-3, 0.1)), 5e-3, 0.1));
        assert!(near(logarithmic.ends((1e-16, 3.0)), 1e-16, 5.0));
        let (low, high) = logarithmic.ends((3.0, 4.0));
        assert!(
            low <= 3.0 && high >= 4.0 && high / low > 9.9,
            "{low} {high}"
        );
    }

    #[test]
    fn a_range_by_hand_is_checked() {
        let axis = |logarithmic, low, high| Axis {
            label: String::new(),
            logarithmic,
            range: Some((low, high)),
        };
        assert!(axis(false, -1.0, 1.0).range_is_sound() && axis(true, 1e-3, 1.0).range_is_sound());
        assert!(!axis(false, 1.0, 1.0).range_is_sound() && !axis(true, 0.0, 1.0).range_is_sound());
        assert!(!axis(false, 0.0, f64::NAN).range_is_sound());
    }
}
