//! A step that keeps one copy of velocities, stresses and affine parts.
//!
//! A step must be able to fail and leave all as it was. It reads positions and deformation gradients and writes them to
//! the trial motion; of the rest a step need read nothing where velocities are those of the nodes and stresses those of
//! the deformation gradients, so that it may write over them. Should it fail, what was written over is made again as the
//! step before had made it, to the last bit:
//!
//! - velocities and affine parts from the nodal field of the step before at the positions of the step before, which the
//!   trial still holds: new positions follow from new velocities, `x + v Δt`, and are written when the step has
//!   succeeded;
//! - stresses of points without a history from their deformation gradients
//!   ([`STRESS_FROM_GRADIENT`](fissure_materials::Material::STRESS_FROM_GRADIENT)); those of the others are kept beside
//!   their states.
//!
//! After a change of the scene or a sort there is no step before; then all three are copied for one step.

use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_tensor::Sym;
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use crate::body::Body;
use crate::error::SolveError;
use crate::law::Constants;
use crate::moving::Moving;
use crate::sweep::{KernelFailure, Run, RunKernel};

/// Particles that a thread moves at a time.
const CHUNK: usize = 4096;

/// What a step in place writes over.
pub(crate) struct WrittenOver<const D: usize> {
    velocity: Vec<SVector<f64, D>>,
    stress: Vec<Sym>,
    affine: Vec<SMatrix<f64, D, D>>,
}

impl<const D: usize> Body<D> {
    /// Whether stresses may be written over, see
    /// [`STRESS_FROM_GRADIENT`](fissure_materials::Material::STRESS_FROM_GRADIENT).
    pub fn writes_in_place(&self) -> bool {
        self.law.stress_from_gradient()
    }

    /// Copies what a step in place will write over, until it is committed or undone.
    pub fn copy_for_undo(&mut self) {
        let motion = &self.particles.motion;
        self.copies = Some(WrittenOver {
            velocity: motion.velocity.clone(),
            stress: motion.stress.clone(),
            affine: motion.affine.clone(),
        });
    }

    /// Makes the trial of a step in place, of length `dt` (s), the present: positions follow from the velocities.
    ///
    /// # Errors
    /// Columns that do not fit one another.
    pub fn commit_in_place(&mut self, dt: f64) -> Result<(), SolveError> {
        let (motion, trial) = (&self.particles.motion, &mut self.particles.trial);
        let before = motion.position.par_chunks(CHUNK);
        let velocity = motion.velocity.par_chunks(CHUNK);
        let after = trial.position.par_chunks_mut(CHUNK);
        after.zip(before.zip(velocity)).for_each(|(after, (x, v))| {
            for (after, (x, v)) in after.iter_mut().zip(x.iter().zip(v)) {
                *after = x + v * dt;
            }
        });
        let refused = |source| SolveError::Particles {
            body: self.name.clone(),
            source,
        };
        self.particles.commit_in_place().map_err(refused)?;
        self.law.commit();
        self.copies = None;
        Ok(())
    }

    /// Brings back what a step in place has written over: the copies if there are any, else by a `kernel` that gathers
    /// velocities and affine parts of these sets of runs as the step before did, and by asking the law.
    ///
    /// # Errors
    /// [`SolveError::Undo`], where what could be done once cannot be done again.
    pub fn undo_in_place<'r>(
        &mut self,
        batches: impl Iterator<Item = &'r [Run]>,
        kernel: &dyn RunKernel<D>,
    ) -> Result<(), SolveError> {
        let particles = &mut self.particles;
        let (motion, trial) = (&mut particles.motion, &particles.trial);
        let undone = if let Some(copies) = self.copies.take() {
            motion.velocity = copies.velocity;
            motion.stress = copies.stress;
            motion.affine = copies.affine;
            true
        } else {
            let constants = Constants {
                id: &particles.id,
                mass: &particles.mass,
                volume: &particles.volume,
                density: self.law.density(),
                scale: None,
            };
            let mut position = trial.position.clone();
            let mut gathered = true;
            for runs in batches {
                let moving = Moving {
                    old: MotionSlices {
                        position: &trial.position,
                        deformation_gradient: &motion.deformation_gradient,
                        velocity: &[],
                        stress: &[],
                        affine: &[],
                    },
                    new: MotionSlicesMut {
                        position: &mut position,
                        velocity: &mut motion.velocity,
                        affine: &mut motion.affine,
                        deformation_gradient: &mut [],
                        stress: &mut [],
                    },
                };
                let moved: Result<(), KernelFailure> = moving.over(runs, &constants, kernel, false);
                gathered &= moved.is_ok();
            }
            let scale = particles.extra.get();
            let gradients = &motion.deformation_gradient;
            let restored = self
                .law
                .restore_stress(gradients, scale, &mut motion.stress);
            gathered && restored.is_ok()
        };
        self.law.forget();
        if undone {
            Ok(())
        } else {
            Err(SolveError::Undo {
                body: self.name.clone(),
            })
        }
    }
}
