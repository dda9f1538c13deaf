//! Symmetric tensors in Mandel form, fourth-order tangents, rotations and spectral decompositions.
//!
//! # Conventions, stated once for the whole workspace
//! - Tensors are three-dimensional, `f64`, SI units. Tension is positive; so is the opening of a crack.
//! - A symmetric second-order tensor is a [`Sym`]: six Mandel components in the order
//!   `xx, yy, zz, √2·yz, √2·xz, √2·xy`. The double contraction `A:B` is then the plain dot product
//!   and rotations act by orthogonal 6×6 matrices. Constructors and accessors named after a
//!   component (`new`, `xy`, …) take and give *tensor* components: no √2, no engineering shear.
//! - A fourth-order tensor with both minor symmetries is a [`Tangent`]: the 6×6 matrix that maps
//!   Mandel components to Mandel components.
//! - Eigenvalues descend, eigenvectors are right-handed; the Lode angle runs from 0 in uniaxial
//!   tension to π/3 in uniaxial compression.
//! - The deformation gradient `F` maps reference to current line elements; the polar decomposition
//!   is `F = R·U` with `U` symmetric positive definite.
//!
//! ```
//! use fissure_tensor::{Sym, Vector3};
//! let stress = Sym::new(2.0e6, -1.0e6, 0.0, 0.0, 0.0, 0.5e6);
//! let normal = Vector3::x();
//! assert!((stress.traction(&normal) - Vector3::new(2.0e6, 0.5e6, 0.0)).norm() < 1e-8);
//! assert_eq!(stress.trace(), 1.0e6);
//! ```

mod band;
mod eigen;
mod eigen_plane;
mod exponential;
mod functions;
mod invariants;
mod lyapunov;
mod operators;
mod polar;
mod root;
mod rotation;
pub mod simd;
mod spectral;
mod sym;
mod tangent;

pub use band::Band;
pub use exponential::exponential;
pub use lyapunov::solve_lyapunov;
pub use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
pub use polar::{Polar, polar};
pub use rotation::{rotation, rotation_between};
pub use spectral::Spectrum;
pub use sym::Sym;
pub use tangent::Tangent;
