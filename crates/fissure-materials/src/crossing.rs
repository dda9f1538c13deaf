//! Where a function ceases to be negative, to the last bit.

/// Evaluations before the search ends, three for each halving of which 64 or so are needed unless the place is next to zero.
const EVALUATIONS: usize = 600;

/// Narrows an interval at whose lower end a function is negative and at whose upper end it is not, to neighbouring numbers:
/// the last at which it was seen to be negative and the first at which it was not. NaN counts as not negative. `values` are
/// the function's at the ends.
///
/// A secant step, then one of twice the length, which ends beyond the place if the function is nearly straight, and a
/// halving where the two did not halve the interval [Alefeld, Potra and Shi, ACM Trans. Math. Softw. 21, 327 (1995)]: a
/// dozen evaluations where the function is smooth, and never over three times those of halvings.
pub(crate) fn crossing(
    [mut low, mut high]: [f64; 2],
    mut values: [f64; 2],
    function: impl Fn(f64) -> f64,
) -> [f64; 2] {
    let mut before = high - low;
    for count in 0..EVALUATIONS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if count % 3 == 0 {
            before = high - low;
        }
        let tried = match count % 3 {
            2 if high - low > 0.5 * before => middle,
            1 => secant([low, high], values, 2.0),
            _ => secant([low, high], values, 1.0),
        };
        // A step of nothing, or beyond the other end, is one to the nearest number within; NaN is none.
        let next = if tried.is_nan() {
            middle
        } else {
            tried.max(low.next_up()).min(high.next_down())
        };
        let value = function(next);
        if value < 0.0 {
            (low, values[0]) = (next, value);
        } else {
            (high, values[1]) = (next, value);
        }
    }
    [low, high]
}

/// A step of so many secant lengths from the end at which the function is the smaller.
fn secant([low, high]: [f64; 2], values: [f64; 2], lengths: f64) -> f64 {
    let slope = (values[1] - values[0]) / (high - low);
    let (near, value) = if values[0].abs() < values[1].abs() {
        (low, values[0])
    } else {
        (high, values[1])
    };
    near - lengths * value / slope
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    type Function = fn(f64) -> f64;

    /// The place, and how often the function was asked.
    fn counted(low: f64, high: f64, function: impl Fn(f64) -> f64) -> ([f64; 2], usize) {
        let count = Cell::new(0);
        let found = crossing([low, high], [function(low), function(high)], |x| {
            count.set(count.get() + 1);
            function(x)
        });
        (found, count.get())
    }

    #[test]
    fn the_ends_are_neighbours_after_a_dozen_evaluations() {
        let smooth: [(f64, f64, Function); 4] = [
            (0.0, 2.0, |x| x * x - 2.0),
            (0.0, 10.0, |x| (x - 3.0).tanh()),
            (0.0, 1.0, |x| 1e9 * x - 3.0),
            (1e-300, 1.0, |x| x.exp() - 1.5),
        ];
        for (low, high, function) in smooth {
            let ([last, first], count) = counted(low, high, function);
            assert!(function(last) < 0.0 && function(first) >= 0.0);
            assert_eq!(last.to_bits() + 1, first.to_bits());
            assert!(count <= 16, "{count} evaluations");
        }
    }

    #[test]
    fn what_is_not_smooth_is_found_as_well() {
        let rough: [Function; 6] = [
            |x| if x < 0.3 { -1.0 } else { 1.0 },
            |x| if x < 0.3 { -1e9 } else { 1e-9 },
            |x| if x < 0.3 { -1e-9 } else { 1e9 },
            |x| (x - 0.7).powi(9),
            |x| if x < 0.3 { f64::NEG_INFINITY } else { 2.0 },
            |x| if x < 0.3 { -1.0 } else { f64::NAN },
        ];
        for function in rough {
            let ([last, first], count) = counted(0.0, 1.0, function);
            assert!(function(last) < 0.0 && !(function(first) < 0.0));
            assert_eq!(last.to_bits() + 1, first.to_bits());
            // Three for each halving.
            assert!(count <= 3 * 56, "{count} evaluations");
        }
    }
}
