//! Choices of the explicit solver.

use fissure_grid::{Grid, Shape, simd::Simd};
use fissure_scene::SolveError;

use crate::band::BandSource;

/// When the stress is updated, relative to the nodal forces of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StressUpdate {
    /// Before them, with the velocities the step starts from. Conserves energy best.
    First,
    /// After the nodes have moved, with their new velocities. Damps slightly; the cheapest. Stable to about half of the Courant
    /// limit only (docs/choose-a-solver.md has it by shape and transfer).
    Last,
    /// After the nodes have moved, with velocities mapped back from the moved particles
    /// (modified update stress last) [Sanchez 2010, eq. 4.3.7]. Safe at nodes of little mass.
    #[default]
    Musl,
}

/// How velocities travel between particles and nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transfer {
    /// Particles add the nodal change of velocity to their own; `pic` (0 to 1) of the
    /// interpolated velocity is blended in. 0 is pure FLIP.
    Flip {
        /// Share of PIC.
        pic: f64,
    },
    /// Particles take the interpolated velocity. Very dissipative.
    Pic,
    /// Particles take the interpolated velocity and carry its gradient [Jiang et al. 2015].
    Apic,
    /// APIC by moving least squares, as in MLS-MPM [Hu et al. 2018]: the affine part is also the gradient that strains the
    /// particle, and forces are those that do its work, `f_i = −Σ V σ D⁻¹ (x_i − x_p) N_i`, with APIC's moment `D`. Cheaper, since
    /// no gradients of the functions are needed; conserves as APIC does. B-splines alone have it.
    Mls,
    /// FLIP's acceleration on velocities filtered by `order` terms of the expansion of the
    /// inverse mass matrix [Hammerquist and Nairn 2017]. Order 1 is PIC.
    Xpic {
        /// Number of terms.
        order: usize,
    },
    /// The same filter on the accelerated velocities, boundary conditions included
    /// [Nairn and Hammerquist 2021]. Order 1 is PIC. Reactions include what holding the terms of
    /// the filter takes, so that momentum is accounted for; the work of that part is a loss of
    /// the transfer, not external work.
    Fmpm {
        /// Number of terms.
        order: usize,
    },
}

impl Transfer {
    /// Whether particles take up another nodal field than the velocity they move with.
    pub(crate) fn carries(&self) -> bool {
        !matches!(self, Self::Pic | Self::Apic | Self::Mls)
    }

    /// Whether particles carry an affine part.
    pub(crate) fn is_affine(&self) -> bool {
        matches!(self, Self::Apic | Self::Mls)
    }
}

/// Choices of the explicit solver; `Default` is FLIP with MUSL at 0.4 of the Courant limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExplicitSettings {
    /// Share of the time that the fastest wave needs across a cell; in (0, 1]. How much of it is stable depends on transfer and
    /// stress update: MUSL with FLIP all of it.
    pub cfl: f64,
    /// How velocities travel.
    pub transfer: Transfer,
    /// When the stress is updated.
    pub stress_update: StressUpdate,
    /// Artificial bulk viscosity, `(linear, quadratic)` coefficients, ≥ 0; `None` for none.
    pub viscosity: Option<(f64, f64)>,
    /// Width over which cracks smear.
    pub band: BandSource,
    /// Nodes below this share of the mean particle mass feel no force; in [0, 1e-2]. What they
    /// would have felt is lost to the momentum, so it is 0 (round-off) by default: MUSL does not
    /// need it. With the stress first or last and linear functions, 1e-6 or so keeps nodes that
    /// hold next to nothing from running off.
    pub mass_cutoff: f64,
    /// Vector unit to compute transfers on; the widest of the machine unless one wants to compare.
    pub simd: Simd,
}

impl Default for ExplicitSettings {
    fn default() -> Self {
        Self {
            cfl: 0.4,
            transfer: Transfer::Flip { pic: 0.0 },
            stress_update: StressUpdate::default(),
            viscosity: None,
            band: BandSource::default(),
            mass_cutoff: 0.0,
            simd: Simd::widest(),
        }
    }
}

impl ExplicitSettings {
    /// `D⁻¹`, 1/m², where forces go by weighted arms in place of gradients.
    pub(crate) fn force_factor<S: Shape<D>, const D: usize>(
        &self,
        shape: &S,
        grid: &Grid<D>,
    ) -> Option<f64> {
        let factor = shape.affine_inverse(grid.spacing());
        factor.filter(|_| self.transfer == Transfer::Mls)
    }

    /// Whether a step reads no velocity, stress or affine part of the step before, and can make them again from its nodal
    /// field: then they are written over ([`Body::writes_in_place`](fissure_scene::Body::writes_in_place)).
    pub(crate) fn in_place<S: Shape<D>, const D: usize>(&self) -> bool {
        !self.transfer.carries()
            && self.stress_update == StressUpdate::Last
            && self.viscosity.is_none()
            && !S::DEFORMS
    }

    /// Refuses settings outside their range, and those that do not go with the shape.
    pub(crate) fn check<S: Shape<D>, const D: usize>(&self) -> Result<(), SolveError> {
        if self.transfer == Transfer::Mls && !S::MOMENTS {
            return Err(SolveError::Unsupported {
                what: "moving least squares with other shape functions than B-splines",
            });
        }
        let refuse = |setting, value, permitted| {
            Err(SolveError::Setting {
                setting,
                value,
                permitted,
            })
        };
        if !(self.cfl > 0.0 && self.cfl <= 1.0) {
            return refuse("cfl", self.cfl, "in (0, 1]");
        }
        if !(self.mass_cutoff >= 0.0 && self.mass_cutoff <= 1e-2) {
            return refuse("mass_cutoff", self.mass_cutoff, "in [0, 1e-2]");
        }
        match self.transfer {
            Transfer::Flip { pic } if !(0.0..=1.0).contains(&pic) => {
                return refuse("pic", pic, "in [0, 1]");
            }
            Transfer::Xpic { order } | Transfer::Fmpm { order } if !(1..=20).contains(&order) => {
                return refuse("order", order as f64, "1 to 20");
            }
            _ => {}
        }
        if let Some((linear, quadratic)) = self.viscosity {
            for (setting, value) in [
                ("linear viscosity", linear),
                ("quadratic viscosity", quadratic),
            ] {
                if !(value >= 0.0 && value.is_finite()) {
                    return refuse(setting, value, "finite and >= 0");
                }
            }
        }
        Ok(())
    }
}
