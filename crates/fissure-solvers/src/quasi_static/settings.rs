//! Choices of the quasi-static solver.

use fissure_scene::SolveError;

use crate::band::BandSource;

/// Choices of the quasi-static solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuasiStaticSettings {
    /// Length of a load step, s: prescribed speeds times this are the displacement increments; > 0.
    pub step: f64,
    /// Residual forces over the largest reaction so far at which a step is in equilibrium; in
    /// (0, 1e-2].
    pub tolerance: f64,
    /// Newton iterations before a step is cut; ≥ 1.
    pub max_iterations: usize,
    /// How often a step may be halved before it fails; at most 40.
    pub max_cuts: usize,
    /// Width over which cracks smear.
    pub band: BandSource,
}

impl Default for QuasiStaticSettings {
    fn default() -> Self {
        Self {
            step: 1.0,
            tolerance: 1e-8,
            max_iterations: 40,
            max_cuts: 12,
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
        if !(self.tolerance > 0.0 && self.tolerance <= 1e-2) {
            return refuse("tolerance", self.tolerance, "in (0, 1e-2]");
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
