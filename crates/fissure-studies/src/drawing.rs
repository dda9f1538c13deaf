//! Drawing to files, for all studies.

use std::path::Path;

use fissure::io::plot::LinePlot;
use fissure_study::StudyError;

/// Draws a plot to a file.
///
/// # Errors
/// A plot without points, or a file that cannot be written.
pub fn save(plot: LinePlot<'_>, path: &Path) -> Result<(), StudyError> {
    plot.save(path)
        .map_err(StudyError::failed(format!("drawing {}", path.display())))
}
