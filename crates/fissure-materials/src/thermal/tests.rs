use fissure_tensor::rotation;

use super::*;
use crate::contract;
use crate::hardening::Voce;
use crate::testing::{assert_wave_speed, gradients, tangent_error};
use crate::{Decohesive, Hencky, Isotropic, J2, Normal, Orthotropic, PlaneStress};

const STEEL: Isotropic = Isotropic {
    density: 7800.0,
    young: 210e9,
    poisson: 0.3,
};
const CONCRETE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

fn decohesive() -> Decohesive {
    Decohesive {
        elastic: CONCRETE,
        strength: 2.7e6,
        toughness: 61.35,
        softening: Default::default(),
        normal: Normal::Rankine,
    }
}

fn j2() -> J2<Voce> {
    J2 {
        elastic: STEEL,
        hardening: Voce {
            yield_stress: 300e6,
            saturation: 150e6,
            rate: 16.0,
            modulus: 0.2e9,
        },
    }
}

fn timber() -> Orthotropic {
    Orthotropic {
        density: 450.0,
        young: [11.6e9, 0.9e9, 0.5e9],
        poisson_12: 0.37,
        poisson_13: 0.42,
        poisson_23: 0.47,
        shear_12: 0.75e9,
        shear_13: 0.72e9,
        shear_23: 0.039e9,
        axes: rotation(&Vector3::new(0.2, -0.5, 1.0), 0.7),
    }
}

fn across_the_grain() -> Expansion {
    Expansion::Orthotropic {
        coefficients: [4e-6, 30e-6, 45e-6],
        axes: timber().axes,
    }
}

/// A law at a temperature, seen from its own free expansion: what `F` the battery gives is taken
/// from there, so that rest is rest and every property applies.
#[derive(Debug)]
struct Warm<M> {
    law: Thermal<M>,
    temperature: f64,
    free: Matrix3<f64>,
}

impl<M: Material> Warm<M> {
    fn new(law: M, expansion: Expansion, temperature: f64) -> Self {
        let stretch = expansion.stretch(temperature).expect("a sound temperature");
        let free = stretch.taken_off(&Matrix3::identity());
        let free = free.try_inverse().expect("not singular");
        let law = Thermal { law, expansion };
        Self {
            law,
            temperature,
            free,
        }
    }

    fn there(&self, increment: &Increment) -> Result<Increment, MaterialError> {
        check_deformation(increment)?;
        let mut there = Increment {
            f_old: increment.f_old * self.free,
            f_new: increment.f_new * self.free,
            ..*increment
        };
        there.external.temperature = self.temperature;
        Ok(there)
    }
}

impl<M: Material> Material for Warm<M> {
    type State = ThermalState<M::State>;
    const OBJECTIVE: bool = M::OBJECTIVE;
    const HYPERELASTIC: bool = M::HYPERELASTIC;
    const STEP_ERROR: f64 = M::STEP_ERROR;
    fn check(&self) -> Result<(), MaterialError> {
        self.law.check()
    }
    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.law.check_band(band, scale)
    }
    fn isotropic(&self) -> bool {
        self.law.isotropic()
    }
    fn density(&self) -> f64 {
        self.law.density() / self.free.determinant()
    }
    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64 {
        self.law.wave_speed(&(f * self.free), state, scale)
    }
    fn initial(&self) -> Self::State {
        ThermalState {
            temperature: self.temperature,
            ..self.law.initial()
        }
    }
    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        let mut response = self.law.update(&self.there(increment)?, old)?;
        // Per volume of the configuration that the battery takes for undeformed.
        response.stored /= self.free.determinant();
        response.dissipated /= self.free.determinant();
        Ok(response)
    }
    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        self.law.tangent(&self.there(increment)?, old)
    }
}

fn passes(law: &impl Material) {
    let message = contract::check(law).err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

/// P1-P3, P6, P9-P12, P19, P20, P22, P24 at rest and hot, around laws with and without history.
#[test]
fn warm_laws_pass_the_battery() {
    let uniform = Expansion::Isotropic(12e-6);
    passes(&Thermal {
        law: Hencky { elastic: STEEL },
        expansion: uniform,
    });
    passes(&Warm::new(Hencky { elastic: STEEL }, uniform, 400.0));
    passes(&Warm::new(j2(), uniform, 400.0));
    passes(&Warm::new(decohesive(), uniform, -30.0));
    passes(&Warm::new(timber(), across_the_grain(), 60.0));
}

/// P4, P5, P7, P8, P13-P18 as well.
#[test]
fn a_cracking_law_keeps_its_properties() {
    let law = Thermal {
        law: decohesive(),
        expansion: Expansion::Isotropic(10e-6),
    };
    let message = contract::check_cracking(&law).err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

/// A free expansion, turned or not, is free of stress and energy, whatever the law.
#[test]
fn free_expansion_is_free_of_stress() -> Result<(), MaterialError> {
    fn largest<M: Material>(law: M, expansion: Expansion) -> Result<f64, MaterialError> {
        let warm = Warm::new(law, expansion, 250.0);
        let turn = rotation(&Vector3::new(0.3, 1.0, -0.2), 1.1);
        let mut largest: f64 = 0.0;
        for f in [Matrix3::identity(), turn] {
            let response = warm.update(&Increment::to(f), &warm.law.initial())?;
            assert_eq!(response.state.inner, warm.law.law.initial());
            largest = largest.max(response.stress.max_abs());
        }
        println!("stress of a free expansion by 250 K: {largest:.1e} Pa");
        Ok(largest)
    }
    let uniform = Expansion::Isotropic(12e-6);
    let round_off = 1e-14 * STEEL.young;
    assert!(largest(Hencky { elastic: STEEL }, uniform)? <= round_off);
    assert!(largest(j2(), uniform)? <= round_off);
    assert!(largest(decohesive(), uniform)? <= round_off);
    assert!(largest(timber(), across_the_grain())? <= round_off);
    Ok(())
}

/// Held on all sides the pressure is `3K ln(1 + α ΔT)/J` for Hencky's law, `E α ΔT/(1 − 2ν)` to
/// first order; held along one axis the stress is `−E α ΔT`.
#[test]
fn held_bodies_have_the_stress_of_the_books() -> Result<(), MaterialError> {
    let (coefficient, temperature) = (12e-6, 150.0);
    let law = Thermal {
        law: Hencky { elastic: STEEL },
        expansion: Expansion::Isotropic(coefficient),
    };
    let mut held = Increment::to(Matrix3::identity());
    held.external.temperature = temperature;
    let response = law.update(&held, &law.initial())?;
    let log = -(coefficient * temperature).ln_1p();
    let jacobian_inside = (3.0 * log).exp();
    let exact = 3.0 * STEEL.bulk_modulus() * log / jacobian_inside;
    assert!((response.stress.xx() / exact - 1.0).abs() < 1e-11);
    let book = -STEEL.young * coefficient * temperature / (1.0 - 2.0 * STEEL.poisson);
    assert!((response.stress.xx() / book - 1.0).abs() < 5e-3);
    // Free energy of the held body per undeformed volume: 9/2 K ln² J_θ.
    let stored = 4.5 * STEEL.bulk_modulus() * log * log / jacobian_inside;
    assert!((response.stored / stored - 1.0).abs() < 1e-11);

    let small = Thermal {
        law: STEEL,
        expansion: Expansion::Isotropic(coefficient),
    };
    let lateral = 1.0 + (1.0 + STEEL.poisson) * coefficient * temperature;
    let bar = Matrix3::from_diagonal(&Vector3::new(1.0, lateral, lateral));
    let stress = small.update(&held.with_end(bar), &small.initial())?.stress;
    let book = -STEEL.young * coefficient * temperature;
    assert!((stress.xx() / book - 1.0).abs() < 5e-3);
    assert!(stress.yy().abs() < 5e-3 * book.abs());
    Ok(())
}

/// Cooling a held body cracks it, at `α |ΔT| = τ/(E/(1 − 2ν))` where it is held on all sides, and
/// dissipates the toughness over the band once it is broken.
#[test]
fn cooling_a_held_body_cracks_it() -> Result<(), MaterialError> {
    let inside = decohesive();
    let width = 5e-3;
    let law = Thermal {
        law: Decohesive {
            normal: Normal::Prescribed(Vector3::x()),
            ..inside
        },
        expansion: Expansion::Orthotropic {
            coefficients: [1e-3, 0.0, 0.0],
            axes: Matrix3::identity(),
        },
    };
    let mut state = law.initial();
    let (mut dissipated, mut started) = (0.0, None);
    for step in 1..=4000 {
        let temperature = -6e-3 * f64::from(step);
        let mut cooled = Increment {
            band: Band::Uniform(width),
            ..Increment::to(Matrix3::identity())
        };
        cooled.external.temperature = temperature;
        let response = law.update(&cooled, &state)?;
        state = response.state;
        dissipated += response.dissipated;
        if started.is_none() && !law.cracks(&state).is_empty() {
            started = Some(temperature);
        }
    }
    let expected = -inside.strength / (CONCRETE.p_wave_modulus() * 1e-3);
    let started = started.expect("it cracked");
    assert!((started - expected).abs() <= 6e-3, "{started} {expected}");
    assert!(law.cracks(&state)[0].failed);
    // To the change of volume of the law's reference, 2.4 %.
    let ratio = dissipated * width / inside.toughness;
    println!("energy of the crack over its toughness: {ratio:.4}");
    assert!((ratio - 1.0).abs() < 0.025);
    Ok(())
}

/// Plane stress of a warm law and a warm law in plane stress agree, thickness included.
#[test]
fn plane_stress_works_inside_and_outside() -> Result<(), MaterialError> {
    let expansion = Expansion::Isotropic(12e-6);
    let law = Hencky { elastic: STEEL };
    let inside = Thermal {
        law: PlaneStress(law),
        expansion,
    };
    let outside = PlaneStress(Thermal { law, expansion });
    let mut f = Matrix3::identity();
    (f.m11, f.m12) = (1.002, 0.001);
    let mut increment = Increment::to(f);
    increment.external.temperature = 300.0;
    let one = inside.update(&increment, &inside.initial())?;
    let other = outside.update(&increment, &outside.initial())?;
    let gap = (one.stress - other.stress).max_abs();
    assert!(gap <= 1e-12 * STEEL.young, "{gap:e}");
    let thickness = [
        inside.out_of_plane_stretch(&one.state),
        outside.out_of_plane_stretch(&other.state),
    ]
    .map(Option::unwrap_or_default);
    assert!((thickness[0] - thickness[1]).abs() < 1e-13, "{thickness:?}");
    assert!(thickness[0] > 1.0 + 12e-6 * 300.0 - 0.3 * 2.1e-3);
    Ok(())
}

#[test]
fn tangent_and_wave_speed_hold_when_warm() -> Result<(), MaterialError> {
    let warm = Warm::new(j2(), Expansion::Isotropic(2e-4), 500.0);
    let mut error: f64 = 0.0;
    for f in gradients().iter().skip(1) {
        error = error.max(tangent_error(&warm, &Increment::to(*f), &warm.initial())?);
    }
    println!("largest error of the tangent: {error:.1e}");
    assert!(error <= 1e-8);
    let warm = Warm::new(Hencky { elastic: STEEL }, Expansion::Isotropic(2e-4), 500.0);
    for f in gradients() {
        assert_wave_speed(&warm, &f, &warm.initial(), f64::INFINITY)?;
    }
    Ok(())
}

/// P24.
#[test]
fn what_is_no_expansion_is_refused() -> Result<(), MaterialError> {
    let with = |expansion| Thermal {
        law: STEEL,
        expansion,
    };
    assert!(with(Expansion::Isotropic(f64::NAN)).check().is_err());
    let axes = Matrix3::identity();
    let coefficients = [1e-5, f64::INFINITY, 1e-5];
    let bad = Expansion::Orthotropic { coefficients, axes };
    assert!(with(bad).check().is_err());
    let bad = Expansion::Orthotropic {
        coefficients: [1e-5; 3],
        axes: axes * 2.0,
    };
    assert!(with(bad).check().is_err());
    let law = with(Expansion::Isotropic(1e-5));
    assert_eq!(law.check(), Ok(()));
    for temperature in [-1e5, f64::NAN, f64::INFINITY] {
        let mut increment = Increment::to(Matrix3::identity());
        increment.external.temperature = temperature;
        let refusal = law.update(&increment, &law.initial());
        assert!(matches!(refusal, Err(MaterialError::Parameter { .. })));
        assert!(law.tangent(&increment, &law.initial()).is_err());
    }
    Ok(())
}
