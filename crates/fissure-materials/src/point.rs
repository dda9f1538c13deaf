//! One material point, driven along a [`Path`]: the shortest way to look at a law.
//!
//! `F = R (1 + ε)` with the path's rotation and symmetric strain. Work is `∫ T : dε` per reference
//! volume with the Biot stress `T = sym(J σ̂ U⁻¹)`, where `σ̂` is the Cauchy stress in the turning
//! frame: the same as `∫ P : dF`, since a rigid rotation does no work. It is summed by the
//! trapezoidal rule over the steps, so it converges with their number and is exact for laws that
//! are linear in `ε` but for the steps in which they bend.

use fissure_tensor::{Matrix3, Sym, rotation};
use thiserror::Error;

use crate::equilibrium::{Failure, Problem, components, tensor};
use crate::{Control, Increment, Leg, Material, MaterialError, Path};

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
    /// A leg has no steps, a negative step length or a target that is not a number.
    #[error("leg {leg}: needs steps > 0, a step length ≥ 0 and finite targets and spin")]
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
}

impl<S> Sample<S> {
    /// `F = R (1 + ε)`.
    pub fn deformation_gradient(&self) -> Matrix3<f64> {
        self.rotation * (Matrix3::identity() + self.strain.to_matrix())
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
        let mut samples = Vec::with_capacity(path.legs.iter().map(|leg| leg.steps).sum());
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
        self.law.check_band(&path.band, &path.external.scale)?;
        for (index, leg) in path.legs.iter().enumerate() {
            if !is_sound(leg) {
                return Err(PointError::Leg { leg: index });
            }
        }
        for (index, leg) in path.legs.iter().enumerate() {
            let start = self.now;
            for step in 1..=leg.steps {
                self.step(path, index, step, &start)?;
                visit(&self.now);
            }
        }
        Ok(())
    }

    fn step(
        &mut self,
        path: &Path,
        index: usize,
        step: usize,
        start: &Sample<M::State>,
    ) -> Result<(), PointError> {
        let leg = &path.legs[index];
        let fraction = step as f64 / leg.steps as f64;
        let (strain, stress) = self.targets(leg, start, fraction);
        let old = self.now;
        let problem = Problem {
            law: self.law,
            old: &old.state,
            increment: Increment {
                f_old: old.deformation_gradient(),
                f_new: old.deformation_gradient(),
                dt: leg.dt,
                band: path.band,
                external: path.external,
            },
            rotation: rotation(&leg.spin, leg.spin.norm() * fraction) * start.rotation,
            stress,
            modulus: self.modulus(path),
        };
        let mut trial = problem.solve(strain).map_err(|failure| match failure {
            Failure::Law(source) => PointError::Update {
                leg: index,
                step,
                source,
            },
            Failure::Unbalanced(unbalanced) => PointError::NoEquilibrium {
                leg: index,
                step,
                unbalanced,
            },
        })?;
        if let Some(stretch) = self.law.out_of_plane_stretch(&trial.response.state) {
            trial.strain.mandel[2] = stretch - 1.0;
        }
        self.now = Sample {
            leg: index,
            step,
            time: old.time + leg.dt,
            strain: trial.strain,
            stress: trial.stress,
            rotation: problem.rotation,
            state: trial.response.state,
            stored: trial.response.stored,
            dissipated: old.dissipated + trial.response.dissipated,
            work: old.work,
        };
        let mean_stress = (old.biot_stress() + self.now.biot_stress()) * 0.5;
        self.now.work += mean_stress.dot(&(self.now.strain - old.strain));
        Ok(())
    }

    /// Strain to start from (final where it is controlled) and the stresses asked for.
    fn targets(
        &self,
        leg: &Leg,
        start: &Sample<M::State>,
        fraction: f64,
    ) -> (Sym, [Option<f64>; 6]) {
        let (first_strain, first_stress) = (components(&start.strain), components(&start.stress));
        let mut strain = components(&self.now.strain);
        let mut stress = [None; 6];
        let plane = self.law.out_of_plane_stretch(&self.now.state).is_some();
        for i in 0..6 {
            if plane && (2..5).contains(&i) {
                continue;
            }
            // In this form the last step ends on the target to the last bit.
            let between = |first: f64, end: f64| first * (1.0 - fraction) + end * fraction;
            match leg.control[i] {
                Control::Held => strain[i] = first_strain[i],
                Control::Strain(end) => strain[i] = between(first_strain[i], end),
                Control::Stress(end) => stress[i] = Some(between(first_stress[i], end)),
            }
        }
        (tensor(&strain), stress)
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

fn is_sound(leg: &Leg) -> bool {
    let targets = leg.control.iter().all(|control| match control {
        Control::Held => true,
        Control::Strain(end) | Control::Stress(end) => end.is_finite(),
    });
    leg.steps > 0 && leg.dt >= 0.0 && targets && leg.spin.iter().all(|c| c.is_finite())
}

#[cfg(test)]
mod tests;
