//! The part of the plane a body takes, and how large its particles are.

use super::scale::Scale;

/// What part of the plane is shown.
pub(super) struct View {
    low: [f64; 2],
    high: [f64; 2],
    /// Side of a particle, m.
    pub side: f64,
    pub scale: Scale,
}

impl View {
    /// The particles' extent with some paper around; none if there are no particles.
    pub fn of(points: &[[f64; 2]], side: Option<f64>) -> Option<Self> {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        let mut count = 0.0;
        for point in points.iter().filter(|point| finite(point)) {
            count += 1.0;
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        if count == 0.0 {
            return None;
        }
        let span = [high[0] - low[0], high[1] - low[1]];
        let largest = span[0].max(span[1]);
        let guess = side_of(span, count);
        let side = side
            .filter(|side| side.is_finite() && *side > 0.0)
            .unwrap_or(guess);
        let around = 0.5 * side + 0.03 * (largest + side);
        for axis in 0..2 {
            low[axis] -= around;
            high[axis] += around;
        }
        let farthest = low
            .iter()
            .chain(&high)
            .fold(0.0, |far: f64, end| far.max(end.abs()));
        Some(Self {
            low,
            high,
            side,
            scale: Scale::linear(farthest),
        })
    }

    /// The ends of an axis as drawn.
    pub fn drawn(&self, axis: usize) -> (f64, f64) {
        (
            self.scale.apply(self.low[axis]),
            self.scale.apply(self.high[axis]),
        )
    }
}

/// The side s for which `count` squares fill the rectangle their centres span, (a + s)(b + s) = count·s².
fn side_of([a, b]: [f64; 2], count: f64) -> f64 {
    if count < 2.0 {
        return if a.max(b) > 0.0 { a.max(b) } else { 1.0 };
    }
    let half = 0.5 * (a + b);
    let side = (half + (half * half + (count - 1.0) * a * b).sqrt()) / (count - 1.0);
    if side > 0.0 { side } else { 1.0 }
}

/// Whether a particle is anywhere at all.
pub(super) fn finite(point: &[f64; 2]) -> bool {
    point.iter().all(|coordinate| coordinate.is_finite())
}

#[cfg(test)]
mod tests {
    use super::side_of;

    #[test]
    fn the_guessed_side_is_the_spacing_of_a_full_rectangle() {
        // 20 × 6 particles, centres 0.01 m apart.
        assert!((side_of([0.19, 0.05], 120.0) - 0.01).abs() < 1e-12);
        assert!((side_of([0.9, 0.0], 10.0) - 0.1).abs() < 1e-12, "a row");
        assert_eq!(side_of([0.0, 0.0], 1.0), 1.0);
        assert_eq!(side_of([0.0, 0.0], 5.0), 1.0, "all in one place");
    }
}
