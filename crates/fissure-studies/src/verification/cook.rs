//! Cook's membrane (A18) [Cook 1974]: a tapered panel, clamped on the left, sheared on the right.
//!
//! 48 long, 44 high on the left and 16 on the right. Plane stress with E = 1, ν = 1/3 and a load of 1
//! has `u_y = 23.97` in the middle of the loaded edge (Q9 elements of 8² to 64²: 23.925 to 23.965).
//! Nearly incompressible, in plane strain with ν = 0.4999, low-order elements lock; the reference
//! 7.7 for E = 240.565 and a load of 100 is the one quoted for it. The loads here are small enough for
//! small strains, and displacements are scaled back.

use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use super::fitting::displacement_at;
use crate::convergence::positions;
use crate::filling::{Seeded, clipped};
use crate::method::{self, Chosen, Method};
use crate::problem::{Outcome, Problem, run_to};

/// The study `cook`.
pub struct Cook;

/// Spacings of the default run, m.
const SPACINGS: [f64; 3] = [4.0, 2.0, 1.0];
const LENGTH: f64 = 48.0;
/// Heights on the left and of the right edge's ends, m.
const LEFT: f64 = 44.0;
const RIGHT: (f64, f64) = (44.0, 60.0);

/// What a case is, and its answer.
struct Variant {
    plane: Plane,
    young: f64,
    poisson: f64,
    /// On the right edge, N.
    load: f64,
    /// The part of it that is put on.
    part: f64,
    /// Displacement of the middle of the loaded edge, m.
    reference: f64,
}

fn variant(name: &str) -> Variant {
    if name == "nearly-incompressible" {
        return Variant {
            plane: Plane::Strain { thickness: 1.0 },
            young: 240.565,
            poisson: 0.4999,
            load: 100.0,
            part: 1e-3,
            reference: 7.7,
        };
    }
    Variant {
        plane: Plane::Stress { thickness: 1.0 },
        young: 1.0,
        poisson: 1.0 / 3.0,
        load: 1.0,
        part: 1e-5,
        reference: 23.97,
    }
}

impl Problem for Cook {
    fn name(&self) -> &'static str {
        "cook"
    }

    fn about(&self) -> &'static str {
        "Cook's membrane, compressible and nearly incompressible, quasi-static: displacement and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["quasi-static"]);
        // At ν = 0.4999 rounding of the volume change alone leaves 1e-6.
        for parameter in parameters.iter_mut().filter(|p| p.name == "tolerance") {
            parameter.default = vec![1e-5.into()];
        }
        parameters.push(Parameter::choice(
            "material",
            "plane stress with ν = 1/3, or plane strain with ν = 0.4999",
            "compressible",
            &["compressible", "nearly-incompressible"],
        ));
        parameters.push(Parameter::choice(
            "volume",
            "change of a particle: its own, or the mean of its cell against locking (nearly-incompressible)",
            "particle",
            &["particle", "patch"],
        ));
        parameters.push(Parameter::number(
            "poisson",
            "Poisson's ratio in place of 0.4999 (nearly-incompressible); the reference is for 0.4999",
            "1",
            0.4999,
            Permitted::between(0.4, 0.5),
        ));
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = if quick { &SPACINGS[..2] } else { &SPACINGS[..] };
        let shapes: &[&str] = if quick {
            &["linear"]
        } else {
            &["linear", "bspline2"]
        };
        vec![
            Overrides::new()
                .sweep("h", spacings.iter().copied())
                .sweep("material", ["compressible", "nearly-incompressible"])
                .sweep("shape", shapes.iter().copied()),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "displacement"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        let name = case.choice("material")?;
        let mut variant = variant(name);
        if name == "nearly-incompressible" {
            variant.poisson = case.number("poisson")?;
        }
        if ((LENGTH / h).round() - LENGTH / h).abs() > 1e-6 {
            let reason = "the length of 48 m must be a whole number of cells";
            return Err(StudyError::combination(case, &["h"], reason));
        }
        let grid = Grid::over([-4.0 * h, -4.0 * h], [LENGTH + 4.0 * h, 60.0 + 4.0 * h], h)
            .map_err(StudyError::failed("making the grid"))?;
        let mut scene =
            panel(&variant, &grid).map_err(StudyError::failed("building the membrane"))?;
        let first = positions(&scene);
        let patch = case.choice("volume")? == "patch";
        if patch && name != "nearly-incompressible" {
            let reason = "volume changes are averaged in plane strain only";
            return Err(StudyError::combination(
                case,
                &["material", "volume"],
                reason,
            ));
        }
        let settings = QuasiStaticSettings {
            step: 1.0 / method.steps as f64,
            tolerance: method.tolerance,
            averaging: if patch {
                Averaging::Volume
            } else {
                Averaging::None
            },
            ..QuasiStaticSettings::default()
        };
        let mut solver = method.build_with(grid, Chosen::QuasiStatic(settings))?;
        let wall_s = run_to(&mut scene, &mut *solver, 1.0, case)?;
        let edge = Vector2::new(LENGTH, 0.5 * (RIGHT.0 + RIGHT.1));
        let way = displacement_at(&scene, &first, &edge, 2.0 * h).y / variant.part;
        let mut outcome = Outcome::of(scene, wall_s);
        let error = (way / variant.reference - 1.0).abs();
        outcome.errors.insert("displacement", error);
        outcome.values.insert("u_y", way);
        outcome.values.insert("reference", variant.reference);
        let stress = outcome.scene.bodies()[0].motion().stress;
        let pressure = stress
            .iter()
            .map(|s| -s.mean() / (variant.part * variant.load));
        outcome.field = Some(("pressure over load [1/m²]", pressure.collect()));
        Ok(outcome)
    }
}

fn panel(
    variant: &Variant,
    grid: &Grid<2>,
) -> Result<Scene<2>, Box<dyn std::error::Error + Send + Sync>> {
    let h = grid.spacing();
    let outline = Polygon::new([
        [0.0, 0.0],
        [LENGTH, RIGHT.0],
        [LENGTH, RIGHT.1],
        [0.0, LEFT],
    ]);
    let area = 0.5 * LENGTH * (LEFT + RIGHT.1 - RIGHT.0);
    let seeds = clipped(grid, &outline, area)?;
    let law = Isotropic {
        density: 1.0,
        young: variant.young,
        poisson: variant.poisson,
    };
    let load = variant.part * variant.load;
    let mut scene = Scene::plane(variant.plane);
    scene
        .fill("panel", law, &outline, &Seeded(seeds))?
        .rigid(
            "clamp",
            &Block::new([-2.0 * h, -2.0 * h], [0.0, LEFT + 2.0 * h]),
            &Spacing(0.5 * h),
            Hold::All(Vector2::x()),
            Constant(0.0),
        )?
        .force(
            "load",
            "panel",
            |x| x.x > LENGTH - 0.5 * h,
            move |t| Vector2::new(0.0, load * t),
        )?;
    Ok(scene)
}
