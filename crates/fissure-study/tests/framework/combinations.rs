//! From default cases and settings to the combinations that are run.

use crate::fake::Pull;
use fissure_study::{
    Form, Overrides, Parameter, ParameterError, Parameters, Permitted, Report, Study, StudyError,
    combinations,
};

fn cases(settings: &[&str], form: Form) -> Vec<Parameters> {
    let settings: Vec<String> = settings.iter().map(|text| (*text).to_owned()).collect();
    let overrides = Overrides::from_settings(Pull.name(), &Pull.parameters(), &settings).unwrap();
    combinations(&Pull, &overrides, form).unwrap()
}

fn shape_h_solver(cases: &[Parameters]) -> Vec<String> {
    cases
        .iter()
        .map(|case| {
            format!(
                "{} {} {}",
                case.choice("shape").unwrap(),
                case.number("h").unwrap(),
                case.choice("solver").unwrap()
            )
        })
        .collect()
}

#[test]
fn default_cases_expand_in_order() {
    assert_eq!(
        shape_h_solver(&cases(&[], Form::Standard)),
        [
            "linear 0.02 explicit",
            "linear 0.02 implicit",
            "linear 0.01 explicit",
            "linear 0.01 implicit",
            "linear 0.005 explicit",
            "linear 0.005 implicit",
            "linear 0.0025 explicit",
            "linear 0.0025 implicit",
            "quadratic 0.02 explicit",
            "quadratic 0.01 explicit",
        ]
    );
}

#[test]
fn one_setting_replaces_the_value_in_every_case() {
    assert_eq!(
        shape_h_solver(&cases(&["h=0.005"], Form::Standard)),
        [
            "linear 0.005 explicit",
            "linear 0.005 implicit",
            "quadratic 0.005 explicit"
        ]
    );
}

#[test]
fn cases_that_become_equal_run_once() {
    let cases = cases(&["shape=quadratic", "solver=explicit"], Form::Standard);
    assert_eq!(
        shape_h_solver(&cases),
        [
            "quadratic 0.02 explicit",
            "quadratic 0.01 explicit",
            "quadratic 0.005 explicit",
            "quadratic 0.0025 explicit",
        ]
    );
    assert_eq!(cases[0].varying(), ["h"]);
}

#[test]
fn lists_multiply_the_cases() {
    let cases = cases(&["angle=0,45", "solver=explicit"], Form::Standard);
    assert_eq!(cases.len(), 2 * (4 + 2));
    let rotated = |case: &&Parameters| case.number("angle").unwrap() == 45.0;
    assert_eq!(cases.iter().filter(rotated).count(), 6);
    assert!(
        cases
            .iter()
            .all(|case| case.choice("solver").unwrap() == "explicit")
    );
}

#[test]
fn a_parameter_that_names_the_case_chooses_among_the_default_cases() {
    let settings = |list: &[&str]| -> Overrides {
        let list: Vec<String> = list.iter().map(|text| (*text).to_owned()).collect();
        Overrides::from_settings("named", &Named.parameters(), &list).unwrap()
    };
    let run = |list: &[&str]| -> Vec<String> {
        let cases = combinations(&Named, &settings(list), Form::Standard).unwrap();
        cases.iter().map(ToString::to_string).collect()
    };
    let (short, long) = ("case=short length=1", "case=long length=9");
    assert_eq!(run(&[]), [short, long]);
    assert_eq!(run(&["case=long"]), [long]);
    assert_eq!(run(&["case=long,short"]), [short, long]);
    assert_eq!(run(&["case=short", "length=2"]), ["case=short length=2"]);
    // One that is not run by default has the defaults of the parameters.
    let both = run(&["case=odd,long"]);
    assert_eq!(both, [long, "case=odd length=5"]);
}

/// Two default cases with a length each, and a third name.
struct Named;

impl Study for Named {
    fn name(&self) -> &'static str {
        "named"
    }

    fn about(&self) -> &'static str {
        "cases by name"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let case = Parameter::choice("case", "which", "short", &["short", "long", "odd"]);
        let length = Parameter::number("length", "of it", "m", 5.0, Permitted::above(0.0));
        vec![case.selecting(), length]
    }

    fn default_cases(&self, _settings: &Overrides, _quick: bool) -> Vec<Overrides> {
        vec![
            // Its case is the default one.
            Overrides::new().set("length", 1.0),
            Overrides::new().set("case", "long").set("length", 9.0),
        ]
    }

    fn run(&self, _cases: &[Parameters], _report: &mut Report<'_>) -> Result<(), StudyError> {
        Ok(())
    }
}

#[test]
fn equal_values_written_differently_are_one() {
    let cases = cases(&["h=0.01,1e-2, 0.010", "angle=0,-0"], Form::Quick);
    assert_eq!(cases.len(), 1);
    assert_eq!(cases[0].label(), "default");
}

#[test]
fn quick_is_smaller_and_can_be_widened() {
    assert_eq!(cases(&[], Form::Quick).len(), 1);
    let cases = cases(&["h=0.1,0.2", "angle=10,20,30"], Form::Quick);
    assert_eq!(cases.len(), 6);
    assert_eq!(cases[0].label(), "h=0.1 angle=10");
    assert_eq!(cases[0].label_without(&["h"]), "angle=10");
}

#[test]
fn parameters_are_typed() {
    let case = &cases(&["threads=4"], Form::Quick)[0];
    assert_eq!(case.count("threads").unwrap(), 4);
    assert_eq!(case.size("threads").unwrap(), 4);
    assert_eq!(
        case.number("threads").unwrap_err().to_string(),
        "parameter 'threads' is declared as a count but used as a number"
    );
    assert_eq!(
        case.number("mass").unwrap_err(),
        ParameterError::NotDeclared("mass".to_owned())
    );
}

/// A study whose definition is wrong in the way the test chooses.
struct Misdefined {
    parameters: Vec<Parameter>,
    case: Overrides,
}

impl Study for Misdefined {
    fn name(&self) -> &'static str {
        "misdefined"
    }

    fn about(&self) -> &'static str {
        "a study that contradicts itself"
    }

    fn parameters(&self) -> Vec<Parameter> {
        self.parameters.clone()
    }

    fn default_cases(&self, _settings: &Overrides, _quick: bool) -> Vec<Overrides> {
        vec![self.case.clone()]
    }

    fn run(&self, _: &[Parameters], _: &mut Report<'_>) -> Result<(), StudyError> {
        Ok(())
    }
}

fn definition_error(parameters: Vec<Parameter>, case: Overrides) -> ParameterError {
    let study = Misdefined { parameters, case };
    match combinations(&study, &Overrides::new(), Form::Standard) {
        Err(StudyError::Definition(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_wrong_definition_is_an_error() {
    let h = || Parameter::number("h", "grid spacing", "m", 0.1, Permitted::above(0.0));
    for (parameters, case, message) in [
        (
            vec![h().sweep([0.0])],
            Overrides::new(),
            "parameter 'h': 0 is not in the permitted range (0, inf)",
        ),
        (
            vec![h().sweep([0.0; 0])],
            Overrides::new(),
            "parameter 'h' has an empty list of values",
        ),
        (
            vec![h(), h()],
            Overrides::new(),
            "parameter 'h' is declared twice",
        ),
        (
            vec![h()],
            Overrides::new().set("h", 1_u64),
            "parameter 'h' is declared as a number but used as a count",
        ),
        (
            vec![h()],
            Overrides::new().set("k", 1.0),
            "study 'misdefined' has no parameter 'k' (did you mean 'h'?); permitted: h",
        ),
    ] {
        assert_eq!(definition_error(parameters, case).to_string(), message);
    }
}
