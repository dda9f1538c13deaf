//! A crack at rest that a step of stress reaches.
//!
//! Plane waves from both ends of the plate, each a step of height σ, meet on the crack's plane, where they would leave the
//! stress 2σ. Until waves from the crack's other tip or the walls are back at the tip, it is that of a half-infinite crack
//! the faces of which are suddenly pulled by 2σ: `K_I(t) = 2 (2σ) √(c t (1 − 2ν)/π)/(1 − ν)` with the speed c of fast
//! waves and the time t since they met [Freund 1990, sec. 2.5].

use std::f64::consts::PI;
use std::time::Instant;

use fissure::diagnostics::MeasureError;
use fissure::diagnostics::fracture::{
    Annulus, Contours, Intensity, Rates, TipField, TipFrame, contours, interaction,
};
use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use super::plates::{mouth, pull};
use super::{BODY, CRACK, ELASTIC, STEEL, STRESS, upright_stress};
use crate::method::Method;
use crate::problem::{History, Outcome};

/// Between which ways of the wave past the crack K is compared, over its length: later it is back from the other tip.
const WINDOW: [f64; 2] = [0.2, 1.7];
/// Radii of the domains of J over that of K's.
const WIDER: [f64; 3] = [1.0, 1.4, 1.75];
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
    let (mut asked, mut errors) = (0.0, Errors::default());
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
            let now = Measured::of(&mut rates, &scene, 0.4 * CRACK)
                .map_err(StudyError::failed("measuring the tip"))?;
            samples.push([(time - met) * wave / a, now.k.k1, exact(time)]);
            errors.add(&now, exact(time));
            found = (now.k.k1, exact(time));
        }
        rates
            .look(&scene, BODY)
            .map_err(StudyError::failed("looking at the plate"))?;
    }
    let mut outcome = Outcome::of(scene, start.elapsed().as_secs_f64());
    errors.over(exact(last), &mut outcome);
    outcome.values.insert("k1", found.0);
    outcome.values.insert("k1_exact", found.1);
    outcome.values.insert("a_over_h", CRACK / h);
    outcome.history = Some(History {
        x_label: "way of the wave past the crack over its length [1]",
        y_label: "K_I [Pa √m]",
        samples,
    });
    outcome.field = Some(upright_stress(&outcome.scene));
    Ok(outcome)
}

/// Intensities, and J over three domains, with inertia.
struct Measured {
    k: Intensity,
    j: Contours,
}

impl Measured {
    /// Intensities over domains of this radius, m, J over wider ones too.
    fn of(rates: &mut Rates, scene: &Scene<2>, radius: f64) -> Result<Self, MeasureError> {
        rates.look(scene, BODY)?;
        let tip = TipFrame::of(&scene.cracks()[0], End::Last);
        let most = WIDER[WIDER.len() - 1] * radius;
        let field = TipField::of(scene, BODY, &tip.position, most, &ELASTIC, Some(rates))?;
        let domains = WIDER.map(|times| Annulus {
            inner: 0.4 * times * radius,
            outer: times * radius,
        });
        Ok(Self {
            k: interaction(&field, &tip, &domains[0], &ELASTIC)?,
            j: contours(&field, &tip, &domains)?,
        })
    }
}

/// Sums of squares over the window.
#[derive(Default)]
struct Errors {
    k1: f64,
    k2: f64,
    j: f64,
    spread: f64,
    count: f64,
}

impl Errors {
    fn add(&mut self, now: &Measured, exact: f64) {
        self.k1 += (now.k.k1 - exact).powi(2);
        self.k2 += now.k.k2.powi(2);
        self.j += (now.j.mean - ELASTIC.energy_release(exact, 0.0)).powi(2);
        self.spread += (now.j.spread * now.j.mean).powi(2);
        self.count += 1.0;
    }

    /// Roots of the means, over the last K and J.
    fn over(&self, last: f64, outcome: &mut Outcome) {
        let root = |square: f64, scale: f64| (square / self.count).sqrt() / scale;
        let release = ELASTIC.energy_release(last, 0.0);
        for (name, square, scale) in [
            ("k1", self.k1, last),
            ("k2", self.k2, last),
            ("j", self.j, release),
        ] {
            outcome.errors.insert(name, root(square, scale));
        }
        let spread = root(self.spread, release);
        outcome.values.insert("contour_spread", spread);
    }
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
