//! Isotropic laws on the logarithmic strain, on the principal axes they share with their stress.
//!
//! For a Kirchhoff stress `τ` that is an isotropic function of `h = ½ ln b` with
//! `τ_i − τ_j = 2 μ (h_i − h_j)`, and a `b` that follows `F → (1 + d) F` as `δb = d·b + b·d` (the
//! total left Cauchy-Green tensor, or the elastic one while the plastic deformation is held), the
//! spatial tangent on the principal axes `n_i` is (Ogden 1997, sec. 6.1.4; Simo 1992, eq. 3.8)
//! `J c_iijj = ∂τ_i/∂h_j − 2 τ_i δ_ij` and `J c_ijij = μ x coth x − (τ_i + τ_j)/2` with
//! `x = h_i − h_j`, smooth where principal strains coincide.

use fissure_tensor::{Sym, Tangent, Vector3};

use crate::{Isotropic, MaterialError};

/// A logarithmic strain and the volume ratio that belongs to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LogStrain {
    /// Principal axes in space.
    pub axes: [Vector3<f64>; 3],
    /// Principal values `h_i`.
    pub values: [f64; 3],
    /// `ln J`.
    pub log_jacobian: f64,
    /// `J`.
    pub jacobian: f64,
}

impl LogStrain {
    /// From `b − 1`, whose principal values keep their relative accuracy near rest, and `J − 1`.
    ///
    /// # Errors
    /// [`MaterialError::NotFinite`] in the name of `law` where a stretch vanishes or overflows.
    pub fn new(excess: &Sym, dilation: f64, law: &'static str) -> Result<Self, MaterialError> {
        let spectrum = excess.spectrum();
        let values = spectrum.values.map(|excess| 0.5 * excess.ln_1p());
        if !values.iter().all(|h| h.is_finite()) {
            return Err(MaterialError::NotFinite { law });
        }
        Ok(Self {
            axes: spectrum.vectors,
            values,
            log_jacobian: dilation.ln_1p(),
            jacobian: 1.0 + dilation,
        })
    }

    /// Deviatoric principal values.
    pub fn deviator(&self) -> [f64; 3] {
        let mean = self.values.iter().sum::<f64>() / 3.0;
        self.values.map(|h| h - mean)
    }

    /// Cauchy stress of a principal Kirchhoff stress.
    pub fn cauchy(&self, kirchhoff: &[f64; 3]) -> Sym {
        (0..3)
            .map(|i| Sym::dyad(&self.axes[i]) * (kirchhoff[i] / self.jacobian))
            .sum()
    }

    /// Spatial tangent from the principal Kirchhoff stress, the shear modulus `μ` of its
    /// differences and the principal moduli `∂τ_i/∂h_j`.
    pub fn spatial_tangent(
        &self,
        kirchhoff: &[f64; 3],
        shear: f64,
        moduli: impl Fn(usize, usize) -> f64,
    ) -> Tangent {
        let normals = self.axes.map(|axis| Sym::dyad(&axis));
        let mut tangent = Tangent::zero();
        for i in 0..3 {
            for j in 0..3 {
                let geometric = if i == j { 2.0 * kirchhoff[i] } else { 0.0 };
                let modulus = moduli(i, j) - geometric;
                tangent = tangent + Tangent::dyad(&normals[i], &normals[j]) * modulus;
            }
            for j in 0..i {
                let mixed = Sym::dyad_of(&self.axes[i], &self.axes[j]);
                let modulus = shear * x_coth_x(self.values[i] - self.values[j])
                    - 0.5 * (kirchhoff[i] + kirchhoff[j]);
                tangent = tangent + Tangent::dyad(&mixed, &mixed) * (4.0 * modulus);
            }
        }
        tangent * (1.0 / self.jacobian)
    }

    /// Largest `ρ₀c²` of the elastic waves that run along a principal axis: `λ + 2μ − τ_i` for the
    /// longitudinal one, `μ x (coth x + 1)` with `x = h_i − h_j` for those across.
    pub fn wave_modulus(&self, elastic: &Isotropic, kirchhoff: &[f64; 3]) -> f64 {
        let shear = elastic.shear_modulus();
        let mut largest: f64 = 0.0;
        for (i, stress) in kirchhoff.iter().enumerate() {
            largest = largest.max(elastic.p_wave_modulus() - stress);
            for j in 0..3 {
                let x = self.values[i] - self.values[j];
                largest = largest.max(shear * (x_coth_x(x) + x));
            }
        }
        largest
    }
}

/// `x coth x`, 1 at 0.
fn x_coth_x(x: f64) -> f64 {
    if x.abs() < 1e-4 {
        1.0 + x * x / 3.0
    } else {
        x / x.tanh()
    }
}
