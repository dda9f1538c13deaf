//! Distances between curves, and fits.

use fissure_diagnostics::{CurveError, curve_error, fit_slope};

#[test]
fn the_distance_is_the_integral_and_not_a_sum_over_samples() {
    // y = 0 against e = x over [0, 1]: all of it is error, however the samples lie.
    for x in [vec![0.0, 1.0], vec![-1.0, 0.9, 0.95, 3.0]] {
        let y = vec![0.0; x.len()];
        let error = curve_error(&x, &y, |x| x, (0.0, 1.0), &[]).unwrap();
        assert!((error - 1.0).abs() < 1e-14, "{error}");
    }
    // The chord of x² over [0, 1]: ∫(x − x²)² = 1/30, ∫x⁴ = 1/5.
    let error = curve_error(&[0.0, 1.0], &[0.0, 1.0], |x| x * x, (0.0, 1.0), &[]).unwrap();
    assert!((error - (1.0_f64 / 6.0).sqrt()).abs() < 1e-14, "{error}");
}

#[test]
fn breakpoints_make_jumps_exact() {
    let step = |x: f64| if x < 1.0 / 3.0 { 2.0 } else { 1.0 };
    // y = 1: ∫(y − e)² = 1/3, ∫e² = 4/3 + 2/3.
    let error = |breaks: &[f64]| curve_error(&[0.0, 1.0], &[1.0, 1.0], step, (0.0, 1.0), breaks);
    let exact = (1.0_f64 / 6.0).sqrt();
    assert!((error(&[1.0 / 3.0, 7.0]).unwrap() - exact).abs() < 1e-14);
    assert!((error(&[]).unwrap() - exact).abs() > 1e-3);
}

#[test]
fn what_cannot_be_compared_is_said() {
    let one = |_: f64| 1.0;
    let error = |x: &[f64], y: &[f64]| curve_error(x, y, one, (0.0, 1.0), &[]);
    assert_eq!(
        error(&[0.0], &[1.0]),
        Err(CurveError::Length { x: 1, y: 1 })
    );
    assert_eq!(
        error(&[0.0, 0.5, 0.4, 1.0], &[1.0; 4]),
        Err(CurveError::Falling { point: 2 })
    );
    let nan = error(&[0.0, 0.5, 1.0], &[1.0, f64::NAN, 1.0]);
    assert!(matches!(nan, Err(CurveError::NotFinite { point: 1, .. })));
    assert!(matches!(
        error(&[0.1, 1.0], &[1.0, 1.0]),
        Err(CurveError::Range { .. })
    ));
    let lines = (&[0.0, 1.0], &[0.0, 1.0]);
    let against = |exact: f64| curve_error(lines.0, lines.1, move |_| exact, (0.0, 1.0), &[]);
    assert_eq!(against(0.0), Err(CurveError::ZeroCurve));
    assert!(matches!(
        against(f64::NAN),
        Err(CurveError::NotFinite { .. })
    ));
    for range in [(1.0, 0.0), (0.0, f64::NAN), (f64::NAN, 1.0)] {
        let refused = curve_error(lines.0, lines.1, one, range, &[]);
        assert!(matches!(refused, Err(CurveError::Range { .. })));
    }
}

#[test]
fn slopes_are_those_of_least_squares() {
    let x = [1.0, 2.0, 4.0];
    let fit = fit_slope(&x, &x.map(|x: f64| 3.0 * x.powf(-1.5))).unwrap();
    assert!((fit.exponent + 1.5).abs() < 1e-14 && (fit.factor - 3.0).abs() < 1e-13);
    assert!(fit.worst_residual < 1e-14);
    // The middle point off by a factor: slope unchanged, residual ⅔ of its logarithm.
    let fit = fit_slope(&x, &[1.0, 2.0 * 1.1, 4.0]).unwrap();
    assert!((fit.exponent - 1.0).abs() < 1e-14);
    assert!((fit.worst_residual - 2.0 / 3.0 * 1.1_f64.ln()).abs() < 1e-14);
    assert_eq!(
        fit_slope(&[2.0, 2.0], &[1.0, 3.0]),
        Err(CurveError::OneAbscissa)
    );
    assert!(matches!(
        fit_slope(&[1.0, 2.0], &[1.0, 0.0]),
        Err(CurveError::NotPositive { point: 1, .. })
    ));
    assert!(fit_slope(&[1.0, 2.0], &[1.0, f64::NAN]).is_err());
}
