//! One law with a choice of small faults, each of which one property has to catch.

use fissure_materials::{
    Band, Crack, Cracking, Decohesive, DecohesiveState, Increment, Initiation, Material,
    MaterialError, Matrix3, Response, Scale, Sym, Tangent, Vector3,
};
use fissure_tensor::rotation;

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The state creeps by round-off in every step.
    CreepingState,
    /// A law with a preferred direction says it is isotropic.
    ClaimsIsotropy,
    /// An absolute pressure of 10 µPa.
    AbsolutePressure,
    /// The answer depends on the time step in the last digits.
    Time,
    /// What never falls is given with the wrong sign.
    FallingIrreversible,
    /// A crack says that it has less strength left than it carries.
    UnderstatedRatio,
    /// The opening is given for another width.
    WrongOpening,
    /// The direction of initiation is off by half a degree.
    TurnedNormal,
    /// The limit of the band is stated too large.
    WideLimit,
    /// The wave speed is that of shear waves.
    SlowWave,
    /// A crack starts only at 1.001 of the stated strength.
    LateOnset,
}

/// The elastic-decohesive law with a fault.
pub struct Faulty(pub Decohesive, pub Fault);

impl Faulty {
    fn has(&self, fault: Fault) -> bool {
        self.1 == fault
    }
}

impl Material for Faulty {
    type State = DecohesiveState;

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.0.check_band(band, scale)
    }

    fn isotropic(&self) -> bool {
        self.has(Fault::ClaimsIsotropy) || self.0.isotropic()
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &DecohesiveState, scale: &Scale) -> f64 {
        let factor = if self.has(Fault::SlowWave) { 0.6 } else { 1.0 };
        factor * self.0.wave_speed(f, state, scale)
    }

    fn update(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Response<DecohesiveState>, MaterialError> {
        let mut response = self.0.update(increment, old)?;
        match self.1 {
            Fault::CreepingState if response.state.softened > 0.0 => {
                response.state.softened *= 1.0 + 1e-15;
            }
            Fault::AbsolutePressure => response.stress += Sym::IDENTITY * 1e-5,
            Fault::Time => response.stress = response.stress * (1.0 + 1e-13 * increment.dt),
            _ => {}
        }
        Ok(response)
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Tangent, MaterialError> {
        self.0.tangent(increment, old)
    }
}

impl Cracking for Faulty {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.0.toughness(scale)
    }

    fn strength(&self, scale: &Scale) -> f64 {
        let factor = if self.has(Fault::LateOnset) {
            1.001
        } else {
            1.0
        };
        self.0.strength(scale) / factor
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.0.critical_opening(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        let factor = if self.has(Fault::WideLimit) {
            1.02
        } else {
            1.0
        };
        factor * self.0.band_limit(scale)
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        let mut initiation = self.0.initiation(stress, scale);
        if self.has(Fault::TurnedNormal) {
            let axis = initiation.normal.cross(&Vector3::new(0.3, 0.5, 0.8));
            initiation.normal = rotation(&axis, 0.5_f64.to_radians()) * initiation.normal;
        }
        initiation
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.0.failure_along(stress, normal, scale)
    }

    fn cracks(&self, state: &DecohesiveState) -> Vec<Crack> {
        let mut cracks = self.0.cracks(state);
        for crack in &mut cracks {
            match self.1 {
                Fault::UnderstatedRatio => crack.strength_ratio *= 1.0 - 1e-6,
                Fault::WrongOpening => crack.opening *= 0.999,
                _ => {}
            }
        }
        cracks
    }

    fn irreversible(&self, state: &DecohesiveState) -> Vec<f64> {
        let sign = if self.has(Fault::FallingIrreversible) {
            -1.0
        } else {
            1.0
        };
        let listed = self.0.irreversible(state);
        listed.into_iter().map(|value| sign * value).collect()
    }
}
