//! Runs of windows in parallel, each window on one thread.

use crate::sweep::Run;

/// Fewer particles than this are worked on by one thread.
const GRAIN: u32 = 1024;

/// Columns of some consecutive particles, which can be cut in two.
pub(crate) trait Cut: Sized + Send {
    /// The particles before `row` and those from it on.
    fn cut(self, row: usize) -> (Self, Self);
}

impl Cut for () {
    fn cut(self, _row: usize) -> ((), ()) {
        ((), ())
    }
}

/// Halves the runs until those of one window are left, which `leaf` gets with their columns. The
/// tree depends on the runs alone, so what `join` makes of its two branches does too.
pub(crate) fn over_windows<C: Cut, T: Send>(
    runs: &[Run],
    columns: C,
    leaf: &(impl Fn(&[Run], C) -> T + Sync),
    join: &(impl Fn(T, T) -> T + Sync),
) -> Option<T> {
    let (first, last) = (runs.first()?, runs.last()?);
    let Some(middle) = window_boundary(runs) else {
        return Some(leaf(runs, columns));
    };
    let (left, right) = runs.split_at(middle);
    let (a, b) = columns.cut((right[0].start - first.start) as usize);
    let a = || over_windows(left, a, leaf, join);
    let b = || over_windows(right, b, leaf, join);
    let (a, b) = if last.end - first.start < GRAIN {
        (a(), b())
    } else {
        rayon::join(a, b)
    };
    Some(join(a?, b?))
}

/// Where a window begins, near the middle; `None` if there is but one.
fn window_boundary(runs: &[Run]) -> Option<usize> {
    let middle = runs.len() / 2;
    let begins = |&i: &usize| runs[i].window != runs[i - 1].window;
    let before = (1..=middle).rev().find(begins);
    before.or_else(|| (middle + 1..runs.len()).find(begins))
}

/// Calls `leaf` for the runs of each window, in parallel; runs of a window stand side by side.
///
/// # Errors
/// The error of the first window, in the order of the runs, that has one.
pub fn for_each_window<E: Send>(
    runs: &[Run],
    leaf: &(impl Fn(&[Run]) -> Result<(), E> + Sync),
) -> Result<(), E> {
    over_windows(runs, (), &|runs, ()| leaf(runs), &Result::and).unwrap_or(Ok(()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn every_window_is_seen_once_and_whole() {
        let windows = [3, 3, 3, 1, 4, 4, 9, 9, 9, 9, 9, 2];
        let run = |(i, &window): (usize, &u32)| Run {
            start: 40 * i as u32,
            end: 40 * (i as u32 + 1),
            window,
        };
        let runs: Vec<Run> = windows.iter().enumerate().map(run).collect();
        let seen = Mutex::new(Vec::new());
        let result: Result<(), ()> = for_each_window(&runs, &|runs| {
            let window = runs[0].window;
            assert!(runs.iter().all(|run| run.window == window));
            seen.lock().unwrap().push((window, runs.len()));
            Ok(())
        });
        assert_eq!(result, Ok(()));
        let mut seen = seen.into_inner().unwrap();
        seen.sort_unstable();
        assert_eq!(seen, [(1, 1), (2, 1), (3, 3), (4, 2), (9, 5)]);
        let first = for_each_window(&runs, &|runs| Err::<(), u32>(runs[0].window));
        assert_eq!(first, Err(3));
    }
}
