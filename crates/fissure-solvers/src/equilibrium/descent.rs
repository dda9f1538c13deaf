//! How much a correction has to lower a residual, and how far it is shortened [Armijo 1966].

/// Share of the fall that the tangent promises which a correction must bring.
const ARMIJO: f64 = 1e-4;

/// Shortest share of a correction that is tried: eight halvings.
pub(crate) const LEAST_SHARE: f64 = 1.0 / 256.0;

/// Whether a share of a correction lowered a residual enough.
pub(crate) fn falls(now: f64, before: f64, share: f64) -> bool {
    now <= (1.0 - ARMIJO * share) * before
}
