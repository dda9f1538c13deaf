//! Two lines of the bar that are equally weak, or nearly so: which branch is followed.
//!
//! Two equal lines in series may both open, with twice the critical elongation and energy (the symmetric
//! branch), or one opens and the other unloads. The second needs less work: the first is unstable.
//! An imperfection makes one line a little less weak; the branch found must not depend on it as it goes
//! to zero.

use fissure_study::{Overrides, Parameter, Parameters, Report as Rows, Study, StudyError};

use crate::bar::{self, Bar, break_bar, row};
use crate::method::on_threads;

/// The study `bar-bifurcation`.
pub struct BarBifurcation;

const NAME: &str = "bar-bifurcation";

impl Study for BarBifurcation {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "a bar with two lines that are equally weak but for an imperfection that goes to zero: one crack or two"
    }

    fn parameters(&self) -> Vec<Parameter> {
        bar::parameters(&[0.01])
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let imperfections: &[f64] = if quick {
            &[0.0, 1e-2]
        } else {
            &[0.0, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2]
        };
        let base = Overrides::new()
            .set("weak", "two-lines")
            .sweep("imperfection", imperfections.iter().copied());
        let mut cases = vec![base.clone().set("solver", "quasi-static")];
        if !quick {
            cases.push(base.set("solver", "explicit"));
        }
        cases
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        for case in cases {
            rows.progress(&case.label());
            let bar = Bar::new(case)?;
            let finished = on_threads(case, || break_bar(&bar, case, None))?;
            let mut row = row(NAME, &bar, case, &finished)?;
            // Where both open, elongation and energy are those of a section twice as tough.
            let mut both = bar.exact();
            both.toughness *= 2.0;
            let kinks = [both.peak_elongation(), both.critical_opening()];
            let end = 1.2 * bar.exact().critical_opening();
            let error = finished
                .history
                .curve
                .error(|x| both.load(x), (0.0, end), &kinks);
            row.values
                .insert("load_l2_symmetric", error.unwrap_or(f64::NAN));
            rows.row(row)?;
            if let Some(reason) = &finished.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
        }
        Ok(())
    }
}
