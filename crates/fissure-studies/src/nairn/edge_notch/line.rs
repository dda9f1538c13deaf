//! The crack as a line that grows where J reaches the toughness.

use fissure_study::{Parameters, StudyError};

use super::growth::Growth;
use super::run::{Finished, Seen, row_of};
use crate::nairn::drive::drive_growing;
use crate::nairn::numerics::Numerics;
use crate::nairn::plate::{Notch, Plate};
use crate::nairn::tips::Tips;

pub(super) fn pull(case: &Parameters, drawing: bool) -> Result<Finished, StudyError> {
    let numerics = Numerics::of(case)?;
    let plate = Plate::new(case, Notch::Line)?;
    let end = case.number("end")?;
    let mut scene = plate.elastic()?;
    let mut solver = numerics.solver(plate.grid(end)?)?;
    let mut tips = Tips::of(case, &plate)?;
    let (mut growth, mut seen) = (Growth::default(), Seen::default());
    let through = plate.width - 2.0 * plate.spacing;
    let done = drive_growing(&mut scene, solver.as_mut(), end, |scene, report| {
        let mut tip = f64::NAN;
        for grown in tips.ask(scene)? {
            tip = grown.tip.x;
            growth.push(report.time, tip);
        }
        if drawing {
            seen.look(&plate, scene);
        }
        Ok(!(tip > through))
    })?;
    let row = row_of(case, &plate, &scene, &growth, &done)?;
    Ok(Finished {
        row,
        growth,
        seen,
        stopped: done.stopped,
    })
}
