//! The decohesion function of geological materials [Sanchez 2010, eqs 3.5.49-3.5.57].
//!
//! On a plane of normal `n`, with `τ_n = σ_nn`, `τ_s² = σ_nt² + σ_np²` and the softening `f_n`
//! (1 before failure, 0 after):
//! ```text
//! F_n  = τ̄_s² − tanh[ψ(1 + C_ψ ψ)]/C            (3.5.49)   ψ ≥ 0
//! F_n  = τ̄_s² − ψ/C                             (3.5.61)   ψ < 0
//! ψ    = −C B/(1 + C_s s)                        (3.5.50)
//! B    = τ̄_n (1 + C_n s) + s (1 + τ̄_n/P) − f_n  (3.5.51)
//! s    = f_n σ̄²                                 (3.5.52)
//! P    = 2 − tr σ/(3 τ_nf)                       (3.5.53)
//! σ̄²  = [σ_tt² + χ σ_tt σ_pp + σ_pp² + (2−χ) σ_tp²]/f'_c² = [S² − (2−χ) M]/f'_c²   (3.5.56)
//! χ    = (f'_c/f'_b)² − 2                        (3.5.55)   |χ| < 2 for f'_b > f'_c/2
//! τ̄_n = τ_n/τ_nf,  τ̄_s = τ_s/τ_sf,  C = (τ_sf/τ_sm)²                             (3.5.57)
//! ```
//! `S = σ_tt + σ_pp` and `M = σ_tt σ_pp − σ_tp²` are the invariants of the stress in the plane, so no
//! axes `t`, `p` have to be chosen.
//!
//! Where this departs from the page, and why:
//! - `ψ < 0` is beyond the surface. As printed the argument of `tanh` turns back at
//!   `ψ = −1/(2C_ψ)` and `F_n` becomes *negative* again at `ψ = −1/C_ψ`, a traction some seven times
//!   the strength. The document's own first-order form (3.5.61) continues `F_n` with the same value
//!   and slope at `ψ = 0`; the surface `F_n = 0` has `ψ ≥ 0` and is untouched.
//! - `P` has a zero at a mean tension of `2τ_nf`, which is past failure in some direction: it is held
//!   at 1/20 from below, so that everything stays finite there and `F > 0` says so.
//! - `∂F_n/∂σ_tp` carries a factor `f_n` that eq. 3.5.91 lacks (central differences, see the tests).

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::mohr::{OnMohr, largest};
use super::{FailureCriterion, canonical};
use crate::{Initiation, MaterialError, Scale, check_parameter};

const NAME: &str = "geological criterion";

/// Least `P`: a mean tension of 1.95 strengths.
const LEAST_PRESSURE_TERM: f64 = 0.05;

/// Failure in tension, shear and compression with the orientation of the failure plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geological {
    /// Tensile strength τ_nf, Pa; > 0.
    pub strength: f64,
    /// Shear strength without pressure τ_sf, Pa; > 0.
    pub shear_strength: f64,
    /// Shear strength under large pressure τ_sm, Pa; > `shear_strength`.
    pub confined_shear_strength: f64,
    /// Uniaxial compressive strength f'_c, Pa; > 0.
    pub compressive_strength: f64,
    /// Biaxial compressive strength f'_b, Pa; > f'_c/2. The source gives no value:
    /// [`Geological::biaxial`] is the usual one.
    pub biaxial_strength: f64,
    /// Coupling C_n of the normal traction, dimensionless; ≥ 0.
    pub normal_coupling: f64,
    /// Coupling C_s of the stress along the plane, dimensionless; ≥ 0.
    pub lateral_coupling: f64,
    /// Coupling C_ψ, dimensionless; ≥ 0.
    pub shape_coupling: f64,
}

/// What the decohesion function sees of a stress on a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnPlane {
    /// Normal traction τ_n, Pa.
    pub normal: f64,
    /// Shear traction squared τ_s², Pa².
    pub shear_squared: f64,
    /// `S = σ_tt + σ_pp`, Pa.
    pub lateral_sum: f64,
    /// `M = σ_tt σ_pp − σ_tp²`, Pa².
    pub lateral_determinant: f64,
}

/// The decohesion function and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Partials {
    /// F_n.
    pub value: f64,
    /// ∂F_n/∂τ_n, 1/Pa (3.5.88).
    pub normal: f64,
    /// ∂F_n/∂(τ_s²), 1/Pa²; `2 τ_t` times it is ∂F_n/∂τ_t (3.5.88).
    pub shear_squared: f64,
    /// ∂F_n/∂S, 1/Pa: with the next, eqs 3.5.89-3.5.91.
    pub lateral_sum: f64,
    /// ∂F_n/∂M, 1/Pa².
    pub lateral_determinant: f64,
    /// ∂F_n/∂f_n (3.5.92).
    pub softening: f64,
}

impl OnPlane {
    /// Of a stress, on the plane of this unit normal.
    #[inline]
    pub fn new(stress: &Sym, normal: &Vector3<f64>) -> Self {
        let traction = stress.traction(normal);
        let along = normal.dot(&traction);
        let shear = traction - normal * along;
        let lateral_sum = stress.trace() - along;
        // n·cof(σ)·n with cof(σ) = σ² − tr(σ) σ + I₂ 1 and |τ|² = n·σ²·n.
        let lateral_determinant = traction.norm_squared() - stress.trace() * along + stress.i2();
        Self {
            normal: along,
            shear_squared: shear.norm_squared(),
            lateral_sum,
            lateral_determinant,
        }
    }

    /// `∂S/∂σ` and `∂M/∂σ`, Pa.
    pub(crate) fn lateral_gradients(stress: &Sym, normal: &Vector3<f64>) -> [Sym; 2] {
        let plane = Matrix3::identity() - normal * normal.transpose();
        let lateral = stress.congruence(&plane);
        // In the plane ∂M/∂σ is the adjugate of the 2×2 block, S·1 − σ.
        let within = Sym::IDENTITY - Sym::dyad(normal);
        [within, within * lateral.trace() - lateral]
    }
}

impl Geological {
    /// The concrete of Sanchez 2010, table 5.1.
    pub const CONCRETE: Self = Self {
        strength: 2.7e6,
        shear_strength: 14.9e6,
        confined_shear_strength: 90e6,
        compressive_strength: 42.7e6,
        biaxial_strength: Self::biaxial(42.7e6),
        normal_coupling: 0.2,
        lateral_coupling: 0.1,
        shape_coupling: 5.0,
    };

    /// `1.16 f'_c`, the default biaxial strength (Kupfer, Hilsdorf and Rüsch, ACI J. 66, 1969).
    pub const fn biaxial(compressive_strength: f64) -> f64 {
        1.16 * compressive_strength
    }

    /// `χ` (3.5.55).
    pub fn chi(&self) -> f64 {
        (self.compressive_strength / self.biaxial_strength).powi(2) - 2.0
    }

    /// `C_f/m` (3.5.57).
    fn ratio(&self) -> f64 {
        (self.shear_strength / self.confined_shear_strength).powi(2)
    }

    /// `tanh[ψ(1 + C_ψ ψ)]/C` and its derivative with ψ over C; straight for ψ < 0.
    #[inline]
    fn capacity(&self, psi: f64) -> (f64, f64) {
        let c = self.ratio();
        if psi < 0.0 {
            return (psi / c, 1.0);
        }
        let tanh = (psi * (1.0 + self.shape_coupling * psi)).tanh();
        let slope = (1.0 + 2.0 * self.shape_coupling * psi) * (1.0 - tanh * tanh);
        (tanh / c, slope)
    }

    /// F_n for the softening `f_n` (1 before failure).
    #[inline]
    pub fn value(&self, plane: &OnPlane, softening: f64) -> f64 {
        self.partials(plane, softening).value
    }

    /// F_n with its derivatives.
    #[inline]
    pub fn partials(&self, plane: &OnPlane, softening: f64) -> Partials {
        self.evaluate(plane, softening, f64::NEG_INFINITY)
    }

    /// As [`partials`](Self::partials) with `f_n − s` held at zero from below: what drives the jump
    /// of a plane. Where the stress along a plane exceeds the compressive strength (axial splitting)
    /// `F_n` as printed asks for a *compressive* normal traction, against which the plane would
    /// open: energy out of nothing, since that stress enters `F_n` but does no work on the jump.
    /// Held, such a plane has lost its cohesion, and `τ·∂F_n/∂τ ≥ 0` on the surface.
    #[inline]
    pub fn flow_partials(&self, plane: &OnPlane, softening: f64) -> Partials {
        self.evaluate(plane, softening, 0.0)
    }

    /// F_n with its derivatives, and `f_n − s` held from below.
    #[inline]
    pub(crate) fn evaluate(
        &self,
        plane: &OnPlane,
        softening: f64,
        least_cohesion: f64,
    ) -> Partials {
        let (strength, f_c) = (self.strength, self.compressive_strength);
        let c = self.ratio();
        let spread = 2.0 - self.chi();
        let tau = plane.normal / strength;
        let lateral = plane.lateral_sum / f_c;
        let sigma_squared = lateral * lateral - spread * plane.lateral_determinant / (f_c * f_c);
        let s = softening * sigma_squared;
        let free = 2.0 - (plane.normal + plane.lateral_sum) / (3.0 * strength);
        let held = free.max(LEAST_PRESSURE_TERM);
        // B = τ̄_n (1 + s (C_n + 1/P)) − (f_n − s).
        let cohesion = (softening - s).max(least_cohesion);
        let cohesive = if softening - s >= least_cohesion {
            1.0
        } else {
            0.0
        };
        let b = tau * (1.0 + s * (self.normal_coupling + 1.0 / held)) - cohesion;
        let shrink = 1.0 / (1.0 + self.lateral_coupling * s);
        let (capacity, slope) = self.capacity(-c * b * shrink);
        // D_ψσ (3.5.74), D_σ̄ (3.5.76) and what P adds (3.5.77).
        let d_psi = slope * shrink;
        let d_sigma = cohesive + tau * (self.normal_coupling + 1.0 / held)
            - self.lateral_coupling * b * shrink;
        let pressure = if free > LEAST_PRESSURE_TERM {
            tau * s / (3.0 * held * held * strength)
        } else {
            0.0
        };
        let per_sigma_squared = d_psi * d_sigma * softening;
        let shear_squared = 1.0 / (self.shear_strength * self.shear_strength);
        Partials {
            value: plane.shear_squared * shear_squared - capacity,
            normal: d_psi * ((1.0 + s * (self.normal_coupling + 1.0 / held)) / strength + pressure),
            shear_squared,
            lateral_sum: d_psi * pressure + per_sigma_squared * 2.0 * lateral / f_c,
            lateral_determinant: -per_sigma_squared * spread / (f_c * f_c),
            softening: d_psi * (d_sigma * sigma_squared - cohesive),
        }
    }

    /// Change of `∂F_n/∂τ_n` of [`flow_partials`](Self::flow_partials), 1/Pa, with the stress on the plane (whose shear does
    /// not enter) and with the softening: eq. 3.5.88 differentiated once more.
    pub(crate) fn flow_normal_rate(
        &self,
        plane: &OnPlane,
        softening: f64,
        plane_rate: &OnPlane,
        softening_rate: f64,
    ) -> f64 {
        let (strength, f_c, c) = (self.strength, self.compressive_strength, self.ratio());
        let spread = (2.0 - self.chi()) / (f_c * f_c);
        let (tau, tau_rate) = (plane.normal / strength, plane_rate.normal / strength);
        let lateral = plane.lateral_sum / f_c;
        let sigma_squared = lateral * lateral - spread * plane.lateral_determinant;
        let sigma_squared_rate =
            2.0 * lateral * plane_rate.lateral_sum / f_c - spread * plane_rate.lateral_determinant;
        let s = softening * sigma_squared;
        let s_rate = softening_rate * sigma_squared + softening * sigma_squared_rate;
        let free = 2.0 - (plane.normal + plane.lateral_sum) / (3.0 * strength);
        let (held, held_rate, follows) = if free > LEAST_PRESSURE_TERM {
            let rate = -(plane_rate.normal + plane_rate.lateral_sum) / (3.0 * strength);
            (free, rate, 1.0)
        } else {
            (LEAST_PRESSURE_TERM, 0.0, 0.0)
        };
        let (cohesion, cohesion_rate) = if softening >= s {
            (softening - s, softening_rate - s_rate)
        } else {
            (0.0, 0.0)
        };
        let grip = self.normal_coupling + 1.0 / held;
        let grip_rate = -held_rate / (held * held);
        let gain_rate = s_rate * grip + s * grip_rate;
        let b = tau * (1.0 + s * grip) - cohesion;
        let b_rate = tau_rate * (1.0 + s * grip) + tau * gain_rate - cohesion_rate;
        let shrink = 1.0 / (1.0 + self.lateral_coupling * s);
        let shrink_rate = -self.lateral_coupling * shrink * shrink * s_rate;
        let psi = -c * b * shrink;
        let psi_rate = -c * (b_rate * shrink + b * shrink_rate);
        let (_, slope) = self.capacity(psi);
        let slope_rate = self.capacity_bend(psi) * psi_rate;
        let pressure = follows * tau * s / (3.0 * held * held);
        let pressure_rate = follows * (tau_rate * s + tau * s_rate) / (3.0 * held * held)
            - 2.0 * pressure * held_rate / held;
        let along = 1.0 + s * grip + pressure;
        ((slope_rate * shrink + slope * shrink_rate) * along
            + slope * shrink * (gain_rate + pressure_rate))
            / strength
    }

    /// Derivative of the slope of [`capacity`](Self::capacity) with ψ.
    fn capacity_bend(&self, psi: f64) -> f64 {
        if psi < 0.0 {
            return 0.0;
        }
        let tanh = (psi * (1.0 + self.shape_coupling * psi)).tanh();
        let steepness = 1.0 + 2.0 * self.shape_coupling * psi;
        (2.0 * self.shape_coupling - 2.0 * steepness * steepness * tanh) * (1.0 - tanh * tanh)
    }

    /// The normal traction at which a plane without shear starts to move, Pa: `B = 0`, cohesion held,
    /// for the stress along the plane and `P` as they are.
    pub(crate) fn tension(&self, plane: &OnPlane, softening: f64) -> f64 {
        let f_c = self.compressive_strength;
        let lateral = plane.lateral_sum / f_c;
        let spread = 2.0 - self.chi();
        let s = softening * (lateral * lateral - spread * plane.lateral_determinant / (f_c * f_c));
        let free = 2.0 - (plane.normal + plane.lateral_sum) / (3.0 * self.strength);
        let held = free.max(LEAST_PRESSURE_TERM);
        self.strength * (softening - s).max(0.0) / (1.0 + s * (self.normal_coupling + 1.0 / held))
    }

    /// ∂F_n/∂σ for a plane of this unit normal, 1/Pa.
    pub fn gradient(&self, stress: &Sym, normal: &Vector3<f64>, softening: f64) -> Sym {
        let partials = self.partials(&OnPlane::new(stress, normal), softening);
        Self::gradient_of(&partials, stress, normal)
    }

    /// ∂F_n/∂σ from the derivatives on a plane.
    pub(crate) fn gradient_of(partials: &Partials, stress: &Sym, normal: &Vector3<f64>) -> Sym {
        let traction = stress.traction(normal);
        let along = normal.dot(&traction);
        let shear = traction - normal * along;
        let [lateral_sum, lateral_determinant] = OnPlane::lateral_gradients(stress, normal);
        Sym::dyad(normal) * partials.normal
            + Sym::dyad_of(normal, &shear) * (2.0 * partials.shear_squared)
            + lateral_sum * partials.lateral_sum
            + lateral_determinant * partials.lateral_determinant
    }

    /// The direction in which the crack's faces part under associated flow, ∂F_n/∂τ, 1/Pa
    /// (3.5.64, 3.5.93).
    pub fn flow(&self, stress: &Sym, normal: &Vector3<f64>, softening: f64) -> Vector3<f64> {
        let partials = self.partials(&OnPlane::new(stress, normal), softening);
        let traction = stress.traction(normal);
        let along = normal.dot(&traction);
        normal * partials.normal + (traction - normal * along) * (2.0 * partials.shear_squared)
    }
}

impl FailureCriterion for Geological {
    fn check(&self) -> Result<(), MaterialError> {
        let positive =
            |field, value: f64| check_parameter(NAME, field, value, value > 0.0, "finite and > 0");
        positive("strength", self.strength)?;
        positive("shear_strength", self.shear_strength)?;
        positive("compressive_strength", self.compressive_strength)?;
        let confined = self.confined_shear_strength;
        let stronger = confined > self.shear_strength;
        let rule = "finite and > shear_strength";
        check_parameter(NAME, "confined_shear_strength", confined, stronger, rule)?;
        let biaxial = self.biaxial_strength;
        let definite = biaxial > 0.5 * self.compressive_strength;
        let rule = "finite and > compressive_strength/2";
        check_parameter(NAME, "biaxial_strength", biaxial, definite, rule)?;
        for (field, value) in [
            ("normal_coupling", self.normal_coupling),
            ("lateral_coupling", self.lateral_coupling),
            ("shape_coupling", self.shape_coupling),
        ] {
            check_parameter(NAME, field, value, value >= 0.0, "finite and >= 0")?;
        }
        Ok(())
    }

    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            strength: self.strength * scale.strength,
            shear_strength: self.shear_strength * scale.strength,
            confined_shear_strength: self.confined_shear_strength * scale.strength,
            compressive_strength: self.compressive_strength * scale.strength,
            biaxial_strength: self.biaxial_strength * scale.strength,
            ..*self
        }
    }

    fn along(&self, stress: &Sym, normal: &Vector3<f64>) -> f64 {
        self.value(&OnPlane::new(stress, normal), 1.0)
    }

    /// Each part at its worst: `τ_s² ≤ J₂`, `τ_n ≤ m + 2√(J₂/3)`, `σ̄² ≤ (1 + |χ|/2) |σ|²/f'_c²`.
    fn upper_bound(&self, stress: &Sym) -> f64 {
        let (mean, j2) = (stress.mean(), stress.j2());
        let tau = (mean + 2.0 * (j2 / 3.0).sqrt()) / self.strength;
        let size = (3.0 * mean * mean + 2.0 * j2) / self.compressive_strength.powi(2);
        let sigma_squared = (1.0 + 0.5 * self.chi().abs()) * size;
        let held = (2.0 - mean / self.strength).max(LEAST_PRESSURE_TERM);
        let growth = tau.max(0.0) * (self.normal_coupling + 1.0 / held);
        let b = tau + sigma_squared * (1.0 + growth) - 1.0;
        let shrunk = if b > 0.0 {
            b
        } else {
            b / (1.0 + self.lateral_coupling * sigma_squared)
        };
        j2 / (self.shear_strength * self.shear_strength) - self.capacity(-self.ratio() * shrunk).0
    }

    fn initiation(&self, stress: &Sym) -> Initiation {
        self.initiation_held(stress, f64::NEG_INFINITY)
    }
}

impl Geological {
    /// The largest `F_n` before softening, with `1 − s` held from below. It sees of a plane its normal and its squared
    /// traction `q` and `r`: `τ_s² = r − q²`, `S = tr σ − q`, `M = r − q tr σ + I₂`.
    pub(crate) fn initiation_held(&self, stress: &Sym, least_cohesion: f64) -> Initiation {
        let spectrum = stress.spectrum();
        let (trace, second) = (stress.trace(), stress.i2());
        let (value, squares) = largest(spectrum.values, |q, r| {
            let plane = OnPlane {
                normal: q,
                shear_squared: (r - q * q).max(0.0),
                lateral_sum: trace - q,
                lateral_determinant: r - q * trace + second,
            };
            let here = self.evaluate(&plane, 1.0, least_cohesion);
            OnMohr {
                value: here.value,
                normal: here.normal
                    - 2.0 * q * here.shear_squared
                    - here.lateral_sum
                    - trace * here.lateral_determinant,
                squared: here.shear_squared + here.lateral_determinant,
            }
        });
        let local = Vector3::from(squares.map(f64::sqrt));
        let [e, g, h] = spectrum.vectors;
        let (x, y, z) = (e * local.x, g * local.y, h * local.z);
        let normal = canonical([x + y + z, x - y + z, x + y - z, x - y - z]);
        Initiation { value, normal }
    }
}
