//! The history integral of the dynamic damage, advanced by one step at a time.
//!
//! `D_dyn(t) = ∫ Ḋ(τ) exp(−((t − τ)/ϑ(τ))^g) dτ` remembers every increment of damage with its own
//! time `ϑ` and its age. Here a few parcels stand for them, each of damage `A`, time `ϑ` and age
//! `ξ` in units of `ϑ`, so that `D_dyn = Σ A exp(−ξ^g)` and a step only adds `Δt/ϑ` to each `ξ`.
//! An increment that grows evenly over `δt` comes with the mean `H̄ = (1/x) ∫₀ˣ exp(−ξ^g) dξ`,
//! `x = δt/ϑ`, and hence the age at which `exp(−ξ^g)` has that value. Where there are too many, the
//! two most alike are joined so that their damage, what they contribute now and, for `g = 1`, what
//! they will contribute in all are kept: exact for `g = 1` and one rate of strain. A joint parcel
//! falls from `A` to 0 like any other, so `0 ≤ D_dyn ≤ D_st` and `D` never falls whatever is lost.

use serde::{Deserialize, Serialize};

use crate::{MaterialError, check_parameter};

/// Parcels of damage that one state remembers.
const PARCELS: usize = 6;
/// Bounds of the rate of strain over 1/s, of which a logarithm is taken.
const RATES: (f64, f64) = (1e-12, 1e12);

/// How damage lags behind the strain that does it. None of these values is published: they are to
/// be fitted to the strength over the rate of strain of the concrete at hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    /// Relaxation time at a rate of 1/s, ϑ₀, s; > 0.
    pub time: f64,
    /// c_t1, of the squared logarithm of the rate; finite.
    pub rate_curvature: f64,
    /// c_t2, minus the exponent of the rate; finite.
    pub rate_exponent: f64,
    /// g_h; > 0, and 1 for exponential relaxation.
    pub exponent: f64,
}

impl Relaxation {
    pub(super) fn check_for(&self, law: &'static str) -> Result<(), MaterialError> {
        let (time, exponent) = (self.time, self.exponent);
        check_parameter(law, "time", time, time > 0.0, "finite and > 0")?;
        check_parameter(law, "rate_curvature", self.rate_curvature, true, "finite")?;
        check_parameter(law, "rate_exponent", self.rate_exponent, true, "finite")?;
        let permitted = "in [0.1, 10]";
        let valid = (0.1..=10.0).contains(&exponent);
        check_parameter(law, "relaxation exponent", exponent, valid, permitted)
    }

    /// Relaxation time of eq. 5, s, and the derivative of its logarithm with that of the rate.
    pub(super) fn time_at(&self, rate: f64) -> (f64, f64) {
        // In this order NaN, of no rise in no time, is the lower bound.
        let logarithm = rate.max(RATES.0).min(RATES.1).ln();
        let power = (self.rate_curvature * logarithm - self.rate_exponent) * logarithm;
        let held = power.abs() > 600.0 || !(rate > RATES.0 && rate < RATES.1);
        let slope = 2.0 * self.rate_curvature * logarithm - self.rate_exponent;
        let time = self.time * power.clamp(-600.0, 600.0).exp();
        (time, if held { 0.0 } else { slope })
    }

    /// `H` at an age over its time.
    pub(super) fn remaining(&self, age: f64) -> f64 {
        (-self.power(age)).exp()
    }

    /// `ξ^g`.
    fn power(&self, age: f64) -> f64 {
        if self.exponent == 1.0 {
            age
        } else {
            age.powf(self.exponent)
        }
    }

    /// The age at which `H` is `remaining`.
    fn age_of(&self, remaining: f64) -> f64 {
        let power = -remaining.ln();
        if self.exponent == 1.0 {
            power
        } else {
            power.max(0.0).powf(1.0 / self.exponent)
        }
    }

    /// `H̄(x) = (1/x) ∫₀ˣ H`, and its derivative.
    ///
    /// With `u = x^g` and `a = 1/g` it is `e^{−u} Σ uⁿ/((a + 1) … (a + n))`, the series of the
    /// incomplete gamma function, whose terms are positive.
    pub(super) fn mean(&self, x: f64) -> (f64, f64) {
        const FAR: f64 = 40.0;
        let u = self.power(x);
        if u < 1e-8 {
            let lost = u / (self.exponent + 1.0);
            let slope = if x > 0.0 {
                -self.exponent * lost / x
            } else {
                0.0
            };
            return (1.0 - lost, slope);
        }
        let mean = if u > FAR {
            // Beyond, the integral has its full value to the last digit.
            let far = self.age_of((-FAR).exp());
            self.series(FAR) * (far / x)
        } else if self.exponent == 1.0 {
            -(-u).exp_m1() / u
        } else {
            self.series(u)
        };
        (mean, (self.remaining(x) - mean) / x)
    }

    fn series(&self, u: f64) -> f64 {
        let a = 1.0 / self.exponent;
        let (mut term, mut sum) = (1.0, 1.0);
        for n in 1..400 {
            term *= u / (a + f64::from(n));
            sum += term;
            if term <= f64::EPSILON * sum {
                break;
            }
        }
        (-u).exp() * sum
    }
}

/// Growth of the static damage in one step.
pub(super) struct Growth {
    /// By how much.
    pub damage: f64,
    /// Derivative of the static damage with the equivalent strain, at the end.
    pub slope: f64,
    /// Equivalent strain at the start of the step, where growth starts, and at its end.
    pub before: f64,
    pub onset: f64,
    pub now: f64,
    /// Length of the step, s.
    pub dt: f64,
}

impl Growth {
    /// Fraction of the step at which damage starts to grow, the strain rising evenly.
    pub fn start(&self) -> f64 {
        let rise = self.now - self.before;
        if rise > 0.0 {
            ((self.onset - self.before) / rise).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// Increments of damage of about one age and one relaxation time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Parcel {
    /// Damage when it was done; 0 for none.
    damage: f64,
    /// Relaxation time, s.
    time: f64,
    /// Age over that time.
    age: f64,
}

/// What is left of the increments of damage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct History {
    parcels: [Parcel; PARCELS],
}

impl History {
    /// Whether nothing is left to be felt.
    pub fn is_empty(&self) -> bool {
        self.parcels.iter().all(|parcel| parcel.damage == 0.0)
    }

    /// `D_dyn`.
    pub fn dynamic_damage(&self, relaxation: &Relaxation) -> f64 {
        let parcels = self.parcels.iter().filter(|parcel| parcel.damage > 0.0);
        parcels
            .map(|parcel| parcel.damage * relaxation.remaining(parcel.age))
            .sum()
    }

    /// Lets time pass.
    pub fn age(&mut self, relaxation: &Relaxation, dt: f64) {
        for parcel in &mut self.parcels {
            if parcel.damage > 0.0 {
                parcel.age += dt / parcel.time;
                if !(parcel.damage * relaxation.remaining(parcel.age) > 1e-18) {
                    *parcel = Parcel::default();
                }
            }
        }
    }

    /// Lets time pass while damage grows. Returns the derivative of the damage that is felt with
    /// the equivalent strain at the end of the step.
    pub fn advance(&mut self, relaxation: &Relaxation, growth: &Growth) -> f64 {
        self.age(relaxation, growth.dt);
        let rise = growth.now - growth.before;
        let (time, time_slope) = relaxation.time_at(rise / growth.dt);
        let start = growth.start();
        let x = growth.dt * (1.0 - start) / time;
        let (mean, mean_slope) = relaxation.mean(x);
        let mut x_slope = 0.0;
        if rise > 0.0 {
            // d(1 − start) and d ln ϑ; no division by a step of no length.
            x_slope = (growth.dt / time * start - x * time_slope) / rise;
        }
        self.add(
            relaxation,
            Parcel {
                damage: growth.damage,
                time,
                age: relaxation.age_of(mean),
            },
        );
        growth.slope * (1.0 - mean) - growth.damage * mean_slope * x_slope
    }

    fn add(&mut self, relaxation: &Relaxation, new: Parcel) {
        if !(new.damage * relaxation.remaining(new.age) > 1e-18) {
            return;
        }
        if let Some(free) = self.parcels.iter_mut().find(|p| p.damage == 0.0) {
            *free = new;
            return;
        }
        let mut all = [new; PARCELS + 1];
        all[..PARCELS].copy_from_slice(&self.parcels);
        let (keep, join) = most_alike(relaxation, &all);
        all[keep] = joined(relaxation, &all[keep], &all[join]);
        all[join] = all[PARCELS];
        self.parcels.copy_from_slice(&all[..PARCELS]);
    }
}

/// The two parcels whose joining changes the future least: small ones, of like times and, unless
/// relaxation is exponential and has no memory, of like ages. The first is the lower index.
fn most_alike(relaxation: &Relaxation, parcels: &[Parcel; PARCELS + 1]) -> (usize, usize) {
    let memory = (relaxation.exponent - 1.0).abs();
    let measure = parcels.map(|parcel| {
        let left = parcel.damage * relaxation.remaining(parcel.age);
        (left, parcel.time.ln(), memory * (parcel.age + 0.1).ln())
    });
    let mut best = (f64::INFINITY, (0, 1));
    for (i, a) in measure.iter().enumerate() {
        for (j, b) in measure.iter().enumerate().skip(i + 1) {
            let distance = (a.1 - b.1).powi(2) + (a.2 - b.2).powi(2);
            let cost = a.0 * b.0 / (a.0 + b.0) * distance;
            if cost < best.0 {
                best = (cost, (i, j));
            }
        }
    }
    best.1
}

/// One parcel for two.
fn joined(relaxation: &Relaxation, a: &Parcel, b: &Parcel) -> Parcel {
    let (left_a, left_b) = (
        a.damage * relaxation.remaining(a.age),
        b.damage * relaxation.remaining(b.age),
    );
    let (damage, left) = (a.damage + b.damage, left_a + left_b);
    Parcel {
        damage,
        time: (left_a * a.time + left_b * b.time) / left,
        age: relaxation.age_of((left / damage).min(1.0)),
    }
}
