//! What quasi-static and implicit steps share: the balance of forces at the end of a step, as a
//! function of the displacement increments of the nodes, and its derivative.
//!
//! `links` lists which nodes a particle reaches at the start of the step, `kernel` strains the
//! particles, `averages` gives those of a patch one volume change, `one_strain` one strain, `balance` sums forces, `stiffness` differentiates them, `freedoms` takes out what
//! conditions hold, `system` solves for a correction, `descent` says when a correction is good
//! enough, `pace` chooses step lengths, `failure` and
//! `statistics` say how an attempt ended.

pub(crate) mod averages;
pub(crate) mod balance;
pub(crate) mod choice;
#[cfg(test)]
mod derivative_tests;
pub(crate) mod descent;
pub(crate) mod divided;
pub(crate) mod failure;
pub(crate) mod freedoms;
pub(crate) mod kernel;
pub(crate) mod links;
pub(crate) mod one_strain;
pub(crate) mod pace;
pub(crate) mod statistics;
pub(crate) mod stiffness;
pub(crate) mod system;
