//! Fracture: what drives a crack, what it has done, and where it goes.

mod domain;
mod elastic;
mod field;
mod interaction;
mod near_tip;

pub use domain::{Annulus, Contours, contours, j_integral};
pub use elastic::PlaneElastic;
pub use field::{FaceLoad, Rates, TipField, TipFrame, TipSample};
pub use interaction::{Intensity, interaction};
pub use near_tip::NearTip;
