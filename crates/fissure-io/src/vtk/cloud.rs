//! Points with named arrays, borrowed from wherever they are.

use std::borrow::Cow;
use std::path::Path;

use super::{Compression, VtkError, document};
use crate::file::{self, Survive};

/// Particles and what is known at each of them, to become one `.vtu`.
///
/// Columns are borrowed slices or owned vectors; what exists only as an iterator is collected. Units are the caller's, by
/// convention SI, and a name may carry them: `"stress [Pa]"`.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// use fissure_io::vtk::{Compression, PointCloud};
///
/// let positions = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]]; // m
/// let damage = [0.0, 0.75];
/// PointCloud::new(&positions)
///     .scalar("damage", &damage)
///     .ids("id", (0..2).collect::<Vec<u32>>())
///     .write(folder.path().join("bar.vtu"), Compression::None)?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct PointCloud<'a> {
    pub(super) points: Cow<'a, [[f64; 3]]>,
    pub(super) time: Option<f64>,
    pub(super) arrays: Vec<(String, Values<'a>)>,
}

/// The numbers of one array.
#[derive(Debug, Clone)]
pub(super) enum Values<'a> {
    Scalar(Cow<'a, [f64]>),
    Vector(Cow<'a, [[f64; 3]]>),
    Symmetric(Cow<'a, [[f64; 6]]>),
    Tensor(Cow<'a, [[[f64; 3]; 3]]>),
    Ids(Cow<'a, [u32]>),
}

impl Values<'_> {
    pub fn len(&self) -> usize {
        match self {
            Self::Scalar(values) => values.len(),
            Self::Vector(values) => values.len(),
            Self::Symmetric(values) => values.len(),
            Self::Tensor(values) => values.len(),
            Self::Ids(values) => values.len(),
        }
    }

    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Scalar(values) => bytemuck::cast_slice(values),
            Self::Vector(values) => bytemuck::cast_slice(values),
            Self::Symmetric(values) => bytemuck::cast_slice(values),
            Self::Tensor(values) => bytemuck::cast_slice(values),
            Self::Ids(values) => bytemuck::cast_slice(values),
        }
    }

    pub fn vtk_type(&self) -> &'static str {
        match self {
            Self::Ids(_) => "UInt32",
            _ => "Float64",
        }
    }

    /// The components' names, in order; none for a scalar.
    pub fn components(&self) -> &'static [&'static str] {
        match self {
            Self::Scalar(_) | Self::Ids(_) => &[],
            Self::Vector(_) => &["x", "y", "z"],
            Self::Symmetric(_) => &["xx", "yy", "zz", "xy", "yz", "xz"],
            Self::Tensor(_) => &["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"],
        }
    }
}

impl<'a> PointCloud<'a> {
    /// A cloud at the given positions, m. Plane problems leave the third coordinate zero.
    pub fn new(points: impl Into<Cow<'a, [[f64; 3]]>>) -> Self {
        Self {
            points: points.into(),
            time: None,
            arrays: Vec::new(),
        }
    }

    /// States the time, s, in the file itself, where a viewer finds it without the `.pvd`. [`Series`](super::Series) does
    /// so for its frames.
    #[must_use]
    pub fn time(mut self, time: f64) -> Self {
        self.time = Some(time);
        self
    }

    /// One number per point.
    #[must_use]
    pub fn scalar(self, name: &str, values: impl Into<Cow<'a, [f64]>>) -> Self {
        self.array(name, Values::Scalar(values.into()))
    }

    /// A vector per point.
    #[must_use]
    pub fn vector(self, name: &str, values: impl Into<Cow<'a, [[f64; 3]]>>) -> Self {
        self.array(name, Values::Vector(values.into()))
    }

    /// A symmetric tensor per point in VTK's order xx, yy, zz, xy, yz, xz: true shear components, without the factors of
    /// Mandel's or Voigt's notation.
    #[must_use]
    pub fn symmetric(self, name: &str, values: impl Into<Cow<'a, [[f64; 6]]>>) -> Self {
        self.array(name, Values::Symmetric(values.into()))
    }

    /// A tensor per point, by rows: `value[i][j]` is the component ij.
    #[must_use]
    pub fn tensor(self, name: &str, values: impl Into<Cow<'a, [[[f64; 3]; 3]]>>) -> Self {
        self.array(name, Values::Tensor(values.into()))
    }

    /// An id, an index or a flag per point.
    #[must_use]
    pub fn ids(self, name: &str, values: impl Into<Cow<'a, [u32]>>) -> Self {
        self.array(name, Values::Ids(values.into()))
    }

    /// Writes the cloud, replacing a file that is there in one piece. The folder must exist.
    ///
    /// # Errors
    /// [`VtkError::Length`], [`VtkError::Duplicate`] or [`VtkError::ArrayName`] before anything is written;
    /// [`VtkError::File`] if the operating system refuses.
    pub fn write(&self, path: impl AsRef<Path>, compression: Compression) -> Result<(), VtkError> {
        self.check(path.as_ref())?;
        file::replace(path.as_ref(), Survive::Process, |out| {
            document::write(self, compression, out)
        })?;
        Ok(())
    }

    fn array(mut self, name: &str, values: Values<'a>) -> Self {
        self.arrays.push((name.to_owned(), values));
        self
    }

    fn check(&self, path: &Path) -> Result<(), VtkError> {
        for (index, (name, values)) in self.arrays.iter().enumerate() {
            let (path, array) = (path.to_owned(), name.clone());
            if name.is_empty() || name.contains(char::is_control) {
                return Err(VtkError::ArrayName { path, array });
            }
            if self.arrays[..index]
                .iter()
                .any(|(earlier, _)| earlier == name)
            {
                return Err(VtkError::Duplicate { path, array });
            }
            if values.len() != self.points.len() {
                return Err(VtkError::Length {
                    path,
                    array,
                    found: values.len(),
                    points: self.points.len(),
                });
            }
        }
        Ok(())
    }
}
