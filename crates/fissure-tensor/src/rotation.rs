//! Proper orthogonal matrices.

use crate::{Matrix3, Vector3};

/// Rotation by `angle` (radians, right-handed) about `axis`, which need not be a unit vector.
/// A zero axis gives the identity.
pub fn rotation(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let length = axis.norm();
    if length == 0.0 {
        return Matrix3::identity();
    }
    let n = axis / length;
    let (s, c) = angle.sin_cos();
    Matrix3::identity() * c + n.cross_matrix() * s + n * n.transpose() * (1.0 - c)
}

/// The smallest rotation that takes the unit vector `from` to the unit vector `to`.
pub fn rotation_between(from: &Vector3<f64>, to: &Vector3<f64>) -> Matrix3<f64> {
    let axis = from.cross(to);
    let cosine = from.dot(to);
    if axis.norm() == 0.0 && cosine < 0.0 {
        // Opposite vectors: half a turn about any perpendicular axis; the choice is fixed.
        let other = if from.x.abs() < 0.9 {
            Vector3::x()
        } else {
            Vector3::y()
        };
        return rotation(&from.cross(&other), std::f64::consts::PI);
    }
    rotation(&axis, axis.norm().atan2(cosine))
}
