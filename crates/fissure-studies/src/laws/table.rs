//! The table of laws: a row of counts and figures per law.

use std::time::Instant;

use fissure_laws::{NAMES, Space};

use fissure_study::{Overrides, Parameter, Parameters, Permitted, Report, Row, Study, StudyError};

use super::chosen::{self, Chosen};

/// The study `laws`.
pub struct LawTable;

/// Updates of the small form.
const QUICK_UPDATES: u64 = 20_000;
/// Paths to failure of the small form.
const QUICK_PATHS: u64 = 50;

impl Study for LawTable {
    fn name(&self) -> &'static str {
        "laws"
    }

    fn about(&self) -> &'static str {
        "every law through random updates of 1e-12 to 10 strain: errors, energies, tangents, speed, bytes"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = chosen::parameters(NAMES[0]);
        parameters.push(Parameter::count(
            "updates",
            "asked of each law",
            10_000_000,
            Permitted::counts(1..),
        ));
        parameters.push(Parameter::count(
            "paths",
            "of loading and unloading to failure, for the energy",
            1000,
            Permitted::counts(1..),
        ));
        parameters.push(Parameter::count(
            "seed",
            "of the random walks",
            1,
            Permitted::counts(..),
        ));
        parameters
    }

    fn default_cases(&self, _: &Overrides, quick: bool) -> Vec<Overrides> {
        let all = Overrides::new()
            .sweep("law", NAMES.iter().copied())
            .sweep("space", Space::NAMES.iter().copied());
        if quick {
            vec![all.set("updates", QUICK_UPDATES).set("paths", QUICK_PATHS)]
        } else {
            vec![all]
        }
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        for case in chosen::offered(cases)? {
            let (row, remarks) = row(case)?;
            report.row(row)?;
            for remark in remarks {
                report.progress(&remark);
            }
        }
        Ok(())
    }
}

/// Tangents further off than this are told of, with the update and the state.
const TANGENT_TOLD: f64 = 1e-5;

/// The row of a law, the first update that did what must not happen, and the one whose tangent is furthest off.
fn row(case: &Parameters) -> Result<(Row, Vec<String>), StudyError> {
    let chosen = Chosen::of(case)?;
    let (updates, seed) = (case.count("updates")?, case.count("seed")?);
    let law = &chosen.law;
    // Timed first, while the machine is as it was for the others.
    let speed = law.speed(seed);
    let start = Instant::now();
    let fuzzed = law.fuzz(updates, seed);
    let wall_s = start.elapsed().as_secs_f64();
    let (size, sparse) = law.state_size();
    let [undamaged, cracked] = fissure::scene::state_bytes(size, sparse);
    let row = Row::other("laws")
        .field("law", chosen.name())
        .field("updates", fuzzed.updates)
        .field("typed_errors", fuzzed.typed_errors)
        .field("not_finite", fuzzed.not_finite)
        .field("panics", fuzzed.panics)
        .field("negative_dissipation", fuzzed.negative_dissipation)
        .field(
            "irreversibility_violations",
            fuzzed.irreversibility_violations,
        )
        .field(
            "energy_error_max",
            law.energy_error(case.size("paths")?, seed),
        )
        .field("tangent_error_max", fuzzed.tangent_error)
        .field("tangent", fuzzed.tangent())
        .field("ratio_to_elastic", speed.undamaged)
        .field("bytes_undamaged", undamaged)
        .field("bytes_cracked", cracked)
        .field("ratio_damaging", speed.damaging)
        .field("ratio_damaging_plane", speed.damaging_plane)
        .field("sound", fuzzed.sound)
        .field("typed_errors_elsewhere", fuzzed.typed_errors_elsewhere)
        .field("cracked", fuzzed.cracked)
        .field("failed", fuzzed.failed)
        .field("most_cracks", fuzzed.most_cracks)
        .field("tangents", fuzzed.tangents)
        .field("tangents_numerical", fuzzed.numerical_tangents)
        .field("wall_s", wall_s)
        .parameters(case);
    let worst = fuzzed
        .worst_tangent
        .filter(|_| fuzzed.tangent_error > TANGENT_TOLD);
    Ok((row, fuzzed.first.into_iter().chain(worst).collect()))
}
