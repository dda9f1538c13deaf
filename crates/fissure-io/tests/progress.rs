//! Progress where nobody looks.
#![cfg(feature = "progress")]

use std::process::Command;

use fissure_io::progress::Progress;
use fissure_scene::{Plane, Report, Scene, Watch};

/// Run by [`nothing_is_written_without_a_terminal`] in a process of its own.
#[test]
#[ignore = "the other test runs it with its stderr in a pipe"]
fn a_run() {
    let scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let mut progress = Progress::new(1.0, "bar");
    for step in 1..=100 {
        let report = Report {
            step,
            time: 0.01 * step as f64,
            dt: 0.01,
            ..Report::default()
        };
        progress.after(&scene, &report).unwrap();
    }
}

#[test]
fn nothing_is_written_without_a_terminal() {
    let test = std::env::current_exe().unwrap();
    let output = Command::new(test)
        .args(["--exact", "a_run", "--ignored", "--nocapture"])
        .output()
        .unwrap();
    assert!(output.status.success());
    let written = String::from_utf8_lossy(&output.stdout);
    assert!(written.contains("1 passed"), "{written}");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}
