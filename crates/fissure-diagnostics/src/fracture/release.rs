//! Energy release rate from the ledger.

use fissure_scene::EnergyTotals;

use crate::MeasureError;
use crate::error::check_positive;

/// Energy that a crack released on growing by an area (m², length times thickness), over that area,
/// J/m²:
///
/// ```text
/// G = (ΔW_ext − Δψ − ΔK − ΔD − ΔV − ΔC − ΔL)/ΔA                                              (3)
/// ```
///
/// with the changes of external work, stored and kinetic energy (at the time of the stresses), the laws' dissipation, artificial
/// viscosity, what contacts and stabilising forces took, and transfer loss between two ledgers. For virtual crack closure they are those of one
/// quasi-static scene before and after its tip has moved and equilibrium is found again, or of two that differ by the
/// crack's length only and whose loads act in full from the start: loads and held motions that grow with the step do just the work that is
/// stored, whatever the length, and (3) of two such scenes is 0. It is central in the length, so take it as G at the middle of
/// the two. In a dynamic run with a sharp crack nothing is released: what leaves the tip goes into
/// waves, and (3) is the error of the balance.
///
/// # Errors
/// [`MeasureError::Parameter`] if the area is not positive and finite; [`MeasureError::NotFinite`].
pub fn energy_release(
    before: &EnergyTotals,
    after: &EnergyTotals,
    area: f64,
) -> Result<f64, MeasureError> {
    check_positive("area by which the crack has grown", area)?;
    let kept = |e: &EnergyTotals| {
        let spent = e.dissipated + e.viscous + e.contact + e.stabilisation + e.transfer_loss;
        e.external - e.stored - e.kinetic - e.half_step - spent
    };
    let release = (kept(after) - kept(before)) / area;
    if release.is_finite() {
        Ok(release)
    } else {
        Err(MeasureError::NotFinite { measure: "G" })
    }
}
