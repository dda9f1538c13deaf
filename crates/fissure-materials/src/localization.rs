//! Loss of ellipticity: when and across which plane a law lets a strain jump develop.
//!
//! With the spatial tangent `c` (Truesdell rate) and the Cauchy stress `σ` the acoustic tensor is
//! `Q_ik(n) = n_j c_ijkl n_l + (n·σ·n) δ_ik` [Rabczuk 2007, sec. 4.2.1, with normal and
//! polarisation told apart]. A jump `m ⊗ n` of the velocity gradient across a plane of normal `n`
//! is possible where `Q(n)·m = 0`, so the criterion is `min_n det Q(n) ≤ 0` [Rice 1976]. In the
//! plane (normals and polarisations across z) `Q` is 2×2.
//!
//! The minimum over all directions is found by a scan and refinement of its best points, so
//! several minima and flat stretches do no harm and equal input gives equal output. Where every
//! state of a neighbourhood is elliptic, [`is_elliptic_by_bound`] says so from the eigenvalues of
//! `c` alone: `m·Q·m ≥ ½ λ_min(c) + σ_min` for unit `m`, `n` if `λ_min > 0`, since `½ ≤ |sym(m⊗n)|² ≤ 1`.

use fissure_tensor::{Matrix3, Sym, Tangent, Vector3};

use crate::{
    Increment, Material, MaterialError,
    criteria::{Domain, maximise},
};

/// Grid steps to the quarter turn: 1° in the plane, 5° in space.
const PARTS: (u32, u32) = (90, 18);

/// Which normals and polarisations are considered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Directions {
    /// Those across z: plane strain, or plane stress with the condensed tangent.
    Plane,
    /// All of space.
    Space,
}

/// The direction in which the acoustic tensor comes nearest to singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Localization {
    /// `det Q(n)` over the largest entry of `c` to the power of the dimension; ≤ 0 where
    /// ellipticity is lost.
    pub determinant: f64,
    /// Unit normal `n` of the plane.
    pub normal: Vector3<f64>,
    /// Unit direction `m` of the jump: along `n` a crack opens, across it a band shears.
    pub polarization: Vector3<f64>,
}

impl Localization {
    /// Whether ellipticity is lost, to `tolerance` (dimensionless).
    pub fn is_lost(&self, tolerance: f64) -> bool {
        self.determinant <= tolerance
    }
}

/// The least determinant of the acoustic tensor over directions.
///
/// `tangent` is the spatial one of [`Material::tangent`], `stress` the Cauchy stress, both Pa.
pub fn localization(tangent: &Tangent, stress: &Sym, directions: Directions) -> Localization {
    let size = tangent.max_abs();
    let scaled = Tangent(tangent.0 / size);
    let stress = *stress / size;
    let determinant = |normal: &Vector3<f64>| {
        let acoustic = acoustic(&scaled, &stress, normal);
        match directions {
            Directions::Plane => acoustic.m11 * acoustic.m22 - acoustic.m12 * acoustic.m21,
            Directions::Space => acoustic.determinant(),
        }
    };
    let (domain, parts) = match directions {
        Directions::Plane => (Domain::Plane, PARTS.0),
        Directions::Space => (Domain::HalfSphere, PARTS.1),
    };
    let (least, normal) = maximise(|n| -determinant(n), domain, parts);
    let mut matrix = acoustic(&scaled, &stress, &normal);
    if directions == Directions::Plane {
        // Out-of-plane motion is not among the candidates.
        matrix.set_row(2, &Vector3::zeros().transpose());
        matrix.set_column(2, &Vector3::new(0.0, 0.0, 1e3));
    }
    let squared = Sym::from_matrix(&(matrix.transpose() * matrix));
    Localization {
        determinant: -least,
        normal,
        polarization: squared.spectrum().vectors[2],
    }
}

/// [`localization`] at the end of an increment of a law.
///
/// # Errors
/// As [`Material::update`].
pub fn localization_of<M: Material>(
    law: &M,
    increment: &Increment,
    old: &M::State,
    directions: Directions,
) -> Result<Localization, MaterialError> {
    let (response, tangent) = law.update_with_tangent(increment, old)?;
    Ok(localization(&tangent, &response.stress, directions))
}

/// Whether a bound from eigenvalues rules loss of ellipticity out, in any direction; `false` says
/// nothing.
pub fn is_elliptic_by_bound(tangent: &Tangent, stress: &Sym) -> bool {
    let least = tangent.symmetric_part().0.symmetric_eigenvalues().min();
    let share = if least > 0.0 { 0.5 } else { 1.0 };
    share * least + stress.eigenvalues()[2] > 0.0
}

/// `Q(n) = n·c·n + (n·σ·n) 1`.
fn acoustic(tangent: &Tangent, stress: &Sym, normal: &Vector3<f64>) -> Matrix3<f64> {
    tangent.acoustic_tensor(normal) + Matrix3::identity() * stress.normal_component(normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Band, Decohesive, Isotropic, Normal, contract::Random, softening::Linear};

    const ELASTIC: Isotropic = Isotropic {
        density: 2350.0,
        young: 24.9e9,
        poisson: 0.18,
    };

    /// Elastoplastic tangent of associated flow along `P` (unit) and the hardening modulus.
    fn plastic(p: &Sym, hardening: f64) -> Tangent {
        let direction = ELASTIC.stress(p);
        let factor = p.dot(&direction) + hardening;
        ELASTIC.stiffness() - Tangent::dyad(&direction, &direction) * (1.0 / factor)
    }

    /// Least angle between a normal and ± the plane `n = (cos, 0, sin)` or its mirror image, in
    /// principal axes 1, 3, degrees.
    fn angle_off(found: &Vector3<f64>, cosine_squared: f64, axes: &Matrix3<f64>) -> f64 {
        let (c, s) = (
            cosine_squared.sqrt(),
            (1.0 - cosine_squared).max(0.0).sqrt(),
        );
        let planes = [Vector3::new(c, 0.0, s), Vector3::new(c, 0.0, -s)];
        let dots = planes.map(|n| (axes * n).dot(found).abs());
        dots[0].max(dots[1]).min(1.0).acos().to_degrees()
    }

    /// P21. For associated flow along `P`, principal values `P1 ≥ P2 ≥ P3`, the critical plane has
    /// `n1² = (P1 + ν P2)/(P1 − P3)` (in 0 to 1), at the largest hardening modulus for which some
    /// plane is singular, found here by bisection [Ottosen and Runesson 1991, Int. J. Solids Struct. 27, 401].
    #[test]
    fn localization_angles_are_the_analytic_ones() {
        let mut random = Random::new(21);
        let nu = ELASTIC.poisson;
        let directions = [
            Sym::diagonal(1.0, 0.0, 0.0),                     // Rankine
            Sym::diagonal(1.0, 0.0, -1.0) / 2.0_f64.sqrt(),   // Tresca, and J2 in pure shear
            Sym::diagonal(2.0, -1.0, -1.0) / 6.0_f64.sqrt(),  // J2 in uniaxial tension
            Sym::diagonal(3.0, -0.5, -2.5) / 15.5_f64.sqrt(), // J2 between
            Sym::diagonal(1.0, 0.2, -0.1) / 1.05_f64.sqrt(),  // a dilatant law
        ];
        for p in directions {
            let [p1, p2, p3] = [p.xx(), p.yy(), p.zz()];
            let expected = ((p1 + nu * p2) / (p1 - p3)).clamp(0.0, 1.0);
            let axes = random.rotation();
            // Critical hardening: the largest for which some plane is singular.
            let (mut low, mut high) = (-0.9 * p.dot(&ELASTIC.stress(&p)), ELASTIC.young);
            let lost = |h: f64| {
                let tangent = plastic(&p, h).rotated(&axes);
                localization(&tangent, &Sym::ZERO, Directions::Space)
            };
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                if lost(middle).is_lost(0.0) {
                    low = middle
                } else {
                    high = middle
                }
            }
            let found = lost(0.5 * (low + high));
            let off = angle_off(&found.normal, expected, &axes);
            // Uniaxial J2: a cone of planes about the axis, judged by the angle to it.
            let cone = (p2 - p3).abs() < 1e-12;
            let along = (axes * Vector3::x()).dot(&found.normal).abs();
            let off = if cone {
                (along.acos() - expected.sqrt().acos()).abs().to_degrees()
            } else {
                off
            };
            assert!(off < 0.5, "{p:?}: {off}° from the analytic plane");
        }
    }

    #[test]
    fn in_the_plane_tresca_shears_and_rankine_opens() {
        let root = 2.0_f64.sqrt();
        let tresca = plastic(&(Sym::diagonal(1.0, -1.0, 0.0) / root), 0.0);
        let found = localization(&tresca, &Sym::ZERO, Directions::Plane);
        assert!((found.normal.x.abs() - 1.0 / root).abs() < 1e-6);
        assert!(found.determinant.abs() < 1e-12);
        assert!(found.polarization.dot(&found.normal).abs() < 1e-6);
        let rankine = plastic(&Sym::diagonal(0.0, 1.0, 0.0), 0.0);
        let found = localization(&rankine, &Sym::ZERO, Directions::Plane);
        assert!(found.normal.y.abs() > 1.0 - 1e-12 && found.polarization.y.abs() > 1.0 - 1e-12);
        assert_eq!(found, localization(&rankine, &Sym::ZERO, Directions::Plane));
    }

    #[test]
    fn a_law_loses_ellipticity_across_its_crack_and_not_before() -> Result<(), MaterialError> {
        let law = Decohesive {
            elastic: ELASTIC,
            strength: 2.7e6,
            toughness: 61.35,
            softening: Linear,
            normal: Normal::Rankine,
        };
        let to = |strain: f64| {
            let mut f = Matrix3::identity();
            f.m22 += strain;
            Increment {
                band: Band::cube(0.01),
                ..Increment::to(f)
            }
        };
        let sound = to(5e-5);
        assert!(
            localization_of(&law, &sound, &law.initial(), Directions::Space)?.determinant > 0.0
        );
        let (response, tangent) = law.update_with_tangent(&sound, &law.initial())?;
        assert!(is_elliptic_by_bound(&tangent, &response.stress));
        let (cracked, further) = (to(1e-3), to(1.1e-3));
        let state = law.update(&cracked, &law.initial())?.state;
        let (response, tangent) = law.update_with_tangent(&further, &state)?;
        assert!(!is_elliptic_by_bound(&tangent, &response.stress));
        for directions in [Directions::Plane, Directions::Space] {
            let found = localization_of(&law, &further, &state, directions)?;
            assert!(
                found.is_lost(0.0) && found.normal.y.abs() > 1.0 - 1e-6,
                "{found:?}"
            );
        }
        Ok(())
    }

    /// The bound never calls a state elliptic that the search calls lost.
    #[test]
    fn the_bound_is_one() {
        let mut random = Random::new(22);
        for _ in 0..200 {
            let p = random.strain_direction(false);
            let tangent = plastic(&p, random.uniform(-0.2, 0.5) * ELASTIC.young);
            let stress = random.strain_direction(false) * random.log_uniform(1e5, 1e10);
            if is_elliptic_by_bound(&tangent, &stress) {
                let found = localization(&tangent, &stress, Directions::Space);
                assert!(found.determinant > 0.0);
            }
        }
    }
}
