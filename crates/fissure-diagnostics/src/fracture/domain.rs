//! The J-integral over a domain of particles.

use std::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};

use super::field::{TipField, TipFrame, TipSample};
use crate::MeasureError;

/// The domain of an integral around a tip: a weight q of 1 within the inner radius, 0 outside the
/// outer, falling between them as `1 − s³(10 − 15 s + 6 s²)`, twice continuously differentiable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annulus {
    /// Inner radius, m; 0 is permitted.
    pub inner: f64,
    /// Outer radius, m.
    pub outer: f64,
}

impl Annulus {
    /// Share of the domain's area that may lack particles, or hold too many, before it is refused.
    pub const COVERAGE: f64 = 0.05;

    pub(super) fn check(&self) -> Result<(), MeasureError> {
        let valid = self.inner >= 0.0 && self.outer > self.inner && self.outer.is_finite();
        if valid {
            return Ok(());
        }
        Err(MeasureError::Parameter {
            parameter: "inner radius of the domain",
            value: self.inner,
            permitted: "not below 0 and below the outer radius",
        })
    }

    /// q and its gradient, 1/m, at a place relative to the tip, m.
    pub fn weight(&self, x: &Vector2<f64>) -> (f64, Vector2<f64>) {
        let r = x.norm();
        let s = (r - self.inner) / (self.outer - self.inner);
        if s <= 0.0 {
            return (1.0, Vector2::zeros());
        }
        if !(s < 1.0) {
            return (0.0, Vector2::zeros());
        }
        let q = 1.0 - s * s * s * (10.0 - s * (15.0 - 6.0 * s));
        let slope = -30.0 * (s * (1.0 - s)).powi(2) / (self.outer - self.inner);
        (q, x * (slope / r))
    }

    /// ∫ q dA over the plane, m².
    fn area(&self) -> f64 {
        let width = self.outer - self.inner;
        PI * (self.inner * self.inner + width * (self.inner + 2.0 / 7.0 * width))
    }
}

/// What is the same for all samples of a domain.
pub(super) struct Domain<'a> {
    pub tip: &'a TipFrame,
    annulus: &'a Annulus,
    /// Mean rotation of the material in the domain.
    pub rotation: Matrix2<f64>,
    /// Axes of the tip as columns, now.
    pub axes: Matrix2<f64>,
    field: &'a TipField,
}

impl<'a> Domain<'a> {
    pub(super) fn new(
        field: &'a TipField,
        tip: &'a TipFrame,
        annulus: &'a Annulus,
    ) -> Result<Self, MeasureError> {
        annulus.check()?;
        let length = tip.direction.norm();
        if !((length - 1.0).abs() < 1e-9) {
            return Err(MeasureError::Parameter {
                parameter: "length of the tip's direction",
                value: length,
                permitted: "1",
            });
        }
        let mut domain = Self {
            tip,
            annulus,
            rotation: Matrix2::identity(),
            axes: tip.axes(),
            field,
        };
        let (mut mean, mut covered) = (Matrix2::zeros(), 0.0);
        for (sample, q, gradient) in domain.samples() {
            mean += sample.gradient() * (sample.area * gradient.norm());
            covered += sample.area * sample.gradient().determinant() * q;
        }
        let coverage = covered / annulus.area();
        if !((coverage - 1.0).abs() <= Annulus::COVERAGE) {
            return Err(MeasureError::Coverage { coverage });
        }
        // Of the plane's polar decomposition.
        let (sine, cosine) = (mean.m21 - mean.m12, mean.m11 + mean.m22);
        let size = sine.hypot(cosine);
        domain.rotation = Matrix2::new(cosine, -sine, sine, cosine) / size;
        Ok(domain)
    }

    /// The samples of the domain with q and its gradient there.
    pub(super) fn samples(&self) -> impl Iterator<Item = (&TipSample, f64, Vector2<f64>)> {
        self.field.samples.iter().filter_map(|sample| {
            let (q, gradient) = self.annulus.weight(&(sample.position - self.tip.position));
            (q > 0.0).then_some((sample, q, gradient))
        })
    }

    /// The loads on the crack's faces in the domain with q there.
    pub(super) fn faces(&self) -> impl Iterator<Item = (&super::FaceLoad, f64)> {
        self.field.faces.iter().filter_map(|face| {
            let (q, _) = self.annulus.weight(&(face.position - self.tip.position));
            (q > 0.0).then_some((face, q))
        })
    }
}

/// The J-integral of a tip over a domain of particles, J/m².
///
/// ```text
/// J = Σ_p A_p { det F [σ·∇q]·(F e₁ − t) − (W + ½ρ v²) ∇q·F e₁ }
///   + Σ_p A_p ρ { ü·(F e₁ − t) − v·Ḟ e₁ } q  −  Σ_faces T·Δ[[u]] q                            (1)
/// ```
///
/// with the reference area A_p and density ρ of a particle, the weight q at its present place, the
/// present unit vector t out of the crack and the direction `e₁ = R̄ᵀ t` it had in the material,
/// where R̄ is the mean rotation in the domain. It is the domain form of
/// `J = lim ∮ [(W + T) n₁ − P n·u,₁] ds` [Nakamura, Shih and Freund 1985; Moran and Shih 1987] in the
/// reference placement, with `∂q/∂X = Fᵀ∇q` and `P Fᵀ = det F σ`, hence for any strain and rotation.
/// Instead of `u,₁ = F e₁ − e₁` it has `F e₁ − t`: a constant vector more or less changes nothing in
/// equilibrium, since `∫ P·∂q/∂X dV = −∫ ρ ü q dV`, and with t a body turned with its crack gives the
/// same to round-off. Elastic energy W only: J of a plastic or damaged domain depends on the domain.
///
/// The faces must be straight in the domain, which must lie inside the body and hold no other tip.
///
/// # Errors
/// [`MeasureError::Parameter`] for radii or a direction that are none; [`MeasureError::Coverage`]
/// if the particles do not fill the domain; [`MeasureError::NotFinite`].
pub fn j_integral(
    field: &TipField,
    tip: &TipFrame,
    annulus: &Annulus,
) -> Result<f64, MeasureError> {
    let domain = Domain::new(field, tip, annulus)?;
    let t = tip.direction;
    let ahead = domain.rotation.transpose() * t;
    let mut j = 0.0;
    for (sample, q, gradient) in domain.samples() {
        let f = sample.gradient();
        let along = f * ahead;
        let (slope, jacobian) = (along - t, sample.deformation_gradient.determinant());
        let kinetic = 0.5 * sample.density * sample.velocity.norm_squared();
        let power = sample.plane_stress() * gradient;
        let flux = jacobian * power.dot(&slope) - (sample.stored + kinetic) * gradient.dot(&along);
        let inertia =
            sample.acceleration.dot(&slope) - sample.velocity.dot(&(sample.gradient_rate * ahead));
        j += sample.area * (flux + sample.density * inertia * q);
    }
    for (face, q) in domain.faces() {
        j -= face.traction.dot(&face.jump_change) * q;
    }
    if j.is_finite() {
        Ok(j)
    } else {
        Err(MeasureError::NotFinite { measure: "J" })
    }
}

/// J over several domains: how far it depends on which.
#[derive(Clone, Debug, PartialEq)]
pub struct Contours {
    /// J of each, J/m².
    pub j: Vec<f64>,
    /// Their mean, J/m².
    pub mean: f64,
    /// Largest less smallest, over the magnitude of the mean.
    pub spread: f64,
}

/// [`j_integral`] over each of these domains.
///
/// # Errors
/// Of the first domain that fails; [`MeasureError::Parameter`] if there is none.
pub fn contours(
    field: &TipField,
    tip: &TipFrame,
    domains: &[Annulus],
) -> Result<Contours, MeasureError> {
    let values = domains.iter().map(|domain| j_integral(field, tip, domain));
    let j = values.collect::<Result<Vec<f64>, _>>()?;
    if j.is_empty() {
        return Err(MeasureError::Parameter {
            parameter: "number of domains",
            value: 0.0,
            permitted: "1 or more",
        });
    }
    let mean = j.iter().sum::<f64>() / j.len() as f64;
    let least = j.iter().fold(f64::INFINITY, |a, b| a.min(*b));
    let most = j.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
    Ok(Contours {
        spread: (most - least) / mean.abs(),
        j,
        mean,
    })
}
