//! The Brazilian disc (A14) [Hondros 1959]: pressed along a diameter over two short arcs.
//!
//! Pressure `p` over the arcs `±α` about the ends of a diameter gives at the centre
//! `σ_across = 2p/π (sin 2α − α)` and `σ_along = −2p/π (sin 2α + α)` [Hondros 1959], as `α → 0` with
//! `p = P/(α D t)` the `2P/(πDt)` and `−6P/(πDt)` of point loads. Along the loaded diameter, at the
//! part `ρ` of the radius, `σ_across = 2p/π ((1 − ρ²) sin 2α/(1 − 2ρ² cos 2α + ρ⁴) − A)` and
//! `σ_along = −2p/π ((1 − ρ²) sin 2α/(1 − 2ρ² cos 2α + ρ⁴) + A)`,
//! `A = arctan((1 + ρ²)/(1 − ρ²) tan α)`.

use std::f64::consts::{FRAC_PI_2, PI};

use fissure::prelude::*;

use fissure_study::{Measures, Overrides, Parameter, Parameters, Permitted, StudyError};

use super::fitting::stress_at;
use crate::filling::{Seeded, clipped};
use crate::method::{self, Method};
use crate::problem::{Outcome, Problem, run_to};

/// The study `brazilian`.
pub struct Brazilian;

/// Spacings of the default run over the radius of 1 m.
const SPACINGS: [f64; 5] = [0.2, 0.1, 0.05, 0.025, 0.0125];
const RADIUS: f64 = 1.0;
/// Pressure on the arcs over Young's modulus: small strains.
const PRESSURE: f64 = 1e-6;
/// Sectors of an arc, each with its own direction of the load.
const SECTORS: usize = 4;

/// Stress across and along the loaded diameter over the pressure, at a part of the radius.
fn hondros(arc: f64, part: f64) -> (f64, f64) {
    let squared = part * part;
    let first = (1.0 - squared) * (2.0 * arc).sin()
        / (1.0 - 2.0 * squared * (2.0 * arc).cos() + squared * squared);
    let second = ((1.0 + squared) / (1.0 - squared) * arc.tan()).atan();
    let scale = 2.0 / PI;
    (scale * (first - second), -scale * (first + second))
}

impl Problem for Brazilian {
    fn name(&self) -> &'static str {
        "brazilian"
    }

    fn about(&self) -> &'static str {
        "stresses in a disc pressed along a diameter, quasi-static [Hondros 1959]: errors and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["quasi-static"]);
        parameters.extend([
            Parameter::number(
                "arc",
                "half angle over which the load is spread",
                "deg",
                15.0,
                Permitted::numbers(2.0..=45.0),
            ),
            Parameter::number(
                "poisson",
                "Poisson's ratio",
                "1",
                0.2,
                Permitted::between(-1.0, 0.5),
            ),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let over_h = |count: usize, shape: &str| {
            Overrides::new()
                .sweep("h", SPACINGS[..count].iter().copied())
                .set("shape", shape)
        };
        if quick {
            return vec![over_h(2, "linear")];
        }
        vec![over_h(5, "linear"), over_h(3, "bspline2")]
    }

    fn leading_error(&self) -> &'static str {
        "diameter_l2"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        let arc = case.number("arc")?.to_radians();
        let law = Isotropic {
            density: 1000.0,
            young: 1e9,
            poisson: case.number("poisson")?,
        };
        let pressure = PRESSURE * law.young;
        let reach = ((RADIUS / h).ceil() + 4.0) * h;
        let grid = Grid::over([-reach; 2], [reach; 2], h)
            .map_err(StudyError::failed("making the grid"))?;
        let mut scene =
            disc(&law, &grid, arc, pressure).map_err(StudyError::failed("building the disc"))?;
        let mut solver = method.build(grid, BandSource::default(), 1.0)?;
        let wall_s = run_to(&mut scene, &mut *solver, 1.0, case)?;
        let (errors, values) = compare(&scene, arc, pressure, h);
        let stress = scene.bodies()[0].motion().stress;
        let field = stress.iter().map(|s| s.xx() / pressure).collect();
        Ok(Outcome {
            scene,
            wall_s,
            errors,
            values,
            field: Some(("stress across over pressure [1]", field)),
            history: None,
        })
    }
}

/// Stresses on the diameter at ten places up to 0.7 of the radius, and at the centre.
fn compare(scene: &Scene<2>, arc: f64, pressure: f64, h: f64) -> (Measures, Measures) {
    let at = |part: f64| {
        let [across, along, _] = stress_at(scene, &Vector2::new(0.0, part * RADIUS), 1.5 * h);
        (across / pressure, along / pressure)
    };
    let (mut off, mut whole) = (0.0, 0.0);
    for place in 0..10 {
        let part = 0.7 * (f64::from(place) + 0.5) / 10.0;
        let (found, exact) = (at(part), hondros(arc, part));
        off += (found.0 - exact.0).powi(2) + (found.1 - exact.1).powi(2);
        whole += exact.0 * exact.0 + exact.1 * exact.1;
    }
    let (found, exact) = (at(0.0), hondros(arc, 0.0));
    // P = 2 p t R sin α: the load that an arc passes on.
    let load = 2.0 * RADIUS * arc.sin();
    let unit = load / (PI * 2.0 * RADIUS);
    (
        Measures::new()
            .with("diameter_l2", (off / whole).sqrt())
            .with("centre_across", (found.0 / exact.0 - 1.0).abs())
            .with("centre_along", (found.1 / exact.1 - 1.0).abs()),
        Measures::new()
            .with("across_over_p_by_pi_d_t", found.0 / unit)
            .with("along_over_p_by_pi_d_t", found.1 / unit),
    )
}

fn disc(
    law: &Isotropic,
    grid: &Grid<2>,
    arc: f64,
    pressure: f64,
) -> Result<Scene<2>, Box<dyn std::error::Error + Send + Sync>> {
    let region = Ball::new([0.0; 2], RADIUS);
    let seeds = clipped(grid, &region, PI * RADIUS * RADIUS)?;
    let mut scene = Scene::plane(Plane::Stress { thickness: 1.0 });
    scene.fill("disc", *law, &region, &Seeded(seeds))?;
    // A shell of particles half a cell thick carries the load.
    let shell = RADIUS - 0.5 * grid.spacing();
    let sector = 2.0 * arc / SECTORS as f64;
    for end in [FRAC_PI_2, -FRAC_PI_2] {
        for number in 0..SECTORS {
            let middle = end - arc + (number as f64 + 0.5) * sector;
            let outward = Vector2::new(middle.cos(), middle.sin());
            let inside = move |x: &Vector2<f64>| {
                let off = outward.perp(x).atan2(outward.dot(x));
                x.norm() > shell && (-0.5 * sector..0.5 * sector).contains(&off)
            };
            // The chord: what a uniform pressure over the sector comes to.
            let force = outward * (-pressure * 2.0 * RADIUS * (0.5 * sector).sin());
            let name = format!("load {end:.2} {number}");
            scene.force(&name, "disc", inside, move |t| force * t)?;
        }
    }
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::hondros;

    #[test]
    fn a_short_arc_is_a_point_load() {
        // p = P/(α D t): in units of P/(π D t) the pressure is π/α.
        let arc = 1e-3;
        let (across, along) = hondros(arc, 0.0);
        let unit = std::f64::consts::PI / arc;
        assert!((across * unit - 2.0).abs() <= 1e-5, "{}", across * unit);
        assert!((along * unit + 6.0).abs() <= 1e-5, "{}", along * unit);
    }
}
