//! How the direction turns in which a failure function is largest, with the stress.
//!
//! Where `F(σ, n)` is largest over directions `n(φ)` its slopes vanish, so that `F_φφ dφ = −F_φσ:dσ`. Both second
//! derivatives are differences of fourth order, to about 1e-9 of themselves, of functions that are smooth.

use fissure_tensor::{Sym, Vector3};

/// Angle, rad, and change of the stress over its size, of a difference.
const STEP: f64 = 1e-3;

/// Where `F` is largest over all directions.
pub(super) fn maximum_rate(
    along: impl Fn(&Sym, &Vector3<f64>) -> f64,
    [stress, stress_rate]: [&Sym; 2],
    normal: &Vector3<f64>,
) -> Vector3<f64> {
    let other = if normal.z.abs() < 0.9 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let first = normal.cross(&other).normalize();
    let second = normal.cross(&first);
    let size = stress_rate.norm();
    if size == 0.0 {
        return Vector3::zeros();
    }
    let change = *stress_rate * (stress.norm() / size);
    let at = |x: f64, y: f64, part: f64| {
        let turned = (normal + first * x + second * y).normalize();
        along(&(*stress + change * part), &turned)
    };
    let (xx, yy) = (bend(|x| at(x, 0.0, 0.0)), bend(|y| at(0.0, y, 0.0)));
    let xy = mixed(|x, y| at(x, y, 0.0));
    let (x, y) = (
        mixed(|x, part| at(x, 0.0, part)),
        mixed(|y, part| at(0.0, y, part)),
    );
    let determinant = xx * yy - xy * xy;
    // Flat where directions are equally good: no derivative.
    if !(determinant > 1e-12 * (xx * xx + yy * yy)) {
        return Vector3::zeros();
    }
    let turn = first * (xy * y - yy * x) + second * (xy * x - xx * y);
    turn * (size / stress.norm() / determinant)
}

/// Where `F` is largest on the cone of directions as far as this one from an axis; stress and axis change at these rates.
pub(super) fn on_cone_rate(
    along: impl Fn(&Sym, &Vector3<f64>) -> f64,
    [stress, stress_rate]: [&Sym; 2],
    [axis, axis_rate]: [&Vector3<f64>; 2],
    normal: &Vector3<f64>,
) -> Vector3<f64> {
    let cosine = normal.dot(axis);
    let side = normal - axis * cosine;
    let sine = side.norm();
    let rate = stress_rate.norm() / stress.norm() + axis_rate.norm();
    if rate == 0.0 {
        return Vector3::zeros();
    }
    let direction = |angle: f64, part: f64| {
        let part = part / rate;
        let axis = (axis + axis_rate * part).normalize();
        let side = (side - axis * axis.dot(&side)).normalize();
        let across = axis.cross(&side);
        let (y, x) = angle.sin_cos();
        axis * cosine + (side * x + across * y) * sine
    };
    let at = |angle: f64, part: f64| {
        let stress = *stress + *stress_rate * (part / rate);
        along(&stress, &direction(angle, part))
    };
    let turned = -mixed(at) / bend(|angle| at(angle, 0.0));
    let moved = |part: f64| direction(turned * part, part);
    slope(moved) * rate
}

/// First derivative at 0.
pub(super) fn slope<T>(function: impl Fn(f64) -> T) -> T
where
    T: std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let near = function(STEP) - function(-STEP);
    let far = function(2.0 * STEP) - function(-2.0 * STEP);
    (near * 8.0 - far) * (1.0 / (12.0 * STEP))
}

/// Second derivative at 0.
fn bend(function: impl Fn(f64) -> f64) -> f64 {
    let (near, far) = (
        function(STEP) + function(-STEP),
        function(2.0 * STEP) + function(-2.0 * STEP),
    );
    (16.0 * near - far - 30.0 * function(0.0)) / (12.0 * STEP * STEP)
}

/// Mixed second derivative at (0, 0).
fn mixed(function: impl Fn(f64, f64) -> f64) -> f64 {
    let cross = |h: f64| {
        let [a, b] = [function(h, h), function(-h, -h)];
        let [c, d] = [function(h, -h), function(-h, h)];
        (a + b - c - d) / (4.0 * h * h)
    };
    (4.0 * cross(STEP) - cross(2.0 * STEP)) / 3.0
}
