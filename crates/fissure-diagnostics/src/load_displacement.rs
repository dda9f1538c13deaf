//! The load-displacement curve of grips.

use fissure_scene::{ConditionKind, Every, Report, Scene, Watch, WatchError};
use nalgebra::SVector;

use crate::LoadCurve;

/// A watch that keeps the load-displacement curve between two grips, or of one.
///
/// A grip is a condition that prescribes a velocity, a rigid body's or a held selection's. The
/// displacement is the way of the grip along its own direction, summed as the scene moves rigid
/// bodies: the speed at the end of each step times its length. The load is its reaction along that
/// direction, positive when it pulls the body with it. With a second grip the displacement is
/// that of the first relative to it and the load is the mean of both, which halves the waves
/// between them: `P = ½ (R₁ − R₂)·d`.
///
/// ```
/// use fissure_diagnostics::LoadDisplacement;
///
/// let curve = LoadDisplacement::of("right").against("left").every(100);
/// // run(&mut scene, &mut solver, until, &mut [&mut curve])?;
/// assert_eq!(curve.curve().peak(), 0.0);
/// ```
#[derive(Clone, Debug)]
pub struct LoadDisplacement {
    grip: String,
    other: Option<String>,
    every: Every,
    curve: LoadCurve,
}

impl LoadDisplacement {
    /// The curve of the condition of this name, a point after each step.
    pub fn of(grip: &str) -> Self {
        Self {
            grip: grip.to_owned(),
            other: None,
            every: Every::default(),
            curve: LoadCurve::default(),
        }
    }

    /// Measures against a second grip.
    #[must_use]
    pub fn against(mut self, other: &str) -> Self {
        self.other = Some(other.to_owned());
        self
    }

    /// Keeps a point only after steps whose number is a multiple of `steps`; work and peak are of
    /// all steps.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = Every::Steps(steps);
        self
    }

    /// Keeps a point only after steps that reach or pass a multiple of `interval`, s; work and peak
    /// are of all steps.
    #[must_use]
    pub fn every_interval(mut self, interval: f64) -> Self {
        self.every = Every::Time(interval);
        self
    }

    /// Starts from a displacement (m) and load (N) other than none, as after a restart.
    #[must_use]
    pub fn starting_at(mut self, displacement: f64, load: f64) -> Self {
        self.curve = LoadCurve::starting_at(displacement, load);
        self
    }

    /// The curve so far.
    pub fn curve(&self) -> &LoadCurve {
        &self.curve
    }
}

impl<const D: usize> Watch<D> for LoadDisplacement {
    fn after(&mut self, scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError> {
        let grip = Grip::of(&self.grip, scene, report)?;
        let (mut way, mut load) = (grip.way, grip.reaction);
        if let Some(other) = &self.other {
            let other = Grip::of(other, scene, report)?;
            way -= other.way;
            load = (load - other.reaction) * 0.5;
        }
        let displacement = self.curve.now().0 + way.dot(&grip.direction);
        self.curve.advance(displacement, load.dot(&grip.direction));
        if self.every.is_due(report) {
            self.curve.keep();
        }
        Ok(())
    }
}

/// What a grip did in a step.
struct Grip<const D: usize> {
    direction: SVector<f64, D>,
    way: SVector<f64, D>,
    reaction: SVector<f64, D>,
}

impl<const D: usize> Grip<D> {
    fn of(name: &str, scene: &Scene<D>, report: &Report<D>) -> Result<Self, WatchError> {
        let unknown = || WatchError::Unknown {
            kind: "condition that prescribes a velocity",
            name: name.to_owned(),
        };
        let mut conditions = scene.conditions().iter();
        let condition = conditions.find(|condition| condition.name() == name);
        let condition = condition.ok_or_else(unknown)?;
        let ConditionKind::Velocity { hold, speed } = condition.kind() else {
            return Err(unknown());
        };
        let direction = hold.direction();
        Ok(Self {
            direction,
            way: direction * (speed.at(report.time) * report.dt),
            reaction: scene.reaction(name).ok_or_else(unknown)?,
        })
    }
}
