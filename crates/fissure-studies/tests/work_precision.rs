//! Error against run time: the quick form, through the command line.
#![allow(clippy::unwrap_used)] // A test that cannot go on has failed.

mod common;

use common::rows;

#[test]
fn the_frontier_holds_what_nothing_beats() {
    let settings = [
        "problem=axis-aligned-mms",
        "h=0.125,0.0625",
        "shape=linear,cpdi",
        "transfer=flip",
        "update=musl",
        "cfl=0.4",
        "solver=explicit",
        "steps=1",
        "integration=theta",
        "repeats=1",
    ];
    let rows = rows("work-precision", &settings);
    let efficient: Vec<_> = rows
        .iter()
        .filter(|row| row["case"] == "efficient")
        .collect();
    assert_eq!(rows.len() - efficient.len(), 4);
    let errors: Vec<f64> = efficient
        .iter()
        .map(|row| row["error"].as_f64().unwrap())
        .collect();
    assert!(
        !errors.is_empty() && errors.is_sorted_by(|a, b| a > b),
        "{errors:?}"
    );
    // The most exact run of all is efficient, whatever it takes: CPDI on the finer grid.
    let best = efficient.last().unwrap();
    assert!(
        best["scheme"].as_str().unwrap().contains("cpdi") && best["h"] == 0.0625,
        "{best}"
    );
}
