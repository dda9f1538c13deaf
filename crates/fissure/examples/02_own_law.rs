//! A law of one's own: from a struct to the contract to a scene.
//!
//! New here: `Material`, `contract::check`. Read before: `00_point`. `docs/own-law.md` goes
//! through this file.
#![allow(clippy::print_stdout)]

use fissure::prelude::*;

/// Elastic, with a stiffness that falls to a share of itself beyond a knee: with the Biot strain
/// `E = U − 1` and its norm `q² = E:C:E/Y` (Y is Young's modulus) the energy is `ψ = Y f(q)`,
/// `f' = q` up to the knee and `knee + share (q − knee)` after it; `T = ∂ψ/∂E = C:E f'/q`.
struct Bilinear {
    elastic: Isotropic,
    /// Norm of the strain at which the stiffness falls; > 0.
    knee: f64,
    /// Stiffness after over stiffness before; in (0, 1].
    share: f64,
}

impl Material for Bilinear {
    type State = (); // elastic: nothing to remember

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for("bilinear")?;
        check_parameter("bilinear", "knee", self.knee, self.knee > 0.0, "> 0")?;
        let valid = self.share > 0.0 && self.share <= 1.0;
        check_parameter("bilinear", "share", self.share, valid, "in (0, 1]")
    }
    fn density(&self) -> f64 {
        self.elastic.density
    }
    fn wave_speed(&self, f: &Matrix3<f64>, _: &(), scale: &Scale) -> f64 {
        self.elastic.scaled(scale).p_wave_speed() * Biot::longest_stretch(f)
    }
    fn update(&self, step: &Increment, _: &()) -> Result<Response<()>, MaterialError> {
        let kinematics = Biot::new(&step.f_new)?; // rotations drop out, F is checked
        let strain = kinematics.strain();
        let elastic = self.elastic.scaled(&step.external.scale);
        let stress = elastic.stress(&strain);
        let q = (stress.dot(&strain) / elastic.young).sqrt();
        let (low, beyond) = (q.min(self.knee), (q - self.knee).max(0.0));
        let slope = low + self.share * beyond;
        let secant = if q > 0.0 { slope / q } else { 1.0 };
        Ok(Response {
            stress: kinematics.cauchy(&(stress * secant)),
            state: (),
            stored: elastic.young * 0.5 * (low * low + beyond * (low + slope)),
            dissipated: 0.0,
        })
    }
}

fn main() -> Result<(), Error> {
    let elastic = Isotropic {
        density: 1200.0,
        young: 3e9,
        poisson: 0.35,
    };
    let law = Bilinear {
        elastic,
        knee: 0.01,
        share: 0.3,
    };
    println!("{}", contract::check(&law)?);

    let along = Hold::Component(Vector2::x());
    let mut scene = Scene::plane(Plane::Stress { thickness: 1e-3 });
    scene
        .fill(
            "strip",
            law,
            &Block::new([0.0, 0.0], [0.1, 0.02]),
            &Spacing(5e-3),
        )?
        .hold("left", "strip", |x| x[0] < 0.005, along, Constant(0.0))?
        .hold("right", "strip", |x| x[0] > 0.095, along, Constant(2e-4))?;
    let grid = Grid::over([-0.04, -0.04], [0.16, 0.06], 0.01)?;
    let settings = QuasiStaticSettings::default();
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings)?;
    while scene.time() < 10.0 {
        let report = solver.step(&mut scene, 10.0)?;
        println!(
            "t = {:4.1} s, force {:7.2} N",
            report.time, report.reactions[1][0]
        );
    }
    Ok(())
}
