//! The particles of a body.

use std::ops::Range;

use nalgebra::{Matrix3, SVector};
use serde::{Deserialize, Serialize};

use crate::error::ParticleError;
use crate::extra::Extra;
use crate::motion::Motion;
use crate::order::{check_permutation, gather, gathered};
use crate::seeding::Seeds;

/// Names a particle of a body for good: given once, kept when the particles are sorted.
#[derive(
    Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Hash, Default, Serialize, Deserialize,
)]
pub struct ParticleId(pub u32);

/// The particles of a body, in columns of equal length; row `i` of each belongs to the same
/// particle.
///
/// Id, mass and volume do not change in a step. Made with [`Particles::default`] and filled with
/// [`Particles::extend_from_seeds`] or [`Particles::push`], or from stored columns with
/// [`Particles::from_columns`]. Whoever writes to the columns directly can have them checked by
/// [`Particles::check`].
#[derive(Clone, Debug, Default)]
pub struct Particles<const D: usize> {
    /// Names, unique in the body.
    pub id: Vec<ParticleId>,
    /// Mass, kg.
    pub mass: Vec<f64>,
    /// Volume in the reference placement, m³ (plane bodies: area times thickness).
    pub volume: Vec<f64>,
    /// Present motion.
    pub motion: Motion<D>,
    /// What a step writes; empty until [`Particles::make_trial`].
    pub trial: Motion<D>,
    /// Optional columns.
    pub extra: Extra,
    next_id: u32,
}

impl<const D: usize> Particles<D> {
    /// Particles from stored columns: ids, masses (kg), reference volumes (m³) and motion. No
    /// optional columns.
    ///
    /// # Errors
    /// [`ParticleError::ColumnLength`], [`ParticleError::RepeatedId`] or
    /// [`ParticleError::TooMany`].
    pub fn from_columns(
        id: Vec<ParticleId>,
        mass: Vec<f64>,
        volume: Vec<f64>,
        motion: Motion<D>,
    ) -> Result<Self, ParticleError> {
        let next_id = id.iter().map(|id| id.0.saturating_add(1)).max();
        let extra = Extra::with_len(id.len());
        let particles = Self {
            id,
            mass,
            volume,
            motion,
            extra,
            next_id: next_id.unwrap_or(0),
            ..Self::default()
        };
        particles.check()?;
        Ok(particles)
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Adds an undeformed particle free of stress and returns its id. `position` in m, `velocity`
    /// in m/s, `mass` in kg (zero is for bodies whose motion is prescribed), reference `volume` in
    /// m³. Optional columns get their default.
    ///
    /// # Errors
    /// [`ParticleError::OutOfRange`] for a number outside its range, [`ParticleError::TooMany`]
    /// when ids run out.
    pub fn push(
        &mut self,
        position: SVector<f64, D>,
        velocity: SVector<f64, D>,
        mass: f64,
        volume: f64,
    ) -> Result<ParticleId, ParticleError> {
        for (quantity, vector) in [("position, m,", position), ("velocity, m/s,", velocity)] {
            if let Some(&value) = vector.iter().find(|value| !value.is_finite()) {
                let rule = "a number";
                return Err(ParticleError::OutOfRange {
                    quantity,
                    value,
                    rule,
                });
            }
        }
        not_negative("mass, kg,", mass)?;
        positive("volume, m³,", volume)?;
        self.ids_left(1)?;
        let id = ParticleId(self.next_id);
        self.next_id += 1;
        self.id.push(id);
        self.mass.push(mass);
        self.volume.push(volume);
        self.motion.push(position, velocity);
        self.extra.resize(self.id.len());
        Ok(id)
    }

    /// Adds a particle at rest for each seed and returns the rows they take. `density` in kg/m³
    /// (zero is for bodies whose motion is prescribed); `thickness` in m turns the seeds' measure
    /// into a volume and is 1 (no unit) where `D` = 3.
    ///
    /// # Errors
    /// [`ParticleError::OutOfRange`] or [`ParticleError::ColumnLength`] for numbers or seeds which
    /// are not usable, [`ParticleError::TooMany`] when ids run out; no particle is added then.
    pub fn extend_from_seeds(
        &mut self,
        seeds: &Seeds<D>,
        density: f64,
        thickness: f64,
    ) -> Result<Range<usize>, ParticleError> {
        not_negative("density, kg/m³,", density)?;
        positive("thickness, m,", thickness)?;
        if seeds.volume.len() != seeds.position.len() {
            return Err(ParticleError::ColumnLength {
                column: "volume of the seeds",
                found: seeds.volume.len(),
                expected: seeds.position.len(),
            });
        }
        self.ids_left(seeds.position.len())?;
        let (first, first_id) = (self.len(), self.next_id);
        for (position, measure) in seeds.position.iter().zip(&seeds.volume) {
            let volume = measure * thickness;
            if let Err(error) = self.push(*position, SVector::zeros(), density * volume, volume) {
                self.truncate(first);
                self.next_id = first_id;
                return Err(error);
            }
        }
        Ok(first..self.len())
    }

    /// Gives the trial motion as many rows as the present one, without copying it: a step writes
    /// every row. What was allocated before is used again.
    pub fn make_trial(&mut self) {
        self.trial.resize(self.motion.len());
        if self.motion.affine.is_empty() {
            self.trial.affine.clear();
        } else {
            self.trial.ensure_affine();
        }
    }

    /// The same for a step that writes velocities, stresses and affine parts over the present ones: the trial has
    /// positions and deformation gradients, and nothing else.
    pub fn make_trial_in_place(&mut self) {
        let Motion {
            position,
            velocity,
            deformation_gradient,
            stress,
            affine,
        } = &mut self.trial;
        let len = self.motion.position.len();
        position.resize(len, SVector::zeros());
        deformation_gradient.resize(len, Matrix3::identity());
        *velocity = Vec::new();
        *stress = Vec::new();
        *affine = Vec::new();
    }

    /// Makes trial positions and deformation gradients the present ones.
    ///
    /// # Errors
    /// [`ParticleError::ColumnLength`] if the trial has not one of each for every particle; nothing is swapped then.
    pub fn commit_in_place(&mut self) -> Result<(), ParticleError> {
        let expected = self.id.len();
        let trial = &mut self.trial;
        let columns = [
            ("position", trial.position.len()),
            ("deformation_gradient", trial.deformation_gradient.len()),
        ];
        if let Some((column, found)) = columns.into_iter().find(|(_, found)| *found != expected) {
            return Err(ParticleError::ColumnLength {
                column,
                found,
                expected,
            });
        }
        std::mem::swap(&mut self.motion.position, &mut trial.position);
        let gradient = &mut self.motion.deformation_gradient;
        std::mem::swap(gradient, &mut trial.deformation_gradient);
        Ok(())
    }

    /// Makes the trial motion the present one; the former present one becomes the next trial's
    /// storage.
    ///
    /// # Errors
    /// [`ParticleError::ColumnLength`] if the trial has not a row per particle; nothing is swapped
    /// then.
    pub fn commit(&mut self) -> Result<(), ParticleError> {
        self.trial.check(self.id.len())?;
        std::mem::swap(&mut self.motion, &mut self.trial);
        Ok(())
    }

    /// Brings all columns into a new order: row `i` becomes what row `order[i]` was. The storage of
    /// the trial motion is used for it where it is there, so that what a step wrote there is lost: sort before a
    /// step, not within it.
    ///
    /// # Errors
    /// [`ParticleError::ColumnLength`] or [`ParticleError::NotAPermutation`]; nothing is moved
    /// then.
    pub fn reorder(&mut self, order: &[u32]) -> Result<(), ParticleError> {
        // Sorts are seldom: what they need besides is given back at once.
        check_permutation(order, self.id.len(), &mut Vec::new())?;
        self.check_lengths()?;
        self.id = gathered(order, &self.id);
        let mut value = Vec::new();
        gather(order, &self.mass, &mut value);
        std::mem::swap(&mut self.mass, &mut value);
        gather(order, &self.volume, &mut value);
        std::mem::swap(&mut self.volume, &mut value);
        self.motion.reorder(order, &mut self.trial);
        self.extra.reorder_checked(order);
        Ok(())
    }

    /// All columns must have the same length and all ids must differ. Sorts a copy of the ids: not
    /// for every step.
    ///
    /// # Errors
    /// [`ParticleError::ColumnLength`], [`ParticleError::RepeatedId`] or
    /// [`ParticleError::TooMany`].
    pub fn check(&self) -> Result<(), ParticleError> {
        self.check_lengths()?;
        too_many(self.id.len())?;
        let mut sorted = self.id.clone();
        sorted.sort_unstable();
        match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(ParticleError::RepeatedId { id: pair[0].0 }),
            None => Ok(()),
        }
    }

    fn check_lengths(&self) -> Result<(), ParticleError> {
        let expected = self.id.len();
        self.motion.check(expected)?;
        let columns = [
            ("mass", self.mass.len()),
            ("volume", self.volume.len()),
            ("extra", self.extra.len()),
        ];
        match columns.into_iter().find(|(_, found)| *found != expected) {
            Some((column, found)) => Err(ParticleError::ColumnLength {
                column,
                found,
                expected,
            }),
            None => Ok(()),
        }
    }

    fn ids_left(&self, more: usize) -> Result<(), ParticleError> {
        // The next id counts, not the number of rows: ids are never given twice.
        too_many((self.next_id as usize).saturating_add(more))
    }

    fn truncate(&mut self, len: usize) {
        self.id.truncate(len);
        self.mass.truncate(len);
        self.volume.truncate(len);
        self.motion.resize(len);
        self.extra.resize(len);
    }
}

fn too_many(asked: usize) -> Result<(), ParticleError> {
    let limit = u32::MAX as usize;
    if asked <= limit {
        return Ok(());
    }
    Err(ParticleError::TooMany { asked, limit })
}

fn positive(quantity: &'static str, value: f64) -> Result<(), ParticleError> {
    let rule = "greater than 0";
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(ParticleError::OutOfRange {
        quantity,
        value,
        rule,
    })
}

fn not_negative(quantity: &'static str, value: f64) -> Result<(), ParticleError> {
    let rule = "not less than 0";
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(ParticleError::OutOfRange {
        quantity,
        value,
        rule,
    })
}
