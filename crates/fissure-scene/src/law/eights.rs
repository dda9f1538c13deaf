//! The law asked for eight particles at once.

use fissure_materials::{EIGHT, EightPoints, Material, Matrix3};
use fissure_tensor::simd::{Lanes, SimdTask, read_columns, read_numbers, write_columns};
use nalgebra::SVector;

use super::windows::Part;
use crate::body::ParticleScale;
use crate::sweep::{Run, SweepTotals};

/// What a law answered for the particles of a run by eights; their stresses are in the trial.
#[derive(Default)]
pub(super) struct ByEights {
    /// A bit for each eight.
    answered: u8,
    /// Eight sums of stored energies, J.
    stored: [f64; EIGHT],
    /// The largest wave speeds of eight sets, m/s.
    wave_speed: [f64; EIGHT],
}

impl ByEights {
    #[inline(always)]
    pub(super) fn answered(&self, row: usize) -> bool {
        // A run of another solver may be longer.
        row < Run::MAX && self.answered >> (row / EIGHT) & 1 == 1
    }

    /// Whether the first of so many rows are.
    pub(super) fn all_answered(&self, rows: usize) -> bool {
        (0..rows).step_by(EIGHT).all(|row| self.answered(row))
    }

    /// Sums over those that are answered.
    pub(super) fn totals(&self) -> SweepTotals {
        SweepTotals {
            stored: self.stored.iter().sum(),
            wave_speed: self.wave_speed.iter().copied().fold(0.0, f64::max),
            ..SweepTotals::default()
        }
    }
}

/// Asks a law for the eights of a run that have no history.
pub(super) struct AskByEights<'a, 'p, M: Material, const D: usize> {
    pub law: &'a M,
    /// Volumes at rest, m³, from the run's first particle on.
    pub volume: &'a [f64],
    /// From the run's first particle on.
    pub scale: Option<&'a [ParticleScale]>,
    pub part: &'a mut Part<'p, M, D>,
    pub answers: &'a mut ByEights,
}

impl<M: Material, const D: usize> SimdTask for AskByEights<'_, '_, M, D> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let answers = self.answers;
        let Part { new, states, .. } = self.part;
        let count = new.len().min(Run::MAX);
        let (mut stored, mut wave_speed) = (lanes.splat(0.0), lanes.splat(0.0));
        for first in (0..count).step_by(EIGHT) {
            let rows = first..(first + EIGHT).min(count);
            let no_state = size_of::<M::State>() == 0;
            if !no_state && rows.clone().any(|row| states.slot(row).is_some()) {
                continue;
            }
            let points = points(lanes, &new.deformation_gradient[first..], self.scale, first);
            let Some(responses) = self.law.update_eight(&points) else {
                continue;
            };
            let (energy, speed) = (
                lanes.load(&responses.stored),
                lanes.load(&responses.wave_speed),
            );
            let mut stress = [energy; 6];
            for (column, numbers) in stress.iter_mut().zip(&responses.stress) {
                *column = lanes.load(numbers);
            }
            if !all_finite(lanes, stress, energy, speed) {
                continue;
            }
            answers.answered |= 1 << (first / EIGHT);
            write_columns(lanes, &stress, &mut new.stress[rows.clone()]);
            let volume = lanes.first(read_numbers(lanes, &self.volume[rows.clone()]), rows.len());
            stored = lanes.mul_add(lanes.load(&responses.stored), volume, stored);
            wave_speed = lanes.max(lanes.load(&responses.wave_speed), wave_speed);
        }
        lanes.store(stored, &mut answers.stored);
        lanes.store(wave_speed, &mut answers.wave_speed);
    }
}

/// Whether all of these are numbers.
#[inline(always)]
fn all_finite<L: Lanes>(
    lanes: L,
    [a, b, c, d, e, f]: [L::Eight; 6],
    energy: L::Eight,
    speed: L::Eight,
) -> bool {
    // In pairs, since one sum would be a long chain.
    let pairs = [
        nothing(lanes, a, b),
        nothing(lanes, c, d),
        nothing(lanes, e, f),
        nothing(lanes, energy, speed),
    ];
    let sums = [lanes.add(pairs[0], pairs[1]), lanes.add(pairs[2], pairs[3])];
    let mut all = [1.0; EIGHT];
    lanes.store(lanes.add(sums[0], sums[1]), &mut all);
    let mut zero = true;
    for number in all {
        zero &= number == 0.0;
    }
    zero
}

/// Zero where both are numbers: a number times zero is zero, and what is none stays so.
#[inline(always)]
fn nothing<L: Lanes>(lanes: L, a: L::Eight, b: L::Eight) -> L::Eight {
    let zero = lanes.splat(0.0);
    lanes.mul_add(a, zero, lanes.mul(b, zero))
}

/// Kinetic energies of some particles.
pub(super) struct Kinetic<'a, const D: usize> {
    /// kg.
    pub mass: &'a [f64],
    /// m/s.
    pub velocity: &'a [SVector<f64, D>],
}

impl<const D: usize> SimdTask for Kinetic<'_, D> {
    /// With the squares of the largest speeds.
    type Output = SweepTotals;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> SweepTotals {
        let zero = lanes.splat(0.0);
        let (mut twice, mut largest) = (zero, zero);
        for first in (0..self.mass.len()).step_by(EIGHT) {
            let end = (first + EIGHT).min(self.mass.len());
            let mut velocity = [zero; D];
            read_columns(lanes, &self.velocity[first..end], &mut velocity);
            let mut square = zero;
            for component in velocity {
                square = lanes.mul_add(component, component, square);
            }
            let mass = lanes.first(read_numbers(lanes, &self.mass[first..end]), end - first);
            twice = lanes.mul_add(mass, square, twice);
            largest = lanes.max(square, largest);
        }
        let (mut sums, mut squares) = ([0.0; EIGHT], [0.0; EIGHT]);
        lanes.store(twice, &mut sums);
        lanes.store(largest, &mut squares);
        SweepTotals {
            kinetic: 0.5 * sums.iter().sum::<f64>(),
            speed_squared: squares.iter().copied().fold(0.0, f64::max),
            ..SweepTotals::default()
        }
    }
}

/// The points from row `first` on; where there are fewer than eight the last one stands in for the others.
#[inline(always)]
fn points<L: Lanes>(
    lanes: L,
    deformation_gradient: &[Matrix3<f64>],
    scale: Option<&[ParticleScale]>,
    first: usize,
) -> EightPoints {
    let mut columns = [lanes.splat(0.0); 9];
    read_columns(lanes, deformation_gradient, &mut columns);
    let mut points = EightPoints {
        deformation_gradient: [[0.0; EIGHT]; 9],
        stiffness: [1.0; EIGHT],
        strength: [1.0; EIGHT],
    };
    for j in 0..3 {
        for i in 0..3 {
            lanes.store(
                columns[3 * j + i],
                &mut points.deformation_gradient[3 * i + j],
            );
        }
    }
    if let Some(scale) = scale {
        for place in 0..EIGHT {
            let row = first + place.min(deformation_gradient.len() - 1);
            points.stiffness[place] = scale[row].0.stiffness;
            points.strength[place] = scale[row].0.strength;
        }
    }
    points
}
