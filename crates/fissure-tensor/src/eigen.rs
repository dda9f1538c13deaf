//! Closed-form eigenvalues and eigenvectors of a symmetric 3×3 tensor.
//!
//! The trigonometric solution of the characteristic cubic loses half of the digits of two nearly
//! equal eigenvalues, but never of the third, which is at least `√3 p` away from the others
//! (`p² = J₂/3`). So only that one is taken from the cubic. Its eigenvector is the largest column of
//! the adjugate of `B - μI`; the plane across it carries a 2×2 problem, whose closed form is
//! accurate whatever the gap (the deflation of Scherzinger & Dohrmann 2008, Comput. Methods Appl.
//! Mech. Engrg. 197, 4007). The residual of the first vector, known from that 2×2 frame, corrects
//! it to second order, so the root of the cubic is needed to a few digits only and no
//! transcendental function is called: results are the same on every platform.

use crate::{Spectrum, Sym, Vector3};

/// Interpolation at Chebyshev nodes of `2 cos(acos(h)/3)` on `0 ≤ h ≤ 1`, within 1.1e-5.
const ROOT_FIT: [f64; 5] = [
    1.732_060_864_045_381_8,
    0.332_823_443_575_192_1,
    -0.091_843_866_261_528_63,
    0.035_024_377_150_422_28,
    -0.008_070_797_433_311_199,
];

/// A power of two that brings `magnitude ≥ 0` into `[1, 2)`, or as near to it as a normal number can.
#[inline]
pub(crate) fn power_of_two(magnitude: f64) -> f64 {
    let exponent = (magnitude.to_bits() >> 52) & 0x7ff;
    f64::from_bits(2046_u64.saturating_sub(exponent).max(1) << 52)
}

/// A tensor with its magnitude and its mean taken out, and one eigenvector split off.
///
/// The tensor is `(q + q₂ + B/deviator_scale)/scale`, both scales powers of two.
struct Deflated {
    scale: f64,
    deviator_scale: f64,
    mean: f64,
    mean_left: f64,
    /// Eigenvector of the eigenvalue that is well separated, to about ten digits.
    axis: Vector3<f64>,
    /// Completes `axis` to an orthonormal set.
    across: [Vector3<f64>; 2],
    /// Components of `B` on `axis`, between `axis` and `across`, and in the plane `across`.
    axial: f64,
    coupling: [f64; 2],
    block_mean: f64,
    block_half: f64,
    block_off: f64,
    /// Half the difference of the two eigenvalues of the block.
    radius: f64,
    /// Whether `axis` belongs to the largest eigenvalue rather than to the smallest.
    axis_first: bool,
}

impl Deflated {
    /// `None` if the tensor is plane, or becomes so when scaled to magnitude one.
    #[inline]
    fn new(a: &Sym) -> Option<Self> {
        let m = &a.mandel;
        let sum = (m[0].abs() + m[1].abs()) + (m[2].abs() + m[3].abs()) + (m[4].abs() + m[5].abs());
        let scale = power_of_two(sum);
        let a = Sym {
            mandel: m.map(|c| c * scale),
        };
        let (xx, yy, zz) = (a.xx(), a.yy(), a.zz());
        let (yz, xz, xy) = (a.yz(), a.xz(), a.xy());
        // The mean is rounded; its remainder matters if the deviator is as small as that rounding.
        let mean = (xx + yy + zz) * (1.0 / 3.0);
        let (xx, yy, zz) = (xx - mean, yy - mean, zz - mean);
        let mean_left = (xx + yy + zz) * (1.0 / 3.0);
        let (xx, yy, zz) = (xx - mean_left, yy - mean_left, zz - mean_left);
        let sum = (xx.abs() + yy.abs()) + (zz.abs() + yz.abs()) + (xz.abs() + xy.abs());
        if sum == 0.0 {
            return None;
        }
        let deviator_scale = power_of_two(sum);
        let b = [xx, yy, zz, yz, xz, xy].map(|c| c * deviator_scale);
        let (root, axis_first) = separated_root(&b);
        let axis = separated_vector(&b, root);
        let across = frame(&axis);
        let image = product(&b, &axis);
        let images = [product(&b, &across[0]), product(&b, &across[1])];
        let (first, last) = (across[0].dot(&images[0]), across[1].dot(&images[1]));
        let block_half = 0.5 * (first - last);
        let block_off = across[0].dot(&images[1]);
        Some(Self {
            scale,
            deviator_scale,
            mean,
            mean_left,
            axis,
            across,
            axial: axis.dot(&image),
            coupling: [across[0].dot(&image), across[1].dot(&image)],
            block_mean: 0.5 * (first + last),
            block_half,
            block_off,
            radius: (block_half * block_half + block_off * block_off).sqrt(),
            axis_first,
        })
    }

    #[inline]
    fn values(&self) -> [f64; 3] {
        let (upper, lower) = (self.block_mean + self.radius, self.block_mean - self.radius);
        let ordered = if self.axis_first {
            [self.axial, upper, lower]
        } else {
            [upper, lower, self.axial]
        };
        // Reciprocals of powers of two are exact.
        let (unit, deviator_unit) = (1.0 / self.scale, 1.0 / self.deviator_scale);
        ordered.map(|value| ((value * deviator_unit + self.mean_left) + self.mean) * unit)
    }

    #[inline]
    fn vectors(&self) -> [Vector3<f64>; 3] {
        let [u, w] = &self.across;
        // One Newton step on the eigenvector: solve (axial - block) x = coupling.
        let gap = self.axial - self.block_mean;
        let (p, q) = (self.coupling[0], self.coupling[1]);
        let step = 1.0 / (gap * gap - self.radius * self.radius);
        let along_u = step * ((gap + self.block_half) * p + self.block_off * q);
        let along_w = step * ((gap - self.block_half) * q + self.block_off * p);
        let axis = polished(self.axis + (u * along_u + w * along_w));

        let positive = self.block_half >= 0.0;
        let large = self.block_half.abs() + self.radius;
        // A radius whose square underflows is no radius: the pair is equal to working precision.
        let (x, y) = if self.radius < 1e-140 {
            (1.0, 0.0)
        } else if positive {
            (large, self.block_off)
        } else {
            (self.block_off, large)
        };
        let upper = u * x + w * y;
        let upper = upper - axis * axis.dot(&upper);
        let upper = polished(upper * (1.0 / upper.dot(&upper).sqrt()));
        let lower = axis.cross(&upper);
        if self.axis_first {
            [axis, upper, lower]
        } else {
            [upper, lower, axis]
        }
    }
}

/// The eigenvalue of the traceless `b` that is farthest from the others, to about ten digits, and
/// whether it is the largest.
#[inline]
fn separated_root(b: &[f64; 6]) -> (f64, bool) {
    let [xx, yy, zz, yz, xz, xy] = *b;
    let squares = ((xx * xx + yy * yy) + zz * zz) + 2.0 * ((yz * yz + xz * xz) + xy * xy);
    let p2 = squares * (1.0 / 6.0);
    let p = p2.sqrt();
    let determinant =
        xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // b = p·x turns det(b - μ) into x³ - 3x - 2h, |h| ≤ 1; the root wanted has the sign of h.
    let h = determinant / (2.0 * p * p2);
    let size = h.abs();
    let size = if size > 1.0 { 1.0 } else { size };
    let [c0, c1, c2, c3, c4] = ROOT_FIT;
    let x = c0 + size * (c1 + size * (c2 + size * (c3 + size * c4)));
    let x = x - ((x * x - 3.0) * x - 2.0 * size) / (3.0 * x * x - 3.0);
    let axis_first = h >= 0.0;
    (if axis_first { p * x } else { -p * x }, axis_first)
}

/// Unit vector along the largest column of the adjugate of `b - root`.
#[inline]
fn separated_vector(b: &[f64; 6], root: f64) -> Vector3<f64> {
    let [xx, yy, zz, yz, xz, xy] = *b;
    let (xx, yy, zz) = (xx - root, yy - root, zz - root);
    let (axx, ayy, azz) = (yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy);
    let (ayz, axz, axy) = (xy * xz - xx * yz, xy * yz - yy * xz, xz * yz - zz * xy);
    // The adjugate is (μ₁-μ)(μ₂-μ) n⊗n with a positive factor: its diagonal tells the column.
    let column = if axx >= ayy && axx >= azz {
        Vector3::new(axx, axy, axz)
    } else if ayy >= azz {
        Vector3::new(axy, ayy, ayz)
    } else {
        Vector3::new(axz, ayz, azz)
    };
    // Twice the error of the length would go into the eigenvalue.
    polished(column * (1.0 / column.dot(&column).sqrt()))
}

/// A vector of unit length up to a few units of round-off, brought to within one.
#[inline]
fn polished(n: Vector3<f64>) -> Vector3<f64> {
    n + n * (0.5 - 0.5 * n.dot(&n))
}

/// Two unit vectors that complete the unit vector `n` (Duff et al. 2017, J. Comput. Graph. Tech. 6).
#[inline]
fn frame(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let sign = 1.0_f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    [
        Vector3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        Vector3::new(b, sign + n.y * n.y * a, -n.y),
    ]
}

#[inline]
fn product(b: &[f64; 6], n: &Vector3<f64>) -> Vector3<f64> {
    let [xx, yy, zz, yz, xz, xy] = *b;
    Vector3::new(
        xx * n.x + xy * n.y + xz * n.z,
        xy * n.x + yy * n.y + yz * n.z,
        xz * n.x + yz * n.y + zz * n.z,
    )
}

/// Spectrum of any symmetric tensor.
#[inline]
pub(crate) fn spectrum(a: &Sym) -> Spectrum {
    if a.mandel[3] == 0.0 && a.mandel[4] == 0.0 {
        return crate::eigen_plane::spectrum(a);
    }
    match Deflated::new(a) {
        Some(deflated) => Spectrum {
            values: deflated.values(),
            vectors: deflated.vectors(),
        },
        None => crate::eigen_plane::spectrum(a),
    }
}

/// The eigenvalues that [`spectrum`] finds, to the last bit.
#[inline]
pub(crate) fn eigenvalues(a: &Sym) -> [f64; 3] {
    if a.mandel[3] == 0.0 && a.mandel[4] == 0.0 {
        return crate::eigen_plane::eigenvalues(a);
    }
    match Deflated::new(a) {
        Some(deflated) => deflated.values(),
        None => crate::eigen_plane::eigenvalues(a),
    }
}
