//! The notched plate that is pulled at both ends [Nairn 2017, fig. 5A], of either kind of material.

use fissure::prelude::*;
use fissure_study::{Parameter, Parameters, Permitted, StudyError};

use super::conjugate::StressMeasure;
use super::numerics::seeding;

/// Name of the plate's body.
pub(super) const BODY: &str = "plate";
/// Thickness of the plane, m.
pub(super) const THICKNESS: f64 = 1e-3;
/// Factors that leave nothing to fail, and keep the limit of the band.
const SEVERED: Scale = Scale {
    stiffness: 1.0,
    strength: 1e-3,
    toughness: 1e-6,
};

/// What the notch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Notch {
    /// A row of cells left out.
    Gap,
    /// A row of cells that has failed from the start.
    Severed,
    /// A crack as a line.
    Line,
}

/// The plate that one set of parameters describes, the notch from its left edge at half height.
pub(super) struct Plate {
    pub width: f64,
    pub height: f64,
    pub crack: f64,
    pub spacing: f64,
    pub toughness: f64,
    pub elastic: Isotropic,
    pub notch: Notch,
    speed: f64,
    strength: f64,
    /// Height of the notch's line, m.
    line: f64,
}

impl Plate {
    /// The parameters that [`new`](Self::new) reads, but for those of the discretisation.
    pub(super) fn parameters() -> Vec<Parameter> {
        let positive = || Permitted::above(0.0);
        let ratio = Permitted::between(-1.0, 0.5);
        vec![
            Parameter::number("strength", "in tension (damage)", "Pa", 30e6, positive()),
            Parameter::choice(
                "line",
                "where the notch lies as a line: on the mid-plane of a cell row or on a row of nodes",
                "cells",
                &["cells", "nodes"],
            ),
            Parameter::number("young", "Young's modulus", "Pa", 2.5e9, positive()),
            Parameter::number("poisson", "Poisson's ratio", "1", 0.33, ratio),
            Parameter::number("density", "mass density", "kg/m3", 1000.0, positive()),
            Parameter::number("width", "of the plate", "m", 0.05, positive()),
            Parameter::number("height", "of the plate", "m", 0.1, positive()),
            Parameter::number("crack", "length of the notch", "m", 0.025, positive()),
            Parameter::number("speed", "of each end", "m/s", 3.1623, positive()),
        ]
    }

    pub(super) fn new(case: &Parameters, notch: Notch) -> Result<Self, StudyError> {
        let spacing = case.number("h")?;
        let plate = Self {
            width: case.number("width")?,
            height: case.number("height")?,
            crack: case.number("crack")?,
            speed: case.number("speed")?,
            spacing,
            strength: case.number("strength")?,
            toughness: case.number("toughness")?,
            elastic: Isotropic {
                density: case.number("density")?,
                young: case.number("young")?,
                poisson: case.number("poisson")?,
            },
            notch,
            line: match case.choice("line")? {
                "nodes" => 0.0,
                _ => 0.5 * spacing,
            },
        };
        if !(plate.crack < plate.width) {
            return Err(StudyError::combination(
                case,
                &["crack", "width"],
                "the notch cuts the plate",
            ));
        }
        Ok(plate)
    }

    /// Height of the notch as a line, m.
    pub(super) fn line(&self) -> f64 {
        self.line
    }

    /// Strength in tension, Pa.
    pub(super) fn strength(&self) -> f64 {
        self.strength
    }

    /// Speed of each end, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.speed
    }

    /// About how far each end goes until the release of a slender strip's energy, `E ε²/2` over its height, is the
    /// toughness, m.
    pub(super) fn way_at_toughness(&self) -> f64 {
        let strain = (2.0 * self.toughness / (self.elastic.young * self.height)).sqrt();
        0.5 * self.height * strain
    }

    /// Whether geometry and loading are those of the document.
    pub(super) fn is_documents(&self) -> bool {
        (self.width, self.height, self.crack) == (0.05, 0.1, 0.025)
            && self.speed == 3.1623
            && self.elastic.young == 2.5e9
    }

    /// Whether so is the material, on the grid of the document.
    pub(super) fn has_documents_damage(&self) -> bool {
        self.strength == 30e6 && self.toughness == 600.0 && self.spacing == 1e-3
    }

    /// The cell row just above the mid-plane, in the length of the notch.
    fn is_notch(&self, x: &Vector2<f64>) -> bool {
        x[0] < self.crack && x[1] > 0.0 && x[1] < self.spacing
    }

    /// Within the ligament: ahead of the notch, away from grips.
    pub(super) fn is_ahead(&self, x: &Vector2<f64>) -> bool {
        x[0] > self.crack && x[1].abs() < 0.4 * self.height
    }

    /// The tips between which the speed is measured, m: 30 to 45 mm of 25 to 50 mm.
    pub(super) fn measured(&self) -> (f64, f64) {
        let ligament = self.width - self.crack;
        (self.crack + 0.2 * ligament, self.crack + 0.8 * ligament)
    }

    pub(super) fn grid(&self, end: f64) -> Result<Grid<2>, StudyError> {
        let margin = 6.0 * self.spacing;
        let reach = 0.5 * self.height + margin + self.speed * end;
        let reach = (reach / self.spacing).ceil() * self.spacing;
        Grid::over(
            [-margin, -reach],
            [self.width + margin, reach],
            self.spacing,
        )
        .map_err(StudyError::failed("making the grid"))
    }

    /// The plate of a material that is damaged, in mode I alone or alike in both, between its grips.
    pub(super) fn damaged(&self, case: &Parameters, mixed: bool) -> Result<Scene<2>, StudyError> {
        let mode = |strength: f64, toughness: f64| Mode {
            strength: strength * self.strength,
            toughness: toughness * self.toughness,
            softening: softening::Linear,
        };
        // Of pure mode I shear is no part.
        let shear = if mixed {
            mode(1.0, 1.0)
        } else {
            mode(1e3, 1e6)
        };
        let mut law = AnisotropicDamage::new(self.elastic, mode(1.0, 1.0), shear);
        law.onset = Onset::InPlane;
        let half = 0.5 * self.height;
        let (low, high) = ([0.0, -half], [self.width, half]);
        let seeding = seeding(self.spacing);
        let mut scene = self.empty();
        let measure = StressMeasure::of(case)?;
        if self.notch == Notch::Gap {
            let plate = Where::new(low, high, |x| !self.is_notch(x));
            measure.fill(&mut scene, BODY, law, &plate, &seeding)?;
        } else {
            measure.fill(&mut scene, BODY, law, &Block::new(low, high), &seeding)?;
        }
        if self.notch == Notch::Severed {
            scene
                .set_scale(BODY, |x| self.is_notch(x), SEVERED)
                .map_err(StudyError::failed("cutting the notch"))?;
        }
        self.grip(&mut scene)?;
        Ok(scene)
    }

    /// The plate of an elastic material between its grips.
    pub(super) fn elastic(&self) -> Result<Scene<2>, StudyError> {
        let half = 0.5 * self.height;
        let plate = Block::new([0.0, -half], [self.width, half]);
        let mut scene = self.empty();
        scene
            .fill(BODY, self.elastic, &plate, &seeding(self.spacing))
            .map_err(StudyError::failed("filling the plate"))?;
        self.grip(&mut scene)?;
        Ok(scene)
    }

    /// How far the ends have gone apart, m, and the load that they carry, N.
    pub(super) fn load(&self, scene: &Scene<2>) -> [f64; 2] {
        let reaction = |end| scene.reaction(end).map_or(f64::NAN, |reaction| reaction.y);
        let load = 0.5 * (reaction("top") - reaction("bottom"));
        [2.0 * self.speed * scene.load_time(), load]
    }

    fn empty(&self) -> Scene<2> {
        Scene::plane(Plane::Strain {
            thickness: THICKNESS,
        })
    }

    fn grip(&self, scene: &mut Scene<2>) -> Result<(), StudyError> {
        let failed = || StudyError::failed("building the plate");
        if self.notch == Notch::Line {
            let mouth = CrackSettings {
                first: EndState::Mouth,
                ..CrackSettings::default()
            };
            let line = [[-self.spacing, self.line], [self.crack, self.line]];
            scene.crack("notch", &line, mouth).map_err(failed())?;
        }
        let (half, grip, speed) = (0.5 * self.height, 2.0 * self.spacing, self.speed);
        let seeding = seeding(self.spacing);
        let hold = Hold::Component(Vector2::y());
        for (name, low, speed) in [("bottom", -half - grip, -speed), ("top", half, speed)] {
            let block = Block::new([0.0, low], [self.width, low + grip]);
            scene
                .rigid(name, &block, &seeding, hold, Velocity(move |_| speed))
                .map_err(failed())?;
        }
        Ok(())
    }
}
