//! A law as a user would write it, with nothing but what the library makes public (see docs/own-law.md).

use fissure::prelude::*;

/// `ψ = μ/2 (tr C − 3) − μ (J − 1) + λ/2 (J − 1)²`, so that `σ = (μ b + J (λ (J − 1) − μ) 1)/J`; with `EIGHTS` it
/// answers for eight points at once too.
#[derive(Clone, Copy, Debug)]
pub struct OwnLaw<const EIGHTS: bool> {
    /// kg/m³.
    pub density: f64,
    /// Pa.
    pub lambda: f64,
    /// Pa.
    pub shear: f64,
}

impl<const EIGHTS: bool> OwnLaw<EIGHTS> {
    /// Determinant, stress, stored energy and wave speed at a deformation gradient, row by row, with this factor on both
    /// moduli.
    #[inline(always)]
    fn answer(
        &self,
        [xx, xy, xz, yx, yy, yz, zx, zy, zz]: [f64; 9],
        stiffness: f64,
    ) -> (f64, Sym, f64, f64) {
        let (lambda, shear) = (self.lambda * stiffness, self.shear * stiffness);
        let jacobian =
            xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx);
        let left = [
            xx * xx + xy * xy + xz * xz,
            yx * yx + yy * yy + yz * yz,
            zx * zx + zy * zy + zz * zz,
        ];
        let root = std::f64::consts::SQRT_2;
        let across = [
            root * (yx * zx + yy * zy + yz * zz),
            root * (xx * zx + xy * zy + xz * zz),
            root * (xx * yx + xy * yy + xz * yz),
        ];
        let (inverse, swelling) = (1.0 / jacobian, jacobian - 1.0);
        let pressure = jacobian * (lambda * swelling - shear);
        let normal = |b: f64| (shear * b + pressure) * inverse;
        let shift = shear * inverse;
        let mandel = [
            normal(left[0]),
            normal(left[1]),
            normal(left[2]),
            shift * across[0],
            shift * across[1],
            shift * across[2],
        ];
        let square = left[0] + left[1] + left[2];
        let stored = 0.5 * shear * (square - 3.0) + swelling * (0.5 * lambda * swelling - shear);
        // From above: the acoustic tensor is μ n·b·n 1 + λ J² n⊗n, and n·b·n is at most tr b.
        let speed = ((lambda * jacobian * jacobian + shear * square) / self.density).sqrt();
        (jacobian, Sym { mandel }, stored, speed)
    }
}

impl<const EIGHTS: bool> Material for OwnLaw<EIGHTS> {
    type State = ();
    const STRESS_FROM_GRADIENT: bool = true;

    fn density(&self) -> f64 {
        self.density
    }

    #[inline(always)]
    fn wave_speed(&self, f: &Matrix3<f64>, _: &(), scale: &Scale) -> f64 {
        self.answer(rows(f), scale.stiffness).3
    }

    #[inline(always)]
    fn update(&self, step: &Increment, _: &()) -> Result<Response<()>, MaterialError> {
        let stiffness = step.external.scale.stiffness;
        let (determinant, stress, stored, _) = self.answer(rows(&step.f_new), stiffness);
        if !(determinant > 0.0 && determinant < f64::INFINITY) {
            return Err(MaterialError::Deformation { determinant });
        }
        Ok(Response {
            stress,
            state: (),
            stored,
            dissipated: 0.0,
        })
    }

    #[inline(always)]
    fn update_eight(&self, points: &EightPoints) -> Option<EightResponses> {
        if !EIGHTS {
            return None;
        }
        let mut responses = EightResponses::default();
        let mut all_sound = true;
        for place in 0..EIGHT {
            let stiffness = points.stiffness[place];
            let (determinant, stress, stored, speed) =
                self.answer(points.gradient(place), stiffness);
            all_sound &= (determinant > 0.0) & (determinant < f64::INFINITY);
            responses.set(place, &stress, stored, speed);
        }
        all_sound.then_some(responses)
    }
}

#[inline(always)]
fn rows(f: &Matrix3<f64>) -> [f64; 9] {
    [
        f.m11, f.m12, f.m13, f.m21, f.m22, f.m23, f.m31, f.m32, f.m33,
    ]
}
