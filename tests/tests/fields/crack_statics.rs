//! Cracks as lines in equilibrium: what crosses a closed one, and tips between nodes.

use fissure::nalgebra::Vector2;
use fissure::prelude::*;

const H: f64 = 0.125;
const YOUNG: f64 = 1e6;

fn stiff() -> Isotropic {
    Isotropic {
        density: 1000.0,
        young: YOUNG,
        poisson: 0.3,
    }
}

/// Reaction of a bar, cut aslant or not, stretched by a part `strain` of its length.
fn reaction(cut: Option<ContactLaw>, strain: f64) -> Vector2<f64> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let length = 16.0 * H;
    scene
        .fill(
            "bar",
            stiff(),
            &Block::new([0.0, 0.0], [length, 4.0 * H]),
            &Spacing(H / 2.0),
        )
        .unwrap();
    if let Some(contact) = cut {
        let ends = CrackSettings {
            first: EndState::Mouth,
            last: EndState::Mouth,
            contact,
        };
        let line = [[6.93 * H, -H], [9.13 * H, 5.0 * H]];
        scene.crack("cut", &line, ends).unwrap();
    }
    let along = Hold::Component(Vector2::x());
    scene
        .hold("left", "bar", |x| x.x < 0.5 * H, along, Constant(0.0))
        .unwrap()
        .hold(
            "right",
            "bar",
            move |x| x.x > length - 0.5 * H,
            along,
            Constant(strain * length),
        )
        .unwrap()
        .hold(
            "floor",
            "bar",
            |x| x.y < 0.5 * H,
            Hold::Component(Vector2::y()),
            Constant(0.0),
        )
        .unwrap();
    let grid = Grid::over([-8.0 * H, -6.0 * H], [24.0 * H, 10.0 * H], H).unwrap();
    let settings = QuasiStaticSettings {
        step: 0.5,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings).unwrap();
    run(&mut scene, &mut solver, Until::Time(1.0), &mut []).unwrap();
    assert_eq!(scene.step(), 2);
    scene.reaction("right").unwrap()
}

#[test]
fn a_closed_cut_in_equilibrium_lets_pressure_through() {
    let whole = reaction(None, -1e-4).x;
    for (contact, error) in [
        (ContactLaw::Stick, 2e-3),
        // Held by friction: tan 20° < 1.
        (ContactLaw::Coulomb { friction: 1.0 }, 2e-3),
    ] {
        let cut = reaction(Some(contact), -1e-4).x;
        assert!(
            (cut / whole - 1.0).abs() < error,
            "{contact:?}: {cut} of {whole}"
        );
    }
    // Without friction the upper part slides up the slope and is pressed less: by σ_n/σ of the slope, about cos² 20°,
    // where the floor lets it.
    let slipping = reaction(Some(ContactLaw::Frictionless), -1e-4).x / whole;
    assert!(slipping > 0.9 && slipping < 0.98, "{slipping}");
}

/// Work that a plate with an edge crack takes under a load, J.
fn work(tip: f64, y: f64) -> f64 {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let (width, half) = (16.0 * H, 16.0 * H);
    let mouth = CrackSettings {
        first: EndState::Mouth,
        ..CrackSettings::default()
    };
    let up = Vector2::new(0.0, 1e-4 * YOUNG * width);
    scene
        .fill(
            "plate",
            stiff(),
            &Block::new([0.0, -half], [width, half]),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .crack("edge", &[[-H, y], [tip, y]], mouth)
        .unwrap()
        .force("top", "plate", move |x| x.y > half - 0.5 * H, move |_| up)
        .unwrap()
        .force(
            "bottom",
            "plate",
            move |x| x.y < -half + 0.5 * H,
            move |_| -up,
        )
        .unwrap();
    let grid = Grid::over([-H, -half - H], [width + H, half + H], H).unwrap();
    let mut solver = QuasiStatic::new(grid, shape::Linear, QuasiStaticSettings::default()).unwrap();
    run(&mut scene, &mut solver, Until::Time(1.0), &mut []).unwrap();
    let e = scene.energy();
    // The whole load from the start: half its work is stored, in the body and in the springs at the tip.
    let kept = e.stored + e.contact;
    assert!((2.0 * kept / e.external - 1.0).abs() < 3e-3, "{e:?}");
    kept
}

/// While a tip crosses a cell the compliance grows evenly: nodes are let go little by little. Along a line of nodes, that
/// is; between lines it grows in every quarter of a cell, by up to three times as much in one as in another.
#[test]
fn a_tip_may_lie_anywhere_between_nodes() {
    for (y, least, most) in [(0.0, 0.8, 1.5), (0.5 * H, 0.4, 2.5), (0.3 * H, 0.4, 2.5)] {
        let tips: Vec<f64> = (0..=8).map(|k| (7.0 + 0.25 * f64::from(k)) * H).collect();
        let works: Vec<f64> = tips.iter().map(|tip| work(*tip, y)).collect();
        let gains: Vec<f64> = works.windows(2).map(|pair| pair[1] - pair[0]).collect();
        println!("y = {y}: {gains:?}");
        for pair in gains.windows(2) {
            let ratio = pair[1] / pair[0];
            assert!((least..most).contains(&ratio), "y = {y}: {gains:?}");
        }
        // A whole cell of growth costs the same wherever in a cell the crack lies.
        let cells = [&gains[..4], &gains[4..]].map(|cell| cell.iter().sum::<f64>());
        let growth = cells[1] / cells[0];
        assert!((1.6..1.8).contains(&growth), "y = {y}: {gains:?}");
    }
}
