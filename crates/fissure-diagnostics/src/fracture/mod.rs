//! Fracture: what drives a crack, what it has done, and where it goes.
//!
//! | item | answers |
//! |---|---|
//! | [`TipField`], [`Rates`] | the particles around a tip, what they know there |
//! | [`j_integral`], [`contours`] | the energy release rate, and how far it depends on the domain |
//! | [`interaction`] | K_I and K_II |
//! | [`opening_profile`], [`apparent_tip`], [`opening_intensity`] | opening and sliding of the faces, the tip and K from them |
//! | [`energy_release`] | the energy release rate from two ledgers |
//! | [`hoop_angle`], [`EnergyReleaseGrowth`] | where a crack goes, and when |
//! | [`CrackHistory`] | length, onset and speed of a crack |
//! | [`CrackExtraction`] | cracks in a field of failed particles |
//! | [`FractureEnergy`], [`volume_integral`] | what failing has cost, by mode |

mod domain;
mod elastic;
mod extraction;
mod field;
mod growth;
mod history;
mod interaction;
mod modes;
mod near_tip;
mod opening;
mod release;

pub use domain::{Annulus, Contours, contours, j_integral};
pub use elastic::PlaneElastic;
pub use extraction::{CrackExtraction, ExtractedCrack, ExtractedCracks};
pub use field::{FaceLoad, Rates, TipField, TipFrame, TipSample};
pub use growth::{EnergyReleaseGrowth, GrowthDirection, hoop_angle};
pub use history::CrackHistory;
pub use interaction::{Intensity, interaction};
pub use modes::{FractureEnergy, volume_integral};
pub use near_tip::NearTip;
pub use opening::{FaceJump, apparent_tip, opening_intensity, opening_profile};
pub use release::energy_release;
