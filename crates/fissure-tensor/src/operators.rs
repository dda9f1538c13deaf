//! Addition and scaling of symmetric tensors.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::Sym;

impl Add for Sym {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self {
            mandel: std::array::from_fn(|i| self.mandel[i] + o.mandel[i]),
        }
    }
}
impl Sub for Sym {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self {
            mandel: std::array::from_fn(|i| self.mandel[i] - o.mandel[i]),
        }
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
    #[inline]
    fn mul(self, s: f64) -> Self {
        Self {
            mandel: self.mandel.map(|c| c * s),
        }
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
    #[inline]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Sym {
    #[inline]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
impl Sum for Sym {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::ZERO, Add::add)
    }
}
