//! Values at a point from the particles about it.

use fissure::nalgebra::Matrix3;
use fissure::prelude::*;

/// Displacement at a place of the undeformed first body, m: the linear function that fits those of
/// the particles within `radius` m best. NaN with fewer than three of them.
pub(super) fn displacement_at(
    scene: &Scene<2>,
    first: &[Vector2<f64>],
    place: &Vector2<f64>,
    radius: f64,
) -> Vector2<f64> {
    let body = &scene.bodies()[0];
    let ids = body.particles().id.iter().map(|id| id.0 as usize);
    let ways = ids.zip(body.motion().position);
    let near = ways.filter_map(|(id, x)| {
        let away = first[id] - place;
        (away.norm() <= radius).then(|| (away, x - first[id]))
    });
    Vector2::from_iterator(linear_fit(near, |way| [way.x, way.y]))
}

/// In-plane stresses `xx`, `yy`, `xy` at a place of the first body in the same way, Pa.
pub(super) fn stress_at(scene: &Scene<2>, place: &Vector2<f64>, radius: f64) -> [f64; 3] {
    let motion = scene.bodies()[0].motion();
    let pairs = motion.position.iter().zip(motion.stress);
    let near = pairs.filter_map(|(x, stress)| {
        let away = x - place;
        (away.norm() <= radius).then_some((away, stress))
    });
    linear_fit(near, |stress| [stress.xx(), stress.yy(), stress.xy()])
}

/// The values at no distance of the linear functions of the distance that fit best.
fn linear_fit<T, const N: usize>(
    near: impl Iterator<Item = (Vector2<f64>, T)>,
    values: impl Fn(T) -> [f64; N],
) -> [f64; N] {
    let mut normal = Matrix3::zeros();
    let mut right = [Vector3::zeros(); N];
    for (away, value) in near {
        let row = Vector3::new(1.0, away.x, away.y);
        normal += row * row.transpose();
        for (right, value) in right.iter_mut().zip(values(value)) {
            *right += row * value;
        }
    }
    let inverse = normal.try_inverse();
    right.map(|right| inverse.map_or(f64::NAN, |inverse| (inverse * right).x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_field_is_read_exactly_off_its_points() {
        let points = [(0.1, 0.3), (-0.4, 0.2), (0.5, -0.6), (0.2, 0.2)];
        let field = points.map(|(x, y)| (Vector2::new(x, y), 3.0 + 2.0 * x - 5.0 * y));
        let [found] = linear_fit(field.into_iter(), |value| [value]);
        assert!((found - 3.0).abs() <= 1e-13, "{found}");
        let [none] = linear_fit(field.into_iter().take(2), |value| [value]);
        assert!(none.is_nan());
    }
}
