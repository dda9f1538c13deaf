//! Eight numbers at a time, on whatever vector unit the machine has.
//!
//! Transfers between particles and nodes are written once, over [`Lanes`], and compiled for AVX-512, for AVX2 with
//! fused multiply-add, and plainly; [`Simd::run`] picks one. The two fused ones give the same bits. The plain one
//! rounds products before it adds them, so its results differ in the last place.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod columns;
mod plain;

use std::hint::black_box;

pub use columns::{Row, chunks, prefetch_rows, read_columns, read_numbers, write_columns};
use plain::Plain;

/// Numbers that go through a vector unit at once.
pub const EIGHT: usize = 8;

/// Operations on eight `f64` that happen to be done at once.
pub trait Lanes: Copy + Send + Sync {
    /// Eight numbers.
    type Eight: Copy;
    /// The same number eight times.
    fn splat(self, x: f64) -> Self::Eight;
    /// From memory.
    fn load(self, x: &[f64; 8]) -> Self::Eight;
    /// To memory.
    fn store(self, x: Self::Eight, to: &mut [f64; 8]);
    /// `a + b`.
    fn add(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// `a − b`.
    fn sub(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// `a / b`.
    fn div(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// `a b`.
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// `a b + c`, rounded once where the machine can.
    fn mul_add(self, a: Self::Eight, b: Self::Eight, c: Self::Eight) -> Self::Eight;
    /// Four times the one, four times the other.
    fn pair(self, low: f64, high: f64) -> Self::Eight;
    /// The larger of each two; the second where one is no number.
    fn max(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// A bit for each number, by its place: whether it is zero or more. What is no number is not.
    fn not_negative(self, x: Self::Eight) -> u8;
    /// The first `count`, and zeros.
    #[inline(always)]
    fn first(self, x: Self::Eight, count: usize) -> Self::Eight {
        if count >= EIGHT {
            return x;
        }
        let mut numbers = [0.0; EIGHT];
        self.store(x, &mut numbers);
        numbers[count..].fill(0.0);
        self.load(&numbers)
    }
    /// Number j of row i becomes number i of row j.
    fn transpose(self, rows: [Self::Eight; 8]) -> [Self::Eight; 8];
    /// Eight rows of four numbers become four columns.
    fn columns4(self, rows: [&[f64; 4]; 8]) -> [Self::Eight; 4];
    /// Four columns become eight rows of four numbers.
    fn rows4(self, columns: [Self::Eight; 4]) -> [[f64; 4]; 8];
    /// Eight rows of two numbers become two columns.
    fn columns2(self, rows: [&[f64; 2]; 8]) -> [Self::Eight; 2];
    /// Two columns become eight rows of two numbers.
    fn rows2(self, columns: [Self::Eight; 2]) -> [[f64; 2]; 8];
    /// Eight rows of two numbers that stand side by side become two columns.
    #[inline(always)]
    fn unzip2(self, rows: &[f64; 16]) -> [Self::Eight; 2] {
        self.columns2(columns::parts(rows, 0))
    }
    /// The same of three.
    #[inline(always)]
    fn unzip3(self, rows: &[f64; 24]) -> [Self::Eight; 3] {
        let [a, b] = self.columns2(columns::parts(rows, 0));
        let [_, c] = self.columns2(columns::parts(rows, 1));
        [a, b, c]
    }
    /// The same of four.
    #[inline(always)]
    fn unzip4(self, rows: &[f64; 32]) -> [Self::Eight; 4] {
        self.columns4(columns::parts(rows, 0))
    }
    /// Two columns become eight rows of two numbers side by side.
    #[inline(always)]
    fn zip2(self, columns: [Self::Eight; 2], to: &mut [f64; 16]) {
        to.copy_from_slice(self.rows2(columns).as_flattened());
    }
    /// The same of three.
    #[inline(always)]
    fn zip3(self, [a, b, c]: [Self::Eight; 3], to: &mut [f64; 24]) {
        let mut last = [0.0; EIGHT];
        self.store(c, &mut last);
        let (to, _) = to.as_chunks_mut::<3>();
        for (to, (two, last)) in to.iter_mut().zip(self.rows2([a, b]).iter().zip(last)) {
            to[..2].copy_from_slice(two);
            to[2] = last;
        }
    }
    /// The same of four.
    #[inline(always)]
    fn zip4(self, columns: [Self::Eight; 4], to: &mut [f64; 32]) {
        to.copy_from_slice(self.rows4(columns).as_flattened());
    }
    /// Has the machine bring the line at this address to its caches, if it can. Nothing is read: any address will do.
    #[inline(always)]
    fn prefetch(self, _address: *const u8) {}
}

/// What is run on a vector unit. `run` must be `#[inline(always)]`, and so must what it calls, or it is compiled for
/// the plain one, where every operation on [`Lanes`] is a call. A closure cannot be made so: operations belong into
/// functions.
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
        // The compiler keeps vectors that do not fit the registers on the stack, and aligns the stack for them only if
        // something there asks for it. Else each of them may lie across two cache lines.
        black_box(&mut Line([0]));
        self.task.run(self.lanes)
    }
}

/// A cache line.
#[repr(align(64))]
struct Line(#[allow(dead_code)] [u8; 1]);

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
            let mut sums = [0.0; 8];
            let quotient = lanes.div(lanes.sub(sum, product), lanes.splat(0.5));
            let quotient = lanes.max(quotient, lanes.splat(-1e9));
            lanes.store(lanes.add(quotient, product), &mut sums);
            out.into_iter().chain(sums).collect()
        }
    }

    /// Rows as columns, and back.
    struct Turns([[f64; 8]; 8]);

    /// Which of these are not negative.
    struct Signs([f64; 8]);

    impl SimdTask for Signs {
        type Output = u8;

        #[inline(always)]
        fn run<L: Lanes>(self, lanes: L) -> u8 {
            lanes.not_negative(lanes.load(&self.0))
        }
    }

    #[test]
    fn every_unit_tells_what_is_not_negative() {
        for name in ["plain", "avx2", "avx512"] {
            let Some(unit) = Simd::named(name) else {
                continue;
            };
            let inf = f64::INFINITY;
            let found = unit.run(Signs([
                0.0,
                -0.0,
                1e-308,
                -1e-308,
                f64::NAN,
                inf,
                -inf,
                2.0,
            ]));
            assert_eq!(found, 0b1010_0111, "{name}");
        }
    }

    impl SimdTask for Turns {
        type Output = [[[f64; 8]; 8]; 5];

        #[inline(always)]
        fn run<L: Lanes>(self, lanes: L) -> Self::Output {
            let rows = self.0;
            let mut found = [[[0.0; 8]; 8]; 5];
            let turned = lanes.transpose(rows.map(|row| lanes.load(&row)));
            let four = rows.map(|r| [r[0], r[1], r[2], r[3]]);
            let four = lanes.columns4(four.each_ref());
            let two = rows.map(|r| [r[0], r[1]]);
            let two = lanes.columns2(two.each_ref());
            for (to, column) in found[0].iter_mut().zip(turned) {
                lanes.store(column, to);
            }
            for (to, column) in found[1].iter_mut().zip(four) {
                lanes.store(column, to);
            }
            for (to, column) in found[2].iter_mut().zip(two) {
                lanes.store(column, to);
            }
            for (to, row) in found[3].iter_mut().zip(lanes.rows4(four)) {
                to[..4].copy_from_slice(&row);
            }
            for (to, row) in found[4].iter_mut().zip(lanes.rows2(two)) {
                to[..2].copy_from_slice(&row);
            }
            found
        }
    }

    #[test]
    fn every_unit_turns_rows_into_columns_and_back() {
        let rows: [[f64; 8]; 8] =
            std::array::from_fn(|i| std::array::from_fn(|j| (10 * i + j) as f64));
        for name in ["plain", "avx2", "avx512"] {
            let Some(unit) = Simd::named(name) else {
                continue;
            };
            let [all, four, two, rows_of_four, rows_of_two] = unit.run(Turns(rows));
            for i in 0..8 {
                for j in 0..8 {
                    assert_eq!(all[j][i], rows[i][j], "{name}");
                    let within = |count| if j < count { rows[i][j] } else { 0.0 };
                    assert_eq!([four[j][i], two[j][i]], [within(4), within(2)], "{name}");
                    let found = [rows_of_four[i][j], rows_of_two[i][j]];
                    assert_eq!(found, [within(4), within(2)], "{name}");
                }
            }
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
            assert!((plain[8 + i] - exact * (2.0 * factor - 0.1)).abs() <= 1e-15 * exact.abs());
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
