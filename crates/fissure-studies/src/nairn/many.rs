//! Several runs at once, reported in the order of their cases.

use fissure_study::{Parameters, Report, StudyError};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// Runs each case on one thread, as many at once as the first one's `threads`, and hands over the
/// results in order, as they come.
pub(super) fn in_order<T: Send>(
    cases: &[Parameters],
    rows: &mut Report<'_>,
    work: impl Fn(&Parameters) -> Result<T, StudyError> + Sync,
    mut take: impl FnMut(&mut Report<'_>, &Parameters, T) -> Result<(), StudyError>,
) -> Result<(), StudyError> {
    let threads = match cases.first() {
        Some(first) => first.size("threads")?,
        None => return Ok(()),
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(StudyError::failed("starting the worker threads"))?;
    // A run must not help another with its loops: its wall time would be another's.
    let alone = |case: &Parameters| -> Result<T, StudyError> {
        let single = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .map_err(StudyError::failed("starting a worker thread"))?;
        single.install(|| work(case))
    };
    let mut done = 0;
    for chunk in cases.chunks(threads) {
        rows.progress(&format!(
            "{} to {} of {}",
            done + 1,
            done + chunk.len(),
            cases.len()
        ));
        let results: Vec<Result<T, StudyError>> =
            pool.install(|| chunk.par_iter().map(alone).collect());
        for (case, result) in chunk.iter().zip(results) {
            take(rows, case, result?)?;
        }
        done += chunk.len();
    }
    Ok(())
}
