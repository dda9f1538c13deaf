//! The unit of work: a run of at most 64 particles of one window of nodes.

use fissure_materials::{External, MaterialError, Matrix3, Tangent};
use fissure_particles::{MotionSlices, MotionSlicesMut, ParticleId};
use fissure_tensor::{Band, simd::Simd};
use nalgebra::SVector;

use crate::law::Constants;

/// Consecutive particles of one body that reach into one window of a grid's nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// First particle, as an index into the body's columns.
    pub start: u32,
    /// One past the last.
    pub end: u32,
    /// Which window of nodes; the solver's own numbering.
    pub window: u32,
}

impl Run {
    /// Most particles of a run.
    pub const MAX: usize = 64;

    /// Number of particles.
    pub fn len(&self) -> usize {
        (self.end - self.start) as usize
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.end == self.start
    }
}

/// A particle that a kernel could not move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelFailure {
    /// Index into the body's columns.
    pub index: usize,
}

impl KernelFailure {
    /// Of the particles of a run that a kernel cannot move the one with the lowest id, whatever
    /// their order: the kernel, which stopped at the first, is asked for each one by itself.
    pub(crate) fn lowest<const D: usize>(
        self,
        kernel: &mut dyn WindowKernel<D>,
        run: &Run,
        constants: &Constants<'_>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> Self {
        let mut lowest = self.index;
        for row in self.index + 1 - run.start as usize..run.len() {
            let start = run.start + row as u32;
            let alone = Run {
                start,
                end: start + 1,
                window: run.window,
            };
            let (old, _) = old.split_at(row).1.split_at(1);
            let (mut new, _) = new.reborrow().split_at(row).1.split_at(1);
            let failed = kernel
                .gather(&alone, &constants.of(&alone), &old, &mut new)
                .is_err();
            if failed && constants.id[start as usize] < constants.id[lowest] {
                lowest = start as usize;
            }
        }
        Self { index: lowest }
    }
}

/// What does not change of the particles of a run.
#[derive(Clone, Copy, Debug)]
pub struct RunConstants<'a> {
    /// Masses, kg.
    pub mass: &'a [f64],
    /// Volumes at rest, m³.
    pub volume: &'a [f64],
}

/// What a solver does with a body's particles before and after the law sees them, window by window.
pub trait RunKernel<const D: usize>: Sync {
    /// Opens a window: calls `work` once, which hands over the body's runs in it one after another,
    /// all on one thread. What the runs of a window share (its nodes' numbers) is kept on the stack
    /// of this call.
    ///
    /// # Errors
    /// What `work` returns.
    fn on_window(
        &self,
        window: u32,
        work: &mut dyn FnMut(&mut dyn WindowKernel<D>) -> Result<(), KernelFailure>,
    ) -> Result<(), KernelFailure>;
}

/// A kernel that fills the trial motion by a function of a run and the present motion, which gives
/// the failing row, and shares nothing within a window.
pub struct ByRun<F>(pub F);

impl<const D: usize, F> RunKernel<D> for ByRun<F>
where
    F: Fn(&Run, &MotionSlices<'_, D>, &mut MotionSlicesMut<'_, D>) -> Result<(), usize> + Sync,
{
    fn on_window(
        &self,
        _window: u32,
        work: &mut dyn FnMut(&mut dyn WindowKernel<D>) -> Result<(), KernelFailure>,
    ) -> Result<(), KernelFailure> {
        work(&mut OneRun(&self.0))
    }
}

struct OneRun<'a, F>(&'a F);

impl<const D: usize, F> WindowKernel<D> for OneRun<'_, F>
where
    F: Fn(&Run, &MotionSlices<'_, D>, &mut MotionSlicesMut<'_, D>) -> Result<(), usize>,
{
    fn gather(
        &mut self,
        run: &Run,
        _constants: &RunConstants<'_>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> Result<(), KernelFailure> {
        self.0(run, old, new).map_err(|row| KernelFailure {
            index: run.start as usize + row,
        })
    }
}

/// A kernel at work on a window.
pub trait WindowKernel<const D: usize> {
    /// Fills the trial motion `new` (at least the deformation gradient) from the present one;
    /// both hold the particles of `run` only.
    ///
    /// # Errors
    /// The first particle that is outside the grid.
    fn gather(
        &mut self,
        run: &Run,
        constants: &RunConstants<'_>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> Result<(), KernelFailure>;

    /// Takes what the law made of the run, its stresses for example, on to the nodes. Returns the
    /// [`SweepTotals::work`] of the run, J.
    fn scatter(
        &mut self,
        _run: &Run,
        _constants: &RunConstants<'_>,
        _old: &MotionSlices<'_, D>,
        _new: &MotionSlices<'_, D>,
    ) -> f64 {
        0.0
    }

    /// Whether [`external`](Self::external) and [`band`](Self::band) are to be asked.
    fn sets_external(&self) -> bool {
        false
    }

    /// What the solver sets for the law of one particle (by row of the run) in this step: a
    /// temperature change, a damage interpolated from a nodal field. The particle's own scale is
    /// added after.
    fn external(&self, _run: &Run, _row: usize) -> External {
        External::default()
    }

    /// The band of a particle that the step found at this place, m, where it is not that of the sweep.
    fn band(&self, _at: &SVector<f64, D>) -> Option<Band> {
        None
    }
}

/// Artificial bulk viscosity of von Neumann and Richtmyer: in compression at the rate `−D` the
/// pressure `ρ ℓ D (linear·c + quadratic·ℓ D)` is added to the stress. `−D` is the rate of the
/// volume; in plane stress that of the area, in the plane of which alone the pressure acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscosity {
    /// Coefficient of the linear term; usually 0.06 to 0.5.
    pub linear: f64,
    /// Coefficient of the quadratic term; usually 1.2 to 2.
    pub quadratic: f64,
    /// Length over which a shock is spread: the cell size, m.
    pub length: f64,
}

/// What a sweep over a body needs to know besides the kernel.
#[derive(Clone, Copy, Debug)]
pub struct SweepSettings {
    /// Length of the step, s.
    pub dt: f64,
    /// Width over which cracks smear.
    pub band: Band,
    /// Artificial viscosity, if wanted.
    pub viscosity: Option<Viscosity>,
    /// The vector unit that laws run on.
    pub simd: Simd,
    /// Whether velocities, stresses and affine parts are written over the present ones, as
    /// [`Body::writes_in_place`](crate::Body::writes_in_place) allows. Runs then have at most [`Run::MAX`] particles.
    pub in_place: bool,
}

/// Sums over the particles of a body, in an order that does not depend on threads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SweepTotals {
    /// Stored energy, J.
    pub stored: f64,
    /// Energy dissipated in the step, J.
    pub dissipated: f64,
    /// Work of artificial viscosity in the step, J.
    pub viscous: f64,
    /// Largest wave speed, m/s.
    pub wave_speed: f64,
    /// Kinetic energy of the velocities in the trial, J.
    pub kinetic: f64,
    /// Square of the largest of those, m²/s².
    pub speed_squared: f64,
    /// Work of stresses on the strains of the step, J, as the kernel has counted it.
    pub work: f64,
}

impl SweepTotals {
    /// Sums of two sets of particles.
    pub fn merge(self, other: Self) -> Self {
        Self {
            stored: self.stored + other.stored,
            dissipated: self.dissipated + other.dissipated,
            viscous: self.viscous + other.viscous,
            wave_speed: self.wave_speed.max(other.wave_speed),
            kinetic: self.kinetic + other.kinetic,
            speed_squared: self.speed_squared.max(other.speed_squared),
            work: self.work + other.work,
        }
    }
}

/// A particle that stopped a sweep; the one with the lowest id, whatever the threads did.
#[derive(Clone, Debug)]
pub(crate) struct SweepFailure {
    pub id: ParticleId,
    pub index: usize,
    pub cause: SweepCause,
}

#[derive(Clone, Debug)]
pub(crate) enum SweepCause {
    Kernel,
    Law {
        source: MaterialError,
        deformation_gradient: Box<Matrix3<f64>>,
        state: String,
    },
}

impl SweepFailure {
    /// Of two failures the one with the lower id, so that one input gives one error.
    pub(crate) fn first(
        a: Result<SweepTotals, Self>,
        b: Result<SweepTotals, Self>,
    ) -> Result<SweepTotals, Self> {
        match (a, b) {
            (Ok(a), Ok(b)) => Ok(a.merge(b)),
            (Err(a), Err(b)) => Err(if a.id <= b.id { a } else { b }),
            (Err(failure), Ok(_)) | (Ok(_), Err(failure)) => Err(failure),
        }
    }
}

/// Where a sweep puts the tangents, if it is to make them.
pub(crate) enum Tangents<'a> {
    None,
    Into(&'a mut [Tangent]),
}

impl<'a> Tangents<'a> {
    pub(crate) fn split_at(self, row: usize) -> (Self, Self) {
        match self {
            Self::None => (Self::None, Self::None),
            Self::Into(slice) => {
                let (a, b) = slice.split_at_mut(row);
                (Self::Into(a), Self::Into(b))
            }
        }
    }
}
