//! Frames of a running simulation and the `.pvd` that gives them their times.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::document::{BYTE_ORDER, escape, unescape};
use super::{Compression, PointCloud, VtkError};
use crate::FileError;
use crate::file::{self, Survive};

/// Writes `name_000000.vtu`, `name_000001.vtu`, … into a folder and keeps `name.pvd` listing them.
///
/// The `.pvd` is replaced in one piece after each frame, so that it can be open in ParaView meanwhile and is complete
/// whenever the program ends.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let folder = folder.path();
/// use fissure_io::vtk::{Compression, PointCloud, Series};
///
/// let mut series = Series::new(folder, "bar", Compression::Lz4)?;
/// for step in 0..3_u32 {
///     let time = 1e-6 * f64::from(step); // s
///     series.write(time, PointCloud::new(vec![[time, 0.0, 0.0]]))?;
/// }
/// assert!(folder.join("bar_000002.vtu").exists());
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Series {
    folder: PathBuf,
    name: String,
    compression: Compression,
    /// Time, s, and file name of every frame written.
    frames: Vec<(f64, String)>,
}

impl Series {
    /// A series without frames. Nothing is written before the first frame, which replaces what an earlier run left under
    /// the same name; the folder is created then.
    ///
    /// # Errors
    /// [`VtkError::SeriesName`] if the name cannot be a part of a file's name.
    pub fn new(
        folder: impl AsRef<Path>,
        name: &str,
        compression: Compression,
    ) -> Result<Self, VtkError> {
        if name.is_empty() || name.contains(['/', '\\', ':']) || name.contains(char::is_control) {
            return Err(VtkError::SeriesName {
                name: name.to_owned(),
            });
        }
        Ok(Self {
            folder: folder.as_ref().to_owned(),
            name: name.to_owned(),
            compression,
            frames: Vec::new(),
        })
    }

    /// Goes on with the series an earlier run left, as after reading a checkpoint: frames up to and including `time`, s,
    /// are kept, later ones are forgotten and overwritten as the run meets them again.
    ///
    /// # Errors
    /// [`VtkError::File`] if there is no `.pvd`, [`VtkError::Unreadable`] if another program wrote it, and
    /// [`VtkError::SeriesName`].
    pub fn resume(
        folder: impl AsRef<Path>,
        name: &str,
        compression: Compression,
        time: f64,
    ) -> Result<Self, VtkError> {
        let mut series = Self::new(folder, name, compression)?;
        let path = series.index_path();
        let text = fs::read_to_string(&path).map_err(FileError::on("read", &path))?;
        let listed = text
            .lines()
            .enumerate()
            .filter(|(_, line)| line.trim_start().starts_with("<DataSet"));
        for (index, line) in listed {
            let frame = parse_frame(line).ok_or_else(|| VtkError::Unreadable {
                path: path.clone(),
                line: index + 1,
            })?;
            series.frames.push(frame);
        }
        series.frames.retain(|frame| frame.0 <= time);
        Ok(series)
    }

    /// Writes the cloud as the next frame, at `time` in s, and then the `.pvd`. A frame at the very time of the last one
    /// replaces it: a run that ends on an output step may write its final state without asking. Returns the frame's path.
    ///
    /// # Errors
    /// [`VtkError::Time`] if the time is not finite or lies before the last frame's; those of [`PointCloud::write`].
    pub fn write(&mut self, time: f64, cloud: PointCloud<'_>) -> Result<PathBuf, VtkError> {
        let last = self
            .frames
            .last()
            .map_or(f64::NEG_INFINITY, |frame| frame.0);
        if !time.is_finite() || time < last {
            return Err(VtkError::Time {
                path: self.index_path(),
                time,
                last,
            });
        }
        let again = usize::from(time == last);
        let name = format!("{}_{:06}.vtu", self.name, self.frames.len() - again);
        let path = self.folder.join(&name);
        file::create_folder(&self.folder)?;
        cloud.time(time).write(&path, self.compression)?;
        if again == 0 {
            self.frames.push((time, name));
        }
        self.write_index()?;
        Ok(path)
    }

    /// Number of frames the `.pvd` lists.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Whether no frame has been written.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Where the `.pvd` is, to open in ParaView.
    pub fn index_path(&self) -> PathBuf {
        self.folder.join(format!("{}.pvd", self.name))
    }

    fn write_index(&self) -> Result<(), VtkError> {
        let mut xml = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"{BYTE_ORDER}\">\n  <Collection>\n"
        );
        for (time, name) in &self.frames {
            // Writing to a String cannot fail. `{:?}` is the shortest form that reads back as the same time.
            let _ = writeln!(
                xml,
                "    <DataSet timestep=\"{time:?}\" part=\"0\" file=\"{}\"/>",
                escape(name)
            );
        }
        xml.push_str("  </Collection>\n</VTKFile>\n");
        file::replace(&self.index_path(), Survive::Process, |out| {
            out.write_all(xml.as_bytes())
        })?;
        Ok(())
    }
}

/// Time and file of one `<DataSet …/>` line as [`Series::write_index`] writes it.
fn parse_frame(line: &str) -> Option<(f64, String)> {
    let attribute = |key: &str| {
        let (_, rest) = line.split_once(&format!(" {key}=\""))?;
        rest.split_once('"').map(|(value, _)| value)
    };
    Some((
        attribute("timestep")?.parse().ok()?,
        unescape(attribute("file")?),
    ))
}
