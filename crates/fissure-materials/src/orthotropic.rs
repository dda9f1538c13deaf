//! Orthotropic linear elasticity on the Biot strain, in a frame that turns with the material.
//!
//! Engineering constants along the material axes 1, 2, 3 (columns of `axes` in the reference
//! configuration), with `ν_ij = −ε_j/ε_i` under a stress along `i`, so `ν_ij/E_i = ν_ji/E_j`  (1):
//!
//! ```text
//! ε_11 = σ_11/E_1 − ν_12 σ_22/E_1 − ν_13 σ_33/E_1,  …,  2 ε_23 = γ_23 = σ_23/G_23,  …       (2)
//! ```
//!
//! Inverted, with `Δ = 1 − ν_12 ν_21 − ν_23 ν_32 − ν_13 ν_31 − 2 ν_21 ν_32 ν_13`  (3):
//! `C_11 = E_1 (1 − ν_23 ν_32)/Δ`, `C_12 = E_1 (ν_21 + ν_31 ν_23)/Δ`,
//! `C_13 = E_1 (ν_31 + ν_21 ν_32)/Δ`, `C_23 = E_2 (ν_32 + ν_12 ν_31)/Δ` and so on round  (4).
//! In Voigt form with engineering shears the last three diagonal entries are `G`; in Mandel form
//! (`fissure-tensor`: 11, 22, 33, √2·23, √2·13, √2·12 for both stress and strain) they are `2G`,
//! and the normal block is the same.
//!
//! The strain is `E = U − 1`, the stress conjugate to it `T = C:E`, `ψ = ½ E:C:E`  (5): objective,
//! with an energy at any strain, and the axes turn with `R` of `F = R·U`. Positive definite if and
//! only if `E_i, G_ij > 0`, `|ν_ij| < √(E_i/E_j)` and `Δ > 0`  (6).
//!
//! Wave speed at rest: with `w_ij = (a_i n_j)²`, which add up to 1 over all `i, j`,
//! `a·Q(n)·a = Σ C_ii w_ii + Σ_{i<j} G_ij (w_ij + w_ji) + 2 (C_ij + G_ij) a_i n_i a_j n_j`, and the
//! last product is at most `½ (w_ij + w_ji)`, so `ρc² ≤ max(C_ii, G_ij + |C_ij + G_ij|)`  (7); the
//! isotropic value is exact.

use fissure_tensor::{Matrix3, Sym, Tangent};

use crate::{
    Biot, Increment, Isotropic, Material, MaterialError, Response, Scale, check_parameter,
};

const NAME: &str = "orthotropic elasticity";

/// Orthotropic elastic constants, and the law of that name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orthotropic {
    /// Reference mass density ρ, kg/m³; > 0.
    pub density: f64,
    /// Young's moduli E₁, E₂, E₃ along the material axes, Pa; > 0.
    pub young: [f64; 3],
    /// Poisson's ratio ν₁₂ (contraction along 2 under a pull along 1); |ν₁₂| < √(E₁/E₂).
    pub poisson_12: f64,
    /// Poisson's ratio ν₁₃; |ν₁₃| < √(E₁/E₃).
    pub poisson_13: f64,
    /// Poisson's ratio ν₂₃; |ν₂₃| < √(E₂/E₃).
    pub poisson_23: f64,
    /// Shear modulus G₁₂, Pa; > 0.
    pub shear_12: f64,
    /// Shear modulus G₁₃, Pa; > 0.
    pub shear_13: f64,
    /// Shear modulus G₂₃, Pa; > 0.
    pub shear_23: f64,
    /// Rotation from the material axes to those of the reference configuration: its columns are
    /// the material axes.
    pub axes: Matrix3<f64>,
}

/// Ratios `ν_12, ν_21, ν_13, ν_31, ν_23, ν_32` and `Δ` of eq. 3.
struct Ratios {
    n12: f64,
    n21: f64,
    n13: f64,
    n31: f64,
    n23: f64,
    n32: f64,
    determinant: f64,
}

impl Orthotropic {
    /// The same constants in every direction.
    pub fn from_isotropic(elastic: &Isotropic) -> Self {
        let shear = elastic.shear_modulus();
        Self {
            density: elastic.density,
            young: [elastic.young; 3],
            poisson_12: elastic.poisson,
            poisson_13: elastic.poisson,
            poisson_23: elastic.poisson,
            shear_12: shear,
            shear_13: shear,
            shear_23: shear,
            axes: Matrix3::identity(),
        }
    }

    /// The elasticity tensor in the axes of the reference configuration, Pa.
    pub fn stiffness(&self) -> Tangent {
        self.stiffness_in_material_axes().rotated(&self.axes)
    }

    /// The elasticity tensor in the material axes (eq. 4), Pa.
    pub fn stiffness_in_material_axes(&self) -> Tangent {
        let r = self.ratios();
        let [e1, e2, e3] = self.young.map(|young| young / r.determinant);
        let (c12, c13) = (e1 * (r.n21 + r.n31 * r.n23), e1 * (r.n31 + r.n21 * r.n32));
        let c23 = e2 * (r.n32 + r.n12 * r.n31);
        let mut c = Tangent::zero();
        c.0[(0, 0)] = e1 * (1.0 - r.n23 * r.n32);
        c.0[(1, 1)] = e2 * (1.0 - r.n13 * r.n31);
        c.0[(2, 2)] = e3 * (1.0 - r.n12 * r.n21);
        for (i, j, value) in [(0, 1, c12), (0, 2, c13), (1, 2, c23)] {
            c.0[(i, j)] = value;
            c.0[(j, i)] = value;
        }
        c.0[(3, 3)] = 2.0 * self.shear_23;
        c.0[(4, 4)] = 2.0 * self.shear_13;
        c.0[(5, 5)] = 2.0 * self.shear_12;
        c
    }

    /// `C:ε` in the axes of the reference configuration, Pa.
    pub fn stress(&self, strain: &Sym) -> Sym {
        let material = strain.congruence(&self.axes.transpose());
        let stress = self.stiffness_in_material_axes().apply(&material);
        stress.congruence(&self.axes)
    }

    /// The same constants with the stiffness scaled.
    pub fn scaled(&self, scale: &Scale) -> Self {
        Self {
            young: self.young.map(|young| young * scale.stiffness),
            shear_12: self.shear_12 * scale.stiffness,
            shear_13: self.shear_13 * scale.stiffness,
            shear_23: self.shear_23 * scale.stiffness,
            ..*self
        }
    }

    /// Bound on `ρc²` at rest (eq. 7), Pa.
    pub fn wave_modulus(&self) -> f64 {
        let c = self.stiffness_in_material_axes().0;
        let mut largest: f64 = 0.0;
        for i in 0..3 {
            largest = largest.max(c[(i, i)]);
            for j in 0..i {
                // Mandel positions 3, 4, 5 are the shears across the axes 0, 1, 2.
                let shear = 0.5 * c[(6 - i - j, 6 - i - j)];
                largest = largest.max(shear + (c[(i, j)] + shear).abs());
            }
        }
        largest
    }

    fn ratios(&self) -> Ratios {
        let [e1, e2, e3] = self.young;
        let (n12, n13, n23) = (self.poisson_12, self.poisson_13, self.poisson_23);
        let (n21, n31, n32) = (n12 * (e2 / e1), n13 * (e3 / e1), n23 * (e3 / e2));
        let determinant = 1.0 - n12 * n21 - n23 * n32 - n13 * n31 - 2.0 * n21 * n32 * n13;
        Ratios {
            n12,
            n21,
            n13,
            n31,
            n23,
            n32,
            determinant,
        }
    }

    /// Refuses constants outside their range, in the name of `law`.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`].
    pub fn check_for(&self, law: &'static str) -> Result<(), MaterialError> {
        let density = self.density;
        check_parameter(law, "density", density, density > 0.0, "finite and > 0")?;
        for young in self.young {
            check_parameter(law, "young", young, young > 0.0, "finite and > 0")?;
        }
        for (name, shear) in [
            ("shear_12", self.shear_12),
            ("shear_13", self.shear_13),
            ("shear_23", self.shear_23),
        ] {
            check_parameter(law, name, shear, shear > 0.0, "finite and > 0")?;
        }
        let r = self.ratios();
        let rule = "|nu_ij| < sqrt(E_i/E_j), for a positive energy";
        for (name, ratio, inverse) in [
            ("poisson_12", r.n12, r.n21),
            ("poisson_13", r.n13, r.n31),
            ("poisson_23", r.n23, r.n32),
        ] {
            check_parameter(law, name, ratio, ratio * inverse < 1.0, rule)?;
        }
        let determinant = r.determinant;
        check_parameter(
            law,
            "poisson",
            determinant,
            determinant > 0.0,
            "1 - n12 n21 - n23 n32 - n13 n31 - 2 n21 n32 n13 > 0, for a positive energy",
        )?;
        check_axes(law, &self.axes)
    }
}

/// Refuses axes that are no rotation, to `1e-9`.
pub(crate) fn check_axes(law: &'static str, axes: &Matrix3<f64>) -> Result<(), MaterialError> {
    let error = (axes.transpose() * axes - Matrix3::identity()).amax();
    let rule = "columns of unit length, at right angles and right-handed";
    check_parameter(law, "axes", error, error <= 1e-9, rule)?;
    let determinant = axes.determinant();
    check_parameter(law, "axes", determinant, determinant > 0.0, rule)
}

impl Material for Orthotropic {
    type State = ();
    const STRESS_FROM_GRADIENT: bool = true;
    const STEP_ERROR: f64 = 0.0;

    fn check(&self) -> Result<(), MaterialError> {
        self.check_for(NAME)
    }

    fn isotropic(&self) -> bool {
        false
    }

    fn density(&self) -> f64 {
        self.density
    }

    /// That of eq. 7 times the longest stretch, which brings it to the current configuration.
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &(), scale: &Scale) -> f64 {
        (self.scaled(scale).wave_modulus() / self.density).sqrt() * Biot::longest_stretch(f)
    }

    fn update(&self, increment: &Increment, _old: &()) -> Result<Response<()>, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let strain = kinematics.strain();
        let biot_stress = self.scaled(&increment.external.scale).stress(&strain);
        Ok(Response {
            stress: kinematics.cauchy(&biot_stress),
            state: (),
            stored: 0.5 * biot_stress.dot(&strain),
            dissipated: 0.0,
        })
    }

    fn tangent(&self, increment: &Increment, _old: &()) -> Result<Tangent, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let elastic = self.scaled(&increment.external.scale);
        let biot_stress = elastic.stress(&kinematics.strain());
        Ok(kinematics.spatial_tangent(&biot_stress, &elastic.stiffness()))
    }
}

#[cfg(test)]
mod tests;
