//! A slender cantilever under a dead load at its tip, bent far (A19).
//!
//! The elastica [Bisshopp and Drucker 1945]: `EI θ'' = −P cos θ`, `θ(0) = 0`, `θ'(l) = 0`; deflection
//! `∫ sin θ`. Plane strain with ν = 0, so that E is E; shear adds about `0.6 (H/L)²` to the deflection.

use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use crate::convergence::positions;
use crate::method::{self, Method};
use crate::problem::{Outcome, Problem, run_to};

/// The study `cantilever`.
pub struct Cantilever;

/// Spacings of the default run, m: the beam is 0.1 m high.
const SPACINGS: [f64; 3] = [0.05, 0.025, 0.0125];
const HEIGHT: f64 = 0.1;

/// Deflection and shortening over the length of an elastica under the load `P l²/(EI)`.
///
/// In terms of the arc length over `l`, `½ θ'² = k (sin θ_l − sin θ)` with the load `k`, so that the
/// angle at the tip is found by shooting from it back to the clamp with the Runge-Kutta method.
pub(super) fn elastica(load: f64) -> (f64, f64) {
    // The angle at the clamp, the deflection and the reach, for an angle at the tip.
    let shoot = |tip: f64| {
        let steps = 2000;
        let ds = 1.0 / f64::from(steps);
        let rate =
            |[angle, slope, ..]: [f64; 4]| [-slope, load * angle.cos(), angle.sin(), angle.cos()];
        let mut y = [tip, 0.0, 0.0, 0.0];
        let ahead =
            |y: [f64; 4], k: [f64; 4], part: f64| std::array::from_fn(|i| y[i] + part * ds * k[i]);
        for _ in 0..steps {
            let a = rate(y);
            let b = rate(ahead(y, a, 0.5));
            let c = rate(ahead(y, b, 0.5));
            let d = rate(ahead(y, c, 1.0));
            y = std::array::from_fn(|i| y[i] + ds / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        y
    };
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if shoot(middle)[0] > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    let [.., down, reach] = shoot(0.5 * (low + high));
    (down, 1.0 - reach)
}

impl Problem for Cantilever {
    fn name(&self) -> &'static str {
        "cantilever"
    }

    fn about(&self) -> &'static str {
        "a cantilever bent far by a load at its tip, quasi-static, against the elastica: errors and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["quasi-static"]);
        for parameter in &mut parameters {
            match parameter.name {
                "steps" => parameter.default = vec![20_u64.into()],
                "tolerance" => parameter.default = vec![1e-6.into()],
                _ => {}
            }
        }
        parameters.extend([
            Parameter::number(
                "load",
                "P L²/(EI)",
                "1",
                1.0,
                Permitted::numbers(1e-3..=10.0),
            ),
            Parameter::number(
                "slenderness",
                "length over height",
                "1",
                20.0,
                Permitted::numbers(5.0..=100.0),
            ),
            Parameter::number("young", "Young's modulus", "Pa", 1e6, Permitted::above(0.0)),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = if quick { &SPACINGS[..2] } else { &SPACINGS[..] };
        vec![
            Overrides::new()
                .sweep("h", spacings.iter().copied())
                .set("shape", "cpdi"),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "deflection"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        let length = HEIGHT * case.number("slenderness")?;
        let young = case.number("young")?;
        let law = NeoHookean {
            density: 1000.0,
            young,
            poisson: 0.0,
        };
        if ((length / h).round() - length / h).abs() > 1e-6
            || ((HEIGHT / h).round() - HEIGHT / h).abs() > 1e-6
        {
            let reason = "length and height (0.1 m) must be whole numbers of cells";
            return Err(StudyError::combination(case, &["h", "slenderness"], reason));
        }
        // The load hangs on the last column of particles: that is the beam compared.
        let arm = length - 0.25 * h;
        let load = case.number("load")?;
        let force = load * young * HEIGHT.powi(3) / 12.0 / (arm * arm);
        let mut scene =
            beam(&law, length, h, force).map_err(StudyError::failed("building the beam"))?;
        let first = positions(&scene);
        let grid = Grid::over(
            [-4.0 * h, -length - 4.0 * h],
            [length + 4.0 * h, HEIGHT + 4.0 * h],
            h,
        )
        .map_err(StudyError::failed("making the grid"))?;
        let mut solver = method.build(grid, BandSource::default(), 1.0)?;
        let wall_s = run_to(&mut scene, &mut *solver, 1.0, case)?;
        let now = positions(&scene);
        let loaded: Vec<usize> = (0..first.len())
            .filter(|&i| first[i].x > length - 0.5 * h)
            .collect();
        let mean = loaded
            .iter()
            .map(|&i| now[i] - first[i])
            .sum::<Vector2<f64>>()
            / loaded.len() as f64;
        let (down, short) = elastica(load);
        let mut outcome = Outcome::of(scene, wall_s);
        outcome
            .errors
            .insert("deflection", (-mean.y / arm / down - 1.0).abs());
        outcome
            .errors
            .insert("shortening", (-mean.x / arm / short - 1.0).abs());
        outcome.values.insert("deflection", -mean.y / arm);
        outcome.values.insert("elastica", down);
        let stress = outcome.scene.bodies()[0].motion().stress;
        let field = stress.iter().map(|s| (s.xx() + s.yy()) / young).collect();
        outcome.field = Some(("trace of the stress over E [1]", field));
        Ok(outcome)
    }
}

fn beam(law: &NeoHookean, length: f64, h: f64, force: f64) -> Result<Scene<2>, SceneError> {
    let fill = Spacing(0.5 * h);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill(
            "beam",
            *law,
            &Block::new([0.0, 0.0], [length, HEIGHT]),
            &fill,
        )?
        .rigid(
            "clamp",
            &Block::new([-2.0 * h, 0.0], [0.0, HEIGHT]),
            &fill,
            Hold::All(Vector2::x()),
            Constant(0.0),
        )?
        .force(
            "load",
            "beam",
            |x| x.x > length - 0.5 * h,
            move |t| Vector2::new(0.0, -force * t),
        )?;
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::elastica;

    #[test]
    fn the_elastica_has_the_published_deflections() {
        // Bisshopp and Drucker; Mattiasson 1981.
        for (load, deflection) in [(1.0, 0.30172), (10.0, 0.81061)] {
            let found = elastica(load).0;
            assert!((found - deflection).abs() <= 1e-5, "{found} for {load}");
        }
        // Small loads: P l³/(3EI).
        assert!((elastica(1e-3).0 / (1e-3 / 3.0) - 1.0).abs() <= 1e-6);
    }
}
