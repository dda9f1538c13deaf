//! Stress intensities of cracks as lines (A2, A3, A4, A7), with tips anywhere in a cell.
//!
//! | case | plate | K_I, K_II |
//! |---|---|---|
//! | `centre` | half of a plate with the crack 2a in its middle, twice as high as wide, a/W about 1/2 | σ√(πa) F, F = (1 − 0.025 λ² + 0.06 λ⁴) √sec(πλ/2) [Tada] |
//! | `edge` | the same plate with the crack from its side | F = 1.12 − 0.231 λ + 10.55 λ² − 21.72 λ³ + 30.39 λ⁴ [Tada], λ ≤ 0.6, long strip |
//! | `inclined` | a square plate of twelve crack lengths a, the crack 2a turned by `angle` | σ√(πa) (cos² β, sin β cos β), infinite plate |
//! | `cantilever` | a double cantilever beam, arms of height a/10 | G = 12 P²(a + 0.67 H)²/(E′H³) and the opening 8 P (a + 0.67 H)³/(E′H³) |
//!
//! J is compared with (K_I² + K_II²)/E′ of the exact intensities; `contour_spread` is how far three domains differ.

use std::f64::consts::PI;

use fissure::diagnostics::MeasureError;
use fissure::diagnostics::fracture::{
    Annulus, PlaneElastic, TipField, TipFrame, contours, interaction,
};
use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use crate::method::{self, Method};
use crate::problem::{Outcome, Problem, run_to};

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
/// Far stress, Pa; in the cantilever the load per thickness over a.
const STRESS: f64 = 1e6;
/// Arms of the cantilever over the crack length.
const ARM: f64 = 0.1;
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
                &["centre", "edge", "inclined", "cantilever"],
            ),
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
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = |cells: &[f64]| cells.iter().map(|cells| CRACK / cells).collect::<Vec<_>>();
        if quick {
            return vec![Overrides::new().set("h", CRACK / 12.5)];
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
            all("inclined", &[12.5, 25.0]).sweep("angle", [22.5, 45.0, 67.5]),
            all("cantilever", &[100.0, 160.0]),
            Overrides::new()
                .set("h", CRACK / 12.5)
                .set("solver", "explicit"),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "k1"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        // Waves run through the plate at about 5.8 km/s: slow loads let them die out.
        let (ramp, end) = if method.is_dynamic() {
            (4e-4, 8e-4)
        } else {
            (1.0, 1.0)
        };
        let load = move |t: f64| (t / ramp).min(1.0);
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
        measure(&mut outcome, plate.k, plate.radius)
            .map_err(StudyError::failed("measuring the tip"))?;
        let tip = TipFrame::of(&outcome.scene.cracks()[0], End::Last);
        outcome.values.insert("a_over_h", CRACK / h);
        outcome.values.insert("tip_x", tip.position.x);
        if case.choice("case")? == "cantilever" {
            opening(&mut outcome, h);
        }
        let stress = outcome.scene.bodies()[0].motion().stress;
        let field = stress.iter().map(|s| s.yy() / STRESS).collect();
        outcome.field = Some(("σ_yy over the far stress [1]", field));
        Ok(outcome)
    }
}

/// Intensities, J and how far J depends on the domain.
fn measure(outcome: &mut Outcome, exact: [f64; 2], radius: f64) -> Result<(), MeasureError> {
    let scene = &outcome.scene;
    let tip = TipFrame::of(&scene.cracks()[0], End::Last);
    let field = TipField::of(scene, BODY, &tip.position, radius, &ELASTIC, None)?;
    let annulus = |inner: f64, outer: f64| Annulus {
        inner: inner * radius,
        outer: outer * radius,
    };
    let domains = [annulus(0.25, 0.7), annulus(0.4, 0.85), annulus(0.5, 1.0)];
    let found = interaction(&field, &tip, &domains[1], &ELASTIC)?;
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
fn opening(outcome: &mut Outcome, h: f64) {
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
    let exact =
        8.0 * STRESS * CRACK * length.powi(3) / (ELASTIC.effective_modulus() * height.powi(3));
    outcome.errors.insert("opening", (open / exact - 1.0).abs());
}

fn tip_of(scene: &Scene<2>) -> f64 {
    scene.cracks()[0].tip(End::Last).0.x
}

fn plate(
    case: &Parameters,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, Box<dyn std::error::Error + Send + Sync>> {
    let a = CRACK + case.number("part")? * h;
    match case.choice("case")? {
        "inclined" => Ok(inclined(a, case.number("angle")?.to_radians(), h, load)?),
        "cantilever" => Ok(cantilever(a, h, load)?),
        other => Ok(upright(other == "centre", a, h, load)?),
    }
}

fn mouth() -> CrackSettings {
    CrackSettings {
        first: EndState::Mouth,
        ..CrackSettings::default()
    }
}

/// The plates with a crack along x from the left side, which is a plane of symmetry for `centre`.
fn upright(
    centre: bool,
    a: f64,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, SceneError> {
    let (width, height) = (2.0 * CRACK, 4.0 * CRACK);
    let (low, high) = ([0.0, -height], [width, height]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene.fill(BODY, STEEL, &Block::new(low, high), &Spacing(0.5 * h))?;
    scene.crack("crack", &[[-h, 0.0], [a, 0.0]], mouth())?;
    pull(&mut scene, width, height, h, load)?;
    let ratio = a / width;
    let form = if centre {
        scene.hold(
            "symmetry",
            BODY,
            move |x| x.x < 0.5 * h,
            Hold::Component(Vector2::x()),
            Constant(0.0),
        )?;
        (1.0 - 0.025 * ratio.powi(2) + 0.06 * ratio.powi(4)) / (0.5 * PI * ratio).cos().sqrt()
    } else {
        1.12 - 0.231 * ratio + 10.55 * ratio.powi(2) - 21.72 * ratio.powi(3) + 30.39 * ratio.powi(4)
    };
    Ok(Plate {
        scene,
        low,
        high,
        k: [STRESS * (PI * a).sqrt() * form, 0.0],
        radius: 0.5 * CRACK,
    })
}

/// The square plate with a crack in its middle, the normal of which is turned from y by `angle`.
fn inclined(
    a: f64,
    angle: f64,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, SceneError> {
    let half = 6.0 * CRACK;
    let (low, high) = ([-half; 2], [half; 2]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let (sine, cosine) = angle.sin_cos();
    // Off the nodes, as the tips are.
    let middle = [0.31 * h, 0.17 * h];
    let end = |sign: f64| [middle[0] + sign * a * cosine, middle[1] + sign * a * sine];
    scene
        .fill(BODY, STEEL, &Block::new(low, high), &Spacing(0.5 * h))?
        .crack("crack", &[end(-1.0), end(1.0)], CrackSettings::default())?;
    pull(&mut scene, 2.0 * half, half, h, load)?;
    let k = STRESS * (PI * a).sqrt();
    Ok(Plate {
        scene,
        low,
        high,
        k: [k * cosine * cosine, k * sine * cosine],
        radius: 0.8 * CRACK,
    })
}

/// Loads on the top and the bottom row.
fn pull(
    scene: &mut Scene<2>,
    width: f64,
    height: f64,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<(), SceneError> {
    let top = move |x: &Vector2<f64>| x.y > height - 0.5 * h;
    let bottom = move |x: &Vector2<f64>| x.y < -height + 0.5 * h;
    let force = move |t: f64| Vector2::new(0.0, STRESS * width * load(t));
    scene
        .force("top", BODY, top, force)?
        .force("bottom", BODY, bottom, move |t| -force(t))?;
    Ok(())
}

/// Two arms, pulled apart at their ends.
fn cantilever(
    a: f64,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, SceneError> {
    let height = ARM * CRACK;
    let (low, high) = ([0.0, -height], [1.6 * CRACK, height]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let force = move |t: f64| Vector2::new(0.0, STRESS * CRACK * load(t));
    scene
        .fill(BODY, STEEL, &Block::new(low, high), &Spacing(0.5 * h))?
        .crack("crack", &[[-h, 0.0], [a, 0.0]], mouth())?
        .force("upper", BODY, move |x| x.x < 0.5 * h && x.y > 0.0, force)?
        .force(
            "lower",
            BODY,
            move |x| x.x < 0.5 * h && x.y < 0.0,
            move |t| -force(t),
        )?;
    // The loads act in the middle of the first column.
    let arm = a - 0.25 * h + 0.67 * height;
    let release =
        12.0 * (STRESS * CRACK * arm).powi(2) / (ELASTIC.effective_modulus() * height.powi(3));
    Ok(Plate {
        scene,
        low,
        high,
        k: [(release * ELASTIC.effective_modulus()).sqrt(), 0.0],
        radius: 0.9 * height,
    })
}
