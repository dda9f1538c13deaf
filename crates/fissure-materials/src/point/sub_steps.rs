//! A step in as many parts as it needs.

use super::targets::Part;
use super::{Point, PointError, Sample};
use crate::equilibrium::Failure;
use crate::{Material, Path};

/// A part that was taken.
pub(super) struct Taken<S> {
    pub part: Part,
    pub old: Sample<S>,
    pub new: Sample<S>,
}

/// A step and how it is divided.
struct Division<'a, S, V> {
    path: &'a Path,
    place: (usize, usize),
    start: &'a Sample<S>,
    /// Told of every part taken.
    taken: V,
}

impl<M: Material> Point<'_, M> {
    /// Takes one step, telling `taken` of each of its parts; the point stays where it is if that
    /// fails.
    pub(super) fn step(
        &mut self,
        path: &Path,
        index: usize,
        step: usize,
        start: &Sample<M::State>,
        taken: impl FnMut(Taken<M::State>),
    ) -> Result<(), PointError> {
        let steps = path.legs[index].steps() as f64;
        let whole = Part {
            from: (step - 1) as f64 / steps,
            to: step as f64 / steps,
            length: 1.0,
        };
        let mut division = Division {
            path,
            place: (index, step),
            start,
            taken,
        };
        let halvings = path.sub_steps.halvings;
        let end = self.divide(&mut division, self.now, whole, halvings);
        self.now = end.map_err(|failure| match failure {
            Failure::Law(source) => PointError::Update {
                leg: index,
                step,
                source,
            },
            Failure::Unbalanced(unbalanced) => PointError::NoEquilibrium {
                leg: index,
                step,
                unbalanced,
            },
        })?;
        Ok(())
    }

    /// The end of a part that may still be halved `halvings` times.
    fn divide<V: FnMut(Taken<M::State>)>(
        &self,
        division: &mut Division<'_, M::State, V>,
        old: Sample<M::State>,
        part: Part,
        halvings: u32,
    ) -> Result<Sample<M::State>, Failure> {
        let attempt = |from: &Sample<M::State>, part: &Part| {
            self.attempt(division.path, division.place, division.start, from, part)
        };
        let whole = attempt(&old, &part);
        let tolerance = division.path.sub_steps.tolerance;
        let [first, second] = part.halves();
        let accepted = match &whole {
            _ if halvings == 0 => true,
            Err(_) => false,
            Ok(_) if tolerance == f64::INFINITY => true,
            Ok(whole) => attempt(&old, &first).is_ok_and(|half| {
                let agrees = attempt(&half, &second)
                    .is_ok_and(|end| (end.stress - whole.stress).max_abs() <= tolerance);
                // Where a crack or a flow starts late in the part, taking it whole or in halves is
                // wrong by the same: there the part itself has to be short.
                let starts = half.dissipated == old.dissipated && whole.dissipated > old.dissipated;
                let short = (whole.stress - old.stress).max_abs() <= tolerance;
                agrees && (short || !starts)
            }),
        };
        if accepted {
            let new = whole?;
            (division.taken)(Taken { part, old, new });
            return Ok(new);
        }
        let half = self.divide(division, old, first, halvings - 1)?;
        let mut end = self.divide(division, half, second, halvings - 1)?;
        end.parts += half.parts;
        Ok(end)
    }
}
