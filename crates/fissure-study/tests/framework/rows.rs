//! The forms in which rows are delivered.

use std::fs;
use std::io::{self, Write};

use crate::fake::{Pull, obey};
use fissure_study::{Study, execute};

#[test]
fn json_rows_are_alone_on_standard_output() {
    let outcome = obey("pull-bar --json --set angle=0,30 --set h=0.01");
    assert_eq!(outcome.code, 0);
    let rows = outcome.json();
    assert_eq!(rows.len(), 6);
    for row in &rows {
        for field in [
            "study",
            "case",
            "solver",
            "shape",
            "transfer",
            "h",
            "threads",
            "particles",
            "steps",
            "wall_s",
            "errors",
            "values",
            "state_hash",
        ] {
            assert!(row.get(field).is_some(), "{field}");
        }
    }
    assert_eq!(rows[1]["case"], "angle=30");
    assert_eq!(rows[1]["parameters"]["poisson"], 0.3);
    assert!(outcome.messages.contains("case 6 of 6\n"));
    assert!(outcome.messages.contains("order of convergence: 2\n"));
}

#[test]
fn a_simulation_row_keeps_its_order_and_marks_what_is_not_finite() {
    let outcome = obey("pull-bar --json --quick");
    assert_eq!(
        outcome.output,
        "{\"study\":\"pull-bar\",\"case\":\"default\",\"solver\":\"explicit\",\
         \"shape\":\"linear\",\"transfer\":\"flip\",\"h\":0.02,\"threads\":1,\
         \"particles\":400,\"steps\":12,\"wall_s\":1.25,\
         \"errors\":{\"displacement\":0.0004,\"energy\":null},\
         \"values\":{\"peak\":null},\"state_hash\":\"0000000000000abc\",\
         \"parameters\":{\"shape\":\"linear\",\"h\":0.02,\"solver\":\"explicit\",\
         \"poisson\":0.3,\"angle\":0.0,\"threads\":1}}\n"
    );
}

#[test]
fn the_table_is_aligned() {
    let outcome = obey("pull-bar --set h=0.0025,0.01 --set shape=linear --set angle=0,45");
    assert_eq!(outcome.code, 0);
    let lines: Vec<&str> = outcome.output.lines().collect();
    assert_eq!(lines[0], "pull-bar: a bar that nobody pulls");
    assert_eq!(
        lines[2],
        "case      solver    shape   transfer         h   threads  particles     steps    \
         wall_s  error.displacement  error.energy      peak  state_hash"
    );
    assert_eq!(
        lines[3],
        "angle=0   explicit  linear  flip        0.0025         1        400        12      \
         1.25             6.25e-6          !NaN      !inf  0000000000000abc"
    );
    assert!(lines[4].starts_with("angle=45  explicit  linear  flip        0.0025 "));
    assert_eq!(lines.len(), 3 + 8 + 1);
    assert_eq!(lines[11], "order of convergence: 2");
}

#[test]
fn other_rows_show_the_parameters_that_vary() {
    let outcome = obey("broken --set young=1e6,2e6");
    assert_eq!(
        outcome.output,
        "broken: a study that fails\n\n   \
         young      load     profile  converged\n     \
         1e6       0.5  [0.1 !NaN]  yes\n     \
         2e6       0.5  [0.1 !NaN]  yes\n"
    );
}

#[test]
fn files_are_written_only_when_asked_for() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("deep/er");
    let refused = obey(&format!("broken --set young=-1 --out {}", out.display()));
    assert_eq!(refused.code, 2);
    assert!(!out.exists());

    let outcome = obey(&format!("broken --out {} --json", out.display()));
    assert_eq!(outcome.code, 1);
    let lines = fs::read_to_string(out.join("rows.jsonl")).unwrap();
    assert_eq!(lines, outcome.output);
    assert_eq!(
        fs::read_to_string(out.join("rows.csv")).unwrap(),
        "study,load,profile,converged,parameters.young\n\
         broken,0.5,0.1 NaN,true,210000000000\n"
    );
}

#[test]
fn an_unusable_directory_is_named() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let outcome = obey(&format!("pull-bar --quick --out {}", file.path().display()));
    assert_eq!(outcome.code, 1);
    let named = format!("caused by: cannot write {}\n", file.path().display());
    assert!(outcome.messages.contains(&named), "{}", outcome.messages);
}

/// Standard output whose reader has gone.
struct Closed(io::ErrorKind);

impl Write for Closed {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(self.0.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_reader_that_leaves_is_no_failure_but_a_full_disk_is() {
    for (kind, code) in [
        (io::ErrorKind::BrokenPipe, 0),
        (io::ErrorKind::StorageFull, 1),
    ] {
        let studies: Vec<Box<dyn Study>> = vec![Box::new(Pull)];
        let mut messages = Vec::new();
        let arguments = ["fissure-studies", "pull-bar"];
        let outcome = execute(&studies, arguments, &mut Closed(kind), &mut messages);
        assert_eq!(outcome, code);
        assert_eq!(messages.is_empty(), code == 0);
    }
}
