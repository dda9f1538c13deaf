//! The generalised vortex [Brannon, Kamojjala and Sadeghirad 2011] (A16).
//!
//! A ring turns by `α(R, t) = g(t) p(R)`, `g = G sin(πt/T)`, `p = 1 − 8s² + 16s⁴`,
//! `s = (R − R̄)/(R_i − R_o)`: `x = Q(α) X`. With `γ = r α'` the deformation gradient is
//! `Q (1 + γ e_θ⊗e_r)`, of determinant 1, and the neo-Hookean stress is
//! `μ (γ (e_r⊗e_θ + e_θ⊗e_r) + γ² e_θ⊗e_θ)`. It vanishes at both edges, which rest: they are held, since
//! a free ring is turned by what little torque the sums of the large body forces leave.
//! Balance of momentum gives `b_r = −α̇² r + (μ/ρ) r α'²` and `b_θ = α̈ r − (μ/ρ)(3α' + r α'')`.

use std::f64::consts::PI;

use fissure::nalgebra::{Matrix2, Rotation2};
use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use super::manufactured::{Following, Motion};
use crate::filling::{Seeded, whole};
use crate::method::{self, Method};
use crate::problem::{Outcome, Problem};

/// The study `vortex-mms`.
pub struct VortexMms;

/// Inner and outer radius, m.
const RADII: (f64, f64) = (0.75, 1.25);
/// Spacings of the default run, m.
const SPACINGS: [f64; 3] = [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0];

#[derive(Clone, Copy, Debug)]
struct Vortex {
    law: NeoHookean,
    amplitude: f64,
    period: f64,
}

impl Vortex {
    /// `g`, its rate and its second rate.
    fn turn(&self, t: f64) -> [f64; 3] {
        let rate = PI / self.period;
        let (sine, cosine) = (rate * t).sin_cos();
        [sine, rate * cosine, -rate * rate * sine].map(|g| g * self.amplitude)
    }

    /// `p`, its slope and its curvature.
    fn profile(r: f64) -> [f64; 3] {
        let (inner, outer) = RADII;
        let scale = (inner - outer).recip();
        let s = (r - 0.5 * (inner + outer)) * scale;
        let s2 = s * s;
        [
            1.0 - 8.0 * s2 + 16.0 * s2 * s2,
            (-16.0 * s + 64.0 * s * s2) * scale,
            (-16.0 + 192.0 * s2) * scale * scale,
        ]
    }
}

impl Motion for Vortex {
    fn position(&self, x0: &Vector2<f64>, t: f64) -> Vector2<f64> {
        Rotation2::new(self.turn(t)[0] * Self::profile(x0.norm())[0]) * x0
    }

    fn gradient(&self, x0: &Vector2<f64>, t: f64) -> Matrix2<f64> {
        let r = x0.norm();
        let [profile, slope, _] = Self::profile(r);
        let g = self.turn(t)[0];
        let radial = x0 / r;
        let hoop = Vector2::new(-radial.y, radial.x);
        let shear = Matrix2::identity() + hoop * radial.transpose() * (r * g * slope);
        Rotation2::new(g * profile).into_inner() * shear
    }

    fn first_velocity(&self, x0: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(-x0.y, x0.x) * (self.turn(0.0)[1] * Self::profile(x0.norm())[0])
    }

    fn body_force(&self, x0: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let r = x0.norm();
        let [profile, slope, curvature] = Self::profile(r);
        let [g, rate, second] = self.turn(t);
        let stiffness = self.law.elastic().shear_modulus() / self.law.density;
        let (slope, curvature) = (g * slope, g * curvature);
        let radial = -(rate * profile).powi(2) * r + stiffness * r * slope * slope;
        let hoop = second * profile * r - stiffness * (3.0 * slope + r * curvature);
        let x = self.position(x0, t);
        (x * radial + Vector2::new(-x.y, x.x) * hoop) / r
    }

    fn law(&self) -> NeoHookean {
        self.law
    }
}

impl Problem for VortexMms {
    fn name(&self) -> &'static str {
        "vortex-mms"
    }

    fn about(&self) -> &'static str {
        "manufactured vortex in a ring, large shear and rotation [Brannon et al. 2011]: errors and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["explicit", "implicit"]);
        parameters.extend([
            Parameter::number(
                "amplitude",
                "largest turn",
                "rad",
                0.1,
                Permitted::numbers(1e-4..=2.0),
            ),
            Parameter::number(
                "end",
                "length of the run over the period",
                "1",
                0.5,
                Permitted::numbers(0.01..=2.0),
            ),
            Parameter::number("period", "T: half a swing", "s", 1.0, Permitted::above(0.0)),
            Parameter::number("young", "Young's modulus", "Pa", 1e6, Permitted::above(0.0)),
            Parameter::number(
                "poisson",
                "Poisson's ratio",
                "1",
                0.3,
                Permitted::between(-1.0, 0.5),
            ),
            Parameter::number(
                "density",
                "mass density",
                "kg/m3",
                1050.0,
                Permitted::above(0.0),
            ),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = if quick { &SPACINGS[..2] } else { &SPACINGS[..] };
        let still = || {
            Overrides::new()
                .set("h", SPACINGS[1])
                .set("amplitude", 1e-4)
        };
        if quick {
            return vec![
                Overrides::new()
                    .sweep("h", spacings.iter().copied())
                    .set("shape", "bspline2"),
            ];
        }
        vec![
            Overrides::new()
                .sweep("h", spacings.iter().copied())
                .sweep("shape", method::SHAPES.iter().copied()),
            Overrides::new()
                .sweep("h", spacings.iter().copied())
                .set("shape", "bspline2")
                .sweep("transfer", ["apic", "fmpm"]),
            // In time, where particles stay where they are in their cells.
            still().sweep("cfl", [0.4, 0.2, 0.1, 0.05]),
            still()
                .set("solver", "implicit")
                .set("shape", "bspline2")
                .sweep("integration", ["theta", "newmark", "generalized-alpha"])
                .sweep("steps", [4_u64, 8, 16, 32]),
        ]
    }

    fn leading_error(&self) -> &'static str {
        "place_l2"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let h = method.spacing;
        let motion = Vortex {
            law: NeoHookean {
                density: case.number("density")?,
                young: case.number("young")?,
                poisson: case.number("poisson")?,
            },
            amplitude: case.number("amplitude")?,
            period: case.number("period")?,
        };
        let reach = ((RADII.1 / h).ceil() + 6.0) * h;
        let grid = Grid::over([-reach; 2], [reach; 2], h)
            .map_err(StudyError::failed("making the grid"))?;
        Following {
            motion,
            scene: ring(&motion.law, &grid).map_err(StudyError::failed("building the ring"))?,
            grid,
            end: case.number("end")? * motion.period,
            amplitude: motion.amplitude * 0.5 * (RADII.0 + RADII.1),
            counts: |_| true,
        }
        .run(case, method)
    }
}

fn ring(
    law: &NeoHookean,
    grid: &Grid<2>,
) -> Result<Scene<2>, Box<dyn std::error::Error + Send + Sync>> {
    let (inner, outer) = RADII;
    let ring =
        |inner: f64, outer: f64| Ball::new([0.0; 2], outer).minus(Ball::new([0.0; 2], inner));
    let region = ring(inner, outer);
    let seeds = whole(grid, &region, PI * (outer * outer - inner * inner))?;
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene.fill("body", *law, &region, &Seeded(seeds))?;
    // A cell off the edges: splines reach farther than linear functions.
    let h = grid.spacing();
    for (name, edge) in [
        ("inside", ring(inner - 3.0 * h, inner - h)),
        ("outside", ring(outer + h, outer + 3.0 * h)),
    ] {
        scene.rigid(
            name,
            &edge,
            &Spacing(0.5 * h),
            Hold::All(Vector2::x()),
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
        let vortex = Vortex {
            law: NeoHookean {
                density: 1050.0,
                young: 1e4,
                poisson: 0.3,
            },
            amplitude: 1.0,
            period: 1.0,
        };
        for (x, y, t) in [(0.9, 0.1, 0.3), (-0.7, 0.75, 0.8), (0.3, -1.1, 0.45)] {
            let left = imbalance(&vortex, &Vector2::new(x, y), t);
            assert!(left <= 1e-5, "{left} at {x}, {y}, {t}");
        }
    }
}
