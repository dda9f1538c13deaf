//! Figures as PNG or SVG: curves, and particles coloured by a field.
//!
//! Labels are plain text with the unit in brackets, `"delta [m]"`; numbers far from one are shown with a power of ten in
//! the unit, `"delta [10⁻⁶ m]"`. Colours can be told apart by colour-blind readers. `$…$` in a label is set as simple
//! mathematics: `"$G_c$ [N/m]"`.

mod axis;
mod colour_bar;
mod figure;
mod legend;
mod line;
mod palette;
mod pen;
mod scale;
mod scatter;
mod stroke;
mod view;

use std::path::PathBuf;

pub use line::{LinePlot, Style};
pub use palette::ColourMap;
pub use scatter::ScatterPlot;

use crate::FileError;

/// Why a figure could not be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// The operating system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file's name ends neither in `.png` nor in `.svg`.
    #[error("'{}': a figure is saved as .png or .svg", path.display())]
    Extension {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// Two columns of one series differ in length.
    #[error("'{}': series '{series}' has {xs} abscissas and {ys} ordinates", path.display())]
    Length {
        /// The file that was asked for.
        path: PathBuf,
        /// The series, or the label of the field.
        series: String,
        /// Numbers along x, or points.
        xs: usize,
        /// Numbers along y, or values.
        ys: usize,
    },
    /// There is nothing that can be shown: no point, or none that is finite and, on a logarithmic axis, above zero.
    #[error("'{}': there is no point to show", path.display())]
    Empty {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// A range set by hand is empty, not finite, or reaches to zero on a logarithmic axis.
    #[error("'{}': {low} to {high} is no range for '{axis}'", path.display())]
    Range {
        /// The file that was asked for.
        path: PathBuf,
        /// Label of the axis or the colour bar.
        axis: String,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
    },
    /// The plotting library refused.
    #[error("'{}': cannot be drawn: {message}", path.display())]
    Draw {
        /// The file that was asked for.
        path: PathBuf,
        /// What the library says; it has no error type.
        message: String,
    },
}
