//! What a user puts into a scene: bodies, conditions, loads, initial velocities.

use fissure_materials::{Material, PlaneStress, Scale};
use fissure_particles::{ParticleError, ParticleId, Particles, Region, Seeding, Seeds};
use nalgebra::{SMatrix, SVector};

use crate::body::Body;
use crate::condition::{Condition, ConditionKind, Hold, Selection, TimeFunction};
use crate::error::SceneError;
use crate::kinematics::Kinematics;
use crate::law::{SweepLaw, TypedLaw};
use crate::scene::Scene;

impl<const D: usize> Scene<D> {
    /// Fills a region with particles of a law. The law is checked first; in plane stress it is
    /// wrapped in [`PlaneStress`](fissure_materials::PlaneStress).
    ///
    /// # Errors
    /// A law or a seeding that is refused, a name that is taken, a radius that is not positive.
    pub fn fill<M: Material>(
        &mut self,
        name: &str,
        law: M,
        region: &dyn Region<D>,
        seeding: &dyn Seeding<D>,
    ) -> Result<&mut Self, SceneError> {
        let seeds = seeding.seed(region).map_err(|source| SceneError::Seed {
            body: name.to_owned(),
            source,
        })?;
        self.add_body(name, law, seeds)
    }

    /// Adds a body whose particles are given.
    ///
    /// # Errors
    /// As [`fill`](Self::fill).
    pub fn add_body<M: Material>(
        &mut self,
        name: &str,
        law: M,
        seeds: Seeds<D>,
    ) -> Result<&mut Self, SceneError> {
        self.kinematics.check()?;
        self.free_name(name)?;
        let refused = |source| SceneError::Law {
            body: name.to_owned(),
            source,
        };
        law.check().map_err(refused)?;
        if seeds.position.len() != seeds.volume.len() {
            return Err(SceneError::Particles {
                body: name.to_owned(),
                source: ParticleError::ColumnLength {
                    column: "volume of the seeds",
                    found: seeds.volume.len(),
                    expected: seeds.position.len(),
                },
            });
        }
        let density = law.density();
        let mut particles = Particles::default();
        for (&position, &measure) in seeds.position.iter().zip(&seeds.volume) {
            let radius = position[0];
            if self.kinematics == Kinematics::Axisymmetric && !(radius > 0.0) {
                return Err(SceneError::NegativeRadius {
                    body: name.to_owned(),
                    radius,
                });
            }
            let volume = measure * self.kinematics.depth(radius);
            particles
                .push(position, SVector::zeros(), density * volume, volume)
                .map_err(|source| SceneError::Particles {
                    body: name.to_owned(),
                    source,
                })?;
        }
        let mut law: Box<dyn SweepLaw<D>> = match self.kinematics {
            Kinematics::PlaneStress { .. } => {
                let law = PlaneStress(law);
                law.check().map_err(refused)?;
                Box::new(TypedLaw::new(law))
            }
            _ => Box::new(TypedLaw::new(law)),
        };
        law.grow(particles.len());
        self.bodies.push(Body {
            name: name.to_owned(),
            particles,
            law,
            half_edges: seeds.half_edges,
            copies: None,
        });
        self.edits += 1;
        Ok(self)
    }

    /// Adds a rigid body: particles without a law that prescribe a velocity on every node they
    /// reach and move with it. Its name is that of the condition, for [`reaction`](Self::reaction).
    ///
    /// # Errors
    /// A seeding or a direction that is refused, a name that is taken.
    pub fn rigid(
        &mut self,
        name: &str,
        region: &dyn Region<D>,
        seeding: &dyn Seeding<D>,
        hold: Hold<D>,
        speed: impl TimeFunction + 'static,
    ) -> Result<&mut Self, SceneError> {
        let seeds = seeding.seed(region).map_err(|source| SceneError::Seed {
            body: name.to_owned(),
            source,
        })?;
        let selection = Selection::Rigid {
            position: seeds.position,
            half_edges: seeds.half_edges,
        };
        self.prescribe(name, selection, hold, speed)
    }

    /// Prescribes velocities on every node that the selected particles of a body reach.
    ///
    /// # Errors
    /// An unknown body, an empty selection, a direction that is refused, a name that is taken.
    pub fn hold(
        &mut self,
        name: &str,
        body: &str,
        select: impl Fn(&SVector<f64, D>) -> bool,
        hold: Hold<D>,
        speed: impl TimeFunction + 'static,
    ) -> Result<&mut Self, SceneError> {
        let selection = self.select(name, body, select)?;
        self.prescribe(name, selection, hold, speed)
    }

    /// Prescribes velocities on every node that a point at one of these places (m) reaches: of a place
    /// at a node that node alone, with linear or isoparametric functions. The places stay; material
    /// that moves away from them is no longer held.
    ///
    /// # Errors
    /// No place, a place or a direction that is refused, a name that is taken.
    pub fn hold_places(
        &mut self,
        name: &str,
        places: &[SVector<f64, D>],
        hold: Hold<D>,
        speed: impl TimeFunction + 'static,
    ) -> Result<&mut Self, SceneError> {
        if places.is_empty() {
            return Err(SceneError::EmptySelection {
                name: name.to_owned(),
            });
        }
        let mut coordinates = places.iter().flat_map(|x| x.iter());
        if let Some(&value) = coordinates.find(|c| !c.is_finite()) {
            return Err(SceneError::Parameter {
                parameter: "place of a hold",
                value,
                permitted: "finite",
            });
        }
        self.prescribe(name, Selection::Places(places.to_vec()), hold, speed)
    }

    /// Loads the selected particles of a body with a total force (N, as a function of time), shared
    /// in proportion to their volumes.
    ///
    /// # Errors
    /// An unknown body, an empty selection, a name that is taken.
    pub fn force(
        &mut self,
        name: &str,
        body: &str,
        select: impl Fn(&SVector<f64, D>) -> bool,
        force: impl Fn(f64) -> SVector<f64, D> + Send + Sync + 'static,
    ) -> Result<&mut Self, SceneError> {
        self.free_name(name)?;
        let selection = self.select(name, body, select)?;
        self.push_condition(name, selection, ConditionKind::Force(Box::new(force)));
        Ok(self)
    }

    /// Loads the selected particles with a traction (Pa, as a function of time) on a surface of
    /// `area` m² that they stand for.
    ///
    /// # Errors
    /// As [`force`](Self::force), and an area that is not positive.
    pub fn traction(
        &mut self,
        name: &str,
        body: &str,
        select: impl Fn(&SVector<f64, D>) -> bool,
        area: f64,
        traction: impl Fn(f64) -> SVector<f64, D> + Send + Sync + 'static,
    ) -> Result<&mut Self, SceneError> {
        if !(area > 0.0 && area.is_finite()) {
            return Err(SceneError::Parameter {
                parameter: "area",
                value: area,
                permitted: "finite and > 0",
            });
        }
        self.force(name, body, select, move |t| traction(t) * area)
    }

    /// Sets the body force, an acceleration (m/s²) as a function of place and time.
    pub fn body_force(
        &mut self,
        acceleration: impl Fn(&SVector<f64, D>, f64) -> SVector<f64, D> + Send + Sync + 'static,
    ) -> &mut Self {
        self.body_force = Some(Box::new(acceleration));
        self
    }

    /// Gives every particle of a body a velocity, m/s, by its place; before a run, or between any two of its steps.
    ///
    /// Gradients that a transfer carries beside the velocity (APIC) become zero. The ledger's kinetic energy is that of the
    /// new velocities; the change is in no other column, so that its balances are of the run before or after an edit.
    ///
    /// # Errors
    /// An unknown body, or a velocity that is not finite; nothing is changed then.
    pub fn set_velocity(
        &mut self,
        body: &str,
        velocity: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<&mut Self, SceneError> {
        let index = self.body_index(body)?;
        let motion = &mut self.bodies[index].particles.motion;
        let velocities: Vec<SVector<f64, D>> = motion.position.iter().map(velocity).collect();
        let mut components = velocities.iter().flat_map(|v| v.iter());
        if let Some(&value) = components.find(|c| !c.is_finite()) {
            return Err(SceneError::Parameter {
                parameter: "velocity",
                value,
                permitted: "finite",
            });
        }
        motion.velocity = velocities;
        motion.affine.fill(SMatrix::zeros());
        self.energy.kinetic = self.bodies.iter().map(Body::kinetic_energy).sum();
        self.edits += 1;
        Ok(self)
    }

    /// Scales the law's parameters of the particles of a body that lie where `select` says.
    ///
    /// # Errors
    /// An unknown body, an empty selection, a factor that is not positive.
    pub fn set_scale(
        &mut self,
        body: &str,
        select: impl Fn(&SVector<f64, D>) -> bool,
        scale: Scale,
    ) -> Result<&mut Self, SceneError> {
        check_scale(&scale)?;
        let index = self.body_index(body)?;
        let chosen: Vec<bool> = {
            let position = &self.bodies[index].particles.motion.position;
            position.iter().map(&select).collect()
        };
        if !chosen.contains(&true) {
            return Err(SceneError::EmptySelection {
                name: format!("scale of {body}"),
            });
        }
        let scales = self.bodies[index]
            .scales_mut()
            .map_err(|source| SceneError::Column {
                body: body.to_owned(),
                source,
            })?;
        for (entry, chosen) in scales.iter_mut().zip(chosen) {
            if chosen {
                entry.0 = scale;
            }
        }
        self.edits += 1;
        Ok(self)
    }

    /// Scales the law's parameters of every particle of a body by its id and place: a strength field
    /// from [`WhiteNoise`](fissure_particles::WhiteNoise) or a
    /// [`RandomField`](fissure_particles::RandomField). Nothing is changed where one is refused.
    ///
    /// # Errors
    /// An unknown body, a factor that is not positive.
    pub fn set_scales(
        &mut self,
        body: &str,
        scale: impl Fn(ParticleId, &SVector<f64, D>) -> Scale,
    ) -> Result<&mut Self, SceneError> {
        let index = self.body_index(body)?;
        let particles = &self.bodies[index].particles;
        let pairs = particles.id.iter().zip(&particles.motion.position);
        let scales: Vec<Scale> = pairs.map(|(&id, x)| scale(id, x)).collect();
        scales.iter().try_for_each(check_scale)?;
        let entries = self.bodies[index]
            .scales_mut()
            .map_err(|source| SceneError::Column {
                body: body.to_owned(),
                source,
            })?;
        for (entry, scale) in entries.iter_mut().zip(scales) {
            entry.0 = scale;
        }
        self.edits += 1;
        Ok(self)
    }

    fn prescribe(
        &mut self,
        name: &str,
        selection: Selection<D>,
        hold: Hold<D>,
        speed: impl TimeFunction + 'static,
    ) -> Result<&mut Self, SceneError> {
        self.free_name(name)?;
        let length = match &hold {
            Hold::Component(direction) | Hold::All(direction) => direction.norm(),
        };
        if !(length > 0.0 && length.is_finite()) {
            return Err(SceneError::Parameter {
                parameter: "length of the direction of a hold",
                value: length,
                permitted: "finite and > 0",
            });
        }
        let kind = ConditionKind::Velocity {
            hold,
            speed: Box::new(speed),
        };
        self.push_condition(name, selection, kind);
        Ok(self)
    }

    fn push_condition(&mut self, name: &str, selection: Selection<D>, kind: ConditionKind<D>) {
        self.conditions.push(Condition {
            name: name.to_owned(),
            selection,
            kind,
        });
        self.edits += 1;
    }

    fn select(
        &self,
        name: &str,
        body: &str,
        select: impl Fn(&SVector<f64, D>) -> bool,
    ) -> Result<Selection<D>, SceneError> {
        let index = self.body_index(body)?;
        let particles = &self.bodies[index].particles;
        let pairs = particles.id.iter().zip(&particles.motion.position);
        let mut ids: Vec<ParticleId> = pairs
            .filter(|(_, x)| select(x))
            .map(|(id, _)| *id)
            .collect();
        if ids.is_empty() {
            return Err(SceneError::EmptySelection {
                name: name.to_owned(),
            });
        }
        ids.sort_unstable();
        Ok(Selection::Body { body: index, ids })
    }

    pub(crate) fn body_index(&self, name: &str) -> Result<usize, SceneError> {
        let index = self.bodies.iter().position(|body| body.name == name);
        index.ok_or_else(|| SceneError::UnknownBody {
            name: name.to_owned(),
        })
    }

    pub(crate) fn free_name(&self, name: &str) -> Result<(), SceneError> {
        let taken = self.bodies.iter().any(|body| body.name == name)
            || self.conditions.iter().any(|c| c.name == name)
            || self.contacts.iter().any(|c| c.name == name)
            || self.cracks.iter().any(|crack| crack.name() == name);
        if taken {
            return Err(SceneError::NameTaken {
                name: name.to_owned(),
            });
        }
        Ok(())
    }
}

/// Refuses factors that are not positive.
fn check_scale(scale: &Scale) -> Result<(), SceneError> {
    for (parameter, value) in [
        ("scale of stiffness", scale.stiffness),
        ("scale of strength", scale.strength),
        ("scale of toughness", scale.toughness),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(SceneError::Parameter {
                parameter,
                value,
                permitted: "finite and > 0",
            });
        }
    }
    Ok(())
}
