//! Elongation between two places of the bar, as an extensometer reads it.

use fissure::prelude::*;

use super::breaking::load;
use super::exact::Exact;
use super::history::History;
use super::specimen::Bar;

/// Places of the slabs from the middle of the bar, over its length.
const PLACE: f64 = 0.25;
/// Half the thickness of a slab, cells.
const HALF: f64 = 1.0;

/// Two slabs of particles across the bar, whose mean positions are read off after every step.
///
/// Grips hold whatever nodes their rigid particles reach. In a turned bar these do not lie on two lines across it, so the length
/// between the grips is known to a cell only; that between the slabs is known.
pub(crate) struct Gauge {
    axis: Vector2<f64>,
    /// Shares of the particles in either slab, by identity.
    shares: Vec<[f64; 2]>,
    /// Between the slabs at rest, m.
    pub length: f64,
    /// What the run leaves over the elongation between the slabs.
    pub history: History,
}

impl Gauge {
    /// A gauge on the bar at rest.
    pub(crate) fn new(bar: &Bar, scene: &Scene<2>) -> Self {
        let body = &scene.bodies()[0];
        let particles = body.particles();
        let mut shares = vec![[0.0; 2]; scene.particle_count()];
        let mut volumes = [0.0; 2];
        let places = body.motion().position.iter().zip(&particles.volume);
        for (id, (x, volume)) in particles.id.iter().zip(places) {
            for (slab, side) in [-PLACE, PLACE].into_iter().enumerate() {
                let away = bar.along(x) - (0.5 + side) * bar.length;
                if away.abs() <= HALF * bar.spacing {
                    shares[id.0 as usize][slab] = *volume;
                    volumes[slab] += volume;
                }
            }
        }
        for share in &mut shares {
            *share = [share[0] / volumes[0], share[1] / volumes[1]];
        }
        let mut gauge = Self {
            axis: bar.axis(),
            shares,
            length: 0.0,
            history: History::at_rest(),
        };
        gauge.length = gauge.distance(scene);
        gauge
    }

    /// The curve of a bar that is as long as the gauge.
    pub(crate) fn exact(&self, bar: &Bar) -> Exact {
        Exact {
            length: self.length,
            ..bar.exact()
        }
    }

    fn distance(&self, scene: &Scene<2>) -> f64 {
        let body = &scene.bodies()[0];
        let ids = body.particles().id.iter();
        let places = ids.zip(body.motion().position);
        let parts = places.map(|(id, x)| {
            let [left, right] = self.shares[id.0 as usize];
            (right - left) * x.dot(&self.axis)
        });
        parts.sum()
    }
}

impl Watch<2> for Gauge {
    fn after(&mut self, scene: &Scene<2>, _report: &Report<2>) -> Result<(), WatchError> {
        let elongation = self.distance(scene) - self.length;
        let (load, energy) = (load(scene, &self.axis), scene.energy());
        self.history
            .push(elongation, load, energy.stored, energy.dissipated);
        Ok(())
    }
}
