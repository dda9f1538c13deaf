//! Studies run through the command line, and their rows.
#![allow(clippy::unwrap_used, dead_code)] // Each test binary uses its part.

use std::path::Path;

use fissure_studies::studies;
use fissure_study::execute;
use serde_json::Value;

/// Result rows of a study with settings and flags, as JSON.
pub fn rows(study: &str, settings: &[&str]) -> Vec<Value> {
    let mut arguments = vec!["fissure-studies", study, "--json"];
    for setting in settings {
        if !setting.starts_with("--") {
            arguments.push("--set");
        }
        arguments.push(setting);
    }
    let (mut output, mut messages) = (Vec::new(), Vec::new());
    let code = execute(&studies(), arguments, &mut output, &mut messages);
    assert_eq!(code, 0, "{}", String::from_utf8_lossy(&messages));
    let text = String::from_utf8(output).unwrap();
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// The same with files in a folder, among them these pictures.
pub fn drawn(study: &str, settings: &[&str], folder: &Path, pictures: &[&str]) -> Vec<Value> {
    let out = format!("--out={}", folder.to_str().unwrap());
    let rows = rows(study, &[settings, &[&out]].concat());
    for picture in pictures {
        let bytes = std::fs::read(folder.join(picture)).unwrap_or_default();
        assert!(bytes.starts_with(b"\x89PNG"), "{study} drew no {picture}");
    }
    rows
}

/// A number of a row; a missing or non-finite one is NaN, which no bound holds for.
pub fn number(row: &Value, group: &str, name: &str) -> f64 {
    row[group][name].as_f64().unwrap_or(f64::NAN)
}
