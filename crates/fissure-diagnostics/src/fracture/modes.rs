//! What a body has spent on failing, by mode.

use fissure_scene::Scene;

use crate::MeasureError;
use crate::error::check_positive;

/// `Σ V_p g_p` over a body: the integral of a value of its law (one of its names, per reference
/// volume) over the reference volume; of an energy per volume, J/m³, an energy, J.
///
/// # Errors
/// [`MeasureError::UnknownBody`] or [`MeasureError::UnknownValue`].
pub fn volume_integral<const D: usize>(
    scene: &Scene<D>,
    body: &str,
    value: &str,
) -> Result<f64, MeasureError> {
    let name = body;
    let body = scene.body(name).ok_or_else(|| MeasureError::UnknownBody {
        name: name.to_owned(),
    })?;
    let values = body
        .value(value)
        .ok_or_else(|| MeasureError::UnknownValue {
            body: name.to_owned(),
            value: value.to_owned(),
            present: body.law().names(),
        })?;
    let pairs = body.particles().volume.iter().zip(values);
    Ok(pairs.map(|(volume, value)| volume * value).sum())
}

/// Energy that cracks of a damage law have dissipated, by mode, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FractureEnergy {
    /// By opening.
    pub opening: f64,
    /// By sliding.
    pub shear: f64,
    /// What was left when a crack failed in mixed mode, of no mode in particular.
    pub left_over: f64,
}

impl FractureEnergy {
    /// Of a body whose law names its `opening_energy`, `shear_energy` and `left_over_energy` per crack
    /// area, as `AnisotropicDamage` does. `width` (m) is the band of the cracks, so that a particle
    /// holds a crack area of `V_p/width`. The law names them for its own toughness: where a scale
    /// changes that, they are those of the unscaled one.
    ///
    /// # Errors
    /// As [`volume_integral`]; [`MeasureError::Parameter`] if the width is not positive and finite.
    pub fn of<const D: usize>(
        scene: &Scene<D>,
        body: &str,
        width: f64,
    ) -> Result<Self, MeasureError> {
        check_positive("width of the band", width)?;
        let spent = |value| Ok(volume_integral(scene, body, value)? / width);
        Ok(Self {
            opening: spent("opening_energy")?,
            shear: spent("shear_energy")?,
            left_over: spent("left_over_energy")?,
        })
    }

    /// Of all modes, J.
    pub fn total(&self) -> f64 {
        self.opening + self.shear + self.left_over
    }
}
