//! Explicit material-point method in momentum form [Sanchez 2010, sec. 4.2-4.3, μ = 0].
//!
//! A step: particles give mass, momentum and forces to the nodes; nodes are accelerated and held;
//! particles take the motion back; the law gives the new stress. When the stress is updated
//! relative to the forces is the [`StressUpdate`]; how velocities travel is the [`Transfer`].

mod booking;
mod contact;
mod filter;
mod grid_update;
mod kernels;
#[allow(clippy::needless_range_loop)] // Numbers name the components of matrices.
mod particle;
mod phases;
mod settings;
mod step;

pub use settings::{ExplicitSettings, StressUpdate, Transfer};
pub use step::Explicit;
