//! How a crack's normal and band follow the strain in the step in which it starts.
//!
//! From the next step on both are fixed. In the first the normal still is the first principal
//! direction of the strain, and the width that of the band across it, so the consistent tangent
//! has two terms more.

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3, solve_lyapunov};

use crate::{Biot, Isotropic};

/// The first principal direction of a strain and its derivative.
pub(crate) struct Turning {
    /// The direction and, for each of the two others, `m_j / (ε_1 − ε_j)`.
    normal: Vector3<f64>,
    others: [Vector3<f64>; 2],
}

impl Turning {
    /// A normal that follows the strain, `dn = Σ_j m_j (n·dε·m_j)/(ε_1 − ε_j)`. Coinciding strains
    /// are left out: there the direction is not differentiable.
    pub fn principal(strain: &Sym, normal: &Vector3<f64>) -> Self {
        let spectrum = strain.spectrum();
        let other = |j: usize| {
            let gap = spectrum.values[0] - spectrum.values[j];
            if gap > 1e-8 * strain.max_abs() {
                spectrum.vectors[j] / gap.sqrt()
            } else {
                Vector3::zeros()
            }
        };
        Self {
            normal: *normal,
            others: [other(1), other(2)],
        }
    }

    /// A normal that does not depend on the strain.
    pub fn fixed(normal: &Vector3<f64>) -> Self {
        Self {
            normal: *normal,
            others: [Vector3::zeros(); 2],
        }
    }

    /// Change of the normal with the strain.
    pub fn rate(&self, strain_rate: &Sym) -> Vector3<f64> {
        let traction = strain_rate.traction(&self.normal);
        self.others.iter().map(|m| m * m.dot(&traction)).sum()
    }

    /// Derivative of `C:(n⊗n)` with the strain.
    pub fn of_crack_stress(&self, elastic: &Isotropic) -> Tangent {
        let terms = self.others.iter().map(|other| {
            let mixed = Sym::dyad_of(&self.normal, other);
            Tangent::dyad(&mixed, &mixed) * (4.0 * elastic.shear_modulus())
        });
        terms.fold(Tangent::zero(), |sum, term| sum + term)
    }

    /// Derivative of the width of the band, in space, for `F → (1 + d) F`: the normal turns with
    /// the strain and both with the rotation.
    pub fn of_width(&self, band: &Band, kinematics: &Biot, d: &Sym) -> f64 {
        if matches!(band, Band::Uniform(_)) {
            return 0.0;
        }
        let f = &kinematics.deformation_gradient;
        let strain_rate = d.congruence(&f.transpose()) * 2.0;
        let stretch_rate = solve_lyapunov(&kinematics.stretch, &strain_rate);
        let rotation = &kinematics.rotation;
        // Ṙ = (Ḟ − R·U̇)·U⁻¹, and U is positive definite.
        let inverse = kinematics.stretch.to_matrix().try_inverse();
        let rotation_rate = (d.to_matrix() * f - rotation * stretch_rate.to_matrix())
            * inverse.unwrap_or_else(Matrix3::zeros);
        let spatial = rotation * self.normal;
        let rate = rotation_rate * self.normal + rotation * self.rate(&stretch_rate);
        width_rate(band, &spatial, &rate)
    }
}

/// Rate of the width of a band when the spatial normal turns.
pub(crate) fn width_rate(band: &Band, normal: &Vector3<f64>, rate: &Vector3<f64>) -> f64 {
    const ANGLE: f64 = 1e-6;
    let size = rate.norm();
    if matches!(band, Band::Uniform(_)) || size == 0.0 {
        return 0.0;
    }
    let side = rate * (ANGLE / size);
    (band.width(&(normal + side)) - band.width(&(normal - side))) * (size / (2.0 * ANGLE))
}
