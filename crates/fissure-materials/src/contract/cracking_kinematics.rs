//! P14 crack strain and P15 closure.

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::{Case, Random, gauge::Gauge, runner::Property, subject::Subject};
use super::{case::gradient, continuity::largest_jump};
use crate::{Biot, Cracking, Increment, MaterialError, Response, Scale};

/// The strain that the elastic law does not explain, `E − C⁻¹:T`, has only the components `nn`,
/// `nt` and `np` of a crack, and `nn` is opening over width; without a crack there is none.
///
/// Bound: `1e-10` of the strain plus `1e-13`, and twice what the same law with a strength out of
/// reach shows at the same strain: nothing for laws linear in the Biot strain, second order for
/// others. Judged for up to one crack; in plane stress for one across the sheet, since what opens out of it shows in no
/// strain that is controlled.
pub(super) fn crack_strain<M: Cracking>() -> Property<M> {
    Property {
        name: "P14 crack strain",
        hint: "The crack strain is (u ⊗ n + n ⊗ u)/(2 L): nothing along the crack",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, true),
        judge: judge_crack_strain,
        must_apply: false,
    }
}

fn judge_crack_strain<M: Cracking>(
    subject: &Subject<M>,
    case: &Case,
) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let law = subject.law;
    let Some(compliance) = subject.compliance() else {
        return Ok(gauge);
    };
    let gradients = case.gradients();
    let responses = subject.drive(&gradients, &case.band, &Scale::default())?;
    for (response, f) in responses.iter().zip(&gradients[1..]) {
        let Some(undamaged) = subject.undamaged(f, &case.band) else {
            return Ok(gauge);
        };
        let f = |state: &M::State| subject.whole(f, state);
        let strain = subject.controlled(&Biot::new(&f(&response.state))?.strain());
        let inelastic = |answer: &Response<M::State>| -> Result<Sym, MaterialError> {
            let stress = law.driving_stress(&f(&answer.state), &answer.stress)?;
            Ok(strain - compliance.apply(&stress))
        };
        let crack_strain = inelastic(response)?;
        let bound = 2.0 * inelastic(&undamaged)?.norm() + 1e-10 * strain.norm() + 1e-13;
        match law.cracks(&response.state).as_slice() {
            [] => gauge.check(crack_strain.norm(), bound, "crack strain without a crack"),
            [crack] if !(M::PLANE && crack.normal.z.abs() > 1e-9) => {
                let along = along(&crack_strain, &crack.normal);
                gauge.check(along, bound, "crack strain along the crack");
                let opening = crack_strain.normal_component(&crack.normal);
                let difference = (opening - crack.opening / crack.width).abs();
                gauge.check(difference, bound, "crack strain is not opening over width");
            }
            _ => {}
        }
    }
    Ok(gauge)
}

/// Norm of the components of a tensor in the plane of a normal.
fn along(tensor: &Sym, normal: &Vector3<f64>) -> f64 {
    let plane = Matrix3::identity() - normal * normal.transpose();
    tensor.congruence(&plane).norm()
}

/// A crack that has failed and is pressed shut answers as if it were not there: its normal
/// traction is that of the undamaged law, it is not open, and on the way from open to shut the
/// stress does not jump. Bounds: `1e-10` of stiffness times strain plus `1e-13` of the stiffness;
/// for the jump that of P11. Laws whose cracks never fail, or whose strength has no scale, are
/// not judged. Where a crack that has only softened leaves its opening is the law's choice.
pub(super) fn closure<M: Cracking>() -> Property<M> {
    Property {
        name: "P15 closure",
        hint: "A shut crack carries compression; open and shut branches meet at zero opening",
        share: 0.5,
        draw: draw_closure,
        judge: judge_closure,
        must_apply: false,
    }
}

/// An opening path, then one step back into compression with some strain across.
fn draw_closure<M: Cracking>(subject: &Subject<M>, random: &mut Random) -> Case {
    let mut case = subject.draw_opening(random);
    let points = case.points();
    let reached = points.last().map_or(Sym::ZERO, |(_, strain)| *strain);
    let normal = reached.spectrum().vectors[0];
    let size = subject.natural * random.log_uniform(1e-3, 10.0);
    let plane = Matrix3::identity() - normal * normal.transpose();
    let across = random.strain_direction(false).congruence(&plane) * (0.3 * size);
    let target = across - Sym::dyad(&normal) * size;
    case.steps.push(super::Step {
        strain: target - reached,
        spin: Vector3::zeros(),
    });
    case
}

fn judge_closure<M: Cracking>(subject: &Subject<M>, case: &Case) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let (law, scale) = (subject.law, Scale::default());
    let points = case.points();
    let gradients: Vec<_> = points.iter().map(gradient).collect();
    let [history @ .., end] = gradients.as_slice() else {
        return Ok(gauge);
    };
    let responses = subject.drive(history, &case.band, &scale)?;
    let (Some(open), Some(from)) = (responses.last(), history.last()) else {
        return Ok(gauge);
    };
    let cracks = law.cracks(&open.state);
    let ([crack], Some(undamaged)) = (cracks.as_slice(), subject.undamaged(end, &case.band)) else {
        return Ok(gauge);
    };
    if !crack.failed {
        return Ok(gauge);
    }
    let increment = subject.increment(*from, *end, &case.band);
    let shut = law.update(&increment, &open.state)?;
    let traction = |answer: &Response<M::State>| -> Result<f64, MaterialError> {
        let f = subject.whole(end, &answer.state);
        let stress = law.driving_stress(&f, &answer.stress)?;
        Ok(stress.normal_component(&crack.normal))
    };
    let expected = traction(&undamaged)?;
    let strain = points.last().map_or(0.0, |(_, strain)| strain.norm());
    if expected > -1e-6 * subject.stiffness * strain {
        return Ok(gauge);
    }
    let bound = subject.stiffness * (1e-10 * strain + 1e-13);
    gauge.check(
        (traction(&shut)? - expected).abs(),
        bound,
        "a shut crack does not carry the undamaged traction, Pa",
    );
    let opening = law.cracks(&shut.state).first().map_or(0.0, |c| c.opening);
    gauge.check(
        opening,
        1e-12 * subject.opening,
        "a crack under compression is open, m",
    );
    let opened: Increment = increment.with_end(*from);
    let jump = largest_jump(law, &opened, &open.state, end)?;
    let segment = (end - from).norm();
    let bound = subject.stiffness * (1e-5 * segment + 1e-13);
    gauge.check(jump, bound, "the stress jumps at closure, Pa");
    Ok(gauge)
}
