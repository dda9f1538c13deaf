//! Isotropic hardening: the yield stress as a function of the equivalent plastic strain.
//!
//! The curves here do not fall: a local law whose yield stress falls localises in one cell, however
//! small, and dissipates nothing in the limit. Softening belongs to the laws that know their band. A
//! curve of one's own may fall, more slowly than `3μ`, to see when and how a law localises.

use std::fmt::Debug;

use crate::{MaterialError, check_parameter};

/// A yield stress `σ(α)` over the equivalent plastic strain `α ≥ 0`.
///
/// `slope` may jump; `stress` may not, and is positive.
pub trait Hardening: Debug + Send + Sync + 'static {
    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`] with the field, the value and the rule.
    fn check(&self) -> Result<(), MaterialError> {
        Ok(())
    }

    /// Yield stress, Pa; > 0.
    fn stress(&self, plastic_strain: f64) -> f64;

    /// Derivative of `stress`, Pa; > −3μ.
    fn slope(&self, plastic_strain: f64) -> f64;

    /// Plastic work `∫₀^α stress`, J/m³.
    fn work(&self, plastic_strain: f64) -> f64;
}

/// Hardening that is chosen when the program runs: `J2<Box<dyn Hardening>>` is one law of any.
impl<H: Hardening + ?Sized> Hardening for Box<H> {
    fn check(&self) -> Result<(), MaterialError> {
        (**self).check()
    }

    fn stress(&self, plastic_strain: f64) -> f64 {
        (**self).stress(plastic_strain)
    }

    fn slope(&self, plastic_strain: f64) -> f64 {
        (**self).slope(plastic_strain)
    }

    fn work(&self, plastic_strain: f64) -> f64 {
        (**self).work(plastic_strain)
    }
}

/// `σ = σ₀ + H α`; perfectly plastic with `H = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Initial yield stress σ₀, Pa; > 0.
    pub yield_stress: f64,
    /// Hardening modulus H, Pa; ≥ 0.
    pub modulus: f64,
}

impl Hardening for Linear {
    fn check(&self) -> Result<(), MaterialError> {
        let name = "linear hardening";
        check_positive(name, "yield_stress", self.yield_stress)?;
        check_not_negative(name, "modulus", self.modulus)
    }
    #[inline]
    fn stress(&self, plastic_strain: f64) -> f64 {
        self.yield_stress + self.modulus * plastic_strain
    }
    #[inline]
    fn slope(&self, _plastic_strain: f64) -> f64 {
        self.modulus
    }
    #[inline]
    fn work(&self, plastic_strain: f64) -> f64 {
        (self.yield_stress + 0.5 * self.modulus * plastic_strain) * plastic_strain
    }
}

/// `σ = σ₀ + Q (1 − e^{−bα}) + H α` (Voce 1955, with a linear part).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Voce {
    /// Initial yield stress σ₀, Pa; > 0.
    pub yield_stress: f64,
    /// Rise at saturation Q, Pa; ≥ 0.
    pub saturation: f64,
    /// Exponent b; > 0.
    pub rate: f64,
    /// Hardening modulus that remains H, Pa; ≥ 0.
    pub modulus: f64,
}

impl Hardening for Voce {
    fn check(&self) -> Result<(), MaterialError> {
        let name = "Voce hardening";
        check_positive(name, "yield_stress", self.yield_stress)?;
        check_not_negative(name, "saturation", self.saturation)?;
        check_positive(name, "rate", self.rate)?;
        check_not_negative(name, "modulus", self.modulus)
    }
    fn stress(&self, plastic_strain: f64) -> f64 {
        let saturated = -(-self.rate * plastic_strain).exp_m1();
        self.yield_stress + self.saturation * saturated + self.modulus * plastic_strain
    }
    fn slope(&self, plastic_strain: f64) -> f64 {
        self.saturation * self.rate * (-self.rate * plastic_strain).exp() + self.modulus
    }
    fn work(&self, plastic_strain: f64) -> f64 {
        let lag = (-self.rate * plastic_strain).exp_m1() / self.rate;
        (self.yield_stress + 0.5 * self.modulus * plastic_strain) * plastic_strain
            + self.saturation * (plastic_strain + lag)
    }
}

/// Straight lines between measured points; constant beyond the last.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Plastic strain, stress and work up to there, of each point.
    rows: Vec<[f64; 3]>,
}

impl Table {
    /// From pairs of equivalent plastic strain and yield stress (Pa).
    ///
    /// # Errors
    /// [`MaterialError::Parameter`] unless the first strain is 0, strains rise, stresses are
    /// positive and do not fall, and all are finite.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Result<Self, MaterialError> {
        let name = "hardening table";
        let mut rows: Vec<[f64; 3]> = Vec::new();
        for (strain, stress) in points {
            let Some(&[before, lower, work]) = rows.last() else {
                check_parameter(
                    name,
                    "strain",
                    strain,
                    strain == 0.0,
                    "0 at the first point",
                )?;
                check_positive(name, "stress", stress)?;
                rows.push([strain, stress, 0.0]);
                continue;
            };
            check_parameter(name, "strain", strain, strain > before, "finite and rising")?;
            check_parameter(
                name,
                "stress",
                stress,
                stress >= lower,
                "finite and not falling",
            )?;
            let work = work + 0.5 * (lower + stress) * (strain - before);
            rows.push([strain, stress, work]);
        }
        let count = rows.len() as f64;
        check_parameter(name, "points", count, count >= 1.0, "at least one")?;
        Ok(Self { rows })
    }

    /// The last point not beyond a plastic strain, and the slope after it.
    fn row(&self, plastic_strain: f64) -> ([f64; 3], f64) {
        let next = self.rows.partition_point(|row| row[0] <= plastic_strain);
        // `new` refuses an empty table, whose first strain is 0.
        let row = self.rows[next.max(1) - 1];
        let slope = self
            .rows
            .get(next)
            .map_or(0.0, |after| (after[1] - row[1]) / (after[0] - row[0]));
        (row, slope)
    }
}

impl Hardening for Table {
    fn stress(&self, plastic_strain: f64) -> f64 {
        let ([start, stress, _], slope) = self.row(plastic_strain);
        stress + slope * (plastic_strain - start)
    }
    fn slope(&self, plastic_strain: f64) -> f64 {
        self.row(plastic_strain).1
    }
    fn work(&self, plastic_strain: f64) -> f64 {
        let ([start, stress, work], slope) = self.row(plastic_strain);
        let beyond = plastic_strain - start;
        work + (stress + 0.5 * slope * beyond) * beyond
    }
}

fn check_positive(
    law: &'static str,
    parameter: &'static str,
    value: f64,
) -> Result<(), MaterialError> {
    check_parameter(law, parameter, value, value > 0.0, "finite and > 0")
}

fn check_not_negative(
    law: &'static str,
    parameter: &'static str,
    value: f64,
) -> Result<(), MaterialError> {
    check_parameter(law, parameter, value, value >= 0.0, "finite and >= 0")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curves() -> Result<Vec<Box<dyn Hardening>>, MaterialError> {
        let table = Table::new([(0.0, 250e6), (0.02, 300e6), (0.1, 420e6), (0.3, 500e6)])?;
        Ok(vec![
            Box::new(Linear {
                yield_stress: 250e6,
                modulus: 1e9,
            }),
            Box::new(Voce {
                yield_stress: 250e6,
                saturation: 150e6,
                rate: 16.0,
                modulus: 0.2e9,
            }),
            Box::new(table),
        ])
    }

    /// Slope and work are derivative and integral of the stress.
    #[test]
    fn slope_and_work_belong_to_the_stress() -> Result<(), MaterialError> {
        for curve in curves()? {
            for strain in [1e-3, 0.017, 0.05, 0.2, 0.7] {
                let h = 1e-4 * strain;
                let slope = (curve.stress(strain + h) - curve.stress(strain - h)) / (2.0 * h);
                let gap = (slope - curve.slope(strain)).abs();
                assert!(
                    gap <= 1e-6 * curve.slope(0.0),
                    "{curve:?} at {strain}: {gap:e}"
                );
                let stress = (curve.work(strain + h) - curve.work(strain - h)) / (2.0 * h);
                assert!(
                    (stress / curve.stress(strain) - 1.0).abs() < 1e-7,
                    "{curve:?}"
                );
            }
            assert_eq!(curve.work(0.0), 0.0);
        }
        Ok(())
    }

    #[test]
    fn a_table_refuses_what_is_no_hardening() {
        let refused = |points: &[(f64, f64)]| Table::new(points.iter().copied()).is_err();
        assert!(refused(&[]));
        assert!(refused(&[(0.1, 1e6)]), "does not start at 0");
        assert!(refused(&[(0.0, 0.0)]), "no strength");
        assert!(refused(&[(0.0, 2e6), (0.1, 1e6)]), "softens");
        assert!(
            refused(&[(0.0, 1e6), (0.0, 2e6)]),
            "two stresses at one strain"
        );
        assert!(refused(&[(0.0, 1e6), (f64::NAN, 2e6)]));
        assert!(refused(&[(0.0, 1e6), (0.1, f64::INFINITY)]));
    }
}
