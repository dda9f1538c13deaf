//! Where a crack starts under tension or shear [Nairn 2017, sec. 2.1, fig. 1].
//!
//! A crack starts when the largest principal stress reaches the tensile strength `σ_n` or the
//! largest shear stress `(σ₁ − σ₃)/2` the shear strength `τ_t`, whichever is more exceeded.
//! In tension its normal is the first principal direction, in shear it lies halfway between the
//! first and the third. Of the two such planes, which carry the same tractions, the one is taken
//! whose normal is nearer to x (then to y, then the one that points into x, y > 0): a rule on
//! axes, since the stress alone cannot choose (it is the same seen in a mirror that swaps them).

use fissure_tensor::{Spectrum, Sym, Vector3};

use crate::Initiation;

/// Which stress starts a crack, and on which plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Onset {
    /// Tension or shear on any plane (fig. 1B, a Tresca prism cut off by the tensile strength).
    #[default]
    TensionShear,
    /// Tension or shear on planes that contain the z axis (fig. 1A): the choice for plane
    /// problems, where a crack that leans out of the plane would bring out-of-plane shear stress.
    InPlane,
    /// Tension alone (Rankine). A crack still softens in shear.
    Tension,
    /// Tension or shear on the plane of this normal in the reference configuration, which need not
    /// be of unit length.
    Prescribed(Vector3<f64>),
}

/// The surface of fig. 1 with its two strengths, Pa.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TensionShear {
    pub onset: Onset,
    pub tensile: f64,
    pub shear: f64,
}

/// The plane that a stress asks for.
pub(crate) struct Asked {
    pub initiation: Initiation,
    /// Components of the normal on the eigenvectors of the stress; zero for a fixed normal.
    pub weights: [f64; 3],
}

impl TensionShear {
    /// A bound that rejects most states before any spectrum: `σ₁ ≤ mean + 2√(J₂/3)` and
    /// `(σ₁ − σ₃)/2 ≤ √J₂`.
    #[inline]
    pub fn is_surely_below(&self, stress: &Sym) -> bool {
        let (reach, deviator) = (self.tensile - stress.mean(), stress.j2());
        let shear = matches!(self.onset, Onset::Tension) | (deviator <= self.shear * self.shear);
        shear & (reach >= 0.0) & (4.0 * deviator <= 3.0 * reach * reach)
    }

    /// The failure function maximised over the planes considered.
    pub fn asked(&self, stress: &Sym) -> Asked {
        let Onset::Prescribed(normal) = self.onset else {
            let spectrum = self.considered(stress).spectrum();
            return self.on_eigenvectors(&spectrum);
        };
        let normal = normal.normalize();
        Asked {
            initiation: Initiation {
                value: self.along(stress, &normal),
                normal,
            },
            weights: [0.0; 3],
        }
    }

    /// The failure function on one plane; `None` for planes not considered.
    pub fn value_along(&self, stress: &Sym, normal: &Vector3<f64>) -> Option<f64> {
        let considered = match self.onset {
            Onset::TensionShear | Onset::Tension => true,
            Onset::InPlane => normal.z.abs() <= 1e-12,
            Onset::Prescribed(only) => only.normalize().cross(normal).norm() <= 1e-12,
        };
        considered.then(|| self.along(&self.considered(stress), normal))
    }

    /// The stress without what planes that contain z do not see.
    fn considered(&self, stress: &Sym) -> Sym {
        let mut plane = *stress;
        if self.onset == Onset::InPlane {
            plane.mandel[3] = 0.0;
            plane.mandel[4] = 0.0;
        }
        plane
    }

    pub fn along(&self, stress: &Sym, normal: &Vector3<f64>) -> f64 {
        let traction = stress.traction(normal);
        let across = normal.dot(&traction);
        let tension = across / self.tensile - 1.0;
        if self.onset == Onset::Tension {
            return tension;
        }
        tension.max((traction - normal * across).norm() / self.shear - 1.0)
    }

    fn on_eigenvectors(&self, spectrum: &Spectrum) -> Asked {
        let (first, last) = self.ends(spectrum);
        let (values, vectors) = (&spectrum.values, &spectrum.vectors);
        let tension = values[first] / self.tensile - 1.0;
        let shear = 0.5 * (values[first] - values[last]) / self.shear - 1.0;
        let mut weights = [0.0; 3];
        if self.onset == Onset::Tension || tension >= shear {
            weights[first] = 1.0;
            return Asked {
                initiation: Initiation {
                    value: tension,
                    normal: vectors[first],
                },
                weights,
            };
        }
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let (one, other) = (
            (vectors[first] + vectors[last]) * half,
            (vectors[first] - vectors[last]) * half,
        );
        let sign = if preferred(&one, &other) { 1.0 } else { -1.0 };
        weights[first] = half;
        weights[last] = half * sign;
        Asked {
            initiation: Initiation {
                value: shear,
                normal: if sign > 0.0 { one } else { other },
            },
            weights,
        }
    }

    /// Positions of the largest and smallest principal stress considered.
    fn ends(&self, spectrum: &Spectrum) -> (usize, usize) {
        if self.onset != Onset::InPlane {
            return (0, 2);
        }
        // Without out-of-plane shear one eigenvector is z to the last bit.
        match spectrum.vectors.iter().position(|v| v.z.abs() > 0.5) {
            Some(0) => (1, 2),
            Some(1) => (0, 2),
            _ => (0, 1),
        }
    }
}

/// Whether `one` comes before `other` by the rule above.
fn preferred(one: &Vector3<f64>, other: &Vector3<f64>) -> bool {
    const TIE: f64 = 1e-6;
    for axis in 0..2 {
        let gap = one[axis].abs() - other[axis].abs();
        if gap.abs() > TIE {
            return gap > 0.0;
        }
    }
    one.x * one.y >= other.x * other.y
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Random;

    const SURFACE: TensionShear = TensionShear {
        onset: Onset::TensionShear,
        tensile: 30.0,
        shear: 20.0,
    };

    #[test]
    fn corners_of_the_figure() {
        let value = |x, y, z| {
            let asked = SURFACE.asked(&Sym::diagonal(x, y, z));
            (asked.initiation.value, asked.initiation.normal)
        };
        let (tension, normal) = value(30.0, 0.0, 0.0);
        assert!(tension.abs() < 1e-15 && normal.x.abs() == 1.0);
        let (shear, normal) = value(25.0, -15.0, 0.0);
        assert!(shear.abs() < 1e-15 && (normal.x * normal.y - 0.5).abs() < 1e-15);
        // Pressure alone starts nothing; compression does so by shear at 2 τ.
        assert!(value(-1e3, -1e3, -1e3).0 < 0.0);
        assert!(value(-40.0, 0.0, 0.0).0.abs() < 1e-15);
        // The apex.
        assert!(value(30.0, 30.0, 30.0).0.abs() < 1e-15);
    }

    #[test]
    fn in_plane_ignores_the_stress_across() {
        let plane = TensionShear {
            onset: Onset::InPlane,
            ..SURFACE
        };
        for zz in [-1e3, 0.0, 1e3] {
            let asked = plane.asked(&Sym::new(10.0, -10.0, zz, 5.0, -3.0, 0.0));
            assert!((asked.initiation.value + 0.5).abs() < 1e-15);
            assert!(asked.initiation.normal.z == 0.0);
        }
    }

    #[test]
    fn the_bound_never_rejects_a_state_that_asks_for_a_crack() {
        let mut random = Random::new(11);
        let (mut rejected, mut total) = (0, 0);
        for _ in 0..4000 {
            let stress = random.strain_direction(true) * random.uniform(0.0, 60.0);
            let value = SURFACE.asked(&stress).initiation.value;
            if SURFACE.is_surely_below(&stress) {
                assert!(value <= 1e-14, "{value}");
            }
            if value < -0.3 {
                total += 1;
                rejected += i32::from(SURFACE.is_surely_below(&stress));
            }
        }
        assert!(
            f64::from(rejected) > 0.95 * f64::from(total),
            "{rejected} of {total}"
        );
    }
}
