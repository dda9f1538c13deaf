//! Bodies, what holds and loads them, and time: the scene every solver moves.
//!
//! A [`Scene`] knows no grid and no solver. It is filled with bodies (a law and particles), rigid
//! bodies and conditions; a [`Solver`] moves it by one step; a [`Watch`] looks at it after each
//! step; [`run`] is the loop for those who do not want to write it.
//!
//! ```
//! use fissure_materials::Isotropic;
//! use fissure_particles::{Block, Spacing};
//! use fissure_scene::{Hold, Plane, Scene, Velocity};
//! use nalgebra::Vector2;
//!
//! let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
//! let mut scene = Scene::plane(Plane::Strain { thickness: 0.01 });
//! scene
//!     .fill("bar", steel, &Block::new([0.0, 0.0], [0.2, 0.06]), &Spacing(5e-3))?
//!     .rigid("grip", &Block::new([-0.01, 0.0], [0.0, 0.06]), &Spacing(5e-3),
//!            Hold::Component(Vector2::x()), Velocity(|_| 0.0))?;
//! assert_eq!(scene.bodies()[0].particles().len(), 40 * 12);
//! # Ok::<(), fissure_scene::SceneError>(())
//! ```

mod body;
mod building;
mod condition;
mod contact;
mod crack;
mod error;
mod every;
mod in_place;
mod kinematics;
mod law;
mod ledger;
mod moving;
mod over_windows;
mod persist;
mod scene;
mod solution;
mod solver;
mod states;
mod sweep;

pub use body::{Body, BodyFailure, ParticleScale};
pub use condition::{Condition, ConditionKind, Constant, Hold, Selection, TimeFunction, Velocity};
pub use contact::{Contact, ContactLaw};
pub use crack::{
    Bond, BondAnswer, CarriedCrack, CrackError, CrackLine, CrackSettings, End, EndState, FacePoint,
    Foot, Grown, Growth, GrowthCriterion, GrowthError, Polyline, Side, VertexMotion, grow_cracks,
};
pub use error::{PersistError, SceneError, SolveError, WatchError};
pub use every::Every;
pub use fissure_materials::External;
pub use kinematics::{Kinematics, Plane};
pub use law::BodyLaw;
pub use ledger::{EnergyTotals, Report, StepEnergy};
pub use over_windows::for_each_window;
pub use persist::Section;
pub use scene::Scene;
pub use solution::{NewtonStop, Solution, StepControl};
pub use solver::{RunSummary, Solver, Until, Watch, run};
pub use states::state_bytes;
pub use sweep::{
    ByRun, KernelFailure, Run, RunConstants, RunKernel, SweepSettings, SweepTotals, Viscosity,
    WindowKernel,
};
