//! Biot kinematics: a small-strain law on the right stretch, objective and energy-consistent.
//!
//! With `F = R·U` the strain is `E = U − 1`, linear in the opening of a crack, and a law gives the
//! conjugate stress `T(E)`. The second Piola-Kirchhoff stress solves `U·S + S·U = 2T`, which holds
//! whether or not `T` and `U` share their axes, and the Cauchy stress is `F·S·Fᵀ / det F`. The
//! work of the Cauchy stress is then exactly `T : dE` per reference volume.

use std::f64::consts::SQRT_2;

use fissure_tensor::{Matrix3, Sym, Tangent, Vector3, polar, solve_lyapunov};

use crate::MaterialError;
use crate::finite_strain::rows;

/// Kinematics of one deformation gradient for laws written on the Biot strain.
#[derive(Clone, Copy, Debug)]
pub struct Biot {
    /// The deformation gradient.
    pub deformation_gradient: Matrix3<f64>,
    /// Rotation `R`.
    pub rotation: Matrix3<f64>,
    /// Right stretch `U`.
    pub stretch: Sym,
    /// `det F`.
    pub jacobian: f64,
}

impl Biot {
    /// Polar decomposition of a deformation gradient.
    ///
    /// # Errors
    /// [`MaterialError::Deformation`] unless `F` is finite with positive determinant.
    #[inline]
    pub fn new(f: &Matrix3<f64>) -> Result<Self, MaterialError> {
        let jacobian = f.determinant();
        let polar = polar(f).ok_or(MaterialError::Deformation {
            determinant: jacobian,
        })?;
        Ok(Self {
            deformation_gradient: *f,
            rotation: polar.rotation,
            stretch: polar.stretch,
            jacobian,
        })
    }

    /// Strain `U − 1`.
    #[inline]
    pub fn strain(&self) -> Sym {
        self.stretch - Sym::IDENTITY
    }

    /// Bound on the largest principal stretch, at least 1; attained where the others coincide.
    ///
    /// With `C = FᵀF`, `λ² ≤ tr C/3 + 2 √(J₂(C)/3)`: no spectrum needed. It turns a wave speed of the
    /// reference configuration into a bound of that of the current one.
    #[inline]
    pub fn longest_stretch(f: &Matrix3<f64>) -> f64 {
        Self::longest_stretch_of_rows(rows(f))
    }

    /// The same from the components, row by row; without branches and calls.
    #[inline(always)]
    pub(crate) fn longest_stretch_of_rows([xx, xy, xz, yx, yy, yz, zx, zy, zz]: [f64; 9]) -> f64 {
        let squared = Sym {
            mandel: [
                xx * xx + yx * yx + zx * zx,
                xy * xy + yy * yy + zy * zy,
                xz * xz + yz * yz + zz * zz,
                SQRT_2 * (xy * xz + yy * yz + zy * zz),
                SQRT_2 * (xx * xz + yx * yz + zx * zz),
                SQRT_2 * (xx * xy + yx * yy + zx * zy),
            ],
        };
        let largest = squared.mean() + 2.0 * (squared.j2() / 3.0).sqrt();
        let stretch = largest.sqrt();
        // Not `max`, which is a call.
        if stretch > 1.0 { stretch } else { 1.0 }
    }

    /// Cauchy stress from the stress `T` conjugate to the strain.
    ///
    /// `U·S = T + W` with a skew `W`, since `S·U` is its transpose; that `S` is symmetric asks `W·U + U·W = U·T − T·U`,
    /// for the axial vectors `(tr U − U) w = k`, and `F·S·Fᵀ` is `R·(T + W)·Fᵀ`: no spectrum needed.
    #[inline]
    pub fn cauchy(&self, biot_stress: &Sym) -> Sym {
        if self.stretch.yz() == 0.0 && self.stretch.xz() == 0.0 {
            let second_piola = self.second_piola(biot_stress);
            return second_piola.congruence(&self.deformation_gradient) / self.jacobian;
        }
        let t = biot_stress.to_matrix();
        let ut = self.stretch.to_matrix() * t;
        let axial = Vector3::new(ut.m32 - ut.m23, ut.m13 - ut.m31, ut.m21 - ut.m12);
        let half = t + self.solve_pairs(&axial).cross_matrix();
        let kirchhoff = self.rotation * half * self.deformation_gradient.transpose();
        Sym::from_matrix(&kirchhoff) / self.jacobian
    }

    /// The stress `T` conjugate to the strain from the Cauchy stress: `cauchy` inverted.
    pub fn conjugate(&self, cauchy: &Sym) -> Sym {
        // Rᵀ·J·σ·R = U·S·U; the Lyapunov equation is undone by T = (U·S + S·U)/2.
        let Some(inverse) = self.deformation_gradient.try_inverse() else {
            return Sym::ZERO; // not reached: `new` refused a singular gradient
        };
        let second_piola = cauchy.congruence(&inverse).to_matrix() * self.jacobian;
        Sym::from_matrix(&(self.stretch.to_matrix() * second_piola))
    }

    /// Spatial tangent (see [`Material::tangent`](crate::Material::tangent)) from `∂T/∂E`.
    ///
    /// Each column follows a perturbation `d`: `δC = 2FᵀdF`, `δU` from `U·δU + δU·U = δC`,
    /// `δS` from `U·δS + δS·U = 2δT − δU·S − S·δU`, and `c:d = F·δS·Fᵀ/J`.
    pub fn spatial_tangent(&self, biot_stress: &Sym, modulus: &Tangent) -> Tangent {
        let second_piola = self.second_piola(biot_stress);
        Tangent::from_columns(|d| {
            let strain_rate = d.congruence(&self.deformation_gradient.transpose()) * 2.0;
            let stretch_rate = solve_lyapunov(&self.stretch, &strain_rate);
            self.truesdell(&second_piola, &stretch_rate, &modulus.apply(&stretch_rate))
        })
    }

    /// The same from the rate of `T` with the motion, given the rates of stretch and rotation.
    pub(crate) fn conjugate_tangent(
        &self,
        biot_stress: &Sym,
        rate: impl Fn(&Sym, &Matrix3<f64>) -> Sym,
    ) -> Tangent {
        let second_piola = self.second_piola(biot_stress);
        Tangent::from_columns(|d| {
            let (stretch_rate, rotation_rate) = self.rates(d);
            let stress_rate = rate(&stretch_rate, &rotation_rate);
            self.truesdell(&second_piola, &stretch_rate, &stress_rate)
        })
    }

    /// Solves `(tr U - U) w = k`, by elimination: positive definite.
    fn solve_pairs(&self, k: &Vector3<f64>) -> Vector3<f64> {
        let u = &self.stretch;
        let (a, b, c) = (u.yy() + u.zz(), u.xx() + u.zz(), u.xx() + u.yy());
        let (yz, xz, xy) = (-u.yz(), -u.xz(), -u.xy());
        let (first, second) = (xy / a, xz / a);
        let (b, yz, c) = (b - first * xy, yz - first * xz, c - second * xz);
        let (y, z) = (k.y - first * k.x, k.z - second * k.x);
        let third = yz / b;
        let z = (z - third * y) / (c - third * yz);
        let y = (y - yz * z) / b;
        Vector3::new((k.x - xy * y - xz * z) / a, y, z)
    }

    fn second_piola(&self, biot_stress: &Sym) -> Sym {
        solve_lyapunov(&self.stretch, &(*biot_stress * 2.0))
    }

    /// `F·δS·Fᵀ/J` for rates of `U` and `T`.
    fn truesdell(&self, second_piola: &Sym, stretch_rate: &Sym, stress_rate: &Sym) -> Sym {
        let coupling = stretch_rate.to_matrix() * second_piola.to_matrix();
        let right_side = *stress_rate * 2.0 - Sym::from_matrix(&coupling) * 2.0;
        solve_lyapunov(&self.stretch, &right_side).congruence(&self.deformation_gradient)
            / self.jacobian
    }

    /// Spatial tangent of a stress `T` that changes along one tensor, by a rate linear in `d`.
    pub(crate) fn spatial_rate(&self, along: &Sym, rate: impl Fn(&Sym) -> f64) -> Tangent {
        let spatial = self.cauchy(along);
        Tangent::from_columns(|d| spatial * rate(d))
    }
}
