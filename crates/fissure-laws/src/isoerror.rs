//! The error of one step against many, over a plane of increments (P20).

use fissure_materials::*;
use fissure_tensor::{Band, Matrix3, Sym};

use super::subject::{Subject, stiffness};

/// One increment of the plane.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// Normal increment over the natural strain.
    pub normal: f64,
    /// Shear increment `Δε_nt` over the natural strain.
    pub shear: f64,
    /// Change of the stress by dividing the step, over stiffness times increment; NaN where the
    /// law refuses one of both.
    pub error: f64,
}

/// A plane of increments.
#[derive(Clone, Debug)]
pub struct Map {
    /// The increments, ±5 natural strains each way.
    pub cells: Vec<Cell>,
    /// Increments that the law refused.
    pub refused: usize,
    /// The largest error.
    pub largest: f64,
}

/// Half the width of the plane, in natural strains.
const REACH: f64 = 5.0;

/// The map of a law from a stretch of `level` natural strains along `n`, the first axis: `cells`
/// increments each way, one step against `parts`.
pub(super) fn map<S: Subject>(
    subject: &S,
    band: f64,
    cells: usize,
    parts: usize,
    level: f64,
) -> Map {
    let law = subject.law();
    let (natural, modulus) = (subject.strain(), stiffness(law));
    let mut start = Increment::to(gradient(&Sym::diagonal(level * natural, 0.0, 0.0)));
    start.band = Band::Uniform(band);
    let state = law.update(&start, &law.initial()).map(|r| r.state);
    let half = (cells / 2).max(1) as f64;
    let mut map = Map {
        cells: Vec::new(),
        refused: 0,
        largest: 0.0,
    };
    for i in 0..=2 * (cells / 2).max(1) {
        for j in 0..=2 * (cells / 2).max(1) {
            let place = |index: usize| (index as f64 / half - 1.0) * REACH;
            let (normal, shear) = (place(i), place(j));
            let change = Sym::new(normal, 0.0, 0.0, 0.0, 0.0, shear) * natural;
            let end = start.f_new + change.to_matrix();
            let size = change.norm();
            let error = match &state {
                _ if size == 0.0 => Ok(0.0),
                Ok(state) => taken(law, &start, &end, state, 1).and_then(|one| {
                    let many = taken(law, &start, &end, state, parts)?;
                    Ok((one - many).max_abs() / (modulus * size))
                }),
                Err(error) => Err(error.clone()),
            };
            map.refused += usize::from(error.is_err());
            let error = error.unwrap_or(f64::NAN);
            map.largest = map.largest.max(error);
            map.cells.push(Cell {
                normal,
                shear,
                error,
            });
        }
    }
    map
}

fn gradient(strain: &Sym) -> Matrix3<f64> {
    Matrix3::identity() + strain.to_matrix()
}

/// The stress after a straight step in equal parts.
fn taken<M: Material>(
    law: &M,
    start: &Increment,
    end: &Matrix3<f64>,
    old: &M::State,
    parts: usize,
) -> Result<Sym, MaterialError> {
    let from = start.f_new;
    let mut state = *old;
    let mut stress = Sym::ZERO;
    let mut step = *start;
    for part in 1..=parts {
        step.f_old = if part == 1 { from } else { step.f_new };
        step.f_new = if part == parts {
            *end
        } else {
            from + (end - from) * (part as f64 / parts as f64)
        };
        step.dt = start.dt / parts as f64;
        let response = law.update(&step, &state)?;
        (stress, state) = (response.stress, response.state);
    }
    Ok(stress)
}
