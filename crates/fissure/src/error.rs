//! Everything that can go wrong, for programs that only hand errors on.

use thiserror::Error;

/// Any error of the workspace, so that `?` works throughout a program.
///
/// Each says on its own what is wrong; this type adds nothing.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A grid refused its bounds.
    #[error(transparent)]
    Grid(#[from] fissure_grid::GridError),
    /// A mesh refused its nodes or elements.
    #[error(transparent)]
    Mesh(#[from] fissure_grid::MeshError),
    /// A file of gmsh was refused.
    #[error(transparent)]
    Gmsh(#[from] fissure_io::gmsh::GmshError),
    /// A region refused its shape.
    #[error(transparent)]
    Region(#[from] fissure_particles::RegionError),
    /// A region could not be filled.
    #[error(transparent)]
    Seed(#[from] fissure_particles::SeedError),
    /// A random field or its distribution was refused.
    #[error(transparent)]
    Field(#[from] fissure_particles::FieldError),
    /// A law refused its parameters or a deformation.
    #[error(transparent)]
    Law(#[from] fissure_materials::MaterialError),
    /// A material point stopped.
    #[error(transparent)]
    Point(#[from] fissure_materials::PointError),
    /// A law breaks a property of the contract.
    #[error(transparent)]
    Contract(#[from] fissure_materials::contract::Violation),
    /// A scene refused what it was given.
    #[error(transparent)]
    Scene(#[from] fissure_scene::SceneError),
    /// A crack was refused.
    #[error(transparent)]
    Crack(#[from] fissure_scene::CrackError),
    /// Cracks could not grow.
    #[error(transparent)]
    Growth(#[from] fissure_scene::GrowthError),
    /// A step failed.
    #[error(transparent)]
    Solve(#[from] fissure_scene::SolveError),
    /// A watch failed.
    #[error(transparent)]
    Watch(#[from] fissure_scene::WatchError),
    /// A scene could not be saved or restored.
    #[error(transparent)]
    Persist(#[from] fissure_scene::PersistError),
    /// A measure could not be taken.
    #[error(transparent)]
    Measure(#[from] fissure_diagnostics::MeasureError),
    /// Curves could not be compared.
    #[error(transparent)]
    Curve(#[from] fissure_diagnostics::CurveError),
    /// A checkpoint was refused or could not be written.
    #[error(transparent)]
    Checkpoint(#[from] fissure_io::checkpoint::CheckpointError),
    /// A table was refused or could not be written.
    #[error(transparent)]
    Table(#[from] fissure_io::table::TableError),
    /// A ParaView file could not be written.
    #[error(transparent)]
    Vtk(#[from] fissure_io::vtk::VtkError),
}
