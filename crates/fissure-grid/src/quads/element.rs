//! The bilinear map of one element and its inverse.

use nalgebra::{Matrix2, Vector2};

/// Steps of Newton's method: it takes one on a parallelogram and seldom more than six.
const STEPS: usize = 30;
/// What is left of a distance when an inverse is found, as part of the element's size.
const FOUND: f64 = 1e-14;
/// Halvings that take a bracket of length 2 below round-off.
const HALVINGS: usize = 60;

/// Natural coordinates of the corners.
pub(super) const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// `x = c + a ξ + b η + d ξη`, which is [Sanchez 2010, eqs 4.4.1-4.4.2] written out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Element {
    centre: Vector2<f64>,
    /// Half the mean edge along ξ, m.
    a: Vector2<f64>,
    /// The same along η, m.
    b: Vector2<f64>,
    /// What tells it from a parallelogram, m.
    d: Vector2<f64>,
}

impl Element {
    pub(super) fn of([first, second, third, fourth]: [Vector2<f64>; 4]) -> Self {
        // Differences first, so that an element far from zero loses no digits twice.
        let (second, third, fourth) = (second - first, third - first, fourth - first);
        Self {
            centre: first + (second + third + fourth) * 0.25,
            a: (second + third - fourth) * 0.25,
            b: (third + fourth - second) * 0.25,
            d: (third - second - fourth) * 0.25,
        }
    }

    /// Edges of the parallelogram with the same centre and the same slopes there, m.
    pub(super) fn edges(&self) -> [Vector2<f64>; 2] {
        [self.a * 2.0, self.b * 2.0]
    }

    /// From the centre to the point of natural coordinates, m.
    fn offset(&self, at: &Vector2<f64>) -> Vector2<f64> {
        self.a * at.x + self.b * at.y + self.d * (at.x * at.y)
    }

    /// The point of natural coordinates, m.
    pub(super) fn point(&self, at: &Vector2<f64>) -> Vector2<f64> {
        self.centre + self.offset(at)
    }

    /// `∂x/∂(ξ, η)`, m: the matrix of [eq. 4.4.8], transposed that of [eq. 4.4.12].
    pub(super) fn jacobian(&self, at: &Vector2<f64>) -> Matrix2<f64> {
        Matrix2::from_columns(&[self.a + self.d * at.y, self.b + self.d * at.x])
    }

    /// Natural coordinates of a point of the element, by Newton's method from the centre
    /// [Sanchez 2010, eqs 4.4.8-4.4.9]. Steps are cut at the faces; if one brings the image no nearer before the point is
    /// found, the root is bracketed instead.
    pub(super) fn inverse(&self, x: &Vector2<f64>) -> Vector2<f64> {
        let target = x - self.centre;
        let newton = self.newton(&target, Vector2::zeros());
        if self.finds(&newton, &target) {
            return newton;
        }
        self.newton(&target, self.bracketed(&target))
    }

    fn finds(&self, at: &Vector2<f64>, target: &Vector2<f64>) -> bool {
        (target - self.offset(at)).norm() <= FOUND * (self.a.norm() + self.b.norm())
    }

    fn newton(&self, target: &Vector2<f64>, start: Vector2<f64>) -> Vector2<f64> {
        let mut at = start;
        let mut left = target - self.offset(&at);
        let rounding = f64::EPSILON.powi(2) * (self.a.norm_squared() + self.b.norm_squared());
        for _ in 0..STEPS {
            if left.norm_squared() <= rounding {
                break;
            }
            let Some(inverse) = self.jacobian(&at).try_inverse() else {
                break;
            };
            let next = (at + inverse * left).map(|c| c.clamp(-1.0, 1.0));
            let after = target - self.offset(&next);
            // Also ends at round-off, and at once for what is no number.
            if !(after.norm_squared() < left.norm_squared()) {
                break;
            }
            (at, left) = (next, after);
        }
        at
    }

    /// The same by halving. The line of constant ξ through the point runs from `aξ − b − dξ` along `b + dξ`, so that
    /// `(b + dξ) × (x − c − aξ) = 0`: negative on the face ξ = −1, positive on ξ = 1, once zero in between, since the
    /// element is convex.
    fn bracketed(&self, target: &Vector2<f64>) -> Vector2<f64> {
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..HALVINGS {
            let xi = 0.5 * (low + high);
            // The point lies right of the line, the image of ξ is too small, where the product is negative.
            let side = (self.b + self.d * xi).perp(&(target - self.a * xi));
            if side < 0.0 {
                low = xi;
            } else {
                high = xi;
            }
        }
        let xi = 0.5 * (low + high);
        let line = self.b + self.d * xi;
        let eta = line.dot(&(target - self.a * xi)) / line.norm_squared();
        Vector2::new(xi, eta.clamp(-1.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Newton's method and the bracket find the same, on faces and in corners too, in a square, a trapezium, and an element
    /// with angles of nearly 180° and 0°.
    #[test]
    fn bracket_and_newton_agree() {
        let elements = [
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            [[0.0, 0.0], [4.0, 0.0], [2.5, 1.0], [2.0, 1.0]],
            [[0.0, 0.0], [1.0, 0.1], [0.56, 0.55], [0.1, 1.0]],
        ];
        for corners in elements {
            let element = Element::of(corners.map(Vector2::from));
            for j in 0..=8 {
                for i in 0..=8 {
                    let at = Vector2::new(f64::from(i), f64::from(j)) * 0.25 - Vector2::repeat(1.0);
                    let target = element.offset(&at);
                    let halved = element.bracketed(&target);
                    let newton = element.newton(&target, Vector2::zeros());
                    for found in [halved, newton] {
                        assert!(element.finds(&found, &target), "{at} {found}");
                        // Near an angle of 180° the image hardly moves with the coordinates.
                        let slope = element.jacobian(&at).determinant();
                        assert!((found - at).norm() <= 1e-14 / slope, "{at} {found}");
                    }
                }
            }
        }
    }
}
