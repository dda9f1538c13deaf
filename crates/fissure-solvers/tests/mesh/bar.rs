//! The bar of Sanchez 2010, ch. 5, on a mesh along its own axis: no angle against it, and no bias.

use fissure_grid::{Grid, QuadMesh, Shape, shape};
use fissure_materials::{Decohesive, Isotropic, Normal, Scale, Vector3, softening};
use fissure_particles::Seeds;
use fissure_scene::{Constant, Hold, Plane, Scene, Solver};
use fissure_solvers::{QuasiStatic, QuasiStaticSettings};
use nalgebra::{Matrix2, Rotation2, Vector2};

use crate::meshes::mapped;

const H: f64 = 0.01;
const LENGTH: f64 = 0.2;
const WIDTH: f64 = 0.06;
const STRENGTH: f64 = 2.7e6;
const TOUGHNESS: f64 = 61.35;
/// Columns of elements beyond either end, for the grips and to move into.
const BEYOND: usize = 4;

/// Load by elongation, and what was dissipated.
struct Pulled {
    loads: Vec<f64>,
    dissipated: f64,
}

/// Pulls the bar to 1.1 critical openings; `columns` are the lengths of the columns of elements between the ends, that in the
/// middle is weak, `angle` is that of the bar.
fn pull<S: Shape<2>>(
    grid: Grid<2>,
    shape: S,
    columns: &[f64],
    angle: f64,
    normal: Option<Normal>,
) -> Pulled {
    let turn = Rotation2::new(angle);
    let axis = turn * Vector2::x();
    let law = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: STRENGTH,
        toughness: TOUGHNESS,
        softening: softening::Linear,
        normal: normal.unwrap_or(Normal::Prescribed(Vector3::new(axis.x, axis.y, 0.0))),
    };
    let mut seeds = Seeds {
        position: Vec::new(),
        volume: Vec::new(),
        half_edges: turn.matrix() * Matrix2::identity() * (0.25 * H),
    };
    let rows = (WIDTH / H).round() as usize;
    let mut weak = Vec::new();
    let mut from = 0.0;
    for (column, &length) in columns.iter().enumerate() {
        for (i, j) in (0..2).flat_map(|i| (0..2 * rows).map(move |j| (i, j))) {
            let at = Vector2::new(
                from + (0.25 + 0.5 * f64::from(i)) * length,
                (j as f64 + 0.5) * 0.5 * H,
            );
            seeds.position.push(turn * at);
            seeds.volume.push(0.25 * H * length);
            if column == columns.len() / 2 {
                weak.push(turn * at);
            }
        }
        from += length;
    }
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    let scale = Scale {
        strength: 0.9,
        ..Scale::default()
    };
    scene
        .add_body("bar", law, seeds)
        .unwrap()
        .set_scale("bar", |x| weak.contains(x), scale)
        .unwrap();
    let line = |x: f64| -> Vec<Vector2<f64>> {
        let nodes = (0..=rows).map(|j| turn * Vector2::new(x, j as f64 * H));
        nodes.collect()
    };
    let hold = Hold::Component(axis);
    scene
        .hold_places("left", &line(0.0), hold, Constant(0.0))
        .unwrap()
        .hold_places("right", &line(LENGTH), hold, Constant(1.0))
        .unwrap();
    // Beyond the end, since the bar moves on.
    let grip = line(LENGTH + H);
    scene
        .hold_places("beyond", &grip, hold, Constant(1.0))
        .unwrap();
    let end = 1.1 * 2.0 * TOUGHNESS / (0.9 * STRENGTH);
    let steps = 60;
    let settings = QuasiStaticSettings {
        step: end / f64::from(steps),
        tolerance: 1e-10,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid, shape, settings).unwrap();
    let mut loads = Vec::new();
    while scene.time() < end {
        let report = solver.step(&mut scene, end).unwrap();
        loads.push((report.reactions[1] + report.reactions[2]).dot(&axis));
    }
    Pulled {
        loads,
        dissipated: scene.energy().dissipated,
    }
}

/// A mesh along the bar with these columns between its ends.
fn along(columns: &[f64], angle: f64) -> QuadMesh {
    let mut x = vec![-(BEYOND as f64) * H];
    let all = std::iter::repeat_n(&H, BEYOND)
        .chain(columns)
        .chain(std::iter::repeat_n(&H, BEYOND));
    for length in all {
        x.push(x[x.len() - 1] + length);
    }
    let rows = (WIDTH / H).round() as usize + 2;
    mapped(x.len() - 1, rows, |i, j| {
        let y = (j - 1.0) * H;
        Rotation2::new(angle) * Vector2::new(x[i as usize], y)
    })
}

fn equal() -> Vec<f64> {
    vec![H; (LENGTH / H).round() as usize]
}

fn on_grid(normal: Option<Normal>) -> Pulled {
    let reach = BEYOND as f64 * H;
    let grid = Grid::over([-reach, -H], [LENGTH + reach, WIDTH + H], H).unwrap();
    pull(grid, shape::Linear, &equal(), 0.0, normal)
}

fn on_mesh(mesh: QuadMesh, columns: &[f64], angle: f64, normal: Option<Normal>) -> Pulled {
    pull(
        mesh.grid(),
        shape::Isoparametric(mesh),
        columns,
        angle,
        normal,
    )
}

/// Largest difference of two curves over the peak.
fn apart(a: &Pulled, b: &Pulled) -> f64 {
    assert_eq!(a.loads.len(), b.loads.len());
    let peak = a.loads.iter().copied().fold(0.0, f64::max);
    let pairs = a.loads.iter().zip(&b.loads);
    pairs.map(|(a, b)| (a - b).abs() / peak).fold(0.0, f64::max)
}

/// The curve and the energy at 15°, 30° and 45° are those at 0° on the grid, and those are right.
#[test]
fn a_mesh_along_the_bar_knows_no_angle() {
    for normal in [None, Some(Normal::Rankine)] {
        let straight = on_grid(normal);
        let energy = TOUGHNESS * WIDTH * 0.06;
        assert!(
            (straight.dissipated / energy - 1.0).abs() <= 2e-3,
            "{}",
            straight.dissipated / energy
        );
        let peak = straight.loads.iter().copied().fold(0.0, f64::max);
        let exact = 0.9 * STRENGTH * WIDTH * 0.06;
        assert!((peak / exact - 1.0).abs() <= 0.03, "{}", peak / exact);
        for degrees in [0.0_f64, 15.0, 30.0, 45.0] {
            let angle = degrees.to_radians();
            let turned = on_mesh(along(&equal(), angle), &equal(), angle, normal);
            let apart = apart(&straight, &turned);
            let of_energy = (turned.dissipated / straight.dissipated - 1.0).abs();
            println!("{degrees}°: load {apart:.1e}, energy {of_energy:.1e}");
            assert!(
                apart <= 1e-9 && of_energy <= 1e-11,
                "{degrees}°: {apart} {of_energy}"
            );
        }
    }
}

/// Columns of unlike lengths: each particle has the band of its own element.
#[test]
fn the_energy_does_not_depend_on_the_element_that_breaks() {
    for middle in [0.6, 1.0, 1.7] {
        let mut columns = equal();
        let (count, half) = (columns.len(), columns.len() / 2);
        // The others make up for it.
        let rest = (count as f64 - middle) / (count as f64 - 1.0);
        columns.iter_mut().for_each(|length| *length *= rest);
        columns[half] = middle * H;
        let angle = 0.3;
        let pulled = on_mesh(along(&columns, angle), &columns, angle, None);
        let energy = TOUGHNESS * WIDTH * 0.06;
        println!(
            "element of {middle} h: {:.5} of G_f A",
            pulled.dissipated / energy
        );
        assert!(
            (pulled.dissipated / energy - 1.0).abs() <= 1e-5,
            "{middle}: {}",
            pulled.dissipated / energy
        );
    }
}
