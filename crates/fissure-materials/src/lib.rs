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

mod anisotropic_damage;
mod biot;
mod cohesive;
pub mod contract;
mod cracking;
pub mod criteria;
mod crossing;
mod decohesive;
mod eight;
mod equilibrium;
mod error;
mod finite_strain;
mod formula;
pub mod hardening;
mod hencky;
mod implex;
mod increment;
mod isotropic;
mod j2;
mod jwl;
pub mod localization;
mod logarithmic;
mod lowered_strength;
mod material;
pub mod multi_crack;
mod neo_hookean;
mod orthotropic;
mod path;
mod plane_stress;
mod point;
mod rotated;
mod scalar_damage;
mod sheet;
pub mod softening;
mod sound;
mod stress_measure;
mod tension_shear;
#[cfg(test)]
mod testing;
mod thermal;
mod turning;
mod viscous_damage;
mod wrapping;

pub use anisotropic_damage::{
    AnisotropicDamage, AnisotropicDamageState, ConjugateDamage, DamagePlane, EllipticalDamage,
    IncrementalDamage, IncrementalState, MixedMode, Mode, OrthotropicDamage, SteppedCircleDamage,
    TwoCrackDamage, TwoCrackState,
};
pub use biot::Biot;
pub use cohesive::{Cohesive, Jump, Traction, TractionSeparation, TractionSeparationState};
pub use cracking::{Crack, Cracking, Initiation};
pub use decohesive::{Decohesive, DecohesiveState, Normal};
pub use eight::{EightPoints, EightResponses};
pub use error::{MaterialError, check_parameter};
pub use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3, simd::EIGHT};
pub use formula::{Formula, FormulaAnswer, Hyperelastic};
pub use hardening::Hardening;
pub use hencky::Hencky;
pub use implex::{Extrapolated, Implex, ImplexState};
pub use increment::{External, Increment, Response, Scale};
pub use isotropic::Isotropic;
pub use j2::{J2, J2State};
pub use jwl::{Burn, Jwl, JwlState, ProgramBurn};
pub use lowered_strength::{Lowered, LoweredStrength, LoweredStrengthState};
pub use material::Material;
pub use neo_hookean::NeoHookean;
pub use orthotropic::Orthotropic;
pub use path::{Axis, Component, Control, Entry, GradientLeg, Leg, Path, Stage, SubSteps};
pub use plane_stress::{PlaneStress, PlaneStressState, SheetStep};
pub use point::{Event, EventKind, History, Point, PointError, Sample};
pub use scalar_damage::{
    DamageEvolution, Evolved, MazarsDamage, MazarsSoftening, Measure, RankineDamage, ScalarDamage,
    ScalarDamageState,
};
pub use softening::Softening;
pub use tension_shear::Onset;
pub use thermal::{Expansion, Thermal, ThermalState};
pub use viscous_damage::{DamageSurface, Relaxation, ViscousDamage, ViscousDamageState};
