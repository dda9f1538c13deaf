//! Laws for tests.

use fissure::materials::{Hencky, SheetStep};
use fissure::prelude::*;
use fissure::tensor::Matrix3 as Tensor;

/// A soft hyperelastic law: c = 100 m/s, ν = 0.25.
pub fn rubber() -> Hencky {
    Hencky {
        elastic: Isotropic {
            density: 1000.0,
            young: 1e7 / 1.2,
            poisson: 0.25,
        },
    }
}

/// Elastic up to a stretch of `limit` along x, where it refuses to go on.
#[derive(Clone, Copy, Debug)]
pub struct Refusing {
    /// The law below the limit.
    pub inner: Hencky,
    /// Largest F₁₁ − 1.
    pub limit: f64,
}

impl Material for Refusing {
    /// Largest F₁₁ − 1 so far.
    type State = f64;

    const NAMES: &'static [&'static str] = &["largest strain"];

    fn density(&self) -> f64 {
        self.inner.density()
    }

    fn wave_speed(&self, f: &Tensor<f64>, _state: &f64, scale: &Scale) -> f64 {
        self.inner.wave_speed(f, &(), scale)
    }

    fn update(&self, increment: &Increment, old: &f64) -> Result<Response<f64>, MaterialError> {
        let strain = increment.f_new.m11 - 1.0;
        if !(strain <= self.limit) {
            return Err(MaterialError::NoConvergence {
                law: "refusing law",
                iterations: 7,
                residual: strain,
            });
        }
        let inner = self.inner.update(increment, &())?;
        Ok(Response {
            stress: inner.stress,
            state: strain.max(*old),
            stored: inner.stored,
            dissipated: inner.dissipated,
        })
    }

    fn values(&self, state: &f64, out: &mut [f64]) {
        out[0] = *state;
    }
}

/// A law whose states are all kept, whether they have a history or not.
#[derive(Clone, Copy, Debug)]
pub struct Dense<M>(pub M);

impl<M: Material> Material for Dense<M> {
    type State = M::State;
    const NAMES: &'static [&'static str] = M::NAMES;

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.0.check_band(band, scale)
    }

    fn started_width(&self, old: &M::State, new: &M::State) -> f64 {
        self.0.started_width(old, new)
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Tensor<f64>, state: &M::State, scale: &Scale) -> f64 {
        self.0.wave_speed(f, state, scale)
    }

    fn initial(&self) -> M::State {
        self.0.initial()
    }

    fn update(
        &self,
        increment: &Increment,
        old: &M::State,
    ) -> Result<Response<M::State>, MaterialError> {
        self.0.update(increment, old)
    }

    fn tangent(&self, increment: &Increment, old: &M::State) -> Result<Tangent, MaterialError> {
        self.0.tangent(increment, old)
    }

    fn plane_stress(
        &self,
        increment: &Increment,
        old: &M::State,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<M::State>>, MaterialError> {
        self.0.plane_stress(increment, old, with_tangent)
    }

    fn values(&self, state: &M::State, out: &mut [f64]) {
        self.0.values(state, out);
    }
}
