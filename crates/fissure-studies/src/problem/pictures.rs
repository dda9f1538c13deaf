//! Pictures of a problem, if they are asked for: errors over spacing and over run time, and of each `case` that it has the
//! field and the history on the finest grid.

use std::path::{Path, PathBuf};

use fissure::io::plot::{LinePlot, ScatterPlot, Style};
use fissure_study::{Parameters, SimulationRow, StudyError};

use super::{History, Outcome, Problem};
use crate::convergence::ErrorChart;
use crate::drawing::save;

pub(super) struct Pictures {
    folder: Option<PathBuf>,
    leading: &'static str,
    /// Parameters that the label of a line leaves out.
    untold: Vec<&'static str>,
    over_h: ErrorChart,
    over_time: ErrorChart,
    /// What was drawn, and on which spacing.
    drawn: Vec<(PathBuf, f64)>,
}

impl Pictures {
    pub(super) fn of(problem: &impl Problem, folder: Option<&Path>) -> Self {
        let leading = problem.leading_error();
        let mut over_h = ErrorChart::new("Error against spacing", "h [m]", leading);
        let mut over_time = ErrorChart::over_time("Error against run time", leading);
        if !problem.alike().is_empty() {
            (over_h, over_time) = (over_h.scattered(), over_time.scattered());
        }
        Self {
            folder: folder.map(Path::to_path_buf),
            leading,
            untold: [&["h"], problem.alike()].concat(),
            over_h,
            over_time,
            drawn: Vec::new(),
        }
    }

    /// Takes in a run, and draws it if none before was finer.
    pub(super) fn add(
        &mut self,
        case: &Parameters,
        row: &SimulationRow,
        outcome: &Outcome,
    ) -> Result<(), StudyError> {
        let error = row.errors.get(self.leading).unwrap_or(f64::NAN);
        let label = case.label_without(&self.untold);
        self.over_h.add(&label, row.h, error);
        self.over_time.add(&label, row.wall_s, error);
        let name = case.choice("case").ok();
        let title = name.unwrap_or(&row.study);
        if let Some((label, values)) = &outcome.field
            && let Some(path) = self.finest("field", name, row.h)
        {
            let motion = outcome.scene.bodies()[0].motion();
            let points: Vec<[f64; 2]> = motion.position.iter().map(|x| [x.x, x.y]).collect();
            ScatterPlot::new(title, points)
                .colour(label, values.as_slice())
                .particle_size(0.5 * row.h)
                .save(path)
                .map_err(StudyError::failed("drawing the field"))?;
        }
        if let Some(history) = &outcome.history
            && let Some(path) = self.finest("history", name, row.h)
        {
            draw_history(title, history, &path)?;
        }
        Ok(())
    }

    /// The file for a picture of a case on this spacing, unless one on as fine a grid is there.
    fn finest(&mut self, kind: &str, case: Option<&str>, h: f64) -> Option<PathBuf> {
        let name = case.map_or(kind.to_owned(), |case| format!("{kind}-{case}"));
        let path = self.folder.as_ref()?.join(format!("{name}.png"));
        match self.drawn.iter_mut().find(|(known, _)| *known == path) {
            Some((_, finest)) if *finest <= h => return None,
            Some((_, finest)) => *finest = h,
            None => self.drawn.push((path.clone(), h)),
        }
        Some(path)
    }

    pub(super) fn finish(&self) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        self.over_h.save(&folder.join("error-against-h.png"))?;
        self.over_time.save(&folder.join("error-against-time.png"))
    }
}

fn draw_history(title: &str, history: &History, path: &Path) -> Result<(), StudyError> {
    let column = |k: usize| history.samples.iter().map(|s| s[k]).collect::<Vec<_>>();
    let plot = LinePlot::new(title)
        .x_label(history.x_label)
        .y_label(history.y_label)
        .series("found", column(0), column(1), Style::Line)
        .series("exact", column(0), column(2), Style::Dashed);
    save(plot, path)
}
