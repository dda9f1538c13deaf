//! The paths by name.

use fissure::io::table::Table;
use fissure::prelude::*;

use crate::laws::chosen::{Chosen, number_or};
use fissure_laws::Space;
use fissure_study::{Parameters, StudyError, Value};

/// Names of the paths.
pub(super) const NAMES: &[&str] = &[
    "uniaxial-stress",
    "uniaxial-strain",
    "shear",
    "hydrostatic",
    "cycle",
    "willam",
    "walk",
    "csv",
];

/// Columns of a file of deformation gradients, row by row.
const COLUMNS: [&str; 9] = [
    "Fxx", "Fxy", "Fxz", "Fyx", "Fyy", "Fyz", "Fzx", "Fzy", "Fzz",
];

/// The path that a case asks for.
pub(super) fn path(case: &Parameters, chosen: &Chosen<'_>, band: f64) -> Result<Path, StudyError> {
    let law = &chosen.law;
    let to = number_or(case, "to", 1.2 * law.failure_strain(band))?;
    let name = case.choice("path")?;
    let steps = match (case.value("steps")?, name) {
        (Value::Count(_), _) => case.size("steps")?,
        (_, "csv") => 1,
        (_, "walk") => 10,
        _ => 200,
    };
    let legs = case.size("legs")?;
    let start = Path::new(Band::Uniform(band)).sub_steps(SubSteps {
        halvings: u32::try_from(case.count("halvings")?).unwrap_or(u32::MAX),
        tolerance: number_or(case, "tolerance", f64::INFINITY)?,
    });
    Ok(match name {
        "uniaxial-strain" => start.uniaxial_strain(Axis::X, to, steps),
        "shear" => start.shear(Axis::Z, to, steps),
        "hydrostatic" => start.hydrostatic(to, steps),
        "cycle" => (1..=legs).fold(start, |path, leg| {
            let there = to * leg as f64 / legs as f64;
            path.uniaxial(Axis::X, there, steps).back(0.0, steps)
        }),
        "willam" => {
            let own = |name: &str| Some(chosen.values.number(name)).filter(|v| v.is_finite());
            let poisson = own("poisson").unwrap_or(0.2);
            let peak = match (own("strength"), own("young")) {
                (Some(strength), Some(young)) => strength / young,
                _ => law.natural_strain(),
            };
            start.willam(peak, to, poisson, steps)
        }
        "walk" => {
            let plane = chosen.space == Space::PlaneStress;
            start.random_walk(case.count("seed")?, to.abs(), legs, steps, plane)
        }
        "csv" => start.gradients(read(case)?, steps),
        _ => start.uniaxial(Axis::X, to, steps),
    })
}

/// The deformation gradients of a file; a column that is not there is that of the identity.
fn read(case: &Parameters) -> Result<Vec<Matrix3<f64>>, StudyError> {
    let file = case.choice("file")?;
    let refused = |reason: String| StudyError::combination(case, &["path", "file"], reason);
    if file.is_empty() {
        return Err(refused(
            "this path needs a file of deformation gradients".to_owned(),
        ));
    }
    let table = Table::read(file).map_err(|error| refused(error.to_string()))?;
    let mut gradients = vec![Matrix3::identity(); table.len()];
    for (index, column) in COLUMNS.iter().enumerate() {
        if !table.names().any(|name| name == *column) {
            continue;
        }
        let numbers = table
            .numbers(column)
            .map_err(|error| refused(error.to_string()))?;
        for (gradient, number) in gradients.iter_mut().zip(numbers) {
            gradient[(index / 3, index % 3)] = number;
        }
    }
    let known = |name: &str| COLUMNS.contains(&name);
    if let Some(stranger) = table.names().find(|name| !known(name)) {
        return Err(refused(format!(
            "the column '{stranger}' is none of {}",
            COLUMNS.join(", ")
        )));
    }
    if gradients.is_empty() {
        return Err(refused("the file has no rows".to_owned()));
    }
    Ok(gradients)
}
