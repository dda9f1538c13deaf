//! Figures reach their files whole, hold what was asked for, and are refused by name.

#![cfg(feature = "plots")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests are tests"
)]

use std::fs;
use std::path::Path;

use fissure_io::plot::{ColourMap, LinePlot, PlotError, ScatterPlot, Style};

fn curve() -> LinePlot<'static> {
    let xs: Vec<f64> = (0..300).map(|step| 1e-7 * f64::from(step)).collect(); // m
    let ys: Vec<f64> = xs.iter().map(|x| 9e9 * x * (-x / 8e-6).exp()).collect(); // N
    LinePlot::new("Notched beam")
        .x_label("deflection [m]")
        .y_label("force [N]")
        .series("computed", xs.clone(), ys.clone(), Style::Dashed)
        .series("measured", xs, ys, Style::Markers)
}

fn bar() -> (Vec<[f64; 2]>, Vec<f64>) {
    let place = |index: u32| [f64::from(index % 40) * 5e-3, f64::from(index / 40) * 5e-3];
    let positions: Vec<[f64; 2]> = (0..480).map(place).collect();
    let damage = positions
        .iter()
        .map(|x| (-((x[0] - 0.1) / 0.01).powi(2)).exp())
        .collect();
    (positions, damage)
}

/// Width and height a PNG states in its first chunk.
fn size(path: &Path) -> (u32, u32) {
    let bytes = fs::read(path).unwrap();
    assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n"));
    let word = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    (word(16), word(20))
}

#[test]
fn a_curve_is_drawn_in_both_formats() {
    let folder = tempfile::tempdir().unwrap();
    let (png, svg) = (folder.path().join("a.png"), folder.path().join("a.SVG"));
    curve().save(&png).unwrap();
    assert_eq!(
        size(&png),
        (1800, 1200),
        "two pixels for each of the figure's"
    );
    curve().size(600, 400).save(&png).unwrap();
    assert_eq!(size(&png), (1200, 800));
    curve().save(&svg).unwrap();
    let text = fs::read_to_string(&svg).unwrap();
    for expected in [
        "Notched beam",
        "deflection [10⁻⁶ m]",
        "force [10³ N]",
        "computed",
        "measured",
    ] {
        assert!(text.contains(expected), "{expected}");
    }
    assert!(!text.contains("NaN") && !text.contains("inf"));
    curve().without_legend().save(&svg).unwrap();
    assert!(!fs::read_to_string(&svg).unwrap().contains("computed"));
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        2,
        "nothing temporary stays behind"
    );
}

#[test]
fn logarithmic_axes_leave_out_what_they_cannot_show() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("newton.svg");
    let residual = [10.0, 1e-2, 1e-7, 1e-15, 0.0, f64::NAN];
    let step = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
    let plot = LinePlot::new("").y_label("residual [N]").log_y().series(
        "",
        &step,
        &residual,
        Style::LineAndMarkers,
    );
    plot.save(&svg).unwrap();
    let text = fs::read_to_string(&svg).unwrap();
    assert!(text.contains("10⁻¹⁵") && !text.contains("NaN") && !text.contains("inf"));
    let error = plot.log_x().x_range(0.0, 5.0).save(&svg).unwrap_err();
    assert!(
        matches!(error, PlotError::Range { low: 0.0, .. }),
        "{error}"
    );
}

#[test]
fn a_body_keeps_its_shape() {
    let folder = tempfile::tempdir().unwrap();
    let png = folder.path().join("bar.png");
    let (positions, damage) = bar();
    ScatterPlot::new("Bar", &positions)
        .colour("damage [-]", &damage)
        .range(0.0, 1.0)
        .save(&png)
        .unwrap();
    let (width, height) = size(&png);
    assert!(
        width == 1800 && height < 1000,
        "a long bar needs no square: {width} by {height}"
    );
    let upright: Vec<[f64; 2]> = positions.iter().map(|x| [x[1], x[0]]).collect();
    ScatterPlot::new("Bar", &upright)
        .colour("damage [-]", &damage)
        .colour_map(ColourMap::Greys)
        .save(&png)
        .unwrap();
    let (width, height) = size(&png);
    assert!(height == 1800 && width < 1400, "{width} by {height}");
}

#[test]
fn odd_fields_are_drawn_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("odd.svg");
    let cases: [(&[[f64; 2]], &[f64]); 4] = [
        (&[[0.0, 0.0]], &[1.0]),
        (&[[0.0, 0.0], [1.0, 0.0]], &[f64::NAN, f64::NAN]),
        (
            &[[1e-9, 0.0], [f64::NAN, 0.0], [2e-9, 1e-9]],
            &[-3.0, 0.0, f64::INFINITY],
        ),
        (&[[5.0, 5.0]; 3], &[0.0; 3]),
    ];
    for (points, values) in cases {
        ScatterPlot::new("", points)
            .colour("field [Pa]", values)
            .save(&svg)
            .unwrap();
        let text = fs::read_to_string(&svg).unwrap();
        assert!(!text.contains("NaN") && !text.contains("inf"), "{points:?}");
        ScatterPlot::new("", points).save(&svg).unwrap();
    }
}

#[test]
fn what_is_wrong_is_named_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let error = curve().save(folder.path().join("a.pdf")).unwrap_err();
    assert!(
        matches!(error, PlotError::Extension { .. }) && error.to_string().contains("a.pdf"),
        "{error}"
    );
    let error = LinePlot::new("")
        .series("short", &[1.0, 2.0], &[1.0], Style::Line)
        .save(&path)
        .unwrap_err();
    assert!(
        matches!(&error, PlotError::Length { series, xs: 2, ys: 1, .. } if series == "short"),
        "{error}"
    );
    let error = LinePlot::new("")
        .series("nothing", &[f64::NAN], &[1.0], Style::Line)
        .save(&path)
        .unwrap_err();
    assert!(matches!(error, PlotError::Empty { .. }), "{error}");
    let error = curve().y_range(1.0, 1.0).save(&path).unwrap_err();
    assert!(matches!(error, PlotError::Range { .. }), "{error}");

    let points = [[0.0, 0.0], [1.0, 1.0]];
    let error = ScatterPlot::new("", &points)
        .colour("damage", &[1.0])
        .save(&path)
        .unwrap_err();
    assert!(
        matches!(error, PlotError::Length { xs: 2, ys: 1, .. }),
        "{error}"
    );
    let error = ScatterPlot::new("", Vec::new()).save(&path).unwrap_err();
    assert!(matches!(error, PlotError::Empty { .. }), "{error}");
    let error = ScatterPlot::new("", &points)
        .range(1.0, 0.0)
        .save(&path)
        .unwrap_err();
    assert!(matches!(error, PlotError::Range { .. }), "{error}");
    assert!(!path.exists());
}
