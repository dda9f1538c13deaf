//! The bar as a scene: gripped at its ends, with ends that do not soften.

use fissure::nalgebra::SVector;
use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use crate::nairn::conjugate::StressMeasure;
use crate::nairn::numerics::{Numerics, check_whole_cells, seeding};

/// Name of the body.
pub(super) const BODY: &str = "bar";
/// Cells that a grip is long.
const GRIP: f64 = 2.0;
/// Cells of empty grid around everything.
const MARGIN: f64 = 4.0;
/// Thickness of a plane bar, m.
const THICKNESS: f64 = 1e-3;
/// Factors that put softening out of reach and keep the limit of the band.
const STRONG: Scale = Scale {
    stiffness: 1.0,
    strength: 1e3,
    toughness: 1e6,
};

/// The section of a bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    /// A bar in the plane.
    Plane(Flat),
    /// width × depth, in space.
    Rectangle,
    /// Diameter `width`, in space.
    Circle,
}

/// Which plane problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flat {
    Strain,
    Stress,
}

/// The bar that one set of parameters describes.
#[derive(Clone, Debug)]
pub(super) struct Bar {
    pub section: Section,
    pub length: f64,
    pub width: f64,
    pub depth: f64,
    pub law: AnisotropicDamage,
    /// Speed of the right grip along the bar, m/s; negative in compression.
    pub speed: f64,
    /// Until when it rises to that, s.
    rise: f64,
    /// When the run ends, s.
    pub end: f64,
    measure: StressMeasure,
    /// Whether a particle may have a second crack across its first.
    two_cracks: bool,
    buffer: f64,
    jitter: f64,
    seed: u64,
}

impl Bar {
    pub(super) fn new(case: &Parameters) -> Result<Self, StudyError> {
        let name = case.choice("case")?;
        let section = match name {
            "rectangle" | "square" => Section::Rectangle,
            "circle" => Section::Circle,
            _ => Section::Plane(match case.choice("plane")? {
                "stress" => Flat::Stress,
                _ => Flat::Strain,
            }),
        };
        check_whole_cells(case, &["length", "width"])?;
        if section == Section::Rectangle {
            check_whole_cells(case, &["depth"])?;
        }
        let toughness = case.number("toughness")?;
        let mode = |strength| Mode {
            strength,
            toughness,
            softening: softening::Linear,
        };
        let elastic = Isotropic {
            density: case.number("density")?,
            young: case.number("young")?,
            poisson: case.number("poisson")?,
        };
        let (opening, shear) = (case.number("strength")?, case.number("shear_strength")?);
        let mut law = AnisotropicDamage::new(elastic, mode(opening), mode(shear));
        let upright = case.choice("planes")? == "upright";
        if upright || matches!(section, Section::Plane(_)) {
            law.onset = Onset::InPlane;
        }
        let (length, buffer) = (case.number("length")?, case.number("buffer")?);
        if !(2.0 * buffer < length) {
            return Err(StudyError::combination(
                case,
                &["length", "buffer"],
                "the two buffers leave nothing to soften",
            ));
        }
        let measure = StressMeasure::of(case)?;
        let two_cracks = case.choice("cracks")? == "two";
        let (speed, rise) = (case.number("speed")?, case.number("rise")?);
        let end = case.number("strain")? * length / speed + 0.5 * rise;
        if !(end >= rise) {
            return Err(StudyError::combination(
                case,
                &["rise", "speed", "strain"],
                "the run ends before the grip has its speed",
            ));
        }
        Ok(Self {
            section,
            length,
            width: case.number("width")?,
            depth: case.number("depth")?,
            law,
            rise,
            end,
            speed: if name == "compression" { -speed } else { speed },
            measure,
            two_cracks,
            buffer,
            jitter: case.number("jitter")?,
            seed: case.count("seed")?,
        })
    }

    /// Stress at which the bar starts to fail, Pa: the smaller of σ_n and 2τ_t in tension, 2τ_t in
    /// compression.
    pub(super) fn strength(&self) -> f64 {
        let shear = 2.0 * self.law.shear.strength;
        if self.speed < 0.0 {
            return shear;
        }
        shear.min(self.law.opening.strength)
    }

    /// How far the right grip has gone at a time, m: its speed rises smoothly, as s²(3 − 2s), at first.
    pub(super) fn elongation(&self, time: f64) -> f64 {
        if time >= self.rise {
            return self.speed * (time - 0.5 * self.rise);
        }
        let part = time / self.rise;
        self.speed * self.rise * part.powi(3) * (1.0 - 0.5 * part)
    }

    /// Area of the section, m².
    pub(super) fn area(&self) -> f64 {
        match self.section {
            Section::Plane(_) => self.width * THICKNESS,
            Section::Rectangle => self.width * self.depth,
            Section::Circle => std::f64::consts::FRAC_PI_4 * self.width * self.width,
        }
    }

    /// Whether a place of rest is in the part that softens.
    pub(super) fn softens(&self, x: f64) -> bool {
        x > self.buffer && x < self.length - self.buffer
    }

    /// A plane bar and its solver.
    pub(super) fn in_plane(
        &self,
        flat: Flat,
        numerics: &Numerics,
    ) -> Result<(Scene<2>, Box<dyn Solver<2>>), StudyError> {
        let mut scene = Scene::plane(match flat {
            Flat::Strain => Plane::Strain {
                thickness: THICKNESS,
            },
            Flat::Stress => Plane::Stress {
                thickness: THICKNESS,
            },
        });
        let part = |from: f64, to: f64| Block::new([from, 0.0], [to, self.width]);
        self.build(&mut scene, numerics.spacing, Box::new(part))?;
        let grid = self.grid(numerics.spacing, [0.0; 2], [0.0, self.width])?;
        Ok((scene, numerics.solver(grid)?))
    }

    /// A bar in space and its solver.
    pub(super) fn in_space(
        &self,
        numerics: &Numerics,
        case: &Parameters,
    ) -> Result<(Scene<3>, Box<dyn Solver<3>>), StudyError> {
        let mut scene = Scene::solid();
        let spacing = numerics.spacing;
        if self.section == Section::Circle {
            let middle = 0.5 * self.width;
            let part = |from: f64, to: f64| {
                Cylinder::new([from, middle, middle], [to, middle, middle], middle)
            };
            self.build(&mut scene, spacing, Box::new(part))?;
            let grid = self.grid(spacing, [0.0; 3], [0.0, self.width, self.width])?;
            return Ok((scene, numerics.solver_in_space(case, grid)?));
        }
        let part = |from: f64, to: f64| Block::new([from, 0.0, 0.0], [to, self.width, self.depth]);
        self.build(&mut scene, spacing, Box::new(part))?;
        let grid = self.grid(spacing, [0.0; 3], [0.0, self.width, self.depth])?;
        Ok((scene, numerics.solver_in_space(case, grid)?))
    }

    /// Room for the bar, its grips and the way of the right one.
    fn grid<const D: usize>(
        &self,
        spacing: f64,
        mut min: [f64; D],
        mut max: [f64; D],
    ) -> Result<Grid<D>, StudyError> {
        let way = self.elongation(self.end).max(0.0);
        max[0] = self.length + (way / spacing).ceil() * spacing;
        for axis in 0..D {
            let grip = if axis == 0 { GRIP } else { 0.0 };
            min[axis] -= (grip + MARGIN) * spacing;
            max[axis] += (grip + MARGIN) * spacing;
        }
        Grid::over(min, max, spacing).map_err(StudyError::failed("making the grid"))
    }

    fn build<const D: usize, R: Region<D>>(
        &self,
        scene: &mut Scene<D>,
        spacing: f64,
        part: Box<dyn Fn(f64, f64) -> R + '_>,
    ) -> Result<(), StudyError> {
        let (seeding, grip) = (seeding(spacing), GRIP * spacing);
        let failed = || StudyError::failed("building the bar");
        let along = SVector::<f64, D>::from_fn(|i, _| if i == 0 { 1.0 } else { 0.0 });
        let (speed, rise) = (self.speed, self.rise);
        let speed = move |time: f64| {
            let part = if time < rise { time / rise } else { 1.0 };
            speed * part * part * (3.0 - 2.0 * part)
        };
        let whole = part(0.0, self.length);
        if self.two_cracks {
            let law = TwoCrackDamage(self.law);
            self.measure.fill(scene, BODY, law, &whole, &seeding)?;
        } else {
            self.measure.fill(scene, BODY, self.law, &whole, &seeding)?;
        }
        scene
            .rigid(
                "left",
                &part(-grip, 0.0),
                &seeding,
                Hold::Component(along),
                Velocity(|_| 0.0),
            )
            .map_err(failed())?
            .rigid(
                "right",
                &part(self.length, self.length + grip),
                &seeding,
                Hold::Component(along),
                Velocity(speed),
            )
            .map_err(failed())?;
        let noise = WhiteNoise { seed: self.seed };
        let marginal = Marginal::Normal {
            deviation: self.jitter.max(f64::MIN_POSITIVE),
            least: 0.1,
        };
        scene
            .set_scales(BODY, |id, x| {
                if !self.softens(x[0]) {
                    return STRONG;
                }
                let strength = if self.jitter > 0.0 {
                    marginal.of(noise.at(id))
                } else {
                    1.0
                };
                Scale {
                    strength,
                    ..Scale::default()
                }
            })
            .map_err(failed())?;
        Ok(())
    }
}
