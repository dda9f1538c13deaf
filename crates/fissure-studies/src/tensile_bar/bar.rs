//! The bar as a scene: turned against the grid, gripped at its ends, weak in the middle.

use fissure::prelude::*;
use nalgebra::SMatrix;

use super::exact::Exact;
use fissure_study::{Parameters, StudyError};

type Point = Vector2<f64>;

/// The bar that one set of parameters describes.
#[derive(Clone, Debug)]
pub(super) struct Bar {
    pub length: f64,
    pub width: f64,
    pub depth: f64,
    /// Angle against the grid, rad.
    pub angle: f64,
    pub spacing: f64,
    pub law: Decohesive,
    pub weakening: f64,
    rotated_fill: bool,
    clamped: bool,
    gap: f64,
}

/// Name of the body.
pub(super) const BODY: &str = "bar";

impl Bar {
    pub(super) fn new(parameters: &Parameters) -> Result<Self, StudyError> {
        let angle = parameters.number("angle")?.to_radians();
        let (sine, cosine) = angle.sin_cos();
        let bar = Self {
            length: parameters.number("length")?,
            width: parameters.number("width")?,
            depth: parameters.number("depth")?,
            angle,
            spacing: parameters.number("h")?,
            law: Decohesive {
                elastic: Isotropic {
                    density: parameters.number("density")?,
                    young: parameters.number("young")?,
                    poisson: parameters.number("poisson")?,
                },
                strength: parameters.number("strength")?,
                toughness: parameters.number("toughness")?,
                softening: softening::Linear,
                normal: Normal::Prescribed(Vector3::new(cosine, sine, 0.0)),
            },
            weakening: parameters.number("weakening")?,
            rotated_fill: parameters.choice("fill")? == "rotated",
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

    /// The response of the weak section.
    pub(super) fn exact(&self) -> Exact {
        let elastic = &self.law.elastic;
        Exact {
            length: self.length,
            area: self.width * self.depth,
            modulus: elastic.young / (1.0 - elastic.poisson * elastic.poisson),
            strength: self.law.strength * self.weakening,
            toughness: self.law.toughness,
        }
    }

    /// The response without the weakening.
    pub(super) fn nominal(&self) -> Exact {
        Exact {
            strength: self.law.strength,
            ..self.exact()
        }
    }

    /// Direction of the bar.
    pub(super) fn axis(&self) -> Point {
        Point::new(self.angle.cos(), self.angle.sin())
    }

    fn centre(&self) -> Point {
        Point::new(0.5 * self.length, 0.5 * self.width)
    }

    /// Place along the bar, 0 to its length, of a point of the turned bar.
    pub(super) fn along(&self, x: &Point) -> f64 {
        (x - self.centre()).dot(&self.axis()) + 0.5 * self.length
    }

    /// The cell-wide line across the middle that is weaker, as a range along the bar.
    fn weak_line(&self) -> (f64, f64) {
        let cell = (0.5 * self.length / self.spacing + 1e-6).floor();
        (cell * self.spacing, (cell + 1.0) * self.spacing)
    }

    /// A grid that holds the bar, the grips and what they reach.
    pub(super) fn grid(&self) -> Result<Grid<2>, StudyError> {
        let reach = 0.5 * self.length.hypot(self.width) + 8.0 * self.spacing;
        let cells = (reach / self.spacing).ceil();
        // Nodes stay at whole multiples of the spacing from the corner of the unturned bar.
        let floor = |x: f64| ((x / self.spacing).floor() - cells) * self.spacing;
        let (x, y) = (floor(0.5 * self.length), floor(0.5 * self.width));
        let size = (2.0 * cells + 1.0) * self.spacing;
        Grid::over([x, y], [x + size, y + size], self.spacing)
            .map_err(StudyError::failed("making the grid"))
    }

    /// The scene; `speed` moves the right grip along the bar.
    pub(super) fn scene(
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
        let seeds = if self.rotated_fill {
            self.lattice(&block)?
        } else {
            let fill = InCell {
                origin: grid.origin().into(),
                cell: self.spacing,
                per_axis: 2,
                clip: true,
            };
            let mut seeds = fill.seed(&block.rotated(self.angle, self.centre().into()))?;
            // Slivers of the bar in sub-cells whose centre is outside belong to nobody: shared out.
            let missing = length * width / seeds.total_volume();
            seeds
                .volume
                .iter_mut()
                .for_each(|volume| *volume *= missing);
            seeds
        };
        scene.add_body(BODY, self.law, seeds)?;
        if self.weakening < 1.0 {
            let (start, end) = self.weak_line();
            let weak = Scale {
                strength: self.weakening,
                ..Scale::default()
            };
            let inside = |x: &Point| (start..end).contains(&self.along(x));
            scene.set_scale(BODY, inside, weak)?;
        }
        // Grips stand off a turned bar so that they reach only nodes around its ends (fig. 5.6).
        let gap = if self.angle == 0.0 {
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

/// Seeds that are already there.
struct Seeded(Seeds<2>);

impl Seeding<2> for Seeded {
    fn seed(&self, _region: &dyn Region<2>) -> Result<Seeds<2>, SeedError> {
        let half_edges: SMatrix<f64, 2, 2> = self.0.half_edges;
        Ok(Seeds {
            position: self.0.position.clone(),
            volume: self.0.volume.clone(),
            half_edges,
        })
    }
}
