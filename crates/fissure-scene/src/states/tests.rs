use fissure_materials::{Increment, MaterialError, Response, Scale, Sym};

use super::*;

/// Counts how often it was told to.
struct Counting<const SPARSE: bool>;

impl<const SPARSE: bool> Material for Counting<SPARSE> {
    type State = [u32; 5];
    const SPARSE: bool = SPARSE;

    fn density(&self) -> f64 {
        1.0
    }

    fn wave_speed(&self, _: &Matrix3<f64>, _: &[u32; 5], _: &Scale) -> f64 {
        1.0
    }

    fn update(&self, _: &Increment, old: &[u32; 5]) -> Result<Response<[u32; 5]>, MaterialError> {
        Ok(Response {
            stress: Sym::ZERO,
            state: *old,
            stored: 0.0,
            dissipated: 0.0,
        })
    }
}

/// A small generator: the tests are the same every time.
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % limit
    }
}

const COUNT: usize = 50;

/// Two runs, the rows of which are swept together.
fn runs(dice: &mut Dice) -> Vec<Run> {
    let mut ends = [0; 4].map(|_| dice.below(COUNT + 1) as u32);
    ends.sort_unstable();
    let run = |start, end| Run {
        start,
        end,
        window: 0,
    };
    vec![run(ends[0], ends[1]), run(ends[2], ends[3])]
}

/// Adds 1 to the states of the chosen rows of two runs, in parts as a sweep cuts them.
fn sweep<const SPARSE: bool>(states: &mut States<Counting<SPARSE>>, runs: &[Run], chosen: &[bool]) {
    let (law, f) = (Counting::<SPARSE>, Matrix3::identity());
    let mut fresh = Vec::new();
    let mut rest = Some(states.columns(false));
    let mut at = 0;
    for run in runs {
        let (_, later) = rest.take().unwrap().cut(run.start as usize - at);
        let (mut part, later) = later.cut(run.len());
        for row in 0..run.len() {
            let index = run.start as usize + row;
            let slot = part.slot(row);
            let mut state = slot.map_or(law.without_history(&f), |slot| *part.present(slot));
            if chosen[index] {
                state = state.map(|entry| entry + index as u32 + 1);
            }
            match slot {
                Some(slot) => part.set_trial(slot, state),
                None if law.has_history(&state) => fresh.push((index as u32, state)),
                None => {}
            }
        }
        rest = Some(later);
        at = run.end as usize;
    }
    states.put_aside(runs, fresh);
}

fn all<const SPARSE: bool>(states: &States<Counting<SPARSE>>) -> Vec<[u32; 5]> {
    let (law, f) = (Counting::<SPARSE>, Matrix3::identity());
    (0..states.len())
        .map(|row| states.get(&law, row, &f))
        .collect()
}

fn grown<const SPARSE: bool>() -> States<Counting<SPARSE>> {
    let mut states = States::default();
    states.grow(&Counting, COUNT);
    states
}

#[test]
fn sparse_states_are_the_dense_ones_whatever_happens() {
    let mut dice = Dice(1);
    let (mut sparse, mut dense) = (grown::<true>(), grown::<false>());
    let whole = [Run {
        start: 0,
        end: COUNT as u32,
        window: 0,
    }];
    for round in 0..200 {
        let rarely = 1 + round / 2;
        let chosen: Vec<bool> = (0..COUNT)
            .map(|_| dice.below(100) < rarely.min(30))
            .collect();
        let none = vec![false; COUNT];
        // Everything once, as a step does; then some rows again, as an iteration does.
        let parts = runs(&mut dice);
        for (runs, chosen) in [(&whole[..], &chosen), (&parts[..], &none)] {
            sweep(&mut sparse, runs, chosen);
            sweep(&mut dense, runs, chosen);
        }
        let before = all(&sparse);
        assert_eq!(before, all(&dense), "a sweep changes no present state");
        match dice.below(4) {
            0 => {
                sparse.forget();
                sweep(&mut sparse, &whole, &none);
                sweep(&mut dense, &whole, &none);
                sparse.commit();
                dense.commit();
                assert_eq!(all(&sparse), before, "a failed step leaves all as it was");
            }
            1 => {
                let mut order: Vec<u32> = (0..COUNT as u32).collect();
                (1..COUNT).for_each(|i| order.swap(i, dice.below(i + 1)));
                sparse.reorder(&order);
                dense.reorder(&order);
            }
            2 => {
                let saved = sparse.save().unwrap();
                let mut restored = grown::<true>();
                restored.restore(&saved, "states").unwrap();
                assert!(restored.save().unwrap() == saved);
                assert_eq!(all(&restored), all(&sparse));
                sparse = restored;
            }
            _ => {
                sparse.commit();
                dense.commit();
            }
        }
        assert_eq!(all(&sparse), all(&dense));
        let kept = all(&sparse).iter().filter(|state| state[0] > 0).count();
        assert_eq!(sparse.present.len(), kept);
    }
    assert!(sparse.present.len() > COUNT / 2);
}

#[test]
fn what_does_not_fit_is_refused_when_restored() {
    let mut states = grown::<true>();
    let entry = |row: u32| (row, [1_u32; 5]);
    for (count, entries) in [
        (COUNT + 1, vec![]),
        (COUNT, vec![entry(COUNT as u32)]),
        (COUNT, vec![entry(3), entry(3)]),
    ] {
        let bytes = postcard::to_stdvec(&(count, entries)).unwrap();
        let refused = states.restore(&bytes, "states");
        assert!(matches!(refused, Err(PersistError::Mismatch { .. })));
    }
    assert!(all(&states).iter().all(|state| *state == [0; 5]));
}

#[test]
fn a_particle_without_a_history_costs_four_bytes() {
    assert_eq!(state_bytes(20, true), [4, 44]);
    assert_eq!(state_bytes(20, false), [40, 40]);
    assert_eq!(state_bytes(0, false), [0, 0]);
}
