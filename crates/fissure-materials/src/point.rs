//! One material point, driven along a [`Path`]: the shortest way to look at a law.
//!
//! `F = R (1 + ε)` with the path's rotation and symmetric strain. Work is `∫ T : dε` per reference
//! volume with the Biot stress `T = sym(J σ̂ U⁻¹)`, where `σ̂` is the Cauchy stress in the turning
//! frame: the same as `∫ P : dF`, since a rigid rotation does no work. It is summed by the
//! trapezoidal rule over the steps, so it converges with their number and is exact for laws that
//! are linear in `ε` but for the steps in which they bend.

mod events;
mod sub_steps;
mod targets;

use fissure_tensor::{Matrix3, Sym};
use thiserror::Error;

pub use self::events::{Event, EventKind, History};
use self::targets::is_sound;
use crate::{Material, MaterialError, Path};

/// Why a point stopped. `leg` and `step` count from 0 and from 1.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PointError {
    /// The law refused its parameters or the band.
    #[error(transparent)]
    Law(#[from] MaterialError),
    /// The law refused a step.
    #[error("leg {leg}, step {step}: {source}")]
    Update {
        /// The leg.
        leg: usize,
        /// The step in it.
        step: usize,
        /// What the law said.
        source: MaterialError,
    },
    /// No strain gives the stress asked for.
    #[error(
        "leg {leg}, step {step}: no equilibrium, {unbalanced} Pa unbalanced; a softening material \
         cannot follow a load beyond its strength, nor unload where its band is too wide: drive a \
         strain, or refine the band"
    )]
    NoEquilibrium {
        /// The leg.
        leg: usize,
        /// The step in it.
        step: usize,
        /// Largest difference to the stress asked for, Pa.
        unbalanced: f64,
    },
    /// A leg has no steps, a negative step length, a target that is not a number, or a stress for
    /// both of two entries of the gradient that mirror each other; or the tolerance of the
    /// sub-steps is not above zero.
    #[error(
        "leg {leg}: needs steps > 0, a step length ≥ 0, finite targets and spin, a stress for at \
         most one of F_ij and F_ji, and a tolerance of sub-steps > 0"
    )]
    Leg {
        /// The leg.
        leg: usize,
    },
}

/// A material point at the end of a step. Energies are per reference volume, J/m³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<S> {
    /// Leg, from 0.
    pub leg: usize,
    /// Step in the leg, from 1.
    pub step: usize,
    /// Time, s.
    pub time: f64,
    /// Strain `U − 1`, in the turning frame.
    pub strain: Sym,
    /// Cauchy stress in the turning frame, Pa.
    pub stress: Sym,
    /// Rotation `R` of that frame.
    pub rotation: Matrix3<f64>,
    /// The law's history.
    pub state: S,
    /// Stored energy.
    pub stored: f64,
    /// Energy dissipated so far.
    pub dissipated: f64,
    /// Work done so far.
    pub work: f64,
    /// Parts that the step was divided into.
    pub parts: usize,
}

impl<S> Sample<S> {
    /// `F = R (1 + ε)`.
    pub fn deformation_gradient(&self) -> Matrix3<f64> {
        self.rotation * (Matrix3::identity() + self.strain.to_matrix())
    }

    /// Cauchy stress in the fixed axes, Pa.
    pub fn cauchy(&self) -> Sym {
        self.stress.congruence(&self.rotation)
    }

    /// Stress conjugate to the strain, `sym(J σ̂ U⁻¹)`, Pa; zero where `U` is singular.
    pub fn biot_stress(&self) -> Sym {
        let stretch = Matrix3::identity() + self.strain.to_matrix();
        let inverse = stretch.try_inverse().unwrap_or_default();
        Sym::from_matrix(&(self.stress.to_matrix() * inverse)) * stretch.determinant()
    }
}

/// A law at one point, with the history of what it has been through.
///
/// ```
/// use fissure_materials::{Axis, Band, Isotropic, Path, Point};
/// let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
/// let path = Path::new(Band::cube(1e-3)).uniaxial(Axis::X, 1e-3, 10).back(0.0, 10);
/// let samples = Point::new(&steel)?.drive(&path)?;
/// // Uniaxial stress: Young's modulus along the axis, Poisson's ratio across.
/// assert!((samples[9].stress.xx() / 210e6 - 1.0).abs() < 1e-9);
/// assert!((samples[9].strain.yy() / -0.3e-3 - 1.0).abs() < 1e-9);
/// # Ok::<(), fissure_materials::PointError>(())
/// ```
#[derive(Debug)]
pub struct Point<'a, M: Material> {
    law: &'a M,
    now: Sample<M::State>,
}

impl<'a, M: Material> Point<'a, M> {
    /// At rest, free of stress.
    ///
    /// # Errors
    /// [`PointError::Law`] if the law refuses its parameters.
    pub fn new(law: &'a M) -> Result<Self, PointError> {
        law.check()?;
        Ok(Self {
            law,
            now: Sample {
                leg: 0,
                step: 0,
                time: 0.0,
                strain: Sym::ZERO,
                stress: Sym::ZERO,
                rotation: Matrix3::identity(),
                state: law.initial(),
                stored: 0.0,
                dissipated: 0.0,
                work: 0.0,
                parts: 0,
            },
        })
    }

    /// Where the point is now.
    pub fn sample(&self) -> &Sample<M::State> {
        &self.now
    }

    /// Follows a path from where the point is; one sample per step.
    ///
    /// A law in plane stress determines its out-of-plane components itself: the path's control of
    /// zz, yz and xz is not read, the strain zz is what the law found, and only a spin about z keeps
    /// the plane.
    ///
    /// # Errors
    /// [`PointError`]. The point then stays at the last step it could take, see
    /// [`drive_with`](Self::drive_with) for the samples up to there.
    pub fn drive(&mut self, path: &Path) -> Result<Vec<Sample<M::State>>, PointError> {
        let mut samples = Vec::with_capacity(path.legs.iter().map(|leg| leg.steps()).sum());
        self.drive_with(path, |sample| samples.push(*sample))?;
        Ok(samples)
    }

    /// As [`drive`](Self::drive), handing each sample to `visit` as soon as it is there.
    ///
    /// # Errors
    /// As [`drive`](Self::drive).
    pub fn drive_with(
        &mut self,
        path: &Path,
        mut visit: impl FnMut(&Sample<M::State>),
    ) -> Result<(), PointError> {
        self.check(path)?;
        for (index, leg) in path.legs.iter().enumerate() {
            let start = self.now;
            for step in 1..=leg.steps() {
                self.step(path, index, step, &start, |_| ())?;
                visit(&self.now);
            }
        }
        Ok(())
    }

    /// Refuses a band or a path that cannot be followed.
    fn check(&self, path: &Path) -> Result<(), PointError> {
        self.law.check_band(&path.band, &path.external.scale)?;
        for (index, leg) in path.legs.iter().enumerate() {
            if !(is_sound(leg) && path.sub_steps.tolerance > 0.0) {
                return Err(PointError::Leg { leg: index });
            }
        }
        Ok(())
    }

    /// P-wave modulus at rest, Pa.
    fn modulus(&self, path: &Path) -> f64 {
        let identity = Matrix3::identity();
        let initial = self.law.initial();
        let speed = self
            .law
            .wave_speed(&identity, &initial, &path.external.scale);
        self.law.density() * speed * speed
    }
}

#[cfg(test)]
mod tests;
