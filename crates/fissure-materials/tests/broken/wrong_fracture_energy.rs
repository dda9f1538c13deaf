//! States one fracture energy and dissipates another.

use fissure_materials::{
    Band, Crack, Cracking, Decohesive, DecohesiveState, Increment, Initiation, Material,
    MaterialError, Matrix3, Response, Scale, Sym, Tangent,
};

/// Softens over a band one per cent narrower than it was given, as a wrong element size would.
pub struct WrongFractureEnergy(pub Decohesive);

impl WrongFractureEnergy {
    fn narrowed(increment: &Increment) -> Increment {
        let band = increment.band.scaled(0.99);
        Increment { band, ..*increment }
    }
}

impl Material for WrongFractureEnergy {
    type State = DecohesiveState;

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.0.check_band(band, scale)
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &DecohesiveState, scale: &Scale) -> f64 {
        self.0.wave_speed(f, state, scale)
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    fn update(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Response<DecohesiveState>, MaterialError> {
        self.0.update(&Self::narrowed(increment), old)
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Tangent, MaterialError> {
        self.0.tangent(&Self::narrowed(increment), old)
    }
}

impl Cracking for WrongFractureEnergy {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.0.toughness(scale)
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.0.strength(scale)
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.0.critical_opening(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.0.band_limit(scale)
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.0.initiation(stress, scale)
    }

    fn cracks(&self, state: &DecohesiveState) -> Vec<Crack> {
        let mut cracks = self.0.cracks(state);
        for crack in &mut cracks {
            crack.width /= 0.99;
        }
        cracks
    }

    fn irreversible(&self, state: &DecohesiveState) -> Vec<f64> {
        self.0.irreversible(state)
    }
}
