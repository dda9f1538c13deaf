//! Two cracks across each other in one strain.

use fissure_tensor::{Sym, Tangent, Vector3};

use super::TwoCrackState;
use crate::Softening;
use crate::anisotropic_damage::crack::{CrackAt, Demand, Moved, Slopes};
use crate::anisotropic_damage::elasticity::Elastic;
use crate::anisotropic_damage::tangent::modulus;

/// Both cracks, and what the strain of the step asks of each if the other has no strain.
pub(super) struct Pair<'a, N, T> {
    pub first: CrackAt<'a, N, T>,
    pub second: CrackAt<'a, N, T>,
    /// `κ`, by which the strain of one crack relieves the other: `λ/C₁₁`.
    pub lateral: f64,
    pub old: &'a TwoCrackState,
    pub demands: [Demand; 2],
    pub old_demands: [Demand; 2],
}

/// Both cracks after a step.
pub(super) struct MovedPair {
    pub first: Moved,
    pub second: Moved,
    /// Whether the shear strain that both planes see is the second crack's.
    pub second_shears: bool,
    /// Normal strain of the first crack as the second saw it: its own but for round-off.
    pub relieving: f64,
}

impl MovedPair {
    pub fn state(&self) -> TwoCrackState {
        TwoCrackState {
            first: self.first.state,
            second: self.second.state,
            relieving: self.relieving,
        }
    }

    pub fn dissipated(&self) -> f64 {
        self.first.dissipated + self.second.dissipated
    }

    /// The strain of both cracks.
    pub fn strain(&self) -> Sym {
        [&self.first, &self.second]
            .map(|moved| {
                let normal = Vector3::from(moved.state.normal);
                Sym::dyad(&normal) * moved.normal_strain
                    + Sym::dyad_of(&normal, &moved.shear_strain)
            })
            .into_iter()
            .fold(Sym::ZERO, |sum, strain| sum + strain)
    }

    /// `∂T/∂E`: the normal strains follow from `dε_cj = p_j (dA_j − κ dε_ci)`, `p = 1 − a`; in shear a direction belongs
    /// to one crack.
    pub fn modulus<const SHEET: bool>(&self, elastic: &Elastic<SHEET>) -> Tangent {
        let [one, two] = [&self.first, &self.second];
        let normals = [one, two].map(|moved| Vector3::from(moved.state.normal));
        let third = normals[0].cross(&normals[1]);
        let owner = if self.second_shears { 1 } else { 0 };
        let mut sum = elastic.stiffness();
        for (index, crack) in [one, two].into_iter().enumerate() {
            let mut slopes = Slopes {
                normal: 1.0,
                ..crack.slopes
            };
            if index != owner {
                // It has softened along `third` alone.
                (slopes.direction, slopes.across) = (third, 1.0);
            }
            sum = sum + modulus(elastic, &normals[index], &slopes) - elastic.stiffness();
        }
        let p_wave = elastic.p_wave_modulus();
        let [p, q] = [one, two].map(|crack| 1.0 - crack.slopes.normal);
        let [m, n] = normals.map(|normal| elastic.stress(&Sym::dyad(&normal)));
        let lateral = elastic.lateral_ratio();
        let scale = 1.0 / (p_wave * (1.0 - lateral * lateral * p * q));
        let mixed = Tangent::dyad(&m, &n) + Tangent::dyad(&n, &m);
        sum - (Tangent::dyad(&m, &m) * p + Tangent::dyad(&n, &n) * q - mixed * (lateral * p * q))
            * scale
    }
}

impl<N: Softening, T: Softening> Pair<'_, N, T> {
    /// Both cracks at the end of the step.
    ///
    /// The normal strain of the first is the zero of `g₁(A₁ − κ g₂(A₂ − κ y)) − y`, where `g` gives a crack's
    /// strain for a demand: Newton's method, kept in a bracket. Below the limit of the band the function falls but for
    /// jumps upwards, where a crack fails, so that what the bracket closes on is a zero.
    pub fn settle(&self) -> MovedPair {
        let (mut low, mut high) = (0.0, self.demands[0].normal.max(0.0));
        let tolerance = 4.0 * f64::EPSILON * high;
        // From where the last step ended: one that nothing moves ends there, to the last bit.
        let mut strain = self.old.relieving.min(high);
        let mut moved = self.at(strain);
        for round in 0..200 {
            let gap = moved.first.normal_strain - strain;
            // NaN ends the search; the stress is then refused as not finite.
            if !(gap.abs() > tolerance) {
                break;
            }
            if gap > 0.0 {
                low = strain
            } else {
                high = strain
            }
            let compliances =
                (1.0 - moved.first.slopes.normal) * (1.0 - moved.second.slopes.normal);
            let next = strain + gap / (1.0 - self.lateral * self.lateral * compliances);
            let middle = 0.5 * (low + high);
            let inside = next > low && next < high && round % 4 != 3;
            strain = if inside { next } else { middle };
            if middle <= low || middle >= high {
                break;
            }
            moved = self.at(strain);
        }
        moved
    }

    /// The cracks if the first one's normal strain were this, which its own may not be.
    fn at(&self, strain: f64) -> MovedPair {
        let normals = [self.first.normal, self.second.normal];
        let relief = self.lateral;
        let olds = [&self.old.first, &self.old.second];
        let old_relief = olds.map(|old| relief * open_strain(old.opening, old.width));

        let without = |demand: &Demand, across: &Vector3<f64>, relief: f64| Demand {
            normal: demand.normal - relief,
            shear: demand.shear - across * demand.shear.dot(across),
        };
        let demand = without(&self.demands[1], &normals[0], relief * strain);
        let mut second = self.second.moved(olds[1], &demand, || {
            without(&self.old_demands[1], &normals[0], old_relief[0])
        });
        let second_shears = self.second.is_free_to_slide(&second.state);
        if second_shears {
            second.shear_strain = self.demands[1].shear;
        }

        let relieved = |demand: &Demand, relief: f64| match second_shears {
            true => without(demand, &normals[1], relief),
            false => Demand {
                normal: demand.normal - relief,
                ..*demand
            },
        };
        let demand = relieved(&self.demands[0], relief * second.normal_strain);
        let first = self.first.moved(olds[0], &demand, || {
            relieved(&self.old_demands[0], old_relief[1])
        });
        MovedPair {
            first,
            second,
            second_shears,
            relieving: strain,
        }
    }
}

/// Normal strain of a crack, from its opening.
fn open_strain(opening: f64, width: f64) -> f64 {
    if width > 0.0 { opening / width } else { 0.0 }
}
