//! The plates and their exact intensities.

use std::f64::consts::PI;

use fissure::prelude::*;
use fissure_study::Parameters;

use super::{ARM, BODY, CRACK, ELASTIC, Plate, STEEL, STRESS};

/// Of the plates with an upright load and a crack across it, m: of `centre` half of it.
const WIDTH: f64 = 2.0 * CRACK;

pub(super) fn plate(
    case: &Parameters,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, Box<dyn std::error::Error + Send + Sync>> {
    let a = CRACK + case.number("part")? * h;
    match case.choice("case")? {
        "inclined" => Ok(inclined(a, case.number("angle")?.to_radians(), h, load)?),
        "sneddon" => Ok(inclined(a, 0.0, h, load)?),
        "closed" => {
            let angle = case.number("angle")?.to_radians();
            Ok(closed(a, angle, case.number("friction")?, h, load)?)
        }
        "cantilever" => {
            let share = case.number("load")?;
            Ok(cantilever(a, h, share, load)?)
        }
        "centre-square" => Ok(square_of_nafems(true, h, load)?),
        "edge-square" => Ok(square_of_nafems(false, h, load)?),
        other => Ok(upright(other == "centre", a, h, load)?),
    }
}

pub(super) fn mouth() -> CrackSettings {
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
    let ratio = a / WIDTH;
    let form = if centre {
        (1.0 - 0.025 * ratio.powi(2) + 0.06 * ratio.powi(4)) / (0.5 * PI * ratio).cos().sqrt()
    } else {
        1.12 - 0.231 * ratio + 10.55 * ratio.powi(2) - 21.72 * ratio.powi(3) + 30.39 * ratio.powi(4)
    };
    cracked(centre, a, 4.0 * CRACK, form, h, load)
}

/// Tests 1.1 and 2.1 of NAFEMS R0020: a/W = 1/2 in square plates, wherever in its cell that puts the tip.
fn square_of_nafems(
    centre: bool,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, SceneError> {
    let (height, form) = if centre {
        (WIDTH, 1.325)
    } else {
        (0.5 * WIDTH, 3.0)
    };
    cracked(centre, CRACK, height, form, h, load)
}

/// A plate of this half height with a crack of the intensity σ√(πa) times `form`.
fn cracked(
    centre: bool,
    a: f64,
    height: f64,
    form: f64,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, SceneError> {
    let (low, high) = ([0.0, -height], [WIDTH, height]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene.fill(BODY, STEEL, &Block::new(low, high), &Spacing(0.5 * h))?;
    scene.crack("crack", &[[-h, 0.0], [a, 0.0]], mouth())?;
    pull(&mut scene, WIDTH, height, h, load)?;
    if centre {
        scene.hold(
            "symmetry",
            BODY,
            move |x| x.x < 0.5 * h,
            Hold::Component(Vector2::x()),
            Constant(0.0),
        )?;
    }
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
    let k = STRESS * (PI * a).sqrt();
    let (sine, cosine) = angle.sin_cos();
    let k = [k * cosine * cosine, k * sine * cosine];
    square(a, angle, h, load, ContactLaw::Frictionless, k)
}

/// The same pressed together, with friction of its faces.
fn closed(
    a: f64,
    angle: f64,
    friction: f64,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, SceneError> {
    let (sine, cosine) = angle.sin_cos();
    let sliding = (sine * cosine - friction * cosine * cosine).max(0.0);
    let k = [0.0, -STRESS * (PI * a).sqrt() * sliding];
    let contact = ContactLaw::Coulomb { friction };
    let mut plate = square(a, angle, h, move |t| -load(t), contact, k)?;
    // A plate that dead loads press and nothing guides turns over.
    let half = plate.high[1];
    let upright = move |x: &Vector2<f64>| x.x.abs() < h && x.y.abs() > half - 0.5 * h;
    let across = Hold::Component(Vector2::x());
    plate
        .scene
        .hold("upright", BODY, upright, across, Velocity(|_| 0.0))?;
    Ok(plate)
}

fn square(
    a: f64,
    angle: f64,
    h: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
    contact: ContactLaw,
    k: [f64; 2],
) -> Result<Plate, SceneError> {
    let half = 10.0 * CRACK;
    let (low, high) = ([-half; 2], [half; 2]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let (sine, cosine) = angle.sin_cos();
    // Off the nodes, as the tips are.
    let middle = [0.31 * h, 0.17 * h];
    let end = |sign: f64| [middle[0] + sign * a * cosine, middle[1] + sign * a * sine];
    let settings = CrackSettings {
        contact,
        ..CrackSettings::default()
    };
    scene
        .fill(BODY, STEEL, &Block::new(low, high), &Spacing(0.5 * h))?
        .crack("crack", &[end(-1.0), end(1.0)], settings)?;
    pull(&mut scene, 2.0 * half, half, h, load)?;
    Ok(Plate {
        scene,
        low,
        high,
        k,
        radius: 0.8 * CRACK,
    })
}

/// Loads on the top and the bottom row.
pub(super) fn pull(
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

/// Two arms, pulled apart at their ends by a share of the stress times a.
fn cantilever(
    a: f64,
    h: f64,
    share: f64,
    load: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static,
) -> Result<Plate, SceneError> {
    let height = ARM * CRACK;
    let (low, high) = ([0.0, -height], [1.6 * CRACK, height]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let most = share * STRESS * CRACK;
    let force = move |t: f64| Vector2::new(0.0, most * load(t));
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
    let release = 12.0 * (most * arm).powi(2) / (ELASTIC.effective_modulus() * height.powi(3));
    Ok(Plate {
        scene,
        low,
        high,
        k: [(release * ELASTIC.effective_modulus()).sqrt(), 0.0],
        radius: 0.9 * height,
    })
}
