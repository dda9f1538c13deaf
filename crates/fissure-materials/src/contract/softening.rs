//! What a softening curve has to satisfy before a law may rest on it.

use thiserror::Error;

use crate::{MaterialError, Softening};

/// What is wrong with a softening curve.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SofteningFault {
    /// The curve refuses its own parameters.
    #[error(transparent)]
    Parameter(#[from] MaterialError),
    /// A value is not what the others say it is.
    #[error("{what}: {found} at opening {opening}, expected {expected} to {tolerance}")]
    Curve {
        /// What was looked at.
        what: &'static str,
        /// Dimensionless opening.
        opening: f64,
        /// What the curve gave.
        found: f64,
        /// What it should have given, or its bound.
        expected: f64,
        /// By how much it may differ.
        tolerance: f64,
    },
}

/// Intervals in which a curve is looked at.
const PARTS: u32 = 4096;

/// Checks a softening curve: 1 at zero opening, never rising, nothing from the critical opening on,
/// unit area; `slope` is the derivative and `area` the integral of `ratio`; `steepest` is the
/// largest `−slope`, no less and no more.
///
/// Derivative and integral are compared by Simpson's rule on 4096 intervals of the curve; the
/// tolerance is `1e-12` plus the second difference of what is integrated times the interval, so
/// that kinks pass. An infinite critical opening is followed to where `1e-12` of the strength is
/// left.
///
/// # Errors
/// The first thing that is wrong, and where.
///
/// ```
/// use fissure_materials::{Softening, contract::check_softening};
/// /// A quarter circle, scaled to unit area.
/// #[derive(Clone, Copy, Debug)]
/// struct Arc;
/// const RADIUS: f64 = 4.0 / std::f64::consts::PI;
/// impl Softening for Arc {
///     fn ratio(&self, s: f64) -> f64 {
///         (1.0 - (s / RADIUS).powi(2)).max(0.0).sqrt()
///     }
/// #   fn slope(&self, s: f64) -> f64 { -s / (RADIUS * RADIUS * self.ratio(s)) }
/// #   fn area(&self, _: f64) -> f64 { 1.0 }
/// #   fn critical(&self) -> f64 { RADIUS }
///     // … and its end is vertical: no band is stable.
///     fn steepest(&self) -> f64 {
///         f64::INFINITY
///     }
/// }
/// assert!(check_softening(&Arc).is_err());
/// assert!(check_softening(&fissure_materials::softening::CubicStep).is_ok());
/// ```
pub fn check_softening<S: Softening>(curve: &S) -> Result<(), SofteningFault> {
    curve.check()?;
    let (critical, steepest) = (curve.critical(), curve.steepest());
    within(
        "steepest slope",
        0.0,
        steepest,
        steepest > 0.0 && steepest.is_finite(),
    )?;
    within("critical opening", 0.0, critical, critical > 0.0)?;
    equal("ratio at the start", 0.0, curve.ratio(0.0), 1.0, 0.0)?;
    equal("area at the start", 0.0, curve.area(0.0), 0.0, 0.0)?;
    let end = end_of(curve)?;
    let mut attained: f64 = 0.0;
    for part in 0..PARTS {
        let [low, high] = [part, part + 1].map(|i| end * f64::from(i) / f64::from(PARTS));
        attained = attained.max(interval(curve, low, high)?);
    }
    let before_end = end * (1.0 - 1e-9);
    attained = attained.max(-curve.slope(before_end));
    equal(
        "steepest slope against the largest met",
        end,
        steepest,
        attained,
        1e-3 * attained,
    )?;
    finished(curve, end)
}

/// Where the curve has ended, or all but ended.
fn end_of<S: Softening>(curve: &S) -> Result<f64, SofteningFault> {
    let critical = curve.critical();
    if critical.is_finite() {
        return Ok(critical);
    }
    let mut end = 1.0;
    for _ in 0..30 {
        if curve.ratio(end) < 1e-12 {
            return Ok(end);
        }
        end *= 2.0;
    }
    equal("ratio far out", end, curve.ratio(end), 0.0, 1e-12)?;
    Ok(end)
}

/// Nothing is left from the end on, and all of the toughness has been spent.
fn finished<S: Softening>(curve: &S, end: f64) -> Result<(), SofteningFault> {
    for opening in [end, 1.5 * end, 100.0 * end] {
        equal(
            "ratio at the end",
            opening,
            curve.ratio(opening),
            0.0,
            1e-11,
        )?;
        equal("area at the end", opening, curve.area(opening), 1.0, 1e-11)?;
        if opening > end {
            equal(
                "slope beyond the end",
                opening,
                curve.slope(opening),
                0.0,
                1e-11,
            )?;
        }
    }
    Ok(())
}

/// One interval; the steepest slope met.
fn interval<S: Softening>(curve: &S, low: f64, high: f64) -> Result<f64, SofteningFault> {
    let middle = 0.5 * (low + high);
    let ratio = [low, middle, high].map(|s| curve.ratio(s));
    let slope = [low, middle, high].map(|s| curve.slope(s));
    for (s, f) in [low, middle, high].into_iter().zip(ratio) {
        within("ratio outside 0 to 1", s, f, (0.0..=1.0).contains(&f))?;
    }
    let falls = ratio[1] <= ratio[0] && ratio[2] <= ratio[1];
    within("ratio rises", middle, ratio[1], falls)?;
    let most = curve.steepest() * (1.0 + 1e-12);
    for (s, f) in [low, middle, high].into_iter().zip(slope) {
        within("slope steeper than the steepest", s, f, -f <= most)?;
    }
    let area = curve.area(high) - curve.area(low);
    simpson(
        "area against the integral of ratio",
        [low, high],
        area,
        ratio,
    )?;
    // The last point belongs to what comes after the end.
    let inside = [slope[0], slope[1], slope[1]];
    let slope = if high >= curve.critical() {
        inside
    } else {
        slope
    };
    simpson(
        "ratio against the integral of slope",
        [low, high],
        ratio[2] - ratio[0],
        slope,
    )?;
    Ok(slope.into_iter().fold(0.0, |most: f64, s| most.max(-s)))
}

fn simpson(
    what: &'static str,
    [low, high]: [f64; 2],
    found: f64,
    values: [f64; 3],
) -> Result<(), SofteningFault> {
    let width = high - low;
    let integral = width / 6.0 * (values[0] + 4.0 * values[1] + values[2]);
    let bend =
        (values[0] - 2.0 * values[1] + values[2]).abs() + (values[2] - values[0]).abs() * 1e-3;
    equal(what, low, found, integral, 1e-12 + width * bend)
}

fn equal(
    what: &'static str,
    opening: f64,
    found: f64,
    expected: f64,
    tolerance: f64,
) -> Result<(), SofteningFault> {
    if (found - expected).abs() <= tolerance {
        return Ok(());
    }
    Err(SofteningFault::Curve {
        what,
        opening,
        found,
        expected,
        tolerance,
    })
}

/// A condition without an expected value; NaN must have failed it.
fn within(what: &'static str, opening: f64, found: f64, holds: bool) -> Result<(), SofteningFault> {
    if holds {
        return Ok(());
    }
    Err(SofteningFault::Curve {
        what,
        opening,
        found,
        expected: 0.0,
        tolerance: 0.0,
    })
}
