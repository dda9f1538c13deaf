//! The experiments of the source documents, one sub-command each.
//!
//! A study implements [`fissure_study::Study`] and is listed in [`studies`].

mod bar;
mod convergence;
mod filling;
mod method;
mod problem;
pub mod tensile_bar;
pub mod verification;

use fissure_study::Study;

/// Every study of the binary, in the order of `--list`.
pub fn studies() -> Vec<Box<dyn Study>> {
    let mut studies: Vec<Box<dyn Study>> = vec![Box::new(tensile_bar::TensileBar)];
    studies.extend(verification::studies());
    studies.extend(fissure_law_studies::studies());
    studies
}
