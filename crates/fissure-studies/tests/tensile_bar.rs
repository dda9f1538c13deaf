//! The tensile bar against its exact solution, through the command line.
#![allow(clippy::unwrap_used)] // A test that cannot go on has failed.

mod common;

use common::{number, rows};
use serde_json::Value;

fn assert_within(row: &Value, bounds: &[(&str, f64)]) {
    for (error, bound) in bounds {
        let found = number(row, "errors", error);
        assert!(
            found <= *bound,
            "{error} = {found} is over {bound} in {row}"
        );
    }
    let imbalance = number(row, "values", "energy_imbalance");
    assert!(imbalance <= 0.01, "energy_imbalance = {imbalance} in {row}");
}

#[test]
fn quasi_static_bar_follows_the_exact_curve() {
    let rows = rows(
        "tensile-bar",
        &["solver=quasi-static", "shape=linear", "h=0.005"],
    );
    assert_eq!(rows.len(), 1);
    assert_within(
        &rows[0],
        &[
            ("load_l2", 0.03),
            ("peak", 0.03),
            ("work", 0.02),
            ("dissipated", 0.02),
        ],
    );
    let zone = number(&rows[0], "values", "failed_zone_cells");
    assert!(
        (zone - 1.0).abs() <= 1e-9,
        "the failed zone is {zone} cells wide"
    );
}

/// On the document's finest grid, h⁻¹ = 400.
#[test]
fn quasi_static_bar_is_within_a_hundredth_on_the_finest_grid() {
    let settings = [
        "solver=quasi-static",
        "shape=linear",
        "h=0.0025",
        "steps=40",
    ];
    let rows = rows("tensile-bar", &settings);
    assert_within(&rows[0], &[("load_l2", 0.01)]);
}

#[test]
fn implicit_bar_agrees_with_the_one_in_equilibrium() {
    let rows = rows(
        "tensile-bar",
        &["solver=implicit", "shape=linear", "h=0.01", "angle=0"],
    );
    assert_eq!(rows.len(), 1);
    assert_within(
        &rows[0],
        &[
            ("load_l2", 0.03),
            ("peak", 0.01),
            ("work", 0.01),
            ("dissipated", 0.01),
        ],
    );
}

#[test]
fn explicit_bar_follows_the_exact_curve() {
    let rows = rows(
        "tensile-bar",
        &["solver=explicit", "shape=linear", "h=0.005"],
    );
    assert_eq!(rows.len(), 1);
    assert_within(
        &rows[0],
        &[
            ("load_l2", 0.05),
            ("peak", 0.03),
            ("work", 0.02),
            ("dissipated", 0.02),
        ],
    );
}

#[test]
fn other_constants_and_sizes_are_as_right() {
    let rows = rows(
        "tensile-bar",
        &[
            "solver=quasi-static",
            "shape=linear",
            "h=0.005",
            "young=30e9,35e9",
            "poisson=0.25",
            "strength=3e6",
            "toughness=100",
            "length=0.15",
            "width=0.05",
            "depth=0.1",
            "weakening=0.8",
        ],
    );
    assert_eq!(rows.len(), 2, "a comma list makes one row per value");
    for row in &rows {
        assert_within(
            row,
            &[("load_l2", 0.03), ("work", 0.02), ("dissipated", 0.02)],
        );
    }
}

#[test]
fn the_particles_size_as_band_dissipates_twice() {
    let rows = rows(
        "tensile-bar",
        &[
            "solver=quasi-static",
            "shape=linear",
            "h=0.01",
            "band=particle",
        ],
    );
    let ratio = number(&rows[0], "values", "dissipated_ratio");
    assert!(
        (ratio - 2.0).abs() <= 0.01,
        "dissipated over W D G_f: {ratio}"
    );
}

#[test]
fn a_bar_at_45_degrees_locks_as_in_the_document() {
    let rows = rows(
        "tensile-bar",
        &["solver=quasi-static", "shape=linear", "h=0.01", "angle=45"],
    );
    let error = number(&rows[0], "errors", "load_l2");
    let work = number(&rows[0], "errors", "work");
    assert!(
        error >= 0.5 && work >= 0.5,
        "load_l2 {error}, work {work}: has the locking gone?"
    );
}

#[test]
fn elastic_bar_is_exact_when_aligned_and_converges_when_turned() {
    let rows = rows("tensile-bar", &["case=elastic", "angle=0,30", "fill=cell"]);
    let (slopes, runs): (Vec<&Value>, Vec<&Value>) =
        rows.iter().partition(|row| row["case"] == "elastic slopes");
    assert_eq!((slopes.len(), runs.len()), (4, 8));
    for run in runs.iter().filter(|run| run["parameters"]["angle"] == 0.0) {
        let error = number(run, "errors", "gauge_load");
        assert!(error <= 1e-6, "aligned: {error}");
    }
    let turned = slopes
        .iter()
        .find(|row| row["angle"] == 30.0 && row["measure"] == "gauge_load")
        .unwrap();
    let slope = turned["slope"].as_f64().unwrap();
    assert!(slope >= 0.757, "Table 5.2 less 0.1; found {slope}");
}
