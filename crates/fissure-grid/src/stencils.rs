//! Stencils of eight particles of a tile: what transfers between particles and nodes go through.

mod affine;
mod one_by_one;
mod separable;

pub use one_by_one::OneByOne;
pub use separable::SeparableStencils;

use crate::simd::{EIGHT, Lanes};
use crate::stencil::{Gathered, Gift, SUMS};

/// What the sloped numbers of a [`Gift`] are multiplied by, known when a transfer is compiled.
pub trait By {
    /// Nothing: they are not given.
    const NOTHING: bool = false;
    /// All by `N (x_i − x)_a`.
    const ARMS: bool = false;
}

/// Values alone are given.
#[derive(Clone, Copy, Debug)]
pub struct ByNothing;
/// The first [`FIELD`](crate::FIELD) of the sloped numbers go by `N (x_i − x)_a`, the rest by `∂N/∂x_a`.
#[derive(Clone, Copy, Debug)]
pub struct ByArmsAndSlopes;
/// All sloped numbers go by `N (x_i − x)_a`.
#[derive(Clone, Copy, Debug)]
pub struct ByArms;

impl By for ByNothing {
    const NOTHING: bool = true;
}
impl By for ByArmsAndSlopes {}
impl By for ByArms {
    const ARMS: bool = true;
}

/// How much each of eight particles, by its place, gives to and takes from the nodes of a window.
pub trait Stencils<const D: usize> {
    /// A bit for each particle, by its place: whether it is on the grid, its nodes in the window, and the shape can use its
    /// domain. What the others give and take has no meaning.
    fn fitting(&self) -> u8;

    /// The bit of a particle.
    #[inline(always)]
    fn fits(&self, place: usize) -> bool {
        self.fitting() >> place & 1 == 1
    }

    /// Whether ∇N is zero wherever N is.
    const SMOOTH: bool;

    /// Sums of a field over the nodes of all eight: `Σ N v`, with `G` the `Σ v ∂_a N`, with `M` the `Σ N (x_i − x)_a v`.
    /// What is not asked for has no meaning, and of the last number only the value and gradient of shapes that are not
    /// [`SMOOTH`](Self::SMOOTH) have one.
    ///
    /// `field` holds [`FIELD`](crate::FIELD) numbers for each of
    /// [`ELEMENTS`](crate::Window::ELEMENTS) of a window.
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        field: &[f64],
    ) -> Gathered<L::Eight, D>;

    /// Adds what the first `count` particles, at least one, give, those that fit, to the sums of every node: `N value`, and what is
    /// sloped by what `B` says. `sums` holds one for each of the
    /// [`ELEMENTS`](crate::Window::ELEMENTS) of a window, at its [`sums_entry`](crate::sums_entry).
    fn scatter<L: Lanes, B: By>(
        &self,
        lanes: L,
        gifts: &[Gift<D>; EIGHT],
        count: usize,
        sums: &mut [[f64; SUMS]],
    );
}
