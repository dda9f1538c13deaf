//! The damage surface in strain space and the equivalent strain it defines
//! [Rabczuk 2007, eq. 36].
//!
//! `c₁ J₂ + κ b − κ² = 0` with `b = c₂ √J₂ + c₃ e_max + c₄ I₁` has one positive root, and its
//! derivative is `dκ = (c₁ dJ₂ + κ db)/(2κ − b)`.

use fissure_tensor::Sym;

use crate::{MaterialError, check_parameter};

/// Weights of the invariants of the strain in the equivalent strain; dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DamageSurface {
    /// c₁ of `J₂`, the second invariant of the deviator; > 0.
    pub second: f64,
    /// c₂ of `√J₂`; ≥ 0.
    pub root: f64,
    /// c₃ of the largest principal strain; ≥ 0.
    pub largest: f64,
    /// c₄ of the trace `I₁`; ≥ 0.
    pub trace: f64,
}

impl DamageSurface {
    /// Concrete with ν = 0.22, the same in tables 2 and 5 of Rabczuk 2007: `κ` is the strain in
    /// uniaxial tension and 0.076 of it in uniaxial compression.
    pub const CONCRETE: Self = Self {
        second: 0.012_342_4,
        root: 0.025_166,
        largest: 0.782_058,
        trace: 0.346_384,
    };

    /// Equivalent strain κ.
    pub fn equivalent(&self, strain: &Sym) -> f64 {
        let j2 = strain.j2();
        let linear = self.root * j2.sqrt()
            + self.largest * strain.eigenvalues()[0]
            + self.trace * strain.trace();
        let root = (linear * linear + 4.0 * self.second * j2).sqrt();
        if linear >= 0.0 {
            0.5 * (linear + root)
        } else {
            // The same without the difference of near equals.
            2.0 * self.second * j2 / (root - linear)
        }
    }

    /// Derivative of κ with the strain; zero at none. Where the largest principal strain is not
    /// unique, that along one of its directions.
    pub(super) fn gradient(&self, strain: &Sym) -> Sym {
        let (j2, spectrum) = (strain.j2(), strain.spectrum());
        let kappa = self.equivalent(strain);
        let linear =
            self.root * j2.sqrt() + self.largest * spectrum.values[0] + self.trace * strain.trace();
        let denominator = 2.0 * kappa - linear;
        if !(denominator > 0.0) {
            return Sym::ZERO;
        }
        let deviator = strain.deviator();
        let mut linear_rate =
            Sym::dyad(&spectrum.vectors[0]) * self.largest + Sym::IDENTITY * self.trace;
        if j2 > 0.0 {
            linear_rate += deviator * (0.5 * self.root / j2.sqrt());
        }
        (deviator * self.second + linear_rate * kappa) / denominator
    }

    pub(super) fn check_for(&self, law: &'static str) -> Result<(), MaterialError> {
        let second = self.second;
        check_parameter(law, "second", second, second > 0.0, "finite and > 0")?;
        for (name, value) in [
            ("root", self.root),
            ("largest", self.largest),
            ("trace", self.trace),
        ] {
            check_parameter(law, name, value, value >= 0.0, "finite and >= 0")?;
        }
        Ok(())
    }
}
