//! What the growth of a crack has cost, noted whenever its tip moves on.

use fissure::prelude::*;

use crate::nairn::failed::Places;
use crate::nairn::plate::{BODY, Plate, THICKNESS};

/// Energies at one length of the crack, J.
#[derive(Clone, Copy, Debug, Default)]
struct Cost {
    /// Growth, m.
    growth: f64,
    failed: f64,
    wake: f64,
    transfer: f64,
    /// Number of failed particles.
    count: f64,
}

/// The costs at every length.
#[derive(Clone, Debug, Default)]
pub(super) struct Costs(Vec<Cost>);

/// Energies per area of growth over the toughness, and the rows of particles that failed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rate {
    pub failed: f64,
    pub wake: f64,
    pub transfer: f64,
    pub rows: f64,
}

impl Costs {
    /// Looks at a scene; returns the growth, m, if the tip has moved on.
    pub(super) fn look(
        &mut self,
        scene: &Scene<2>,
        places: &Places<2>,
        plate: &Plate,
    ) -> Option<f64> {
        let body = scene.body(BODY)?;
        let tips = places.failed(body);
        let ahead = tips.iter().filter(|x| plate.is_ahead(x));
        let (count, tip) = ahead.fold((0.0, f64::NAN), |(n, most), x| (n + 1.0, x.x.max(most)));
        let growth = tip - plate.crack;
        if !(growth > self.growth()) {
            return None;
        }
        let failed = body.value("failed").unwrap_or_default();
        let energy = body.value("opening_energy").unwrap_or_default();
        let (mut by_failed, mut all) = (0.0, 0.0);
        for ((failed, energy), volume) in failed.iter().zip(&energy).zip(&body.particles().volume) {
            all += volume * energy;
            if *failed > 0.5 {
                by_failed += volume * energy;
            }
        }
        // Energies of the law are per area; the band is the same for all.
        let dissipated = scene.energy().dissipated;
        let failed = dissipated * by_failed / all;
        self.0.push(Cost {
            growth,
            failed,
            wake: dissipated - failed,
            transfer: scene.energy().transfer_loss,
            count,
        });
        Some(growth)
    }

    /// m.
    pub(super) fn growth(&self) -> f64 {
        self.0.last().map_or(0.0, |last| last.growth)
    }

    /// Of the second half of the growth: the process zone ahead of the tip has then its length, and what it holds
    /// is no part of the cost. NaN if the tip moved less than three times.
    pub(super) fn rate(&self, plate: &Plate) -> Rate {
        let half = 0.5 * self.growth();
        let first = self.0.iter().find(|cost| cost.growth >= half);
        let (Some(a), Some(b), true) = (first, self.0.last(), self.0.len() > 2) else {
            let nothing = f64::NAN;
            return Rate {
                failed: nothing,
                wake: nothing,
                transfer: nothing,
                rows: nothing,
            };
        };
        let growth = b.growth - a.growth;
        let area = growth * THICKNESS * plate.toughness;
        Rate {
            failed: (b.failed - a.failed) / area,
            wake: (b.wake - a.wake) / area,
            transfer: (b.transfer - a.transfer) / area,
            rows: (b.count - a.count) * 0.5 * plate.spacing / growth,
        }
    }
}
