//! What a law that cracks also says, so that measures and contract checks can look inside.

use fissure_tensor::{Matrix3, Sym, Vector3};

use crate::{Biot, Material, MaterialError, Scale};

/// Where and how strongly a stress state asks for a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Initiation {
    /// Failure function, dimensionless: > 0 asks for a crack, 0 is the surface.
    pub value: f64,
    /// Unit normal of that crack.
    pub normal: Vector3<f64>,
}

/// One crack of a material point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crack {
    /// Unit normal in the reference configuration.
    pub normal: Vector3<f64>,
    /// Normal opening now, m.
    pub opening: f64,
    /// Band that turns openings into strains, m.
    pub width: f64,
    /// Strength it still has, over the virgin one.
    pub strength_ratio: f64,
    /// Energy dissipated, over the toughness; 1 when failed.
    pub dissipated_fraction: f64,
    /// Whether it carries no more tension.
    pub failed: bool,
}

/// A law that cracks.
pub trait Cracking: Material {
    /// Energy per crack area to failure in opening, J/m².
    fn toughness(&self, scale: &Scale) -> f64;

    /// Tensile strength, Pa.
    fn strength(&self, scale: &Scale) -> f64;

    /// Opening at which nothing is carried any more, m; may be infinite.
    fn critical_opening(&self, scale: &Scale) -> f64;

    /// Largest band with a unique response, m [Sanchez 2010, eq. 4.5.17].
    fn band_limit(&self, scale: &Scale) -> f64;

    /// The stress that cracks are judged by, in the reference axes, from the Cauchy stress and the
    /// whole deformation gradient: a law in plane stress is given the stretch that its state holds.
    ///
    /// The default is the stress conjugate to the Biot strain; a small-strain law has the same to
    /// first order.
    ///
    /// # Errors
    /// [`MaterialError::Deformation`].
    fn driving_stress(&self, f: &Matrix3<f64>, cauchy: &Sym) -> Result<Sym, MaterialError> {
        Ok(Biot::new(f)?.conjugate(cauchy))
    }

    /// The failure function in one direction; `None` if the law lets no crack start there.
    ///
    /// The default is Rankine's, normal traction over strength less 1.
    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        Some(stress.normal_component(normal) / self.strength(scale) - 1.0)
    }

    /// The failure function of a crack, with the strength that it has left: zero while it softens.
    ///
    /// The default is that of opening, normal traction over strength less [`Crack::strength_ratio`].
    fn failure_of(&self, stress: &Sym, crack: &Crack, scale: &Scale) -> f64 {
        stress.normal_component(&crack.normal) / self.strength(scale) - crack.strength_ratio
    }

    /// Whether the flow follows from the failure function, so that the tangent is symmetric while
    /// the crack's direction and band are fixed.
    fn associated(&self) -> bool {
        true
    }

    /// The failure function maximised over the directions the law considers.
    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation;

    /// [`failure_along`](Self::failure_along) in plane stress, where a law may leave out planes that
    /// lean out of the plane.
    fn failure_in_plane(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.failure_along(stress, normal, scale)
    }

    /// [`initiation`](Self::initiation) in plane stress.
    fn initiation_in_plane(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.initiation(stress, scale)
    }

    /// The cracks of a state, in storage order.
    fn cracks(&self, state: &Self::State) -> Vec<Crack>;

    /// Quantities that never fall, in a fixed order.
    fn irreversible(&self, state: &Self::State) -> Vec<f64>;
}
