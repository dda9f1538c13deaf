//! The fields around a crack tip in an elastic plane.
//!
//! In polar coordinates about the tip, `θ = 0` ahead of it [Williams 1957; Irwin 1957], with
//! `c = cos(θ/2)`, `s = sin(θ/2)`, `κ` of Kolosov and the shear modulus `μ`:
//!
//! ```text
//! mode I    u₁ = K_I/(2μ) √(r/2π) c (κ − 1 + 2 s²)      u₂ = K_I/(2μ) √(r/2π) s (κ + 1 − 2 c²)
//! mode II   u₁ = K_II/(2μ) √(r/2π) s (κ + 1 + 2 c²)     u₂ = −K_II/(2μ) √(r/2π) c (κ − 1 − 2 s²)
//! T         σ₁₁ = T
//! ```

use std::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};

use super::PlaneElastic;

/// Stress and displacement gradient at a point near a tip, in the axes of the tip: the first along
/// the crack and out of it, the second to its left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NearTip {
    /// In-plane stress, Pa.
    pub stress: Matrix2<f64>,
    /// `∂u_i/∂x_j`.
    pub gradient: Matrix2<f64>,
}

impl NearTip {
    /// The fields of intensities `[K_I, K_II]`, Pa √m, at a point in the axes of the tip, m. Not
    /// finite at the tip itself.
    pub fn of(elastic: &PlaneElastic, k: [f64; 2], x: &Vector2<f64>) -> Self {
        let (r, theta) = (x.norm(), x.y.atan2(x.x));
        let (s, c) = (0.5 * theta).sin_cos();
        let (s3, c3) = (1.5 * theta).sin_cos();
        let root = 1.0 / (2.0 * PI * r).sqrt();
        let [k1, k2] = k.map(|k| k * root);
        let s11 = k1 * c * (1.0 - s * s3) - k2 * s * (2.0 + c * c3);
        let s22 = k1 * c * (1.0 + s * s3) + k2 * s * c * c3;
        let s12 = k1 * s * c * c3 + k2 * c * (1.0 - s * s3);
        let stress = Matrix2::new(s11, s12, s12, s22);
        // The symmetric part by Hooke, the rotation from the displacements above.
        let (mu, kappa) = (elastic.shear_modulus(), elastic.kolosov());
        let mean = 0.25 * (3.0 - kappa) * (s11 + s22);
        let strain = (stress - Matrix2::identity() * mean) / (2.0 * mu);
        let spin = (kappa + 1.0) / (4.0 * mu) * (k1 * s + k2 * c);
        let rotation = Matrix2::new(0.0, spin, -spin, 0.0);
        Self {
            stress,
            gradient: strain + rotation,
        }
    }

    /// Displacement at a point in the axes of the tip, m.
    pub fn displacement(elastic: &PlaneElastic, k: [f64; 2], x: &Vector2<f64>) -> Vector2<f64> {
        let (s, c) = (0.5 * x.y.atan2(x.x)).sin_cos();
        let (mu, kappa) = (elastic.shear_modulus(), elastic.kolosov());
        let [k1, k2] = k.map(|k| k / (2.0 * mu) * (x.norm() / (2.0 * PI)).sqrt());
        Vector2::new(
            k1 * c * (kappa - 1.0 + 2.0 * s * s) + k2 * s * (kappa + 1.0 + 2.0 * c * c),
            k1 * s * (kappa + 1.0 - 2.0 * c * c) - k2 * c * (kappa - 1.0 - 2.0 * s * s),
        )
    }
}

/// Opening and sliding of the faces at a distance `r` (m) behind a tip per unit of intensity:
/// `δ = 8 K/E′ √(r/2π)`, for K_I the opening, for K_II the sliding, m/(Pa √m).
pub(super) fn opening_per_intensity(elastic: &PlaneElastic, r: f64) -> f64 {
    8.0 / elastic.effective_modulus() * (r / (2.0 * PI)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The gradient is that of the displacement, for every angle and state of the plane.
    #[test]
    fn displacements_and_gradients_agree() {
        for plane_stress in [false, true] {
            let elastic = PlaneElastic {
                young: 3.0,
                poisson: 0.3,
                plane_stress,
            };
            for k in [[1.0, 0.0], [0.0, 1.0], [0.7, -1.3]] {
                for degrees in [-179.0f64, -90.0, -20.0, 0.0, 35.0, 120.0, 178.0] {
                    let (y, x) = degrees.to_radians().sin_cos();
                    let x = Vector2::new(x, y) * 0.8;
                    let exact = NearTip::of(&elastic, k, &x).gradient;
                    let step = 1e-5;
                    for j in 0..2 {
                        let mut along = Vector2::zeros();
                        along[j] = step;
                        let u = |x: Vector2<f64>| NearTip::displacement(&elastic, k, &x);
                        let slope = (u(x + along) - u(x - along)) / (2.0 * step);
                        let error = (slope - exact.column(j)).norm();
                        assert!(error < 1e-8, "{k:?} at {degrees}: {error:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_faces_open_as_they_should() {
        let elastic = PlaneElastic {
            young: 3.0,
            poisson: 0.3,
            plane_stress: false,
        };
        let k = [2.0, -0.5];
        let [upper, lower] =
            [1e-300, -1e-300].map(|y| NearTip::displacement(&elastic, k, &Vector2::new(-0.3, y)));
        let per = opening_per_intensity(&elastic, 0.3);
        assert!(((upper - lower) - Vector2::new(k[1], k[0]) * per).norm() < 1e-14);
    }
}
