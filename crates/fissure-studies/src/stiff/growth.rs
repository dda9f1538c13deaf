//! How the work of a linear solution grows with the number of unknowns.

use fissure::diagnostics::fit_slope;

use fissure_study::{Field, Parameters, Row, StudyError};

use super::NAME;
use super::square::{Solved, unknowns};

/// How products grow with the number of unknowns, all else the same.
pub(super) struct Growth {
    pub name: String,
    /// What else the case is.
    label: String,
    pub unknowns: Vec<f64>,
    pub products: Vec<f64>,
}

impl Growth {
    pub(super) fn note(
        all: &mut Vec<Self>,
        case: &Parameters,
        run: &Solved,
    ) -> Result<(), StudyError> {
        if !run.converged {
            return Ok(());
        }
        let label = case.label_without(&["cells"]);
        let place = match all.iter().position(|growth| growth.label == label) {
            Some(place) => place,
            None => {
                let (linear, by) = (
                    case.choice("linear_solver")?,
                    case.choice("preconditioner")?,
                );
                all.push(Self {
                    name: format!("{linear}, {by}"),
                    label,
                    unknowns: Vec::new(),
                    products: Vec::new(),
                });
                all.len() - 1
            }
        };
        all[place].unknowns.push(unknowns(case)? as f64);
        let per_step = run.products as f64 / run.scene.step() as f64;
        all[place].products.push(per_step);
        Ok(())
    }

    /// Sizes that differ.
    pub(super) fn sizes(&self) -> usize {
        let mut sizes: Vec<u64> = self.unknowns.iter().map(|&n| n as u64).collect();
        sizes.sort_unstable();
        sizes.dedup();
        sizes.len()
    }

    pub(super) fn row(&self) -> Result<Row, StudyError> {
        let fit = fit_slope(&self.unknowns, &self.products);
        let fit = fit.map_err(StudyError::failed("fitting the growth"))?;
        Ok(Row::other(NAME)
            .field("case", "growth")
            .field("scheme", self.name.as_str())
            .field("unknowns", Field::Numbers(self.unknowns.clone()))
            .field("iterations", Field::Numbers(self.products.clone()))
            .field("exponent", fit.exponent))
    }
}
