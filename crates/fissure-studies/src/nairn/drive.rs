//! The loop that runs a scene, and what its ledger says at the end.

use std::time::Instant;

use fissure::diagnostics::{EnergyBalance, state_hash};
use fissure::prelude::*;
use fissure_study::{Measures, Parameters, SimulationRow, StudyError};

/// How a run went.
#[derive(Clone, Debug)]
pub(super) struct Drive {
    pub wall_s: f64,
    /// Why it ended before its time.
    pub stopped: Option<String>,
}

/// Steps a scene to `end`, s, and calls `after` after each step until it says to stop.
///
/// An error after the first step is a result, not the study's failure: which numerics break down,
/// and when, is asked of the studies.
pub(super) fn drive<const D: usize>(
    scene: &mut Scene<D>,
    solver: &mut dyn Solver<D>,
    end: f64,
    mut after: impl FnMut(&Scene<D>, &Report<D>) -> bool,
) -> Result<Drive, StudyError> {
    drive_growing(scene, solver, end, |scene, report| Ok(after(scene, report)))
}

/// The same for a scene whose cracks may grow after a step; if that cannot be decided the run ends.
pub(super) fn drive_growing<const D: usize>(
    scene: &mut Scene<D>,
    solver: &mut dyn Solver<D>,
    end: f64,
    mut after: impl FnMut(&mut Scene<D>, &Report<D>) -> Result<bool, GrowthError>,
) -> Result<Drive, StudyError> {
    let start = Instant::now();
    let mut stopped = None;
    while scene.time() < end {
        match solver.step(scene, end) {
            Ok(report) => match after(scene, &report) {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) => {
                    stopped = Some(error.to_string());
                    break;
                }
            },
            Err(error) if scene.step() == 0 => {
                return Err(StudyError::failed("taking the first step")(error));
            }
            Err(error) => {
                stopped = Some(error.to_string());
                break;
            }
        }
    }
    Ok(Drive {
        wall_s: start.elapsed().as_secs_f64(),
        stopped,
    })
}

/// A row with what every run of these studies reports.
pub(super) fn row<const D: usize>(
    study: &str,
    case: &Parameters,
    scene: &Scene<D>,
    drive: &Drive,
) -> SimulationRow {
    let mut row = SimulationRow::new(study, case);
    row.solver = "explicit".to_owned();
    row.particles = scene.particle_count() as u64;
    row.steps = scene.step();
    row.wall_s = drive.wall_s;
    row.state_hash = state_hash(scene);
    row
}

/// Dissipation, and the errors of the ledger over its largest term: of the laws' integration
/// (`energy_imbalance`), of the grid's steps (`worst_balance`), of the transfer (`transfer_loss`),
/// and what of the external work is nowhere (`lost`, the sum of the first and the last).
pub(super) fn energies<const D: usize>(measures: Measures, scene: &Scene<D>) -> Measures {
    let balance = EnergyBalance::of(scene.energy());
    measures
        .with("dissipated", balance.dissipated)
        .with("energy_imbalance", balance.energy_imbalance())
        .with("worst_balance", balance.worst_balance)
        .with("transfer_loss", balance.relative_transfer_loss())
        .with(
            "lost",
            balance.energy_imbalance() + balance.relative_transfer_loss(),
        )
}
