//! Constitutive laws, the material-point driver and the public battery of contract checks.
//!
//! A law is a pure function from an [`Increment`] and an old state to a [`Response`]: it does not
//! know the particle, the grid or the time step's history, so retry, Newton, line search and
//! replay are free. Write one by implementing [`Material`]; every solver takes it as it is.
//!
//! ```
//! use fissure_materials::{Increment, Isotropic, Material, Matrix3};
//! let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
//! let mut stretched = Matrix3::identity();
//! stretched.m11 = 1.001;
//! let response = steel.update(&Increment::to(stretched), &())?;
//! // Uniaxial strain: the stress is the P-wave modulus times the strain.
//! assert!((response.stress.xx() - steel.p_wave_modulus() * 1e-3).abs() < 1e-3);
//! # Ok::<(), fissure_materials::MaterialError>(())
//! ```

mod biot;
pub mod contract;
mod cracking;
mod decohesive;
mod equilibrium;
mod error;
mod finite_strain;
mod hencky;
mod increment;
mod isotropic;
mod material;
mod neo_hookean;
mod path;
mod plane_stress;
mod point;
pub mod softening;
#[cfg(test)]
mod testing;
mod turning;

pub use biot::Biot;
pub use cracking::{Crack, Cracking, Initiation};
pub use decohesive::{Decohesive, DecohesiveState, Normal};
pub use error::{MaterialError, check_parameter};
pub use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};
pub use hencky::Hencky;
pub use increment::{External, Increment, Response, Scale};
pub use isotropic::Isotropic;
pub use material::Material;
pub use neo_hookean::NeoHookean;
pub use path::{Axis, Component, Control, Entry, GradientLeg, Leg, Path, Stage, SubSteps};
pub use plane_stress::{PlaneStress, PlaneStressState};
pub use point::{Event, EventKind, History, Point, PointError, Sample};
pub use softening::Softening;
