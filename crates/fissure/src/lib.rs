//! Material failure with particle methods: the facade crate.

pub use fissure_diagnostics as diagnostics;
pub use fissure_grid as grid;
pub use fissure_io as io;
pub use fissure_materials as materials;
pub use fissure_particles as particles;
pub use fissure_scene as scene;
pub use fissure_solvers as solvers;
pub use fissure_tensor as tensor;
pub use nalgebra;

/// Everything a simulation names.
pub mod prelude {
    pub use fissure_grid::{Grid, Shape, shape};
    pub use fissure_materials::{
        Cracking, Decohesive, Increment, Isotropic, Material, MaterialError, Normal, Response,
        Scale, Softening, softening,
    };
    pub use fissure_particles::*;
    pub use fissure_scene::*;
    pub use fissure_solvers::{
        BandSource, Explicit, ExplicitSettings, QuasiStatic, QuasiStaticSettings, StressUpdate,
        Transfer,
    };
    pub use fissure_tensor::{Band, Matrix3, Sym, Vector3};
    pub use nalgebra::{Vector2, vector};
}
