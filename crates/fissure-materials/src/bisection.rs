//! Where a condition ceases to hold, to the last bit.

/// Halvings before the search ends, of which 64 or so are needed unless the place is next to zero.
const HALVINGS: usize = 200;

/// Narrows an interval at whose lower end a condition holds and at whose upper end it does not, to neighbouring numbers: the
/// last at which it was seen to hold and the first at which it was not.
pub(crate) fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_neighbours() {
        let [low, high] = bisect(0.0, 2.0, |x| x * x < 2.0);
        assert!(low * low < 2.0 && high * high >= 2.0);
        assert_eq!(low.to_bits() + 1, high.to_bits());
    }
}
