//! The bar as a scene: turned against the grid, gripped at its ends, weak in the middle.

use fissure::materials::multi_crack::{Shear, Unloading};
use fissure::prelude::*;

use fissure_study::{Parameters, StudyError};

use super::exact::Exact;
use crate::filling::{Seeded, clipped, cut};

type Point = Vector2<f64>;

/// The bar that one set of parameters describes.
#[derive(Clone, Debug)]
pub(crate) struct Bar {
    pub length: f64,
    pub width: f64,
    pub depth: f64,
    /// Angle against the grid, rad.
    pub angle: f64,
    pub spacing: f64,
    pub elastic: Isotropic,
    pub strength: f64,
    pub toughness: f64,
    pub weakening: f64,
    /// Part of the length, in the middle, that can fail.
    failing: f64,
    law: String,
    weak: Weak,
    /// Way of the grid against the bar, cells.
    offset: Point,
    fill: Fill,
    clamped: bool,
    gap: f64,
}

/// Where the particles are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fill {
    /// On a lattice that turns with the bar.
    Rotated,
    /// At the same places in every cell.
    Cell,
    /// In the middle of the parts of cells.
    Cut,
}

/// Where the bar is weaker [Sanchez 2010, sec. 5.4].
#[derive(Clone, Copy, Debug)]
enum Weak {
    /// A line of one cell across the bar.
    Line,
    /// Two such lines, at a third and two thirds; the second is less weak by this share.
    TwoLines(f64),
    /// A square of this side in the middle, m.
    Square(f64),
    /// The particle nearest to the middle.
    Point,
}

/// Sub-cell offsets of the bar against the grid: eight, spread evenly, the first of them none.
pub(crate) const OFFSETS: u64 = 8;

/// Strength of what is elastic over that of the rest.
const NEVER: f64 = 1e3;

/// Name of the body.
pub(crate) const BODY: &str = "bar";

impl Bar {
    /// A bar that does not snap back.
    pub(crate) fn new(parameters: &Parameters) -> Result<Self, StudyError> {
        let bar = Self::of_any_length(parameters)?;
        let exact = bar.exact();
        if !(bar.length < exact.length_limit()) {
            let limit = exact.length_limit();
            return Err(StudyError::combination(
                parameters,
                &[
                    "length",
                    "young",
                    "poisson",
                    "strength",
                    "weakening",
                    "toughness",
                ],
                format!(
                    "the bar snaps back from a length of {limit:.4} m [Sanchez 2010, eq. 5.2.15]"
                ),
            ));
        }
        Ok(bar)
    }

    pub(crate) fn of_any_length(parameters: &Parameters) -> Result<Self, StudyError> {
        let angle = parameters.number("angle")?.to_radians();
        let offset = parameters.count("offset")? as f64;
        let bar = Self {
            length: parameters.number("length")?,
            width: parameters.number("width")?,
            depth: parameters.number("depth")?,
            angle,
            spacing: parameters.number("h")?,
            elastic: Isotropic {
                density: parameters.number("density")?,
                young: parameters.number("young")?,
                poisson: parameters.number("poisson")?,
            },
            strength: parameters.number("strength")?,
            toughness: parameters.number("toughness")?,
            failing: parameters.number("failing")?,
            law: parameters.choice("law")?.to_owned(),
            weak: match parameters.choice("weak")? {
                "square" => Weak::Square(parameters.number("weak_side")?),
                "point" => Weak::Point,
                "two-lines" => Weak::TwoLines(parameters.number("imperfection")?),
                _ => Weak::Line,
            },
            // A rank-1 lattice: both coordinates take each eighth of a cell once.
            offset: Point::new(offset, (3.0 * offset) % OFFSETS as f64) / OFFSETS as f64,
            weakening: parameters.number("weakening")?,
            fill: match parameters.choice("fill")? {
                "cell" => Fill::Cell,
                "cut" => Fill::Cut,
                _ => Fill::Rotated,
            },
            clamped: parameters.choice("ends")? == "clamped",
            gap: parameters.number("gap")?,
        };
        for side in [bar.length, bar.width] {
            let cells = side / bar.spacing;
            if !((cells - cells.round()).abs() <= 1e-6 && cells.round() >= 1.0) {
                return Err(StudyError::combination(
                    parameters,
                    &["h", "length", "width"],
                    "length and width must be whole numbers of cells",
                ));
            }
        }
        Ok(bar)
    }

    /// The response of the weak section.
    pub(crate) fn exact(&self) -> Exact {
        let elastic = &self.elastic;
        Exact {
            length: self.length,
            area: self.width * self.depth,
            modulus: elastic.young / (1.0 - elastic.poisson * elastic.poisson),
            strength: self.strength * self.weakening,
            toughness: self.toughness,
        }
    }

    /// The response without the weakening.
    pub(crate) fn nominal(&self) -> Exact {
        Exact {
            strength: self.strength,
            ..self.exact()
        }
    }

    /// Direction of the bar.
    pub(crate) fn axis(&self) -> Point {
        Point::new(self.angle.cos(), self.angle.sin())
    }

    fn centre(&self) -> Point {
        Point::new(0.5 * self.length, 0.5 * self.width)
    }

    /// Its corners, counter-clockwise, m.
    fn outline(&self) -> [Point; 4] {
        let along = self.axis() * (0.5 * self.length);
        let across = Point::new(-self.axis().y, self.axis().x) * (0.5 * self.width);
        [
            -along - across,
            along - across,
            along + across,
            across - along,
        ]
        .map(|way| self.centre() + way)
    }

    /// Place along the bar, 0 to its length, of a point of the turned bar.
    pub(crate) fn along(&self, x: &Point) -> f64 {
        (x - self.centre()).dot(&self.axis()) + 0.5 * self.length
    }

    /// The middle of the weak line, m.
    pub(crate) fn middle_of_line(&self) -> Point {
        let (start, end) = self.line_at(0.5);
        self.centre() + self.axis() * (0.5 * (start + end - self.length))
    }

    /// A line of one cell across the bar, as a range along it.
    fn line_at(&self, place: f64) -> (f64, f64) {
        let cell = (place * self.length / self.spacing + 1e-6).floor();
        (cell * self.spacing, (cell + 1.0) * self.spacing)
    }

    /// A grid that holds the bar, the grips and what they reach.
    pub(crate) fn grid(&self) -> Result<Grid<2>, StudyError> {
        let reach = 0.5 * self.length.hypot(self.width) + 8.0 * self.spacing;
        let cells = (reach / self.spacing).ceil();
        // Without an offset nodes are at whole multiples of the spacing from the corner of the
        // unturned bar.
        let floor =
            |x: f64, offset: f64| ((x / self.spacing).floor() - cells - offset) * self.spacing;
        let x = floor(0.5 * self.length, self.offset.x);
        let y = floor(0.5 * self.width, self.offset.y);
        let size = (2.0 * cells + 1.0) * self.spacing;
        Grid::over([x, y], [x + size, y + size], self.spacing)
            .map_err(StudyError::failed("making the grid"))
    }

    /// The scene; `speed` moves the right grip along the bar.
    pub(crate) fn scene(
        &self,
        grid: &Grid<2>,
        speed: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Result<Scene<2>, StudyError> {
        self.build(grid, speed)
            .map_err(StudyError::failed("building the bar"))
    }

    fn build(
        &self,
        grid: &Grid<2>,
        speed: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Result<Scene<2>, Box<dyn std::error::Error + Send + Sync>> {
        let mut scene = Scene::plane(Plane::Strain {
            thickness: self.depth,
        });
        let (length, width) = (self.length, self.width);
        let block = Block::new([0.0, 0.0], [length, width]);
        let seeds = match self.fill {
            Fill::Rotated => self.lattice(&block)?,
            Fill::Cell => {
                let turned = block.rotated(self.angle, self.centre().into());
                clipped(grid, &turned, length * width)?
            }
            Fill::Cut => cut(grid, &self.outline()),
        };
        self.fill(&mut scene, seeds)?;
        self.weaken(&mut scene)?;
        // Grips stand off a turned bar so that they reach only nodes around its ends (fig. 5.6).
        let gap = if self.angle == 0.0 && self.offset == Point::zeros() {
            0.0
        } else {
            self.gap * self.spacing
        };
        let grip = 2.0 * self.spacing;
        let hold = if self.clamped {
            Hold::All(self.axis())
        } else {
            Hold::Component(self.axis())
        };
        let left = Block::new([-gap - grip, 0.0], [-gap, width]);
        let right = Block::new([length + gap, 0.0], [length + gap + grip, width]);
        scene.rigid(
            "left",
            &left,
            &Seeded(self.lattice(&left)?),
            hold,
            Velocity(|_| 0.0),
        )?;
        scene.rigid(
            "right",
            &right,
            &Seeded(self.lattice(&right)?),
            hold,
            Velocity(speed),
        )?;
        Ok(scene)
    }

    /// Adds the body with the law that the parameters name.
    fn fill(&self, scene: &mut Scene<2>, seeds: Seeds<2>) -> Result<(), SceneError> {
        let axis = self.axis();
        let decohesive = |normal| Decohesive {
            elastic: self.elastic,
            strength: self.strength,
            toughness: self.toughness,
            softening: softening::Linear,
            normal,
        };
        let plane = |shear, planes| MultiCrack::<1, _> {
            elastic: self.elastic,
            decohesion: ModeOne {
                strength: self.strength,
                toughness: self.toughness,
                softening: softening::Linear,
                unloading: Unloading::Permanent,
                shear,
            },
            planes,
        };
        match self.law.as_str() {
            "rankine" => scene.add_body(BODY, decohesive(Normal::Rankine), seeds)?,
            "no-shear" => scene.add_body(BODY, plane(Shear::Coulomb(0.0), Planes::Fixed), seeds)?,
            "damaged-shear" => {
                scene.add_body(BODY, plane(Shear::Damaged(0.0), Planes::Fixed), seeds)?
            }
            "elastic" => scene.add_body(BODY, self.elastic, seeds)?,
            "rotating" => scene.add_body(BODY, plane(Shear::Elastic, Planes::Rotating), seeds)?,
            _ => {
                let normal = Normal::Prescribed(Vector3::new(axis.x, axis.y, 0.0));
                scene.add_body(BODY, decohesive(normal), seeds)?
            }
        };
        Ok(())
    }

    /// Sets strengths: elastic beyond the part that can fail, weaker where the crack is to start.
    fn weaken(&self, scene: &mut Scene<2>) -> Result<(), SceneError> {
        if self.failing < 1.0 {
            let half = 0.5 * self.failing * self.length;
            let beyond = |x: &Point| (self.along(x) - 0.5 * self.length).abs() > half;
            // The toughness with the square: the greatest width of a crack stays.
            let never = Scale {
                strength: NEVER,
                toughness: NEVER * NEVER,
                ..Scale::default()
            };
            scene.set_scale(BODY, beyond, never)?;
        }
        if self.weakening == 1.0 {
            return Ok(());
        }
        let weaker = |strength| Scale {
            strength,
            ..Scale::default()
        };
        let weak = weaker(self.weakening);
        let within =
            |(start, end): (f64, f64)| move |x: &Point| (start..end).contains(&self.along(x));
        match self.weak {
            Weak::Line => scene.set_scale(BODY, within(self.line_at(0.5)), weak)?,
            Weak::TwoLines(imperfection) => {
                let second = weaker(self.weakening * (1.0 + imperfection));
                scene.set_scale(BODY, within(self.line_at(1.0 / 3.0)), weak)?;
                scene.set_scale(BODY, within(self.line_at(2.0 / 3.0)), second)?
            }
            Weak::Square(side) => {
                let half = 0.5 * side;
                let inside = |x: &Point| {
                    let away = x - self.centre();
                    let across = self.axis().perp(&away);
                    away.dot(&self.axis()).abs() <= half && across.abs() <= half
                };
                scene.set_scale(BODY, inside, weak)?
            }
            Weak::Point => {
                let positions = scene.bodies()[0].motion().position;
                let away = |x: &Point| (x - self.centre()).norm();
                let nearest = positions
                    .iter()
                    .copied()
                    .min_by(|a, b| away(a).total_cmp(&away(b)))
                    .unwrap_or_else(Point::zeros);
                scene.set_scale(BODY, move |x| *x == nearest, weak)?
            }
        };
        Ok(())
    }

    /// Two particles per cell and axis on a lattice that turns with the bar about its centre.
    fn lattice(&self, region: &Block<2>) -> Result<Seeds<2>, SeedError> {
        let turned = Turned {
            inner: Spacing(0.5 * self.spacing),
            angle: self.angle,
            centre: self.centre().into(),
        };
        turned.seed(region)
    }
}
