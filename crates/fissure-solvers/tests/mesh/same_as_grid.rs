//! Of squares along the axes a mesh is a grid with linear functions.

use fissure_grid::{Grid, QuadMesh, shape};
use fissure_materials::{Decohesive, Isotropic, NeoHookean, Normal, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Constant, Hold, Plane, Scene, Solver};
use fissure_solvers::{
    Averaging, Explicit, ExplicitSettings, Implicit, ImplicitSettings, QuasiStatic,
    QuasiStaticSettings, StressUpdate, Transfer,
};
use nalgebra::{Vector2, vector};

use crate::meshes::{difference, mapped};

const H: f64 = 0.125;

fn grid() -> Grid<2> {
    Grid::over([0.0, 0.0], [24.0 * H, 16.0 * H], H).unwrap()
}

fn mesh() -> QuadMesh {
    mapped(24, 16, |i, j| Vector2::new(i, j) * H)
}

/// A rubber block that turns, stretches and flies, beside one of concrete that tears.
fn flying() -> Scene<2> {
    let rubber = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let concrete = Decohesive {
        elastic: Isotropic {
            density: 1000.0,
            young: 1e6,
            poisson: 0.2,
        },
        strength: 1e4,
        toughness: 100.0,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = |x: f64| Block::new([x, 0.5], [x + 0.75, 1.25]);
    let spacing = Spacing(0.5 * H);
    scene.fill("rubber", rubber, &block(0.5), &spacing).unwrap();
    scene
        .fill("concrete", concrete, &block(1.75), &spacing)
        .unwrap();
    let turn = |x: &Vector2<f64>| vector![2.0 - 0.3 * x.y, 1.0 + 0.3 * x.x * x.y];
    scene.set_velocity("rubber", turn).unwrap();
    let tear = |x: &Vector2<f64>| vector![-2.0 + 1.5 * (x.x - 2.0), 1.0];
    scene.set_velocity("concrete", tear).unwrap();
    scene
}

#[test]
fn explicit_steps() {
    let transfers = [
        Transfer::Flip { pic: 0.1 },
        Transfer::Pic,
        Transfer::Apic,
        Transfer::Xpic { order: 3 },
        Transfer::Fmpm { order: 2 },
    ];
    let updates = [StressUpdate::First, StressUpdate::Last, StressUpdate::Musl];
    for transfer in transfers {
        for stress_update in updates {
            let settings = ExplicitSettings {
                transfer,
                stress_update,
                mass_cutoff: 1e-3,
                ..ExplicitSettings::default()
            };
            let (mut one, mut other) = (flying(), flying());
            let mut on_grid = Explicit::new(grid(), shape::Linear, settings).unwrap();
            let mesh = mesh();
            assert_eq!(mesh.grid(), grid());
            let mut on_mesh =
                Explicit::new(mesh.grid(), shape::Isoparametric(mesh), settings).unwrap();
            // Without MUSL, and with APIC, a node at the rim of a body soon runs off, on a grid as well.
            let lasts = stress_update == StressUpdate::Musl && transfer != Transfer::Apic;
            for _ in 0..if lasts { 60 } else { 20 } {
                let a = on_grid.step(&mut one, f64::INFINITY).unwrap();
                let b = on_mesh.step(&mut other, f64::INFINITY).unwrap();
                assert!((a.dt / b.dt - 1.0).abs() <= 1e-10);
            }
            // The particles have crossed faces, and the concrete has torn.
            assert!(one.time() * 2.0 > 0.25 * H);
            assert!(!lasts || one.energy().dissipated > 0.0);
            let apart = difference(&one, &other, (H, 2.0, 1e4));
            println!("explicit, {transfer:?}, {stress_update:?}: {apart:.1e}");
            let bound = if lasts { 1e-11 } else { 1e-8 };
            assert!(apart <= bound, "{transfer:?} {stress_update:?}: {apart}");
        }
    }
}

/// A thick ring that is opened from within, and a block that is pulled and crushed.
fn held(axisymmetric: bool) -> Scene<2> {
    let law = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let mut scene = if axisymmetric {
        Scene::axisymmetric()
    } else {
        Scene::plane(Plane::Strain { thickness: 0.5 })
    };
    let block = Block::new([4.0 * H, 4.0 * H], [16.0 * H, 12.0 * H]);
    scene.fill("block", law, &block, &Spacing(0.5 * H)).unwrap();
    let low = Hold::All(vector![0.0, 1.0]);
    scene
        .hold("low", "block", |x| x.y < 5.0 * H, low, Constant(0.0))
        .unwrap();
    let inner = Hold::Component(vector![1.0, 0.0]);
    scene
        .hold("inner", "block", |x| x.x < 5.0 * H, inner, Constant(0.02))
        .unwrap();
    scene
        .force(
            "top",
            "block",
            |x| x.y > 11.0 * H,
            |t| vector![3e3, -2e3] * t,
        )
        .unwrap();
    scene
}

#[test]
fn quasi_static_steps() {
    let one_strain = Averaging::Strain { hourglass: 0.1 };
    for (axisymmetric, averaging) in [
        (false, Averaging::None),
        (true, Averaging::None),
        (false, Averaging::Volume),
        (false, one_strain),
    ] {
        let settings = QuasiStaticSettings {
            averaging,
            step: 0.25,
            tolerance: 1e-12,
            ..QuasiStaticSettings::default()
        };
        let (mut one, mut other) = (held(axisymmetric), held(axisymmetric));
        let mesh = mesh();
        let mut on_grid = QuasiStatic::new(grid(), shape::Linear, settings).unwrap();
        let mut on_mesh =
            QuasiStatic::new(mesh.grid(), shape::Isoparametric(mesh), settings).unwrap();
        for _ in 0..4 {
            let a = on_grid.step(&mut one, 1.0).unwrap();
            let b = on_mesh.step(&mut other, 1.0).unwrap();
            assert_eq!(a.iterations, b.iterations);
            for (p, q) in a.reactions.iter().zip(&b.reactions) {
                assert!((p - q).norm() <= 1e-8 * p.norm());
            }
        }
        let energies = [one.energy(), other.energy()];
        assert!(energies[0].stored > 1.0);
        assert!((energies[0].stored / energies[1].stored - 1.0).abs() <= 1e-10);
        let apart = difference(&one, &other, (H, H, 1e4));
        println!(
            "quasi-static, axisymmetric {axisymmetric}, {averaging:?}: {apart:.1e}, {:.3} J",
            energies[0].stored
        );
        assert!(apart <= 1e-11, "{apart}");
    }
}

#[test]
fn implicit_steps() {
    let settings = ImplicitSettings {
        step: 5e-3,
        tolerance: 1e-12,
        ..ImplicitSettings::default()
    };
    for axisymmetric in [false, true] {
        let (mut one, mut other) = (held(axisymmetric), held(axisymmetric));
        let mesh = mesh();
        let mut on_grid = Implicit::new(grid(), shape::Linear, settings).unwrap();
        let mut on_mesh = Implicit::new(mesh.grid(), shape::Isoparametric(mesh), settings).unwrap();
        for _ in 0..10 {
            on_grid.step(&mut one, 1.0).unwrap();
            on_mesh.step(&mut other, 1.0).unwrap();
        }
        assert!(one.energy().kinetic > 0.0);
        let apart = difference(&one, &other, (H, 1.0, 1e4));
        println!("implicit, axisymmetric {axisymmetric}: {apart:.1e}");
        assert!(apart <= 1e-11, "{apart}");
    }
}
