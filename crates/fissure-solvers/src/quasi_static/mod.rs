//! Quasi-static material-point method [Sanchez 2010, app. B]: equilibrium of every load step by
//! Newton's method with the law's tangent.
//!
//! The unknowns are the displacement increments of the nodes; the nodes return to their places
//! after each step. With `f = 1 + ∇u` the increment of deformation, `F = f·F_old`,
//! `∇_x N = f⁻ᵀ ∇N`, the residual is `f_ext − Σ V σ·∇_x N` and its derivative is assembled from
//! the law's Truesdell tangent `c` and the stress: `Σ V (∇_x N_i · c · ∇_x N_j + ∇_x N_i·σ·∇_x N_j 1)`.
//! A step that does not converge is cut and tried again; the scene is untouched until one does.
//!
//! `trial` is a step in the making; `newton` balances it at a given load, `path` with the load as an
//! unknown, for which `border` has the scalar equations; `control` chooses between them, `step` cuts and books. `faces`
//! says what faces of cracks do to each other, `embedded` what a crack within cells does.

mod border;
mod control;
mod embedded;
mod embedded_crack;
mod faces;
mod newton;
mod path;
mod settings;
mod step;
mod trial;

pub use embedded_crack::{EmbeddedCrack, EmbeddedForm, EmbeddedJump};
pub use settings::{Averaging, LoadControl, QuasiStaticSettings, Safeguard};
pub use step::QuasiStatic;
