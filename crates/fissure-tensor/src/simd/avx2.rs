//! Eight numbers as two times four on AVX2.

use std::arch::x86_64::{_CMP_GE_OQ, _MM_HINT_T0};

use pulp::x86::V3;
use pulp::{Simd as _, cast, f64x2, f64x4};

use super::Lanes;

impl Lanes for V3 {
    type Eight = [f64x4; 2];

    #[inline(always)]
    fn splat(self, x: f64) -> [f64x4; 2] {
        [self.splat_f64x4(x); 2]
    }
    #[inline(always)]
    fn load(self, x: &[f64; 8]) -> [f64x4; 2] {
        cast(*x)
    }
    #[inline(always)]
    fn store(self, x: [f64x4; 2], to: &mut [f64; 8]) {
        *to = cast(x);
    }
    #[inline(always)]
    fn add(self, a: [f64x4; 2], b: [f64x4; 2]) -> [f64x4; 2] {
        [self.add_f64s(a[0], b[0]), self.add_f64s(a[1], b[1])]
    }
    #[inline(always)]
    fn sub(self, a: [f64x4; 2], b: [f64x4; 2]) -> [f64x4; 2] {
        [self.sub_f64s(a[0], b[0]), self.sub_f64s(a[1], b[1])]
    }
    #[inline(always)]
    fn div(self, a: [f64x4; 2], b: [f64x4; 2]) -> [f64x4; 2] {
        [self.div_f64s(a[0], b[0]), self.div_f64s(a[1], b[1])]
    }
    #[inline(always)]
    fn mul(self, a: [f64x4; 2], b: [f64x4; 2]) -> [f64x4; 2] {
        [self.mul_f64s(a[0], b[0]), self.mul_f64s(a[1], b[1])]
    }
    #[inline(always)]
    fn mul_add(self, a: [f64x4; 2], b: [f64x4; 2], c: [f64x4; 2]) -> [f64x4; 2] {
        [
            self.mul_add_f64x4(a[0], b[0], c[0]),
            self.mul_add_f64x4(a[1], b[1], c[1]),
        ]
    }
    #[inline(always)]
    fn pair(self, low: f64, high: f64) -> [f64x4; 2] {
        [self.splat_f64x4(low), self.splat_f64x4(high)]
    }
    #[inline(always)]
    fn max(self, a: [f64x4; 2], b: [f64x4; 2]) -> [f64x4; 2] {
        [self.max_f64s(a[0], b[0]), self.max_f64s(a[1], b[1])]
    }
    #[inline(always)]
    fn not_negative(self, x: [f64x4; 2]) -> u8 {
        self.not_negative4(x[0]) | self.not_negative4(x[1]) << 4
    }
    #[inline(always)]
    fn transpose(self, r: [[f64x4; 2]; 8]) -> [[f64x4; 2]; 8] {
        // The four blocks of the matrix.
        let a = self.turned([r[0][0], r[1][0], r[2][0], r[3][0]]);
        let b = self.turned([r[4][0], r[5][0], r[6][0], r[7][0]]);
        let c = self.turned([r[0][1], r[1][1], r[2][1], r[3][1]]);
        let d = self.turned([r[4][1], r[5][1], r[6][1], r[7][1]]);
        [
            [a[0], b[0]],
            [a[1], b[1]],
            [a[2], b[2]],
            [a[3], b[3]],
            [c[0], d[0]],
            [c[1], d[1]],
            [c[2], d[2]],
            [c[3], d[3]],
        ]
    }
    #[inline(always)]
    fn columns4(self, r: [&[f64; 4]; 8]) -> [[f64x4; 2]; 4] {
        let a = self.turned([cast(*r[0]), cast(*r[1]), cast(*r[2]), cast(*r[3])]);
        let b = self.turned([cast(*r[4]), cast(*r[5]), cast(*r[6]), cast(*r[7])]);
        [[a[0], b[0]], [a[1], b[1]], [a[2], b[2]], [a[3], b[3]]]
    }
    #[inline(always)]
    fn rows4(self, c: [[f64x4; 2]; 4]) -> [[f64; 4]; 8] {
        let a = self.turned([c[0][0], c[1][0], c[2][0], c[3][0]]);
        let b = self.turned([c[0][1], c[1][1], c[2][1], c[3][1]]);
        [
            cast(a[0]),
            cast(a[1]),
            cast(a[2]),
            cast(a[3]),
            cast(b[0]),
            cast(b[1]),
            cast(b[2]),
            cast(b[3]),
        ]
    }
    #[inline(always)]
    fn columns2(self, r: [&[f64; 2]; 8]) -> [[f64x4; 2]; 2] {
        let a = self.interleaved(self.joined2(*r[0], *r[2]), self.joined2(*r[1], *r[3]));
        let b = self.interleaved(self.joined2(*r[4], *r[6]), self.joined2(*r[5], *r[7]));
        [[a[0], b[0]], [a[1], b[1]]]
    }
    #[inline(always)]
    fn rows2(self, columns: [[f64x4; 2]; 2]) -> [[f64; 2]; 8] {
        let [even, odd] = self.interleaved(columns[0][0], columns[1][0]);
        let (a, b) = (self.split2(even), self.split2(odd));
        let [even, odd] = self.interleaved(columns[0][1], columns[1][1]);
        let (c, d) = (self.split2(even), self.split2(odd));
        [a[0], b[0], a[1], b[1], c[0], d[0], c[1], d[1]]
    }
    #[inline(always)]
    fn prefetch(self, address: *const u8) {
        self.sse._mm_prefetch::<_MM_HINT_T0>(address.cast());
    }
}

/// Shuffles of AVX2, which AVX-512 has too.
pub(super) trait Shuffle256: Copy {
    /// A bit for each number: whether it is zero or more.
    fn not_negative4(self, x: f64x4) -> u8;
    /// The lower half of each.
    fn low_halves4(self, a: f64x4, b: f64x4) -> f64x4;
    /// The upper half of each.
    fn high_halves4(self, a: f64x4, b: f64x4) -> f64x4;
    /// One half and the other.
    fn joined2(self, low: [f64; 2], high: [f64; 2]) -> f64x4;
    /// The halves.
    fn split2(self, x: f64x4) -> [[f64; 2]; 2];
    /// `a0 b0 a2 b2` and `a1 b1 a3 b3`.
    fn interleaved(self, a: f64x4, b: f64x4) -> [f64x4; 2];
    /// The transpose.
    fn turned(self, rows: [f64x4; 4]) -> [f64x4; 4];
}

impl Shuffle256 for V3 {
    #[inline(always)]
    fn not_negative4(self, x: f64x4) -> u8 {
        let zero = cast(self.splat_f64x4(0.0));
        let mask = self.avx._mm256_cmp_pd::<_CMP_GE_OQ>(cast(x), zero);
        self.avx._mm256_movemask_pd(mask) as u8
    }
    #[inline(always)]
    fn low_halves4(self, a: f64x4, b: f64x4) -> f64x4 {
        let (a, b) = (cast(a), cast(b));
        cast(self.avx._mm256_permute2f128_pd::<0x20>(a, b))
    }
    #[inline(always)]
    fn high_halves4(self, a: f64x4, b: f64x4) -> f64x4 {
        let (a, b) = (cast(a), cast(b));
        cast(self.avx._mm256_permute2f128_pd::<0x31>(a, b))
    }
    #[inline(always)]
    fn joined2(self, low: [f64; 2], high: [f64; 2]) -> f64x4 {
        let low: f64x2 = cast(low);
        let high: f64x2 = cast(high);
        let low = self.avx._mm256_castpd128_pd256(cast(low));
        cast(self.avx._mm256_insertf128_pd::<1>(low, cast(high)))
    }
    #[inline(always)]
    fn split2(self, x: f64x4) -> [[f64; 2]; 2] {
        let low = self.avx._mm256_castpd256_pd128(cast(x));
        let high = self.avx._mm256_extractf128_pd::<1>(cast(x));
        [cast(low), cast(high)]
    }
    #[inline(always)]
    fn interleaved(self, a: f64x4, b: f64x4) -> [f64x4; 2] {
        let (a, b) = (cast(a), cast(b));
        [
            cast(self.avx._mm256_unpacklo_pd(a, b)),
            cast(self.avx._mm256_unpackhi_pd(a, b)),
        ]
    }
    #[inline(always)]
    fn turned(self, rows: [f64x4; 4]) -> [f64x4; 4] {
        let [even, odd] = self.interleaved(rows[0], rows[1]);
        let [even_2, odd_2] = self.interleaved(rows[2], rows[3]);
        [
            self.low_halves4(even, even_2),
            self.low_halves4(odd, odd_2),
            self.high_halves4(even, even_2),
            self.high_halves4(odd, odd_2),
        ]
    }
}
