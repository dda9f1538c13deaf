//! A law as a user would write it, with nothing but what the library makes public (see docs/own-law.md).

use fissure::prelude::*;

/// `ψ = μ/2 (tr C − 3) − μ (J − 1) + λ/2 (J − 1)²`, so that `σ = (μ b + J (λ (J − 1) − μ) 1)/J`.
#[derive(Clone, Copy, Debug)]
pub struct OwnLaw {
    /// kg/m³.
    pub density: f64,
    /// Pa.
    pub lambda: f64,
    /// Pa.
    pub shear: f64,
}

impl Formula for OwnLaw {
    fn density(&self) -> f64 {
        self.density
    }

    #[inline(always)]
    fn answer(
        &self,
        [xx, xy, xz, yx, yy, yz, zx, zy, zz]: [f64; 9],
        stiffness: f64,
    ) -> FormulaAnswer {
        let (lambda, shear) = (self.lambda * stiffness, self.shear * stiffness);
        let jacobian =
            xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx);
        let left = [
            xx * xx + xy * xy + xz * xz,
            yx * yx + yy * yy + yz * yz,
            zx * zx + zy * zy + zz * zz,
        ];
        let across = [
            yx * zx + yy * zy + yz * zz,
            xx * zx + xy * zy + xz * zz,
            xx * yx + xy * yy + xz * yz,
        ];
        let (inverse, swelling) = (1.0 / jacobian, jacobian - 1.0);
        let pressure = jacobian * (lambda * swelling - shear);
        let (isotropic, shift) = (pressure * inverse, shear * inverse);
        let root = std::f64::consts::SQRT_2 * shift;
        let mandel = [
            shift * left[0] + isotropic,
            shift * left[1] + isotropic,
            shift * left[2] + isotropic,
            root * across[0],
            root * across[1],
            root * across[2],
        ];
        let square = left[0] + left[1] + left[2];
        FormulaAnswer {
            stress: Sym { mandel },
            stored: 0.5 * shear * (square - 3.0) + swelling * (0.5 * lambda * swelling - shear),
            // From above: the acoustic tensor is μ n·b·n 1 + λ J² n⊗n, and n·b·n is at most tr b.
            wave_speed: ((lambda * jacobian * jacobian + shear * square) / self.density).sqrt(),
        }
    }
}

/// A law without its answers by eights.
#[derive(Clone, Copy, Debug)]
pub struct OneByOne<M>(pub M);

impl<M: Material<State = ()>> Material for OneByOne<M> {
    type State = ();
    const STRESS_FROM_GRADIENT: bool = M::STRESS_FROM_GRADIENT;

    fn density(&self) -> f64 {
        self.0.density()
    }

    #[inline(always)]
    fn wave_speed(&self, f: &Matrix3<f64>, state: &(), scale: &Scale) -> f64 {
        self.0.wave_speed(f, state, scale)
    }

    #[inline(always)]
    fn update(&self, step: &Increment, old: &()) -> Result<Response<()>, MaterialError> {
        self.0.update(step, old)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_keeps_the_contract() {
        let law = OwnLaw {
            density: 1000.0,
            lambda: 6e5,
            shear: 4e5,
        };
        contract::check(&Hyperelastic(law)).unwrap();
    }
}
