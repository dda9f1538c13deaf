//! Gaussian random fields on a lattice.

use nalgebra::SVector;
use rustfft::num_complex::Complex64;

use super::correlation::Correlation;
use super::embedding::{Embedding, advance, embed};
use super::error::{FieldError, positive};
use super::fourier::transform;
use super::noise::Normals;

/// Share of the variance that negative eigenvalues may have unless the caller says otherwise.
const PERMITTED: f64 = 1e-3;
/// A place this far outside the lattice, in spacings, is on its edge.
const EDGE: f64 = 1e-9;

/// Draws fields of one correlation over one region: the embedding is made once.
///
/// ```
/// use fissure_particles::{Correlation, FieldSampler, Marginal};
/// use nalgebra::Vector2;
///
/// // A strength that varies by 10 % over about 20 mm on a plate of 0.2 by 0.1 m.
/// let correlation = Correlation::Exponential { alpha: 1.0 / 0.02_f64.powf(1.5) };
/// let sampler = FieldSampler::new([0.0, 0.0], [0.2, 0.1], 2.5e-3, correlation)?;
/// assert!(sampler.embedding().negative < 1e-12);
/// let field = sampler.draw(42);
/// let strength = Marginal::Weibull { modulus: 12.0 };
/// let factor = field.at(&Vector2::new(0.1, 0.05)).map(|z| strength.of(z));
/// assert!(factor.is_some_and(|factor| factor > 0.0));
/// assert_eq!(field.at(&Vector2::new(0.3, 0.05)), None);
/// # Ok::<(), fissure_particles::FieldError>(())
/// ```
#[derive(Clone, Debug)]
pub struct FieldSampler<const D: usize> {
    origin: SVector<f64, D>,
    spacing: f64,
    points: [usize; D],
    correlation: Correlation,
    embedding: Embedding<D>,
    roots: Vec<f64>,
}

impl<const D: usize> FieldSampler<D> {
    /// Fields over the box from `min` to `max`, m, on a lattice of `spacing` m that starts at `min`.
    /// A third of the correlation length or less resolves it; the spacing of the particles, with
    /// `min` at one of them, gives them lattice values.
    ///
    /// # Errors
    /// A parameter outside its range, a lattice that is too large, or a correlation too long for
    /// the box: negative eigenvalues with more than 1e-3 of the variance.
    pub fn new(
        min: [f64; D],
        max: [f64; D],
        spacing: f64,
        correlation: Correlation,
    ) -> Result<Self, FieldError> {
        Self::permitting(min, max, spacing, correlation, PERMITTED)
    }

    /// The same with another share of the variance that negative eigenvalues may have; 0 to permit
    /// none (but round-off).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn permitting(
        min: [f64; D],
        max: [f64; D],
        spacing: f64,
        correlation: Correlation,
        permitted: f64,
    ) -> Result<Self, FieldError> {
        correlation.check()?;
        positive("spacing [m]", spacing)?;
        if !(0.0..1.0).contains(&permitted) {
            return Err(FieldError::Parameter {
                parameter: "permitted share of negative eigenvalues",
                value: permitted,
                permitted: "in [0, 1)",
            });
        }
        let mut points = [2; D];
        for axis in 0..D {
            let (min, max) = (min[axis], max[axis]);
            let cells = ((max - min) / spacing - EDGE).ceil();
            if !(min < max && cells.is_finite()) {
                return Err(FieldError::Extent { axis, min, max });
            }
            // Saturates; the limit of the embedding refuses it then.
            points[axis] = (cells.min(1e9) as usize).max(1) + 1;
        }
        let (embedding, roots) = embed(&points, spacing, &correlation, permitted)?;
        Ok(Self {
            origin: SVector::from(min),
            spacing,
            points,
            correlation,
            embedding,
            roots,
        })
    }

    /// How the correlation was embedded, and what that leaves out.
    pub fn embedding(&self) -> &Embedding<D> {
        &self.embedding
    }

    /// The field of a seed.
    pub fn draw(&self, seed: u64) -> RandomField<D> {
        let mut normals = Normals::of_field(seed);
        let mut sums: Vec<Complex64> = self
            .roots
            .iter()
            .map(|root| {
                let (a, b) = normals.pair();
                Complex64::new(root * a, root * b)
            })
            .collect();
        let size = &self.embedding.size;
        transform(&mut sums, size);
        let mut values = Vec::with_capacity(self.points.iter().product());
        let mut index = [0; D];
        for _ in 0..self.points.iter().product() {
            let place = index.iter().zip(size).rev();
            let place = place.fold(0, |sum, (&k, &length)| sum * length + k);
            values.push(sums[place].re);
            advance(&mut index, &self.points);
        }
        let diagonal = |corner: usize| self.spacing * f64::from(corner.count_ones()).sqrt();
        RandomField {
            origin: self.origin,
            spacing: self.spacing,
            points: self.points,
            values,
            corners: (0..1 << D)
                .map(|corner| self.correlation.at(diagonal(corner)))
                .collect(),
        }
    }
}

/// A field of mean 0 and variance 1 over a box.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomField<const D: usize> {
    origin: SVector<f64, D>,
    spacing: f64,
    points: [usize; D],
    values: Vec<f64>,
    /// Correlation of two corners of a cell, by the axes along which they differ.
    corners: Vec<f64>,
}

impl<const D: usize> RandomField<D> {
    /// Lattice points along each axis.
    pub fn points(&self) -> [usize; D] {
        self.points
    }

    /// Values at the lattice points, the first axis fastest.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value at a place, m; `None` outside the lattice.
    ///
    /// Between lattice points the corners of a cell are weighed as multilinear interpolation does
    /// and the sum divided by its own standard deviation `√(Σ_ab w_a w_b ρ_ab)`: without that the
    /// field would be weaker in the middle of cells.
    pub fn at(&self, x: &SVector<f64, D>) -> Option<f64> {
        let (mut first, mut stride) = (0, 1);
        let mut part = [0.0; D];
        let mut strides = [0; D];
        for axis in 0..D {
            let cells = self.points[axis] - 1;
            let place = (x[axis] - self.origin[axis]) / self.spacing;
            if !(place >= -EDGE && place <= cells as f64 + EDGE) {
                return None;
            }
            let cell = (place.max(0.0) as usize).min(cells - 1);
            part[axis] = (place - cell as f64).clamp(0.0, 1.0);
            first += cell * stride;
            strides[axis] = stride;
            stride *= self.points[axis];
        }
        let (mut sum, mut variance) = (0.0, 0.0);
        for a in 0..1 << D {
            let weight = weight(&part, a);
            let offset: usize = (0..D)
                .filter(|axis| a >> axis & 1 == 1)
                .map(|axis| strides[axis])
                .sum();
            sum += weight * self.values[first + offset];
            for b in 0..1 << D {
                variance += weight * self::weight(&part, b) * self.corners[a ^ b];
            }
        }
        Some(sum / variance.sqrt())
    }
}

/// Weight of a corner of a cell, by the axes along which it is the far one.
fn weight<const D: usize>(part: &[f64; D], corner: usize) -> f64 {
    let factors = part.iter().enumerate();
    factors
        .map(|(axis, part)| {
            if corner >> axis & 1 == 1 {
                *part
            } else {
                1.0 - part
            }
        })
        .product()
}
