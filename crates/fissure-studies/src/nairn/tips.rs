//! Tips of cracks as lines that are asked, now and then, whether they grow.

use fissure::diagnostics::fracture::{Annulus, EnergyReleaseGrowth, GrowthDirection, PlaneElastic};
use fissure::prelude::*;
use fissure_study::{Parameter, Parameters, Permitted, StudyError};

use super::plate::{BODY, Plate};

/// A criterion and when it is asked.
pub(super) struct Tips {
    criterion: EnergyReleaseGrowth,
    /// s between two questions: what a tip at the speed of shear waves needs for its increment.
    interval: f64,
    next: f64,
}

impl Tips {
    /// The parameters that [`of`](Self::of) reads; tips go this way by default.
    pub(super) fn parameters(direction: &'static str) -> Vec<Parameter> {
        vec![
            Parameter::choice(
                "direction",
                "of a line that grows: straight on or of the largest hoop stress",
                direction,
                &["straight", "hoop"],
            ),
            Parameter::number(
                "increment",
                "of a line that grows",
                "cells",
                0.5,
                Permitted::numbers(0.05..=2.0),
            ),
            Parameter::number(
                "radius",
                "of the domain of J, half of it free of weight",
                "cells",
                6.0,
                Permitted::numbers(3.0..=100.0),
            ),
        ]
    }

    pub(super) fn of(case: &Parameters, plate: &Plate) -> Result<Self, StudyError> {
        let elastic = PlaneElastic {
            young: plate.elastic.young,
            poisson: plate.elastic.poisson,
            plane_stress: false,
        };
        let outer = case.number("radius")? * plate.spacing;
        let increment = case.number("increment")? * plate.spacing;
        let direction = match case.choice("direction")? {
            "hoop" => GrowthDirection::MaximumHoop,
            _ => GrowthDirection::SelfSimilar,
        };
        let domain = Annulus {
            inner: 0.5 * outer,
            outer,
        };
        let criterion =
            EnergyReleaseGrowth::new(BODY, elastic, plate.toughness, domain, increment, direction)
                .map_err(StudyError::failed("setting up the growth of the crack"))?;
        let shear_wave = (elastic.shear_modulus() / plate.elastic.density).sqrt();
        Ok(Self {
            criterion: criterion.with_inertia(),
            interval: increment / shear_wave,
            next: 0.0,
        })
    }

    /// Energy release rate of a tip over the toughness; NaN where it cannot be measured.
    pub(super) fn release(&self, scene: &Scene<2>, crack: usize, end: End) -> f64 {
        let measured = self.criterion.measure(scene, crack, end).ok().flatten();
        measured.map_or(f64::NAN, |(j, _)| j / self.criterion.toughness)
    }

    /// Asks all tips of a scene, if it is time to, and lets those grow that shall.
    pub(super) fn ask(&mut self, scene: &mut Scene<2>) -> Result<Vec<Grown>, GrowthError> {
        if scene.time() < self.next {
            return Ok(Vec::new());
        }
        // On average as often as that: steps do not divide the interval.
        self.next = (self.next + self.interval).max(scene.time());
        grow_cracks(scene, &mut self.criterion)
    }
}
