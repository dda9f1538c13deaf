//! What a part of a leg asks for, and the answer to it.

use fissure_tensor::{Matrix3, rotation};

use super::{Point, Sample};
use crate::equilibrium::{Failure, Problem, Unknowns, components, tensor};
use crate::material::completed;
use crate::{Biot, Control, Entry, GradientLeg, Increment, Leg, Material, Path, Stage};

/// A part of a leg: where it ends, and how much of a step it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Start, as a fraction of the leg.
    pub from: f64,
    /// End, as a fraction of the leg.
    pub to: f64,
    /// Length over that of a step.
    pub length: f64,
}

impl Part {
    /// The first `fraction` of the part.
    pub fn first(&self, fraction: f64) -> Self {
        Self {
            to: self.from + (self.to - self.from) * fraction,
            length: self.length * fraction,
            ..*self
        }
    }

    /// Both halves.
    pub fn halves(&self) -> [Self; 2] {
        let first = self.first(0.5);
        let second = Self {
            from: first.to,
            to: self.to,
            length: first.length,
        };
        [first, second]
    }
}

/// What the end of a part is sought by.
struct Targets {
    unknowns: Unknowns,
    /// Numbers to start from, final where they are controlled.
    guess: [f64; 6],
    /// Stresses asked for, Pa.
    stress: [Option<f64>; 6],
}

impl<M: Material> Point<'_, M> {
    /// The sample at the end of a part that starts at `old`; `start` is that of the leg.
    pub(super) fn attempt(
        &self,
        path: &Path,
        (index, step): (usize, usize),
        start: &Sample<M::State>,
        old: &Sample<M::State>,
        part: &Part,
    ) -> Result<Sample<M::State>, Failure> {
        let leg = &path.legs[index];
        let plane = self.law.out_of_plane_stretch(&old.state).is_some();
        let Targets {
            unknowns,
            guess,
            stress,
        } = match leg {
            Stage::Stretch(leg) => stretch_targets(leg, start, old, part.to, plane),
            Stage::Gradient(leg) => gradient_targets(leg, start, old, part.to, plane),
        };
        let f_old = old.deformation_gradient();
        let problem = Problem {
            law: self.law,
            old: &old.state,
            increment: Increment {
                f_old,
                f_new: f_old,
                dt: leg.dt() * part.length,
                band: path.band,
                external: path.external,
            },
            unknowns,
            stress,
            modulus: self.modulus(path),
        };
        let trial = problem.solve(guess)?;
        let response = &trial.response;
        let (rotation, strain, stress) = match unknowns {
            Unknowns::Stretch { rotation } => {
                let mut strain = tensor(&trial.x);
                if let Some(stretch) = self.law.out_of_plane_stretch(&response.state) {
                    strain.mandel[2] = stretch - 1.0;
                }
                (rotation, strain, trial.stress)
            }
            Unknowns::Entries { .. } => {
                let whole = completed(self.law, &trial.increment.f_new, &response.state);
                let kinematics = Biot::new(&whole).map_err(Failure::Law)?;
                let back = kinematics.rotation.transpose();
                let stress = response.stress.congruence(&back);
                (kinematics.rotation, kinematics.strain(), stress)
            }
        };
        let mut new = Sample {
            leg: index,
            step,
            time: old.time + problem.increment.dt,
            strain,
            stress,
            rotation,
            state: response.state,
            stored: response.stored,
            dissipated: old.dissipated + response.dissipated,
            work: old.work,
            parts: 1,
        };
        let mean_stress = (old.biot_stress() + new.biot_stress()) * 0.5;
        new.work += mean_stress.dot(&(new.strain - old.strain));
        Ok(new)
    }
}

/// In this form the last step ends on the target to the last bit.
fn between(first: f64, end: f64, fraction: f64) -> f64 {
    first * (1.0 - fraction) + end * fraction
}

fn stretch_targets<S>(
    leg: &Leg,
    start: &Sample<S>,
    old: &Sample<S>,
    fraction: f64,
    plane: bool,
) -> Targets {
    let (first_strain, first_stress) = (components(&start.strain), components(&start.stress));
    let mut guess = components(&old.strain);
    let mut stress = [None; 6];
    for i in 0..6 {
        if plane && (2..5).contains(&i) {
            continue;
        }
        match leg.control[i] {
            Control::Held => guess[i] = first_strain[i],
            Control::Strain(end) => guess[i] = between(first_strain[i], end, fraction),
            Control::Stress(end) => stress[i] = Some(between(first_stress[i], end, fraction)),
        }
    }
    let rotation = rotation(&leg.spin, leg.spin.norm() * fraction) * start.rotation;
    Targets {
        unknowns: Unknowns::Stretch { rotation },
        guess,
        stress,
    }
}

fn gradient_targets<S>(
    leg: &GradientLeg,
    start: &Sample<S>,
    old: &Sample<S>,
    fraction: f64,
    plane: bool,
) -> Targets {
    let (first, now) = (start.deformation_gradient(), old.deformation_gradient());
    let first_stress = components(&start.cauchy());
    let mut known = Matrix3::zeros();
    let mut place = [None; 6];
    let mut guess = [0.0; 6];
    let mut stress = [None; 6];
    for i in 0..3 {
        for j in 0..3 {
            known[(i, j)] = match leg.entries[i][j] {
                Entry::Held => first[(i, j)],
                Entry::Value(end) => between(first[(i, j)], end, fraction),
                Entry::Stress(end) => {
                    let slot = slot(i, j);
                    if !(plane && (2..5).contains(&slot)) {
                        place[slot] = Some((i, j));
                        guess[slot] = now[(i, j)];
                        stress[slot] = Some(between(first_stress[slot], end, fraction));
                    }
                    now[(i, j)]
                }
            };
        }
    }
    Targets {
        unknowns: Unknowns::Entries { known, place },
        guess,
        stress,
    }
}

/// Position of a pair of indices in the order of the Mandel components.
fn slot(i: usize, j: usize) -> usize {
    if i == j { i } else { 6 - i - j }
}

/// Whether a leg can be followed.
pub(super) fn is_sound(leg: &Stage) -> bool {
    let sound = match leg {
        Stage::Stretch(leg) => {
            let targets = leg.control.iter().all(|control| match control {
                Control::Held => true,
                Control::Strain(end) | Control::Stress(end) => end.is_finite(),
            });
            targets && leg.spin.iter().all(|c| c.is_finite())
        }
        Stage::Gradient(leg) => is_sound_gradient(&leg.entries),
    };
    sound && leg.steps() > 0 && leg.dt() >= 0.0
}

fn is_sound_gradient(entries: &[[Entry; 3]; 3]) -> bool {
    let finite = entries.iter().flatten().all(|entry| match entry {
        Entry::Held => true,
        Entry::Value(end) | Entry::Stress(end) => end.is_finite(),
    });
    let free = |i: usize, j: usize| matches!(entries[i][j], Entry::Stress(_));
    let mirrored = (0..3).any(|i| (0..i).any(|j| free(i, j) && free(j, i)));
    finite && !mirrored
}
