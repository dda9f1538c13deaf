//! Longitudinal vibration of a bar (A9): `ω_n = (2n − 1)πc/(2L)` fixed at one end, `nπc/L` free at both.

use std::f64::consts::PI;
use std::time::Instant;

use fissure::materials::Hencky;
use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use crate::method::{self, Method};
use crate::problem::{Outcome, Problem};

/// The study `bar-vibration`.
pub struct BarVibration;

/// Spacings of the default run, m: the bar is 1 m long.
const SPACINGS: [f64; 4] = [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0];
const LENGTH: f64 = 1.0;

impl Problem for BarVibration {
    fn name(&self) -> &'static str {
        "bar-vibration"
    }

    fn about(&self) -> &'static str {
        "frequency and energy of a vibrating bar, fixed or free, against the exact mode: errors and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["explicit", "implicit"]);
        parameters.extend([
            Parameter::choice(
                "ends",
                "fixed on the left and free on the right, or both free",
                "free-free",
                &["fixed-free", "free-free"],
            ),
            Parameter::count("mode", "number of the mode", 1, Permitted::counts(1..=8)),
            Parameter::number(
                "periods",
                "length of the run",
                "1",
                10.0,
                Permitted::numbers(2.0..=1000.0),
            ),
            Parameter::number(
                "strain",
                "amplitude",
                "1",
                1e-4,
                Permitted::between(0.0, 0.01),
            ),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = if quick { &SPACINGS[..2] } else { &SPACINGS[..] };
        let over_h = || Overrides::new().sweep("h", spacings.iter().copied());
        if quick {
            return vec![
                over_h(),
                Overrides::new()
                    .set("h", SPACINGS[1])
                    .set("solver", "implicit")
                    .sweep("steps", [200_u64, 400]),
            ];
        }
        let implicit = || {
            Overrides::new()
                .set("h", SPACINGS[2])
                .set("solver", "implicit")
                .sweep("steps", [200_u64, 400, 800, 1600])
        };
        vec![
            over_h().sweep("shape", method::SHAPES.iter().copied()),
            over_h().set("ends", "fixed-free"),
            over_h()
                .set("shape", "bspline2")
                .sweep("transfer", ["apic", "xpic", "fmpm"]),
            Overrides::new()
                .set("h", SPACINGS[2])
                .sweep("update", ["first", "last", "musl"])
                .sweep("cfl", [0.8, 0.4, 0.2, 0.1, 0.05]),
            implicit().sweep("integration", ["generalized-alpha", "newmark"]),
            implicit()
                .set("integration", "theta")
                .sweep("weight", [0.5, 1.0]),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "frequency"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let law = Hencky {
            elastic: Isotropic {
                density: 1000.0,
                young: 1e7,
                poisson: 0.0,
            },
        };
        let speed = law.elastic.p_wave_speed();
        let (mode, free) = (
            case.count("mode")? as f64,
            case.choice("ends")? == "free-free",
        );
        // Wave number times length.
        let number = if free { mode * PI } else { (mode - 0.5) * PI };
        let shape = move |x: f64| {
            let phase = number * x / LENGTH;
            if free { phase.cos() } else { phase.sin() }
        };
        let h = method.spacing;
        let mut scene = bar(&law, h, free).map_err(StudyError::failed("building the bar"))?;
        let amplitude = case.number("strain")? * speed;
        scene
            .set_velocity("bar", |x| Vector2::new(amplitude * shape(x.x), 0.0))
            .map_err(StudyError::failed("setting the bar in motion"))?;
        let period = 2.0 * LENGTH * PI / (number * speed);
        let end = case.number("periods")? * period;
        let grid = Grid::over([-4.0 * h, -4.0 * h], [LENGTH + 4.0 * h, 5.0 * h], h)
            .map_err(StudyError::failed("making the grid"))?;
        let mut solver = method.build(grid, BandSource::default(), end)?;
        let energy = scene.energy().kinetic;
        let start = Instant::now();
        let mut swing = Swing::default();
        while scene.time() < end {
            let report = solver
                .step(&mut scene, end)
                .map_err(StudyError::failed(format!("running {}", case.label())))?;
            let motion = scene.bodies()[0].motion();
            let pairs = motion.position.iter().zip(motion.velocity);
            let modal: f64 = pairs.map(|(x, v)| shape(x.x) * v.x).sum();
            let total = scene.energy().kinetic + scene.energy().stored;
            swing.add(&report, modal, total, end - period);
        }
        let wall_s = start.elapsed().as_secs_f64();
        let mut outcome = Outcome::of(scene, wall_s);
        let frequency = swing.frequency() * period;
        let kept = swing.tail / swing.tail_count / energy;
        outcome.errors.insert("frequency", (frequency - 1.0).abs());
        outcome.errors.insert("energy", (kept - 1.0).abs());
        outcome.values.insert("frequency_over_exact", frequency);
        outcome.values.insert("energy_kept", kept);
        Ok(outcome)
    }
}

/// Zeros of the velocity of the mode, and the mean energy of the last period.
#[derive(Default)]
struct Swing {
    before: f64,
    first: Option<f64>,
    last: f64,
    crossings: f64,
    tail: f64,
    tail_count: f64,
}

impl Swing {
    fn add(&mut self, report: &Report<2>, modal: f64, energy: f64, tail: f64) {
        if self.before * modal < 0.0 {
            self.last = report.time - report.dt * modal / (modal - self.before);
            match self.first {
                None => self.first = Some(self.last),
                Some(_) => self.crossings += 1.0,
            }
        }
        self.before = modal;
        // The mean over a period: single values waver with the staggering of the step.
        if report.time > tail {
            self.tail += energy;
            self.tail_count += 1.0;
        }
    }

    /// 1/s; not finite without two crossings.
    fn frequency(&self) -> f64 {
        0.5 * self.crossings / (self.last - self.first.unwrap_or(f64::NAN))
    }
}

/// One cell high and thick, on a roller of rigid particles on the left unless it is free.
fn bar(law: &Hencky, h: f64, free: bool) -> Result<Scene<2>, SceneError> {
    let fill = Spacing(0.5 * h);
    let mut scene = Scene::plane(Plane::Strain { thickness: h });
    let block = Block::new([0.0, 0.0], [LENGTH, h]);
    scene.fill("bar", *law, &block, &fill)?;
    if !free {
        let wall = Block::new([-2.0 * h, 0.0], [0.0, h]);
        scene.rigid(
            "wall",
            &wall,
            &fill,
            Hold::Component(Vector2::x()),
            Constant(0.0),
        )?;
    }
    Ok(scene)
}
