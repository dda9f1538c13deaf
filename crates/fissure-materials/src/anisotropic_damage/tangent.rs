//! The damage tensor, the strain partitioning tensor, and the consistent tangent.

use fissure_tensor::{Band, Matrix3, Spectrum, Sym, Tangent, Vector3};

use super::crack::{Demand, Moved, Slopes};
use super::elasticity::Elastic;
use crate::Biot;
use crate::stress_measure::StressMeasure;
use crate::turning::width_rate;

/// `∂T/∂E` with the crack's plane and band fixed:
/// `C − (1 − a_n) C₁₁ m⊗m − Σ_t (1 − a_t) G s_t⊗s_t`, `m = C:(n⊗n)/C₁₁`, `s_t = n⊗t + t⊗n`, with
/// the slopes `a` of the tractions over the virgin ones. This is `C:(1 − Δ)` of eq. 6.
pub(super) fn modulus<const SHEET: bool>(
    elastic: &Elastic<SHEET>,
    normal: &Vector3<f64>,
    slopes: &Slopes,
) -> Tangent {
    let opening = elastic.stress(&Sym::dyad(normal));
    let p_wave = elastic.p_wave_modulus();
    let shear = elastic.shear_modulus();
    let mut modulus =
        elastic.stiffness() - Tangent::dyad(&opening, &opening) * ((1.0 - slopes.normal) / p_wave);
    let (first, second) = tangents(normal, &slopes.direction);
    for (tangential, slope) in [(first, slopes.along), (second, slopes.across)] {
        let sliding = Sym::dyad_of(normal, &tangential) * 2.0;
        modulus = modulus - Tangent::dyad(&sliding, &sliding) * ((1.0 - slope) * shear);
    }
    if slopes.pressed != 0.0 {
        let sliding = Sym::dyad_of(normal, &slopes.direction) * 2.0;
        modulus = modulus + Tangent::dyad(&sliding, &opening) * (slopes.pressed * shear / p_wave);
    }
    modulus
}

/// `direction` and the vector across it in the plane of `normal`; any two if it is zero.
pub(super) fn tangents(
    normal: &Vector3<f64>,
    direction: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    let first = if *direction == Vector3::zeros() {
        let axis = normal.iamin();
        normal.cross(&Vector3::ith(axis, 1.0)).normalize()
    } else {
        *direction
    };
    (first, normal.cross(&first))
}

/// The step in which a crack starts: its normal still follows the strain, and its band the normal.
pub(super) struct Start<'a, const SHEET: bool> {
    pub elastic: &'a Elastic<SHEET>,
    pub kinematics: &'a Biot,
    pub strain: &'a Sym,
    pub band: &'a Band,
    pub moved: &'a Moved,
    pub normal: Vector3<f64>,
    pub weights: [f64; 3],
    /// Whether only the components in the xy plane turn the normal.
    pub in_plane: bool,
    pub width: f64,
}

impl<const SHEET: bool> Start<'_, SHEET> {
    /// `C:(1 − Δ)` for a crack that starts.
    pub fn tangent<Measure: StressMeasure>(&self, stress: &Sym, modulus: &Tangent) -> Tangent {
        // In the order of the stresses, as the weights are.
        let spectrum = self
            .elastic
            .completed(&self.plane_part(self.strain))
            .spectrum();
        Measure::tangent(self.kinematics, stress, |strain_rate, rotation_rate| {
            let normal_rate = self.normal_rate(&spectrum, &self.plane_part(strain_rate));
            let widening = self.widening(&normal_rate, rotation_rate);
            modulus.apply(strain_rate) + self.turning(&normal_rate) + widening
        })
    }

    fn plane_part(&self, tensor: &Sym) -> Sym {
        let mut plane = *tensor;
        if self.in_plane {
            plane.mandel[3] = 0.0;
            plane.mandel[4] = 0.0;
        }
        plane
    }

    /// Rate of `n = Σ_i w_i n_i`: `ṅ_i = Σ_j n_j (n_i·Ė·n_j)/(ε_i − ε_j)`. Coinciding strains are
    /// left out: there the direction is not differentiable.
    fn normal_rate(&self, spectrum: &Spectrum, strain_rate: &Sym) -> Vector3<f64> {
        let (values, vectors) = (&spectrum.values, &spectrum.vectors);
        let smallest = 1e-8 * self.strain.max_abs();
        let mut rate = Vector3::zeros();
        for i in 0..3 {
            // The eigenvectors may have come out with another sign than at onset.
            let weight = vectors[i].dot(&self.normal);
            if self.weights[i] == 0.0 {
                continue;
            }
            for j in 0..3 {
                let gap = values[i] - values[j];
                if gap.abs() > smallest {
                    let turn = vectors[i].dot(&strain_rate.traction(&vectors[j])) / gap;
                    rate += vectors[j] * (weight * turn);
                }
            }
        }
        rate
    }

    /// Rate of `T` when the normal turns in a fixed strain: the demands change,
    /// `ε̇_n = (2G/C₁₁) γ·ṅ` and `γ̇ = 2(E·ṅ − (n·E·n) ṅ)` less its part along the normal, and the
    /// crack's strain turns.
    fn turning(&self, rate: &Vector3<f64>) -> Sym {
        let (elastic, n) = (self.elastic, &self.normal);
        let shear = elastic.shear_modulus();
        let slopes = &self.moved.slopes;
        let demand = Demand::new(elastic, n, self.strain);
        let across = self.strain.traction(n).dot(n);
        let mut shear_rate = (self.strain.traction(rate) - rate * across) * 2.0;
        shear_rate -= n * n.dot(&shear_rate);
        let normal_rate = 2.0 * shear / elastic.p_wave_modulus() * demand.shear.dot(rate);
        let (first, second) = tangents(n, &slopes.direction);
        let sliding = first * ((1.0 - slopes.along) * first.dot(&shear_rate))
            + second * ((1.0 - slopes.across) * second.dot(&shear_rate))
            // The crack's shear strain stays in its plane.
            - n * self.moved.shear_strain.dot(rate);
        let opening = self.moved.normal_strain;
        let crack = Sym::dyad(n) * ((1.0 - slopes.normal) * normal_rate)
            + Sym::dyad_of(n, rate) * (2.0 * opening)
            + Sym::dyad_of(rate, &self.moved.shear_strain)
            + Sym::dyad_of(n, &sliding);
        -elastic.stress(&crack)
    }

    /// Rate of `T` when the band widens as the normal turns, in space.
    fn widening(&self, normal_rate: &Vector3<f64>, rotation_rate: &Matrix3<f64>) -> Sym {
        let rotation = &self.kinematics.rotation;
        let spatial = rotation * self.normal;
        let rate = rotation_rate * self.normal + rotation * normal_rate;
        let width_rate = width_rate(self.band, &spatial, &rate);
        let [opening, sliding] = self.moved.slopes.widening;
        let direction = &self.moved.slopes.direction;
        let per_width = self.elastic.stress(&Sym::dyad(&self.normal))
            * (opening / self.elastic.p_wave_modulus())
            + Sym::dyad_of(&self.normal, direction) * (2.0 * sliding);
        per_width * (width_rate / self.width)
    }
}
