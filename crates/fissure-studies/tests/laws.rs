//! The studies of constitutive laws, through the command line.
#![allow(clippy::unwrap_used)] // A test that cannot go on has failed.

use std::fs;

use fissure_laws::LAWS;
use fissure_studies::studies;
use fissure_study::execute;
use serde_json::Value;

/// Exit code, rows and messages of a command.
fn run(arguments: &[&str]) -> (u8, Vec<Value>, String) {
    let (mut output, mut messages) = (Vec::new(), Vec::new());
    let all = ["fissure-studies", "--json"]
        .iter()
        .chain(arguments)
        .copied();
    let code = execute(&studies(), all, &mut output, &mut messages);
    let rows = String::from_utf8(output).unwrap();
    let rows = rows.lines().map(|line| serde_json::from_str(line).unwrap());
    (code, rows.collect(), String::from_utf8(messages).unwrap())
}

fn rows(arguments: &[&str]) -> Vec<Value> {
    let (code, rows, messages) = run(arguments);
    assert_eq!(code, 0, "{messages}");
    rows
}

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or(f64::NAN)
}

/// The laws with the spaces in which they are offered.
fn offered() -> usize {
    let in_plane_stress = LAWS.iter().filter(|entry| entry.plane_stress).count();
    LAWS.len() + in_plane_stress
}

#[test]
fn nothing_that_must_not_happens_in_any_law() {
    let rows = rows(&["laws", "--quick"]);
    assert_eq!(rows.len(), offered());
    for row in &rows {
        assert_eq!(number(row, "updates"), 20_000.0);
        for count in [
            "not_finite",
            "panics",
            "negative_dissipation",
            "irreversibility_violations",
        ] {
            assert_eq!(number(row, count), 0.0, "{count} in {row}");
        }
        let refused = number(row, "typed_errors") / number(row, "sound");
        assert!(refused <= 0.01, "{row}");
        let name = row["law"].as_str().unwrap();
        assert!(number(row, "tangent_error_max") <= 1e-5, "{row}");
        let numerical = number(row, "tangents_numerical");
        let told = match row["tangent"].as_str().unwrap() {
            "analytic" => numerical == 0.0,
            "numerical" => numerical == number(row, "tangents"),
            "both" => numerical > 0.0 && numerical < number(row, "tangents"),
            _ => false,
        };
        assert!(told, "{row}");
        if row["energy_error_max"].is_number() {
            assert!(number(row, "energy_error_max") <= 1e-6, "{row}");
        }
        assert!(number(row, "ratio_to_elastic") > 0.0, "{row}");
        if name == "decohesive" {
            assert!(number(row, "failed") > 1000.0, "{row}");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_counts() {
    let counts = |seed: &str| {
        let seed = format!("seed={seed}");
        let row = &rows(&[
            "laws",
            "--quick",
            "--set",
            "law=decohesive",
            "--set",
            "space=solid",
            "--set",
            &seed,
            "--set",
            "updates=5000",
            "--set",
            "paths=5",
        ])[0];
        ["sound", "cracked", "failed", "tangent_error_max"].map(|name| number(row, name))
    };
    assert_eq!(counts("4"), counts("4"));
    assert_ne!(counts("4"), counts("5"));
}

#[test]
fn a_point_is_driven_by_name_and_draws_its_curve() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let rows = rows(&[
        "point",
        "--set",
        "path=uniaxial-strain",
        "--set",
        "steps=50",
        "--out",
        out,
    ]);
    let (events, samples): (Vec<&Value>, Vec<&Value>) =
        rows.iter().partition(|row| row["event"].is_string());
    assert_eq!(samples.len(), 50);
    let last = samples[49];
    let width = number(last, "cracking_xx") - number(last, "strain_xx");
    assert!(
        width.abs() < 1e-12,
        "all of the strain is the crack's: {last}"
    );
    assert_eq!(number(last, "failed"), 1.0);
    // The energy of the band is the toughness.
    let energy = number(last, "dissipated") / number(samples[0], "stored");
    assert!(energy > 1.0);
    let kinds: Vec<_> = events
        .iter()
        .map(|row| row["event"].as_str().unwrap())
        .collect();
    assert_eq!(kinds, ["initiation", "failure"]);
    assert!(folder.path().join("stress-strain.png").exists());
    assert!(folder.path().join("rows.csv").exists());
}

#[test]
fn a_file_of_gradients_is_followed_and_missing_columns_are_the_identity() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("path.csv");
    fs::write(&file, "Fxx,Fxy\n1.0001,0\n1.0002,0.0001\n").unwrap();
    let file = format!("file={}", file.to_str().unwrap());
    let csv = ["point", "--set", "path=csv", "--set", &file];
    let rows = rows(&[&csv[..], &["--set", "law=hencky", "--set", "young=1e9"]].concat());
    assert_eq!(rows.len(), 2);
    assert!((number(&rows[0], "strain_xx") - 1e-4).abs() < 1e-15);
    let shear = 1e9 / (2.0 * 1.18) * 1e-4;
    assert!((number(&rows[1], "stress_xy") / shear - 1.0).abs() < 1e-3);
    let (code, _, messages) = run(&["point", "--set", "path=csv"]);
    assert_eq!(code, 2, "{messages}");
    fs::write(folder.path().join("path.csv"), "Fxx,Gxy\n1.0,0\n").unwrap();
    let (code, _, messages) = run(&csv);
    assert!(code == 2 && messages.contains("Gxy"), "{messages}");
}

#[test]
fn a_law_refuses_what_it_does_not_have_and_what_is_out_of_range() {
    let (code, _, messages) = run(&["point", "--set", "law=hencky", "--set", "toughness=60"]);
    assert!(
        code == 2 && messages.contains("density, young, poisson"),
        "{messages}"
    );
    let (code, _, _) = run(&["point", "--set", "poisson=0.7"]);
    assert_eq!(code, 2);
    // Over the limit of the band the point does not start.
    let (code, rows, messages) = run(&["point", "--set", "band=10"]);
    assert!(
        code == 1 && rows.is_empty() && messages.contains("limit"),
        "{messages}"
    );
}

/// What no source gives has no default: the concrete does not depend on the rate, or all four are given.
#[test]
fn unpublished_parameters_are_all_given_or_none() {
    let concrete = ["point", "--set", "law=viscous-damage"];
    assert_eq!(run(&concrete).0, 0);
    let some = ["--set", "lag=5e-5", "--set", "rate_exponent=0.8"];
    let (code, _, messages) = run(&[&concrete[..], &some].concat());
    assert!(
        code == 2 && messages.contains("rate_curvature"),
        "{messages}"
    );
    let rest = [
        "--set",
        "rate_curvature=0",
        "--set",
        "relaxation_exponent=1",
    ];
    let (code, rows, messages) = run(&[&concrete[..], &some, &rest].concat());
    assert!(code == 0 && !rows.is_empty(), "{messages}");
}

/// Every parameter that a choice brings in reaches the law.
#[test]
fn choices_of_laws_reach_them() {
    let refused = |arguments: &[&str], named: &str| {
        let (code, _, messages) = run(&[&["point"], arguments].concat());
        assert!(code == 2 && messages.contains(named), "{messages}");
    };
    let geological = ["--set", "law=geological-flow", "--set"];
    refused(
        &[&geological[..], &["biaxial_strength=21e6"]].concat(),
        "biaxial",
    );
    refused(
        &[&geological[..], &["confined_shear_strength=1e6"]].concat(),
        "confined",
    );
    let damage = ["--set", "law=anisotropic-damage", "--set"];
    let power = ["curve=power-law", "--set", "exponent=0.5"];
    refused(&[&damage[..], &power].concat(), "exponent");
    for choice in ["mixed=uncoupled", "curve=cubic-step", "shear_exponent=2"] {
        let (code, _, messages) = run(&[&["point"], &damage[..], &[choice]].concat());
        assert_eq!(code, 0, "{messages}");
    }
}

#[test]
fn maps_are_drawn_and_their_errors_are_what_the_laws_state() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let rows = rows(&["isoerror", "--quick", "--out", out]);
    assert_eq!(rows.len(), 2 * LAWS.len());
    for row in &rows {
        assert_eq!(number(row, "refused"), 0.0, "{row}");
        let bound = number(row, "error_stated") + 1e-8;
        assert!(number(row, "error_max") <= bound, "{row}");
        let name = row["law"].as_str().unwrap();
        let picture = format!("isoerror-{name}-from-{}.png", number(row, "level"));
        assert!(folder.path().join(picture).exists());
    }
}
