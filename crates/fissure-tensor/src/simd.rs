//! Eight numbers at a time, on whatever vector unit the machine has.
//!
//! Transfers between particles and nodes are written once, over [`Lanes`], and compiled for AVX-512, for AVX2 with
//! fused multiply-add, and plainly; [`Simd::run`] picks one. The two fused ones give the same bits. The plain one
//! rounds products before it adds them, so its results differ in the last place.

use pulp::Simd as _;

/// Numbers that go through a vector unit at once.
pub const EIGHT: usize = 8;

/// Operations on eight or four `f64` that happen to be done at once.
pub trait Lanes: Copy + Send + Sync {
    /// Eight numbers.
    type Eight: Copy;
    /// Four numbers.
    type Four: Copy;
    /// The same number eight times.
    fn splat(self, x: f64) -> Self::Eight;
    /// From memory.
    fn load(self, x: &[f64; 8]) -> Self::Eight;
    /// To memory.
    fn store(self, x: Self::Eight, to: &mut [f64; 8]);
    /// `a b`.
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// `a b + c`, rounded once where the machine can.
    fn mul_add(self, a: Self::Eight, b: Self::Eight, c: Self::Eight) -> Self::Eight;
    /// Lower four plus upper four.
    fn fold(self, x: Self::Eight) -> Self::Four;
    /// Four times `low`, four times `high`.
    fn pair(self, low: f64, high: f64) -> Self::Eight;
    /// Four from memory.
    fn load4(self, x: [f64; 4]) -> Self::Four;
    /// Four to memory.
    fn store4(self, x: Self::Four) -> [f64; 4];
    /// `a b`, of four.
    fn mul4(self, a: Self::Four, b: Self::Four) -> Self::Four;
    /// `a b + c`, rounded once where the machine can, of four.
    fn mul_add4(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four;
    /// The same number four times.
    #[inline(always)]
    fn splat4(self, x: f64) -> Self::Four {
        self.load4([x; 4])
    }
}

/// What is run on a vector unit. `run` must be `#[inline(always)]`, and so must what it calls, or it is compiled for
/// the plain one.
pub trait SimdTask {
    /// What comes out.
    type Output;
    /// Does the work.
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// A vector unit of the machine.
#[derive(Clone, Copy, Debug)]
pub struct Simd(Unit);

#[derive(Clone, Copy, Debug)]
enum Unit {
    Plain,
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
}

impl Simd {
    /// The widest this machine has.
    pub fn widest() -> Self {
        let names = ["avx512", "avx2"];
        let found = names.into_iter().find_map(Self::named);
        found.unwrap_or(Self(Unit::Plain))
    }

    /// By its name: `avx512`, `avx2` or `plain`; `None` if the machine has it not.
    pub fn named(name: &str) -> Option<Self> {
        let unit = match name {
            "plain" => Some(Unit::Plain),
            #[cfg(target_arch = "x86_64")]
            "avx2" => pulp::x86::V3::try_new().map(Unit::Avx2),
            #[cfg(target_arch = "x86_64")]
            "avx512" => pulp::x86::V4::try_new().map(Unit::Avx512),
            _ => None,
        };
        unit.map(Self)
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        match self.0 {
            Unit::Plain => "plain",
            #[cfg(target_arch = "x86_64")]
            Unit::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Unit::Avx512(_) => "avx512",
        }
    }

    /// Runs a task, compiled for this unit.
    #[inline]
    pub fn run<T: SimdTask>(self, task: T) -> T::Output {
        match self.0 {
            Unit::Plain => task.run(Plain),
            #[cfg(target_arch = "x86_64")]
            Unit::Avx2(unit) => unit.vectorize(On { lanes: unit, task }),
            #[cfg(target_arch = "x86_64")]
            Unit::Avx512(unit) => unit.vectorize(On { lanes: unit, task }),
        }
    }
}

impl PartialEq for Simd {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

/// A task with its unit, in the form that pulp compiles for it.
struct On<L, T> {
    lanes: L,
    task: T,
}

impl<L: Lanes, T: SimdTask> pulp::NullaryFnOnce for On<L, T> {
    type Output = T::Output;

    #[inline(always)]
    fn call(self) -> T::Output {
        self.task.run(self.lanes)
    }
}

/// What every machine has.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

impl Lanes for Plain {
    type Eight = [f64; 8];
    type Four = [f64; 4];

    #[inline(always)]
    fn splat(self, x: f64) -> [f64; 8] {
        [x; 8]
    }
    #[inline(always)]
    fn load(self, x: &[f64; 8]) -> [f64; 8] {
        *x
    }
    #[inline(always)]
    fn store(self, x: [f64; 8], to: &mut [f64; 8]) {
        *to = x;
    }
    #[inline(always)]
    fn mul(self, a: [f64; 8], b: [f64; 8]) -> [f64; 8] {
        let mut out = a;
        for i in 0..8 {
            out[i] *= b[i];
        }
        out
    }
    #[inline(always)]
    fn mul_add(self, a: [f64; 8], b: [f64; 8], c: [f64; 8]) -> [f64; 8] {
        let mut out = c;
        for i in 0..8 {
            out[i] += a[i] * b[i];
        }
        out
    }
    #[inline(always)]
    fn fold(self, x: [f64; 8]) -> [f64; 4] {
        [x[0] + x[4], x[1] + x[5], x[2] + x[6], x[3] + x[7]]
    }
    #[inline(always)]
    fn pair(self, low: f64, high: f64) -> [f64; 8] {
        [low, low, low, low, high, high, high, high]
    }
    #[inline(always)]
    fn load4(self, x: [f64; 4]) -> [f64; 4] {
        x
    }
    #[inline(always)]
    fn store4(self, x: [f64; 4]) -> [f64; 4] {
        x
    }
    #[inline(always)]
    fn mul4(self, mut a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        for i in 0..4 {
            a[i] *= b[i];
        }
        a
    }
    #[inline(always)]
    fn mul_add4(self, a: [f64; 4], b: [f64; 4], mut c: [f64; 4]) -> [f64; 4] {
        for i in 0..4 {
            c[i] += a[i] * b[i];
        }
        c
    }
}

#[cfg(target_arch = "x86_64")]
impl Lanes for pulp::x86::V4 {
    type Eight = pulp::f64x8;
    type Four = pulp::f64x4;

    #[inline(always)]
    fn splat(self, x: f64) -> pulp::f64x8 {
        self.splat_f64x8(x)
    }
    #[inline(always)]
    fn load(self, x: &[f64; 8]) -> pulp::f64x8 {
        pulp::cast(*x)
    }
    #[inline(always)]
    fn store(self, x: pulp::f64x8, to: &mut [f64; 8]) {
        *to = pulp::cast(x);
    }
    #[inline(always)]
    fn mul(self, a: pulp::f64x8, b: pulp::f64x8) -> pulp::f64x8 {
        self.mul_f64s(a, b)
    }
    #[inline(always)]
    fn mul_add(self, a: pulp::f64x8, b: pulp::f64x8, c: pulp::f64x8) -> pulp::f64x8 {
        self.mul_add_f64x8(a, b, c)
    }
    #[inline(always)]
    fn fold(self, x: pulp::f64x8) -> pulp::f64x4 {
        let [low, high]: [pulp::f64x4; 2] = pulp::cast(x);
        (*self).add_f64x4(low, high)
    }
    #[inline(always)]
    fn load4(self, x: [f64; 4]) -> pulp::f64x4 {
        pulp::cast(x)
    }
    #[inline(always)]
    fn store4(self, x: pulp::f64x4) -> [f64; 4] {
        pulp::cast(x)
    }
    #[inline(always)]
    fn mul4(self, a: pulp::f64x4, b: pulp::f64x4) -> pulp::f64x4 {
        (*self).mul_f64x4(a, b)
    }
    #[inline(always)]
    fn mul_add4(self, a: pulp::f64x4, b: pulp::f64x4, c: pulp::f64x4) -> pulp::f64x4 {
        (*self).mul_add_f64x4(a, b, c)
    }
    #[inline(always)]
    fn pair(self, low: f64, high: f64) -> pulp::f64x8 {
        pulp::cast([self.splat_f64x4(low), self.splat_f64x4(high)])
    }
}

#[cfg(target_arch = "x86_64")]
impl Lanes for pulp::x86::V3 {
    type Eight = [pulp::f64x4; 2];
    type Four = pulp::f64x4;

    #[inline(always)]
    fn splat(self, x: f64) -> [pulp::f64x4; 2] {
        [self.splat_f64x4(x); 2]
    }
    #[inline(always)]
    fn load(self, x: &[f64; 8]) -> [pulp::f64x4; 2] {
        pulp::cast(*x)
    }
    #[inline(always)]
    fn store(self, x: [pulp::f64x4; 2], to: &mut [f64; 8]) {
        *to = pulp::cast(x);
    }
    #[inline(always)]
    fn mul(self, a: [pulp::f64x4; 2], b: [pulp::f64x4; 2]) -> [pulp::f64x4; 2] {
        [self.mul_f64s(a[0], b[0]), self.mul_f64s(a[1], b[1])]
    }
    #[inline(always)]
    fn mul_add(
        self,
        a: [pulp::f64x4; 2],
        b: [pulp::f64x4; 2],
        c: [pulp::f64x4; 2],
    ) -> [pulp::f64x4; 2] {
        [
            self.mul_add_f64x4(a[0], b[0], c[0]),
            self.mul_add_f64x4(a[1], b[1], c[1]),
        ]
    }
    #[inline(always)]
    fn fold(self, x: [pulp::f64x4; 2]) -> pulp::f64x4 {
        self.add_f64s(x[0], x[1])
    }
    #[inline(always)]
    fn load4(self, x: [f64; 4]) -> pulp::f64x4 {
        pulp::cast(x)
    }
    #[inline(always)]
    fn store4(self, x: pulp::f64x4) -> [f64; 4] {
        pulp::cast(x)
    }
    #[inline(always)]
    fn mul4(self, a: pulp::f64x4, b: pulp::f64x4) -> pulp::f64x4 {
        self.mul_f64x4(a, b)
    }
    #[inline(always)]
    fn mul_add4(self, a: pulp::f64x4, b: pulp::f64x4, c: pulp::f64x4) -> pulp::f64x4 {
        self.mul_add_f64x4(a, b, c)
    }
    #[inline(always)]
    fn pair(self, low: f64, high: f64) -> [pulp::f64x4; 2] {
        [self.splat_f64x4(low), self.splat_f64x4(high)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation once, on numbers that round.
    struct Everything([f64; 8]);

    impl SimdTask for Everything {
        type Output = Vec<f64>;

        #[inline(always)]
        fn run<L: Lanes>(self, lanes: L) -> Vec<f64> {
            let x = lanes.load(&self.0);
            let product = lanes.mul(x, lanes.splat(0.1));
            let sum = lanes.mul_add(x, lanes.pair(0.7, -0.3), product);
            let mut out = [0.0; 8];
            lanes.store(sum, &mut out);
            let folded = lanes.fold(product);
            let four = lanes.mul_add4(folded, lanes.splat4(0.3), lanes.mul4(folded, folded));
            let four = [folded, four].map(|four| lanes.store4(four));
            out.into_iter().chain(four.into_iter().flatten()).collect()
        }
    }

    #[test]
    fn every_unit_does_the_same_arithmetic() {
        let x: [f64; 8] = std::array::from_fn(|i| (i as f64 + 0.3) * 1.7 - 4.0);
        let units = ["plain", "avx2", "avx512"].map(|name| (name, Simd::named(name)));
        let plain = Simd(Unit::Plain).run(Everything(x));
        for (i, exact) in x.iter().enumerate() {
            let factor = if i < 4 { 0.8 } else { -0.2 };
            assert!((plain[i] - exact * factor).abs() <= 1e-15 * exact.abs());
        }
        let mut fused: Option<Vec<f64>> = None;
        for (name, unit) in units {
            let Some(unit) = unit else { continue };
            assert_eq!(unit.name(), name);
            let found = unit.run(Everything(x));
            for (a, b) in found.iter().zip(&plain) {
                assert!((a - b).abs() <= 4.0 * f64::EPSILON * (1.0 + a.abs()));
            }
            if name != "plain" {
                assert!(fused.as_ref().is_none_or(|fused| *fused == found));
                fused = Some(found);
            }
        }
        assert!(Simd::named("mmx").is_none());
    }
}
