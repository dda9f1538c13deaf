//! Samples on file, so that a study that was cut off goes on where it was.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use fissure_study::{Parameters, StudyError};

use super::block::Sample;

/// One line per finished sample in `samples.txt` of the output folder: its parameters and seed, a
/// tab, and the numbers.
pub(super) struct Samples {
    path: PathBuf,
    file: File,
    known: Vec<(String, Sample)>,
}

impl Samples {
    /// Opens the file of a folder and reads what is there. A line that was cut off is left out.
    pub(super) fn open(folder: &Path) -> Result<Self, StudyError> {
        let path = folder.join("samples.txt");
        let failed = || StudyError::failed(format!("opening {}", path.display()));
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(failed()(error)),
        };
        let known: Vec<(String, Sample)> = text.lines().filter_map(read).collect();
        let mut file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(&path)
            .map_err(failed())?;
        if !text.is_empty() && !text.ends_with('\n') {
            writeln!(file).map_err(failed())?;
        }
        Ok(Self { path, file, known })
    }

    /// A sample that was finished before.
    pub(super) fn find(&self, case: &Parameters, seed: u64) -> Option<Sample> {
        let key = key(case, seed);
        let found = self.known.iter().find(|(known, _)| *known == key)?;
        Some(found.1.clone())
    }

    /// Adds a finished sample.
    pub(super) fn add(
        &mut self,
        case: &Parameters,
        seed: u64,
        sample: &Sample,
    ) -> Result<(), StudyError> {
        let line = format!("{}\t{}", key(case, seed), numbers(sample));
        writeln!(self.file, "{line}")
            .and_then(|()| self.file.flush())
            .map_err(StudyError::failed(format!(
                "writing {}",
                self.path.display()
            )))
    }
}

/// What a sample depends on: every parameter but the number of samples and of threads.
fn key(case: &Parameters, seed: u64) -> String {
    let parts: Vec<String> = case
        .iter()
        .filter(|(name, _)| !matches!(*name, "samples" | "threads"))
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    format!("{} seed={seed}", parts.join(" "))
}

fn numbers(sample: &Sample) -> String {
    let mut numbers = vec![
        sample.strength,
        sample.strain,
        sample.wall_s,
        sample.particles as f64,
        sample.steps as f64,
        sample.energy_imbalance,
        sample.worst_balance,
        sample.transfer_loss,
        sample.reached,
    ];
    let points = sample.curve.iter().flatten();
    numbers.extend(points);
    let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
    format!("{} {}", texts.len(), texts.join(" "))
}

fn read(line: &str) -> Option<(String, Sample)> {
    let (key, rest) = line.split_once('\t')?;
    let (count, rest) = rest.split_once(' ')?;
    let numbers: Vec<f64> = rest
        .split(' ')
        .map(str::parse)
        .collect::<Result<_, _>>()
        .ok()?;
    if numbers.len() != count.parse::<usize>().ok()? || numbers.len() < 9 {
        return None;
    }
    let (values, points) = numbers.split_at(9);
    let sample = Sample {
        strength: values[0],
        strain: values[1],
        wall_s: values[2],
        particles: values[3] as u64,
        steps: values[4] as u64,
        energy_imbalance: values[5],
        worst_balance: values[6],
        transfer_loss: values[7],
        reached: values[8],
        curve: points.chunks_exact(2).map(|p| [p[0], p[1]]).collect(),
        snapshots: Vec::new(),
    };
    Some((key.to_owned(), sample))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_comes_back_and_half_a_line_does_not() {
        let sample = Sample {
            strength: 9.25e6,
            strain: 0.1 + 0.2,
            steps: 17,
            curve: vec![[1e-3, 1.0 / 3.0]],
            ..Sample::default()
        };
        let line = format!("h=1 seed=2\t{}", numbers(&sample));
        let (key, back) = read(&line).unwrap();
        assert_eq!(key, "h=1 seed=2");
        assert_eq!(
            (back.strength, back.strain),
            (sample.strength, sample.strain)
        );
        assert_eq!((back.steps, back.curve), (17, sample.curve));
        assert!(read(&line[..line.len() - 19]).is_none());
    }
}
