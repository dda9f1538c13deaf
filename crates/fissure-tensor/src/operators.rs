//! Addition and scaling of symmetric tensors.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::Sym;

impl Add for Sym {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, o: Self) -> Self {
        self += o;
        self
    }
}
impl Sub for Sym {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, o: Self) -> Self {
        self -= o;
        self
    }
}
impl Neg for Sym {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            mandel: self.mandel.map(|c| -c),
        }
    }
}
impl Mul<f64> for Sym {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, s: f64) -> Self {
        for c in &mut self.mandel {
            *c *= s;
        }
        self
    }
}
impl Div<f64> for Sym {
    type Output = Self;
    #[inline]
    fn div(self, s: f64) -> Self {
        Self {
            mandel: self.mandel.map(|c| c / s),
        }
    }
}
impl AddAssign for Sym {
    // A loop, not a closure: that would not be compiled for a vector unit.
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        for i in 0..6 {
            self.mandel[i] += o.mandel[i];
        }
    }
}
impl SubAssign for Sym {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        for i in 0..6 {
            self.mandel[i] -= o.mandel[i];
        }
    }
}
impl Sum for Sym {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::ZERO, Add::add)
    }
}
