//! One block of the document, and its compression.

use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use crate::nairn::conjugate::StressMeasure;
use crate::nairn::drive::drive;
use crate::nairn::numerics::{Numerics, seeding};
use crate::nairn::pictures::Snapshot;

const BODY: &str = "block";
/// Thickness of the plane, m.
const THICKNESS: f64 = 1e-3;
/// Points of the curve that is kept.
const POINTS: f64 = 200.0;
/// Least factor on the properties.
const LEAST: f64 = 0.3;

/// What a compressed block leaves.
#[derive(Clone, Debug, Default)]
pub(super) struct Sample {
    /// Largest mean compressive stress of the middle half, Pa.
    pub strength: f64,
    /// Nominal strain there.
    pub strain: f64,
    pub wall_s: f64,
    pub particles: u64,
    pub steps: u64,
    pub energy_imbalance: f64,
    pub worst_balance: f64,
    pub transfer_loss: f64,
    /// Share of the run that was done.
    pub reached: f64,
    /// Nominal strain and mean compressive stress, Pa.
    pub curve: Vec<[f64; 2]>,
    /// The factor and the damage, if asked for.
    pub snapshots: Vec<Snapshot>,
}

/// Compresses the block that one case and a seed describe, on this thread.
pub(super) fn compress(case: &Parameters, seed: u64, drawing: bool) -> Result<Sample, StudyError> {
    let numerics = Numerics::of(case)?;
    let (length, speed) = (case.number("length")?, case.number("speed")?);
    let strain_end = case.number("strain")?;
    let end = strain_end * length / speed;
    let margin = 8.0 * numerics.spacing;
    let width = case.number("width")?;
    let grid = Grid::over(
        [-margin, -margin],
        [length + margin, width + margin],
        numerics.spacing,
    )
    .map_err(StudyError::failed("making the grid"))?;
    let (mut scene, factor) = scene(case, &numerics, seed, drawing)?;
    let inner = inner(&scene, length);
    let mut solver = numerics.solver(grid)?;
    let mut sample = Sample::default();
    let mut next = 0.0;
    let done = drive(&mut scene, solver.as_mut(), end, |scene, report| {
        let strain = speed * report.time / length;
        let stress = -mean_stress(scene, &inner);
        if stress > sample.strength {
            (sample.strength, sample.strain) = (stress, strain);
        }
        if report.time >= next {
            next += end / POINTS;
            sample.curve.push([strain, stress]);
        }
        true
    })?;
    let balance = EnergyBalance::of(scene.energy());
    sample.wall_s = done.wall_s;
    sample.particles = scene.particle_count() as u64;
    sample.steps = scene.step();
    sample.energy_imbalance = balance.energy_imbalance();
    sample.worst_balance = balance.worst_balance;
    sample.transfer_loss = balance.relative_transfer_loss();
    sample.reached = scene.time() / end;
    if drawing {
        let title = format!("Shear damage at {:.1} % compression", 100.0 * strain_end);
        sample.snapshots = factor.into_iter().collect();
        sample
            .snapshots
            .push(Snapshot::of(title, &scene, "shear_damage", None));
    }
    Ok(sample)
}

/// Mean of the axial stress over the middle half of the block, Pa: what a section carries, over its area.
///
/// The cells that the moving plate has reached are held by it and bear nothing of their own. Their share of the
/// length, up to `h/length`, would be missing from the mean over the whole block, which then depends on the grid.
fn mean_stress(scene: &Scene<2>, inner: &[bool]) -> f64 {
    let Some(body) = scene.body(BODY) else {
        return f64::NAN;
    };
    let particles = body.particles();
    let stresses = particles.id.iter().zip(body.motion().stress);
    let (mut force, mut volume) = (0.0, 0.0);
    for ((id, stress), own) in stresses.zip(&particles.volume) {
        if inner.get(id.0 as usize) == Some(&true) {
            force += own * stress.mandel[0];
            volume += own;
        }
    }
    force / volume
}

/// By id, whether a particle rests in the middle half of the length.
fn inner(scene: &Scene<2>, length: f64) -> Vec<bool> {
    let Some(body) = scene.body(BODY) else {
        return Vec::new();
    };
    let particles = body.particles();
    let mut inner = vec![false; particles.len()];
    for (id, x) in particles.id.iter().zip(&particles.motion.position) {
        if let Some(inner) = inner.get_mut(id.0 as usize) {
            *inner = (x[0] - 0.5 * length).abs() < 0.25 * length;
        }
    }
    inner
}

/// The block between two plates without friction, already moving as in even compression so that no
/// wave starts.
fn scene(
    case: &Parameters,
    numerics: &Numerics,
    seed: u64,
    drawing: bool,
) -> Result<(Scene<2>, Option<Snapshot>), StudyError> {
    let failed = || StudyError::failed("building the block");
    let (length, width) = (case.number("length")?, case.number("width")?);
    let speed = case.number("speed")?;
    let mode = |strength: &str, toughness: &str| -> Result<Mode<softening::Linear>, StudyError> {
        Ok(Mode {
            strength: case.number(strength)?,
            toughness: case.number(toughness)?,
            softening: softening::Linear,
        })
    };
    let elastic = Isotropic {
        density: case.number("density")?,
        young: case.number("young")?,
        poisson: case.number("poisson")?,
    };
    let mut law = AnisotropicDamage::new(
        elastic,
        mode("strength", "toughness")?,
        mode("shear_strength", "shear_toughness")?,
    );
    law.onset = Onset::InPlane;
    let seeding = seeding(numerics.spacing);
    let grip = 2.0 * numerics.spacing;
    let along = Vector2::x();
    let mut scene = Scene::plane(Plane::Strain {
        thickness: THICKNESS,
    });
    StressMeasure::of(case)?.fill(
        &mut scene,
        BODY,
        law,
        &Block::new([0.0, 0.0], [length, width]),
        &seeding,
    )?;
    scene
        .rigid(
            "left",
            &Block::new([-grip, 0.0], [0.0, width]),
            &seeding,
            Hold::Component(along),
            Velocity(|_| 0.0),
        )
        .map_err(failed())?
        .rigid(
            "right",
            &Block::new([length, 0.0], [length + grip, width]),
            &seeding,
            Hold::Component(along),
            Velocity(move |_| -speed),
        )
        .map_err(failed())?
        .set_velocity(BODY, |x| Vector2::new(-speed * x[0] / length, 0.0))
        .map_err(failed())?;
    let factors = factors(case, numerics, seed)?;
    scene
        .set_scales(BODY, |id, x| {
            let factor = factors(id, x);
            Scale {
                stiffness: factor,
                strength: factor,
                toughness: factor,
            }
        })
        .map_err(failed())?;
    let snapshot = match (drawing, scene.body(BODY)) {
        (true, Some(body)) => {
            let particles = body.particles();
            let pairs = particles.id.iter().zip(&particles.motion.position);
            Some(Snapshot {
                title: "Factor on the properties".to_owned(),
                points: pairs.clone().map(|(_, x)| [x[0], x[1]]).collect(),
                values: pairs.map(|(id, x)| factors(*id, x)).collect(),
                axes: None,
            })
        }
        _ => None,
    };
    Ok((scene, snapshot))
}

type Factors = Box<dyn Fn(ParticleId, &Vector2<f64>) -> f64>;

/// The factor at each particle.
fn factors(case: &Parameters, numerics: &Numerics, seed: u64) -> Result<Factors, StudyError> {
    let marginal = Marginal::Normal {
        deviation: case.number("deviation")?,
        least: LEAST,
    };
    if case.choice("field")? == "uncorrelated" {
        let noise = WhiteNoise { seed };
        return Ok(Box::new(move |id, _| marginal.of(noise.at(id))));
    }
    // The lattice of the field is that of the particles.
    let spacing = 0.5 * numerics.spacing;
    let edge = 0.5 * spacing;
    let correlation = Correlation::Exponential {
        alpha: case.number("alpha")?,
    };
    let max = [case.number("length")? - edge, case.number("width")? - edge];
    let field = FieldSampler::new([edge; 2], max, spacing, correlation)
        .map_err(StudyError::failed("embedding the field"))?
        .draw(seed);
    // A particle next to the edge may lie outside by round-off.
    let inside =
        move |x: &Vector2<f64>| Vector2::new(x[0].clamp(edge, max[0]), x[1].clamp(edge, max[1]));
    Ok(Box::new(move |_, x| {
        let z = field.at(&inside(x));
        z.map_or(f64::NAN, |z| marginal.of(z))
    }))
}
