//! Frames of a running scene.

use std::path::PathBuf;

use fissure_scene::{Every, Report, Scene, Watch, WatchError};

use super::Series;
use super::fields::Fields;

/// A watch that writes the particles of all bodies of a scene as frames of a [`Series`].
///
/// A frame has the positions (z = 0 in two dimensions) and the fields that were asked for, no others:
///
/// | asked for by | array |
/// |---|---|
/// | [`velocity`](Self::velocity) | `velocity [m/s]` |
/// | [`stress`](Self::stress) | `stress [Pa]`, Cauchy's |
/// | [`jacobian`](Self::jacobian) | `jacobian`, det F |
/// | [`ids`](Self::ids) | `id`, unique within a body |
/// | [`bodies`](Self::bodies) | `body`, its index in the scene |
/// | [`value`](Self::value), [`values`](Self::values) | the law's values, by their names; NaN in a body whose law has none of that name |
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let folder = folder.path();
/// use fissure_io::vtk::{Compression, ParticleSeries, Series};
/// use fissure_materials::Isotropic;
/// use fissure_particles::{Block, Spacing};
/// use fissure_scene::{Plane, Scene};
///
/// let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
/// let mut scene = Scene::plane(Plane::Strain { thickness: 0.01 });
/// scene.fill("bar", steel, &Block::new([0.0, 0.0], [0.2, 0.06]), &Spacing(5e-3))?;
///
/// let mut frames = ParticleSeries::new(Series::new(folder, "bar", Compression::Lz4)?)
///     .velocity()
///     .stress()
///     .every_interval(1e-5);
/// frames.frame(&scene)?; // the state a run starts with
/// // run(&mut scene, &mut solver, until, &mut [&mut frames])?;
/// assert!(folder.join("bar_000000.vtu").exists());
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct ParticleSeries {
    series: Series,
    every: Every,
    fields: Fields,
}

impl ParticleSeries {
    /// Frames of a new series, or one that is resumed, with positions only and after each step.
    pub fn new(series: Series) -> Self {
        Self {
            series,
            every: Every::default(),
            fields: Fields::default(),
        }
    }

    /// Writes a frame only after steps whose number is a multiple of `steps`; 0 is never.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = Every::Steps(steps);
        self
    }

    /// Writes a frame only after steps that reach or pass a multiple of `interval`, s.
    #[must_use]
    pub fn every_interval(mut self, interval: f64) -> Self {
        self.every = Every::Time(interval);
        self
    }

    /// With velocities, m/s.
    #[must_use]
    pub fn velocity(mut self) -> Self {
        self.fields.velocity = true;
        self
    }

    /// With Cauchy stresses, Pa.
    #[must_use]
    pub fn stress(mut self) -> Self {
        self.fields.stress = true;
        self
    }

    /// With determinants of the deformation gradient.
    #[must_use]
    pub fn jacobian(mut self) -> Self {
        self.fields.jacobian = true;
        self
    }

    /// With ids of the particles.
    #[must_use]
    pub fn ids(mut self) -> Self {
        self.fields.ids = true;
        self
    }

    /// With the index of each particle's body in the scene.
    #[must_use]
    pub fn bodies(mut self) -> Self {
        self.fields.bodies = true;
        self
    }

    /// With a value of the laws, by its name. A frame is refused if no body's law has it.
    #[must_use]
    pub fn value(mut self, name: &str) -> Self {
        if !self.fields.values.iter().any(|known| known == name) {
            self.fields.values.push(name.to_owned());
        }
        self
    }

    /// With every value of every law.
    #[must_use]
    pub fn values(mut self) -> Self {
        self.fields.all_values = true;
        self
    }

    /// Writes a frame now, whether it is due or not, and returns its path. One at the time of the last frame replaces it.
    ///
    /// # Errors
    /// [`WatchError::Unknown`] for a value that no law has; [`WatchError::Write`] with the
    /// [`VtkError`](super::VtkError) for a time before the last frame's or a file that cannot be written.
    pub fn frame<const D: usize>(&mut self, scene: &Scene<D>) -> Result<PathBuf, WatchError> {
        let cloud = self.fields.cloud(scene)?;
        let written = self.series.write(scene.time(), cloud);
        written.map_err(|error| WatchError::Write(Box::new(error)))
    }

    /// The files so far.
    pub fn series(&self) -> &Series {
        &self.series
    }
}

impl<const D: usize> Watch<D> for ParticleSeries {
    fn after(&mut self, scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError> {
        if self.every.is_due(report) {
            self.frame(scene)?;
        }
        Ok(())
    }
}
