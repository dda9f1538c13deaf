//! A plane of an elastic material: stiffness to opening and sliding, and what a crack on it does.

use fissure_tensor::{Sym, Tangent, Vector3};

use super::super::crack::{Demand, Moved};
use super::super::tangent::tangents;

/// A plane of the elastic material.
pub(super) struct PlaneAt {
    pub normal: Vector3<f64>,
    /// `K_n` and `Ḡ`, Pa.
    pub across: f64,
    pub along: f64,
    /// `C:n⊗n`, and `C:sym(n⊗a_i) √(Ḡ/G_i)`, Pa.
    pub opening: Sym,
    pub sliding: [Sym; 2],
    pub axes: [Vector3<f64>; 2],
    /// Largest coupling of normal and shear traction over `K_n`.
    pub coupling: f64,
}

impl PlaneAt {
    pub fn new(stiffness: &Tangent, normal: &Vector3<f64>) -> Self {
        let normal = normal.normalize();
        let opening = stiffness.apply(&Sym::dyad(&normal));
        let across = opening.normal_component(&normal);
        let (first, second) = tangents(&normal, &Vector3::zeros());
        let shear = |axis: &Vector3<f64>| stiffness.apply(&Sym::dyad_of(&normal, axis));
        let (q, r) = (shear(&first), shear(&second));
        let component = |stress: &Sym, axis: &Vector3<f64>| axis.dot(&stress.traction(&normal));
        let (a, b) = (component(&q, &first), component(&r, &second));
        let (sin, cos) = (0.5 * (2.0 * component(&q, &second)).atan2(a - b)).sin_cos();
        let axes = [first * cos + second * sin, second * cos - first * sin];
        let stresses = [q * cos + r * sin, r * cos - q * sin];
        let moduli = [0, 1].map(|i| component(&stresses[i], &axes[i]));
        let along = (moduli[0] * moduli[1]).sqrt();
        let in_plane = opening.traction(&normal) - normal * across;
        Self {
            normal,
            across,
            along,
            opening,
            sliding: [0, 1].map(|i| stresses[i] * (along / moduli[i]).sqrt()),
            axes,
            coupling: in_plane.norm() / across,
        }
    }

    /// The demands of a strain; the shear scaled by `√(G_i/Ḡ)`.
    pub fn demand(&self, strain: &Sym) -> Demand {
        let shear = [0, 1].map(|i| self.sliding[i].dot(strain) / self.along);
        Demand {
            normal: self.opening.dot(strain) / self.across,
            shear: self.axes[0] * shear[0] + self.axes[1] * shear[1],
        }
    }

    /// `C:sym(n⊗γ)` for a scaled shear strain.
    pub fn sliding_stress(&self, shear: &Vector3<f64>) -> Sym {
        self.sliding[0] * self.axes[0].dot(shear) + self.sliding[1] * self.axes[1].dot(shear)
    }

    /// The stress that the crack's strain takes off.
    pub fn relief(&self, moved: &Moved) -> Sym {
        self.opening * moved.normal_strain + self.sliding_stress(&moved.shear_strain)
    }

    /// `∂T/∂E` with plane and band fixed.
    pub fn modulus(&self, stiffness: &Tangent, moved: &Moved) -> Tangent {
        let slopes = &moved.slopes;
        let mut modulus = *stiffness
            - Tangent::dyad(&self.opening, &self.opening) * ((1.0 - slopes.normal) / self.across);
        let (first, second) = tangents(&self.normal, &slopes.direction);
        for (direction, slope) in [(first, slopes.along), (second, slopes.across)] {
            let sliding = self.sliding_stress(&direction);
            modulus = modulus - Tangent::dyad(&sliding, &sliding) * ((1.0 - slope) / self.along);
        }
        modulus
    }
}
