//! Stress intensities by the interaction integral.

use nalgebra::{Matrix2, Vector2};

use super::domain::Domain;
use super::near_tip::opening_per_intensity;
use super::{Annulus, FaceLoad, NearTip, PlaneElastic, TipField, TipFrame};
use crate::MeasureError;

/// Stress intensities of a tip, Pa √m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Intensity {
    /// K_I, positive when the crack opens.
    pub k1: f64,
    /// K_II, positive when the face to the left of the tip's direction slides along it.
    pub k2: f64,
}

/// K_I and K_II of a tip by the interaction integral over a domain of particles.
///
/// ```text
/// M = Σ_p a_p { (σ ∇q)·∂₁uᵃ + (σᵃ ∇q)·∂₁u − (σ:∇uᵃ) ∂₁q + ρ ü·∂₁uᵃ q } − Σ_faces T·Δ[[uᵃ]] q,
/// K = ½ E′ M(Kᵃ = 1)                                                                         (2)
/// ```
///
/// with an auxiliary field `uᵃ, σᵃ` of mode I or II ([`NearTip`]) [Stern, Becker and Dunham 1976; Shih
/// and Asaro 1988; with inertia Réthoré, Gravouil and Combescure 2005]. All is in the axes of the tip;
/// `∇u = Tᵀ F E − 1` with the axes T now and `E = R̄ᵀ T` in the material, so that a mean rotation R̄
/// of the domain, however large, is no strain. Strains must be small and elastic. Inertia is that of a
/// tip at rest; for a moving one K means nothing before the speed's functions are put in.
///
/// # Errors
/// As [`j_integral`](super::j_integral).
pub fn interaction(
    field: &TipField,
    tip: &TipFrame,
    annulus: &Annulus,
    elastic: &PlaneElastic,
) -> Result<Intensity, MeasureError> {
    elastic.check()?;
    let domain = Domain::new(field, tip, annulus)?;
    let now = domain.axes;
    let material = domain.rotation.transpose() * now;
    let mut m = Vector2::zeros();
    for (sample, q, gradient) in domain.samples() {
        let x = now.transpose() * (sample.position - tip.position);
        let gradient = now.transpose() * gradient;
        let stress = now.transpose() * sample.plane_stress() * now;
        let u = now.transpose() * sample.gradient() * material - Matrix2::identity();
        let force = sample.density * q * (now.transpose() * sample.acceleration);
        let area = sample.area * sample.gradient().determinant();
        for (mode, k) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let other = NearTip::of(elastic, k, &x);
            let slope = other.gradient.column(0);
            let flux = (stress * gradient).dot(&slope)
                + (other.stress * gradient).dot(&u.column(0))
                - stress.dot(&other.gradient) * gradient.x;
            m[mode] += area * (flux + force.dot(&slope));
        }
    }
    for (face, q) in domain.faces() {
        let traction = now.transpose() * face.traction;
        let change = jump_change(face, tip, elastic);
        m -= Vector2::new(traction.y, traction.x) * (change * q);
    }
    let [k1, k2] = [m.x, m.y].map(|m| 0.5 * elastic.effective_modulus() * m);
    if k1.is_finite() && k2.is_finite() {
        Ok(Intensity { k1, k2 })
    } else {
        Err(MeasureError::NotFinite { measure: "K" })
    }
}

/// What the jump of the auxiliary field with unit intensity loses over a piece of the faces on the way
/// to the tip.
fn jump_change(face: &FaceLoad, tip: &TipFrame, elastic: &PlaneElastic) -> f64 {
    let r = (face.position - tip.position).norm();
    let at = |r: f64| opening_per_intensity(elastic, r.max(0.0));
    at(r - 0.5 * face.length) - at(r + 0.5 * face.length)
}
