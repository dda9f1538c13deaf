//! The spinning disc in plane stress (A12) [Timoshenko and Goodier 1970, sec. 32].
//!
//! `σ_r = (3 + ν)/8 ρω² (R² − r²)`, `σ_θ = ρω²/8 ((3 + ν) R² − (1 + 3ν) r²)`,
//! `u_r = ρω²/(8E) ((1 − ν)(3 + ν) R² r − (1 − ν²) r³)`. With `solver=explicit` the disc turns, from
//! this solution on; with `solver=quasi-static` it rests under the centrifugal force `ω² x`.

use std::f64::consts::PI;

use fissure::materials::Hencky;
use fissure::prelude::*;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, StudyError};

use crate::filling::{Seeded, clipped, whole};
use crate::method::{self, Method};
use crate::problem::{Outcome, Problem, run_to};

/// The study `disc-spin`.
pub struct DiscSpin;

/// Spacings of the default run over the radius of 1 m.
const SPACINGS: [f64; 4] = [0.2, 0.1, 0.05, 0.025];
const RADIUS: f64 = 1.0;

#[derive(Clone, Copy, Debug)]
struct Disc {
    /// Of the Hencky law: the disc turns, so that it has to be objective.
    law: Isotropic,
    /// Angular velocity, 1/s.
    spin: f64,
}

impl Disc {
    /// ρω², Pa/m².
    fn load(&self) -> f64 {
        self.law.density * self.spin * self.spin
    }

    /// Radial and hoop stress, Pa.
    fn stress(&self, r: f64) -> (f64, f64) {
        let (nu, r2) = (self.law.poisson, r * r);
        let load = self.load() / 8.0;
        let whole = (3.0 + nu) * RADIUS * RADIUS;
        (
            load * (whole - (3.0 + nu) * r2),
            load * (whole - (1.0 + 3.0 * nu) * r2),
        )
    }

    /// Displacement over radius, and its slope with the radius, dimensionless.
    fn stretch(&self, r: f64) -> (f64, f64) {
        let nu = self.law.poisson;
        let load = self.load() / (8.0 * self.law.young);
        let first = load * (1.0 - nu) * (3.0 + nu) * RADIUS * RADIUS;
        let third = load * (1.0 - nu * nu) * r * r;
        (first - third, first - 3.0 * third)
    }

    fn scene(
        &self,
        grid: &Grid<2>,
        turns: bool,
    ) -> Result<Scene<2>, Box<dyn std::error::Error + Send + Sync>> {
        let region = Ball::new([0.0; 2], RADIUS);
        // Slivers at the rim would fly off a disc that turns.
        let fill = if turns { whole } else { clipped };
        let seeds = fill(grid, &region, PI * RADIUS * RADIUS)?;
        let mut scene = Scene::plane(Plane::Stress { thickness: 1.0 });
        scene.fill(
            "disc",
            Hencky { elastic: self.law },
            &region,
            &Seeded(seeds),
        )?;
        Ok(scene)
    }

    /// Gives the particles the exact places, strains, stresses and velocities of a steady turn.
    fn start(&self, scene: &mut Scene<2>) -> Result<(), SceneError> {
        let motion = &mut scene.bodies_mut()[0].particles_mut().motion;
        for row in 0..motion.len() {
            let x = motion.position[row];
            let r = x.norm();
            let (hoop, radial) = self.stretch(r);
            let (stress_r, stress_t) = self.stress(r);
            let n = x / r;
            let mut f = Matrix3::identity();
            let mut stress = Matrix3::zeros();
            for i in 0..2 {
                for j in 0..2 {
                    let along = n[i] * n[j];
                    let across = if i == j { 1.0 - along } else { -along };
                    f[(i, j)] += radial * along + hoop * across;
                    stress[(i, j)] = stress_r * along + stress_t * across;
                }
            }
            f.m33 -= self.law.poisson / self.law.young * (stress_r + stress_t);
            motion.deformation_gradient[row] = f;
            motion.stress[row] = Sym::from_matrix(&stress);
            motion.position[row] = x * (1.0 + hoop);
        }
        let spin = self.spin;
        scene.set_velocity("disc", |x| Vector2::new(-x.y, x.x) * spin)?;
        Ok(())
    }
}

/// Radial, hoop and shear stress of a particle at a place, Pa.
fn polar(stress: &Sym, x: &Vector2<f64>) -> [f64; 3] {
    let n = x / x.norm();
    let (xx, yy, xy) = (stress.xx(), stress.yy(), stress.xy());
    let (cc, ss, cs) = (n.x * n.x, n.y * n.y, n.x * n.y);
    [
        xx * cc + yy * ss + 2.0 * xy * cs,
        xx * ss + yy * cc - 2.0 * xy * cs,
        (yy - xx) * cs + xy * (cc - ss),
    ]
}

/// Stresses of particles summed over steps, by id.
struct Mean {
    stresses: Vec<[f64; 3]>,
    count: f64,
}

impl Mean {
    fn of(scene: &Scene<2>) -> Self {
        Self {
            stresses: vec![[0.0; 3]; scene.particle_count()],
            count: 0.0,
        }
    }

    fn add(&mut self, scene: &Scene<2>) {
        let body = &scene.bodies()[0];
        let motion = body.motion();
        for (row, id) in body.particles().id.iter().enumerate() {
            let sum = &mut self.stresses[id.0 as usize];
            let now = polar(&motion.stress[row], &motion.position[row]);
            (0..3).for_each(|i| sum[i] += now[i]);
        }
        self.count += 1.0;
    }
}

impl Problem for DiscSpin {
    fn name(&self) -> &'static str {
        "disc-spin"
    }

    fn about(&self) -> &'static str {
        "stresses of a spinning disc in plane stress, in turning and under its centrifugal force: errors and orders"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&SPACINGS, &["quasi-static", "explicit"]);
        parameters.extend([
            Parameter::number(
                "rim_speed",
                "speed of the rim over that of sound",
                "1",
                0.05,
                Permitted::between(0.0, 0.3),
            ),
            Parameter::number(
                "turns",
                "length of a dynamic run",
                "1",
                1.0,
                Permitted::numbers(0.1..=1000.0),
            ),
            Parameter::number("young", "Young's modulus", "Pa", 1e7, Permitted::above(0.0)),
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
                1000.0,
                Permitted::above(0.0),
            ),
        ]);
        parameters
    }

    fn cases(&self, quick: bool) -> Vec<Overrides> {
        let spacings = if quick { &SPACINGS[..2] } else { &SPACINGS[..] };
        let shapes: &[&str] = if quick {
            &["linear"]
        } else {
            &["linear", "bspline2"]
        };
        let mut cases = vec![
            Overrides::new()
                .set("solver", "quasi-static")
                .sweep("h", spacings.iter().copied())
                .sweep("shape", shapes.iter().copied()),
        ];
        if !quick {
            cases.push(
                Overrides::new()
                    .set("solver", "explicit")
                    .sweep("h", SPACINGS[..3].iter().copied())
                    .set("shape", "bspline2")
                    .set("transfer", "apic"),
            );
        }
        cases
    }

    fn leading_error(&self) -> &'static str {
        "stress_l2"
    }

    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError> {
        let law = Isotropic {
            density: case.number("density")?,
            young: case.number("young")?,
            poisson: case.number("poisson")?,
        };
        // Far slower in the quasi-static case: the solution is that of small strain.
        let rim = if method.is_dynamic() {
            case.number("rim_speed")?
        } else {
            1e-3
        };
        let disc = Disc {
            law,
            spin: rim * law.p_wave_speed() / RADIUS,
        };
        let h = method.spacing;
        let reach = ((RADIUS / h).ceil() + 4.0) * h;
        let grid = Grid::over([-reach; 2], [reach; 2], h)
            .map_err(StudyError::failed("making the grid"))?;
        let mut scene = disc
            .scene(&grid, method.is_dynamic())
            .map_err(StudyError::failed("building the disc"))?;
        let mut mean = Mean::of(&scene);
        let radii = radii(&scene);
        let turn = 2.0 * PI / disc.spin;
        let end = if method.is_dynamic() {
            case.number("turns")? * turn
        } else {
            1.0
        };
        let mut solver = method.build(grid, BandSource::default(), end)?;
        let wall_s = if method.is_dynamic() {
            disc.start(&mut scene)
                .map_err(StudyError::failed("starting the disc"))?;
            let mut wall_s = run_to(&mut scene, &mut *solver, end - 0.5 * turn, case)?;
            // The mean over half a turn: what the start left swings about it.
            while scene.time() < end {
                let next = end.min(scene.time() + turn / 64.0);
                wall_s += run_to(&mut scene, &mut *solver, next, case)?;
                mean.add(&scene);
            }
            wall_s
        } else {
            let squared = disc.spin * disc.spin;
            scene.body_force(move |x, _| x * squared);
            let wall_s = run_to(&mut scene, &mut *solver, end, case)?;
            mean.add(&scene);
            wall_s
        };
        Ok(compare(&disc, scene, wall_s, &mean, &radii))
    }
}

/// Radii at the start, by id, m.
fn radii(scene: &Scene<2>) -> Vec<f64> {
    let positions = crate::convergence::positions(scene);
    positions.iter().map(|x| x.norm()).collect()
}

fn compare(disc: &Disc, scene: Scene<2>, wall_s: f64, mean: &Mean, radii: &[f64]) -> Outcome {
    let body = &scene.bodies()[0];
    let middle = disc.stress(0.0).0;
    let (mut off, mut whole, mut centre, mut near) = (0.0, 0.0, 0.0, 0.0);
    let (mut moved, mut ways) = (0.0, 0.0);
    let mut field = vec![0.0; radii.len()];
    let first_ring = radii.iter().copied().fold(f64::INFINITY, f64::min);
    for (row, id) in body.particles().id.iter().enumerate() {
        let id = id.0 as usize;
        let (volume, r) = (body.particles().volume[row], radii[id]);
        let found = mean.stresses[id].map(|sum| sum / mean.count);
        let (radial, hoop) = disc.stress(r);
        let away = (found[0] - radial).powi(2) + (found[1] - hoop).powi(2) + 2.0 * found[2].powi(2);
        off += volume * away;
        whole += volume * (radial * radial + hoop * hoop);
        field[row] = away.sqrt() / middle;
        if r <= 1.01 * first_ring {
            centre += 0.5 * (found[0] + found[1]);
            near += 0.5 * (radial + hoop);
        }
        let way = disc.stretch(r).0 * r;
        moved += volume * (body.motion().position[row].norm() - r - way).powi(2);
        ways += volume * way * way;
    }
    let mut outcome = Outcome::of(scene, wall_s);
    outcome.errors.insert("stress_l2", (off / whole).sqrt());
    outcome.errors.insert("centre", (centre / near - 1.0).abs());
    outcome.errors.insert("radius_l2", (moved / ways).sqrt());
    outcome.field = Some(("stress error over stress at the centre [1]", field));
    outcome
}
