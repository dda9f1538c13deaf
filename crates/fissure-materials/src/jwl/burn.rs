//! How an explosive turns into its products.

use fissure_tensor::Vector3;

use super::{Jwl, JwlState, NAME};
use crate::{Increment, MaterialError, check_parameter};

/// Largest difference of the pressure at the Chapman-Jouguet state to what the equation of state
/// gives there, over that pressure.
const AGREEMENT: f64 = 0.05;

/// How an explosive burns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Burn {
    /// All of it is gas from the start, at the initial volume.
    Instant,
    /// Behind a detonation front, see eq. 5 at the top of the law.
    Detonation {
        /// Chapman-Jouguet pressure P_CJ, Pa; within 5 % of that of the equation of state.
        pressure: f64,
        /// Speed of detonation D, m/s; ρ₀D² > P_CJ.
        speed: f64,
    },
}

impl Burn {
    /// Share of an explosive in this state that is burnt.
    pub(super) fn burned(&self, state: &JwlState) -> f64 {
        match self {
            Self::Instant => 1.0,
            Self::Detonation { .. } => state.burned,
        }
    }

    /// `1 − V_CJ`: the momentum across the front is `P = ρ₀ D² (1 − V)`.
    fn compression(pressure: f64, speed: f64, density: f64) -> f64 {
        pressure / (density * speed * speed)
    }

    /// The burnt share at the end of a step, and its derivative with the volume.
    pub(super) fn advanced(
        &self,
        density: f64,
        volume: f64,
        increment: &Increment,
        before: f64,
    ) -> Result<(f64, f64), MaterialError> {
        let Self::Detonation { pressure, speed } = *self else {
            return Ok((1.0, 0.0));
        };
        let set = increment.external.burned;
        let within = (0.0..=1.0).contains(&set);
        check_parameter(NAME, "External::burned", set, within, "in [0, 1]")?;
        let given = before.max(set);
        let full = Self::compression(pressure, speed, density);
        let compressed = (1.0 - volume) / full;
        Ok(if compressed >= 1.0 {
            (1.0, 0.0)
        } else if compressed > given {
            (compressed, -1.0 / full)
        } else {
            (given, 0.0)
        })
    }

    pub(super) fn check(&self, law: &Jwl) -> Result<(), MaterialError> {
        let Self::Detonation { pressure, speed } = *self else {
            return Ok(());
        };
        check_parameter(NAME, "speed", speed, speed > 0.0, "finite and > 0")?;
        let compression = Self::compression(pressure, speed, law.density);
        let within = compression > 0.0 && compression < 1.0;
        let rule = "> 0 and below density x speed²";
        check_parameter(NAME, "pressure", pressure, within, rule)?;
        // Energy across the front: E − E₀ = P (1 − V)/2.
        let energy = law.energy + 0.5 * pressure * compression;
        let found = law.pressure(1.0 - compression, energy);
        let agrees = (found - pressure).abs() <= AGREEMENT * pressure;
        let rule = "within 5 % of the pressure of the constants at the Chapman-Jouguet state";
        check_parameter(NAME, "pressure", pressure, agrees, rule)
    }
}

/// A detonation that runs through an explosive at a fixed speed from where it is lit: what a
/// solver or user writes into [`External::burned`](crate::External) of each particle.
///
/// The share burnt grows over `width` behind the front, about 1.5 cells, so that the grid carries
/// the pressure rise.
///
/// ```
/// use fissure_materials::{ProgramBurn, Vector3};
/// let burn = ProgramBurn {
///     lit: vec![(Vector3::zeros(), 0.0)],
///     speed: 6930.0,
///     width: 1.5e-3,
/// };
/// // The front is 6.93 mm from the detonator after a microsecond.
/// assert_eq!(burn.burned(&Vector3::new(7e-3, 0.0, 0.0), 1e-6), 0.0);
/// assert_eq!(burn.burned(&Vector3::new(5e-3, 0.0, 0.0), 1e-6), 1.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramBurn {
    /// Detonators: position in the reference configuration, m, and time of lighting, s.
    pub lit: Vec<(Vector3<f64>, f64)>,
    /// Speed of detonation, m/s; > 0.
    pub speed: f64,
    /// Width over which the share rises behind the front, m; > 0.
    pub width: f64,
}

impl ProgramBurn {
    /// Refuses a speed or width that is not positive, and detonators that are not finite.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`].
    pub fn check(&self) -> Result<(), MaterialError> {
        let name = "program burn";
        let (speed, width) = (self.speed, self.width);
        check_parameter(name, "speed", speed, speed > 0.0, "finite and > 0")?;
        check_parameter(name, "width", width, width > 0.0, "finite and > 0")?;
        for (position, time) in &self.lit {
            let distance = position.norm();
            check_parameter(name, "lit position", distance, true, "finite")?;
            check_parameter(name, "lit time", *time, true, "finite")?;
        }
        Ok(())
    }

    /// Time at which the front of the nearest detonator comes to a point, s; infinite without any.
    pub fn arrival(&self, position: &Vector3<f64>) -> f64 {
        let arrivals = self.lit.iter();
        arrivals
            .map(|(detonator, time)| time + (position - detonator).norm() / self.speed)
            .fold(f64::INFINITY, f64::min)
    }

    /// Share burnt at a point of the reference configuration (m) and time (s), 0 to 1:
    /// `(t − t_arrival) D/width`.
    pub fn burned(&self, position: &Vector3<f64>, time: f64) -> f64 {
        let behind = (time - self.arrival(position)) * self.speed;
        (behind / self.width).clamp(0.0, 1.0)
    }
}
