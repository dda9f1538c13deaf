//! Stress intensities of cracks as lines (A2, A3, A4, A7), with tips anywhere in a cell.
//!
//! | case | plate | K_I, K_II |
//! |---|---|---|
//! | `centre` | half of a plate with the crack 2a in its middle, twice as high as wide, a/W about 1/2 | σ√(πa) F, F = (1 − 0.025 λ² + 0.06 λ⁴) √sec(πλ/2) [Tada] |
//! | `edge` | the same plate with the crack from its side | F = 1.12 − 0.231 λ + 10.55 λ² − 21.72 λ³ + 30.39 λ⁴ [Tada], λ ≤ 0.6, long strip |
//! | `centre-square`, `edge-square` | half and whole of square plates with a/W = 1/2: NAFEMS R0020, tests 1.1 and 2.1 | σ√(πa) F, F = 1.325 and 3.0 |
//! | `inclined` | a square plate of twenty crack lengths a, the crack 2a turned by `angle` | σ√(πa) (cos² β, sin β cos β), infinite plate |
//! | `cantilever` | a double cantilever beam, arms of height a/10 | G = 12 P²(a + 0.67 H)²/(E′H³) and the opening 8 P (a + 0.67 H)³/(E′H³) |
//!
//! | `sneddon` | `inclined` with the normal along the load | opening `4 σ √(a² − x²)/E′`, volume `2 π σ a²/E′` [Sneddon] |
//! | `closed` | `inclined` under pressure, faces with `friction` μ | 0, −σ√(πa) (sin β cos β − μ cos² β), 0 if that is negative |
//! | `step` | `centre` between smooth walls when steps of stress from both ends reach it (explicit) | 4 σ √(c t (1 − 2ν)/π)/(1 − ν) [Freund 1990] |
//!
//! J is compared with (K_I² + K_II²)/E′ of the exact intensities; `contour_spread` is how far three domains differ. Of closed faces, which are loaded, K is read from
//! their opening and sliding, J is that of these, and errors are over K and J of the open crack. `a_over_h` is of the nominal half length a, without the part of a cell.

mod plates;
mod step;

use std::f64::consts::PI;

use fissure::diagnostics::MeasureError;
use fissure::diagnostics::fracture::{
    Annulus, FaceJump, PlaneElastic, TipField, TipFrame, contours, interaction, opening_intensity,
    opening_profile,
};
use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use crate::method::{self, Method};
use crate::problem::{History, Outcome, Problem, run_to};

use self::plates::plate;

/// The study `stress-intensity`.
pub struct StressIntensity;

/// Half length of the crack but for what the tip lies inside a cell, m.
const CRACK: f64 = 0.05;
const STEEL: Isotropic = Isotropic {
    density: 7800.0,
    young: 207e9,
    poisson: 0.3,
};
const ELASTIC: PlaneElastic = PlaneElastic {
    young: STEEL.young,
    poisson: STEEL.poisson,
    plane_stress: false,
};
/// Far stress, Pa; in the cantilever, times `load`, the load per thickness over a.
const STRESS: f64 = 1e6;
/// Arms of the cantilever over the crack length.
const ARM: f64 = 0.1;
/// From where on the field around a tip is used, in cells.
const NEAREST: f64 = 4.0;
const BODY: &str = "plate";

/// A plate with its crack, and what it should give.
struct Plate {
    scene: Scene<2>,
    low: [f64; 2],
    high: [f64; 2],
    /// Exact K_I and K_II, Pa √m.
    k: [f64; 2],
    /// Radius that domains around the tip may have, m.
    radius: f64,
}

impl Problem for StressIntensity {
    fn name(&self) -> &'static str {
        "stress-intensity"
    }

    fn about(&self) -> &'static str {
        "stress intensities and J of cracks as lines, tips anywhere in a cell: errors and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let spacings = [25.0, 50.0].map(|cells| CRACK / cells);
        let mut parameters = method::parameters(&spacings, &["quasi-static", "explicit"]);
        for parameter in &mut parameters {
            match parameter.name {
                // Strains are of 1e-5: what finite strain adds to the residual is no concern.
                "tolerance" => parameter.default = vec![1e-6.into()],
                "transfer" => parameter.default = vec!["xpic".into()],
                "order" => parameter.default = vec![2_u64.into()],
                _ => {}
            }
        }
        parameters.extend([
            Parameter::choice(
                "case",
                "plate",
                "centre",
                &[
                    "centre",
                    "edge",
                    "centre-square",
                    "edge-square",
                    "inclined",
                    "cantilever",
                    "sneddon",
                    "closed",
                    "step",
                ],
            )
            .selecting(),
            Parameter::number(
                "part",
                "where in its cell the tip lies",
                "cells",
                0.5,
                Permitted::numbers(0.0..=1.0),
            ),
            Parameter::number(
                "angle",
                "of the inclined crack's normal to the load",
                "deg",
                45.0,
                Permitted::numbers(0.0..=80.0),
            ),
            Parameter::number(
                "load",
                "of the cantilever; with 1 its opening is 43 % of an arm's height",
                "1",
                0.01,
                Permitted::above(0.0),
            ),
            Parameter::number(
                "friction",
                "between the faces that are pressed together",
                "1",
                0.0,
                Permitted::at_least(0.0),
            ),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = |cells: &[f64]| cells.iter().map(|cells| CRACK / cells).collect::<Vec<_>>();
        if quick {
            let coarse = || Overrides::new().set("h", CRACK / 12.5);
            let tips = coarse().sweep("part", [0.0, 0.25, 0.75]);
            let closed = Overrides::new().set("h", CRACK / 8.0).set("case", "closed");
            return vec![
                tips,
                closed.sweep("friction", [0.0, 0.3]),
                coarse().set("case", "step").set("solver", "explicit"),
            ];
        }
        let tips = [0.0, 0.25, 0.5, 0.75];
        let all = |case: &'static str, cells: &[f64]| {
            Overrides::new()
                .set("case", case)
                .sweep("h", spacings(cells))
        };
        vec![
            all("centre", &[12.5, 25.0, 50.0]).sweep("part", tips),
            all("edge", &[12.5, 25.0, 50.0]).sweep("part", tips),
            all("centre-square", &[25.0, 50.0]),
            all("edge-square", &[25.0, 50.0]),
            all("inclined", &[12.5, 25.0]).sweep("angle", [22.5, 45.0, 67.5]),
            all("cantilever", &[100.0, 160.0]).sweep("part", tips),
            all("sneddon", &[12.5, 25.0]),
            all("closed", &[12.5, 25.0]).sweep("friction", [0.0, 0.3, 0.6]),
            all("step", &[25.0, 50.0]).set("solver", "explicit"),
            Overrides::new()
                .set("h", CRACK / 12.5)
                .set("solver", "explicit")
                .sweep("case", ["centre", "edge"]),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "k1"
    }

    fn alike(&self) -> &'static [&'static str] {
        &["part", "angle", "friction"]
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        if case.choice("case")? == "step" {
            return step::simulate(case, method);
        }
        // Waves run through the plate at about 5.8 km/s: a load that grows slowly and smoothly makes next to none. With a
        // crack from its side the halves of the plate swing about its ligament too, once in about a millisecond.
        let (ramp, end) = match (method.is_dynamic(), case.choice("case")?) {
            (false, _) => (1.0, 1.0),
            (true, "edge" | "edge-square") => (1.6e-3, 1.9e-3),
            (true, _) => (6e-4, 8e-4),
        };
        let load = move |t: f64| {
            let part = (t / ramp).min(1.0);
            part.powi(3) * (10.0 - 15.0 * part + 6.0 * part * part)
        };
        let plate = plate(case, h, load).map_err(StudyError::failed("building the plate"))?;
        let margin = 4.0 * h;
        let grid = Grid::over(
            plate.low.map(|x| x - margin),
            plate.high.map(|x| x + margin),
            h,
        )
        .map_err(StudyError::failed("making the grid"))?;
        let mut solver = method.build(grid, BandSource::default(), end)?;
        let mut scene = plate.scene;
        let wall_s = run_to(&mut scene, &mut *solver, end, case)?;
        let mut outcome = Outcome::of(scene, wall_s);
        match case.choice("case")? {
            "closed" => from_faces(&mut outcome, plate.k),
            _ => measure(&mut outcome, plate.k, plate.radius, h),
        }
        .map_err(StudyError::failed("measuring the tip"))?;
        let tip = TipFrame::of(&outcome.scene.cracks()[0], End::Last);
        outcome.values.insert("a_over_h", CRACK / h);
        outcome.values.insert("tip_x", tip.position.x);
        if case.choice("case")? == "cantilever" {
            opening(&mut outcome, h, case.number("load")?);
        }
        if case.choice("case")? == "sneddon" {
            profile(&mut outcome);
        }
        outcome.field = Some(upright_stress(&outcome.scene));
        Ok(outcome)
    }
}

/// What pictures show: the stress along the load, cut off near the tip so that it can be seen elsewhere.
fn upright_stress(scene: &Scene<2>) -> (&'static str, Vec<f64>) {
    let stress = scene.bodies()[0].motion().stress;
    let shown = stress.iter().map(|s| (s.yy() / STRESS).clamp(-2.0, 3.0));
    (
        "σ_yy over the far stress, from -2 to 3 [1]",
        shown.collect(),
    )
}

/// Intensities, J and how far J depends on the domain.
fn measure(
    outcome: &mut Outcome,
    exact: [f64; 2],
    radius: f64,
    h: f64,
) -> Result<(), MeasureError> {
    let scene = &outcome.scene;
    let tip = TipFrame::of(&scene.cracks()[0], End::Last);
    let field = TipField::of(scene, BODY, &tip.position, radius, &ELASTIC, None)?;
    let annulus = |inner: f64, outer: f64| Annulus {
        inner: inner * radius,
        outer: outer * radius,
    };
    // Within four cells of the tip the field is that of the grid.
    let inner = (NEAREST * h / radius).clamp(0.25, 0.5);
    let domains = [annulus(inner, 0.7), annulus(inner, 0.85), annulus(0.5, 1.0)];
    let found = interaction(&field, &tip, &annulus(0.4, 0.85), &ELASTIC)?;
    let j = contours(&field, &tip, &domains)?;
    let scale = exact[0].hypot(exact[1]);
    let exact_j = ELASTIC.energy_release(exact[0], exact[1]);
    outcome
        .errors
        .insert("k1", ((found.k1 - exact[0]) / scale).abs());
    outcome
        .errors
        .insert("k2", ((found.k2 - exact[1]) / scale).abs());
    outcome.errors.insert("j", (j.mean / exact_j - 1.0).abs());
    outcome.values.insert("k1", found.k1);
    outcome.values.insert("k2", found.k2);
    outcome.values.insert("k1_exact", exact[0]);
    outcome.values.insert("k2_exact", exact[1]);
    outcome.values.insert("contour_spread", j.spread);
    Ok(())
}

/// Error of the cantilever's opening at its loaded end.
fn opening(outcome: &mut Outcome, h: f64, load: f64) {
    let particles = outcome.scene.bodies()[0].particles();
    let height = ARM * CRACK;
    let (mut above, mut below) = (Vec::new(), Vec::new());
    for x in &particles.motion.position {
        if x.x < 0.5 * h {
            if x.y > 0.0 {
                above.push(x.y)
            } else {
                below.push(x.y)
            }
        }
    }
    let mean = |places: &[f64]| places.iter().sum::<f64>() / places.len() as f64;
    let open = mean(&above) - mean(&below) - height;
    let length = tip_of(&outcome.scene) + 0.67 * height - 0.25 * h;
    let exact = 8.0 * load * STRESS * CRACK * length.powi(3)
        / (ELASTIC.effective_modulus() * height.powi(3));
    outcome.errors.insert("opening", (open / exact - 1.0).abs());
}

fn tip_of(scene: &Scene<2>) -> f64 {
    scene.cracks()[0].tip(End::Last).0.x
}

/// Intensities from what the faces do behind the tip, of faces that are loaded.
fn from_faces(outcome: &mut Outcome, exact: [f64; 2]) -> Result<(), MeasureError> {
    let crack = &outcome.scene.cracks()[0];
    let half = 0.5 * crack.line().length();
    let jumps = opening_profile(crack, End::Last);
    let near = |jump: &&FaceJump| (0.08..0.3).contains(&(jump.distance / half));
    let places: Vec<FaceJump> = jumps.iter().filter(near).copied().collect();
    let found = opening_intensity(&places, 0.0, &ELASTIC)?;
    let scale = STRESS * (PI * half).sqrt();
    for (name, found, exact) in [("k1", found.k1, exact[0]), ("k2", found.k2, exact[1])] {
        outcome.errors.insert(name, ((found - exact) / scale).abs());
        outcome.values.insert(name, found);
        outcome.values.insert(format!("{name}_exact"), exact);
    }
    // Closed faces that stick have no J to be compared with: over that of the open crack.
    let [found, exact] = [[found.k1, found.k2], exact].map(|k| ELASTIC.energy_release(k[0], k[1]));
    let scale = ELASTIC.energy_release(scale, 0.0);
    outcome.errors.insert("j", ((found - exact) / scale).abs());
    Ok(())
}

/// Errors of the opening of a crack that stress pulls open, and of its volume.
fn profile(outcome: &mut Outcome) {
    let crack = &outcome.scene.cracks()[0];
    let half = 0.5 * crack.line().length();
    let most = 4.0 * STRESS / ELASTIC.effective_modulus();
    let jumps = opening_profile(crack, End::Last);
    let (mut square, mut scale, mut volume) = (0.0, 0.0, 0.0);
    let mut samples = Vec::new();
    for jump in &jumps {
        let x = jump.distance - half;
        let exact = most * (half * half - x * x).max(0.0).sqrt();
        square += (jump.opening - exact).powi(2);
        scale += exact * exact;
        samples.push([x / half, jump.opening, exact]);
    }
    for pair in jumps.windows(2) {
        volume += 0.5 * (pair[0].opening + pair[1].opening) * (pair[1].distance - pair[0].distance);
    }
    let exact_volume = 0.5 * PI * most * half * half;
    outcome.errors.insert("opening", (square / scale).sqrt());
    outcome.history = Some(History {
        x_label: "place over half the length of the crack [1]",
        y_label: "opening [m]",
        samples,
    });
    outcome
        .errors
        .insert("volume", (volume / exact_volume - 1.0).abs());
}
