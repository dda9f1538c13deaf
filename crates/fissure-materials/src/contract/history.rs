//! A law's word on which states, and which stresses, need not be kept.

use super::{gauge::Gauge, runner::Property};
use crate::{Increment, Material};

/// Every state of a history that a [`SPARSE`](Material::SPARSE) law says need not be kept follows
/// from the deformation gradient it was reached at, and so does the stress of such a point where the law says so
/// ([`STRESS_FROM_GRADIENT`](Material::STRESS_FROM_GRADIENT)). Bound: equality. A virgin particle, above all, keeps none.
pub(super) fn history<M: Material>() -> Property<M> {
    Property {
        name: "sparse history",
        hint: "has_history has to say so of every state that without_history does not give back",
        share: 0.5,
        draw: |subject, random| {
            // From well below the linear limit, so that there is a time without a history.
            let mut case = subject.draw_path(random, true);
            let size = random.log_uniform(0.1 * subject.natural, subject.reach);
            let longest = case.max_strain();
            for step in &mut case.steps {
                step.strain = step.strain * (size / longest);
            }
            case
        },
        judge: |subject, case| {
            let (mut gauge, law) = (Gauge::default(), subject.law);
            if !(M::SPARSE || M::STRESS_FROM_GRADIENT) {
                return Ok(gauge);
            }
            let rest = Increment::to(crate::Matrix3::identity());
            let virgin = law.initial();
            let kept = law.has_history(&virgin) || law.without_history(&rest.f_new) != virgin;
            gauge.require(!kept, "a virgin particle has a history");
            let gradients = case.gradients();
            let driven = subject.drive(&gradients, &case.band, &Default::default())?;
            for (f, response) in gradients.iter().skip(1).zip(&driven) {
                let state = &response.state;
                if !law.has_history(state) {
                    let again = law.without_history(&subject.whole(f, state));
                    gauge.require(
                        again == *state,
                        "a state that is not kept does not come back",
                    );
                    if M::STRESS_FROM_GRADIENT {
                        let zero = subject.increment(*f, *f, &case.band);
                        let again = law.update(&zero, &again)?;
                        let same = again.stress == response.stress;
                        gauge.require(same, "the stress is not that of the gradient alone");
                    }
                }
            }
            Ok(gauge)
        },
        must_apply: M::SPARSE || M::STRESS_FROM_GRADIENT,
    }
}
