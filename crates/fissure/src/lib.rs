//! Material failure with particle methods: the facade crate.
//!
//! One name for the whole workspace: each member is a module here, and [`prelude`] holds what a
//! simulation names. A law is a pure function ([`materials`]); a body is particles and one law, a
//! scene is bodies and what holds them ([`scene`]); a solver owns a grid and moves a scene by one
//! step ([`solvers`]); a watch looks at it after each step ([`diagnostics`], [`io`]).
//!
//! An elastic bar is pulled at one end:
//!
//! ```
//! use fissure::prelude::*;
//!
//! # fn main() -> Result<(), Error> {
//! let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.0 };
//! let mut scene = Scene::plane(Plane::Strain { thickness: 0.01 });
//! scene
//!     .fill("bar", steel, &Block::new([0.0, 0.0], [0.2, 0.02]), &Spacing(5e-3))?
//!     .rigid("left", &Block::new([-0.01, 0.0], [0.0, 0.02]), &Spacing(5e-3),
//!            Hold::Component(Vector2::x()), Velocity(|_| 0.0))?
//!     .rigid("right", &Block::new([0.2, 0.0], [0.21, 0.02]), &Spacing(5e-3),
//!            Hold::Component(Vector2::x()), Velocity(|_| 1e-6))?;
//!
//! let grid = Grid::over([-0.04, -0.04], [0.24, 0.06], 0.01)?;
//! let mut solver = QuasiStatic::new(grid, shape::Linear, QuasiStaticSettings::default())?;
//! run(&mut scene, &mut solver, Until::Time(1.0), &mut [])?;
//!
//! // E·A·δ/L, but for what the strain of 5e-6 does to the lengths.
//! let force = scene.reaction("right").map_or(f64::NAN, |r| r[0]);
//! assert!((force / (210e9 * 0.01 * 0.02 * 1e-6 / 0.2) - 1.0).abs() < 1e-4);
//! # Ok(())
//! # }
//! ```
//!
//! Features: `implicit` (on) for the quasi-static and implicit solvers, `plots` and `progress` (off) for
//! [`io`]'s figures and a bar on the terminal.
//!
//! The numbered examples beside this crate go on from here: `cargo run -p fissure --example 00_point`.

mod error;

pub use error::Error;
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
    pub use crate::Error;
    pub use fissure_diagnostics::{
        EnergyBalance, EnergyGuard, EnergyHistory, FailedZone, LoadCurve, LoadDisplacement, Record,
        SectionForce, curve_error, fit_slope, fracture, section_force, state_hash,
    };
    pub use fissure_grid::{Grid, QuadMesh, Shape, shape};
    pub use fissure_io::checkpoint::{AutoCheckpoint, Checkpoint};
    pub use fissure_io::gmsh::GmshMesh;
    #[cfg(feature = "progress")]
    pub use fissure_io::progress::Progress;
    pub use fissure_io::table::Table;
    pub use fissure_io::vtk::{Compression, ParticleSeries, Series};
    pub use fissure_materials::{
        AnisotropicDamage, Axis, Biot, Burn, Cohesive, Component, ConjugateDamage, Control, Crack,
        Cracking, DamagePlane, Decohesive, EIGHT, EightPoints, EightResponses, EllipticalDamage,
        Entry, Event, EventKind, Expansion, External, Formula, FormulaAnswer, GradientLeg, Hencky,
        Hyperelastic, Implex, Increment, Isotropic, J2, Jump, Jwl, Leg, LoweredStrength, Material,
        MaterialError, MazarsDamage, MazarsSoftening, MixedMode, Mode, NeoHookean, Normal, Onset,
        Orthotropic, OrthotropicDamage, Path, PlaneStress, Point, ProgramBurn, RankineDamage,
        Response, Sample, ScalarDamage, Scale, Softening, SteppedCircleDamage, SubSteps, Thermal,
        Traction, TractionSeparation, TwoCrackDamage, ViscousDamage, check_parameter, contract,
        criteria, hardening, localization, multi_crack,
        multi_crack::{ModeOne, MultiCrack, Planes},
        softening,
    };
    pub use fissure_particles::*;
    pub use fissure_scene::*;
    #[cfg(feature = "implicit")]
    pub use fissure_solvers::{
        Averaging, EmbeddedCrack, EmbeddedForm, EmbeddedJump, Implicit, ImplicitSettings,
        Integration, Iterative, LinearSolver, LoadControl, Method, NewtonStop, Preconditioning,
        Product, QuasiStatic, QuasiStaticSettings, Safeguard, StepStatistics,
    };
    pub use fissure_solvers::{BandSource, Explicit, ExplicitSettings, StressUpdate, Transfer};
    pub use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};
    // The module too: `vector!` expands to paths into it.
    pub use nalgebra::{self, SVector, Vector2, vector};
}

/// Compiles and runs the code blocks of the README and the pages of `docs/`.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../../../README.md")]
    mod readme {}
    #[doc = include_str!("../../../docs/start.md")]
    mod start {}
    #[doc = include_str!("../../../docs/concepts.md")]
    mod concepts {}
    #[doc = include_str!("../../../docs/own-law.md")]
    mod own_law {}
    #[doc = include_str!("../../../docs/strength-fields.md")]
    mod strength_fields {}
    #[doc = include_str!("../../../docs/choose-a-solver.md")]
    mod choose_a_solver {}
    #[doc = include_str!("../../../docs/cracks.md")]
    mod cracks {}
    #[doc = include_str!("../../../docs/fracture-diagnostics.md")]
    mod fracture_diagnostics {}
}
