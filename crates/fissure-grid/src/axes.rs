//! Several numbers at once: one per axis of space, or one per particle of eight.

use std::ops::{Add, Mul, Neg, Sub};

/// Places for axes: one more than space has, so that a vector unit takes all at once.
pub(crate) const AXES: usize = 4;

/// A number for each axis; those of axes that space has not are not used.
pub(crate) type Axes = Numbers<AXES>;

/// Numbers that the same is done to. Loops of fixed length without branches, which the compiler turns into vector
/// instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Numbers<const N: usize>(pub [f64; N]);

impl Axes {
    #[inline(always)]
    pub(crate) fn from_axes<const D: usize>(number: impl Fn(usize) -> f64) -> Self {
        let mut axes = [0.0; AXES];
        for (axis, to) in axes.iter_mut().enumerate().take(D) {
            *to = number(axis);
        }
        Self(axes)
    }
}

impl<const N: usize> Numbers<N> {
    #[inline(always)]
    pub(crate) fn splat(x: f64) -> Self {
        Self([x; N])
    }

    #[inline(always)]
    fn each(mut self, change: impl Fn(f64) -> f64) -> Self {
        for x in &mut self.0 {
            *x = change(*x);
        }
        self
    }

    #[inline(always)]
    fn with(mut self, other: Self, join: impl Fn(f64, f64) -> f64) -> Self {
        for (x, y) in self.0.iter_mut().zip(other.0) {
            *x = join(*x, y);
        }
        self
    }

    #[inline(always)]
    pub(crate) fn floor(self) -> Self {
        self.each(f64::floor)
    }

    /// The larger of two; the number where the other is none.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(other, |x, y| if x > y { x } else { y })
    }

    /// The smaller of two; the number where the other is none.
    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.with(other, |x, y| if x < y { x } else { y })
    }

    /// 1 where at least `limit`, else 0.
    #[inline(always)]
    pub(crate) fn step(self, limit: f64) -> Self {
        self.each(|x| if x >= limit { 1.0 } else { 0.0 })
    }
}

impl<const N: usize> Add for Numbers<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |x, y| x + y)
    }
}

impl<const N: usize> Sub for Numbers<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |x, y| x - y)
    }
}

impl<const N: usize> Mul for Numbers<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |x, y| x * y)
    }
}

impl<const N: usize> Mul<f64> for Numbers<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.each(|x| x * factor)
    }
}

impl<const N: usize> Add<f64> for Numbers<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, term: f64) -> Self {
        self.each(|x| x + term)
    }
}

impl<const N: usize> Neg for Numbers<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.each(|x| -x)
    }
}
