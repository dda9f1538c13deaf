//! What happens to the cracks of a point, and where along the path.
//!
//! An event is a change in what the law says of its cracks between the ends of a part; the part is
//! then taken again to ever better fractions of itself, until the place is known to round-off.

use super::sub_steps::Taken;
use super::targets::Part;
use super::{Point, PointError, Sample};
use crate::{Crack, Cracking, Path};

/// Halvings of a part: its length over 2⁵⁰ is round-off.
const HALVINGS: usize = 50;

/// What can happen to a crack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// It starts.
    Initiation,
    /// It stops carrying tension.
    Failure,
    /// Its faces, once open, come together.
    Contact,
}

/// An event with its place along the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event<S> {
    /// What happens.
    pub kind: EventKind,
    /// To which crack, in the order of [`Cracking::cracks`].
    pub crack: usize,
    /// Where on the leg, from 0 at its start to 1 at its end.
    pub fraction: f64,
    /// The point there: the first place on the path, to round-off, at which it has happened.
    pub sample: Sample<S>,
}

/// A path that was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct History<S> {
    /// One sample per step.
    pub samples: Vec<Sample<S>>,
    /// What happened to cracks, in the order of the path.
    pub events: Vec<Event<S>>,
}

impl<M: Cracking> Point<'_, M> {
    /// As [`drive`](Self::drive), and the initiation, failure and contact of cracks on the way.
    ///
    /// ```
    /// use fissure_materials::{
    ///     Axis, Band, Decohesive, EventKind, Isotropic, Normal, Path, Point, softening::Linear,
    /// };
    /// let concrete = Decohesive {
    ///     elastic: Isotropic { density: 2400.0, young: 30e9, poisson: 0.2 },
    ///     strength: 3e6,
    ///     toughness: 60.0,
    ///     softening: Linear,
    ///     normal: Normal::Rankine,
    /// };
    /// // In one stride: the strength is reached at 3 MPa / 30 GPa of it.
    /// let path = Path::new(Band::cube(0.01)).uniaxial(Axis::X, 1e-3, 1);
    /// let events = Point::new(&concrete)?.drive_with_events(&path)?.events;
    /// assert_eq!(events[0].kind, EventKind::Initiation);
    /// assert!((events[0].sample.strain.xx() / 1e-4 - 1.0).abs() < 1e-3);
    /// # Ok::<(), fissure_materials::PointError>(())
    /// ```
    ///
    /// # Errors
    /// As [`drive`](Self::drive).
    pub fn drive_with_events(&mut self, path: &Path) -> Result<History<M::State>, PointError> {
        let (mut samples, mut events) = (Vec::new(), Vec::new());
        self.visit_with_events(
            path,
            |sample| samples.push(*sample),
            |event| events.push(*event),
        )?;
        Ok(History { samples, events })
    }

    /// As [`drive_with_events`](Self::drive_with_events), handing over each sample, and before it
    /// the events of its step, as soon as they are there.
    ///
    /// # Errors
    /// As [`drive`](Self::drive).
    pub fn visit_with_events(
        &mut self,
        path: &Path,
        mut visit: impl FnMut(&Sample<M::State>),
        mut happens: impl FnMut(&Event<M::State>),
    ) -> Result<(), PointError> {
        self.check(path)?;
        for (index, leg) in path.legs.iter().enumerate() {
            let start = self.now;
            for step in 1..=leg.steps() {
                let mut parts = Vec::new();
                self.step(path, index, step, &start, |taken| parts.push(taken))?;
                for taken in &parts {
                    let mut events = self.events(path, &start, taken);
                    events.sort_by(|a, b| a.fraction.total_cmp(&b.fraction));
                    events.iter().for_each(&mut happens);
                }
                visit(&self.now);
            }
        }
        Ok(())
    }

    /// The events of one part.
    fn events(
        &self,
        path: &Path,
        start: &Sample<M::State>,
        taken: &Taken<M::State>,
    ) -> Vec<Event<M::State>> {
        let old = self.law.cracks(&taken.old.state);
        let new = self.law.cracks(&taken.new.state);
        let mut events = Vec::new();
        for (crack, now) in new.iter().enumerate() {
            let before = old.get(crack);
            let failed_before = before.is_some_and(|c| c.failed);
            let open_before = before.is_some_and(|c| c.opening > 0.0);
            for (kind, happened) in [
                (EventKind::Initiation, before.is_none()),
                (EventKind::Failure, now.failed && !failed_before),
                (EventKind::Contact, open_before && now.opening <= 0.0),
            ] {
                if happened {
                    let (fraction, sample) = self.locate(path, start, taken, kind, crack);
                    events.push(Event {
                        kind,
                        crack,
                        fraction,
                        sample,
                    });
                }
            }
        }
        events
    }

    /// The first place in a part at which an event has happened.
    fn locate(
        &self,
        path: &Path,
        start: &Sample<M::State>,
        taken: &Taken<M::State>,
        kind: EventKind,
        crack: usize,
    ) -> (f64, Sample<M::State>) {
        let place = (taken.new.leg, taken.new.step);
        let (mut low, mut high) = (0.0, 1.0);
        let mut found = (taken.part, taken.new);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let part: Part = taken.part.first(middle);
            // What the law refuses on the way is no event yet.
            match self.attempt(path, place, start, &taken.old, &part) {
                Ok(sample) if happened(self.law.cracks(&sample.state).get(crack), kind) => {
                    high = middle;
                    found = (part, sample);
                }
                _ => low = middle,
            }
        }
        (found.0.to, found.1)
    }
}

fn happened(crack: Option<&Crack>, kind: EventKind) -> bool {
    crack.is_some_and(|crack| match kind {
        EventKind::Initiation => true,
        EventKind::Failure => crack.failed,
        EventKind::Contact => crack.opening <= 0.0,
    })
}
