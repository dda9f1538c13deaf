//! Bodies with fields of their own but no contact between them move as with one field.

use fissure::nalgebra::Vector2;
use fissure::prelude::*;
use fissure_tests::{Build, Case, ShapeKind, Space, Table, largest_difference, rubber};

const H: f64 = 0.125;

/// Two bodies side by side; with `own` fields through contacts with a third one far away.
fn scene(own: bool) -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = |x: f64| Block::new([x, 0.02], [x + 3.0 * H, 0.02 + 2.0 * H]);
    scene
        .fill("left", rubber(), &block(0.0), &Spacing(H / 2.0))
        .unwrap()
        .fill("right", rubber(), &block(3.0 * H), &Spacing(H / 2.0))
        .unwrap()
        .fill("far", rubber(), &block(20.0 * H), &Spacing(H / 2.0))
        .unwrap()
        .set_velocity("right", |x| Vector2::new(0.5 * x[1], 1.0 - x[0]))
        .unwrap();
    if own {
        for name in ["left", "right"] {
            scene
                .contact(&format!("{name}-far"), name, "far", ContactLaw::Stick)
                .unwrap();
        }
    }
    scene
}

#[test]
fn a_bond_is_one_field() {
    for (transfer, update) in [
        (Transfer::Flip { pic: 0.1 }, StressUpdate::Musl),
        (Transfer::Flip { pic: 0.0 }, StressUpdate::First),
        (Transfer::Apic, StressUpdate::Last),
        (Transfer::Xpic { order: 3 }, StressUpdate::Musl),
        (Transfer::Fmpm { order: 3 }, StressUpdate::Last),
    ] {
        let case = Case {
            space: Space::Plane,
            shape: ShapeKind::Bspline2,
            transfer,
            update,
        };
        let [one, two] = [false, true].map(|own| {
            let mut scene = scene(own);
            let grid = Grid::over([-4.0 * H; 2], [30.0 * H, 8.0 * H], H).unwrap();
            let mut solver = Table::solver(case.shape, grid, case.settings(0.3)).unwrap();
            for _ in 0..100 {
                solver.step(&mut scene, f64::INFINITY).unwrap();
            }
            scene
        });
        for name in ["left", "right"] {
            let [a, b] =
                [&one, &two].map(|scene| scene.body(name).unwrap().motion().position.to_vec());
            let error = largest_difference(&a, &b);
            println!("{case:?} {name}: {error:.1e} m");
            assert!(error <= 1e-12, "{case:?} {name}: {error:e}");
        }
        assert!(
            two.energy().worst_balance <= 1e-11,
            "{case:?}: {}",
            two.energy().worst_balance
        );
    }
}
