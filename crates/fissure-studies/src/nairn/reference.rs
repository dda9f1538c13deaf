//! Curves of the independent code, thinned; where they come from is said in the files.

use fissure::io::table::Table;
use fissure_study::StudyError;

/// Two columns of a curve.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
}

impl Curve {
    /// Reads two columns of a table that was compiled in.
    pub(super) fn read(text: &str, label: &str, x: &str, y: &str) -> Result<Self, StudyError> {
        let failed = || StudyError::failed(format!("reading the reference '{label}'"));
        let table = Table::parse(label, text).map_err(failed())?;
        Ok(Self {
            x: table.numbers(x).map_err(failed())?,
            y: table.numbers(y).map_err(failed())?,
        })
    }

    /// The value at `x` by linear interpolation; NaN outside.
    pub(super) fn at(&self, x: f64) -> f64 {
        let after = self.x.partition_point(|known| *known < x);
        match after {
            0 if self.x.first() == Some(&x) => self.y[0],
            0 => f64::NAN,
            after if after == self.x.len() => f64::NAN,
            after => {
                let (a, b) = (self.x[after - 1], self.x[after]);
                let share = (x - a) / (b - a);
                self.y[after - 1] + share * (self.y[after] - self.y[after - 1])
            }
        }
    }
}
