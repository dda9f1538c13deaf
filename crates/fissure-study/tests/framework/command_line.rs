//! The command line: listings, refusals and exit codes.

use crate::fake::obey;
use serde_json::json;

#[test]
fn lists_the_studies() {
    let outcome = obey("--list");
    assert_eq!(outcome.code, 0);
    assert_eq!(
        outcome.output,
        "pull-bar  a bar that nobody pulls\nbroken    a study that fails\n"
    );
    assert_eq!(
        obey("--list --json").json()[0],
        json!({"study": "pull-bar", "about": "a bar that nobody pulls"})
    );
}

#[test]
fn without_a_study_the_list_and_the_usage_appear() {
    let outcome = obey("");
    assert_eq!(outcome.code, 0);
    assert!(outcome.output.starts_with("pull-bar "));
    assert!(outcome.output.contains("Usage: fissure-studies"));
}

#[test]
fn parameters_for_people() {
    let outcome = obey("pull-bar --params");
    assert_eq!(outcome.code, 0);
    assert_eq!(
        outcome.output,
        "\
pull-bar: a bar that nobody pulls

parameter  unit  default                 permitted           meaning
shape      -     linear,quadratic        linear, quadratic   shape functions
h          m     0.02,0.01,0.005,0.0025  (0, inf)            grid spacing
solver     -     explicit,implicit       explicit, implicit  time integration
poisson    1     0.3                     (-1, 0.5)           Poisson's ratio
angle      deg   0                       [-90, 90]           grid rotation
threads    1     1                       [1, 64]             worker threads

the default run has 10 combinations
"
    );
    let quick = obey("pull-bar --params --quick").output;
    assert!(quick.ends_with("the quick run has 1 combination\n"));
}

#[test]
fn parameters_as_json() {
    let lines = obey("pull-bar --params --json").json();
    assert_eq!(lines.len(), 6);
    assert_eq!(
        lines[1],
        json!({
            "name": "h", "meaning": "grid spacing", "unit": "m",
            "default": [0.02, 0.01, 0.005, 0.0025], "permitted": "(0, inf)",
        })
    );
    assert_eq!(lines[2]["permitted"], json!(["explicit", "implicit"]));
    assert_eq!(lines[5]["default"], json!(1));
}

#[test]
fn bad_input_is_named_on_standard_error() {
    for (line, message) in [
        (
            "pull-bar --set poisson=0.6",
            "error: parameter 'poisson': 0.6 is not in the permitted range (-1, 0.5)\n",
        ),
        (
            "pull-bar --set poisson=0.2,0.6 --params",
            "error: parameter 'poisson': 0.6 is not in the permitted range (-1, 0.5)\n",
        ),
        (
            "pull-bar --set poison=0.2",
            "error: study 'pull-bar' has no parameter 'poison' (did you mean 'poisson'?); \
             permitted: shape, h, solver, poisson, angle, threads\n",
        ),
        (
            "pull-bar --set h",
            "error: '--set h' is not of the form name=value or name=value,value,...\n",
        ),
        (
            "pull-bar --set h=1 --set h=2",
            "error: parameter 'h' is set twice; give several values as one list, \
             h=first,second\n",
        ),
        (
            "pull-bar --set h=0.1,",
            "error: parameter 'h': '' is not a finite number; the permitted range is (0, inf)\n",
        ),
        (
            "pul-bar",
            "error: there is no study 'pul-bar' (did you mean 'pull-bar'?); \
             the studies are: pull-bar, broken\n",
        ),
    ] {
        let outcome = obey(line);
        assert_eq!(outcome.messages, message);
        assert_eq!(outcome.code, 2, "{line}");
        assert_eq!(outcome.output, "", "{line}");
    }
}

#[test]
fn a_refused_combination_is_bad_input_with_its_cause() {
    let outcome = obey("pull-bar --set angle=90 --set solver=implicit --quick");
    assert_eq!(outcome.code, 2);
    assert!(outcome.messages.ends_with(
        "error: study 'pull-bar' failed\n  \
         caused by: solver=implicit angle=90: the bar would lie on its side\n"
    ));
}

#[test]
fn the_full_form_is_refused_by_a_study_without_one() {
    for rest in ["", " --params"] {
        let outcome = obey(&format!("pull-bar --full{rest}"));
        assert_eq!(outcome.code, 2);
        assert!(outcome.messages.ends_with(
            "caused by: study 'pull-bar' has no full form: its default run is all there is; --set refines it\n"
        ));
    }
    assert_eq!(obey("pull-bar --full --quick").code, 2);
    let full = obey("broken --params --full");
    assert!(full.output.ends_with("the full run has 3 combinations\n"));
}

#[test]
fn a_failed_study_tells_the_whole_chain() {
    let outcome = obey("broken --json");
    assert_eq!(outcome.code, 1);
    assert_eq!(
        outcome.messages,
        "error: study 'broken' failed\n  \
         caused by: cannot pull the bar\n  \
         caused by: the bar snapped\n"
    );
    assert_eq!(outcome.json().len(), 1);
}

#[test]
fn usage_errors_and_help() {
    for line in [
        "--wrong",
        "--params",
        "--quick",
        "--list pull-bar",
        "pull-bar extra",
    ] {
        let outcome = obey(line);
        assert_eq!(outcome.code, 2, "{line}");
        assert_eq!(outcome.output, "", "{line}");
        assert!(outcome.messages.starts_with("error: "), "{line}");
    }
    let help = obey("--help");
    assert_eq!((help.code, help.messages.as_str()), (0, ""));
    assert!(help.output.contains("--set <NAME=VALUE>"));
}
