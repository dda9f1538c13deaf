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
///
/// Opposite vectors leave the axis open; a fixed one across `from` is taken.
pub fn rotation_between(from: &Vector3<f64>, to: &Vector3<f64>) -> Matrix3<f64> {
    let axis = from.cross(to);
    let cosine = from.dot(to);
    let angle = axis.norm().atan2(cosine);
    if cosine > -0.5 {
        return rotation(&axis, angle);
    }
    // Of nearly opposite vectors the cross product is small and, by round-off, not across `from`,
    // which half a turn would double: take that part out.
    let across = |axis: Vector3<f64>| axis - from * axis.dot(from);
    let axis = axis.try_normalize(f64::EPSILON).unwrap_or_else(|| {
        let other = if from.x.abs() < 0.9 {
            Vector3::x()
        } else {
            Vector3::y()
        };
        from.cross(&other)
    });
    rotation(&across(across(axis)), angle)
}
