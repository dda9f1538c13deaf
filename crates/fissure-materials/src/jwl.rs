//! Detonation products by the equation of state of Jones, Wilkins and Lee
//! [Rabczuk 2007, eq. 47, which prints it without its exponentials; Menikoff, LA-UR-15-29536].
//!
//! With `V = ρ₀/ρ = det F`, `E` the internal energy per initial volume,
//! `s(V) = A e^{−R₁V} + B e^{−R₂V}` and `S(V) = A/R₁ e^{−R₁V} + B/R₂ e^{−R₂V}`, `S' = −s`  (1):
//! `p = A (1 − ω/(R₁V)) e^{−R₁V} + B (1 − ω/(R₂V)) e^{−R₂V} + ω E/V = s + ω y/V`, `y = E − S`  (2).
//! Without heat `dE = −p dV` gives `dy/dV = −ω y/V`, so on an isentrope `y = c V^{−ω}`:
//! `p = s(V) + ω c V^{−1−ω}`, `E = S(V) + c V^{−ω}`  (3),
//! exact for steps of any size. `ρ₀ c² = −V² dp/dV`  (4). The stress is `−p 1`, never tension.
//!
//! Burning: the share `F` that is burnt carries the pressure, `σ = −F p 1`. It never falls and is
//! the largest of what the solver sets ([`External::burned`](crate::External), see
//! [`ProgramBurn`]) and `(1 − V)/(1 − V_CJ)`, which lets a compression wave burn its way  (5);
//! `V_CJ = 1 − P_CJ/(ρ₀ D²)` by the momentum across the front  (6). While it burns,
//! `dy/dV = −F ω y/V + (1 − F) s`; with `F̄` the mean of both ends and `r = (V₀/V₁)^{F̄ω}`,
//! `y₁ = r y₀ + (1 − F̄) (S₀ − S₁) (1 + r)/2`  (7): exact for `F = 0` and `F = 1`, of second order
//! between; a step too long for it, where `y` would be negative, is refused. Energies are `E`, the chemical one included, and no dissipation.
//!
//! The law sees `F`, not the heat of a solver's artificial viscosity: compressed by (5) alone a
//! point ends somewhat below the Chapman-Jouguet pressure (docs/laws/jwl.md has the figure).

mod burn;

use fissure_tensor::{Matrix3, Sym, Tangent};
use serde::{Deserialize, Serialize};

pub use burn::{Burn, ProgramBurn};

use crate::{Increment, Material, MaterialError, Response, Scale, check_parameter};

const NAME: &str = "JWL equation of state";

/// An explosive and its detonation products.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jwl {
    /// Initial mass density ρ₀, kg/m³; > 0.
    pub density: f64,
    /// A, Pa; > 0.
    pub a: f64,
    /// B, Pa; ≥ 0.
    pub b: f64,
    /// R₁; > 0.
    pub r1: f64,
    /// R₂; > 0.
    pub r2: f64,
    /// Grüneisen coefficient ω at large expansion; > 0.
    pub omega: f64,
    /// Chemical energy E₀, J per initial m³; above that of the cold curve, S(1).
    pub energy: f64,
    /// How it burns.
    pub burn: Burn,
}

/// History of an explosive. All zero at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JwlState {
    /// Share that is burnt, of an explosive that burns; never falls.
    pub burned: f64,
    /// Change of `y` since the start while it burns, of `c` of the isentrope once it has, over E₀.
    pub gain: f64,
}

/// Pressure (of the share that is burnt), energy and state at the end of a step.
struct Step {
    pressure: f64,
    /// Derivative of the pressure with `V`, Pa.
    slope: f64,
    energy: f64,
    state: JwlState,
}

impl Jwl {
    /// Trinitrotoluene: constants of UCRL-52997 (Dobratz and Crawford), of which table 6 of
    /// Rabczuk 2007 prints A ten times too small and E₀ ten times too large.
    pub const TNT: Self = Self {
        density: 1630.0,
        a: 371.2e9,
        b: 3.231e9,
        r1: 4.15,
        r2: 0.95,
        omega: 0.30,
        energy: 7.0e9,
        burn: Burn::Detonation {
            pressure: 21.0e9,
            speed: 6930.0,
        },
    };

    /// Composition B, from the same source; table 6 has the same two slips.
    pub const COMPOSITION_B: Self = Self {
        density: 1717.0,
        a: 524.2e9,
        b: 7.678e9,
        r1: 4.20,
        r2: 1.10,
        omega: 0.34,
        energy: 8.5e9,
        burn: Burn::Detonation {
            pressure: 29.5e9,
            speed: 7980.0,
        },
    };

    /// Pressure of the products, Pa, at a volume over the initial one and an energy per initial
    /// volume, J/m³ (eq. 2).
    pub fn pressure(&self, volume: f64, energy: f64) -> f64 {
        self.cold_pressure(volume) + self.omega * (energy - self.cold_energy(volume)) / volume
    }

    /// Pressure and energy on the isentrope through a volume and energy, at another volume (eq. 3).
    pub fn isentrope(&self, (volume, energy): (f64, f64), at: f64) -> (f64, f64) {
        let thermal = (energy - self.cold_energy(volume)) * (volume / at).powf(self.omega);
        let pressure = self.cold_pressure(at) + self.omega * thermal / at;
        (pressure, self.cold_energy(at) + thermal)
    }

    /// The same explosive with its energies and pressures scaled.
    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            a: self.a * scale.stiffness,
            b: self.b * scale.stiffness,
            energy: self.energy * scale.stiffness,
            ..*self
        }
    }

    /// `s(V)`.
    fn cold_pressure(&self, v: f64) -> f64 {
        self.a * (-self.r1 * v).exp() + self.b * (-self.r2 * v).exp()
    }

    /// `S(V)`.
    fn cold_energy(&self, v: f64) -> f64 {
        self.a / self.r1 * (-self.r1 * v).exp() + self.b / self.r2 * (-self.r2 * v).exp()
    }

    /// `s'(V)`.
    fn cold_slope(&self, v: f64) -> f64 {
        -self.a * self.r1 * (-self.r1 * v).exp() - self.b * self.r2 * (-self.r2 * v).exp()
    }

    /// `y` or `c` of a state, Pa.
    fn thermal(&self, state: &JwlState) -> f64 {
        self.energy - self.cold_energy(1.0) + state.gain * self.energy
    }

    fn gain(&self, thermal: f64) -> f64 {
        (thermal - (self.energy - self.cold_energy(1.0))) / self.energy
    }

    fn step(&self, increment: &Increment, old: &JwlState) -> Result<Step, MaterialError> {
        let volume = volume(&increment.f_new)?;
        let before = self.burn.burned(old);
        let (burned, rate) = self
            .burn
            .advanced(self.density, volume, increment, before)?;
        if before == 1.0 {
            return self.expanded(volume, old);
        }
        let start = self::volume(&increment.f_old)?;
        if volume == start && burned == before {
            // Nothing to integrate, and no round-off to add to the state.
            return self.burning(volume, self.thermal(old), (burned, rate), 0.0, *old);
        }
        let (mean, mean_rate) = (0.5 * (before + burned), 0.5 * rate);
        let ratio = (start / volume).powf(mean * self.omega);
        let ratio_slope = ratio * self.omega * ((start / volume).ln() * mean_rate - mean / volume);
        let released = self.cold_energy(start) - self.cold_energy(volume);
        let half = 0.5 * (1.0 + ratio);
        let old_thermal = self.thermal(old);
        let thermal = ratio * old_thermal + (1.0 - mean) * released * half;
        let slope = ratio_slope * (old_thermal + 0.5 * (1.0 - mean) * released)
            + ((1.0 - mean) * self.cold_pressure(volume) - mean_rate * released) * half;
        if !(thermal >= 0.0) {
            // The mean of a step this long that burns and compresses at once is below any gas.
            return Err(MaterialError::NoConvergence {
                law: NAME,
                iterations: 1,
                residual: thermal / self.energy,
            });
        }
        let kept = if burned == 1.0 {
            thermal * volume.powf(self.omega)
        } else {
            thermal
        };
        let state = JwlState {
            burned,
            gain: self.gain(kept),
        };
        self.burning(volume, thermal, (burned, rate), slope, state)
    }

    /// On the isentrope of the state (eq. 3).
    fn expanded(&self, volume: f64, old: &JwlState) -> Result<Step, MaterialError> {
        let thermal = self.thermal(old) * volume.powf(-self.omega);
        let slope = -self.omega * thermal / volume;
        self.burning(volume, thermal, (1.0, 0.0), slope, *old)
    }

    /// Pressure and its slope from `y` and its slope, with the burnt share and its slope.
    fn burning(
        &self,
        volume: f64,
        thermal: f64,
        (burned, rate): (f64, f64),
        thermal_slope: f64,
        state: JwlState,
    ) -> Result<Step, MaterialError> {
        let gas = self.cold_pressure(volume) + self.omega * thermal / volume;
        let gas_slope =
            self.cold_slope(volume) + self.omega * (thermal_slope - thermal / volume) / volume;
        let step = Step {
            pressure: (burned * gas).max(0.0),
            slope: if gas > 0.0 {
                burned * gas_slope + rate * gas
            } else {
                0.0
            },
            energy: self.cold_energy(volume) + thermal,
            state,
        };
        if gas.is_finite() && step.energy.is_finite() && step.slope.is_finite() {
            Ok(step)
        } else {
            Err(MaterialError::NotFinite { law: NAME })
        }
    }

    fn response(step: &Step) -> Response<JwlState> {
        Response {
            stress: Sym::IDENTITY * -step.pressure,
            state: step.state,
            stored: step.energy,
            dissipated: 0.0,
        }
    }

    /// From `τ = −V F p 1` and `dV = V tr d`: `c = −(p + V p') 1⊗1 + 2 p I`.
    fn tangent_of(volume: f64, step: &Step) -> Tangent {
        let volumetric = -(step.pressure + volume * step.slope);
        Tangent::isotropic(volumetric, step.pressure)
    }
}

fn volume(f: &Matrix3<f64>) -> Result<f64, MaterialError> {
    let determinant = f.determinant();
    if determinant > 0.0 && determinant.is_finite() && f.iter().all(|c| c.is_finite()) {
        Ok(determinant)
    } else {
        Err(MaterialError::Deformation { determinant })
    }
}

impl Material for Jwl {
    type State = JwlState;
    const NAMES: &'static [&'static str] = &["burned"];
    const STEP_ERROR: f64 = 0.0;

    fn check(&self) -> Result<(), MaterialError> {
        for (name, value) in [
            ("density", self.density),
            ("a", self.a),
            ("r1", self.r1),
            ("r2", self.r2),
            ("omega", self.omega),
        ] {
            check_parameter(NAME, name, value, value > 0.0, "finite and > 0")?;
        }
        check_parameter(NAME, "b", self.b, self.b >= 0.0, "finite and >= 0")?;
        let rule = "finite and above A/R1 exp(-R1) + B/R2 exp(-R2)";
        let above = self.energy > self.cold_energy(1.0);
        check_parameter(NAME, "energy", self.energy, above, rule)?;
        self.burn.check(self)
    }

    fn density(&self) -> f64 {
        self.density
    }

    /// Of sound in the products (eq. 4); of an explosive that has not burnt at least that of its
    /// detonation.
    fn wave_speed(&self, f: &Matrix3<f64>, state: &JwlState, scale: &Scale) -> f64 {
        let gas = self.scaled(scale);
        let (volume, burned) = (f.determinant(), self.burn.burned(state));
        let mut thermal = gas.thermal(state);
        if burned == 1.0 {
            thermal *= volume.powf(-self.omega);
        }
        let slope =
            gas.cold_slope(volume) - self.omega * (1.0 + self.omega) * thermal / (volume * volume);
        let sound = volume * (burned * (-slope).max(0.0) / self.density).sqrt();
        match self.burn {
            Burn::Detonation { speed, .. } if burned < 1.0 => {
                sound.max(speed * scale.stiffness.sqrt())
            }
            _ => sound,
        }
    }

    fn update(
        &self,
        increment: &Increment,
        old: &JwlState,
    ) -> Result<Response<JwlState>, MaterialError> {
        let gas = self.scaled(&increment.external.scale);
        Ok(Self::response(&gas.step(increment, old)?))
    }

    fn tangent(&self, increment: &Increment, old: &JwlState) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &JwlState,
    ) -> Result<(Response<JwlState>, Tangent), MaterialError> {
        let gas = self.scaled(&increment.external.scale);
        let step = gas.step(increment, old)?;
        let tangent = Self::tangent_of(increment.jacobian(), &step);
        Ok((Self::response(&step), tangent))
    }

    fn values(&self, state: &JwlState, out: &mut [f64]) {
        out[0] = self.burn.burned(state);
    }
}

#[cfg(test)]
mod tests;
