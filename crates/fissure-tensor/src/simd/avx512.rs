//! Eight numbers on AVX-512.

use std::arch::x86_64::{_CMP_GE_OQ, _MM_HINT_T0};

use pulp::x86::V4;
use pulp::{Simd as _, cast, f64x4, f64x8};

use super::Lanes;
use super::avx2::Shuffle256;

impl Lanes for V4 {
    type Eight = f64x8;

    #[inline(always)]
    fn splat(self, x: f64) -> f64x8 {
        self.splat_f64x8(x)
    }
    #[inline(always)]
    fn load(self, x: &[f64; 8]) -> f64x8 {
        cast(*x)
    }
    #[inline(always)]
    fn store(self, x: f64x8, to: &mut [f64; 8]) {
        *to = cast(x);
    }
    #[inline(always)]
    fn add(self, a: f64x8, b: f64x8) -> f64x8 {
        self.add_f64s(a, b)
    }
    #[inline(always)]
    fn sub(self, a: f64x8, b: f64x8) -> f64x8 {
        self.sub_f64s(a, b)
    }
    #[inline(always)]
    fn div(self, a: f64x8, b: f64x8) -> f64x8 {
        self.div_f64s(a, b)
    }
    #[inline(always)]
    fn mul(self, a: f64x8, b: f64x8) -> f64x8 {
        self.mul_f64s(a, b)
    }
    #[inline(always)]
    fn mul_add(self, a: f64x8, b: f64x8, c: f64x8) -> f64x8 {
        self.mul_add_f64x8(a, b, c)
    }
    #[inline(always)]
    fn pair(self, low: f64, high: f64) -> f64x8 {
        let (low, high) = (cast(self.splat(low)), cast(self.splat(high)));
        cast(self.avx512f._mm512_mask_blend_pd(0b1111_0000, low, high))
    }
    #[inline(always)]
    fn max(self, a: f64x8, b: f64x8) -> f64x8 {
        self.max_f64s(a, b)
    }
    #[inline(always)]
    fn not_negative(self, x: f64x8) -> u8 {
        let zero = cast(self.splat_f64x8(0.0));
        self.avx512f._mm512_cmp_pd_mask::<_CMP_GE_OQ>(cast(x), zero)
    }
    #[inline(always)]
    fn transpose(self, r: [f64x8; 8]) -> [f64x8; 8] {
        let (a, b) = (
            self.columns_of_four([r[0], r[1], r[2], r[3]]),
            self.columns_of_four([r[4], r[5], r[6], r[7]]),
        );
        // Each of these holds a column of its lower half and one of its upper half.
        [
            self.low_halves(a[0], b[0]),
            self.low_halves(a[1], b[1]),
            self.low_halves(a[2], b[2]),
            self.low_halves(a[3], b[3]),
            self.high_halves(a[0], b[0]),
            self.high_halves(a[1], b[1]),
            self.high_halves(a[2], b[2]),
            self.high_halves(a[3], b[3]),
        ]
    }
    #[inline(always)]
    fn columns4(self, r: [&[f64; 4]; 8]) -> [f64x8; 4] {
        self.columns_of_four([
            self.joined(cast(*r[0]), cast(*r[4])),
            self.joined(cast(*r[1]), cast(*r[5])),
            self.joined(cast(*r[2]), cast(*r[6])),
            self.joined(cast(*r[3]), cast(*r[7])),
        ])
    }
    #[inline(always)]
    fn rows4(self, columns: [f64x8; 4]) -> [[f64; 4]; 8] {
        // The same step turns back.
        let [a, b, c, d] = self.columns_of_four(columns);
        let (a, b, c, d) = (self.split(a), self.split(b), self.split(c), self.split(d));
        [
            cast(a[0]),
            cast(b[0]),
            cast(c[0]),
            cast(d[0]),
            cast(a[1]),
            cast(b[1]),
            cast(c[1]),
            cast(d[1]),
        ]
    }
    #[inline(always)]
    fn columns2(self, r: [&[f64; 2]; 8]) -> [f64x8; 2] {
        let (a, b) = (self.joined2(*r[0], *r[2]), self.joined2(*r[4], *r[6]));
        let (c, d) = (self.joined2(*r[1], *r[3]), self.joined2(*r[5], *r[7]));
        self.interleaved(self.joined(a, b), self.joined(c, d))
    }
    #[inline(always)]
    fn rows2(self, columns: [f64x8; 2]) -> [[f64; 2]; 8] {
        let [even, odd] = self.interleaved(columns[0], columns[1]);
        let (even, odd) = (self.split(even), self.split(odd));
        let (a, b) = (self.split2(even[0]), self.split2(odd[0]));
        let (c, d) = (self.split2(even[1]), self.split2(odd[1]));
        [a[0], b[0], a[1], b[1], c[0], d[0], c[1], d[1]]
    }
    #[inline(always)]
    fn unzip2(self, rows: &[f64; 16]) -> [f64x8; 2] {
        let [a, b] = cast(*rows);
        [
            self.picked(a, [0, 2, 4, 6, 8, 10, 12, 14], b),
            self.picked(a, [1, 3, 5, 7, 9, 11, 13, 15], b),
        ]
    }
    #[inline(always)]
    fn unzip3(self, rows: &[f64; 24]) -> [f64x8; 3] {
        let [a, b, c] = cast(*rows);
        // Of each column first what is in the first two registers, then what is in the third.
        let x = self.picked(a, [0, 3, 6, 9, 12, 15, 0, 0], b);
        let y = self.picked(a, [1, 4, 7, 10, 13, 0, 0, 0], b);
        let z = self.picked(a, [2, 5, 8, 11, 14, 0, 0, 0], b);
        [
            self.picked(x, [0, 1, 2, 3, 4, 5, 10, 13], c),
            self.picked(y, [0, 1, 2, 3, 4, 8, 11, 14], c),
            self.picked(z, [0, 1, 2, 3, 4, 9, 12, 15], c),
        ]
    }
    #[inline(always)]
    fn unzip4(self, rows: &[f64; 32]) -> [f64x8; 4] {
        let [a, b, c, d] = cast(*rows);
        const LOW: [u64; 8] = [0, 4, 8, 12, 1, 5, 9, 13];
        const HIGH: [u64; 8] = [2, 6, 10, 14, 3, 7, 11, 15];
        let (ab, cd) = (self.picked(a, LOW, b), self.picked(c, LOW, d));
        let (ab_2, cd_2) = (self.picked(a, HIGH, b), self.picked(c, HIGH, d));
        [
            self.low_halves(ab, cd),
            self.high_halves(ab, cd),
            self.low_halves(ab_2, cd_2),
            self.high_halves(ab_2, cd_2),
        ]
    }
    #[inline(always)]
    fn zip2(self, [a, b]: [f64x8; 2], to: &mut [f64; 16]) {
        *to = cast([
            self.picked(a, [0, 8, 1, 9, 2, 10, 3, 11], b),
            self.picked(a, [4, 12, 5, 13, 6, 14, 7, 15], b),
        ]);
    }
    #[inline(always)]
    fn zip3(self, [x, y, z]: [f64x8; 3], to: &mut [f64; 24]) {
        // What the first two columns give to each register, then what the third does.
        let a = self.picked(x, [0, 8, 0, 1, 9, 0, 2, 10], y);
        let b = self.picked(x, [0, 3, 11, 0, 4, 12, 0, 5], y);
        let c = self.picked(x, [13, 0, 6, 14, 0, 7, 15, 0], y);
        *to = cast([
            self.picked(a, [0, 1, 8, 3, 4, 9, 6, 7], z),
            self.picked(b, [10, 1, 2, 11, 4, 5, 12, 7], z),
            self.picked(c, [0, 13, 2, 3, 14, 5, 6, 15], z),
        ]);
    }
    #[inline(always)]
    fn zip4(self, [a, b, c, d]: [f64x8; 4], to: &mut [f64; 32]) {
        const LOW: [u64; 8] = [0, 4, 8, 12, 1, 5, 9, 13];
        const HIGH: [u64; 8] = [2, 6, 10, 14, 3, 7, 11, 15];
        let (ab, cd) = (self.low_halves(a, b), self.low_halves(c, d));
        let (ab_2, cd_2) = (self.high_halves(a, b), self.high_halves(c, d));
        *to = cast([
            self.picked(ab, LOW, cd),
            self.picked(ab, HIGH, cd),
            self.picked(ab_2, LOW, cd_2),
            self.picked(ab_2, HIGH, cd_2),
        ]);
    }
    #[inline(always)]
    fn prefetch(self, address: *const u8) {
        self.sse._mm_prefetch::<_MM_HINT_T0>(address.cast());
    }
}

/// Shuffles of AVX-512.
trait Shuffle512: Copy {
    /// One half and the other.
    fn joined(self, low: f64x4, high: f64x4) -> f64x8;
    /// The halves.
    fn split(self, x: f64x8) -> [f64x4; 2];
    /// `a0 b0 a2 b2 …` and `a1 b1 a3 b3 …`.
    fn interleaved(self, a: f64x8, b: f64x8) -> [f64x8; 2];
    /// The lower half of each.
    fn low_halves(self, a: f64x8, b: f64x8) -> f64x8;
    /// The upper half of each.
    fn high_halves(self, a: f64x8, b: f64x8) -> f64x8;
    /// Numbers of `a` (from 0 on) and of `b` (from 8 on) by their places.
    fn picked(self, a: f64x8, places: [u64; 8], b: f64x8) -> f64x8;
    /// Number k of four rows, then number 4 + k of them, for k from 0 to 3; its own inverse.
    fn columns_of_four(self, rows: [f64x8; 4]) -> [f64x8; 4];
}

impl Shuffle512 for V4 {
    #[inline(always)]
    fn joined(self, low: f64x4, high: f64x4) -> f64x8 {
        let low = self.avx512f._mm512_castpd256_pd512(cast(low));
        cast(self.avx512f._mm512_insertf64x4::<1>(low, cast(high)))
    }
    #[inline(always)]
    fn split(self, x: f64x8) -> [f64x4; 2] {
        let low = self.avx512f._mm512_castpd512_pd256(cast(x));
        let high = self.avx512f._mm512_extractf64x4_pd::<1>(cast(x));
        [cast(low), cast(high)]
    }
    #[inline(always)]
    fn interleaved(self, a: f64x8, b: f64x8) -> [f64x8; 2] {
        let (a, b) = (cast(a), cast(b));
        [
            cast(self.avx512f._mm512_unpacklo_pd(a, b)),
            cast(self.avx512f._mm512_unpackhi_pd(a, b)),
        ]
    }
    #[inline(always)]
    fn low_halves(self, a: f64x8, b: f64x8) -> f64x8 {
        let (a, b) = (cast(a), cast(b));
        cast(self.avx512f._mm512_shuffle_f64x2::<0b01_00_01_00>(a, b))
    }
    #[inline(always)]
    fn high_halves(self, a: f64x8, b: f64x8) -> f64x8 {
        let (a, b) = (cast(a), cast(b));
        cast(self.avx512f._mm512_shuffle_f64x2::<0b11_10_11_10>(a, b))
    }
    #[inline(always)]
    fn picked(self, a: f64x8, places: [u64; 8], b: f64x8) -> f64x8 {
        let (a, b) = (cast(a), cast(b));
        cast(self.avx512f._mm512_permutex2var_pd(a, cast(places), b))
    }
    #[inline(always)]
    fn columns_of_four(self, rows: [f64x8; 4]) -> [f64x8; 4] {
        const LOW: [u64; 8] = [0, 1, 8, 9, 4, 5, 12, 13];
        const HIGH: [u64; 8] = [2, 3, 10, 11, 6, 7, 14, 15];
        let [even, odd] = self.interleaved(rows[0], rows[1]);
        let [even_2, odd_2] = self.interleaved(rows[2], rows[3]);
        [
            self.picked(even, LOW, even_2),
            self.picked(odd, LOW, odd_2),
            self.picked(even, HIGH, even_2),
            self.picked(odd, HIGH, odd_2),
        ]
    }
}
