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
        for extreme in ["ratio=1,1e6", "poisson=0.49999", "mass_ratio=1e6"] {
            for row in rows("stiff", &[&linear, &by, "cells=8", extreme]) {
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
                "steps=1",
                "cells=8,16,32,64",
            ],
        );
        let growth = rows.last().unwrap();
        assert_eq!(growth["case"], "growth");
        assert!(field(growth, "exponent") <= 0.6, "{growth}");
    }
}
