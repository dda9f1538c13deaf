//! The quick forms of the studies of Nairn 2017, sec. 3, through the command line.
#![allow(clippy::unwrap_used)] // A test that cannot go on has failed.

mod common;

use common::{drawn, number, rows};
use serde_json::Value;

/// The pictures of a quick `random-block`.
const BLOCKS: [&str; 5] = [
    "strength.png",
    "curves.png",
    "correlated-h-1-mm-field.png",
    "correlated-h-1-mm-failed.png",
    "error-against-time.png",
];

/// Rows of a study that draws these pictures, into a folder of its own.
fn pictured(study: &str, settings: &[&str], pictures: &[&str]) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    drawn(study, settings, folder.path(), pictures)
}

fn assert_at_most(row: &Value, group: &str, bounds: &[(&str, f64)]) {
    for (name, bound) in bounds {
        let found = number(row, group, name).abs();
        assert!(found <= *bound, "{name} = {found} is over {bound} in {row}");
    }
}

#[test]
fn bars_start_to_fail_at_their_strength() {
    let pictures = [
        "stress-plane.png",
        "stress-space.png",
        "tension-gimp-xpic-any-4.png",
        "error-against-time-necking.png",
    ];
    let rows = pictured("uniaxial", &["--quick"], &pictures);
    let cases: Vec<&str> = rows
        .iter()
        .map(|row| row["parameters"]["case"].as_str().unwrap())
        .collect();
    assert_eq!(cases, ["tension", "necking", "compression", "circle"]);
    for row in &rows {
        let bounds: &[(&str, f64)] = match row["parameters"]["case"].as_str().unwrap() {
            // The particle that fails first follows its law to the end.
            "tension" => &[
                ("peak", 0.02),
                ("law", 0.05),
                // Its Kirchhoff stress is that of the law, ours 1 + ε times as much.
                ("reference_peak", 0.04),
                ("reference_stress", 0.015),
            ],
            _ => &[("peak", 0.05)],
        };
        assert_at_most(row, "errors", bounds);
        assert_eq!(number(row, "values", "reached"), 1.0, "{row}");
    }
    // Through failure in tension, where the halves ring; what softens without failing closes better.
    for (row, imbalance) in rows.iter().zip([3e-3, 1.5e-4, 1.5e-4, 3e-4]) {
        let bounds = [("worst_balance", 1e-12), ("energy_imbalance", imbalance)];
        assert_at_most(row, "values", &bounds);
    }
    let tension = &rows[0];
    // One column of particles, 12 of them, has failed all across.
    assert_eq!(number(tension, "values", "failed_particles"), 12.0);
    // The cracks of the round bar contain z: it becomes a chisel, thinner along y alone, straight across its middle.
    let round = |name: &str| number(&rows[3], "values", name);
    assert!(round("neck") < 0.6, "{}", rows[3]);
    assert!((round("neck_width_z") - 1.0).abs() < 0.05, "{}", rows[3]);
    assert!((round("neck_place") - 0.5).abs() < 0.1, "{}", rows[3]);
    assert!(round("neck_angle_y_deg").abs() < 5.0, "{}", rows[3]);
}

#[test]
fn cases_of_bars_are_chosen_by_name() {
    let settings = ["--quick", "case=compression,tension", "strain=0.004"];
    let rows = rows("uniaxial", &settings);
    let of = |row: &Value, name: &str| row["parameters"][name].clone();
    let found: Vec<Value> = rows.iter().map(|row| of(row, "case")).collect();
    assert_eq!(found, ["tension", "compression"]);
    // Each with its own length.
    assert_eq!(
        (of(&rows[0], "length"), of(&rows[1], "length")),
        (0.04.into(), 0.03.into())
    );
}

/// Where the independent code stops early: CPDI and plane stress; and quadratic B-splines.
#[test]
fn a_bar_necks_to_the_end_with_other_shapes_and_in_plane_stress() {
    let kinds = [
        ["shape=cpdi,bspline2", "plane=strain"],
        ["shape=gimp", "plane=stress"],
    ];
    let mut count = 0;
    for [shape, plane] in kinds {
        let necking = ["--quick", "case=necking", "h=0.0015", "length=0.039"];
        let settings = [&necking[..], &[shape, plane]].concat();
        for row in rows("uniaxial", &settings) {
            assert_eq!(number(&row, "values", "reached"), 1.0, "{row}");
            assert!(number(&row, "values", "neck") < 0.5, "{row}");
            assert_at_most(&row, "errors", &[("peak", 0.05)]);
            let bounds = [("worst_balance", 1e-12), ("energy_imbalance", 2e-4)];
            assert_at_most(&row, "values", &bounds);
            count += 1;
        }
    }
    assert_eq!(count, 3);
}

/// Fig. 4B: sections of 8 × 2 mm and 6 × 6 mm.
#[test]
fn bars_of_rectangular_and_square_section_neck() {
    let rows = rows(
        "uniaxial",
        &["--quick", "case=rectangle,square", "h=0.002", "length=0.02"],
    );
    assert_eq!(rows.len(), 2);
    for row in &rows {
        assert_eq!(number(row, "values", "reached"), 1.0, "{row}");
        assert!(number(row, "values", "neck") < 0.6, "{row}");
        // The square is three cells wide: it necks in one of them.
        assert_at_most(row, "errors", &[("peak", 0.15)]);
        let bounds = [("worst_balance", 1e-12), ("energy_imbalance", 4e-4)];
        assert_at_most(row, "values", &bounds);
    }
}

#[test]
fn a_notch_grows_in_two_rows() {
    let pictures = ["length.png", "speed.png", "load.png"];
    let rows = pictured("edge-notch", &["--quick", "mode=damage"], &pictures);
    assert_eq!(rows.len(), 1);
    let row = &rows[0];
    let (onset, speed) = (
        number(row, "values", "onset_us"),
        number(row, "values", "speed_m_s"),
    );
    assert!(onset > 20.0 && onset < 40.0, "{row}");
    // Below the speed of Rayleigh's waves, 0.93 of the shear waves'.
    assert!(speed > 100.0 && speed < 901.0, "{row}");
    // Both rows of particles of a cell fail, and each takes the toughness [Nairn 2017, sec. 3.2].
    let failed = number(row, "values", "failed_rows");
    assert!((failed - 2.0).abs() <= 0.15, "{row}");
    let ratio = number(row, "values", "dissipated_per_area") / 600.0;
    assert!((2.0..2.6).contains(&ratio), "{row}");
    assert_at_most(
        row,
        "values",
        &[("worst_balance", 1e-12), ("energy_imbalance", 8e-4)],
    );
}

/// Specimens of the document on coarse cells: only of those are errors known.
#[test]
fn errors_are_drawn_against_the_time_they_take() {
    let notch = ["mode=damage", "h=0.0025,0.00125"];
    let pictures = ["error-against-time.png", "30-MPa-600-h-1.25-stress.png"];
    let rows = pictured("edge-notch", &notch, &pictures);
    assert_eq!(rows.len(), 2);
    for row in &rows {
        assert_at_most(row, "errors", &[("onset", 0.2)]);
    }
    let coating = ["h=0.002", "seed=1", "strain=0.006"];
    pictured("coating", &coating, &["error-against-time.png"]);
}

#[test]
fn a_line_grows_when_j_reaches_the_toughness() {
    let rows = rows("edge-notch", &["--quick", "mode=explicit"]);
    assert_eq!(rows.len(), 1);
    let row = &rows[0];
    // Damage of the same toughness costs 2.2 times as much and starts at 30 µs.
    let onset = number(row, "values", "onset_us");
    assert!((onset / 21.5 - 1.0).abs() < 0.05, "{row}");
    let speed = number(row, "values", "speed_m_s");
    assert!(speed > 300.0 && speed < 901.0, "{row}");
    assert!(number(row, "values", "length_mm") > 17.0, "{row}");
    // Nothing is dissipated in the body: no cost of the crack is to be read from the ledger.
    assert!(row["values"]["dissipated_per_area"].is_null(), "{row}");
    let bounds = [("worst_balance", 1e-12), ("energy_imbalance", 0.018)];
    assert_at_most(row, "values", &bounds);
}

#[test]
fn a_crack_is_arrested_at_another_which_then_grows_across() {
    let pictures = ["paths.png", "explicit-plate.png"];
    let rows = pictured("interacting-cracks", &["--quick"], &pictures);
    let row = &rows[0];
    let time = |name: &str| number(row, "values", name);
    let (onset, arrest, restart) = (time("onset_us"), time("arrest_us"), time("restart_us"));
    assert!(onset > 15.0 && arrest > onset && restart > arrest, "{row}");
    for tip in ["lower", "upper"] {
        // At right angles to the second crack, which is along the load.
        assert!(time(&format!("{tip}_growth_mm")) > 3.0, "{row}");
        assert!(time(&format!("{tip}_angle_deg")) < 15.0, "{row}");
    }
    let [lower, upper] = ["lower_growth_mm", "upper_growth_mm"].map(time);
    assert!((lower / upper - 1.0).abs() < 0.1, "{row}");
    // The faces of lines are pressed together behind the tips.
    let bounds = [("worst_balance", 1e-12), ("energy_imbalance", 0.05)];
    assert_at_most(row, "values", &bounds);
}

#[test]
fn growth_by_damage_costs_two_rows_and_a_wake() {
    let pictures = [
        "onset.png",
        "load.png",
        "explicit-particle-cells-h-1-damage.png",
        "quasi-static-particle-cells-h-2-damage.png",
        "quasi-static-discretisation-cells-h-1-damage.png",
        "resistance.png",
        "error-against-time.png",
    ];
    let rows = pictured("apparent-toughness", &["--quick"], &pictures);
    let value = |name| number(&rows[0], "values", name);
    assert!((value("failed_rows") - 2.0).abs() < 0.15, "{}", rows[0]);
    // Each failed row takes the toughness.
    assert!((value("spent_by_failed") / value("failed_rows") - 1.0).abs() < 0.1);
    // Of steady growth: the zone that softens ahead of the tip is no part of it.
    let wake = value("spent_by_wake");
    assert!(wake > 0.0 && wake < 0.3, "{}", rows[0]);
    assert!(
        value("far_j_at_onset") > value("spent_by_failed"),
        "{}",
        rows[0]
    );
    // In equilibrium growth asks for less than onset: two rows, and what is stored in the zone moves on with the tip.
    let still = |name| number(&rows[1], "values", name);
    assert!(still("length_mm") >= 3.6, "{}", rows[1]);
    assert!((still("failed_rows") - 2.0).abs() < 0.1, "{}", rows[1]);
    assert!((still("spent") - 2.0).abs() < 0.2, "{}", rows[1]);
    let (onset, grown) = (still("far_j_at_onset"), still("far_j_grown"));
    assert!(
        onset < 4.0 && grown < 0.95 * onset && grown > still("spent"),
        "{}",
        rows[1]
    );
    // With the band of the discretisation it is the toughness at which damage grows in equilibrium.
    assert!(
        number(&rows[2], "values", "length_mm") >= 1.0,
        "{}",
        rows[2]
    );
    for name in ["far_j_at_onset", "far_j_grown"] {
        let still = number(&rows[2], "values", name);
        assert!((still - 1.0).abs() < 0.12, "{}", rows[2]);
    }
    let bounds = [("worst_balance", 1e-12), ("energy_imbalance", 4.5e-4)];
    assert_at_most(&rows[0], "values", &bounds);
    for (row, bound) in rows[1..].iter().zip([1.1e-3, 2e-3]) {
        assert_at_most(row, "values", &[("energy_imbalance", bound)]);
    }
}

#[test]
fn without_scatter_the_strength_of_a_block_does_not_depend_on_the_grid() {
    let set = [
        "--quick",
        "field=uncorrelated",
        "deviation=1e-4",
        "samples=2",
    ];
    let rows = rows("random-block", &set);
    // What the plate holds, h/length of the block, was missing: 10 % on the coarse grid.
    for row in &rows[..2] {
        let strength = number(row, "values", "mean_over_nominal");
        assert!((strength - 1.0).abs() < 0.035, "{row}");
    }
}

#[test]
fn a_coating_cracks_several_times() {
    let pictures = ["cracks.png", "xpic-5-seed-1-1.png"];
    let rows = pictured("coating", &["--quick"], &pictures);
    assert_eq!(rows.len(), 3, "two runs and their mean");
    for row in &rows {
        let onset = number(row, "values", "onset_strain");
        assert!(onset > 1e-3 && onset < 0.01, "{row}");
        let cracks = row["values"]["cracks"].as_array().unwrap();
        assert!(cracks.last().unwrap()[1].as_f64().unwrap() >= 3.0, "{row}");
        let strains = cracks.iter().map(|step| step[0].as_f64().unwrap());
        assert!(strains.is_sorted(), "{row}");
    }
    for row in &rows[..2] {
        let bounds = [("worst_balance", 1e-12), ("energy_imbalance", 9e-3)];
        assert_at_most(row, "values", &bounds);
    }
}

#[test]
fn correlation_lowers_the_strength_of_a_block() {
    let folder = tempfile::tempdir().unwrap();
    let settings = ["--quick"];
    let first = drawn("random-block", &settings, folder.path(), &BLOCKS);
    let (sets, tests) = first.split_at(4);
    assert_eq!(tests.len(), 4);
    for set in sets {
        let mean = number(set, "values", "mean_over_nominal");
        // Waves across five cells of 2 mm add 3 %.
        assert!(mean > 0.9 && mean < 1.035, "{set}");
        assert_eq!(number(set, "values", "reached"), 1.0);
    }
    for test in tests.iter().filter(|test| {
        let name = test["test"].as_str().unwrap();
        name.starts_with("correlated against")
    }) {
        assert!(test["mean_difference"].as_f64().unwrap() < 0.0, "{test}");
        assert!(test["variance_ratio"].as_f64().unwrap() > 1.0, "{test}");
    }
    // What is on file is not run again, and gives the same rows.
    let samples = std::fs::read_to_string(folder.path().join("samples.txt")).unwrap();
    let second = drawn("random-block", &settings, folder.path(), &BLOCKS);
    let again = std::fs::read_to_string(folder.path().join("samples.txt")).unwrap();
    assert_eq!(samples, again);
    for (one, other) in first.iter().zip(&second) {
        assert_eq!(one["values"]["mean"], other["values"]["mean"]);
        assert_eq!(one["variances_F"], other["variances_F"]);
    }
}

#[test]
fn the_limit_of_every_softening_law_is_that_of_equation_36() {
    let rows = pictured("stability-eta", &["--quick"], &["pulled.png"]);
    assert_eq!(rows.len(), 14);
    for row in &rows {
        assert_at_most(
            row,
            "errors",
            &[
                ("limit", 1.1e-3),
                ("accepted", 1e-12),
                ("dissipated", 1e-12),
            ],
        );
        // Below the limit the traction is continuous: half the step, a smaller jump.
        let jump = number(row, "values", "largest_jump");
        assert!(
            number(row, "values", "jump_halved_steps") < 0.75 * jump,
            "{row}"
        );
        // Above it, the strain would have to go back.
        assert!(number(row, "values", "snap_back_above") > 0.0, "{row}");
    }
}
