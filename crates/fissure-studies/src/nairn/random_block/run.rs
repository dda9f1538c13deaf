//! The samples in parallel, then a row per field and resolution and a row per test.

use std::time::{Duration, Instant};

use fissure_study::{
    Fields, Measures, Parameters, Report as Rows, Row, SimulationRow, StudyError, Value,
};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::block::{Sample, compress};
use super::pictures;
use super::samples::Samples;
use super::statistics::{Moments, Test, fisher, welch};
use crate::nairn::numerics::check_whole_cells;

/// The samples of one case.
pub(super) struct Set {
    pub case: Parameters,
    pub samples: Vec<Option<Sample>>,
}

impl Set {
    pub(super) fn moments(&self) -> Moments {
        let strengths: Vec<f64> = self.all().map(|sample| sample.strength).collect();
        Moments::of(&strengths)
    }

    pub(super) fn all(&self) -> impl Iterator<Item = &Sample> {
        self.samples.iter().flatten()
    }

    pub(super) fn field(&self) -> &str {
        self.case.choice("field").unwrap_or_default()
    }

    pub(super) fn spacing(&self) -> f64 {
        self.case.number("h").unwrap_or(f64::NAN)
    }
}

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let mut sets = Vec::new();
    for case in cases {
        check_whole_cells(case, &["length", "width"])?;
        let samples = vec![None; case.size("samples")?];
        sets.push(Set {
            case: case.clone(),
            samples,
        });
    }
    let mut file = rows.out_dir().map(Samples::open).transpose()?;
    fill(&mut sets, file.as_mut(), rows)?;
    for set in &sets {
        rows.row(row(set)?)?;
    }
    tests(&sets, rows)?;
    match rows.out_dir() {
        Some(folder) => pictures::draw(folder, &sets),
        None => Ok(()),
    }
}

/// Runs what is missing, a sample on each thread at a time.
fn fill(
    sets: &mut [Set],
    mut file: Option<&mut Samples>,
    rows: &mut Rows<'_>,
) -> Result<(), StudyError> {
    let mut todo: Vec<(usize, usize)> = Vec::new();
    let mut found = 0;
    for (s, set) in sets.iter_mut().enumerate() {
        for number in 0..set.samples.len() {
            let seed = number as u64 + 1;
            let known = file.as_ref().and_then(|file| file.find(&set.case, seed));
            found += usize::from(known.is_some());
            set.samples[number] = known;
            // The first of each is run anew, for its picture.
            let drawn = number == 0 && file.is_some();
            if set.samples[number].is_none() || drawn {
                todo.push((s, number));
            }
        }
    }
    if found > 0 {
        rows.progress(&format!("{found} samples were there already"));
    }
    let Some(first) = sets.first() else {
        return Ok(());
    };
    let threads = first.case.size("threads")?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(StudyError::failed("starting the worker threads"))?;
    // Coarse ones first: they tell the time that the others will take.
    todo.sort_by(|a, b| sets[b.0].spacing().total_cmp(&sets[a.0].spacing()));
    let drawing = file.is_some();
    let work = |set: &Set| cost(set) / threads as f64;
    let mut left: f64 = todo.iter().map(|(s, _)| work(&sets[*s])).sum();
    let (start, mut spent) = (Instant::now(), 0.0);
    let mut done = 0;
    for chunk in todo.chunks(threads) {
        let one = |(s, number): &(usize, usize)| {
            let single = rayon::ThreadPoolBuilder::new()
                .num_threads(1)
                .build()
                .map_err(StudyError::failed("starting a worker thread"))?;
            let case = &sets[*s].case;
            single.install(|| compress(case, *number as u64 + 1, drawing && *number == 0))
        };
        let results: Vec<Result<Sample, StudyError>> =
            pool.install(|| chunk.par_iter().map(one).collect());
        for (&(s, number), result) in chunk.iter().zip(results) {
            let sample = result?;
            if let (Some(file), true) = (file.as_mut(), sets[s].samples[number].is_none()) {
                file.add(&sets[s].case, number as u64 + 1, &sample)?;
            }
            sets[s].samples[number] = Some(sample);
            let cost = work(&sets[s]);
            (spent, left) = (spent + cost, left - cost);
        }
        done += chunk.len();
        if done == chunk.len() || done % (10 * threads) < threads || done == todo.len() {
            let rest = start.elapsed().mul_f64((left / spent).clamp(0.0, 1e6));
            let rest = Duration::from_secs(rest.as_secs());
            rows.progress(&format!(
                "{done} of {} samples, about {rest:?} to go",
                todo.len()
            ));
        }
    }
    Ok(())
}

/// Relative cost of a sample: particles times steps.
fn cost(set: &Set) -> f64 {
    set.spacing().powi(-3)
}

fn row(set: &Set) -> Result<SimulationRow, StudyError> {
    let moments = set.moments();
    let (low, high) = moments.deviation_interval();
    let mut row = SimulationRow::new("random-block", &set.case);
    row.solver = "explicit".to_owned();
    row.threads = 1;
    let largest = |f: fn(&Sample) -> f64| set.all().map(f).map(f64::abs).fold(0.0, f64::max);
    if let Some(first) = set.all().next() {
        row.particles = first.particles;
        row.steps = first.steps;
    }
    row.wall_s = set.all().map(|sample| sample.wall_s).sum();
    row.errors = Measures::new().with("mean_interval", moments.mean_interval() / moments.mean);
    let strain = set.all().map(|sample| sample.strain).sum::<f64>() / moments.number;
    row.values = Measures::new()
        .with("mean", moments.mean)
        .with("deviation", moments.deviation)
        .with("deviation_low", low)
        .with("deviation_high", high)
        .with(
            "mean_over_nominal",
            moments.mean / (2.0 * set.case.number("shear_strength")?),
        )
        .with("strain_at_peak", strain)
        .with("reached", 1.0 - largest(|sample| 1.0 - sample.reached))
        .with(
            "energy_imbalance",
            largest(|sample| sample.energy_imbalance),
        )
        .with("worst_balance", largest(|sample| sample.worst_balance))
        .with("transfer_loss", largest(|sample| sample.transfer_loss));
    Ok(row)
}

/// The conclusions of fig. 10 as tests: each field on its coarsest against its finest grid, and the
/// two fields on each grid.
fn tests(sets: &[Set], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    for field in ["uncorrelated", "correlated"] {
        let mut own: Vec<&Set> = sets.iter().filter(|set| set.field() == field).collect();
        own.sort_by(|a, b| b.spacing().total_cmp(&a.spacing()));
        if let [coarse, .., fine] = own.as_slice()
            && coarse.spacing() != fine.spacing()
        {
            let name = format!("{field}: coarsest against finest");
            compare(&name, coarse, fine, rows)?;
        }
    }
    let correlated = sets.iter().filter(|set| set.field() == "correlated");
    for one in correlated {
        let same = |other: &&Set| {
            let pairs = one.case.iter().zip(other.case.iter());
            other.field() == "uncorrelated"
                && pairs.into_iter().all(|(a, b)| a.0 == "field" || a == b)
        };
        if let Some(other) = sets.iter().find(same) {
            let h = Value::Number(one.spacing());
            compare(
                &format!("correlated against uncorrelated, h={h}"),
                one,
                other,
                rows,
            )?;
        }
    }
    Ok(())
}

fn compare(name: &str, one: &Set, other: &Set, rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let (a, b) = (one.moments(), other.moments());
    let (means, variances) = (welch(&a, &b), fisher(&a, &b));
    let group = |test: Test| {
        Fields::new()
            .with("statistic", test.statistic)
            .with("p", test.p)
    };
    rows.row(
        Row::other("random-block")
            .field("test", name)
            .field("mean_difference", (a.mean - b.mean) / b.mean)
            .field("means_t", group(means))
            .field("variance_ratio", (a.deviation / b.deviation).powi(2))
            .field("variances_F", group(variances)),
    )?;
    Ok(())
}
