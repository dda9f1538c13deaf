//! A scene: bodies, what holds and loads them, and time.

use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::SVector;

use crate::body::Body;
use crate::condition::{Condition, ConditionKind, Selection};
use crate::contact::Contact;
use crate::crack::{Bond, CrackLine};
use crate::kinematics::{Kinematics, Plane};
use crate::ledger::{EnergyTotals, Report};

/// Scenes made so far.
static SCENES: AtomicU64 = AtomicU64::new(1);

/// Acceleration of a body force as a function of position and time, m/s².
pub(crate) type BodyForce<const D: usize> =
    Box<dyn Fn(&SVector<f64, D>, f64) -> SVector<f64, D> + Send + Sync>;

/// Bodies, conditions and time. It knows no grid and no solver.
pub struct Scene<const D: usize> {
    pub(crate) kinematics: Kinematics,
    pub(crate) bodies: Vec<Body<D>>,
    pub(crate) conditions: Vec<Condition<D>>,
    pub(crate) contacts: Vec<Contact>,
    pub(crate) cracks: Vec<CrackLine>,
    /// Laws between the faces of cracks, with the number of each crack.
    pub(crate) bonds: Vec<(usize, Bond)>,
    pub(crate) body_force: Option<BodyForce<D>>,
    pub(crate) time: f64,
    pub(crate) load_time: f64,
    pub(crate) step: u64,
    pub(crate) energy: EnergyTotals,
    pub(crate) reactions: Vec<SVector<f64, D>>,
    pub(crate) contact_forces: Vec<SVector<f64, D>>,
    pub(crate) edits: u64,
}

impl Scene<2> {
    /// A plane scene.
    pub fn plane(plane: Plane) -> Self {
        Self::with(match plane {
            Plane::Strain { thickness } => Kinematics::PlaneStrain { thickness },
            Plane::Stress { thickness } => Kinematics::PlaneStress { thickness },
        })
    }

    /// An axisymmetric scene: `x` is the radius, `y` the axis, forces and masses are of the full 2π.
    pub fn axisymmetric() -> Self {
        Self::with(Kinematics::Axisymmetric)
    }
}

impl Scene<3> {
    /// A scene in space.
    pub fn solid() -> Self {
        Self::with(Kinematics::Solid)
    }
}

impl<const D: usize> Scene<D> {
    fn with(kinematics: Kinematics) -> Self {
        Self {
            kinematics,
            bodies: Vec::new(),
            conditions: Vec::new(),
            contacts: Vec::new(),
            cracks: Vec::new(),
            bonds: Vec::new(),
            body_force: None,
            time: 0.0,
            load_time: 0.0,
            step: 0,
            energy: EnergyTotals::default(),
            reactions: Vec::new(),
            contact_forces: Vec::new(),
            // No two scenes count alike, so that a solver notices another scene too.
            edits: SCENES.fetch_add(1, Ordering::Relaxed) << 32,
        }
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Time for which a quasi-static step takes the scene's loads and motions, s: the load factor of a
    /// path that is followed, else [`time`](Self::time). Dynamic solvers take the time itself.
    pub fn load_time(&self) -> f64 {
        self.load_time
    }

    /// Steps done.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// What its third dimension does.
    pub fn kinematics(&self) -> Kinematics {
        self.kinematics
    }

    /// Its bodies, in the order they were added.
    pub fn bodies(&self) -> &[Body<D>] {
        &self.bodies
    }

    /// Its bodies, for solvers. Counts as an edit: a solver prepares anew unless it was its own.
    pub fn bodies_mut(&mut self) -> &mut [Body<D>] {
        self.edits += 1;
        &mut self.bodies
    }

    /// The body of this name.
    pub fn body(&self, name: &str) -> Option<&Body<D>> {
        self.bodies.iter().find(|body| body.name == name)
    }

    /// Its conditions, in the order they were added.
    pub fn conditions(&self) -> &[Condition<D>] {
        &self.conditions
    }

    /// Its cracks, in the order they were added; in space there are none.
    pub fn cracks(&self) -> &[CrackLine] {
        &self.cracks
    }

    /// Its cracks, for solvers. Counts as an edit: a solver prepares anew unless it was its own.
    pub fn cracks_mut(&mut self) -> &mut [CrackLine] {
        self.edits += 1;
        &mut self.cracks
    }

    /// Number of particles of all bodies.
    pub fn particle_count(&self) -> usize {
        self.bodies.iter().map(|body| body.particles.len()).sum()
    }

    /// Acceleration of the body force at a place and time, m/s²; `None` if there is none.
    pub fn body_acceleration(&self, x: &SVector<f64, D>, t: f64) -> Option<SVector<f64, D>> {
        self.body_force.as_ref().map(|force| force(x, t))
    }

    /// Whether there is a body force.
    pub fn has_body_force(&self) -> bool {
        self.body_force.is_some()
    }

    /// Energies since the start.
    pub fn energy(&self) -> &EnergyTotals {
        &self.energy
    }

    /// Force that the condition of this name exerted on the bodies in the last step, N.
    pub fn reaction(&self, name: &str) -> Option<SVector<f64, D>> {
        let index = self.conditions.iter().position(|c| c.name == name)?;
        Some(
            self.reactions
                .get(index)
                .copied()
                .unwrap_or_else(SVector::zeros),
        )
    }

    /// Changes with every change a user makes and differs between scenes; solvers prepare anew
    /// when it does.
    pub fn edits(&self) -> u64 {
        self.edits
    }

    /// Books a step: time, energies, reactions, and the way of the rigid bodies. For solvers.
    pub fn record(&mut self, report: &Report<D>) {
        let (load_time, load_step) = report.load_time();
        for condition in &mut self.conditions {
            let ConditionKind::Velocity { hold, speed } = &condition.kind else {
                continue;
            };
            if let Selection::Rigid { position, .. } = &mut condition.selection {
                let way = hold.direction() * (speed.at(load_time) * load_step);
                position.iter_mut().for_each(|x| *x += way);
            }
        }
        self.time = report.time;
        self.load_time = load_time;
        self.step = report.step;
        self.energy.add(&report.energy);
        self.reactions.clone_from(&report.reactions);
        self.contact_forces.clone_from(&report.contact_forces);
    }
}
