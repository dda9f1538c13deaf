//! What a law around another hands on as it is.
//!
//! Both macros stand in an `impl` for a wrapper with the type parameter `M`, whose state keeps that of
//! the law inside as `inner`; the argument is the field with the law inside.

/// Of [`Material`](crate::Material).
macro_rules! hand_on_material {
    ($law:tt) => {
        const OBJECTIVE: bool = M::OBJECTIVE;
        const HYPERELASTIC: bool = M::HYPERELASTIC;
        const RATE_DEPENDENT: bool = M::RATE_DEPENDENT;
        const SPARSE: bool = M::SPARSE;
        const NAMES: &'static [&'static str] = M::NAMES;

        fn started_width(&self, old: &Self::State, new: &Self::State) -> f64 {
            self.$law.started_width(&old.inner, &new.inner)
        }

        fn continuous(&self) -> bool {
            self.$law.continuous()
        }

        fn density(&self) -> f64 {
            self.$law.density()
        }

        fn values(&self, state: &Self::State, out: &mut [f64]) {
            self.$law.values(&state.inner, out);
        }
    };
}

/// Of [`Cracking`](crate::Cracking).
macro_rules! hand_on_cracking {
    ($law:tt) => {
        fn toughness(&self, scale: &Scale) -> f64 {
            self.$law.toughness(scale)
        }

        fn strength(&self, scale: &Scale) -> f64 {
            self.$law.strength(scale)
        }

        fn driving_stress(&self, f: &Matrix3<f64>, cauchy: &Sym) -> Result<Sym, MaterialError> {
            self.$law.driving_stress(f, cauchy)
        }

        fn failure_of(&self, stress: &Sym, crack: &$crate::Crack, scale: &Scale) -> f64 {
            self.$law.failure_of(stress, crack, scale)
        }

        fn associated(&self) -> bool {
            self.$law.associated()
        }

        fn irreversible(&self, state: &Self::State) -> Vec<f64> {
            self.$law.irreversible(&state.inner)
        }
    };
}

pub(crate) use {hand_on_cracking, hand_on_material};
