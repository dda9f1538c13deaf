//! A scene and its solver's memory in one file.

use std::path::Path;

use fissure_scene::{Scene, Section};

use super::{CheckpointError, CheckpointReader, CheckpointWriter, Content};

/// The one section that is not the scene's: those of bodies hold a slash.
const MEMORY: &str = "solver memory";

/// Saving and loading scenes.
///
/// A checkpoint holds what has happened to a scene, not what it is made of: laws, conditions and functions of time are
/// code. To restart, build the scene by the same code, then load. A restarted run gives the same bits as one that was
/// never interrupted, if it runs to the same end.
///
/// A step that fails leaves the scene as it was before, so what led there can be saved and looked at:
///
/// ```
/// use fissure_grid::{Grid, shape};
/// use fissure_io::checkpoint::Checkpoint;
/// use fissure_materials::Isotropic;
/// use fissure_particles::{Block, Spacing};
/// use fissure_scene::{Plane, Scene, SceneError, Solver};
/// use fissure_solvers::{Explicit, ExplicitSettings};
/// use nalgebra::Vector2;
///
/// fn build() -> Result<Scene<2>, SceneError> {
///     let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
///     let mut scene = Scene::plane(Plane::Strain { thickness: 0.01 });
///     scene
///         .fill("block", steel, &Block::new([0.0, 0.0], [0.1, 0.1]), &Spacing(0.025))?
///         .set_velocity("block", |_| Vector2::new(5e3, 0.0))?; // soon off the grid
///     Ok(scene)
/// }
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("block.checkpoint");
/// let grid = Grid::over([-0.2, -0.2], [0.3, 0.3], 0.05)?;
/// let mut solver = Explicit::new(grid, shape::Linear, ExplicitSettings::default())?;
/// let mut scene = build()?;
/// let failure = loop {
///     if let Err(error) = solver.step(&mut scene, 1e-3) {
///         Checkpoint::save(&path, &scene, &solver.memory())?;
///         break error;
///     }
/// };
///
/// // Later: the same scene just before it happens, to the bit.
/// let mut again = build()?;
/// solver.recall(&Checkpoint::load(&path, &mut again)?);
/// assert_eq!(again.time(), scene.time());
/// let repeated = solver.step(&mut again, 1e-3).map_err(|error| error.to_string());
/// assert_eq!(repeated, Err(failure.to_string()));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Copy)]
pub enum Checkpoint {}

impl Checkpoint {
    /// Saves a scene and what its solver's [`memory`](fissure_scene::Solver::memory) gave, replacing a file that is there
    /// in one piece. When this returns the checkpoint survives a power failure. The folder must exist.
    ///
    /// # Errors
    /// [`CheckpointError::File`] if the operating system refuses, [`CheckpointError::Scene`] if a state does not encode.
    pub fn save<const D: usize>(
        path: impl AsRef<Path>,
        scene: &Scene<D>,
        solver_memory: &[f64],
    ) -> Result<(), CheckpointError> {
        let path = path.as_ref();
        let sections = scene.save().map_err(|source| CheckpointError::Scene {
            path: path.to_owned(),
            source,
        })?;
        let mut checkpoint = CheckpointWriter::new();
        for Section { name, bytes } in sections {
            checkpoint.put_bytes(&name, bytes)?;
        }
        checkpoint.put(MEMORY, solver_memory)?;
        checkpoint.write(path)
    }

    /// Loads a checkpoint into a scene built by the same code, and returns what is to be given to the solver's
    /// [`recall`](fissure_scene::Solver::recall).
    ///
    /// # Errors
    /// A file that is no checkpoint, truncated or damaged, by the name of the section: the scene is then untouched.
    /// [`CheckpointError::Scene`] if it is of another scene: this one may then be partly restored and is to be dropped.
    pub fn load<const D: usize>(
        path: impl AsRef<Path>,
        scene: &mut Scene<D>,
    ) -> Result<Vec<f64>, CheckpointError> {
        let path = path.as_ref();
        let reader = CheckpointReader::open(path)?;
        let memory = reader.get(MEMORY)?;
        let sections = reader.sections().filter(|part| part.1 == Content::Bytes);
        let section = |(name, _): (&str, Content)| {
            Ok(Section {
                name: name.to_owned(),
                bytes: reader.get_bytes(name)?,
            })
        };
        let sections: Vec<Section> = sections
            .map(section)
            .collect::<Result<_, CheckpointError>>()?;
        let refused = |source| CheckpointError::Scene {
            path: path.to_owned(),
            source,
        };
        scene.restore(&sections).map_err(refused)?;
        Ok(memory)
    }
}
