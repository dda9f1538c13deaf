//! Implicit-explicit integration [Oliver et al. 2006, 2008]: the stress is that of internal variables
//! which go on as in the last step; what they really become is found from the strain afterwards.
//!
//! ```text
//! α̃ = α_n + (Δt/Δt_n) (α_n − α_{n−1}),   σ = σ(ε, α̃)                       (1)
//! α_{n+1} = α(ε, α_n)            the law's own update                        (2)
//! ```
//!
//! Within a step α̃ does not depend on the strain, so the tangent is that of unloading: symmetric and positive
//! where the law's stiffness is, whatever softens. A quasi-static step of a law that is linear but for α
//! is one linear system, and none fails. The price is an error of first order in the step,
//! `|σ(ε, α̃) − σ(ε, α_{n+1})|`, which the state keeps and output shows as `implex_gap`: loads overshoot where a crack starts, the more
//! the longer the steps. Energies stored and dissipated are those of (2); the
//! work is that of (1), so the gap is in the ledger's imbalance too.
//!
//! The scheme is explicit in α: where nothing but inertia or an arc length would hold a path (a bar that snaps
//! back), the load is wrong until the jump is over.

use std::fmt::Debug;

use fissure_tensor::{Band, Matrix3, Sym, Tangent};
use serde::{Deserialize, Serialize};

use crate::{Increment, Material, MaterialError, Response, Scale};

/// A law whose internal variables can be frozen in a step.
pub trait Extrapolated: Material {
    /// Its [`NAMES`](Material::NAMES) and `implex_gap`.
    const NAMES_WITH_GAP: &'static [&'static str];

    /// Cauchy stress and tangent at the end of an increment with internal variables that have gone on from `now`
    /// by `ratio` times what they changed by since `before`.
    ///
    /// # Errors
    /// As [`Material::update`].
    fn frozen(
        &self,
        increment: &Increment,
        before: &Self::State,
        now: &Self::State,
        ratio: f64,
    ) -> Result<(Sym, Tangent), MaterialError>;
}

/// The law inside, integrated implicitly-explicitly.
///
/// ```
/// use fissure_materials::{Implex, Isotropic, RankineDamage, ScalarDamage, softening};
///
/// let law = ScalarDamage {
///     elastic: Isotropic { density: 2350.0, young: 24.9e9, poisson: 0.18 },
///     evolution: RankineDamage { strength: 2.7e6, toughness: 61.35, softening: softening::Linear },
/// };
/// let robust = Implex(law);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Implex<M>(pub M);

/// History of a law that is integrated implicitly-explicitly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ImplexState<S> {
    /// History of the law inside.
    pub inner: S,
    /// The same a step before.
    pub before: S,
    /// Length of the last step, s; 0 before the first.
    pub dt: f64,
    /// Norm of the difference between the stress that was used and the law's own, Pa.
    pub gap: f64,
}

impl<M: Extrapolated> Implex<M> {
    fn frozen(
        &self,
        increment: &Increment,
        old: &ImplexState<M::State>,
    ) -> Result<(Sym, Tangent), MaterialError> {
        let ratio = match old.dt > 0.0 {
            true => increment.dt / old.dt,
            false => 0.0,
        };
        self.0.frozen(increment, &old.before, &old.inner, ratio)
    }

    fn response(
        &self,
        increment: &Increment,
        old: &ImplexState<M::State>,
        stress: Sym,
    ) -> Result<Response<ImplexState<M::State>>, MaterialError> {
        let own = self.0.update(increment, &old.inner)?;
        Ok(Response {
            stress,
            state: ImplexState {
                inner: own.state,
                before: old.inner,
                dt: increment.dt,
                gap: (stress - own.stress).norm(),
            },
            stored: own.stored,
            dissipated: own.dissipated,
        })
    }
}

impl<M: Extrapolated> Material for Implex<M> {
    type State = ImplexState<M::State>;
    const OBJECTIVE: bool = M::OBJECTIVE;
    const HYPERELASTIC: bool = false;
    const RATE_DEPENDENT: bool = true;
    const NAMES: &'static [&'static str] = M::NAMES_WITH_GAP;

    fn check(&self) -> Result<(), MaterialError> {
        self.0.check()
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.0.check_band(band, scale)
    }

    fn started_width(&self, old: &Self::State, new: &Self::State) -> f64 {
        self.0.started_width(&old.inner, &new.inner)
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    fn continuous(&self) -> bool {
        self.0.continuous()
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64 {
        self.0.wave_speed(f, &state.inner, scale)
    }

    fn initial(&self) -> Self::State {
        ImplexState {
            inner: self.0.initial(),
            before: self.0.initial(),
            ..ImplexState::default()
        }
    }

    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        let (stress, _) = self.frozen(increment, old)?;
        self.response(increment, old, stress)
    }

    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        Ok(self.frozen(increment, old)?.1)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<(Response<Self::State>, Tangent), MaterialError> {
        let (stress, tangent) = self.frozen(increment, old)?;
        Ok((self.response(increment, old, stress)?, tangent))
    }

    fn values(&self, state: &Self::State, out: &mut [f64]) {
        let (own, gap) = out.split_at_mut(M::NAMES.len());
        self.0.values(&state.inner, own);
        gap[0] = state.gap;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Decohesive, Isotropic, Normal, RankineDamage, ScalarDamage, material::difference_tangent,
        softening,
    };
    use fissure_tensor::Vector3;

    const ELASTIC: Isotropic = Isotropic {
        density: 2350.0,
        young: 24.9e9,
        poisson: 0.18,
    };
    /// Strain at which the laws below have cracked through, in uniaxial strain over 1 cm.
    const FAILED: f64 = 45.44e-6 / 0.01;

    fn damage() -> ScalarDamage {
        ScalarDamage {
            elastic: ELASTIC,
            evolution: RankineDamage {
                strength: 2.7e6,
                toughness: 61.35,
                softening: softening::Linear,
            },
        }
    }

    fn crack() -> Decohesive {
        Decohesive {
            elastic: ELASTIC,
            strength: 2.7e6,
            toughness: 61.35,
            softening: softening::Linear,
            normal: Normal::Prescribed(Vector3::x()),
        }
    }

    fn increment(from: f64, to: f64, dt: f64) -> Increment {
        let f = |strain: f64| Matrix3::from_diagonal(&Vector3::new(1.0 + strain, 1.0, 1.0));
        Increment {
            f_old: f(from),
            f_new: f(to),
            dt,
            band: Band::Uniform(0.01),
            ..Increment::to(Matrix3::identity())
        }
    }

    /// Largest gap, and how far the stress is from the law's own, over the strength, on half of the way to failure.
    fn pulled<M: Extrapolated + Copy>(law: M, steps: usize) -> (f64, f64) {
        let (law, own) = (Implex(law), law);
        let mut state = law.initial();
        let mut own_state = own.initial();
        let (mut gap, mut away) = (0.0_f64, 0.0_f64);
        let mut last = 0.0;
        for step in 1..=steps {
            let strain = 0.5 * FAILED * step as f64 / steps as f64;
            // Steps of two lengths: rates go on, not changes.
            let dt = strain - last;
            let inc = increment(last, strain, dt);
            let (response, tangent) = law.update_with_tangent(&inc, &state).unwrap();
            let expected = own.update(&inc, &own_state).unwrap();
            let smallest = tangent.0.symmetric_eigenvalues().min();
            assert!(smallest > 0.0, "{smallest}");
            let differences = difference_tangent(&law, &inc, &state, 1e-6).unwrap();
            let error = (differences.0 - tangent.0).norm() / tangent.0.norm();
            assert!(error <= 1e-6, "{error}");
            gap = gap.max(response.state.gap / 2.7e6);
            away = away.max((response.stress.xx() - expected.stress.xx()).abs() / 2.7e6);
            // Given the strain the internal variables are exact.
            assert_eq!(response.state.inner, expected.state);
            (state, own_state, last) = (response.state, expected.state, strain);
        }
        (gap, away)
    }

    #[test]
    fn the_gap_is_of_first_order_and_is_the_error() {
        // Far apart: where in a step a crack starts changes its gap by a factor.
        for (coarse, fine) in [
            (pulled(damage(), 200), pulled(damage(), 3200)),
            (pulled(crack(), 200), pulled(crack(), 3200)),
        ] {
            let order = (coarse.0 / fine.0).log2() / 4.0;
            assert!((order - 1.0).abs() <= 0.3, "{coarse:?} {fine:?}");
            for (gap, away) in [coarse, fine] {
                assert!(away <= gap && away > 0.1 * gap, "{away} {gap}");
            }
        }
    }

    #[test]
    fn values_are_those_of_the_law_and_the_gap() {
        let law = Implex(damage());
        let state = law
            .update(&increment(0.0, 1e-3, 1.0), &law.initial())
            .unwrap()
            .state;
        let mut values = [0.0; 3];
        law.values(&state, &mut values);
        assert_eq!(
            Implex::<ScalarDamage>::NAMES,
            ["damage", "largest", "implex_gap"]
        );
        assert_eq!(values, [state.inner.damage, state.inner.largest, state.gap]);
        assert!(state.inner.damage > 0.0 && state.gap > 0.0);
    }
}
