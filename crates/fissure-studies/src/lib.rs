//! The experiments of the source documents, one sub-command each.
//!
//! A study implements [`fissure_study::Study`] and is listed in [`studies`].

pub mod nairn;
pub mod tensile_bar;

use fissure_study::Study;

/// Every study of the binary, in the order of `--list`.
pub fn studies() -> Vec<Box<dyn Study>> {
    let mut studies: Vec<Box<dyn Study>> = vec![Box::new(tensile_bar::TensileBar)];
    studies.extend(nairn::studies());
    studies.extend(fissure_law_studies::studies());
    studies
}
