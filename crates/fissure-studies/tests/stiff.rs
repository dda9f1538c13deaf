//! The linear systems of implicit steps, through the command line.
#![allow(clippy::unwrap_used)] // A test that cannot go on has failed.

mod common;

use common::{number, rows};
use serde_json::Value;

fn field(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or(f64::NAN)
}

/// X1 and X2: unlike neighbours and near incompressibility, by factorisation and by iteration.
#[test]
fn every_solver_finds_the_same_displacements() {
    let schemes = [
        ("direct", "none", 0.0),
        ("cg", "incomplete", 400.0),
        ("gmres", "node-blocks", 3000.0),
    ];
    for (linear, preconditioner, most) in schemes {
        let (linear, by) = (
            format!("linear_solver={linear}"),
            format!("preconditioner={preconditioner}"),
        );
        let plain = ["ratio=1", "poisson=0.3", "mass_ratio=1"];
        for (place, extreme) in ["ratio=1,1e6", "poisson=0.49999", "mass_ratio=1e6"]
            .into_iter()
            .enumerate()
        {
            let mut settings = plain;
            settings[place] = extreme;
            let [a, b, c] = settings;
            let dt = "dt_ratio=100";
            let steps = "steps=3";
            for row in rows("stiff", &[&linear, &by, "cells=8", dt, steps, a, b, c]) {
                assert_eq!(row["converged"], Value::Bool(true), "{row}");
                assert!(number(&row, "errors", "l2") <= 1e-4, "{row}");
                assert!(field(&row, "iterations") <= most, "{row}");
            }
        }
    }
}

/// Over three refinements iterations grow no faster than N^0.6; GMRES keeps all its directions (400).
#[test]
fn iterations_grow_slowly() {
    for linear in ["cg", "gmres"] {
        let linear = format!("linear_solver={linear}");
        let rows = rows(
            "stiff",
            &[
                &linear,
                "preconditioner=incomplete",
                "dt_ratio=1e4",
                "ratio=1",
                "mass_ratio=1",
                "poisson=0.3",
                "steps=1",
                "cells=8,16,32,64",
            ],
        );
        let mut growths = rows.iter().filter(|row| row["case"] == "growth");
        let growth = growths.next().unwrap();
        assert_eq!(growth["unknowns"].as_array().unwrap().len(), 4, "{growth}");
        let exponent = field(growth, "exponent");
        assert!(exponent > 0.3 && exponent <= 0.6, "{growth}");
    }
}
