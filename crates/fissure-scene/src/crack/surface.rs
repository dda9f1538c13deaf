//! A crack: a line of material points, its ends and its faces.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::{CrackError, FacePoint, Polyline, Side};
use crate::contact::ContactLaw;

/// One of the two ends of a crack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum End {
    /// At the first vertex.
    First,
    /// At the last.
    Last,
}

impl End {
    /// Both, in order.
    pub const BOTH: [Self; 2] = [Self::First, Self::Last];

    fn index(self) -> usize {
        match self {
            Self::First => 0,
            Self::Last => 1,
        }
    }
}

/// What an end of a crack is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum EndState {
    /// In the material: it may grow, and a node whose box it lies in stays whole.
    #[default]
    Tip,
    /// At a surface of the body: nothing holds the faces together there.
    Mouth,
    /// A tip that has run into another crack, whose number in the scene is kept.
    Arrested {
        /// The other crack.
        by: usize,
    },
}

/// What a crack is besides its line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CrackSettings {
    /// The end at the first vertex.
    pub first: EndState,
    /// The end at the last vertex.
    pub last: EndState,
    /// What the faces do when they touch.
    pub contact: ContactLaw,
}

/// How a vertex moves in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexMotion {
    /// Displacement of the vertex, m.
    pub displacement: Vector2<f64>,
    /// Displacement of the plus face less that of the minus face, m.
    pub jump: Vector2<f64>,
}

/// Where a step leaves a crack.
#[derive(Clone, Debug)]
pub struct CarriedCrack {
    line: Polyline,
    jump: Vec<Vector2<f64>>,
}

/// A crack in a plane scene: in plane strain and stress it goes through the thickness, in
/// axisymmetry it is the surface that its line sweeps about the axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrackLine {
    name: String,
    line: Polyline,
    placed: Vec<Vector2<f64>>,
    jump: Vec<Vector2<f64>>,
    ends: [EndState; 2],
    contact: ContactLaw,
    bonded: Vec<FacePoint>,
}

impl CrackLine {
    /// A closed crack along these points, m.
    ///
    /// # Errors
    /// Points that make no simple line, a coefficient of friction outside its range.
    pub fn new(
        name: &str,
        points: &[[f64; 2]],
        settings: CrackSettings,
    ) -> Result<Self, CrackError> {
        check(settings.contact)?;
        let placed: Vec<Vector2<f64>> = points.iter().map(|p| Vector2::from(*p)).collect();
        Ok(Self {
            name: name.to_owned(),
            line: Polyline::new(placed.clone())?,
            jump: vec![Vector2::zeros(); placed.len()],
            placed,
            ends: [settings.first, settings.last],
            contact: settings.contact,
            bonded: Vec::new(),
        })
    }

    /// Refuses columns that do not fit one another, as a damaged checkpoint may hold.
    pub(crate) fn check(&self) -> Result<(), CrackError> {
        check(self.contact)?;
        let vertices = self.line.points().len();
        if vertices < 2 || self.placed.len() != vertices || self.jump.len() != vertices {
            return Err(CrackError::TooShort { vertices });
        }
        // The material may have folded the line since.
        self.line.carried(|(_, x)| *x).map(|_| ())
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where it is now.
    pub fn line(&self) -> &Polyline {
        &self.line
    }

    /// Where each vertex was when it was put there, m.
    pub fn placed(&self) -> &[Vector2<f64>] {
        &self.placed
    }

    /// Displacement of the plus face less that of the minus face at each vertex since it was put
    /// there, m: what steps have summed up.
    pub fn jump(&self) -> &[Vector2<f64>] {
        &self.jump
    }

    /// What its faces do when they touch.
    pub fn contact(&self) -> ContactLaw {
        self.contact
    }

    /// What an end is.
    pub fn end(&self, end: End) -> EndState {
        self.ends[end.index()]
    }

    /// Says what an end is: a tip that has broken through a surface is a mouth, an arrested one set
    /// back to a tip may grow again.
    pub fn set_end(&mut self, end: End, state: EndState) {
        self.ends[end.index()] = state;
    }

    /// Its ends that are tips.
    pub fn tips(&self) -> impl Iterator<Item = End> + '_ {
        let ends = End::BOTH.into_iter();
        ends.filter(|end| self.end(*end) == EndState::Tip)
    }

    /// Position of an end, m, and the unit vector along the crack out of it.
    pub fn tip(&self, end: End) -> (Vector2<f64>, Vector2<f64>) {
        let points = self.line.points();
        match end {
            End::First => (points[0], -self.line.tangent(0)),
            End::Last => {
                let segment = self.line.segments() - 1;
                (points[segment + 1], self.line.tangent(segment))
            }
        }
    }

    /// Point at a way `distance` (m) along the crack behind an end, and the unit vector along the
    /// crack there, towards the end. The other end if the crack is shorter.
    pub fn behind(&self, end: End, distance: f64) -> (Vector2<f64>, Vector2<f64>) {
        match end {
            End::First => {
                let (point, tangent) = self.line.at(distance);
                (point, -tangent)
            }
            End::Last => self.line.at(self.line.length() - distance),
        }
    }

    /// Jump across the crack at a way `distance` (m) behind an end, between the vertices' by
    /// straight lines, m.
    pub fn jump_behind(&self, end: End, distance: f64) -> Vector2<f64> {
        let foot = self.line.foot(&self.behind(end, distance).0);
        let (i, t) = (foot.segment, foot.fraction);
        self.jump[i] * (1.0 - t) + self.jump[i + 1] * t
    }

    /// Unit normal and jump of the crack where it is nearest to `x`: the normal points to the plus side, the
    /// jump (m) is between the vertices' by straight lines.
    pub fn face_at(&self, x: &Vector2<f64>) -> (Vector2<f64>, Vector2<f64>) {
        let foot = self.line.foot(x);
        let (i, t) = (foot.segment, foot.fraction);
        (foot.normal, self.jump[i] * (1.0 - t) + self.jump[i + 1] * t)
    }

    /// Where the place of the crack that is nearest to `x` was put, m.
    pub fn placed_at(&self, x: &Vector2<f64>) -> Vector2<f64> {
        let foot = self.line.foot(x);
        let (i, t) = (foot.segment, foot.fraction);
        self.placed[i] * (1.0 - t) + self.placed[i + 1] * t
    }

    /// What the law between its faces remembers, as the last step left it.
    pub fn bonded(&self) -> &[FacePoint] {
        &self.bonded
    }

    /// Puts down what the law between its faces remembers. For solvers.
    pub fn set_bonded(&mut self, points: Vec<FacePoint>) {
        self.bonded = points;
    }

    /// Divides segments longer than `longest` (m) into equal pieces. For solvers, whose nodes see more
    /// of the faces than the vertices a user needs.
    pub fn refine(&mut self, longest: f64) {
        let (line, origins) = self.line.refined(longest);
        let between = |values: &[Vector2<f64>]| -> Vec<Vector2<f64>> {
            let value = |&(i, t): &(usize, f64)| match values.get(i + 1) {
                Some(next) if t > 0.0 => values[i] * (1.0 - t) + next * t,
                _ => values[i],
            };
            origins.iter().map(value).collect()
        };
        (self.placed, self.jump) = (between(&self.placed), between(&self.jump));
        self.line = line;
    }

    /// Whether a tip lies in the open box `|x − centre| < half`, component by component (m). Mouths
    /// and arrested ends do not count.
    pub fn tip_in_box(&self, centre: &Vector2<f64>, half: &Vector2<f64>) -> bool {
        self.tips().any(|end| {
            let from = (self.tip(end).0 - centre).abs();
            from.x < half.x && from.y < half.y
        })
    }

    /// The side of `to` if this crack separates it from `from`: [`Polyline::crossing`].
    pub fn crossing(&self, from: &Vector2<f64>, to: &Vector2<f64>) -> Option<Side> {
        self.line.crossing(from, to)
    }

    /// Moves every vertex with the material and adds to its jump. For solvers.
    ///
    /// # Errors
    /// [`CrackError::NotFinite`] or [`CrackError::NoLength`]; the crack is then as it was.
    pub fn carry(
        &mut self,
        motion: impl FnMut(usize, &Vector2<f64>) -> VertexMotion,
    ) -> Result<(), CrackError> {
        self.carried(motion).map(|carried| self.accept(carried))
    }

    /// What [`carry`](Self::carry) would make of it, to [`accept`](Self::accept) when all else has succeeded.
    ///
    /// # Errors
    /// As of [`carry`](Self::carry).
    pub fn carried(
        &self,
        mut motion: impl FnMut(usize, &Vector2<f64>) -> VertexMotion,
    ) -> Result<CarriedCrack, CrackError> {
        let mut jump = self.jump.clone();
        let line = self.line.carried(|(i, x)| {
            let moved = motion(i, x);
            jump[i] += moved.jump;
            x + moved.displacement
        })?;
        let finite = |j: &Vector2<f64>| j.x.is_finite() && j.y.is_finite();
        if let Some(vertex) = jump.iter().position(|j| !finite(j)) {
            return Err(CrackError::NotFinite { vertex });
        }
        Ok(CarriedCrack { line, jump })
    }

    /// Takes the place and the jumps that [`carried`](Self::carried) has found for it.
    pub fn accept(&mut self, carried: CarriedCrack) {
        (self.line, self.jump) = (carried.line, carried.jump);
    }

    /// Lets a tip grow straight to a new place, m. Other cracks are not asked:
    /// [`Scene::grow_crack`](crate::Scene::grow_crack) does.
    ///
    /// # Errors
    /// [`CrackError::NoTip`], [`CrackError::NotFinite`], [`CrackError::NoLength`] or
    /// [`CrackError::NotSimple`]; the crack is then as it was.
    pub fn grow(&mut self, end: End, to: Vector2<f64>) -> Result<(), CrackError> {
        if self.end(end) != EndState::Tip {
            return Err(CrackError::NoTip);
        }
        self.line.extend(end == End::First, to)?;
        let index = match end {
            End::First => 0,
            End::Last => self.placed.len(),
        };
        self.placed.insert(index, to);
        self.jump.insert(index, Vector2::zeros());
        Ok(())
    }
}

/// Refuses friction outside its range.
fn check(contact: ContactLaw) -> Result<(), CrackError> {
    match contact.refused() {
        Some(value) => Err(CrackError::Parameter {
            parameter: "friction",
            value,
            permitted: "finite and >= 0",
        }),
        None => Ok(()),
    }
}
