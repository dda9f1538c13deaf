//! The compact-tension specimen [Sanchez 2010, app. C; Wittmann et al. 1988].
//!
//! ```text
//!        <- w ->h<- w ->
//!       +-------+ +-------+  -
//!       |  arm  | |  arm  |  n: notch, one cell wide
//!       |  <-o  | |  o->  |     o: rigid points, at the middle of the arms
//!       |       +-+       |  -
//!       |       |.|       |  b: ligament, the notch line of one cell
//!       |       |.|       |
//!       +-------+-+-------+  -
//! ```
//!
//! The document gives the geometry as multiples of `b` in a figure that its text does not repeat: the notch and the
//! halves are parameters here, `n = b` and `w = 0.7 b` by default, those of the ASTM specimen with `a = b` and the ligament as long.

use fissure::materials::multi_crack::{Shear, Unloading};
use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use crate::method::Method;

/// The two elastic halves.
pub(super) const HALVES: &str = "halves";
/// What may crack.
pub(super) const LINE: &str = "line";
/// The rigid points that pull.
pub(super) const GRIPS: [&str; 2] = ["left", "right"];

/// How the notch line fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// Across the line alone.
    Ideal,
    /// On several planes of a point, wherever the tension asks for them.
    Multiple,
}

/// The specimen of one set of parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Specimen {
    pub ligament: f64,
    pub notch: f64,
    pub half: f64,
    pub depth: f64,
    pub spacing: f64,
    pub speed: f64,
    pub rise: f64,
    pub elastic: Isotropic,
    pub strength: f64,
    pub toughness: f64,
    pub failure: Failure,
    /// Least angle between planes of a point.
    pub threshold: f64,
    pub shear: Shear,
    /// Whether the points hold the arms from turning, as one inside a cell does.
    pub clamped: bool,
}

impl Specimen {
    pub fn new(case: &Parameters, method: &Method) -> Result<Self, StudyError> {
        let ligament = case.number("ligament")?;
        let spacing = method.spacing;
        let snapped = |name: &str| -> Result<f64, StudyError> {
            Ok((case.number(name)? * ligament / spacing).round().max(2.0) * spacing)
        };
        let cells = ligament / spacing;
        if (cells - cells.round()).abs() > 1e-6 {
            let reason = "the ligament must be a whole number of cells";
            return Err(StudyError::combination(case, &["ligament", "h"], reason));
        }
        Ok(Self {
            ligament,
            notch: snapped("notch")?,
            half: snapped("half")?,
            depth: case.number("depth")?,
            spacing,
            speed: case.number("speed")?,
            rise: if method.is_dynamic() {
                case.number("rise")?
            } else {
                0.0
            },
            elastic: Isotropic {
                density: case.number("density")?,
                young: case.number("young")?,
                poisson: case.number("poisson")?,
            },
            strength: case.number("strength")?,
            toughness: case.number("toughness")?,
            failure: match case.choice("failure")? {
                "ideal" => Failure::Ideal,
                _ => Failure::Multiple,
            },
            threshold: case.number("threshold")?.to_radians(),
            shear: match case.choice("faces")? {
                "free" => Shear::Coulomb(0.0),
                "damaged" => Shear::Damaged(0.0),
                _ => Shear::Elastic,
            },
            clamped: case.choice("grip")? == "cell",
        })
    }

    /// m².
    pub fn area(&self) -> f64 {
        self.ligament * self.depth
    }

    /// Opening at which nothing is carried, m.
    pub fn critical_opening(&self) -> f64 {
        2.0 * self.toughness / self.strength
    }

    /// How far the points have moved apart, m.
    pub fn elongation(&self, time: f64) -> f64 {
        // The speed rises linearly to its end.
        let after = (time - self.rise).max(0.0);
        let during = time.min(self.rise);
        let risen = if self.rise > 0.0 {
            0.5 * during * during / self.rise
        } else {
            0.0
        };
        2.0 * self.speed * (risen + after)
    }

    /// When they are this far apart, s; beyond the rise of the speed.
    pub fn time_at(&self, elongation: f64) -> f64 {
        elongation / (2.0 * self.speed) + 0.5 * self.rise
    }

    pub fn grid(&self) -> Result<Grid<2>, StudyError> {
        let (h, side) = (self.spacing, self.half + 4.0 * self.spacing);
        let top = self.ligament + self.notch + 4.0 * h;
        Grid::over([-side, -4.0 * h], [side + h, top], h)
            .map_err(StudyError::failed("making the grid"))
    }

    pub fn scene(&self) -> Result<Scene<2>, StudyError> {
        let scene = match self.failure {
            Failure::Ideal => {
                let law = Decohesive {
                    elastic: self.elastic,
                    strength: self.strength,
                    toughness: self.toughness,
                    softening: softening::Linear,
                    normal: Normal::Prescribed(Vector3::x()),
                };
                self.scene_of(law)
            }
            Failure::Multiple => {
                let decohesion = ModeOne {
                    strength: self.strength,
                    toughness: self.toughness,
                    softening: softening::Linear,
                    unloading: Unloading::Permanent,
                    shear: self.shear,
                };
                let law: MultiCrack<20, ModeOne> = MultiCrack {
                    elastic: self.elastic,
                    decohesion,
                    planes: Planes::Multiple(Some(self.threshold)),
                };
                self.scene_of(law)
            }
        };
        scene.map_err(StudyError::failed("building the specimen"))
    }

    fn scene_of<M: Material>(&self, line: M) -> Result<Scene<2>, SceneError> {
        let (h, top) = (self.spacing, self.ligament + self.notch);
        let seeding = Spacing(0.5 * h);
        let left = Block::new([-self.half, 0.0], [0.0, top]);
        let right = Block::new([h, 0.0], [h + self.half, top]);
        let mut scene = Scene::plane(Plane::Strain {
            thickness: self.depth,
        });
        scene
            .fill(
                LINE,
                line,
                &Block::new([0.0, 0.0], [h, self.ligament]),
                &seeding,
            )?
            .fill(HALVES, self.elastic, &Union(left, right), &seeding)?;
        let (speed, rise) = (self.speed, self.rise);
        let middle = ((self.ligament + 0.5 * self.notch) / h).round() * h;
        let out = (0.5 * self.half / h).round() * h;
        for (name, from, sign) in [(GRIPS[0], -out - h, -1.0), (GRIPS[1], h + out, 1.0)] {
            // A point on a line of the grid moves the two nodes beside it, about which the arm can turn.
            let low = if self.clamped {
                middle
            } else {
                middle - 0.5 * h
            };
            let cell = Block::new([from, low], [from + h, low + h]);
            let pull = move |t: f64| {
                let share = if rise > 0.0 { (t / rise).min(1.0) } else { 1.0 };
                sign * speed * share
            };
            let hold = Hold::Component(Vector2::x());
            scene.rigid(name, &cell, &Spacing(h), hold, Velocity(pull))?;
        }
        Ok(scene)
    }
}
