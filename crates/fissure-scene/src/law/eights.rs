//! The law asked for eight particles at once.

use fissure_materials::{EIGHT, EightPoints, Material, Matrix3};
use fissure_tensor::simd::{Lanes, SimdTask};

use super::windows::Part;
use crate::body::ParticleScale;
use crate::sweep::Run;

/// What a law answered for the particles of a run by eights; their stresses are in the trial.
pub(super) struct ByEights {
    /// A bit for each eight.
    answered: u8,
    pub stored: [f64; Run::MAX],
    pub wave_speed: [f64; Run::MAX],
}

impl Default for ByEights {
    fn default() -> Self {
        Self {
            answered: 0,
            stored: [0.0; Run::MAX],
            wave_speed: [0.0; Run::MAX],
        }
    }
}

impl ByEights {
    #[inline(always)]
    pub(super) fn answered(&self, row: usize) -> bool {
        // A run of another solver may be longer.
        row < Run::MAX && self.answered >> (row / EIGHT) & 1 == 1
    }
}

/// Asks a law for the eights of a run that have no history.
pub(super) struct AskByEights<'a, 'p, M: Material, const D: usize> {
    pub law: &'a M,
    /// Of the run's particles on.
    pub scale: Option<&'a [ParticleScale]>,
    pub part: &'a mut Part<'p, M, D>,
    pub answers: &'a mut ByEights,
}

impl<M: Material, const D: usize> SimdTask for AskByEights<'_, '_, M, D> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _lanes: L) {
        let answers = self.answers;
        let Part { new, states, .. } = self.part;
        let count = new.len().min(Run::MAX);
        // All are brought into columns first: what has just been written number by number cannot be read by eights.
        let mut points = [EightPoints::of(&Matrix3::identity()); Run::MAX / EIGHT];
        for (row, f) in new.deformation_gradient.iter().enumerate().take(count) {
            let points = &mut points[row / EIGHT];
            points.set(row % EIGHT, f);
            if let Some(scale) = self.scale {
                points.stiffness[row % EIGHT] = scale[row].0.stiffness;
                points.strength[row % EIGHT] = scale[row].0.strength;
            }
        }
        for (first, points) in (0..count).step_by(EIGHT).zip(&points) {
            let rows = first..(first + EIGHT).min(count);
            let no_state = size_of::<M::State>() == 0;
            if !no_state && rows.clone().any(|row| states.slot(row).is_some()) {
                continue;
            }
            let Some(responses) = self.law.update_eight(points) else {
                continue;
            };
            if !responses.is_finite() {
                continue;
            }
            answers.answered |= 1 << (first / EIGHT);
            for row in rows {
                new.stress[row] = responses.stress(row - first);
            }
            answers.stored[first..first + EIGHT].copy_from_slice(&responses.stored);
            answers.wave_speed[first..first + EIGHT].copy_from_slice(&responses.wave_speed);
        }
    }
}
