//! The axis-aligned manufactured displacement [Wallstedt and Guilkey 2008] (A17).
//!
//! `u_x = A sin(2πX) sin(cπt)`, `u_y = A sin(2πY) sin(cπt + π)` with `c = √(E/ρ₀)` in the unit square,
//! neo-Hookean. F is diagonal, so that the sides are symmetry planes and rollers hold them exactly.
//! The body force follows from `ρ₀ ü = ∂P/∂X + ρ₀ b` with
//! `∂P₁₁/∂X = (μ (1 + 1/F₁₁²) + λ (1 − ln J)/F₁₁²) ∂F₁₁/∂X`.

use std::f64::consts::PI;

use fissure::nalgebra::Matrix2;
use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use super::manufactured::{Following, Motion};
use crate::method::{self, Method};
use crate::problem::{Outcome, Problem};

/// The study `axis-aligned-mms`.
pub struct AxisAlignedMms;

#[derive(Clone, Copy, Debug)]
struct AxisAligned {
    law: NeoHookean,
    amplitude: f64,
    /// `c`, 1/s: the wave speed over the metre of the square.
    rate: f64,
}

impl AxisAligned {
    /// `A sin(cπt)` with the sign of the axis, and its second rate.
    fn amplitudes(&self, t: f64) -> [f64; 2] {
        let way = self.amplitude * (self.rate * PI * t).sin();
        [way, -way]
    }
}

impl Motion for AxisAligned {
    fn position(&self, x0: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let a = self.amplitudes(t);
        Vector2::from_fn(|i, _| x0[i] + a[i] * (2.0 * PI * x0[i]).sin())
    }

    fn gradient(&self, x0: &Vector2<f64>, t: f64) -> Matrix2<f64> {
        let a = self.amplitudes(t);
        let stretch = |i: usize| 1.0 + 2.0 * PI * a[i] * (2.0 * PI * x0[i]).cos();
        Matrix2::new(stretch(0), 0.0, 0.0, stretch(1))
    }

    fn first_velocity(&self, x0: &Vector2<f64>) -> Vector2<f64> {
        let speed = self.amplitude * self.rate * PI;
        Vector2::from_fn(|i, _| [speed, -speed][i] * (2.0 * PI * x0[i]).sin())
    }

    fn body_force(&self, x0: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let a = self.amplitudes(t);
        let sines = [0, 1].map(|i| (2.0 * PI * x0[i]).sin_cos());
        let stretch = [0, 1].map(|i| 1.0 + 2.0 * PI * a[i] * sines[i].1);
        let log = (stretch[0] * stretch[1]).ln();
        let (lambda, shear) = (
            self.law.elastic().lambda(),
            self.law.elastic().shear_modulus(),
        );
        Vector2::from_fn(|i, _| {
            let inverse_square = (stretch[i] * stretch[i]).recip();
            let modulus = shear * (1.0 + inverse_square) + lambda * (1.0 - log) * inverse_square;
            let bend = -4.0 * PI * PI * a[i] * sines[i].0;
            let inertia = -(self.rate * PI).powi(2) * a[i] * sines[i].0;
            inertia - modulus * bend / self.law.density
        })
    }

    fn law(&self) -> NeoHookean {
        self.law
    }
}

impl Problem for AxisAlignedMms {
    fn name(&self) -> &'static str {
        "axis-aligned-mms"
    }

    fn about(&self) -> &'static str {
        "manufactured axis-aligned waves in a square, large strain [Wallstedt and Guilkey 2008]: errors and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["explicit", "implicit"]);
        parameters.extend([
            Parameter::number(
                "amplitude",
                "largest displacement",
                "m",
                0.05,
                Permitted::between(0.0, 0.159),
            ),
            Parameter::number(
                "periods",
                "length of the run",
                "1",
                0.25,
                Permitted::numbers(0.01..=10.0),
            ),
            Parameter::choice(
                "margin",
                "material beyond each side of the square that is compared: splines cannot hold a side exactly",
                "0",
                &["0", "0.5"],
            ),
            Parameter::number("young", "Young's modulus", "Pa", 1e7, Permitted::above(0.0)),
            Parameter::number("poisson", "Poisson's ratio", "1", 0.3, Permitted::between(-1.0, 0.5)),
            Parameter::number("density", "mass density", "kg/m3", 1000.0, Permitted::above(0.0)),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = if quick { &SPACINGS[..2] } else { &SPACINGS[..] };
        let over_h = |shapes: &[&'static str], transfers: &[&'static str]| {
            Overrides::new()
                .sweep("h", spacings.iter().copied())
                .sweep("shape", shapes.iter().copied())
                .sweep("transfer", transfers.iter().copied())
        };
        // So small that particles stay where they are in their cells: nothing but the scheme in time is seen, down to the
        // error of the grid.
        let still = || {
            Overrides::new()
                .set("h", SPACINGS[2])
                .set("amplitude", 1e-4)
        };
        let implicit = |steps: &[u64]| {
            still()
                .set("solver", "implicit")
                .sweep("steps", steps.iter().copied())
        };
        if quick {
            return vec![
                over_h(&["linear", "gimp"], &["flip"]),
                implicit(&[4, 8, 16])
                    .set("h", SPACINGS[1])
                    .sweep("integration", ["generalized-alpha", "theta"]),
            ];
        }
        let steps = [4, 8, 16];
        vec![
            over_h(&["linear", "gimp", "cpdi"], &["flip"]),
            over_h(&["bspline2", "bspline3"], &["flip"]).set("margin", "0.5"),
            over_h(&["bspline2"], &["apic", "fmpm"]).set("margin", "0.5"),
            Overrides::new()
                .set("h", SPACINGS[1])
                .set("shape", "gimp")
                .sweep("update", ["first", "last", "musl"])
                .sweep("cfl", CFL),
            still()
                .sweep("update", ["first", "last", "musl"])
                .sweep("cfl", CFL),
            implicit(&[8, 16, 32, 64, 128])
                .set("integration", "theta")
                .sweep("weight", [0.5, 1.0]),
            implicit(&steps).sweep("integration", ["newmark", "generalized-alpha"]),
            implicit(&steps).set("spectral_radius", 0.0),
            implicit(&steps).set("amplitude", 0.05).set("shape", "cpdi"),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "place_l2"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        if ((1.0 / h) - (1.0 / h).round()).abs() > 1e-6 {
            let reason = "the square must be a whole number of cells";
            return Err(StudyError::combination(case, &["h"], reason));
        }
        let law = NeoHookean {
            density: case.number("density")?,
            young: case.number("young")?,
            poisson: case.number("poisson")?,
        };
        let motion = AxisAligned {
            law,
            amplitude: case.number("amplitude")?,
            rate: (law.young / law.density).sqrt(),
        };
        let margin = if case.choice("margin")? == "0" {
            0.0
        } else {
            0.5
        };
        Following {
            motion,
            scene: square(&law, margin, h).map_err(StudyError::failed("building the square"))?,
            grid: Grid::over([-margin - 6.0 * h; 2], [1.0 + margin + 6.0 * h; 2], h)
                .map_err(StudyError::failed("making the grid"))?,
            end: 2.0 * case.number("periods")? / motion.rate,
            amplitude: motion.amplitude,
            counts: |x| (0..2).all(|i| x[i] > 0.0 && x[i] < 1.0),
        }
        .run(case, method)
    }
}

/// Spacings of the default run, m.
const SPACINGS: [f64; 3] = [1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0];

/// Shares of the longest explicit step over which orders in time are seen.
const CFL: [f64; 4] = [0.4, 0.2, 0.1, 0.05];

/// The square on rollers.
fn square(law: &NeoHookean, margin: f64, h: f64) -> Result<Scene<2>, SceneError> {
    let (low, high, thick) = (-margin, 1.0 + margin, 2.0 * h);
    let fill = Spacing(0.5 * h);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene.fill("body", *law, &Block::new([low; 2], [high; 2]), &fill)?;
    for (name, axis, from, to) in [
        ("left", 0, low - thick, low),
        ("right", 0, high, high + thick),
        ("bottom", 1, low - thick, low),
        ("top", 1, high, high + thick),
    ] {
        let (mut least, mut most) = ([low - thick; 2], [high + thick; 2]);
        (least[axis], most[axis]) = (from, to);
        let direction = if axis == 0 {
            Vector2::x()
        } else {
            Vector2::y()
        };
        let wall = Block::new(least, most);
        scene.rigid(
            name,
            &wall,
            &fill,
            Hold::Component(direction),
            Constant(0.0),
        )?;
    }
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::super::manufactured::imbalance;
    use super::*;

    #[test]
    fn the_body_force_makes_the_motion_a_solution() {
        let law = NeoHookean {
            density: 1000.0,
            young: 1e3,
            poisson: 0.3,
        };
        let motion = AxisAligned {
            law,
            amplitude: 0.1,
            rate: 1.0,
        };
        for (x, y, t) in [(0.2, 0.4, 0.3), (0.7, 0.15, 0.8), (0.9, 0.55, 1.4)] {
            let left = imbalance(&motion, &Vector2::new(x, y), t);
            assert!(left <= 1e-5, "{left} at {x}, {y}, {t}");
        }
    }
}
