//! The present and the trial states of a body's particles.
//!
//! A dense law keeps both of every particle. Of a law that is [`SPARSE`](Material::SPARSE) the
//! particles with a history alone keep them, side by side in the order of the particles; every
//! particle has a place of four bytes, which says whether it keeps one and how many particles
//! before it do. So a run of particles is a run of states here too, and threads share them out
//! without a lock. A first history made in a sweep is put aside (`fresh`), and goes to its place
//! when the step is committed; until then a failed step has changed nothing.

use fissure_materials::{Material, Matrix3};
use fissure_tensor::Sym;

use crate::PersistError;
use crate::sweep::Run;

/// Twice the number of particles before this one that keep a state, plus 1 if it does itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Place(u32);

impl Place {
    fn new(before: usize, kept: bool) -> Self {
        Self(2 * before as u32 + u32::from(kept))
    }

    fn before(self) -> usize {
        (self.0 >> 1) as usize
    }

    fn kept(self) -> bool {
        self.0 & 1 == 1
    }
}

/// First histories of particles, by row, in ascending order.
pub(crate) type Fresh<S> = Vec<(u32, S)>;

/// Bytes that a particle's state of this size takes in a body, with its trial copy and the place of
/// it: without a history, and with one. `sparse` is the law's [`Material::SPARSE`].
pub const fn state_bytes(size: usize, sparse: bool) -> [usize; 2] {
    let both = 2 * size;
    let place = size_of::<Place>();
    if sparse {
        [place, place + both]
    } else {
        [both, both]
    }
}

pub(crate) struct States<M: Material> {
    /// One a particle; empty for a dense law.
    places: Vec<Place>,
    present: Vec<M::State>,
    trial: Vec<M::State>,
    fresh: Fresh<M::State>,
    /// Of each state that is kept the stress which a sweep in place has written over, NaN before.
    overwritten: Vec<Sym>,
}

impl<M: Material> Default for States<M> {
    fn default() -> Self {
        Self {
            places: Vec::new(),
            present: Vec::new(),
            trial: Vec::new(),
            fresh: Vec::new(),
            overwritten: Vec::new(),
        }
    }
}

impl<M: Material> States<M> {
    /// Number of particles.
    pub fn len(&self) -> usize {
        if M::SPARSE {
            self.places.len()
        } else {
            self.present.len()
        }
    }

    /// Adds particles without a history, until there are `count`.
    pub fn grow(&mut self, law: &M, count: usize) {
        if M::SPARSE {
            let place = Place::new(self.present.len(), false);
            self.places.resize(count, place);
        } else {
            self.present.resize(count, law.initial());
        }
    }

    /// The present state of a particle with this deformation gradient.
    pub fn get(&self, law: &M, row: usize, f: &Matrix3<f64>) -> M::State {
        match kept::<M>(&self.places, row) {
            Some(slot) => self.present[slot],
            None => law.without_history(f),
        }
    }

    /// Puts the particles into another order; `order[i]` is the old row of the new row `i`.
    pub fn reorder(&mut self, order: &[u32]) {
        let slots = order
            .iter()
            .map(|&row| kept::<M>(&self.places, row as usize));
        self.trial.clear();
        if M::SPARSE {
            let mut places = Vec::with_capacity(order.len());
            for slot in slots {
                places.push(Place::new(self.trial.len(), slot.is_some()));
                self.trial.extend(slot.map(|slot| self.present[slot]));
            }
            self.places = places;
        } else {
            self.trial
                .extend(slots.flatten().map(|slot| self.present[slot]));
        }
        std::mem::swap(&mut self.present, &mut self.trial);
        self.fresh.clear();
    }

    /// Where the state of a particle is kept, if it is and says anything.
    pub fn slot(&self, row: usize) -> Option<usize> {
        if size_of::<M::State>() == 0 {
            return None;
        }
        kept::<M>(&self.places, row)
    }

    /// The stress that a sweep in place has written over.
    pub fn overwritten(&self, slot: usize) -> Option<Sym> {
        let stress = self.overwritten.get(slot)?;
        stress.is_finite().then_some(*stress)
    }

    /// The columns of all particles, for a sweep.
    pub fn columns(&mut self, in_place: bool) -> StateColumns<'_, M> {
        let kept = self.present.len();
        self.trial.resize(kept, M::State::default());
        let stresses = if in_place && size_of::<M::State>() > 0 {
            kept
        } else {
            0
        };
        self.overwritten.resize(stresses, Sym::IDENTITY * f64::NAN);
        StateColumns {
            places: &self.places,
            first: 0,
            present: &self.present,
            trial: &mut self.trial,
            overwritten: &mut self.overwritten,
        }
    }

    /// Takes over the first histories that a sweep over `runs` made; what an earlier one put aside
    /// of the same particles is void.
    pub fn put_aside(&mut self, runs: &[Run], fresh: Fresh<M::State>) {
        if self.fresh.is_empty() {
            self.fresh = fresh;
            return;
        }
        let swept = |row: u32| {
            let after = runs.partition_point(|run| run.end <= row);
            runs.get(after).is_some_and(|run| run.start <= row)
        };
        self.fresh.retain(|&(row, _)| !swept(row));
        self.fresh.extend(fresh);
        self.fresh.sort_unstable_by_key(|&(row, _)| row);
    }

    /// Forgets what has been put aside: the step failed.
    pub fn forget(&mut self) {
        self.fresh.clear();
    }

    /// Forgets the stresses written over: they are back.
    pub fn forget_stresses(&mut self) {
        self.overwritten.clear();
    }

    /// Makes the trial states the present ones.
    pub fn commit(&mut self) {
        std::mem::swap(&mut self.present, &mut self.trial);
        self.overwritten.clear();
        let fresh = std::mem::take(&mut self.fresh);
        let Some(&(first, _)) = fresh.first() else {
            return;
        };
        // From the last on, so that each state moves up once.
        let mut end = self.present.len();
        self.present.resize(end + fresh.len(), M::State::default());
        for (earlier, &(row, state)) in fresh.iter().enumerate().rev() {
            let slot = self.places[row as usize].before();
            self.present.copy_within(slot..end, slot + earlier + 1);
            self.present[slot + earlier] = state;
            end = slot;
        }
        let mut left = fresh.iter().peekable();
        let mut added = 0;
        for (row, place) in self.places.iter_mut().enumerate().skip(first as usize) {
            let is_new = left.next_if(|(fresh, _)| *fresh as usize == row).is_some();
            *place = Place::new(place.before() + added, place.kept() || is_new);
            added += usize::from(is_new);
        }
    }

    /// The present states as bytes: all, or those kept with their rows.
    pub fn save(&self) -> Result<Vec<u8>, postcard::Error> {
        if !M::SPARSE {
            return postcard::to_stdvec(&self.present);
        }
        let rows = (0..self.places.len()).filter(|&row| self.places[row].kept());
        let kept: Vec<(u32, &M::State)> = rows.map(|row| row as u32).zip(&self.present).collect();
        postcard::to_stdvec(&(self.places.len(), kept))
    }

    /// Puts saved states back.
    ///
    /// # Errors
    /// Bytes that do not decode or do not fit.
    pub fn restore(&mut self, bytes: &[u8], section: &str) -> Result<(), PersistError> {
        let refused = |source| PersistError::Decode {
            section: section.to_owned(),
            source,
        };
        let mismatch = |what, found, expected| PersistError::Mismatch {
            section: section.to_owned(),
            what,
            found,
            expected,
        };
        let expected = self.len();
        if !M::SPARSE {
            let states: Vec<M::State> = postcard::from_bytes(bytes).map_err(refused)?;
            if states.len() != expected {
                return Err(mismatch("number of particles", states.len(), expected));
            }
            self.present = states;
            return Ok(());
        }
        let (found, fresh): (usize, Fresh<M::State>) =
            postcard::from_bytes(bytes).map_err(refused)?;
        if found != expected {
            return Err(mismatch("number of particles", found, expected));
        }
        let mut next = 0;
        for &(row, _) in &fresh {
            if (row as usize) < next || row as usize >= expected {
                return Err(mismatch("row of a state", row as usize, next));
            }
            next = row as usize + 1;
        }
        self.places.fill(Place::default());
        self.present.clear();
        self.trial.clear();
        self.fresh = fresh;
        self.commit();
        Ok(())
    }
}

/// Where a particle's state is kept, if it is.
#[inline(always)]
fn kept<M: Material>(places: &[Place], row: usize) -> Option<usize> {
    if !M::SPARSE {
        return Some(row);
    }
    let place = places[row];
    place.kept().then(|| place.before())
}

/// The states of some consecutive particles, cut out of the body's.
pub(crate) struct StateColumns<'a, M: Material> {
    places: &'a [Place],
    /// How many particles before these keep a state.
    first: usize,
    present: &'a [M::State],
    trial: &'a mut [M::State],
    /// Empty unless the sweep is in place.
    overwritten: &'a mut [Sym],
}

impl<M: Material> StateColumns<'_, M> {
    /// Those of the particles before `row`, and those of the rest.
    pub fn cut(self, row: usize) -> (Self, Self) {
        let (mut before, mut after, mut slot) = (self.places, self.places, row);
        if M::SPARSE {
            (before, after) = self.places.split_at(row);
            let next = after.first().map(|place| place.before() - self.first);
            slot = next.unwrap_or(self.present.len());
        }
        let (present_a, present_b) = self.present.split_at(slot);
        let (trial_a, trial_b) = self.trial.split_at_mut(slot);
        let stresses = slot.min(self.overwritten.len());
        let (overwritten_a, overwritten_b) = self.overwritten.split_at_mut(stresses);
        (
            Self {
                places: before,
                first: self.first,
                present: present_a,
                trial: trial_a,
                overwritten: overwritten_a,
            },
            Self {
                places: after,
                first: self.first + slot,
                present: present_b,
                trial: trial_b,
                overwritten: overwritten_b,
            },
        )
    }

    /// Where a row's states are kept, if they are.
    #[inline(always)]
    pub fn slot(&self, row: usize) -> Option<usize> {
        Some(kept::<M>(self.places, row)? - if M::SPARSE { self.first } else { 0 })
    }

    /// The present state at a slot.
    #[inline(always)]
    pub fn present(&self, slot: usize) -> &M::State {
        &self.present[slot]
    }

    /// Notes the stress that is to be written over.
    #[inline(always)]
    pub fn keep_stress(&mut self, slot: usize, stress: Sym) {
        if let Some(kept) = self.overwritten.get_mut(slot) {
            *kept = stress;
        }
    }

    /// Sets the trial state at a slot.
    #[inline(always)]
    pub fn set_trial(&mut self, slot: usize, state: M::State) {
        self.trial[slot] = state;
    }
}

#[cfg(test)]
mod tests;
