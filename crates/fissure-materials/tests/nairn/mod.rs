//! Reads the reference histories.

#![allow(dead_code)] // each test file uses its part

use std::path::Path;

use fissure_materials::{Matrix3, Softening, Sym};

/// One row of a history.
pub struct Row {
    /// Its number in the whole history.
    pub number: usize,
    pub gradient: Matrix3<f64>,
    /// MPa.
    pub stress: Sym,
    /// MPa.
    pub dissipated: f64,
    pub state: f64,
}

/// A history of one material point.
pub struct History {
    pub rows: Vec<Row>,
}

impl History {
    /// The file of this name in `tests/data/nairn`.
    pub fn read(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/data/nairn")
            .join(format!("{name}.csv"));
        let text = std::fs::read_to_string(&path).expect("a reference file");
        let mut lines = text.lines();
        let names: Vec<_> = lines.next().expect("a header").split(',').collect();
        let rows = lines.map(|line| row(&names, line)).collect();
        Self { rows }
    }

    /// Number of the first row with a failed crack.
    pub fn fails_at(&self) -> Option<usize> {
        let failed = self.rows.iter().find(|row| row.state >= 2.0);
        failed.map(|row| row.number)
    }
}

fn row(names: &[&str], line: &str) -> Row {
    let values: Vec<f64> = line
        .split(',')
        .map(|v| v.parse().expect("a number"))
        .collect();
    let value = |name: &str, missing: f64| {
        let index = names.iter().position(|n| *n == name);
        index.map_or(missing, |i| values[i])
    };
    let axes = ["x", "y", "z"];
    Row {
        number: value("row", f64::NAN) as usize,
        gradient: Matrix3::from_fn(|i, j| {
            let identity = if i == j { 1.0 } else { 0.0 };
            value(&format!("F{}{}", axes[i], axes[j]), identity)
        }),
        stress: Sym::new(
            value("sxx", 0.0),
            value("syy", 0.0),
            value("szz", 0.0),
            value("syz", 0.0),
            value("sxz", 0.0),
            value("sxy", 0.0),
        ),
        dissipated: value("dissipated", f64::NAN),
        state: value("state", f64::NAN),
    }
}

/// `e^{−s}`, of unit area.
#[derive(Clone, Copy, Debug)]
pub struct Exponential;

impl Softening for Exponential {
    fn ratio(&self, s: f64) -> f64 {
        (-s).exp()
    }
    fn slope(&self, s: f64) -> f64 {
        -(-s).exp()
    }
    fn area(&self, s: f64) -> f64 {
        -(-s).exp_m1()
    }
    fn critical(&self) -> f64 {
        f64::INFINITY
    }
    fn steepest(&self) -> f64 {
        1.0
    }
}
