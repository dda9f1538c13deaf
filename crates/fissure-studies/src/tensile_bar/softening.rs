//! The bar breaking: one row per case.

use std::path::Path;

use fissure::prelude::*;

use fissure_study::{Parameters, Report as Rows, StudyError};

use super::NAME;
use super::pictures::{Pictures, frames};
use crate::bar::{Bar, Finished, break_bar, row};
use crate::method::on_threads;

pub(super) fn run(cases: &[&Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let mut pictures = Pictures::new(rows.out_dir());
    for (number, case) in cases.iter().enumerate() {
        rows.progress(&format!(
            "{} of {}: {}",
            number + 1,
            cases.len(),
            case.label()
        ));
        let bar = Bar::new(case)?;
        let folder = rows.out_dir().map(Path::to_path_buf);
        let finished = on_threads(case, || one(&bar, case, folder.as_deref()))?;
        let row = row(NAME, &bar, case, &finished)?;
        let error = row.errors.get("load_l2").unwrap_or(f64::NAN);
        rows.row(row)?;
        if let Some(reason) = &finished.stopped {
            rows.note(&format!("the run above stopped early: {reason}"))?;
        }
        pictures.add(&bar, case, &finished, error)?;
    }
    pictures.finish()
}

fn one(bar: &Bar, case: &Parameters, folder: Option<&Path>) -> Result<Finished, StudyError> {
    let mut frames = frames(folder, bar, case)?;
    break_bar(
        bar,
        case,
        frames.as_mut().map(|frames| frames as &mut dyn Watch<2>),
    )
}
