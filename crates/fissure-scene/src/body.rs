//! A body: particles in columns and one law.

use fissure_materials::{MaterialError, Matrix3, Scale, Tangent};
use fissure_particles::{Column, ExtraError, MotionSlices, Particles};
use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};

use crate::error::SolveError;
use crate::in_place::WrittenOver;
use crate::law::{BodyLaw, Constants, SweepLaw};
use crate::sweep::{
    Run, RunKernel, SweepCause, SweepFailure, SweepSettings, SweepTotals, Tangents,
};

/// Optional column: factors on the law's parameters, particle by particle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ParticleScale(pub Scale);

impl Column for ParticleScale {
    const NAME: &'static str = "scale";
}

/// Particles and the law that gives their stress.
pub struct Body<const D: usize> {
    pub(crate) name: String,
    pub(crate) particles: Particles<D>,
    pub(crate) law: Box<dyn SweepLaw<D>>,
    pub(crate) half_edges: SMatrix<f64, D, D>,
    /// Of a step in place that cannot be undone otherwise.
    pub(crate) copies: Option<WrittenOver<D>>,
}

impl<const D: usize> Body<D> {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its particles.
    pub fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    /// Half-edge vectors of every particle's domain at rest, as columns, m.
    pub fn half_edges(&self) -> &SMatrix<f64, D, D> {
        &self.half_edges
    }

    /// Its law, without its type.
    pub fn law(&self) -> &dyn BodyLaw {
        self.law.as_body_law()
    }

    /// A value of the law's state (one of [`BodyLaw::names`]) of each particle.
    pub fn value(&self, name: &str) -> Option<Vec<f64>> {
        let value = self.law.names().iter().position(|n| *n == name)?;
        let gradients = &self.particles.motion.deformation_gradient;
        Some(self.law.values(value, gradients))
    }

    /// Factors on the law's parameters at each particle, if any differ from 1.
    pub fn scales(&self) -> Option<&[ParticleScale]> {
        self.particles.extra.get::<ParticleScale>()
    }

    pub(crate) fn scales_mut(&mut self) -> Result<&mut [ParticleScale], ExtraError> {
        self.particles.extra.ensure::<ParticleScale>()
    }

    /// Refuses a band for which some particle's law would not be unique.
    ///
    /// # Errors
    /// [`MaterialError::Band`].
    pub fn check_band(&self, band: &Band) -> Result<(), MaterialError> {
        let Some(scales) = self.scales() else {
            return self.law.check_band(band, &Scale::default());
        };
        let mut checked: Option<Scale> = None;
        for scale in scales {
            // Neighbours usually share a scale.
            if checked != Some(scale.0) {
                self.law.check_band(band, &scale.0)?;
                checked = Some(scale.0);
            }
        }
        Ok(())
    }

    /// Fastest wave in the body now, m/s.
    pub fn wave_speed(&self) -> f64 {
        let (motion, constants) = (self.particles.motion.slices(), self.constants());
        self.law.wave_speed(&motion, &constants)
    }

    /// Kinetic energy of the particles, J.
    pub fn kinetic_energy(&self) -> f64 {
        let velocity = &self.particles.motion.velocity;
        kinetic_energy(&self.particles.mass, velocity)
    }

    /// Puts the particles (and states) into another order: `order[i]` is the old index of the new
    /// particle `i`.
    ///
    /// # Errors
    /// An order that is no permutation.
    pub fn reorder(&mut self, order: &[u32]) -> Result<(), SolveError> {
        let refused = |source| SolveError::Particles {
            body: self.name.clone(),
            source,
        };
        self.particles.reorder(order).map_err(refused)?;
        self.law.reorder(order);
        Ok(())
    }

    /// Its particles, for solvers.
    pub fn particles_mut(&mut self) -> &mut Particles<D> {
        &mut self.particles
    }

    /// The particles with the trial motion sized to fit: for solvers.
    pub fn particles_with_trial(&mut self) -> &mut Particles<D> {
        self.particles.make_trial();
        &mut self.particles
    }

    /// Trial motion, stresses and states from the present ones: per run the kernel fills the
    /// trial deformation gradients, then the law is called on each particle of the run.
    ///
    /// # Errors
    /// The failing particle with the lowest id.
    pub fn sweep(
        &mut self,
        runs: &[Run],
        kernel: &dyn RunKernel<D>,
        settings: &SweepSettings,
    ) -> Result<SweepTotals, BodyFailure<D>> {
        self.sweep_into(runs, kernel, settings, None)
    }

    /// The same with the spatial tangent of every particle.
    ///
    /// # Errors
    /// The failing particle with the lowest id.
    pub fn sweep_with_tangents(
        &mut self,
        runs: &[Run],
        kernel: &dyn RunKernel<D>,
        settings: &SweepSettings,
        tangents: &mut Vec<Tangent>,
    ) -> Result<SweepTotals, BodyFailure<D>> {
        tangents.resize(self.particles.len(), Tangent::zero());
        self.sweep_into(runs, kernel, settings, Some(tangents))
    }

    fn sweep_into(
        &mut self,
        runs: &[Run],
        kernel: &dyn RunKernel<D>,
        settings: &SweepSettings,
        tangents: Option<&mut Vec<Tangent>>,
    ) -> Result<SweepTotals, BodyFailure<D>> {
        if settings.in_place {
            self.particles.make_trial_in_place();
        } else {
            self.particles.make_trial();
        }
        let Particles {
            id,
            mass,
            volume,
            motion,
            trial,
            extra,
            ..
        } = &mut self.particles;
        let constants = Constants {
            id,
            mass,
            volume,
            density: self.law.density(),
            scale: extra.get::<ParticleScale>(),
        };
        let tangents = tangents.map_or(Tangents::None, |t| Tangents::Into(t));
        let (old, new) = if settings.in_place {
            motion.slices_in_place(trial)
        } else {
            (motion.slices(), trial.slices_mut())
        };
        let swept = self
            .law
            .sweep(runs, old, new, constants, kernel, settings, tangents);
        swept.map_err(|failure| BodyFailure {
            position: motion.position[failure.index],
            failure,
        })
    }

    /// Makes the trial motion and states the present ones.
    ///
    /// # Errors
    /// Columns that do not fit one another.
    pub fn commit(&mut self) -> Result<(), SolveError> {
        let refused = |source| SolveError::Particles {
            body: self.name.clone(),
            source,
        };
        self.particles.commit().map_err(refused)?;
        self.law.commit();
        Ok(())
    }

    pub(crate) fn constants(&self) -> Constants<'_> {
        Constants {
            id: &self.particles.id,
            mass: &self.particles.mass,
            volume: &self.particles.volume,
            density: self.law.density(),
            scale: self.scales(),
        }
    }

    /// The present motion of all particles.
    pub fn motion(&self) -> MotionSlices<'_, D> {
        self.particles.motion.slices()
    }

    /// The `D×D` part of a deformation gradient that moves in the scene's dimensions.
    #[inline(always)]
    pub fn in_space(f: &Matrix3<f64>) -> SMatrix<f64, D, D> {
        SMatrix::from_fn(|i, j| f[(i, j)])
    }
}

/// `Σ m v²/2` in a fixed order.
pub(crate) fn kinetic_energy<const D: usize>(mass: &[f64], velocity: &[SVector<f64, D>]) -> f64 {
    let pairs = mass.iter().zip(velocity);
    pairs.map(|(m, v)| 0.5 * m * v.norm_squared()).sum()
}

/// A particle that stopped a sweep over a body.
#[derive(Debug)]
pub struct BodyFailure<const D: usize> {
    pub(crate) position: SVector<f64, D>,
    pub(crate) failure: SweepFailure,
}

impl<const D: usize> BodyFailure<D> {
    /// The error of a step that failed on this particle.
    pub fn at(self, body: &Body<D>, step: u64, time: f64) -> SolveError {
        let (body, id) = (body.name.clone(), self.failure.id);
        match self.failure.cause {
            SweepCause::Kernel => SolveError::Outside {
                body,
                id,
                position: self.position.iter().copied().collect(),
                step,
                time,
            },
            SweepCause::Law {
                source,
                deformation_gradient,
                state,
            } => SolveError::Particle {
                body,
                id,
                step,
                time,
                deformation_gradient,
                state,
                source,
            },
        }
    }
}
