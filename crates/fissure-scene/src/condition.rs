//! What holds and loads the bodies.

use fissure_particles::ParticleId;
use nalgebra::SVector;

/// Which components of the velocity a condition prescribes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold<const D: usize> {
    /// The component along this direction moves at the prescribed speed; the others are free (a
    /// roller).
    Component(SVector<f64, D>),
    /// The velocity is the prescribed speed times this direction (a clamp).
    All(SVector<f64, D>),
}

impl<const D: usize> Hold<D> {
    /// The direction, as a unit vector.
    pub fn direction(&self) -> SVector<f64, D> {
        match self {
            Self::Component(direction) | Self::All(direction) => direction.normalize(),
        }
    }
}

/// A number that changes with time.
pub trait TimeFunction: Send + Sync {
    /// Its value at time `t`, s.
    fn at(&self, t: f64) -> f64;
}

/// A speed in m/s as a function of time in s. The bound on the struct lets closures infer.
#[derive(Clone, Copy, Debug)]
pub struct Velocity<F: Fn(f64) -> f64>(pub F);

impl<F: Fn(f64) -> f64 + Send + Sync> TimeFunction for Velocity<F> {
    fn at(&self, t: f64) -> f64 {
        (self.0)(t)
    }
}

/// A value that does not change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant(pub f64);

impl TimeFunction for Constant {
    fn at(&self, _t: f64) -> f64 {
        self.0
    }
}

/// A vector that changes with time.
pub(crate) type VectorFunction<const D: usize> = Box<dyn Fn(f64) -> SVector<f64, D> + Send + Sync>;

/// The particles a condition acts on.
#[derive(Clone, Debug, PartialEq)]
pub enum Selection<const D: usize> {
    /// Particles of a body, chosen once, by id in ascending order.
    Body {
        /// Index of the body in the scene.
        body: usize,
        /// The particles.
        ids: Vec<ParticleId>,
    },
    /// Particles of a rigid body: they have a place and nothing else.
    Rigid {
        /// Positions now, m.
        position: Vec<SVector<f64, D>>,
        /// Half-edge vectors of their domains, m.
        half_edges: nalgebra::SMatrix<f64, D, D>,
    },
    /// Places that stay where they are, whatever moves there: the nodes of a mesh, m.
    Places(Vec<SVector<f64, D>>),
}

/// What a condition does.
pub enum ConditionKind<const D: usize> {
    /// Prescribes velocities on every node that its particles reach.
    Velocity {
        /// Which components.
        hold: Hold<D>,
        /// How fast.
        speed: Box<dyn TimeFunction>,
    },
    /// Loads its particles with a total force, N, shared in proportion to their volumes.
    Force(VectorFunction<D>),
}

/// A named condition of a scene.
pub struct Condition<const D: usize> {
    pub(crate) name: String,
    pub(crate) selection: Selection<D>,
    pub(crate) kind: ConditionKind<D>,
}

impl<const D: usize> Condition<D> {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The particles it acts on.
    pub fn selection(&self) -> &Selection<D> {
        &self.selection
    }

    /// What it does.
    pub fn kind(&self) -> &ConditionKind<D> {
        &self.kind
    }
}
