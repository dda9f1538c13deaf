//! How numbers read at an axis: powers of ten in the unit, and what stands at the ticks.

use std::sync::Arc;

use kuva::prelude::TickFormat;

/// Numbers are drawn times 10^(−`exponent`), so that the plotting library and the reader meet handy ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    exponent: i32,
    /// Powers of ten between which a logarithmic axis lies.
    decades: Option<(i32, i32)>,
}

impl Scale {
    /// Powers of a thousand, as the SI's prefixes; none for numbers that read well as they are.
    pub fn linear(largest: f64) -> Self {
        let exponent = match largest {
            _ if largest == 0.0 || !largest.is_finite() || (0.1..10_000.0).contains(&largest) => 0,
            // A hair above, so that 999.9999999 counts as a thousand and not the other way round.
            _ => ((largest * (1.0 + 1e-9)).log10() / 3.0).floor() as i32 * 3,
        };
        Self {
            exponent,
            decades: None,
        }
    }

    /// Shifts what lies below the library's reach, for an axis between two numbers above zero.
    pub fn logarithmic(low: f64, high: f64) -> Self {
        let (first, last) = (
            (low.log10() + 1e-9).floor() as i32,
            (high.log10() - 1e-9).ceil() as i32,
        );
        // The plotting library has no ticks below 1e-10; the tick labels below put the shift back.
        Self {
            exponent: (first + 8).min(0),
            decades: Some((first, last)),
        }
    }

    /// The number as drawn.
    pub fn apply(self, value: f64) -> f64 {
        // Two exact powers: 10^308 and more would overflow in one.
        let half = self.exponent / 2;
        value * 10_f64.powi(-half) * 10_f64.powi(half - self.exponent)
    }

    /// The label, with the power of ten in the unit's brackets.
    pub fn label(self, label: &str) -> String {
        if self.exponent == 0 || self.decades.is_some() {
            return label.to_owned();
        }
        let power = format!("10{}", superscript(self.exponent));
        match label
            .strip_suffix(']')
            .and_then(|rest| rest.rsplit_once('['))
        {
            Some((name, unit)) if unit.trim() == "-" || unit.trim().is_empty() => {
                format!("{name}[{power}]")
            }
            Some((name, unit)) => format!("{name}[{power} {unit}]"),
            None => format!("{label} [{power}]"),
        }
    }

    /// How the numbers at the ticks are written.
    pub fn ticks(self) -> TickFormat {
        let Self { exponent, decades } = self;
        match decades {
            None => TickFormat::Custom(Arc::new(decimal)),
            Some(decades) => {
                TickFormat::Custom(Arc::new(move |value| power(value, exponent, decades)))
            }
        }
    }
}

/// A scaled number without trailing zeros.
pub(super) fn decimal(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "" | "-0" => "0".to_owned(),
        _ => text.replace('-', "−"),
    }
}

/// The label of a tick on a logarithmic axis between two powers of ten. Twos and fives are labelled on short axes only.
fn power(drawn: f64, shift: i32, (first, last): (i32, i32)) -> String {
    let exponent = (drawn.log10() + 1e-9).floor() as i32;
    let mantissa = (drawn / 10_f64.powi(exponent)).round() as i32;
    let exponent = exponent + shift;
    if mantissa != 1 && last - first > 2 {
        return String::new();
    }
    // One way of writing along the whole axis.
    if first >= -3 && last <= 3 {
        return decimal(f64::from(mantissa) * 10_f64.powi(exponent));
    }
    match mantissa {
        1 => format!("10{}", superscript(exponent)),
        _ => format!("{mantissa}·10{}", superscript(exponent)),
    }
}

/// A number in raised digits.
pub(super) fn superscript(number: i32) -> String {
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32(0x2070 + (digit as u32 - '0' as u32)).unwrap_or(digit),
        other => other,
    };
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_a_thousand_go_to_the_unit() {
        let shown = |largest: f64, label: &str| {
            let scale = Scale::linear(largest);
            (scale.label(label), decimal(scale.apply(largest)))
        };
        assert_eq!(
            shown(4e-4, "time [s]"),
            ("time [10⁻⁶ s]".to_owned(), "400".to_owned())
        );
        assert_eq!(
            shown(2.5e-2, "x [m]"),
            ("x [10⁻³ m]".to_owned(), "25".to_owned())
        );
        assert_eq!(
            shown(0.25, "x [m]"),
            ("x [m]".to_owned(), "0.25".to_owned())
        );
        assert_eq!(
            shown(2.49e10, "E [Pa]"),
            ("E [10⁹ Pa]".to_owned(), "24.9".to_owned())
        );
        assert_eq!(
            shown(3e-5, "strain [-]"),
            ("strain [10⁻⁶]".to_owned(), "30".to_owned())
        );
        assert_eq!(
            shown(3e-5, "strain"),
            ("strain [10⁻⁶]".to_owned(), "30".to_owned())
        );
        assert_eq!(shown(0.0, "x [m]"), ("x [m]".to_owned(), "0".to_owned()));
        assert_eq!(decimal(-0.5), "−0.5");
        assert!(Scale::linear(1e-310).apply(1e-310).is_finite());
    }

    #[test]
    fn powers_of_ten_read_as_such() {
        assert_eq!(power(1e-4, 0, (-6, 0)), "10⁻⁴");
        assert_eq!(power(1e-9, -7, (-16, -10)), "10⁻¹⁶");
        assert_eq!(
            (power(10.0, 0, (0, 3)), power(2.0, 0, (0, 3))),
            ("10".to_owned(), String::new())
        );
        assert_eq!(
            (power(2.0, 0, (0, 1)), power(0.005, 0, (-3, -1))),
            ("2".to_owned(), "0.005".to_owned())
        );
        assert_eq!(power(5e-5, 0, (-5, -4)), "5·10⁻⁵");
    }
}
