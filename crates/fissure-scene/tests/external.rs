//! A solver can drive a law with a field of its own, particle by particle.

use fissure_materials::{Increment, Isotropic, Material, MaterialError, Matrix3, Response, Scale};
use fissure_particles::{Block, MotionSlices, MotionSlicesMut, Spacing};
use fissure_scene::{
    External, KernelFailure, Plane, Run, RunConstants, RunKernel, Scene, SweepSettings,
    WindowKernel,
};
use fissure_tensor::Band;

/// Elasticity that a damage from outside degrades.
struct Degraded(Isotropic);

impl Material for Degraded {
    type State = ();
    const OBJECTIVE: bool = false;
    const HYPERELASTIC: bool = false;

    fn density(&self) -> f64 {
        self.0.density
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &(), scale: &Scale) -> f64 {
        self.0.wave_speed(f, state, scale)
    }

    fn update(&self, increment: &Increment, old: &()) -> Result<Response<()>, MaterialError> {
        let sound = self.0.update(increment, old)?;
        Ok(Response {
            stress: sound.stress * (1.0 - increment.external.damage),
            ..sound
        })
    }
}

/// Stretches every particle alike under a damage that varies along the bar.
struct Field {
    damage: Vec<f64>,
}

impl RunKernel<2> for Field {
    fn on_window(
        &self,
        _window: u32,
        work: &mut dyn FnMut(&mut dyn WindowKernel<2>) -> Result<(), KernelFailure>,
    ) -> Result<(), KernelFailure> {
        work(&mut Stretch(self))
    }
}

struct Stretch<'a>(&'a Field);

impl WindowKernel<2> for Stretch<'_> {
    fn gather(
        &mut self,
        _run: &Run,
        _constants: &RunConstants<'_>,
        _old: &MotionSlices<'_, 2>,
        new: &mut MotionSlicesMut<'_, 2>,
    ) -> Result<(), KernelFailure> {
        for f in new.deformation_gradient.iter_mut() {
            *f = Matrix3::identity();
            f.m11 = 1.001;
        }
        Ok(())
    }

    fn sets_external(&self) -> bool {
        true
    }

    fn external(&self, run: &Run, row: usize) -> External {
        External {
            damage: self.0.damage[run.start as usize + row],
            ..External::default()
        }
    }
}

#[test]
fn a_damage_field_degrades_each_particle_by_its_own_value() {
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.25,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill(
            "bar",
            Degraded(elastic),
            &Block::new([0.0, 0.0], [1.0, 0.1]),
            &Spacing(0.05),
        )
        .unwrap();
    let count = scene.particle_count() as u32;
    let runs: Vec<Run> = (0..count)
        .step_by(7)
        .map(|start| Run {
            start,
            end: (start + 7).min(count),
            window: 0,
        })
        .collect();
    let field = Field {
        damage: (0..count)
            .map(|i| f64::from(i) / f64::from(count))
            .collect(),
    };
    let settings = SweepSettings {
        dt: 1.0,
        band: Band::Uniform(0.1),
        viscosity: None,
        simd: fissure_tensor::simd::Simd::widest(),
        in_place: false,
    };
    let body = &mut scene.bodies_mut()[0];
    body.sweep(&runs, &field, &settings).unwrap();
    body.commit().unwrap();
    let sound = elastic.p_wave_modulus() * 1e-3;
    for (stress, damage) in body.motion().stress.iter().zip(&field.damage) {
        let error = (stress.xx() - sound * (1.0 - damage)).abs() / sound;
        assert!(error <= 1e-12, "damage {damage}: {error:e}");
    }
}
