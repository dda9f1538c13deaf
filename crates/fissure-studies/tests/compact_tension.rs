//! The compact-tension specimen, coarse, through the command line.

mod common;

use common::{number, rows};

#[test]
fn one_plane_dissipates_its_toughness_and_several_planes_more() {
    let settings = ["h=0.025", "elongation=6", "speed=0.1", "rise=0.0005"];
    let of = |failure| {
        let all = [&settings[..], &[failure]].concat();
        rows("compact-tension", &all).remove(0)
    };
    let ideal = of("failure=ideal");
    let error = number(&ideal, "errors", "energy_per_area");
    assert!(error <= 2e-3, "{error} in {ideal}");
    let multiple = of("failure=multiple");
    let planes = number(&multiple, "values", "most_planes");
    let spent = |row| number(row, "values", "energy_per_area");
    let (one, several) = (spent(&ideal), spent(&multiple));
    assert!(planes >= 2.0, "{planes} in {multiple}");
    assert!(
        several >= 1.02 * one,
        "{one} on one plane, {several} on several"
    );
    for row in [&ideal, &multiple] {
        let imbalance = number(row, "values", "energy_imbalance");
        assert!(imbalance.abs() <= 0.05, "{imbalance} in {row}");
    }
}

/// X14: a specimen that has split goes on in finite steps, carries nothing and makes no energy.
#[test]
fn x14_a_specimen_that_has_split_goes_on() {
    let settings = [
        "failure=multiple",
        "faces=free",
        "h=0.025",
        "ligament=0.15",
        "elongation=24",
        "speed=0.1",
        "rise=0.0005",
    ];
    let row = rows("compact-tension", &settings).remove(0);
    let value = |name| number(&row, "values", name);
    assert!(value("failed_ligament") >= 0.9, "{row}");
    assert!(value("last_load").abs() <= 0.05, "{row}");
    assert!(value("energy_imbalance").abs() <= 2e-3, "{row}");
    assert!(value("stored_per_area") <= 1.0, "{row}");
}
