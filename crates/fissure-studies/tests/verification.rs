//! The problems with known answers, coarse: errors and observed orders, through the command line.
#![allow(clippy::unwrap_used)] // A test that cannot go on has failed.

mod common;

use common::{drawn, number, rows};
use serde_json::Value;

/// The order of a measure over `h` in the row of orders.
fn order(rows: &[Value], measure: &str) -> f64 {
    let row = rows
        .iter()
        .find(|row| row["over"] == "h" && row["measure"] == measure)
        .unwrap();
    row["order"].as_f64().unwrap_or(f64::NAN)
}

/// Runs a study with settings and holds the finest run's errors and the orders to bounds.
fn holds(study: &str, settings: &[&str], errors: &[(&str, f64)], orders: &[(&str, f64)]) {
    let rows = rows(study, settings);
    let finest = rows.iter().rfind(|row| row["errors"].is_object()).unwrap();
    for (name, bound) in errors {
        let error = number(finest, "errors", name);
        assert!(
            error <= *bound,
            "{name} = {error} is over {bound} in {finest}"
        );
    }
    for (name, bound) in orders {
        let order = order(&rows, name);
        assert!(order >= *bound, "{name} has order {order}, under {bound}");
    }
}

/// Explicit runs of the axis-aligned waves on two grids: of the default cases those in space alone.
fn explicit_waves(shape: &'static str) -> [&'static str; 12] {
    [
        shape,
        "h=0.0625,0.03125",
        "cfl=0.4",
        "update=musl",
        "margin=0",
        "transfer=flip",
        "amplitude=0.05",
        "solver=explicit",
        "steps=1",
        "integration=theta",
        "weight=1",
        "spectral_radius=0.8",
    ]
}

#[test]
fn axis_aligned_waves_converge_with_second_order_on_cpdi() {
    holds(
        "axis-aligned-mms",
        &explicit_waves("shape=cpdi"),
        &[("place_l2", 0.02), ("stress_l2", 0.04)],
        &[("place_l2", 1.7)],
    );
}

#[test]
fn linear_functions_do_not_converge_where_particles_cross_cells() {
    let settings = explicit_waves("shape=linear");
    let rows = rows("axis-aligned-mms", &settings);
    assert!(order(&rows, "place_l2") <= 0.0, "have they learnt to?");
}

/// θ is of first order, Newmark and generalised α of second, where particles stay in their cells.
#[test]
fn schemes_in_time_have_their_orders() {
    for (integration, bounds) in [
        ("theta", 0.7..1.1),
        ("newmark", 1.8..2.2),
        ("generalized-alpha", 1.8..2.2),
    ] {
        let integration = format!("integration={integration}");
        let settings = [
            "solver=implicit",
            "amplitude=1e-4",
            "h=0.03125",
            "shape=linear",
            "steps=4,8,16",
            "weight=1",
            "spectral_radius=0.8",
            "transfer=flip",
            "margin=0",
            "update=musl",
            "cfl=0.4",
            &integration,
        ];
        let rows = rows("axis-aligned-mms", &settings);
        let of = |row: &&Value| row["over"] == "steps" && row["measure"] == "place_l2";
        let order = rows.iter().find(of).unwrap()["order"].as_f64().unwrap();
        assert!(bounds.contains(&order), "{integration}: {order}");
    }
}

#[test]
fn the_vortex_of_small_amplitude_is_followed() {
    holds(
        "vortex-mms",
        &[
            "shape=bspline2",
            "h=0.125,0.0625",
            "transfer=flip",
            "amplitude=0.1",
            "cfl=0.4",
            "solver=explicit",
            "steps=1",
            "integration=theta",
        ],
        &[("place_l2", 0.05)],
        &[("place_l2", 1.0)],
    );
}

#[test]
fn a_spinning_disc_has_its_stress_at_the_centre() {
    holds(
        "disc-spin",
        &[
            "solver=quasi-static",
            "shape=linear",
            "h=0.2,0.1",
            "transfer=flip",
        ],
        &[("centre", 0.02), ("stress_l2", 0.1)],
        &[],
    );
}

#[test]
fn a_bar_vibrates_with_its_frequency() {
    for ends in ["ends=free-free", "ends=fixed-free"] {
        let settings = [
            ends,
            "shape=linear",
            "h=0.125,0.0625",
            "cfl=0.4",
            "update=musl",
            "transfer=flip",
            "solver=explicit",
            "steps=1",
            "integration=newmark",
            "weight=1",
        ];
        holds(
            "bar-vibration",
            &settings,
            &[("frequency", 0.01), ("energy", 0.01)],
            &[("frequency", 1.8)],
        );
    }
}

#[test]
fn a_bar_vibrates_with_its_frequency_in_implicit_steps_of_second_order() {
    let settings = [
        "ends=free-free",
        "shape=linear",
        "h=0.0625",
        "cfl=0.4",
        "update=musl",
        "transfer=flip",
        "solver=implicit",
        "steps=400,800,1600",
        "integration=newmark",
        "weight=1",
    ];
    let rows = rows("bar-vibration", &settings);
    let finest = rows.iter().rfind(|row| row["errors"].is_object()).unwrap();
    assert!(number(finest, "errors", "frequency") <= 0.01, "{finest}");
    assert!(number(finest, "errors", "energy") <= 1e-3, "{finest}");
    let change = |row: &&Value| row["measure"] == "change_of_positions";
    let order = rows.iter().find(change).unwrap()["order"].as_f64();
    assert!(order.unwrap() >= 1.8, "{order:?}");
}

#[test]
fn a_cantilever_bends_as_the_elastica() {
    holds("cantilever", &["h=0.05"], &[("deflection", 0.05)], &[]);
}

#[test]
fn cooks_membrane_compressible() {
    holds(
        "cook",
        &["material=compressible", "shape=linear", "h=4,2"],
        &[("displacement", 0.02)],
        &[("displacement", 1.2)],
    );
}

#[test]
fn cooks_membrane_locks_when_nearly_incompressible() {
    let rows = rows(
        "cook",
        &["material=nearly-incompressible", "shape=linear", "h=2"],
    );
    let error = number(&rows[0], "errors", "displacement");
    assert!(error >= 0.2, "{error}: has the locking gone?");
}

/// X2: with one volume change per cell at least 95 % of the displacement.
#[test]
fn cooks_membrane_does_not_lock_with_averaged_volume_changes() {
    let settings = [
        "material=nearly-incompressible",
        "shape=linear",
        "h=4",
        "volume=patch",
        "poisson=0.49,0.499,0.4999,0.49999",
    ];
    let rows = rows("cook", &settings);
    let found: Vec<f64> = rows
        .iter()
        .filter(|row| row["errors"].is_object())
        .map(|row| number(row, "values", "u_y"))
        .collect();
    assert_eq!(found.len(), 4);
    assert!(found.iter().all(|way| *way >= 0.95 * 7.7), "{found:?}");
}

#[test]
fn a_pressed_disc_has_the_stresses_of_hondros() {
    holds(
        "brazilian",
        &["shape=linear", "h=0.2,0.1"],
        &[("diameter_l2", 0.1), ("centre_along", 0.03)],
        &[("diameter_l2", 1.0)],
    );
}

#[test]
fn waves_that_meet_open_a_crack_as_fast_as_they_should() {
    let settings = [
        "energy=area",
        "shape=linear",
        "h=0.024390243902439025,0.012345679012345678",
        "transfer=flip",
    ];
    holds(
        "softening-wave",
        &settings,
        &[("rate", 0.05), ("dissipated", 0.06)],
        &[("dissipated", 0.5)],
    );
}

#[test]
fn two_discs_touch_when_their_edges_do() {
    holds(
        "two-discs",
        &["h=0.05", "contact=coulomb"],
        &[("touch", 0.05), ("momentum", 1e-13), ("energy_lost", 0.06)],
        &[],
    );
}

/// Holds every row of `stress-intensity` with these settings to bounds.
fn intensities(settings: &[&str], errors: &[(&str, f64)]) {
    domains(settings, errors, f64::INFINITY);
}

/// The same, and how far domains around the tip may differ in J.
fn domains(settings: &[&str], errors: &[(&str, f64)], spread: f64) {
    let mut count = 0;
    for row in rows("stress-intensity", settings) {
        if row["over"].is_string() {
            continue;
        }
        for (name, bound) in errors {
            let error = number(&row, "errors", name);
            assert!(error <= *bound, "{name} = {error} is over {bound} in {row}");
        }
        let found = number(&row, "values", "contour_spread");
        assert!(spread.is_infinite() || found <= spread, "{found} in {row}");
        count += 1;
    }
    assert!(count > 0, "nothing was run");
}

#[test]
fn cracks_have_their_intensity_wherever_in_a_cell_their_tips_are() {
    let one = ["solver=quasi-static", "angle=45", "friction=0", "h=0.002"];
    for case in ["case=centre", "case=edge"] {
        let settings = [&one[..], &[case, "part=0,0.25,0.5,0.75"]].concat();
        // The bars are 2 % and 0.5 %.
        let errors = [("k1", 0.005), ("k2", 1e-9), ("j", 0.01)];
        domains(&settings, &errors, 5e-4);
    }
}

/// NAFEMS R0020, 1.1 and 2.1: the bar is 2 %.
#[test]
fn cracked_squares_have_the_targets_of_nafems() {
    for case in ["case=centre-square", "case=edge-square"] {
        let settings = [case, "solver=quasi-static", "h=0.002", "part=0.5"];
        domains(&settings, &[("k1", 0.01), ("j", 0.02)], 0.005);
    }
}

/// The bar of both intensities is 2 % of the larger.
#[test]
fn an_inclined_crack_has_both_intensities() {
    let settings = ["case=inclined", "h=0.004", "part=0.5", "angle=22.5,45,67.5"];
    domains(&settings, &[("k1", 0.02), ("k2", 0.02), ("j", 0.03)], 0.005);
}

#[test]
fn a_crack_that_stress_opens_has_the_profile_of_sneddon() {
    let settings = ["case=sneddon", "h=0.004", "part=0.5"];
    let errors = [("opening", 0.03), ("volume", 0.03), ("k1", 0.02)];
    domains(&settings, &errors, 0.005);
}

#[test]
fn every_case_has_its_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let settings = [
        "case=centre,sneddon",
        "h=0.00625",
        "part=0.5",
        "solver=quasi-static",
    ];
    let pictures = [
        "field-centre.png",
        "field-sneddon.png",
        "history-sneddon.png",
        "error-against-h.png",
        "error-against-time.png",
    ];
    let rows = drawn("stress-intensity", &settings, folder.path(), &pictures);
    assert_eq!(rows.len(), 2);
}

/// Faces in touch that part node by node from the loaded end had stayed together over half of the crack, under any load.
#[test]
fn the_arms_of_a_cantilever_open_as_beams_do() {
    for load in ["load=0.01", "load=1"] {
        let settings = ["case=cantilever", load, "h=0.0005", "part=0.25"];
        domains(
            &settings,
            &[("k1", 0.01), ("j", 0.01), ("opening", 0.003)],
            0.005,
        );
    }
}

#[test]
fn an_edge_crack_that_is_pulled_slowly_has_its_intensity() {
    let settings = [
        "case=edge",
        "solver=explicit",
        "angle=45",
        "friction=0",
        "part=0.5",
        "cfl=0.8",
        "h=0.0125",
    ];
    // The bar; the crack is four cells long.
    intensities(&settings, &[("k1", 0.03), ("k2", 1e-3)]);
}

#[test]
fn a_closed_crack_does_not_open_and_slides_against_friction() {
    let settings = [
        "case=closed",
        "solver=quasi-static",
        "angle=45",
        "part=0.25",
        "h=0.00625",
        "friction=0,0.3",
    ];
    // Eight cells: J is that of the sliding.
    intensities(&settings, &[("k1", 0.02), ("k2", 0.06), ("j", 0.07)]);
}

#[test]
fn a_step_of_load_raises_the_intensity_with_the_root_of_time() {
    let settings = [
        "case=step",
        "solver=explicit",
        "angle=45",
        "friction=0",
        "part=0.25",
        "h=0.004",
    ];
    // With inertia, and the bar of domains in equilibrium.
    let errors = [("k1", 0.03), ("k2", 1e-9), ("j", 0.03)];
    domains(&settings, &errors, 0.005);
}
