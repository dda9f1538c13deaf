//! How large the failed part of a body is.

use fissure_scene::{Kinematics, Scene};

use crate::MeasureError;
use crate::error::check_positive;

/// The particles of a body at which a value of the law has reached a limit, in the reference
/// placement: what an open crack has stretched by now is not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FailedZone {
    /// Number of particles.
    pub number: usize,
    /// Σ V_p, reference volume, m³; in axisymmetry that of the full 2π.
    pub volume: f64,
    /// The same as an area in two dimensions (in axisymmetry of the meridian section), m², or a
    /// volume in three, m³.
    pub measure: f64,
}

impl FailedZone {
    /// The zone of a body where `value`, one of its law's names, is at least `limit` (in the
    /// value's unit): `FailedZone::of(&scene, "bar", "opening", u0)`. NaN is below every limit.
    ///
    /// # Errors
    /// [`MeasureError::UnknownBody`], [`MeasureError::UnknownValue`], and
    /// [`MeasureError::Parameter`] if the limit is NaN.
    pub fn of<const D: usize>(
        scene: &Scene<D>,
        body: &str,
        value: &str,
        limit: f64,
    ) -> Result<Self, MeasureError> {
        if limit.is_nan() {
            return Err(MeasureError::Parameter {
                parameter: "limit of a failed zone",
                value: limit,
                permitted: "a number",
            });
        }
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
        let (particles, kinematics) = (body.particles(), scene.kinematics());
        let mut zone = Self::default();
        for (i, value) in values.into_iter().enumerate() {
            if value >= limit {
                // F₃₃ is the hoop stretch: present over reference radius.
                let hoop = match kinematics {
                    Kinematics::Axisymmetric => particles.motion.deformation_gradient[i].m33,
                    _ => 1.0,
                };
                let radius = particles.motion.position[i][0] / hoop;
                zone.number += 1;
                zone.volume += particles.volume[i];
                zone.measure += particles.volume[i] / kinematics.depth(radius);
            }
        }
        Ok(zone)
    }

    /// Mean width of the zone, m: its volume over the area of the crack, m² (in axisymmetry of the
    /// full 2π). A crack smeared over one row of particles has the width of that row.
    ///
    /// # Errors
    /// [`MeasureError::Parameter`] if the area is not positive and finite.
    pub fn width(&self, crack_area: f64) -> Result<f64, MeasureError> {
        check_positive("area of the crack", crack_area)?;
        Ok(self.volume / crack_area)
    }
}
