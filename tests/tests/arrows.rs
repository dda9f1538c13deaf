//! The direction of dependency between the crates.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::print_stdout,
    clippy::result_large_err,
    clippy::unwrap_used
)]

use std::collections::BTreeSet;
use std::process::Command;

/// Which of the workspace's crates a crate may use outside tests.
const ALLOWED: [(&str, &[&str]); 12] = [
    ("fissure-tensor", &[]),
    ("fissure-grid", &["fissure-tensor"]),
    ("fissure-particles", &["fissure-tensor"]),
    ("fissure-materials", &["fissure-tensor"]),
    (
        "fissure-scene",
        &["fissure-tensor", "fissure-particles", "fissure-materials"],
    ),
    (
        "fissure-solvers",
        &[
            "fissure-tensor",
            "fissure-grid",
            "fissure-particles",
            "fissure-materials",
            "fissure-scene",
        ],
    ),
    (
        "fissure-diagnostics",
        &[
            "fissure-tensor",
            "fissure-particles",
            "fissure-materials",
            "fissure-scene",
        ],
    ),
    (
        "fissure-io",
        &[
            "fissure-tensor",
            "fissure-grid",
            "fissure-particles",
            "fissure-scene",
        ],
    ),
    (
        "fissure",
        &[
            "fissure-tensor",
            "fissure-grid",
            "fissure-particles",
            "fissure-materials",
            "fissure-scene",
            "fissure-solvers",
            "fissure-diagnostics",
            "fissure-io",
        ],
    ),
    ("fissure-study", &[]),
    (
        "fissure-laws",
        &["fissure-tensor", "fissure-materials", "fissure-study"],
    ),
    (
        "fissure-studies",
        &["fissure", "fissure-study", "fissure-laws"],
    ),
];

#[test]
fn crates_depend_in_one_direction() {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--format-version",
            "1",
            "--no-deps",
            "--offline",
        ])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut seen = BTreeSet::new();
    for package in metadata["packages"].as_array().unwrap() {
        let name = package["name"].as_str().unwrap();
        let Some((name, allowed)) = ALLOWED.iter().find(|(listed, _)| *listed == name) else {
            continue;
        };
        seen.insert(*name);
        for dependency in package["dependencies"].as_array().unwrap() {
            let on = dependency["name"].as_str().unwrap();
            // Kind is null for a normal dependency; build scripts are held to the same.
            if dependency["kind"] != "dev" && on.starts_with("fissure") {
                assert!(allowed.contains(&on), "{name} depends on {on}");
            }
        }
    }
    assert_eq!(seen.len(), ALLOWED.len(), "found only {seen:?}");
}
