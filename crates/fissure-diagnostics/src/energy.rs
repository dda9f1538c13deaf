//! Where the work went, and how well the ledger closes.

use fissure_scene::EnergyTotals;

/// The energy ledger of a scene and the three identities that it keeps apart.
///
/// 1. `W_ext = ΔK_grid + f_int·Δu + contact + stabilisation`, step by step: the equations of motion of the grid, with the
///    displacement of the nodes by the mean of their velocities. Holds to round-off in explicit steps;
///    [`worst_balance`](Self::worst_balance) is by how much it did not.
/// 2. `f_int·Δu = Δψ + ΔD` (and the work of artificial viscosity): the laws, with the displacement that strains the
///    particles and the mean force of the step. Holds but for little that falls with the step, for a law whose stress is the
///    derivative of its stored energy; [`imbalance`](Self::imbalance) is the difference.
/// 3. `K_grid = K_particles`: the transfer. Never holds exactly, since particles have more freedom
///    than nodes; [`transfer_loss`](Self::transfer_loss) is the difference, summed over both ways. K is taken at the time
///    of the stresses, from which the velocities of explicit steps are half a step away
///    ([`half_step`](Self::half_step)): then the first two say how it changes.
///
/// Together, of a scene that starts at rest: `W_ext = K + half_step + f_int·Δu + contact + stabilisation + transfer_loss`.
///
/// ```
/// use fissure_diagnostics::EnergyBalance;
/// use fissure_scene::EnergyTotals;
///
/// let totals = EnergyTotals { external: 2.0, internal: 1.5, stored: 0.4, dissipated: 1.0, ..Default::default() };
/// let balance = EnergyBalance::of(&totals);
/// assert_eq!(balance.grid_kinetic_gain, 0.5);
/// assert!((balance.energy_imbalance() - 0.1 / 2.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyBalance {
    /// W_ext: work of loads, body forces and prescribed velocities, J.
    pub external: f64,
    /// Σ f_int·Δu: work of the internal forces on what strains the particles, J; positive when it is taken up.
    pub internal: f64,
    /// ψ: stored energy now, J.
    pub stored: f64,
    /// D: energy dissipated by the laws, J.
    pub dissipated: f64,
    /// Work of artificial viscosity, J.
    pub viscous: f64,
    /// Energy that contacts took: friction and impacts, J.
    pub contact: f64,
    /// Work against the forces that stabilise quasi-static steps, J.
    pub stabilisation: f64,
    /// K_particles: kinetic energy of the particles now, J.
    pub kinetic: f64,
    /// Kinetic energy at the time of the stresses less K_particles, J.
    pub half_step: f64,
    /// W_ext − Σ f_int·Δu − contact − stabilisation: what the steps gave as kinetic energy, at the time of the stresses, J.
    /// In a quasi-static run, which has none, it is the error of the first identity.
    pub grid_kinetic_gain: f64,
    /// Σ (K_grid − K_particles) after the steps less the same before them, K at the time of the stresses: kinetic energy
    /// lost between particles and grid, J. Numerical dissipation of the transfer, mostly of PIC, APIC
    /// and XPIC.
    pub transfer_loss: f64,
    /// `f_int·Δu − ψ − D − viscous`, J: the error of the laws' time integration, of a scene that
    /// started undeformed.
    pub imbalance: f64,
    /// Largest violation of the first identity in a step, over that step's largest term.
    pub worst_balance: f64,
}

impl EnergyBalance {
    /// The balance of a ledger: `EnergyBalance::of(scene.energy())`.
    pub fn of(totals: &EnergyTotals) -> Self {
        Self {
            external: totals.external,
            internal: totals.internal,
            stored: totals.stored,
            dissipated: totals.dissipated,
            viscous: totals.viscous,
            contact: totals.contact,
            stabilisation: totals.stabilisation,
            kinetic: totals.kinetic,
            half_step: totals.half_step,
            grid_kinetic_gain: totals.external
                - totals.internal
                - totals.contact
                - totals.stabilisation,
            transfer_loss: totals.transfer_loss,
            imbalance: totals.imbalance(),
            worst_balance: totals.worst_balance,
        }
    }

    /// The largest of external work, dissipated and stored energy in magnitude, J: what the errors
    /// are held against. NaN if any of them is.
    pub fn scale(&self) -> f64 {
        let terms = [self.external, self.dissipated, self.stored];
        terms.into_iter().fold(0.0, largest)
    }

    /// [`imbalance`](Self::imbalance) over [`scale`](Self::scale); zero while nothing has happened.
    pub fn energy_imbalance(&self) -> f64 {
        ratio(self.imbalance, self.scale())
    }

    /// [`transfer_loss`](Self::transfer_loss) over [`scale`](Self::scale); zero while nothing has
    /// happened.
    pub fn relative_transfer_loss(&self) -> f64 {
        ratio(self.transfer_loss, self.scale())
    }
}

impl From<&EnergyTotals> for EnergyBalance {
    fn from(totals: &EnergyTotals) -> Self {
        Self::of(totals)
    }
}

/// The larger magnitude; NaN if either is, which `max` would drop.
pub(crate) fn largest(so_far: f64, next: f64) -> f64 {
    if so_far >= next.abs() || so_far.is_nan() {
        so_far
    } else {
        next.abs()
    }
}

/// A share of a scale; nothing of nothing is nothing.
pub(crate) fn ratio(part: f64, scale: f64) -> f64 {
    if part == 0.0 && scale == 0.0 {
        0.0
    } else {
        part / scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_untouched_scene_is_balanced() {
        let balance = EnergyBalance::of(&EnergyTotals::default());
        assert_eq!((balance.scale(), balance.energy_imbalance()), (0.0, 0.0));
    }

    #[test]
    fn nan_is_never_hidden() {
        for totals in [
            EnergyTotals {
                dissipated: f64::NAN,
                external: 1.0,
                ..EnergyTotals::default()
            },
            EnergyTotals {
                internal: f64::NAN,
                external: 1.0,
                ..EnergyTotals::default()
            },
        ] {
            assert!(EnergyBalance::of(&totals).energy_imbalance().is_nan());
        }
    }
}
