//! Exponential of a general 3×3 matrix.

use crate::Matrix3;

/// Coefficients of the diagonal Padé approximant of degree 13, lowest first.
const PADE: [f64; 14] = [
    64_764_752_532_480_000.0,
    32_382_376_266_240_000.0,
    7_771_770_303_897_600.0,
    1_187_353_796_428_800.0,
    129_060_195_264_000.0,
    10_559_470_521_600.0,
    670_442_572_800.0,
    33_522_128_640.0,
    1_323_241_920.0,
    40_840_800.0,
    960_960.0,
    16_380.0,
    182.0,
    1.0,
];

/// 1-norm up to which that approximant is accurate to round-off; tested on the sum of all entries.
const PADE_REACH: f64 = 5.37;

/// `exp(A)` by scaling and squaring with the Padé approximant of degree 13 (Higham 2005, SIAM J.
/// Matrix Anal. Appl. 26, 1179), the mean of the diagonal taken out first.
///
/// Entries beyond the range of `f64` come out infinite or NaN, and so do all if an entry of `A` is
/// not finite. `exp` of a skew matrix is a rotation: see [`rotation`](crate::rotation).
pub fn exponential(a: &Matrix3<f64>) -> Matrix3<f64> {
    let not_a_number = Matrix3::repeat(f64::NAN);
    let mean = a.trace() / 3.0;
    let mut a = a - Matrix3::identity() * mean;
    let norm = (0..3).map(|j| a.column(j).abs().sum()).sum::<f64>();
    if !norm.is_finite() {
        return not_a_number;
    }
    let mut squarings = 0;
    let mut scaled = norm;
    while scaled > PADE_REACH {
        scaled *= 0.5;
        a *= 0.5;
        squarings += 1;
    }
    let Some(mut result) = pade(&a) else {
        return not_a_number;
    };
    for _ in 0..squarings {
        result *= result;
    }
    result * mean.exp()
}

/// `(V - U)⁻¹ (V + U)` with `V` the even and `U` the odd powers.
fn pade(a: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let identity = Matrix3::identity();
    let a2 = a * a;
    let a4 = a2 * a2;
    let a6 = a4 * a2;
    let b = &PADE;
    let odd = a6 * (a6 * b[13] + a4 * b[11] + a2 * b[9])
        + (a6 * b[7] + a4 * b[5] + a2 * b[3] + identity * b[1]);
    let u = a * odd;
    let v = a6 * (a6 * b[12] + a4 * b[10] + a2 * b[8])
        + (a6 * b[6] + a4 * b[4] + a2 * b[2] + identity * b[0]);
    (v - u).lu().solve(&(v + u))
}
