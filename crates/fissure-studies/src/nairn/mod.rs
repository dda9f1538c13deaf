//! The examples of Nairn, Hammerquist & Aimene 2017, sec. 3.
//!
//! What the studies share is here: the numerics they choose from (`numerics`), the loop that runs
//! a scene and what its ledger says (`drive`), failed particles (`failed`), the notched plate (`plate`) and the tips of
//! its cracks (`tips`), and pictures.

pub mod apparent_toughness;
pub mod coating;
pub mod edge_notch;
pub mod interacting;
pub mod random_block;
pub mod stability;
pub mod uniaxial;

mod conjugate;
mod drive;
mod failed;
mod many;
mod numerics;
mod pictures;
mod plate;
mod reference;
mod tips;

use fissure_study::Study;

/// The studies, in the order of the document.
pub fn studies() -> Vec<Box<dyn Study>> {
    vec![
        Box::new(uniaxial::Uniaxial),
        Box::new(edge_notch::EdgeNotch),
        Box::new(apparent_toughness::ApparentToughness),
        Box::new(interacting::InteractingCracks),
        Box::new(coating::Coating),
        Box::new(random_block::RandomBlock),
        Box::new(stability::StabilityEta),
    ]
}
