//! Choices of the implicit solver.

use fissure_scene::SolveError;

use crate::band::BandSource;
use crate::equilibrium::choice::LinearSolver;

/// How a step goes from accelerations to velocities and displacements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integration {
    /// The document's scheme [Sanchez 2010, eq. 4.2.20]: `p^L = p + Δt (μ f^L + (1 − μ) f)`, and nodes
    /// move with `v^L`. At `weight` 0 it is the explicit step with the stress last. Of first order in
    /// the step for every `weight` > 0, ½ included, since nodes do not move with the mean velocity; it
    /// damps, the more the larger `weight` and the step.
    Theta {
        /// μ, in [0, 1]; from ½ on steps of any length are stable, below it those of at most `h/(c √(2 (1 − 2 μ)))`,
        /// `c` the speed of the fastest wave: longer ones are refused.
        weight: f64,
    },
    /// Generalised α [Chung and Hulbert 1993]: of second order; motions too fast for the step are damped.
    GeneralizedAlpha {
        /// Share that is left of an infinitely fast motion after a step, in [0, 1]; at 1 nothing is
        /// damped.
        spectral_radius: f64,
    },
    /// Newmark's scheme; of second order at `gamma` = ½, where nothing is damped.
    Newmark {
        /// β, in [¼, ½].
        beta: f64,
        /// γ, in [½, 1], at most 2 β, so that steps of any length are stable.
        gamma: f64,
    },
}

/// Choices of the implicit solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImplicitSettings {
    /// Length of a step, s; > 0. Steps that fail are halved and grow back to it.
    pub step: f64,
    /// How forces move nodes.
    pub integration: Integration,
    /// How the linear systems are solved.
    pub linear: LinearSolver,
    /// Unbalanced forces over the largest of internal, external and inertial forces at which a step is
    /// accepted; in (0, 1e-2]. No more is asked than rounding of the stresses lets be had.
    pub tolerance: f64,
    /// Newton iterations before a step is cut; ≥ 1.
    pub max_iterations: usize,
    /// How often a step may be halved before it fails; at most 40.
    pub max_cuts: usize,
    /// Share of the interpolated velocity in the particles' new velocity; the rest is their own plus the
    /// nodes' change of velocity. In [0, 1]; 0 is pure FLIP.
    pub pic: f64,
    /// Width over which cracks smear.
    pub band: BandSource,
}

impl Default for ImplicitSettings {
    fn default() -> Self {
        Self {
            step: 1.0,
            integration: Integration::GeneralizedAlpha {
                spectral_radius: 0.8,
            },
            linear: LinearSolver::Direct,
            tolerance: 1e-8,
            max_iterations: 30,
            max_cuts: 12,
            pic: 0.0,
            band: BandSource::default(),
        }
    }
}

impl ImplicitSettings {
    /// Refuses settings outside their range.
    pub(crate) fn check(&self) -> Result<(), SolveError> {
        let rule = |setting, value: f64, holds: bool, permitted| match holds {
            true => Ok(()),
            false => Err(SolveError::Setting {
                setting,
                value,
                permitted,
            }),
        };
        let step = self.step;
        rule(
            "step",
            step,
            step > 0.0 && step.is_finite(),
            "finite and > 0",
        )?;
        let unit = 0.0..=1.0;
        match self.integration {
            Integration::Theta { weight } => {
                rule("weight", weight, unit.contains(&weight), "in [0, 1]")?;
            }
            Integration::GeneralizedAlpha { spectral_radius: r } => {
                rule("spectral_radius", r, unit.contains(&r), "in [0, 1]")?;
            }
            Integration::Newmark { beta, gamma } => {
                rule("beta", beta, (0.25..=0.5).contains(&beta), "in [0.25, 0.5]")?;
                let fits = gamma >= 0.5 && gamma <= 2.0 * beta;
                rule("gamma", gamma, fits, "in [0.5, 2 beta]")?;
            }
        }
        let tolerance = self.tolerance;
        let fits = tolerance > 0.0 && tolerance <= 1e-2;
        rule("tolerance", tolerance, fits, "in (0, 1e-2]")?;
        rule("max_iterations", 0.0, self.max_iterations > 0, ">= 1")?;
        let cuts = self.max_cuts;
        rule("max_cuts", cuts as f64, cuts <= 40, "at most 40")?;
        rule("pic", self.pic, unit.contains(&self.pic), "in [0, 1]")?;
        self.linear.check()
    }
}
