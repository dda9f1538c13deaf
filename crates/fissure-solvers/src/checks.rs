//! What is asked before a step, and the error of a particle off the grid.

use fissure_grid::{Grid, Shape};
use fissure_scene::{Scene, SolveError};
use nalgebra::SVector;

/// The error of a step that a particle outside the grid stops.
pub(crate) fn outside<const D: usize>(scene: &Scene<D>, body: usize, index: usize) -> SolveError {
    let body = &scene.bodies()[body];
    SolveError::Outside {
        body: body.name().to_owned(),
        id: body.particles().id[index],
        position: body.motion().position[index].iter().copied().collect(),
        step: scene.step() + 1,
        time: scene.time(),
    }
}

/// Refuses to step to a time that is not after the present.
pub(crate) fn check_until<const D: usize>(scene: &Scene<D>, until: f64) -> Result<(), SolveError> {
    if until > scene.time() {
        return Ok(());
    }
    Err(SolveError::Setting {
        setting: "until",
        value: until,
        permitted: "after the scene's time",
    })
}

/// Refuses what a mesh cannot do, and a mesh on another grid than its own.
pub(crate) fn check_mesh<S: Shape<D>, const D: usize>(
    grid: &Grid<D>,
    shape: &S,
    scene: &Scene<D>,
) -> Result<(), SolveError> {
    let refuse = |what| Err(SolveError::Unsupported { what });
    if !shape.goes_with(grid) {
        return refuse("a mesh on another grid than its own");
    }
    if shape.patches().is_some() && !scene.cracks().is_empty() {
        return refuse("a crack on a mesh");
    }
    if shape.patches().is_some() && !scene.contacts().is_empty() {
        return refuse("contact between bodies on a mesh");
    }
    Ok(())
}

/// Refuses numbers that are not finite, once, before the first step.
pub(crate) fn check_columns<const D: usize>(scene: &Scene<D>) -> Result<(), SolveError> {
    if scene.particle_count() == 0 {
        return Err(SolveError::Empty);
    }
    for body in scene.bodies() {
        let particles = body.particles();
        let motion = &particles.motion;
        for (i, &id) in particles.id.iter().enumerate() {
            let finite = |v: &SVector<f64, D>| v.iter().all(|c| c.is_finite());
            let field = if !finite(&motion.position[i]) {
                "position"
            } else if !finite(&motion.velocity[i]) {
                "velocity"
            } else if !motion.deformation_gradient[i].iter().all(|c| c.is_finite()) {
                "deformation_gradient"
            } else if !motion.stress[i].is_finite() {
                "stress"
            } else if !particles.mass[i].is_finite() {
                "mass"
            } else if !particles.volume[i].is_finite() {
                "volume"
            } else {
                continue;
            };
            return Err(SolveError::NotFinite {
                body: body.name().to_owned(),
                id,
                field,
            });
        }
    }
    Ok(())
}
