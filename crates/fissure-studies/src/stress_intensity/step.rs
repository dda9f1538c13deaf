//! A crack at rest that a step of stress reaches.
//!
//! Plane waves from both ends of the plate, each a step of height σ, meet on the crack's plane, where they would leave the
//! stress 2σ. Until waves from the crack's other tip or the walls are back at the tip, it is that of a half-infinite crack
//! the faces of which are suddenly pulled by 2σ: `K_I(t) = 2 (2σ) √(c t (1 − 2ν)/π)/(1 − ν)` with the speed c of fast
//! waves and the time t since they met [Freund 1990, sec. 2.5].

use std::f64::consts::PI;
use std::time::Instant;

use fissure::diagnostics::MeasureError;
use fissure::diagnostics::fracture::{Annulus, Rates, TipField, TipFrame, interaction};
use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use super::plates::{mouth, pull};
use super::{BODY, CRACK, ELASTIC, STEEL, STRESS};
use crate::method::Method;
use crate::problem::{History, Outcome};

/// Between which ways of the wave past the crack K is compared, over its length: later it is back from the other tip.
const WINDOW: [f64; 2] = [0.2, 1.7];
/// Questions over the window.
const QUESTIONS: f64 = 30.0;

pub(super) fn simulate(case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
    if !method.is_dynamic() {
        let reason = "a step of load is for the explicit solver";
        return Err(StudyError::combination(case, &["case", "solver"], reason));
    }
    let h = method.spacing;
    let a = CRACK + case.number("part")? * h;
    let (width, height) = (2.0 * CRACK, 2.0 * CRACK);
    let mut scene = scene(a, width, height, h).map_err(StudyError::failed("building the plate"))?;
    let margin = 4.0 * h;
    let (low, high) = (
        [-margin, -height - margin],
        [width + margin, height + margin],
    );
    let grid = Grid::over(low, high, h).map_err(StudyError::failed("making the grid"))?;
    let (e, nu) = (STEEL.young, STEEL.poisson);
    let wave = (e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu) * STEEL.density)).sqrt();
    let met = height / wave;
    let [first, last] = WINDOW.map(|share| met + share * a / wave);
    let mut solver = method.build(grid, BandSource::default(), last)?;
    let exact =
        |t: f64| 4.0 * STRESS / (1.0 - nu) * (wave * (t - met) * (1.0 - 2.0 * nu) / PI).sqrt();
    let (mut rates, start) = (Rates::default(), Instant::now());
    let (mut asked, mut square, mut count) = (0.0, 0.0, 0.0);
    let mut found = (f64::NAN, f64::NAN);
    let mut samples = Vec::new();
    while scene.time() < last {
        let before = scene.time();
        solver
            .step(&mut scene, last)
            .map_err(StudyError::failed("running the plate"))?;
        let due = before >= first && scene.time() >= asked;
        if due {
            asked = scene.time() + (last - first) / QUESTIONS;
            let time = 0.5 * (before + scene.time());
            let k1 = intensity(&mut rates, &scene, 0.4 * CRACK)
                .map_err(StudyError::failed("measuring the tip"))?;
            found = (k1, exact(time));
            samples.push([(time - met) * wave / a, k1, exact(time)]);
            square += (k1 - exact(time)).powi(2);
            count += 1.0;
        }
        rates
            .look(&scene, BODY)
            .map_err(StudyError::failed("looking at the plate"))?;
    }
    let mut outcome = Outcome::of(scene, start.elapsed().as_secs_f64());
    let scale = exact(last);
    outcome.errors.insert("k1", (square / count).sqrt() / scale);
    outcome.values.insert("k1", found.0);
    outcome.values.insert("k1_exact", found.1);
    outcome.values.insert("a_over_h", a / h);
    outcome.history = Some(History {
        x_label: "way of the wave past the crack over its length [1]",
        y_label: "K_I [Pa √m]",
        samples,
    });
    let stress = outcome.scene.bodies()[0].motion().stress;
    let field = stress.iter().map(|s| s.yy() / STRESS).collect();
    outcome.field = Some(("σ_yy over the step [1]", field));
    Ok(outcome)
}

fn intensity(rates: &mut Rates, scene: &Scene<2>, radius: f64) -> Result<f64, MeasureError> {
    rates.look(scene, BODY)?;
    let tip = TipFrame::of(&scene.cracks()[0], End::Last);
    let field = TipField::of(scene, BODY, &tip.position, radius, &ELASTIC, Some(rates))?;
    let annulus = Annulus {
        inner: 0.4 * radius,
        outer: radius,
    };
    Ok(interaction(&field, &tip, &annulus, &ELASTIC)?.k1)
}

fn scene(a: f64, width: f64, height: f64, h: f64) -> Result<Scene<2>, SceneError> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = Block::new([0.0, -height], [width, height]);
    let smooth = Hold::Component(Vector2::x());
    let side = move |x: &Vector2<f64>| x.x < 0.5 * h || x.x > width - 0.5 * h;
    scene
        .fill(BODY, STEEL, &block, &Spacing(0.5 * h))?
        .crack("crack", &[[-h, 0.0], [a, 0.0]], mouth())?
        .hold("sides", BODY, side, smooth, Constant(0.0))?;
    pull(&mut scene, width, height, h, |_| 1.0)?;
    Ok(scene)
}
