//! A coarse band made possible by a lower strength [Bažant and Oh 1983; Nairn 2017, eq. 36].
//!
//! A material point whose band `L` is over the limit `ηCG/σ²` would snap back: it stores more energy
//! when it starts to crack than its share of the crack can dissipate. Laws refuse such a band.
//! Crack-band theory instead keeps the toughness and lowers the strength to what the band allows,
//!
//! ```text
//! σ' = σ √(r L_max/L),   r = 0.99                                            (1)
//! ```
//! so that the limit of the lowered law is just over the band and its stress falls almost
//! vertically. Loads then depend on the mesh, like those of linear fracture mechanics with one
//! element at the tip; the energy per crack area does not. Wrap a law in [`LoweredStrength`] to
//! choose this: nothing lowers a strength unasked.
//!
//! The limit is that of [`Material::check_band`]: for a law that finds its crack's direction, of
//! the widest band over all directions. Wrap [`PlaneStress`](crate::PlaneStress) rather than be
//! wrapped by it, so that the narrower limit of plane stress counts.

use std::fmt;

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};
use serde::{Deserialize, Serialize};

use crate::wrapping::{hand_on_cracking, hand_on_material};
use crate::{Crack, Cracking, Increment, Initiation, Material, MaterialError, Response, Scale};

/// Band over limit at which a law with a lowered strength works, `r` of equation (1): 1 is the
/// vertical drop, and conditioning is 1/(1 − r).
const FRACTION: f64 = 0.99;

/// The law inside, with its strength lowered where the band is over the limit.
///
/// [`notice`](Self::notice) says whether and by how much, before a run; the state's
/// [`factor`](LoweredStrengthState::factor) says it of a cracked point. [`Cracking::strength`] and
/// [`Cracking::initiation`] are of the law inside, since they know no band; the strength ratio of a
/// [`Crack`] is over that strength, so that it starts at the factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoweredStrength<M>(pub M);

/// History of a law whose strength may be lowered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LoweredStrengthState<S> {
    /// History of the law inside.
    pub inner: S,
    /// Factor on the strength, kept from when the history began; 0 while there is none.
    pub factor: f64,
}

/// By how much a strength is lowered, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lowered {
    /// The band, m.
    pub width: f64,
    /// Largest band with the full strength, m.
    pub limit: f64,
    /// Factor on the strength; in (0, 1).
    pub factor: f64,
}

impl fmt::Display for Lowered {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "the band of {} m is over the limit of {} m: the strength is lowered to {:.4} of it, \
             and loads depend on the mesh",
            self.width, self.limit, self.factor
        )
    }
}

impl<M: Material> LoweredStrength<M> {
    /// What happens to the strength over this band; `None` if nothing.
    ///
    /// # Errors
    /// What the law inside refuses for another reason than a wide band.
    pub fn notice(&self, band: &Band, scale: &Scale) -> Result<Option<Lowered>, MaterialError> {
        let (width, limit) = match self.0.check_band(band, scale) {
            Ok(()) => return Ok(None),
            Err(MaterialError::Band { width, limit, .. })
                if width > limit && width.is_finite() && limit > 0.0 =>
            {
                (width, limit)
            }
            Err(other) => return Err(other),
        };
        let factor = (FRACTION * limit / width).sqrt();
        // Holds where the limit falls with the square of the strength, as it does in all our laws.
        self.0.check_band(band, &lowered(scale, factor))?;
        Ok(Some(Lowered {
            width,
            limit,
            factor,
        }))
    }

    fn factor(&self, band: &Band, scale: &Scale) -> Result<f64, MaterialError> {
        Ok(self.notice(band, scale)?.map_or(1.0, |it| it.factor))
    }

    /// The increment that the law inside sees, and the factor in force.
    fn inner_increment(
        &self,
        increment: &Increment,
        old: &LoweredStrengthState<M::State>,
    ) -> Result<(Increment, f64), MaterialError> {
        let factor = if old.factor > 0.0 {
            old.factor
        } else {
            self.factor(&increment.band, &increment.external.scale)?
        };
        let mut inner = *increment;
        inner.external.scale = lowered(&increment.external.scale, factor);
        Ok((inner, factor))
    }

    fn response(
        &self,
        inner: Response<M::State>,
        factor: f64,
    ) -> Response<LoweredStrengthState<M::State>> {
        let begun = self.0.has_history(&inner.state);
        Response {
            stress: inner.stress,
            state: LoweredStrengthState {
                inner: inner.state,
                factor: if begun { factor } else { 0.0 },
            },
            stored: inner.stored,
            dissipated: inner.dissipated,
        }
    }
}

fn lowered(scale: &Scale, factor: f64) -> Scale {
    Scale {
        strength: scale.strength * factor,
        ..*scale
    }
}

impl<M: Material> Material for LoweredStrength<M> {
    type State = LoweredStrengthState<M::State>;
    hand_on_material!(0);

    const STEP_ERROR: f64 = M::STEP_ERROR;
    const STEP_ERROR_IN_PLANE_STRESS: f64 = M::STEP_ERROR_IN_PLANE_STRESS;
    const PLANE: bool = M::PLANE;

    fn check(&self) -> Result<(), MaterialError> {
        self.0.check()
    }

    /// Refuses what the law inside refuses for another reason than a wide band.
    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.factor(band, scale).map(|_| ())
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64 {
        self.0.wave_speed(f, &state.inner, scale)
    }

    fn initial(&self) -> Self::State {
        LoweredStrengthState {
            inner: self.0.initial(),
            factor: 0.0,
        }
    }

    fn has_history(&self, state: &Self::State) -> bool {
        self.0.has_history(&state.inner)
    }

    fn without_history(&self, f: &Matrix3<f64>) -> Self::State {
        LoweredStrengthState {
            inner: self.0.without_history(f),
            factor: 0.0,
        }
    }

    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        let (inner, factor) = self.inner_increment(increment, old)?;
        Ok(self.response(self.0.update(&inner, &old.inner)?, factor))
    }

    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        let (inner, _) = self.inner_increment(increment, old)?;
        self.0.tangent(&inner, &old.inner)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<(Response<Self::State>, Tangent), MaterialError> {
        let (inner, factor) = self.inner_increment(increment, old)?;
        let (response, tangent) = self.0.update_with_tangent(&inner, &old.inner)?;
        Ok((self.response(response, factor), tangent))
    }

    fn out_of_plane_stretch(&self, state: &Self::State) -> Option<f64> {
        self.0.out_of_plane_stretch(&state.inner)
    }
}

impl<M: Cracking> Cracking for LoweredStrength<M> {
    hand_on_cracking!(0);

    /// Of the full strength; a lowered one opens further, by 1 over the factor.
    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.0.critical_opening(scale)
    }

    /// None: a wider band has a lower strength.
    fn band_limit(&self, _scale: &Scale) -> f64 {
        f64::INFINITY
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.0.failure_along(stress, normal, scale)
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.0.initiation(stress, scale)
    }

    fn cracks(&self, state: &Self::State) -> Vec<Crack> {
        let mut cracks = self.0.cracks(&state.inner);
        for crack in &mut cracks {
            crack.strength_ratio *= state.factor;
        }
        cracks
    }
}

#[cfg(test)]
mod tests;
