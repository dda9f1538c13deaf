//! Two waves that meet in a softening bar [Bažant and Belytschko 1985] (A10).
//!
//! A bar of length 2L is pulled at both ends with `v`, `f_t/2 < ρcv < f_t`. The waves meet in the middle
//! at `t = L/c`, where the stress would be `2ρcv`; the middle, of strength `f`, opens by `w` from there on.
//! Along the characteristics that reach it `T + ρc ẇ/2 = 2ρcv`, so that with linear softening
//! `T = f (1 − w/u₀)`
//!
//! `ẇ = a + k w`, `a = 4v − 2f/(ρc)`, `k = 2f/(ρc u₀)`: `w = a/k (exp(k (t − L/c)) − 1)`,
//!
//! up to `u₀`, and `ẇ = 4v` from then on. It holds until what the crack sends out has been to the ends and back,
//! `t = 3L/c`. Without an energy per area (`energy=volume`: the energy of a cell's volume is kept, and
//! the crack's falls with h) the stress drops at once, `w = 4v (t − L/c)`, and nothing is dissipated.

use std::time::Instant;

use fissure::diagnostics::curve_error;
use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use crate::method::{self, Method};
use crate::problem::{Outcome, Problem};

/// The study `softening-wave`.
pub struct SofteningWave;

/// Half the length of the bar, m.
const HALF: f64 = 0.5;
/// Cells along the bar: odd, so that one is in the middle.
const CELLS: [f64; 4] = [41.0, 81.0, 161.0, 321.0];

/// The bar and its exact opening.
#[derive(Clone, Copy, Debug)]
struct Wave {
    elastic: Isotropic,
    strength: f64,
    /// Of the middle over that of the rest.
    weakening: f64,
    toughness: f64,
    /// v, m/s.
    speed: f64,
}

impl Wave {
    /// c, m/s: there is no lateral strain.
    fn sound(&self) -> f64 {
        self.elastic.p_wave_speed()
    }

    /// `f` and `u₀` of the middle.
    fn middle(&self) -> (f64, f64) {
        let strength = self.weakening * self.strength;
        (strength, 2.0 * self.toughness / strength)
    }

    /// Opening at a time after the waves met, m.
    fn opening(&self, after: f64) -> f64 {
        let (strength, critical) = self.middle();
        let impedance = self.elastic.density * self.sound();
        let rate = 4.0 * self.speed - 2.0 * strength / impedance;
        let growth = 2.0 * strength / (impedance * critical);
        let failure = (1.0 + growth * critical / rate).ln() / growth;
        if after <= 0.0 {
            0.0
        } else if after < failure {
            rate / growth * (growth * after).exp_m1()
        } else {
            critical + 4.0 * self.speed * (after - failure)
        }
    }

    /// One cell high and thick.
    fn scene(&self, h: f64, rise: f64) -> Result<Scene<2>, SceneError> {
        let fill = Spacing(0.5 * h);
        let law = Decohesive {
            elastic: self.elastic,
            strength: self.strength,
            toughness: self.toughness,
            softening: softening::Linear,
            normal: Normal::Prescribed(Vector3::x()),
        };
        let mut scene = Scene::plane(Plane::Strain { thickness: h });
        let weak = Scale {
            strength: self.weakening,
            ..Scale::default()
        };
        let speed = self.speed;
        let pull = move |t: f64| speed * (t / rise).min(1.0);
        let end = 2.0 * HALF;
        scene
            .fill("bar", law, &Block::new([0.0, 0.0], [end, h]), &fill)?
            .set_scale("bar", |x| (x.x - HALF).abs() < 0.5 * h, weak)?;
        for (name, from, sign) in [("left", -2.0 * h, -1.0), ("right", end, 1.0)] {
            let grip = Block::new([from, 0.0], [from + 2.0 * h, h]);
            let hold = Hold::Component(Vector2::x());
            scene.rigid(name, &grip, &fill, hold, Velocity(move |t| sign * pull(t)))?;
        }
        Ok(scene)
    }
}

impl Problem for SofteningWave {
    fn name(&self) -> &'static str {
        "softening-wave"
    }

    fn about(&self) -> &'static str {
        "two waves meet in a softening bar [Bažant and Belytschko 1985]: opening and dissipated energy against the exact ones"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let spacings = CELLS.map(|cells| 2.0 * HALF / cells);
        let mut parameters = method::parameters(&spacings, &["explicit"]);
        parameters.extend([
            Parameter::choice(
                "energy",
                "what is kept as the spacing falls: the energy of the crack's area or of a cell's volume",
                "area",
                &["area", "volume"],
            ),
            Parameter::number("wave", "stress of each wave over the strength", "1", 0.6, Permitted::between(0.5, 1.0)),
            Parameter::number("weakening", "strength of the middle over that of the rest", "1", 0.7, Permitted::numbers(0.5..=1.0)),
            Parameter::number("rise", "of the pull, in times a wave needs across a cell", "1", 4.0, Permitted::above(0.0)),
            Parameter::number("young", "Young's modulus", "Pa", 24.9e9, Permitted::above(0.0)),
            Parameter::number("density", "mass density", "kg/m3", 2350.0, Permitted::above(0.0)),
            Parameter::number("strength", "tensile strength", "Pa", 2.7e6, Permitted::above(0.0)),
            Parameter::number("toughness", "fracture energy", "J/m2", 61.35, Permitted::above(0.0)),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let cells = if quick { &CELLS[..2] } else { &CELLS[..] };
        let over_h = || Overrides::new().sweep("h", cells.iter().map(|cells| 2.0 * HALF / cells));
        if quick {
            return vec![over_h()];
        }
        vec![
            over_h().sweep("energy", ["area", "volume"]),
            over_h().sweep("shape", ["gimp", "cpdi"]),
            over_h().sweep("transfer", ["apic", "xpic", "fmpm"]),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "opening_l2"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        let cells = 2.0 * HALF / h;
        if (cells - cells.round()).abs() > 1e-6 || cells.round() % 2.0 != 1.0 {
            let reason = "the bar of 1 m must be an odd number of cells";
            return Err(StudyError::combination(case, &["h"], reason));
        }
        let elastic = Isotropic {
            density: case.number("density")?,
            young: case.number("young")?,
            poisson: 0.0,
        };
        let strength = case.number("strength")?;
        let impedance = elastic.density * elastic.p_wave_speed();
        let per_volume = case.choice("energy")? == "volume";
        let share = if per_volume {
            h * CELLS[0] / (2.0 * HALF)
        } else {
            1.0
        };
        let wave = Wave {
            elastic,
            strength,
            weakening: case.number("weakening")?,
            toughness: case.number("toughness")? * share,
            speed: case.number("wave")? * strength / impedance,
        };
        if 2.0 * wave.speed * impedance <= wave.middle().0 {
            let reason = "both waves together must exceed the strength of the middle";
            return Err(StudyError::combination(
                case,
                &["wave", "weakening"],
                reason,
            ));
        }
        let transit = HALF / wave.sound();
        let rise = case.number("rise")? * h / wave.sound();
        // Half the rise: when the middle of the front is in the middle of the bar.
        let meet = transit + 0.5 * rise;
        let end = meet + 1.8 * transit;
        let mut scene = wave
            .scene(h, rise)
            .map_err(StudyError::failed("building the bar"))?;
        let grid = Grid::over([-6.0 * h, -4.0 * h], [2.0 * HALF + 6.0 * h, 5.0 * h], h)
            .map_err(StudyError::failed("making the grid"))?;
        let mut solver = method.build(grid, BandSource::default(), end)?;
        let (mut times, mut openings) = (vec![0.0], vec![0.0]);
        let gauge = Gauge::of(&scene, h);
        let start = Instant::now();
        while scene.time() < end {
            solver
                .step(&mut scene, end)
                .map_err(StudyError::failed(format!("running {}", case.label())))?;
            times.push(scene.time() - meet);
            openings.push(gauge.opening(&scene, &wave.elastic, h));
        }
        let wall_s = start.elapsed().as_secs_f64();
        times[0] = -meet;
        Ok(outcome(
            &wave, scene, wall_s, h, per_volume, &times, &openings,
        ))
    }
}

fn outcome(
    wave: &Wave,
    scene: Scene<2>,
    wall_s: f64,
    h: f64,
    per_volume: bool,
    times: &[f64],
    openings: &[f64],
) -> Outcome {
    let last = times[times.len() - 1];
    let range = (0.0, last);
    // Without an energy per area the limit is a crack without cohesion.
    let limit = |t: f64| 4.0 * wave.speed * t.max(0.0);
    let error = match per_volume {
        true => curve_error(times, openings, limit, range, &[]),
        false => curve_error(times, openings, |t| wave.opening(t), range, &[]),
    };
    let half = times.partition_point(|t| *t < 0.5 * last);
    let rate = (openings[openings.len() - 1] - openings[half]) / (last - times[half]);
    let dissipated = scene.energy().dissipated / (wave.toughness * h * h);
    let cracked = scene.bodies()[0].value("opening").unwrap_or_default();
    let count = cracked.iter().filter(|opening| **opening > 0.0).count();
    let mut outcome = Outcome::of(scene, wall_s);
    outcome
        .errors
        .insert("opening_l2", error.unwrap_or(f64::NAN));
    outcome
        .errors
        .insert("rate", (rate / (4.0 * wave.speed) - 1.0).abs());
    if !per_volume {
        outcome
            .errors
            .insert("dissipated", (dissipated - 1.0).abs());
    }
    outcome
        .values
        .insert("rate_over_4v", rate / (4.0 * wave.speed));
    outcome.values.insert("dissipated_ratio", dissipated);
    outcome
        .values
        .insert("dissipated_per_area", dissipated * wave.toughness);
    outcome.values.insert("cracked_cells", count as f64 / 4.0);
    outcome
}

/// Half the length over which the opening is measured, m.
const GAUGE: f64 = 0.1;

/// The particles between which the opening is measured, and those at its ends.
struct Gauge {
    /// By id: 0 outside, 1 inside, 2 in the column at the left end, 3 in that at the right end.
    role: Vec<u8>,
    /// What the columns were apart, m.
    apart: f64,
}

impl Gauge {
    fn of(scene: &Scene<2>, h: f64) -> Self {
        let mut gauge = Self {
            role: vec![0; scene.particle_count()],
            apart: 0.0,
        };
        let body = &scene.bodies()[0];
        for (id, x) in body.particles().id.iter().zip(body.motion().position) {
            let away = x.x - HALF;
            let end = (away.abs() - GAUGE).abs() < 0.25 * h;
            gauge.role[id.0 as usize] = match (end, away.abs() < GAUGE) {
                (true, _) if away < 0.0 => 2,
                (true, _) => 3,
                (false, true) => 1,
                (false, false) => 0,
            };
        }
        gauge.apart = gauge.distance(scene);
        gauge
    }

    fn distance(&self, scene: &Scene<2>) -> f64 {
        let body = &scene.bodies()[0];
        let (mut sums, mut counts) = ([0.0; 2], [0.0; 2]);
        for (id, x) in body.particles().id.iter().zip(body.motion().position) {
            if let Some(end) = self.role[id.0 as usize].checked_sub(2) {
                sums[usize::from(end)] += x.x;
                counts[usize::from(end)] += 1.0;
            }
        }
        sums[1] / counts[1] - sums[0] / counts[0]
    }

    /// What the ends have moved apart beyond the elastic strain of what is between them, m.
    fn opening(&self, scene: &Scene<2>, elastic: &Isotropic, h: f64) -> f64 {
        let body = &scene.bodies()[0];
        let inside = |id: usize| match self.role[id] {
            0 => 0.0,
            1 => 1.0,
            // Half of a column at the end is between the ends.
            _ => 0.5,
        };
        let rows = body.particles().id.iter().zip(body.motion().stress);
        let strained: f64 = rows
            .zip(&body.particles().volume)
            .map(|((id, stress), volume)| inside(id.0 as usize) * stress.xx() * volume)
            .sum();
        let elongation = strained / (elastic.p_wave_modulus() * h * h);
        self.distance(scene) - self.apart - elongation
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_opening_balances_what_arrives() {
        let elastic = Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.0,
        };
        let wave = Wave {
            elastic,
            strength: 2.7e6,
            weakening: 0.9,
            toughness: 61.35,
            speed: 0.25,
        };
        let impedance = elastic.density * elastic.p_wave_speed();
        let (strength, critical) = wave.middle();
        for after in [1e-5, 4e-5, 9e-5, 1.4e-4] {
            let w = wave.opening(after);
            let rate = (wave.opening(after + 1e-9) - wave.opening(after - 1e-9)) / 2e-9;
            let traction = strength * (1.0 - w / critical).max(0.0);
            let arriving = traction + 0.5 * impedance * rate;
            assert!((arriving / (2.0 * impedance * wave.speed) - 1.0).abs() <= 1e-6);
        }
    }
}
