//! Conjugate gradients and GMRES.

use super::preconditioner::Preconditioner;

/// A linear map, known by what it does to a vector.
pub trait Operator {
    /// Why it may fail to be applied.
    type Error;

    /// Number of unknowns.
    fn size(&self) -> usize;

    /// `y = A x`.
    ///
    /// # Errors
    /// Those of the operator; none for a matrix.
    fn apply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Self::Error>;
}

/// When an iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KrylovSettings {
    /// `|b − A x| / |b|` at which a solution is accepted; in (0, 1).
    pub tolerance: f64,
    /// Products with the matrix at most; ≥ 1.
    pub max_iterations: usize,
    /// Directions that GMRES keeps before it starts again from where it is; ≥ 1.
    pub restart: usize,
}

impl Default for KrylovSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            max_iterations: 2000,
            restart: 60,
        }
    }
}

/// Why an iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The true residual is within the tolerance.
    Converged,
    /// The directions span an invariant space: the solution is exact but for round-off ("happy
    /// breakdown"), and its true residual within the tolerance.
    Exact,
    /// The permitted products are spent.
    Iterations,
    /// The true residual no longer falls: round-off, an inaccurate operator, or a restart length too
    /// short.
    Stagnation,
    /// Conjugate gradients met a direction `d` with `d·A d ≤ 0`: the matrix is not positive definite.
    Indefinite,
    /// A number is not finite.
    NotFinite,
}

/// What an iteration came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Why it ended.
    pub stop: Stop,
    /// Products with the matrix within the iteration; those that check residuals are not counted.
    pub iterations: usize,
    /// `|b − A x| / |b|`, computed from `x`.
    pub residual: f64,
    /// The same as the recursion believed it to be.
    pub estimate: f64,
}

impl Outcome {
    /// Whether the solution is within the tolerance.
    pub fn converged(&self) -> bool {
        matches!(self.stop, Stop::Converged | Stop::Exact)
    }
}

/// A pass from one true residual to the next must bring it below this share, else it stagnates.
const PROGRESS: f64 = 0.9999;
/// A new direction shorter than this, relative to its image, is round-off.
const BREAKDOWN: f64 = 1e-14;

/// Solves `A x = b` for a symmetric positive `A` and preconditioner, from the `x` given.
///
/// # Errors
/// Those of the operator.
pub fn conjugate_gradients<O: Operator>(
    operator: &mut O,
    preconditioner: &dyn Preconditioner,
    b: &[f64],
    x: &mut [f64],
    settings: &KrylovSettings,
) -> Result<Outcome, O::Error> {
    let size = norm(b);
    let mut outcome = Outcome {
        stop: Stop::Converged,
        iterations: 0,
        residual: 0.0,
        estimate: 0.0,
    };
    if size == 0.0 {
        x.fill(0.0);
        return Ok(outcome);
    }
    let count = b.len();
    let (mut z, mut image) = (vec![0.0; count], vec![0.0; count]);
    let mut last = f64::INFINITY;
    // Each pass starts from the true residual; the recursion's drifts away from it.
    loop {
        let mut r = true_residual(operator, b, x)?;
        outcome.residual = norm(&r) / size;
        outcome.estimate = outcome.residual;
        if let Some(stop) = judge(&outcome, last, settings) {
            outcome.stop = stop;
            return Ok(outcome);
        }
        last = outcome.residual;
        preconditioner.apply(&r, &mut z);
        let mut direction = z.clone();
        let mut product = dot(&r, &z);
        while outcome.estimate > settings.tolerance && outcome.iterations < settings.max_iterations
        {
            operator.apply(&direction, &mut image)?;
            outcome.iterations += 1;
            let curvature = dot(&direction, &image);
            if !(curvature > 0.0 && product > 0.0) {
                outcome.stop = if curvature.is_finite() && product.is_finite() {
                    Stop::Indefinite
                } else {
                    Stop::NotFinite
                };
                outcome.residual = norm(&true_residual(operator, b, x)?) / size;
                return Ok(outcome);
            }
            let length = product / curvature;
            add(x, length, &direction);
            add(&mut r, -length, &image);
            outcome.estimate = norm(&r) / size;
            preconditioner.apply(&r, &mut z);
            let next = dot(&r, &z);
            let share = next / product;
            product = next;
            for (d, z) in direction.iter_mut().zip(&z) {
                *d = z + share * *d;
            }
        }
    }
}

/// Solves `A x = b` by GMRES with restarts, from the `x` given; the preconditioner stands on the
/// right, so that the residual it minimises is the true one.
///
/// [Sanchez 2010, app. A.2], with the modified Gram-Schmidt process done twice where it cancels.
///
/// # Errors
/// Those of the operator.
pub fn gmres<O: Operator>(
    operator: &mut O,
    preconditioner: &dyn Preconditioner,
    b: &[f64],
    x: &mut [f64],
    settings: &KrylovSettings,
) -> Result<Outcome, O::Error> {
    let size = norm(b);
    let mut outcome = Outcome {
        stop: Stop::Converged,
        iterations: 0,
        residual: 0.0,
        estimate: 0.0,
    };
    if size == 0.0 {
        x.fill(0.0);
        return Ok(outcome);
    }
    let mut exact = false;
    let mut last = f64::INFINITY;
    loop {
        let r = true_residual(operator, b, x)?;
        outcome.residual = norm(&r) / size;
        if outcome.iterations == 0 {
            outcome.estimate = outcome.residual;
        }
        if let Some(stop) = judge(&outcome, last, settings) {
            outcome.stop = match stop {
                Stop::Converged if exact => Stop::Exact,
                other => other,
            };
            return Ok(outcome);
        }
        last = outcome.residual;
        let mut cycle = Cycle::new(r);
        let mut z = vec![0.0; b.len()];
        while cycle.columns.len() < settings.restart
            && outcome.iterations < settings.max_iterations
            && outcome.estimate > settings.tolerance
            || cycle.columns.is_empty()
        {
            let mut image = vec![0.0; b.len()];
            preconditioner.apply(&cycle.basis[cycle.columns.len()], &mut z);
            operator.apply(&z, &mut image)?;
            outcome.iterations += 1;
            exact = cycle.extend(image);
            outcome.estimate = cycle.residual() / size;
            if exact || !outcome.estimate.is_finite() {
                break;
            }
        }
        let combination = cycle.combination();
        preconditioner.apply(&combination, &mut z);
        add(x, 1.0, &z);
    }
}

/// The end that a true residual calls for, if any.
fn judge(outcome: &Outcome, last: f64, settings: &KrylovSettings) -> Option<Stop> {
    if !outcome.residual.is_finite() {
        Some(Stop::NotFinite)
    } else if outcome.residual <= settings.tolerance {
        Some(Stop::Converged)
    } else if outcome.iterations >= settings.max_iterations {
        Some(Stop::Iterations)
    } else if outcome.residual > PROGRESS * last {
        Some(Stop::Stagnation)
    } else {
        None
    }
}

/// The directions of GMRES between two restarts, and the least-squares problem in them.
struct Cycle {
    basis: Vec<Vec<f64>>,
    /// Columns of the triangle left of the Hessenberg matrix by the rotations.
    columns: Vec<Vec<f64>>,
    rotations: Vec<(f64, f64)>,
    /// The right side, turned by the rotations.
    right: Vec<f64>,
}

impl Cycle {
    fn new(mut r: Vec<f64>) -> Self {
        let length = norm(&r);
        r.iter_mut().for_each(|c| *c /= length);
        Self {
            basis: vec![r],
            columns: Vec::new(),
            rotations: Vec::new(),
            right: vec![length],
        }
    }

    fn residual(&self) -> f64 {
        self.right[self.right.len() - 1].abs()
    }

    /// Adds the image of the last direction; true if it lies in the space of the directions.
    fn extend(&mut self, mut image: Vec<f64>) -> bool {
        let whole = norm(&image);
        let mut column = vec![0.0; self.basis.len()];
        // The second pass takes off what cancellation left of the first.
        for _ in 0..2 {
            for (entry, direction) in column.iter_mut().zip(&self.basis) {
                let part = dot(&image, direction);
                *entry += part;
                add(&mut image, -part, direction);
            }
        }
        let mut rest = norm(&image);
        let exact = rest <= BREAKDOWN * whole;
        if exact {
            rest = 0.0;
        } else {
            image.iter_mut().for_each(|c| *c /= rest);
            self.basis.push(image);
        }
        for (k, &(cos, sin)) in self.rotations.iter().enumerate() {
            let (a, b) = (column[k], column[k + 1]);
            (column[k], column[k + 1]) = (cos * a + sin * b, cos * b - sin * a);
        }
        let last = column.len() - 1;
        let length = column[last].hypot(rest);
        let (cos, sin) = if length > 0.0 {
            (column[last] / length, rest / length)
        } else {
            (1.0, 0.0)
        };
        column[last] = length;
        self.columns.push(column);
        self.rotations.push((cos, sin));
        let g = self.right[last];
        self.right[last] = cos * g;
        self.right.push(-sin * g);
        exact
    }

    /// The combination of directions that minimises the residual.
    fn combination(&self) -> Vec<f64> {
        let mut y = vec![0.0; self.columns.len()];
        for k in (0..y.len()).rev() {
            let known: f64 = (k + 1..y.len()).map(|j| self.columns[j][k] * y[j]).sum();
            let pivot = self.columns[k][k];
            // A direction that the operator takes to nothing adds nothing.
            if pivot != 0.0 {
                y[k] = (self.right[k] - known) / pivot;
            }
        }
        let mut sum = vec![0.0; self.basis[0].len()];
        for (y, direction) in y.iter().zip(&self.basis) {
            add(&mut sum, *y, direction);
        }
        sum
    }
}

fn true_residual<O: Operator>(
    operator: &mut O,
    b: &[f64],
    x: &[f64],
) -> Result<Vec<f64>, O::Error> {
    if x.iter().all(|c| *c == 0.0) {
        return Ok(b.to_vec());
    }
    let mut r = vec![0.0; b.len()];
    operator.apply(x, &mut r)?;
    r.iter_mut().zip(b).for_each(|(r, b)| *r = b - *r);
    Ok(r)
}

/// `x += a d`.
fn add(x: &mut [f64], a: f64, d: &[f64]) {
    for (x, d) in x.iter_mut().zip(d) {
        *x += a * d;
    }
}

/// In one order whatever the threads, in eight partial sums.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a_chunks, b_chunks) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = (a_chunks.remainder().iter())
        .zip(b_chunks.remainder())
        .map(|(a, b)| a * b)
        .sum();
    for (a, b) in a_chunks.zip(b_chunks) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// Euclidean norm.
pub(crate) fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}
