//! Problems with exact or agreed answers, with observed orders.

mod axis_aligned_mms;
mod bar_vibration;
mod brazilian;
mod cantilever;
mod cook;
mod disc_spin;
mod fitting;
mod manufactured;
mod nodal_force;
mod two_discs;
mod vortex_mms;

pub(crate) use axis_aligned_mms::AxisAlignedMms;
pub(crate) use vortex_mms::VortexMms;

use fissure_study::Study;

use crate::problem::Verification;

/// The studies of these problems.
pub fn studies() -> Vec<Box<dyn Study>> {
    vec![
        Box::new(Verification(AxisAlignedMms)),
        Box::new(Verification(VortexMms)),
        Box::new(Verification(disc_spin::DiscSpin)),
        Box::new(Verification(bar_vibration::BarVibration)),
        Box::new(Verification(cantilever::Cantilever)),
        Box::new(Verification(cook::Cook)),
        Box::new(Verification(brazilian::Brazilian)),
        Box::new(Verification(two_discs::TwoDiscs)),
    ]
}
