//! The result row of a simulation.

use crate::parameters::Parameters;
use crate::row::{Field, Fields, Row};
use crate::value::Value;

/// The fields of the row that are commonly parameters too.
pub(crate) const OWN_COLUMNS: [&str; 5] = ["solver", "shape", "transfer", "h", "threads"];

/// Named measures in the order in which they were added.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measures {
    fields: Fields,
}

impl Measures {
    /// No measures.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a measure, or replaces the one of that name.
    pub fn insert(&mut self, name: impl Into<String>, value: f64) {
        self.fields.insert(name, value);
    }

    /// The measure of that name.
    pub fn get(&self, name: &str) -> Option<f64> {
        match self.fields.get(name) {
            Some(Field::Number(value)) => Some(*value),
            _ => None,
        }
    }

    /// Every measure with its name, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.fields.iter().map(|(name, field)| match field {
            Field::Number(value) => (name, *value),
            _ => (name, f64::NAN),
        })
    }

    /// Adds a measure and returns the measures, for writing them in one expression.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, value: f64) -> Self {
        self.insert(name, value);
        self
    }
}

/// The row of one simulation; converts to a [`Row`].
#[derive(Debug, Clone, PartialEq)]
pub struct SimulationRow {
    /// The study.
    pub study: String,
    /// What sets this simulation apart from the study's others.
    pub case: String,
    /// The time integrator or quasi-static solver.
    pub solver: String,
    /// The shape functions.
    pub shape: String,
    /// The transfer between particles and grid.
    pub transfer: String,
    /// The grid spacing in metres.
    pub h: f64,
    /// The threads used.
    pub threads: u64,
    /// The particles simulated.
    pub particles: u64,
    /// The steps taken.
    pub steps: u64,
    /// The wall time in seconds.
    pub wall_s: f64,
    /// The error measures.
    pub errors: Measures,
    /// Any other results.
    pub values: Measures,
    /// The hash of the final particle columns.
    pub state_hash: u64,
    /// The parameters of the run, so that a row alone can be reproduced.
    pub parameters: Parameters,
}

impl SimulationRow {
    /// A row with the fields that follow from the parameters.
    ///
    /// `solver`, `shape`, `transfer`, `h` and `threads` are taken from the parameters of
    /// those names and `case` is what else varies in this run. Where the study has no such parameter they
    /// are left empty, not finite and one, and the study fills in what it fixes.
    pub fn new(study: &str, parameters: &Parameters) -> Self {
        let choice = |name| parameters.choice(name).unwrap_or_default().to_owned();
        Self {
            study: study.to_owned(),
            case: parameters.label_without(&OWN_COLUMNS),
            solver: choice("solver"),
            shape: choice("shape"),
            transfer: choice("transfer"),
            h: parameters.number("h").unwrap_or(f64::NAN),
            threads: match parameters.get("threads") {
                Some(Value::Count(threads)) => *threads,
                _ => 1,
            },
            particles: 0,
            steps: 0,
            wall_s: f64::NAN,
            errors: Measures::new(),
            values: Measures::new(),
            state_hash: 0,
            parameters: parameters.clone(),
        }
    }
}

impl From<SimulationRow> for Row {
    fn from(row: SimulationRow) -> Self {
        Row::other(&row.study)
            .field("case", row.case)
            .field("solver", row.solver)
            .field("shape", row.shape)
            .field("transfer", row.transfer)
            .field("h", row.h)
            .field("threads", row.threads)
            .field("particles", row.particles)
            .field("steps", row.steps)
            .field("wall_s", row.wall_s)
            .field("errors", Field::Group(row.errors.fields))
            .field("values", Field::Group(row.values.fields))
            // As text: a JSON reader that keeps numbers as doubles would lose digits.
            .field("state_hash", format!("{:016x}", row.state_hash))
            .parameters(&row.parameters)
    }
}
