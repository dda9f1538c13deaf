//! Necks: the bar in slices of one cell at rest, and how wide the particles of each lie.

use fissure::prelude::*;

/// The narrowest slice of a bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Neck {
    /// Product of its widths over the same at rest.
    pub section: f64,
    /// Its widths over those at rest: along y, and along z in space, else 1.
    pub widths: [f64; 2],
    /// Where it was at rest, over the length of the bar.
    pub place: f64,
    /// Where it is, m.
    pub x: f64,
    /// Between the cross-section and the line from the deepest place of one side to that of the opposite one, along y and z, rad:
    /// 0 for a neck that is straight across.
    pub angles: [f64; 2],
}

/// Ends of a slice's particles across the bar, and where it is along it, m.
#[derive(Clone, Copy, Debug)]
struct Extent {
    x: f64,
    low: [f64; 2],
    high: [f64; 2],
}

impl Extent {
    fn width(&self, axis: usize) -> f64 {
        self.high[axis] - self.low[axis]
    }
}

/// A bar in slices across x.
#[derive(Clone, Debug)]
pub(super) struct Slices {
    /// Slice of each particle, by id.
    slice: Vec<usize>,
    first: Vec<Extent>,
    length: f64,
}

impl Slices {
    /// Of a bar at rest from x = 0 to `length`, with slices of one cell.
    pub(super) fn of<const D: usize>(body: &Body<D>, length: f64, spacing: f64) -> Self {
        let particles = body.particles();
        let ids = particles.id.iter().map(|id| id.0 as usize + 1);
        let mut slice = vec![0; ids.max().unwrap_or(0)];
        let last = ((length / spacing).round() as usize).saturating_sub(1);
        for (id, x) in particles.id.iter().zip(&particles.motion.position) {
            slice[id.0 as usize] = ((x[0] / spacing) as usize).min(last);
        }
        let mut slices = Self {
            slice,
            first: Vec::new(),
            length,
        };
        slices.first = slices.extents(body, last + 1);
        slices
    }

    fn extents<const D: usize>(&self, body: &Body<D>, count: usize) -> Vec<Extent> {
        let none = Extent {
            x: 0.0,
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
        };
        let (mut extents, mut particles) = (vec![none; count], vec![0.0_f64; count]);
        let motion = body.motion();
        for (id, x) in body.particles().id.iter().zip(motion.position) {
            let number = self.slice[id.0 as usize];
            let extent = &mut extents[number];
            extent.x += x[0];
            particles[number] += 1.0;
            for axis in 1..D {
                extent.low[axis - 1] = extent.low[axis - 1].min(x[axis]);
                extent.high[axis - 1] = extent.high[axis - 1].max(x[axis]);
            }
        }
        for (extent, particles) in extents.iter_mut().zip(particles) {
            extent.x /= particles;
        }
        extents
    }

    /// The narrowest slice now; `None` without one.
    pub(super) fn neck<const D: usize>(&self, body: &Body<D>) -> Option<Neck> {
        let now = self.extents(body, self.first.len());
        let widths = |number: usize| {
            let mut widths = [1.0; 2];
            for (axis, width) in widths.iter_mut().enumerate().take(D - 1) {
                *width = now[number].width(axis) / self.first[number].width(axis);
            }
            widths
        };
        let section = |number: usize| widths(number).iter().product::<f64>();
        let number = (0..now.len()).min_by(|a, b| section(*a).total_cmp(&section(*b)))?;
        let mut angles = [0.0; 2];
        for (axis, angle) in angles.iter_mut().enumerate().take(D - 1) {
            let above = now
                .iter()
                .min_by(|a, b| a.high[axis].total_cmp(&b.high[axis]))?;
            let below = now
                .iter()
                .max_by(|a, b| a.low[axis].total_cmp(&b.low[axis]))?;
            *angle = (above.x - below.x).atan2(self.first[number].width(axis));
        }
        Some(Neck {
            section: section(number),
            widths: widths(number),
            place: self.first[number].x / self.length,
            x: now[number].x,
            angles,
        })
    }
}
