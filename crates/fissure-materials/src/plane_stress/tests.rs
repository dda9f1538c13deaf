use super::*;
use crate::contract::Random;
use crate::multi_crack::{ModeOne, MultiCrack, Planes, Shear, Unloading};
use crate::softening::Linear;
use crate::{Axis, Decohesive, Hencky, Isotropic, NeoHookean, Normal, Path, Point, PointError};

const ELASTIC: Isotropic = Isotropic {
    density: 2400.0,
    young: 30e9,
    poisson: 0.2,
};

fn cohesive() -> Decohesive {
    Decohesive {
        elastic: ELASTIC,
        strength: 3e6,
        toughness: 60.0,
        softening: Linear,
        normal: Normal::Rankine,
    }
}

fn in_plane(xx: f64, xy: f64, yx: f64, yy: f64) -> Matrix3<f64> {
    Matrix3::new(1.0 + xx, xy, 0.0, yx, 1.0 + yy, 0.0, 0.0, 0.0, 1.0)
}

#[test]
fn small_strain_moduli_are_those_of_plane_stress() -> Result<(), MaterialError> {
    let law = PlaneStress(ELASTIC);
    let rest = Increment::to(Matrix3::identity());
    let c = law.tangent(&rest, &law.initial())?.0;
    let modulus = ELASTIC.young / (1.0 - ELASTIC.poisson * ELASTIC.poisson);
    assert!((c[(0, 0)] / modulus - 1.0).abs() < 1e-15);
    assert!((c[(0, 1)] / (ELASTIC.poisson * modulus) - 1.0).abs() < 1e-14);
    assert!((c[(5, 5)] / (2.0 * ELASTIC.shear_modulus()) - 1.0).abs() < 1e-15);
    for strain in [1e-9, 1e-6, 1e-3, 0.1] {
        let response = law.update(
            &Increment::to(in_plane(strain, 0.0, 0.0, 0.0)),
            &law.initial(),
        )?;
        let round_off = 2.0 * f64::EPSILON * ELASTIC.p_wave_modulus();
        assert!((response.stress.xx() - modulus * strain).abs() <= round_off);
        assert!((response.stress.yy() - ELASTIC.poisson * modulus * strain).abs() <= round_off);
        let thinning = -ELASTIC.poisson / (1.0 - ELASTIC.poisson) * strain;
        assert!((response.state.thickening - thinning).abs() <= 4.0 * f64::EPSILON);
    }
    Ok(())
}

#[test]
fn finite_strain_stretch_and_tangent() -> Result<(), MaterialError> {
    let rubber = PlaneStress(NeoHookean {
        density: 1100.0,
        young: 2e6,
        poisson: 0.45,
    });
    let metal = PlaneStress(Hencky { elastic: ELASTIC });
    for f in [
        in_plane(0.5, 0.2, -0.1, -0.2),
        in_plane(4.0, 0.0, 0.0, 3.0),
        in_plane(-0.7, 0.3, 0.0, -0.6),
    ] {
        let increment = Increment::to(f);
        check_step(&rubber, &increment, 1e-7)?;
        check_step(&metal, &increment, 1e-7)?;
        // Hencky in closed form: ln F₃₃ = −ν/(1 − ν) ln(area stretch).
        let stretch = metal.update(&increment, &metal.initial())?.state.thickening;
        let exact = (-0.25 * (f.m11 * f.m22 - f.m12 * f.m21).ln()).exp_m1();
        assert!((stretch - exact).abs() < 1e-14 * (1.0 + exact));
    }
    Ok(())
}

/// The stretch leaves no stress, a zero increment moves nothing, the tangent fits differences.
fn check_step<M: Material>(
    law: &PlaneStress<M>,
    increment: &Increment,
    tolerance: f64,
) -> Result<(), MaterialError> {
    let old = law.initial();
    let response = law.update(increment, &old)?;
    let again = Increment {
        f_old: increment.f_new,
        ..*increment
    };
    let second = law.update(&again, &response.state)?;
    assert_eq!(
        (second.state, second.stress),
        (response.state, response.stress)
    );
    let f = with_thickness(&increment.f_new, response.state.thickening);
    let inner = law.0.update(&increment.with_end(f), &old.inner)?;
    assert!(
        inner.stress.zz().abs() < 1e-14 * (law.modulus(&Scale::default()) + inner.stress.max_abs())
    );
    let tangent = law.tangent(increment, &old)?;
    let gap =
        (tangent - crate::material::difference_tangent(law, increment, &old, 1e-6)?).max_abs();
    // Their terms are as large as the stress, which at large strain is above the tangent.
    let size = tangent.max_abs() + response.stress.max_abs();
    assert!(gap <= tolerance * size, "off by {gap:e} of {size:e}");
    Ok(())
}

#[test]
fn a_crack_softens_and_closes() -> Result<(), PointError> {
    let law = PlaneStress(cohesive());
    let width = 0.01;
    for steps in [1, 7, 1000] {
        let path = Path::new(Band::cube(width))
            .uniaxial(Axis::X, 2e-3, steps)
            .back(1e-3, steps)
            .back(8e-3, steps)
            .back(-1e-4, steps);
        let samples = Point::new(&law)?.drive(&path)?;
        let last = samples.last().unwrap();
        assert!(last.state.inner.failed);
        assert!((last.dissipated * width / 60.0 - 1.0).abs() < 1e-10);
        // Shut: the undamaged response.
        assert!((last.stress.xx() / (-1e-4 * ELASTIC.young) - 1.0).abs() < 1e-3);
        assert!(samples.iter().all(|s| s.stress.zz() == 0.0));
        assert!(samples.iter().all(|s| s.stress.yy().abs() < 1e-3));
    }
    Ok(())
}

#[test]
fn cracked_steps_have_the_right_tangent() -> Result<(), MaterialError> {
    let law = PlaneStress(cohesive());
    for f in [
        in_plane(1e-3, 2e-4, 0.0, 1e-4),
        in_plane(1e-2, 2e-4, 3e-4, -1e-4),
    ] {
        let mut increment = Increment::to(f);
        increment.band = Band::cube(0.01);
        check_step(&law, &increment, 1e-5)?;
    }
    Ok(())
}

#[test]
fn the_band_limit_is_that_of_plane_stress() {
    let law = PlaneStress(cohesive());
    let scale = Scale::default();
    let nu = ELASTIC.poisson;
    let limit = cohesive().band_limit(&scale) * (1.0 - 2.0 * nu) / ((1.0 - nu) * (1.0 - nu));
    assert!((law.band_limit(&scale) / limit - 1.0).abs() < 1e-14);
    assert!(law.check_band(&Band::cube(0.999 * limit), &scale).is_ok());
    let refused = law.check_band(&Band::cube(1.001 * limit), &scale);
    assert!(
        matches!(refused, Err(MaterialError::Band { width, .. }) if (width / limit - 1.001).abs() < 1e-12)
    );
}

#[test]
fn a_large_reversal_cracks_in_the_plane() -> Result<(), MaterialError> {
    let law = PlaneStress(cohesive());
    // Swollen by compression, then pulled: at the old stretch the thickness would crack.
    let (pressed, pulled) = (
        in_plane(-5e-3, 0.0, 0.0, -5e-3),
        in_plane(3e-4, 0.0, 0.0, 1e-4),
    );
    let mut increment = Increment::to(pressed);
    increment.band = Band::cube(0.5 * law.band_limit(&Scale::default()));
    let old = law.update(&increment, &law.initial())?.state;
    let step = Increment {
        f_old: pressed,
        f_new: pulled,
        ..increment
    };
    let state = law.update(&step, &old)?.state;
    assert_eq!(state.inner.normal, [1.0, 0.0, 0.0]);
    assert!(state.inner.opening > 0.0 && state.thickening < 0.0);
    // A path without the detour ends at the same point.
    let direct = law
        .update(&increment.with_end(pulled), &law.initial())?
        .state;
    assert!((direct.thickening - state.thickening).abs() < 1e-15);
    Ok(())
}

/// Steps of a law along a random walk in the plane, in closed form and by the search for the thickness.
fn check_closed_form<M: Material>(law: M, size: f64) -> Result<usize, MaterialError> {
    let law = PlaneStress(law);
    let modulus = law.modulus(&Scale::default());
    let mut random = Random::new(11).in_plane(true);
    let mut histories = 0;
    for _ in 0..40 {
        let mut old = law.initial();
        let mut increment = Increment::to(Matrix3::identity());
        increment.band = Band::Uniform(2e-3);
        for _ in 0..12 {
            let turn = Matrix3::identity() + random.strain_direction(true).to_matrix() * size;
            increment.f_new = random.rotation() * turn;
            let step = law.0.plane_stress(&increment, &old.inner, false)?;
            let Some(step) = step else {
                panic!("no closed form")
            };
            let closed = PlaneStress::<M>::response(&step.response, step.thickening);
            let solved = law.solve(&increment, &old)?;
            let found = PlaneStress::<M>::response(&solved.response, solved.thickening);
            let gap = (closed.stress - found.stress).max_abs();
            assert!(gap <= 1e-11 * modulus, "{gap:e} of {modulus:e}");
            assert!((step.thickening - solved.thickening).abs() <= 1e-11);
            assert!((closed.stored - found.stored).abs() <= 1e-11 * modulus * size);
            histories += usize::from(law.has_history(&closed.state));
            (old, increment.f_old) = (closed.state, increment.f_new);
        }
    }
    Ok(histories)
}

#[test]
fn the_closed_forms_are_what_the_search_finds() -> Result<(), MaterialError> {
    let rubber = NeoHookean {
        density: 1100.0,
        young: 2e6,
        poisson: 0.45,
    };
    check_closed_form(ELASTIC, 0.1)?;
    check_closed_form(Hencky { elastic: ELASTIC }, 0.3)?;
    check_closed_form(rubber, 0.3)?;
    assert!(check_closed_form(cohesive(), 3e-4)? > 200);
    // Of two planes that start in one large step the second may lean another way, since the search
    // sees the first one at the thickness of both: one plane.
    let law: MultiCrack<1, ModeOne> = MultiCrack {
        elastic: ELASTIC,
        decohesion: ModeOne {
            strength: 3e6,
            toughness: 60.0,
            softening: Linear,
            unloading: Unloading::Secant,
            shear: Shear::Coulomb(0.3),
        },
        planes: Planes::Fixed,
    };
    assert!(check_closed_form(law, 3e-4)? > 200);
    Ok(())
}

/// A law that widens when it is pulled has no closed form: `T_zz` could be the largest stress.
#[test]
fn a_negative_poisson_ratio_is_searched_for() -> Result<(), MaterialError> {
    let mut law = cohesive();
    law.elastic.poisson = -0.2;
    let step = Increment::to(in_plane(-1e-3, 0.0, 0.0, -1e-3));
    assert!(law.plane_stress(&step, &law.initial(), false)?.is_none());
    let law = PlaneStress(law);
    let state = law.update(&step, &law.initial())?.state;
    assert!(state.inner.width == 0.0 && state.thickening < 0.0);
    Ok(())
}

/// A sheet is refused as too thin only where the solid is pulled across at every thickness: the stress is linear in
/// the strain, and no stretch is left for Poisson's contraction.
fn refused_where_none_exists<M: Material>(law: M) -> Result<usize, MaterialError> {
    let sheet = PlaneStress(law);
    let mut random = Random::new(33).in_plane(true);
    let mut refused = 0;
    for _ in 0..400 {
        // A crack across x, failed.
        let pull = Increment {
            band: Band::Uniform(0.01),
            ..Increment::to(in_plane(0.3, 0.0, 0.0, 0.0))
        };
        let old = sheet.update(&pull, &sheet.initial())?.state;
        let strain = random.strain_direction(true) * random.log_uniform(0.1, 20.0);
        let (xx, yy, xy) = (strain.xx().abs(), strain.yy().abs(), strain.xy());
        let step = pull.with_end(in_plane(xx, xy, xy, yy));
        if step.jacobian() <= 0.0 {
            continue;
        }
        match sheet.update(&step, &old) {
            Ok(_) => {}
            Err(MaterialError::Deformation { determinant }) if determinant <= 0.0 => {
                refused += 1;
                for thickness in [1e-6, 1e-3, 0.1, 0.3, 0.6, 1.0] {
                    let end = step.with_end(with_thickness(&step.f_new, thickness - 1.0));
                    let across = sheet.0.update(&end, &old.inner)?.stress.zz();
                    assert!(across > 0.0, "{across:e} at {thickness}, {end:?}");
                }
            }
            Err(other) => return Err(other),
        }
    }
    Ok(refused)
}

#[test]
fn a_sheet_is_too_thin_only_where_no_thickness_is_left() -> Result<(), MaterialError> {
    let mode = |strength| crate::Mode {
        strength,
        toughness: 60.0,
        softening: Linear,
    };
    let damage = crate::AnisotropicDamage::new(ELASTIC, mode(3e6), mode(2e6));
    let counts = [
        refused_where_none_exists(cohesive())?,
        refused_where_none_exists(damage)?,
    ];
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
    Ok(())
}
