//! An embedded crack as its user gives it, and what opens it.

use fissure_materials::{
    Cohesive, Isotropic, Jump, Traction, TractionSeparation, TractionSeparationState,
};
use nalgebra::{SMatrix, SVector, Vector3};

/// Which traction opens the crack of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EmbeddedForm {
    /// The mean of the cell's particles.
    Optimal,
    /// That of a point with these constants in the middle of the crack's piece, as the document has it.
    Local(Isotropic),
}

/// A crack embedded in the cells that a straight line crosses, bonded until its law opens it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmbeddedCrack {
    /// A point of the line, m.
    pub point: [f64; 2],
    /// Its normal; need not be of unit length.
    pub normal: [f64; 2],
    /// Traction over jump. Its stiffness also presses shut faces apart.
    pub law: TractionSeparation,
    /// What opens it.
    pub form: EmbeddedForm,
}

/// The crack in one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmbeddedJump {
    /// Corner of the cell with the least coordinates, m.
    pub corner: [f64; 2],
    /// Displacement of the side of the normal against the other, m.
    pub jump: [f64; 2],
    /// Energy dissipated over toughness.
    pub dissipated_fraction: f64,
    /// Area, m².
    pub area: f64,
}

/// The law's answer to a jump, with its stiffness against faces that overlap.
pub(super) fn answer<const D: usize>(
    law: &TractionSeparation,
    jump: &SVector<f64, D>,
    normal: &SVector<f64, D>,
    old: &TractionSeparationState,
) -> Result<Traction<TractionSeparationState>, fissure_materials::MaterialError> {
    let in_space =
        |v: &SVector<f64, D>| Vector3::from_fn(|axis, _| if axis < D { v[axis] } else { 0.0 });
    let (opening, normal) = (in_space(jump), in_space(normal));
    let mut answer = law.update(&Jump::new(opening, normal), old)?;
    let gap = opening.dot(&normal);
    if gap <= 0.0 {
        answer.traction += normal * (law.stiffness * gap);
        answer.tangent += normal * normal.transpose() * law.stiffness;
        answer.stored += 0.5 * law.stiffness * gap * gap;
    }
    Ok(answer)
}

/// Traction of the elastic strain `sym(gradient)` across a normal, Pa.
pub(super) fn traction<const D: usize>(
    elastic: &Isotropic,
    gradient: &SMatrix<f64, D, D>,
    normal: &SVector<f64, D>,
) -> SVector<f64, D> {
    let shear = elastic.shear_modulus();
    let lambda = elastic.p_wave_modulus() - 2.0 * shear;
    normal * (lambda * gradient.trace()) + (gradient + gradient.transpose()) * normal * shear
}
