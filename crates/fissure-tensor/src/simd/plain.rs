//! Eight numbers on a machine without a vector unit that is known here.

use super::Lanes;

/// What every machine has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plain;

impl Lanes for Plain {
    type Eight = [f64; 8];

    #[inline(always)]
    fn splat(self, x: f64) -> [f64; 8] {
        [x; 8]
    }
    #[inline(always)]
    fn load(self, x: &[f64; 8]) -> [f64; 8] {
        *x
    }
    #[inline(always)]
    fn store(self, x: [f64; 8], to: &mut [f64; 8]) {
        *to = x;
    }
    #[inline(always)]
    fn add(self, a: [f64; 8], b: [f64; 8]) -> [f64; 8] {
        let mut out = a;
        for i in 0..8 {
            out[i] += b[i];
        }
        out
    }
    #[inline(always)]
    fn sub(self, a: [f64; 8], b: [f64; 8]) -> [f64; 8] {
        let mut out = a;
        for i in 0..8 {
            out[i] -= b[i];
        }
        out
    }
    #[inline(always)]
    fn div(self, a: [f64; 8], b: [f64; 8]) -> [f64; 8] {
        let mut out = a;
        for i in 0..8 {
            out[i] /= b[i];
        }
        out
    }
    #[inline(always)]
    fn mul(self, a: [f64; 8], b: [f64; 8]) -> [f64; 8] {
        let mut out = a;
        for i in 0..8 {
            out[i] *= b[i];
        }
        out
    }
    #[inline(always)]
    fn mul_add(self, a: [f64; 8], b: [f64; 8], c: [f64; 8]) -> [f64; 8] {
        let mut out = c;
        for i in 0..8 {
            out[i] += a[i] * b[i];
        }
        out
    }
    #[inline(always)]
    fn pair(self, low: f64, high: f64) -> [f64; 8] {
        [low, low, low, low, high, high, high, high]
    }
    #[inline(always)]
    fn max(self, a: [f64; 8], b: [f64; 8]) -> [f64; 8] {
        let mut out = b;
        for i in 0..8 {
            out[i] = if a[i] > b[i] { a[i] } else { b[i] };
        }
        out
    }
    #[inline(always)]
    fn not_negative(self, x: [f64; 8]) -> u8 {
        let mut bits = 0;
        for (place, x) in x.iter().enumerate() {
            bits |= u8::from(*x >= 0.0) << place;
        }
        bits
    }
    #[inline(always)]
    fn transpose(self, rows: [[f64; 8]; 8]) -> [[f64; 8]; 8] {
        turned(&rows)
    }
    #[inline(always)]
    fn columns4(self, rows: [&[f64; 4]; 8]) -> [[f64; 8]; 4] {
        turned(&rows.map(|row| *row))
    }
    #[inline(always)]
    fn rows4(self, columns: [[f64; 8]; 4]) -> [[f64; 4]; 8] {
        turned(&columns)
    }
    #[inline(always)]
    fn columns2(self, rows: [&[f64; 2]; 8]) -> [[f64; 8]; 2] {
        turned(&rows.map(|row| *row))
    }
    #[inline(always)]
    fn rows2(self, columns: [[f64; 8]; 2]) -> [[f64; 2]; 8] {
        turned(&columns)
    }
}

/// The transpose.
#[inline(always)]
fn turned<const R: usize, const C: usize>(rows: &[[f64; C]; R]) -> [[f64; R]; C] {
    let mut columns = [[0.0; R]; C];
    for (i, row) in rows.iter().enumerate() {
        for (j, number) in row.iter().enumerate() {
            columns[j][i] = *number;
        }
    }
    columns
}
