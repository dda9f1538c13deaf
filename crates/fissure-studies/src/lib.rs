//! The experiments of the source documents, one sub-command each.
//!
//! A study implements [`fissure_study::Study`] and is listed in [`studies`].

mod bar;
mod bar_bifurcation;
mod bar_embedded;
mod bar_orientation;
mod bar_snapback;
mod compact_tension;
mod convergence;
mod drawing;
mod filling;
mod laws;
mod method;
pub mod nairn;
mod problem;
mod softening_wave;
mod stable_step;
mod stiff;
mod stress_intensity;
pub mod tensile_bar;
pub mod verification;
mod work_precision;

use fissure_study::Study;

/// Every study of the binary, in the order of `--list`.
pub fn studies() -> Vec<Box<dyn Study>> {
    let mut studies: Vec<Box<dyn Study>> = vec![Box::new(tensile_bar::TensileBar)];
    studies.extend(verification::studies());
    studies.push(Box::new(work_precision::WorkPrecision));
    studies.push(Box::new(stiff::Stiff));
    studies.push(Box::new(stable_step::StableStep));
    studies.push(Box::new(problem::Verification(
        softening_wave::SofteningWave,
    )));
    studies.push(Box::new(problem::Verification(
        stress_intensity::StressIntensity,
    )));
    studies.push(Box::new(bar_orientation::BarOrientation));
    studies.push(Box::new(bar_embedded::BarEmbedded));
    studies.push(Box::new(bar_bifurcation::BarBifurcation));
    studies.push(Box::new(bar_snapback::BarSnapback));
    studies.push(Box::new(compact_tension::CompactTension));
    studies.extend(nairn::studies());
    studies.extend(laws::studies());
    studies
}
