//! Sampled curves against exact ones, and orders of convergence.

use crate::CurveError;

/// Abscissae and weights of the Gauss rule of five points on [−1, 1], exact up to degree 9.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Relative L2 distance `√(∫(y − e)² dx / ∫e² dx)` over `range` between the curve through the
/// samples, linear between them, and an exact function `e`.
///
/// Integrated by Gauss' rule between neighbouring samples and breakpoints. `breakpoints` are where
/// the exact function or its slope jumps; those outside the range do nothing. The samples' `x` may
/// rest but not fall, and must reach over the range to within 1e-9 of its length.
///
/// # Errors
/// [`CurveError`] for samples, a range or breakpoints that are not usable; a sample or a value of
/// the exact function that is not finite is an error and never a distance.
///
/// ```
/// use fissure_diagnostics::curve_error;
///
/// // Linear up to 1, then nothing: with the jump named, the samples' slant is all the error.
/// let exact = |x: f64| if x < 1.0 { x } else { 0.0 };
/// let (x, y) = ([0.0, 1.0, 1.0, 2.0], [0.0, 1.0, 0.0, 0.0]);
/// assert!(curve_error(&x, &y, exact, (0.0, 2.0), &[1.0])? < 1e-14);
/// # Ok::<(), fissure_diagnostics::CurveError>(())
/// ```
pub fn curve_error(
    x: &[f64],
    y: &[f64],
    exact: impl Fn(f64) -> f64,
    range: (f64, f64),
    breakpoints: &[f64],
) -> Result<f64, CurveError> {
    check_samples(x, y)?;
    all_finite("breakpoint", breakpoints)?;
    let ((from, to), (first, last)) = (range, (x[0], x[x.len() - 1]));
    let slack = 1e-9 * (to - from);
    let covered = from < to && first <= from + slack && last >= to - slack;
    if !covered {
        return Err(CurveError::Range {
            first,
            last,
            from,
            to,
        });
    }
    let inside = |cut: &f64| from < *cut && *cut < to;
    let mut cuts: Vec<f64> = x
        .iter()
        .chain(breakpoints)
        .copied()
        .filter(inside)
        .collect();
    cuts.extend([from, to]);
    cuts.sort_unstable_by(f64::total_cmp);

    let (mut distance, mut norm) = (0.0, 0.0);
    for piece in cuts.windows(2) {
        let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
        if half > 0.0 {
            let line = Line::at(x, y, middle);
            for (abscissa, weight) in GAUSS {
                let at = middle + half * abscissa;
                let exact = exact(at);
                distance += weight * half * (line.value(at) - exact).powi(2);
                norm += weight * half * exact * exact;
            }
        }
    }
    if norm == 0.0 {
        return Err(CurveError::ZeroCurve);
    }
    let error = (distance / norm).sqrt();
    if error.is_finite() {
        Ok(error)
    } else {
        let what = "exact curve";
        Err(CurveError::NotFinite { what, point: 0 })
    }
}

/// The line through two neighbouring samples.
struct Line {
    x: f64,
    y: f64,
    slope: f64,
}

impl Line {
    /// The one above `at`, which is no sample; beyond the ends the value stays.
    fn at(x: &[f64], y: &[f64], at: f64) -> Self {
        let above = x.partition_point(|x| *x <= at);
        if above == 0 || above == x.len() {
            let i = above.min(x.len() - 1);
            return Self {
                x: x[i],
                y: y[i],
                slope: 0.0,
            };
        }
        let below = above - 1;
        Self {
            x: x[below],
            y: y[below],
            slope: (y[above] - y[below]) / (x[above] - x[below]),
        }
    }

    fn value(&self, at: f64) -> f64 {
        self.y + self.slope * (at - self.x)
    }
}

fn check_samples(x: &[f64], y: &[f64]) -> Result<(), CurveError> {
    if x.len() != y.len() || x.len() < 2 {
        let (x, y) = (x.len(), y.len());
        return Err(CurveError::Length { x, y });
    }
    all_finite("abscissa", x)?;
    all_finite("ordinate", y)?;
    match x.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(i) => Err(CurveError::Falling { point: i + 1 }),
        None => Ok(()),
    }
}

fn all_finite(what: &'static str, numbers: &[f64]) -> Result<(), CurveError> {
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(point) => Err(CurveError::NotFinite { what, point }),
        None => Ok(()),
    }
}

/// A power law `y = factor · x^exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Slope in double-logarithmic axes: the order of convergence, if `y` is an error and `x` a
    /// cell size.
    pub exponent: f64,
    /// Value at `x = 1`, in the unit of `y`.
    pub factor: f64,
    /// Largest `|ln y − ln fit|` of a point: how little it is a power law.
    pub worst_residual: f64,
}

/// The power law through points by least squares in double-logarithmic axes.
///
/// # Errors
/// [`CurveError::Length`], [`CurveError::NotFinite`], [`CurveError::NotPositive`], and
/// [`CurveError::OneAbscissa`] if all `x` are the same.
///
/// ```
/// use fissure_diagnostics::fit_slope;
///
/// let (cell, error) = ([0.1, 0.05, 0.025], [4e-2, 1e-2, 2.5e-3]);
/// assert!((fit_slope(&cell, &error)?.exponent - 2.0).abs() < 1e-12);
/// # Ok::<(), fissure_diagnostics::CurveError>(())
/// ```
pub fn fit_slope(x: &[f64], y: &[f64]) -> Result<PowerLaw, CurveError> {
    if x.len() != y.len() || x.len() < 2 {
        let (x, y) = (x.len(), y.len());
        return Err(CurveError::Length { x, y });
    }
    let (x, y) = (logarithms("abscissa", x)?, logarithms("ordinate", y)?);
    let count = x.len() as f64;
    let mean_x = x.iter().sum::<f64>() / count;
    let mean_y = y.iter().sum::<f64>() / count;
    let (mut xx, mut xy) = (0.0, 0.0);
    for (x, y) in x.iter().zip(&y) {
        xx += (x - mean_x).powi(2);
        xy += (x - mean_x) * (y - mean_y);
    }
    if x.iter().all(|next| *next == x[0]) {
        return Err(CurveError::OneAbscissa);
    }
    let exponent = xy / xx;
    let level = mean_y - exponent * mean_x;
    let residuals = x
        .iter()
        .zip(&y)
        .map(|(x, y)| (y - level - exponent * x).abs());
    Ok(PowerLaw {
        exponent,
        factor: level.exp(),
        worst_residual: residuals.fold(0.0, f64::max),
    })
}

fn logarithms(what: &'static str, numbers: &[f64]) -> Result<Vec<f64>, CurveError> {
    all_finite(what, numbers)?;
    let pairs = numbers.iter().enumerate();
    pairs
        .map(|(point, &value)| match value > 0.0 {
            true => Ok(value.ln()),
            false => Err(CurveError::NotPositive { what, value, point }),
        })
        .collect()
}
