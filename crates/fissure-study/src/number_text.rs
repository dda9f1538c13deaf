//! Numbers as a table for people shows them.

/// The significant digits shown.
const DIGITS: i32 = 3;

/// Three significant digits, without trailing zeros, with an exponent where the plain
/// form would be long. What is not finite is marked, so that it catches the eye.
pub(crate) fn short(number: f64) -> String {
    if !number.is_finite() {
        return format!("!{number}");
    }
    if number == 0.0 {
        return "0".to_owned();
    }
    // The exponent after rounding: 999.9 becomes 1.00e3.
    let scientific = format!("{number:.*e}", (DIGITS - 1) as usize);
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific;
    };
    match exponent.parse::<i32>() {
        Ok(exponent) if (-4..DIGITS + 2).contains(&exponent) => {
            let decimals = (DIGITS - 1 - exponent).max(0) as usize;
            without_trailing_zeros(&format!("{number:.decimals$}"))
        }
        _ => format!("{}e{exponent}", without_trailing_zeros(mantissa)),
    }
}

fn without_trailing_zeros(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits() {
        for (number, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (0.0025, "0.0025"),
            (0.333_333, "0.333"),
            (-12.345, "-12.3"),
            (999.9, "1000"),
            (12_345.0, "12345"),
            (123_456.0, "1.23e5"),
            (2.1e11, "2.1e11"),
            (0.000_012_34, "1.23e-5"),
        ] {
            assert_eq!(short(number), text);
        }
    }

    #[test]
    fn what_is_not_finite_is_marked() {
        assert_eq!(short(f64::NAN), "!NaN");
        assert_eq!(short(f64::INFINITY), "!inf");
        assert_eq!(short(f64::NEG_INFINITY), "!-inf");
    }
}
