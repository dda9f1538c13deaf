//! Eigenvalues and eigenvectors of a tensor without out-of-plane shear: a 2×2 block and `zz`.

use crate::eigen::power_of_two;
use crate::{Spectrum, Sym, Vector3};

/// The in-plane block: its diagonal ordered, and its half difference and shear brought to magnitude one.
struct Block {
    diagonal: [f64; 2],
    half: f64,
    shear: f64,
    /// `|half| + √(half² + shear²)`.
    large: f64,
    unit: f64,
}

impl Block {
    #[inline]
    fn new(a: &Sym) -> Self {
        let (xx, yy, shear) = (a.xx(), a.yy(), a.xy());
        // Halves first: the difference of two huge components is not to overflow.
        let half = 0.5 * xx - 0.5 * yy;
        let scale = power_of_two(half.abs() + shear.abs());
        let (half, shear) = (half * scale, shear * scale);
        Self {
            diagonal: if xx >= yy { [xx, yy] } else { [yy, xx] },
            half,
            shear,
            large: half.abs() + (half * half + shear * shear).sqrt(),
            unit: 1.0 / scale,
        }
    }

    /// The diagonal moved apart by what the shear adds: exact where there is none.
    #[inline]
    fn values(&self) -> (f64, f64) {
        let apart = if self.large == 0.0 {
            0.0
        } else {
            self.shear * self.shear / self.large * self.unit
        };
        (self.diagonal[0] + apart, self.diagonal[1] - apart)
    }

    /// Direction of the larger value, at most a quarter turn from the first axis.
    #[inline]
    fn direction(&self) -> (f64, f64) {
        let large = self.large;
        if large == 0.0 {
            return (1.0, 0.0);
        }
        let length = 1.0 / (large * large + self.shear * self.shear).sqrt();
        let (large, small) = (large * length, self.shear * length);
        if self.half >= 0.0 {
            (large, small)
        } else {
            (small, large)
        }
    }
}

/// Where `zz` stands among the in-plane values; behind those that it equals.
#[inline]
fn ordered(zz: f64, upper: f64, lower: f64) -> ([f64; 3], usize) {
    if zz > upper {
        ([zz, upper, lower], 0)
    } else if zz > lower {
        ([upper, zz, lower], 1)
    } else {
        ([upper, lower, zz], 2)
    }
}

#[inline]
pub(crate) fn spectrum(a: &Sym) -> Spectrum {
    let block = Block::new(a);
    let (upper, lower) = block.values();
    let (values, position) = ordered(a.zz(), upper, lower);
    let (x, y) = block.direction();
    let n = Vector3::new(x, y, 0.0);
    let vectors = match position {
        0 => [Vector3::z(), n, Vector3::new(-y, x, 0.0)],
        1 => [n, Vector3::z(), Vector3::new(y, -x, 0.0)],
        _ => [n, Vector3::new(-y, x, 0.0), Vector3::z()],
    };
    Spectrum { values, vectors }
}

#[inline]
pub(crate) fn eigenvalues(a: &Sym) -> [f64; 3] {
    let (upper, lower) = Block::new(a).values();
    ordered(a.zz(), upper, lower).0
}
