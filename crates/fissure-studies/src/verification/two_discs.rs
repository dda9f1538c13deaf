//! Two elastic discs that fly towards each other, touch and part (A13) [Sulsky, Chen and Schreyer 1994].
//!
//! They touch when their centres are two radii apart, `t = (d − 2 r)/(2 |v|)`. The momentum is zero throughout; what
//! is lost of the energy between before and after goes to the transfer, to contact and to vibrations, which
//! is no loss. With one field for both (`contact = bond`) they feel each other from a cell away and stick while they are
//! that near; with a contact they do not.

use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use crate::method::{self, Method};
use crate::problem::{Outcome, Problem};

/// The study `two-discs`.
pub struct TwoDiscs;

/// Spacings of the default run, m.
const SPACINGS: [f64; 3] = [0.05, 0.025, 0.0125];
const RADIUS: f64 = 0.2;
const CENTRES: [[f64; 2]; 2] = [[0.2, 0.2], [0.8, 0.8]];
/// Components of the velocities, m/s.
const SPEED: f64 = 0.1;
const END: f64 = 3.6;

impl Problem for TwoDiscs {
    fn name(&self) -> &'static str {
        "two-discs"
    }

    fn about(&self) -> &'static str {
        "two elastic discs that touch and part: when, and what it costs"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["explicit"]);
        for parameter in &mut parameters {
            if parameter.name == "shape" {
                parameter.default = vec!["gimp".into()];
            }
        }
        parameters.push(Parameter::choice(
            "contact",
            "what they do to each other",
            "coulomb",
            &["bond", "frictionless", "coulomb", "stick"],
        ));
        parameters.push(Parameter::number(
            "friction",
            "coefficient of coulomb",
            "1",
            0.3,
            Permitted::numbers(0.0..=10.0),
        ));
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = if quick { &SPACINGS[..1] } else { &SPACINGS[..] };
        vec![
            Overrides::new()
                .sweep("h", spacings.iter().copied())
                .sweep("contact", ["bond", "coulomb"]),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "touch"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        let mut scene = discs(case, h)?;
        let grid = Grid::over([-0.2, -0.2], [1.2, 1.2], h)
            .map_err(StudyError::failed("making the grid"))?;
        let mut solver = method.build(grid, BandSource::default(), END)?;
        let before = scene.energy().kinetic;
        let start = std::time::Instant::now();
        let (mut touched, mut momentum) = (f64::NAN, 0.0_f64);
        while scene.time() < END {
            solver
                .step(&mut scene, END)
                .map_err(StudyError::failed(format!("running {}", case.label())))?;
            // One field has no force of contact: the discs feel each other when they deform.
            let felt = match scene.contact_force("touch") {
                Some(force) => force.norm() > 0.0,
                None => scene.energy().stored > 1e-6 * before,
            };
            if felt && touched.is_nan() {
                touched = scene.time();
            }
            momentum = momentum.max(total_momentum(&scene));
        }
        let wall_s = start.elapsed().as_secs_f64();
        let way = (Vector2::from(CENTRES[1]) - Vector2::from(CENTRES[0])).norm() - 2.0 * RADIUS;
        let exact = way / (2.0 * SPEED * 2.0_f64.sqrt());
        let energy = *scene.energy();
        let mut outcome = Outcome::of(scene, wall_s);
        outcome
            .errors
            .insert("touch", (touched / exact - 1.0).abs());
        outcome.errors.insert("momentum", momentum);
        outcome.errors.insert(
            "energy_lost",
            (1.0 - (energy.kinetic + energy.stored) / before).abs(),
        );
        outcome.values.insert("touched_s", touched);
        outcome.values.insert("exact_s", exact);
        outcome
            .values
            .insert("kinetic_kept", energy.kinetic / before);
        outcome
            .values
            .insert("taken_by_contact", energy.contact / before);
        outcome
            .values
            .insert("lost_in_transfer", energy.transfer_loss / before);
        let velocity = outcome.scene.bodies()[0].motion().velocity;
        let field = velocity.iter().map(|v| v.norm()).collect();
        outcome.field = Some(("speed [m/s]", field));
        Ok(outcome)
    }
}

fn discs(case: &Parameters, h: f64) -> Result<Scene<2>, StudyError> {
    let law = NeoHookean {
        density: 1000.0,
        young: 1000.0,
        poisson: 0.3,
    };
    let friction = case.number("friction")?;
    let contact = match case.choice("contact")? {
        "frictionless" => Some(ContactLaw::Frictionless),
        "coulomb" => Some(ContactLaw::Coulomb { friction }),
        "stick" => Some(ContactLaw::Stick),
        _ => None,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let built = || -> Result<(), SceneError> {
        for (name, centre, sign) in [("lower", CENTRES[0], 1.0), ("upper", CENTRES[1], -1.0)] {
            scene
                .fill(name, law, &Ball::new(centre, RADIUS), &Spacing(0.5 * h))?
                .set_velocity(name, |_| Vector2::new(sign * SPEED, sign * SPEED))?;
        }
        if let Some(contact) = contact {
            scene.contact("touch", "lower", "upper", contact)?;
        }
        Ok(())
    };
    let mut built = built;
    built().map_err(StudyError::failed("building the discs"))?;
    Ok(scene)
}

/// `|Σ m v|` over `Σ m |v|`.
fn total_momentum(scene: &Scene<2>) -> f64 {
    let (mut sum, mut scale) = (Vector2::zeros(), 0.0);
    for body in scene.bodies() {
        for (mass, v) in body.particles().mass.iter().zip(body.motion().velocity) {
            sum += v * *mass;
            scale += v.norm() * mass;
        }
    }
    sum.norm() / scale
}
