//! The largest band that a softening law allows, found from below and above [Nairn 2017, eqs 36, 37].
//!
//! With `s = δ L σ/𝒢` a mode that damages takes the strain `x = ε σ⁻¹ C = k s + f(s)`,
//! `k = C 𝒢/(σ² L)`. The response to a strain is unique as long as `x` rises with `s`; where it does
//! not the strain would have to go back. The limit is bisected on samples of `f` alone, without its
//! derivative, and put beside `η C 𝒢/σ²` with the `η` of eq. 37 and beside the band up to which the
//! law itself accepts. At 99 % of it a point is then pulled to failure through the law.

use std::time::Instant;

use fissure::prelude::*;
use fissure_study::{
    Measures, Overrides, Parameter, Parameters, Permitted, Report, SimulationRow, Study, StudyError,
};

use crate::drawing::save;
use fissure::io::plot::{LinePlot, Style};

/// The double exponential: α²β = 1, where it is steepest at the start.
const DOUBLE: softening::DoubleExponential = softening::DoubleExponential {
    decay_ratio: 2.0,
    weight: 0.25,
};
/// Samples of a softening curve.
const SAMPLES: usize = 20_000;
/// Openings beyond this are not looked at where a curve has no end.
const FARTHEST: f64 = 40.0;

/// Strain over that at onset up to which the picture goes: beyond it next to nothing is left.
const SHOWN: f64 = 6.0;

/// The study `stability-eta`.
pub struct StabilityEta;

impl Study for StabilityEta {
    fn name(&self) -> &'static str {
        "stability-eta"
    }

    fn about(&self) -> &'static str {
        "the largest band of each softening law, from below and above, against eq. 36 [Nairn 2017, sec. 2.3]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let positive = || Permitted::above(0.0);
        vec![
            Parameter::choice(
                "softening",
                "the curve",
                "linear",
                &[
                    "linear",
                    "bilinear",
                    "power-2",
                    "power-4",
                    "exponential",
                    "cubic-step",
                    "double-exponential",
                ],
            )
            .sweep([
                "linear",
                "bilinear",
                "power-2",
                "power-4",
                "exponential",
                "cubic-step",
                "double-exponential",
            ]),
            Parameter::choice("mode", "of the crack", "opening", &["opening", "shear"])
                .sweep(["opening", "shear"]),
            Parameter::number("young", "Young's modulus", "Pa", 1e9, positive()),
            Parameter::number(
                "poisson",
                "Poisson's ratio",
                "1",
                0.33,
                Permitted::between(-1.0, 0.5),
            ),
            Parameter::number("strength", "of the mode", "Pa", 3e6, positive()),
            Parameter::number("toughness", "of the mode", "J/m2", 1000.0, positive()),
            Parameter::count(
                "steps",
                "to failure, for the point that is pulled",
                2000,
                Permitted::counts(10..=1_000_000),
            ),
        ]
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let all = Overrides::new();
        vec![if quick {
            all.set("steps", 200_u64)
        } else {
            all
        }]
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        let mut curves = Vec::new();
        for case in cases {
            let (row, curve) = match case.choice("softening")? {
                "bilinear" => one(case, softening::Bilinear::default())?,
                "power-2" => one(case, softening::PowerLaw { exponent: 2.0 })?,
                "power-4" => one(case, softening::PowerLaw { exponent: 4.0 })?,
                "exponential" => one(case, softening::Exponential)?,
                "cubic-step" => one(case, softening::CubicStep)?,
                "double-exponential" => one(case, DOUBLE)?,
                _ => one(case, softening::Linear)?,
            };
            report.row(row)?;
            if case.choice("mode")? == "opening" {
                curves.push((case.choice("softening")?.to_owned(), curve));
            }
        }
        let Some(folder) = report.out_dir() else {
            return Ok(());
        };
        let mut plot = LinePlot::new("A point pulled at 99 % of its limit")
            .x_label("strain over that at onset [1]")
            .y_label("traction over strength [1]")
            .x_range(0.0, SHOWN);
        for (label, (x, y)) in &curves {
            plot = plot.series(label, x, y, Style::Line);
        }
        if curves.is_empty() {
            return Ok(());
        }
        save(plot, &folder.join("pulled.png"))
    }
}

type XY = (Vec<f64>, Vec<f64>);

fn one<S: Softening>(case: &Parameters, curve: S) -> Result<(SimulationRow, XY), StudyError> {
    let start = Instant::now();
    let point = Point::new(case, curve)?;
    let (below, above) = point.bracket();
    let accepted = point.accepted()?;
    let pulled = point.pulled(0.99, case.size("steps")?)?;
    let twice = point.pulled(0.99, 2 * case.size("steps")?)?;
    let limit = point.limit();
    let mut row = SimulationRow::new("stability-eta", case);
    row.h = 0.99 * limit;
    row.solver = "point".to_owned();
    row.particles = 1;
    row.steps = case.count("steps")?;
    row.errors = Measures::new()
        .with("limit", (0.5 * (below + above) / limit - 1.0).abs())
        .with("accepted", (accepted / limit - 1.0).abs())
        .with("dissipated", (pulled.energy - 1.0).abs());
    row.values = Measures::new()
        .with("eta", curve.stability())
        .with("eta_below", below / limit * curve.stability())
        .with("eta_above", above / limit * curve.stability())
        .with("limit", limit)
        .with("largest_jump", pulled.jump)
        .with("jump_halved_steps", twice.jump)
        .with("snap_back_above", point.snap_back(1.01 * limit))
        .with("energy_imbalance", pulled.imbalance)
        .with("transfer_loss", 0.0);
    row.wall_s = start.elapsed().as_secs_f64();
    Ok((row, (pulled.strain, pulled.traction)))
}

/// One mode of one point.
struct Point<S> {
    curve: S,
    shear: bool,
    law: AnisotropicDamage<S, S>,
    /// C₁₁ or G, Pa.
    modulus: f64,
    strength: f64,
    toughness: f64,
}

struct Pulled {
    /// Dissipated per crack area over the toughness.
    energy: f64,
    /// Largest change of the traction in a step, over the strength.
    jump: f64,
    imbalance: f64,
    strain: Vec<f64>,
    traction: Vec<f64>,
}

impl<S: Softening> Point<S> {
    fn new(case: &Parameters, curve: S) -> Result<Self, StudyError> {
        let elastic = Isotropic {
            density: 1000.0,
            young: case.number("young")?,
            poisson: case.number("poisson")?,
        };
        let shear = case.choice("mode")? == "shear";
        let (strength, toughness) = (case.number("strength")?, case.number("toughness")?);
        let asked = Mode {
            strength,
            toughness,
            softening: curve,
        };
        // The other mode is far from failing, and its own limit far above.
        let other = Mode {
            strength: 1e2 * strength,
            toughness: 1e8 * toughness,
            softening: curve,
        };
        let mut law = if shear {
            AnisotropicDamage::new(elastic, other, asked)
        } else {
            AnisotropicDamage::new(elastic, asked, other)
        };
        law.onset = Onset::Prescribed(Vector3::x());
        law.mixed = MixedMode::Uncoupled;
        law.check()
            .map_err(StudyError::failed("checking the law"))?;
        Ok(Self {
            curve,
            shear,
            law,
            modulus: if shear {
                elastic.shear_modulus()
            } else {
                elastic.p_wave_modulus()
            },
            strength,
            toughness,
        })
    }

    /// `η C 𝒢/σ²`, m.
    fn limit(&self) -> f64 {
        self.curve.stability() * self.modulus * self.toughness / self.strength.powi(2)
    }

    fn openings(&self) -> impl Iterator<Item = f64> + '_ {
        let end = self.curve.critical().min(FARTHEST);
        (0..=SAMPLES).map(move |i| end * i as f64 / SAMPLES as f64)
    }

    /// How far the strain has to go back on this band, over that at onset.
    fn snap_back(&self, band: f64) -> f64 {
        let k = self.modulus * self.toughness / (self.strength.powi(2) * band);
        let (mut furthest, mut back) = (f64::NEG_INFINITY, 0.0_f64);
        for s in self.openings() {
            let x = k * s + self.curve.ratio(s);
            furthest = furthest.max(x);
            back = back.max(furthest - x);
        }
        back
    }

    /// The largest band found without and the smallest with a way back, m.
    fn bracket(&self) -> (f64, f64) {
        // Differences of samples resolve a way back of round-off size only.
        let goes_back = |band: f64| self.snap_back(band) > 1e-15;
        let scale = self.modulus * self.toughness / self.strength.powi(2);
        let (mut below, mut above) = (1e-3 * scale, 4.0 * scale);
        for _ in 0..60 {
            let middle = 0.5 * (below + above);
            if goes_back(middle) {
                above = middle;
            } else {
                below = middle;
            }
        }
        (below, above)
    }

    /// The largest band that the law accepts, m.
    fn accepted(&self) -> Result<f64, StudyError> {
        let scale = self.modulus * self.toughness / self.strength.powi(2);
        let (mut below, mut above) = (1e-3 * scale, 4.0 * scale);
        for _ in 0..60 {
            let middle = 0.5 * (below + above);
            match self
                .law
                .check_band(&Band::Uniform(middle), &Scale::default())
            {
                Ok(()) => below = middle,
                Err(MaterialError::Band { .. }) => above = middle,
                Err(other) => return Err(StudyError::failed("asking the law")(other)),
            }
        }
        Ok(below)
    }

    /// A point on `share` of the limit, strained evenly to failure (or until next to nothing is left).
    fn pulled(&self, share: f64, steps: usize) -> Result<Pulled, StudyError> {
        let band = share * self.limit();
        let k = self.modulus * self.toughness / (self.strength.powi(2) * band);
        let end = k * self.curve.critical().min(FARTHEST) * 1.01;
        let unit = self.strength / self.modulus;
        let mut step = Increment::to(Matrix3::identity());
        step.band = Band::Uniform(band);
        let mut state = self.law.initial();
        let mut pulled = Pulled {
            energy: 0.0,
            jump: 0.0,
            imbalance: 0.0,
            strain: vec![0.0],
            traction: vec![0.0],
        };
        let (mut work, mut stored) = (0.0, 0.0);
        for i in 1..=steps {
            let x = end * i as f64 / steps as f64;
            step.f_old = step.f_new;
            step.f_new = self.gradient(x * unit);
            let response = self
                .law
                .update(&step, &state)
                .map_err(StudyError::failed("pulling the point"))?;
            state = response.state;
            let traction = self.traction(&response, &step.f_new)?;
            let (last_x, last) = (pulled.strain[i - 1], pulled.traction[i - 1]);
            work += 0.5 * (last + traction) * self.strength * (x - last_x) * unit;
            stored = response.stored;
            pulled.energy += response.dissipated * band / self.toughness;
            pulled.jump = pulled.jump.max((traction - last).abs());
            pulled.strain.push(x);
            pulled.traction.push(traction);
        }
        let dissipated = pulled.energy * self.toughness / band;
        pulled.imbalance = (work - stored - dissipated) / work.max(dissipated);
        Ok(pulled)
    }

    /// The deformation whose Biot strain is `strain` in the mode asked for (engineering in shear).
    fn gradient(&self, strain: f64) -> Matrix3<f64> {
        let mut f = Matrix3::identity();
        if self.shear {
            f.m12 = 0.5 * strain;
            f.m21 = 0.5 * strain;
        } else {
            f.m11 += strain;
        }
        f
    }

    /// The traction of the law, over the strength.
    fn traction(
        &self,
        response: &Response<<AnisotropicDamage<S, S> as Material>::State>,
        f: &Matrix3<f64>,
    ) -> Result<f64, StudyError> {
        let rotation = Biot::new(f)
            .map_err(StudyError::failed("taking the rotation"))?
            .rotation;
        let stress = response.stress.rotated(&rotation.transpose());
        let component = if self.shear { stress.xy() } else { stress.xx() };
        Ok(component / self.strength)
    }
}
