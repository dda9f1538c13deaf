//! The root of a tensor near the identity, without a spectrum.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::Sym;
use crate::simd::EIGHT;

impl Sym {
    /// `√(1 + A) − 1`, to the relative accuracy of `A`; `None` where `|A|` is over 0.1.
    ///
    /// The binomial series by Horner's rule, with the powers of `A` reduced by Cayley and Hamilton, is cut off where the
    /// terms are below round-off.
    #[inline]
    pub fn root_of_one_plus(&self) -> Option<Self> {
        let squared = self.dot(self);
        if !(squared <= LARGEST) {
            return None;
        }
        let terms = terms(squared);
        let first = self.trace();
        let second = 0.5 * (first * first - squared);
        let third = self.determinant();
        let (mut p, mut q, mut r) = (ROOT[terms - 1], 0.0, 0.0);
        for c in ROOT[..terms - 1].iter().rev() {
            (p, q, r) = (c + third * r, p - second * r, q + first * r);
        }
        let powers = *self * (p - second * r) + self.commuting_product(self) * (q + first * r);
        Some(Self::IDENTITY * (third * r) + powers)
    }

    /// [`root_of_one_plus`](Self::root_of_one_plus) of eight, to the last bit; `None` where one is over 0.1.
    ///
    /// The powers that one alone leaves out have coefficients of zero here, so that all eight take the same turns.
    #[inline(always)]
    pub fn roots_of_one_plus(eight: &[Self; EIGHT]) -> Option<[Self; EIGHT]> {
        let mut squared = [0.0; EIGHT];
        let mut largest: f64 = 0.0;
        let mut small = true;
        for (squared, a) in squared.iter_mut().zip(eight) {
            *squared = a.dot(a);
            small &= *squared <= LARGEST;
            largest = if *squared > largest {
                *squared
            } else {
                largest
            };
        }
        if !small {
            return None;
        }
        let terms = terms(largest);
        let mut invariants = [[0.0; EIGHT]; 3];
        for place in 0..EIGHT {
            let a = &eight[place];
            invariants[0][place] = a.trace();
            invariants[1][place] =
                0.5 * (invariants[0][place] * invariants[0][place] - squared[place]);
            invariants[2][place] = a.determinant();
        }
        let (mut p, mut q, mut r) = ([0.0; EIGHT], [0.0; EIGHT], [0.0; EIGHT]);
        for term in (0..terms).rev() {
            for place in 0..EIGHT {
                let counts = term == 0 || squared[place] > ENOUGH[term - 1];
                let c = if counts { ROOT[term] } else { 0.0 };
                let [first, second, third] = invariants;
                (p[place], q[place], r[place]) = (
                    c + third[place] * r[place],
                    p[place] - second[place] * r[place],
                    q[place] + first[place] * r[place],
                );
            }
        }
        let mut roots = [Self::ZERO; EIGHT];
        for place in 0..EIGHT {
            let a = &eight[place];
            let [first, second, third] = invariants;
            let powers = *a * (p[place] - second[place] * r[place])
                + a.commuting_product(a) * (q[place] + first[place] * r[place]);
            roots[place] = Self::IDENTITY * (third[place] * r[place]) + powers;
        }
        Some(roots)
    }

    /// The product with a tensor of the same axes, which is symmetric.
    #[inline(always)]
    pub fn commuting_product(&self, other: &Self) -> Self {
        let (a, b) = (&self.mandel, &other.mandel);
        let (yz, xz, xy) = (0.5 * a[3] * b[3], 0.5 * a[4] * b[4], 0.5 * a[5] * b[5]);
        Self {
            mandel: [
                a[0] * b[0] + (xy + xz),
                a[1] * b[1] + (xy + yz),
                a[2] * b[2] + (xz + yz),
                a[1] * b[3] + a[3] * b[2] + FRAC_1_SQRT_2 * a[5] * b[4],
                a[0] * b[4] + a[4] * b[2] + FRAC_1_SQRT_2 * a[5] * b[3],
                a[0] * b[5] + a[5] * b[1] + FRAC_1_SQRT_2 * a[4] * b[3],
            ],
        }
    }
}

/// Beyond this square of `|A|` there are too many terms.
const LARGEST: f64 = 1e-2;

/// Up to these squares of `|A|` one term of the root, two, and so on are enough: the next is below 5e-17 of the first.
const ENOUGH: [f64; ROOT.len() - 1] = [
    3.9e-32, 4e-16, 7.4e-11, 3e-8, 1e-6, 1.1e-5, 6.2e-5, 2.1e-4, 5.7e-4, 1.2e-3, 2.3e-3, 3.9e-3,
    6.2e-3, 9e-3,
];

#[inline(always)]
fn terms(squared: f64) -> usize {
    let more = ENOUGH.iter().take_while(|enough| squared > **enough);
    1 + more.count()
}

/// `√(1 + x) − 1 = Σ c_k x^k`, from `c_1`.
const ROOT: [f64; 15] = [
    0.5,
    -0.125,
    0.0625,
    -0.039_062_5,
    0.027_343_75,
    -0.020_507_812_5,
    0.016_113_281_25,
    -0.013_092_041_015_625,
    0.010_910_034_179_687_5,
    -0.009_273_529_052_734_375,
    0.008_008_956_909_179_688,
    -0.007_007_837_295_532_227,
    0.006_199_240_684_509_277,
    -0.005_535_036_325_454_712,
    0.004_981_532_692_909_241,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Symmetric tensors of all shapes with this norm.
    fn tensors(size: f64) -> impl Iterator<Item = Sym> {
        (0..64).map(move |i| {
            let angle = |k: i32| f64::from(i * k + k).sin();
            let a = Sym::new(angle(1), angle(2), angle(3), angle(5), angle(7), angle(11));
            a * (size / a.norm())
        })
    }

    #[test]
    fn the_root_squared_is_the_tensor_to_round_off_of_the_difference() {
        for exponent in 0..60 {
            for a in tensors(0.0999 * 10f64.powf(-0.1 * f64::from(exponent))) {
                let root = a.root_of_one_plus().unwrap_or(Sym::ZERO);
                let error = root * 2.0 + root.commuting_product(&root) - a;
                assert!(error.norm() < 4.0 * f64::EPSILON * a.norm(), "{a:?}");
            }
        }
        assert!(Sym::diagonal(0.11, 0.0, 0.0).root_of_one_plus().is_none());
        assert!(
            Sym::diagonal(f64::NAN, 0.0, 0.0)
                .root_of_one_plus()
                .is_none()
        );
    }

    #[test]
    fn eight_roots_are_those_of_each_to_the_last_bit() {
        let mixed: Vec<Sym> = (0..8).flat_map(|k| tensors(0.09 / 10f64.powi(k))).collect();
        for start in 0..64 {
            let eight: [Sym; EIGHT] = std::array::from_fn(|k| mixed[start + 64 * k]);
            let each = eight.map(|a| a.root_of_one_plus());
            assert_eq!(
                Sym::roots_of_one_plus(&eight).map(|all| all.map(Some)),
                Some(each)
            );
        }
    }
}
