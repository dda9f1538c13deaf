//! The halving shrinker: the smallest case that still fails.

use fissure_tensor::{Band, Sym, Vector3};

use super::{Case, case::Step};

/// Strains and angles below this are as good as zero; halving them further tells nothing.
const NEGLIGIBLE: f64 = 1e-12;

/// Most evaluations of the property while shrinking.
const BUDGET: usize = 4000;

/// Drops steps and halves strains, rotations and the power of two while `fails` holds.
pub(super) fn shrink(case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    let mut best = case;
    let mut left = BUDGET;
    let mut try_case = |candidate: Case, best: &mut Case| {
        if left == 0 || candidate == *best {
            return false;
        }
        left -= 1;
        let smaller = fails(&candidate);
        if smaller {
            *best = candidate;
        }
        smaller
    };
    loop {
        let mut progress = drop_steps(&mut best, &mut try_case);
        for edit in EDITS {
            let mut index = 0;
            while index < best.steps.len().max(1) {
                let mut candidate = best.clone();
                edit(&mut candidate, index);
                // A success is tried again at the same place: halved until it passes.
                if try_case(candidate, &mut best) {
                    progress = true;
                } else {
                    index += 1;
                }
            }
        }
        if !progress {
            return best;
        }
    }
}

/// Leaves out runs of steps, long ones first.
fn drop_steps(best: &mut Case, try_case: &mut impl FnMut(Case, &mut Case) -> bool) -> bool {
    let mut progress = false;
    let mut run = best.steps.len() / 2;
    while run > 0 {
        let mut start = 0;
        while start + run <= best.steps.len() && best.steps.len() > 1 {
            let mut candidate = best.clone();
            candidate.steps.drain(start..start + run);
            if !candidate.steps.is_empty() && try_case(candidate, best) {
                progress = true;
            } else {
                start += run;
            }
        }
        run /= 2;
    }
    progress
}

/// Each makes a case simpler at one step, or as a whole.
const EDITS: [fn(&mut Case, usize); 10] = [
    |case, _| case.band = Band::Uniform(case.band.max_width()),
    |case, _| case.turn = Vector3::zeros(),
    |case, _| case.exponent = 0,
    |case, i| with_step(case, i, |step| step.spin = Vector3::zeros()),
    |case, i| with_step(case, i, |step| step.strain = Sym::ZERO),
    |case, i| {
        with_step(case, i, |step| {
            // The shears go first: a diagonal increment is easier to read.
            let e = step.strain;
            step.strain = Sym::diagonal(e.xx(), e.yy(), e.zz());
        })
    },
    |case, i| {
        with_step(case, i, |step| {
            if step.strain.max_abs() > NEGLIGIBLE {
                step.strain = step.strain * 0.5;
            }
        })
    },
    |case, i| with_step(case, i, |step| step.spin = halved(step.spin)),
    |case, _| case.turn = halved(case.turn),
    |case, _| case.exponent /= 2,
];

fn with_step(case: &mut Case, index: usize, edit: impl Fn(&mut Step)) {
    if let Some(step) = case.steps.get_mut(index) {
        edit(step);
    }
}

fn halved(vector: Vector3<f64>) -> Vector3<f64> {
    if vector.norm() > NEGLIGIBLE {
        vector * 0.5
    } else {
        vector
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_threshold_is_found_within_a_factor_of_two() {
        let strains = (0..9).map(|_| Sym::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
        let case = Case::straight(strains, Band::Uniform(1.0));
        let fails = |case: &Case| case.steps.iter().map(|s| s.strain.xx()).sum::<f64>() > 0.3;
        let small = shrink(case, fails);
        assert_eq!(small.steps.len(), 1);
        let strain = small.steps[0].strain;
        assert!(strain.xx() > 0.3 && strain.xx() <= 0.6, "{strain:?}");
        assert_eq!(strain.xy(), 0.0);
    }
}
