//! Isotropic laws on Biot's strain before any crack, at small strain, without a polar decomposition.
//!
//! For an isotropic law the stress can be taken on the left stretch `V = (F·Fᵀ)^(1/2)`: with
//! `E = V − 1` the stress `T = λ tr(E) 1 + 2μ E` has the principal values of the stress on the
//! right stretch, and Cauchy's stress follows from it and `E` ([`StressMeasure::cauchy_on_left`]).
//!
//! Most particles of a run are sound and far from their strength: this is what they cost.

use fissure_tensor::{Matrix3, Sym};

use crate::finite_strain::LeftStrain;
use crate::stress_measure::StressMeasure;
use crate::{Biot, EIGHT, EightPoints, EightResponses, Isotropic, Response};

/// The response of an uncracked point if the strain is small and `accepts` rules a crack out for
/// its stress, of which it may use the invariants only; else `None`, and the caller has to look
/// closer.
#[inline(always)]
pub(crate) fn sound<Measure: StressMeasure, State: Default>(
    elastic: &Isotropic,
    f: &Matrix3<f64>,
    accepts: impl Fn(&Sym) -> bool,
) -> Option<Response<State>> {
    let (strain, dilation) = LeftStrain::small(f)?;
    let stress = elastic.stress(&strain);
    accepts(&stress).then(|| Response {
        stress: Measure::cauchy_on_left(&stress, &strain, dilation),
        state: State::default(),
        stored: 0.5 * stress.dot(&strain),
        dissipated: 0.0,
    })
}

/// [`sound`] of eight points, to the last bit, with wave speeds; `None` if that closer look is needed at one of them.
#[inline(always)]
pub(crate) fn sound_eight<Measure: StressMeasure>(
    elastic: &Isotropic,
    points: &EightPoints,
    accepts: impl Fn(usize, &Sym) -> bool,
) -> Option<EightResponses> {
    let (strains, dilations) = LeftStrain::small_eight(points)?;
    let mut all_sound = true;
    let mut responses = EightResponses::default();
    for place in 0..EIGHT {
        let elastic = Isotropic {
            young: elastic.young * points.stiffness[place],
            ..*elastic
        };
        let strain = &strains[place];
        let stress = elastic.stress(strain);
        all_sound &= accepts(place, &stress);
        let cauchy = Measure::cauchy_on_left(&stress, strain, dilations[place]);
        let stretch = Biot::longest_stretch_of_rows(points.gradient(place));
        let speed = Measure::wave_speed(elastic.p_wave_speed(), stretch);
        responses.set(place, &cauchy, 0.5 * stress.dot(strain), speed);
    }
    all_sound.then_some(responses)
}

/// Whether no direction carries a normal traction of `strength`: `σ₁ ≤ mean + 2√(J₂/3)`, with a
/// margin for round-off, since the exact test decides at the surface.
#[inline(always)]
pub(crate) fn below(strength: f64, stress: &Sym) -> bool {
    let reach = strength * (1.0 - 1e-9) - stress.mean();
    (reach > 0.0) & (4.0 * stress.j2() < 3.0 * reach * reach)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MaterialError;
    use crate::contract::Random;
    use crate::stress_measure::{Conjugate, Turned};
    use fissure_tensor::rotation;

    const CONCRETE: Isotropic = Isotropic {
        density: 2350.0,
        young: 24.9e9,
        poisson: 0.18,
    };

    #[test]
    fn agrees_with_the_polar_decomposition_to_round_off() -> Result<(), MaterialError> {
        let mut random = Random::new(5);
        let mut used = 0;
        for _ in 0..2000 {
            let turn = random.turn() * random.log_uniform(1e-6, 1.0);
            // Rotations beyond the small ones leave b − 1 a difference of numbers near one.
            let size = random.log_uniform(1e-9, 1e-3);
            let strain = random.strain_direction(true) * size;
            let f = rotation(&turn, turn.norm()) * (Matrix3::identity() + strain.to_matrix());
            let Some(quick) = sound::<Conjugate, ()>(&CONCRETE, &f, |_| true) else {
                continue;
            };
            used += 1;
            let kinematics = Biot::new(&f)?;
            let stress = CONCRETE.stress(&kinematics.strain());
            let gap = (quick.stress - kinematics.cauchy(&stress)).max_abs();
            assert!(gap < 4e-15 * CONCRETE.young, "{gap:e} at {size:e}");
            let turned = sound::<Turned, ()>(&CONCRETE, &f, |_| true).map(|quick| quick.stress);
            let gap = (turned.unwrap_or(Sym::ZERO) - kinematics.turned(&stress)).max_abs();
            assert!(gap < 4e-15 * CONCRETE.young, "{gap:e} at {size:e}");
            let stored = 0.5 * stress.dot(&kinematics.strain());
            assert!((quick.stored - stored).abs() < 4e-15 * CONCRETE.young * (size + 1e-15));
        }
        assert!(used > 1500, "{used}");
        Ok(())
    }

    #[test]
    fn no_state_at_the_surface_is_called_sound() {
        let mut random = Random::new(6);
        for _ in 0..2000 {
            let direction = random.strain_direction(true);
            let largest = CONCRETE.stress(&direction).spectrum().values[0];
            if largest <= 0.0 {
                continue;
            }
            let strain = direction * (2.7e6 / largest);
            let f = Matrix3::identity() + strain.to_matrix();
            assert!(sound::<Turned, ()>(&CONCRETE, &f, |s| below(2.7e6, s)).is_none());
        }
    }
}
