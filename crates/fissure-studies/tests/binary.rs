//! The binary itself, and that every study in it is well defined.

use std::process::Command;

use fissure_studies::studies;
use fissure_study::{Form, Overrides, combinations};

#[test]
fn exit_codes_of_the_process() {
    for (arguments, code) in [
        (&["--list"][..], 0),
        (&[], 0),
        (&["no-such-study"], 2),
        (&["--no-such-flag"], 2),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_fissure-studies"))
            .args(arguments)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        assert_eq!(output.stderr.is_empty(), code == 0, "{arguments:?}");
    }
}

#[test]
fn every_study_is_well_defined() {
    let studies = studies();
    for (position, study) in studies.iter().enumerate() {
        let name = study.name();
        assert!(studies[..position].iter().all(|other| other.name() != name));
        let full = study.full_cases(&Overrides::new()).map(|_| Form::Full);
        for form in [Form::Standard, Form::Quick].into_iter().chain(full) {
            let cases = combinations(study.as_ref(), &Overrides::new(), form).unwrap();
            assert!(!cases.is_empty(), "{name} runs nothing");
        }
    }
}
