//! Artificial viscosity: what it adds to the stress does the work that is booked.

#![allow(clippy::panic, clippy::print_stdout, clippy::unwrap_used)]

use fissure_materials::{Hencky, Isotropic, Matrix3};
use fissure_particles::{Block, MotionSlices, MotionSlicesMut, Spacing};
use fissure_scene::{ByRun, Kinematics, Plane, Run, RunKernel, Scene, SweepSettings, Viscosity};
use fissure_tensor::{Band, Sym};

/// Gives every particle one deformation gradient; the thickness is the law's in plane stress.
fn strain(f: Matrix3<f64>) -> impl RunKernel<2> {
    ByRun(
        move |_: &Run, old: &MotionSlices<'_, 2>, new: &mut MotionSlicesMut<'_, 2>| {
            for row in 0..old.len() {
                new.deformation_gradient[row] = f;
                new.deformation_gradient[row].m33 = old.deformation_gradient[row].m33;
            }
            Ok(())
        },
    )
}

/// Stress, deformation gradient and viscous work of a particle after a strain at rest and a small
/// step from there.
fn squeezed(plane: Plane, viscosity: Option<Viscosity>) -> (Sym, [Matrix3<f64>; 2], f64) {
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e7,
        poisson: 0.35,
    };
    let mut scene = Scene::plane(plane);
    let block = Block::new([0.0, 0.0], [1.0, 0.1]);
    scene
        .fill("bar", Hencky { elastic }, &block, &Spacing(0.1))
        .unwrap();
    let count = scene.particle_count() as u32;
    let runs = [Run {
        start: 0,
        end: count,
        window: 0,
    }];
    let depth = match scene.kinematics() {
        Kinematics::PlaneStrain { thickness } | Kinematics::PlaneStress { thickness } => thickness,
        _ => 1.0,
    };
    let body = &mut scene.bodies_mut()[0];
    let mut settings = SweepSettings {
        dt: 1e-5,
        band: Band::Uniform(0.1),
        viscosity: None,
        simd: fissure_tensor::simd::Simd::widest(),
        in_place: false,
    };
    let first = Matrix3::new(0.9, 0.02, 0.0, 0.01, 1.1, 0.0, 0.0, 0.0, 1.0);
    body.sweep(&runs, &strain(first), &settings).unwrap();
    body.commit().unwrap();
    let old = body.motion().deformation_gradient[0];
    settings.viscosity = viscosity;
    let mut second = first;
    second.m11 -= 1e-7;
    second.m21 += 3e-7;
    let totals = body.sweep(&runs, &strain(second), &settings).unwrap();
    body.commit().unwrap();
    let motion = body.motion();
    let new = motion.deformation_gradient[0];
    (motion.stress[0], [old, new], totals.viscous / (0.1 * depth))
}

#[test]
fn the_booked_work_is_that_of_the_added_stress_in_plane_strain_and_stress() {
    let viscosity = Viscosity {
        linear: 0.3,
        quadratic: 1.5,
        length: 0.05,
    };
    for plane in [
        Plane::Strain { thickness: 0.2 },
        Plane::Stress { thickness: 0.2 },
    ] {
        let (with, [old, new], booked) = squeezed(plane, Some(viscosity));
        let (without, ..) = squeezed(plane, None);
        let added = (with - without).to_matrix();
        assert!(added.m11 < -1.0 && (added.m11 - added.m22).abs() <= 1e-8 * added.m11.abs());
        let sheet = matches!(plane, Plane::Stress { .. });
        assert!((new.m33 != 1.0) == sheet && (added.m33 == 0.0) == sheet);
        // P : ΔF of the added stress with P = J σ F⁻ᵀ.
        let nominal = added * new.try_inverse().unwrap().transpose() * new.determinant();
        let exact = nominal.dot(&(new - old));
        let error = (booked / exact - 1.0).abs();
        println!("{plane:?}: {booked:e} J/m³, off by {error:.1e}");
        assert!(error <= 1e-5, "{plane:?}: {booked:e} for {exact:e}");
    }
}
