//! Growth of cracks: who decides, and what happens on the way.

use nalgebra::Vector2;
use thiserror::Error;

use super::{CrackError, End, EndState};
use crate::{Body, Scene};

/// Where a tip goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Unit vector of its way.
    pub direction: Vector2<f64>,
    /// Length of its way, m.
    pub length: f64,
}

/// Says whether and where the tip of a crack moves on.
///
/// It sees the scene and nothing of a solver: the same criterion serves every solver. It is asked
/// between steps ([`grow_cracks`]) and may remember what it saw, for rates of change.
pub trait GrowthCriterion {
    /// The next piece of way of the tip at `end` of the scene's crack of this number, or `None` if
    /// it stays where it is.
    ///
    /// # Errors
    /// [`GrowthError::Criterion`] if what decides cannot be computed.
    fn growth(
        &mut self,
        scene: &Scene<2>,
        crack: usize,
        end: End,
    ) -> Result<Option<Growth>, GrowthError>;
}

/// Why cracks could not grow.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GrowthError {
    /// The criterion could not decide.
    #[error("the growth of crack '{crack}' could not be decided")]
    Criterion {
        /// The crack.
        crack: String,
        /// What the criterion said.
        #[source]
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The crack could not grow so.
    #[error("crack '{crack}' cannot grow so")]
    Crack {
        /// The crack.
        crack: String,
        /// What the crack said.
        #[source]
        source: CrackError,
    },
}

/// A tip that has grown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grown {
    /// Number of the crack.
    pub crack: usize,
    /// Which end.
    pub end: End,
    /// The new tip, m.
    pub tip: Vector2<f64>,
    /// How far it went, m.
    pub length: f64,
    /// The crack that stopped it.
    pub arrested_by: Option<usize>,
}

impl Scene<2> {
    /// Lets a tip grow straight to a new place, m. If another crack is in the way, the tip stops on
    /// it and is arrested. A tip that leaves the bodies so is a mouth from then on.
    ///
    /// # Errors
    /// [`CrackError::Unknown`] and what [`CrackLine::grow`](crate::CrackLine::grow) refuses.
    pub fn grow_crack(
        &mut self,
        crack: usize,
        end: End,
        to: Vector2<f64>,
    ) -> Result<Grown, CrackError> {
        let cracks = self.cracks.len();
        let growing = self
            .cracks
            .get(crack)
            .ok_or(CrackError::Unknown { crack, cracks })?;
        let from = growing.tip(end).0;
        let mut obstacle: Option<(usize, Vector2<f64>)> = None;
        for (other, line) in self.cracks.iter().enumerate() {
            if other == crack {
                continue;
            }
            let reach = obstacle.map_or(to, |(_, place)| place);
            if let Some((place, _)) = line.line().first_meeting(&from, &reach) {
                obstacle = Some((other, place));
            }
        }
        let tip = obstacle.map_or(to, |(_, place)| place);
        let leaves = self.is_inside(&from) && !self.is_inside(&tip);
        let growing = &mut self.cracks[crack];
        growing.grow(end, tip)?;
        let arrested_by = obstacle.map(|(by, _)| by);
        if leaves {
            growing.set_end(end, EndState::Mouth);
        }
        if let Some(by) = arrested_by {
            growing.set_end(end, EndState::Arrested { by });
        }
        self.edits += 1;
        Ok(Grown {
            crack,
            end,
            tip,
            length: (tip - from).norm(),
            arrested_by,
        })
    }

    /// Whether a place lies in a particle of a body, or as near to one as the particles' own size.
    fn is_inside(&self, x: &Vector2<f64>) -> bool {
        self.bodies.iter().any(|body| {
            let motion = body.motion();
            let edges = motion.deformation_gradient.iter();
            let mut particles = motion.position.iter().zip(edges);
            particles.any(|(centre, f)| {
                let edges = Body::<2>::in_space(f) * body.half_edges();
                let from_centre = edges.try_inverse().map(|inverse| inverse * (x - centre));
                from_centre.is_some_and(|r| r.amax() <= 2.0)
            })
        })
    }
}

/// Asks the criterion for every tip of the scene, then lets those grow that shall: all are asked of
/// the same scene, and grow in the order of the cracks.
///
/// # Errors
/// The first tip that cannot be decided (nothing has grown then) or cannot grow.
pub fn grow_cracks(
    scene: &mut Scene<2>,
    criterion: &mut dyn GrowthCriterion,
) -> Result<Vec<Grown>, GrowthError> {
    let mut asked = Vec::new();
    for (index, crack) in scene.cracks().iter().enumerate() {
        for end in crack.tips() {
            if let Some(growth) = criterion.growth(scene, index, end)? {
                asked.push((
                    index,
                    end,
                    crack.tip(end).0 + growth.direction * growth.length,
                ));
            }
        }
    }
    let mut grown = Vec::with_capacity(asked.len());
    for (index, end, to) in asked {
        let moved = scene.grow_crack(index, end, to);
        grown.push(moved.map_err(|source| GrowthError::Crack {
            crack: scene.cracks()[index].name().to_owned(),
            source,
        })?);
    }
    Ok(grown)
}
