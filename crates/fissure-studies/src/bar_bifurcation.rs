//! Two lines of the bar that are equally weak, or nearly so: which branch is followed.
//!
//! Two equal lines in series may both open, with twice the critical elongation and energy (the symmetric
//! branch), or one opens and the other unloads. The second needs less work: the first is unstable.
//! An imperfection makes one line a little less weak; the branch found must not depend on it as it goes
//! to zero.

use std::collections::BTreeMap;
use std::path::Path;

use fissure::io::plot::{LinePlot, Style};
use fissure_study::{Overrides, Parameter, Parameters, Report as Rows, Study, StudyError};

use crate::bar::drawing::{ROWS, sampled};
use crate::bar::{self, Bar, Thinned, break_bar, row};
use crate::drawing::save;
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
        // A picture per solver.
        let mut curves: BTreeMap<String, Vec<(String, Bar, Thinned)>> = BTreeMap::new();
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
            let label = format!("imperfection {:e}", case.number("imperfection")?);
            let of_solver = curves.entry(case.choice("solver")?.to_owned()).or_default();
            of_solver.push((label, bar, finished.history.thinned(ROWS)));
            if let Some(reason) = &finished.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
        }
        match rows.out_dir() {
            Some(folder) => draw(&curves, folder),
            None => Ok(()),
        }
    }
}

/// Loads over the elongation beside the exact ones of one crack and of two.
fn draw(
    curves: &BTreeMap<String, Vec<(String, Bar, Thinned)>>,
    folder: &Path,
) -> Result<(), StudyError> {
    for (solver, runs) in curves {
        let mut plot = LinePlot::new(&format!("Two lines that are equally weak, {solver}"))
            .x_label("elongation [m]")
            .y_label("load [N]");
        for (label, _, history) in runs {
            plot = plot.series(label, &history.elongation, &history.load, Style::Line);
        }
        if let Some((_, bar, _)) = runs.first() {
            let one = bar.exact();
            let (x, load) = sampled(&one, |exact, at| exact.load(at));
            let mut both = one;
            both.toughness *= 2.0;
            let two: Vec<f64> = x.iter().map(|x| both.load(*x)).collect();
            plot = plot
                .series("one opens", x.clone(), load, Style::Dashed)
                .series("both open", x, two, Style::Dashed);
        }
        save(plot, &folder.join(format!("load-{solver}.png")))?;
    }
    Ok(())
}
