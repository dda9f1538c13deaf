//! Choices of the quasi-static solver.

use fissure_scene::{Scene, SolveError};
use nalgebra::SVector;

use crate::band::BandSource;
use crate::equilibrium::links::Links;
use crate::equilibrium::one_strain::Deviations;

/// What a load step holds fixed.
///
/// With all but [`Prescribed`](Self::Prescribed) the load time is an unknown of the step, which closes with
/// an equation of its own, and may fall: equilibrium is followed past limits of load and of displacement.
/// Loads and motions are those that the scene states for the load time; a motion is its speed
/// times the change of load time, so speeds should be constant and loads smooth functions. Time runs
/// on with the length of the path: it is the load time until the first step that is not prescribed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LoadControl {
    /// The load time: load and displacement control, as the scene states loads and motions.
    #[default]
    Prescribed,
    /// The length of the displacement increment of the nodes, the root of its mean square weighted by mass
    /// [Crisfield 1981]. The first step is prescribed and sets it.
    ArcLength,
    /// The energy that the laws dissipate in a step [Gutierrez 2004]. Steps that dissipate less stay prescribed.
    Dissipation {
        /// In a step of full length, J; > 0.
        energy: f64,
    },
}

/// What of their deformation the particles of a patch have in common: those of a body that reach the same nodes, with
/// linear functions those of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Averaging {
    /// Nothing.
    #[default]
    None,
    /// The change of their volume. Against locking of nearly incompressible bodies (F-bar, B-bar); not in
    /// plane stress.
    Volume,
    /// All of it: one strain per cell. Against the locking of smeared cracks oblique to the grid, with a law that keeps
    /// no elastic shear on a crack; not in axisymmetry.
    Strain {
        /// Stiffness against what the mean does not see, over that of the material as it is; ≥ 0. 0.1 is enough,
        /// 1 locks again.
        hourglass: f64,
    },
}

/// What a Newton iteration at a given load does when a correction leaves more unbalanced than before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Safeguard {
    /// Takes it back and solves again with a stiffer system [Levenberg 1944; Marquardt 1963]. Fit for open cracks,
    /// whose tangent is next to nothing.
    #[default]
    Stiffening,
    /// Takes a half of it, a quarter and so on, until the residual falls (line search [Armijo 1966]), also where
    /// a law refuses what the whole leads to. Fit for smooth laws and large steps.
    LineSearch,
}

/// Choices of the quasi-static solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuasiStaticSettings {
    /// Length of a load step, s: prescribed speeds times this are the displacement increments; > 0.
    pub step: f64,
    /// What a step holds fixed.
    pub control: LoadControl,
    /// Damping rate `c` of a viscous force `−c m v` on every node, 1/s, `v` its displacement over the length of the
    /// step; 0 is none. It lets a step pass a sudden loss of stability; its work is booked as
    /// `stabilisation`. ≥ 0.
    pub stabilisation: f64,
    /// Residual forces over the largest reaction so far at which a step is in equilibrium; in
    /// (0, 1e-2]. No more is asked than rounding of the stresses lets be had.
    pub tolerance: f64,
    /// Newton iterations before a step is cut, tries of a shorter correction among them; ≥ 1.
    pub max_iterations: usize,
    /// What an iteration does when a correction leaves more unbalanced. At a given load only: an iteration that
    /// follows a path chooses among the points that its control permits.
    pub safeguard: Safeguard,
    /// How often a step may be halved before it fails; at most 40.
    pub max_cuts: usize,
    /// What the particles of a cell have in common.
    pub averaging: Averaging,
    /// Width over which cracks smear.
    pub band: BandSource,
}

impl<const D: usize> Links<D> {
    /// Averages over the patches at the start of a step, on so many nodes.
    pub(super) fn average_as(
        &mut self,
        averaging: Averaging,
        scene: &Scene<D>,
        deviations: &Deviations<D>,
        nodes: usize,
    ) {
        match averaging {
            Averaging::None => {}
            Averaging::Volume => self.average(scene, &vec![SVector::zeros(); nodes]),
            Averaging::Strain { hourglass } => self.one_strain(scene, deviations, hourglass),
        }
    }
}

impl Default for QuasiStaticSettings {
    fn default() -> Self {
        Self {
            step: 1.0,
            control: LoadControl::Prescribed,
            stabilisation: 0.0,
            tolerance: 1e-8,
            max_iterations: 40,
            safeguard: Safeguard::default(),
            max_cuts: 12,
            averaging: Averaging::None,
            band: BandSource::default(),
        }
    }
}

impl QuasiStaticSettings {
    /// Refuses settings outside their range.
    pub(crate) fn check(&self) -> Result<(), SolveError> {
        let refuse = |setting, value, permitted| {
            Err(SolveError::Setting {
                setting,
                value,
                permitted,
            })
        };
        if !(self.step > 0.0 && self.step.is_finite()) {
            return refuse("step", self.step, "finite and > 0");
        }
        if let LoadControl::Dissipation { energy } = self.control
            && !(energy > 0.0 && energy.is_finite())
        {
            return refuse("energy", energy, "finite and > 0");
        }
        if !(self.stabilisation >= 0.0 && self.stabilisation.is_finite()) {
            return refuse("stabilisation", self.stabilisation, "finite and >= 0");
        }
        if !(self.tolerance > 0.0 && self.tolerance <= 1e-2) {
            return refuse("tolerance", self.tolerance, "in (0, 1e-2]");
        }
        if let Averaging::Strain { hourglass } = self.averaging
            && !(hourglass >= 0.0 && hourglass.is_finite())
        {
            return refuse("hourglass", hourglass, "finite and >= 0");
        }
        if self.max_iterations == 0 {
            return refuse("max_iterations", 0.0, ">= 1");
        }
        if self.max_cuts > 40 {
            return refuse("max_cuts", self.max_cuts as f64, "at most 40");
        }
        Ok(())
    }
}
