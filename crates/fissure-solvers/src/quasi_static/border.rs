//! The scalar equations that close a step with the load as an unknown.

/// Doublings of the first probe before a search is given up.
const DOUBLINGS: usize = 14;
/// Most evaluations between two points of opposite sign.
const EVALUATIONS: usize = 60;
/// Relative accuracy of the goal.
const ACCURACY: f64 = 1e-8;

/// The roots of `square x² + 2 half x + rest = 0`, the larger first; `None` if there are none.
pub(super) fn roots(square: f64, half: f64, rest: f64) -> Option<[f64; 2]> {
    let discriminant = half * half - square * rest;
    if !(square > 0.0 && discriminant >= 0.0) {
        return None;
    }
    // Without cancellation.
    let sum = -(half + discriminant.sqrt().copysign(half));
    let [a, b] = match sum {
        0.0 => [0.0; 2],
        _ => [sum / square, rest / sum],
    };
    Some([a.max(b), a.min(b)])
}

/// Where a function that is zero or rises away from somewhere reaches a goal, nearest to zero: the side on which it
/// gets nearer to the goal is searched in steps that double from `probe`, both where it is flat. `None` if it
/// does not get there.
///
/// # Errors
/// Those of the function.
pub(super) fn reach<E>(
    function: &mut impl FnMut(f64) -> Result<f64, E>,
    goal: f64,
    probe: f64,
) -> Result<Option<f64>, E> {
    let mut error = |x: f64| Ok(function(x)? / goal - 1.0);
    let start = error(0.0)?;
    if start.abs() <= ACCURACY {
        return Ok(Some(0.0));
    }
    let nearer = |x: f64| if start < 0.0 { x } else { -x };
    let (up, down) = (nearer(error(probe)?), nearer(error(-probe)?));
    let ways: &[f64] = match up.partial_cmp(&down) {
        Some(std::cmp::Ordering::Greater) => &[1.0],
        Some(std::cmp::Ordering::Less) => &[-1.0],
        Some(std::cmp::Ordering::Equal) => &[1.0, -1.0],
        None => return Ok(None),
    };
    let mut last = [(0.0, start); 2];
    let mut length = probe;
    for _ in 0..DOUBLINGS {
        for (way, last) in ways.iter().zip(&mut last) {
            let x = way * length;
            let there = error(x)?;
            if there * start <= 0.0 {
                return between(&mut error, *last, (x, there)).map(Some);
            }
            *last = (x, there);
        }
        length *= 2.0;
    }
    Ok(None)
}

/// The root between two points of opposite sign, by the rule of false position in the variant of Illinois.
fn between<E>(
    error: &mut impl FnMut(f64) -> Result<f64, E>,
    mut a: (f64, f64),
    mut b: (f64, f64),
) -> Result<f64, E> {
    for _ in 0..EVALUATIONS {
        if b.1.abs() <= ACCURACY {
            break;
        }
        let x = b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
        let there = (x, error(x)?);
        if there.1 * b.1 <= 0.0 {
            a = b;
        } else {
            a.1 *= 0.5;
        }
        b = there;
    }
    Ok(b.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_a_quadratic() {
        let [a, b] = roots(1.0, -1.5, 2.0).unwrap();
        assert!((a - 2.0).abs() < 1e-15 && (b - 1.0).abs() < 1e-15);
        // 1e-9 is lost where the larger root is subtracted.
        let [a, b] = roots(1.0, -0.5 * (1e9 + 1e-9), 1.0).unwrap();
        assert!((a / 1e9 - 1.0).abs() < 1e-15 && (b / 1e-9 - 1.0).abs() < 1e-12);
        assert_eq!(roots(1.0, 0.0, 1.0), None);
        assert_eq!(roots(0.0, 1.0, 1.0), None);
        assert_eq!(roots(f64::NAN, 1.0, 1.0), None);
    }

    fn reached(function: impl Fn(f64) -> f64, goal: f64) -> Option<f64> {
        let mut function = |x| Ok::<_, ()>(function(x));
        reach(&mut function, goal, 1e-2).unwrap()
    }

    #[test]
    fn a_goal_is_reached_on_the_side_where_it_is() {
        let ramp = |x: f64| (x - 1.0).max(0.0);
        // Flat about zero: both sides are searched.
        for way in [1.0, -1.0] {
            let x = reached(|x| ramp(way * x), 0.25).unwrap();
            assert!((way * x - 1.25).abs() < 1e-6, "{x}");
        }
        // From above and from below.
        let x = reached(|x| (x + 2.0).powi(2), 1.0).unwrap();
        assert!((x + 1.0).abs() < 1e-6, "{x}");
        let x = reached(|x| (x + 2.0).powi(2), 9.0).unwrap();
        assert!((x - 1.0).abs() < 1e-6, "{x}");
        // Beyond what there is.
        assert_eq!(reached(|x| x.clamp(0.0, 1.0), 2.0), None);
        assert_eq!(reached(|_| f64::NAN, 2.0), None);
    }
}
