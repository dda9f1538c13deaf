//! Seeding: volumes, counts, alignment, and what is refused.

use std::f64::consts::{FRAC_PI_6, PI};

use fissure_particles::{
    Ball, Block, Compose, HalfSpace, InCell, Particles, PerCell, Polygon, Region, RegionError,
    SeedError, Seeding, Spacing, Turned, Where,
};
use nalgebra::{Matrix2, Vector2, Vector3};
use proptest::prelude::*;

fn close(value: f64, expected: f64, relative: f64) {
    // Written so that NaN fails.
    assert!(
        (value - expected).abs() <= relative * expected.abs(),
        "{value} is not {expected}"
    );
}

#[test]
fn an_aligned_block_is_filled_exactly() {
    let plate = Spacing(2.5e-3)
        .seed(&Block::new([0.0, 0.0], [0.20, 0.06]))
        .unwrap();
    assert_eq!(plate.len(), 80 * 24);
    close(plate.total_volume(), 0.20 * 0.06, 1e-12);
    assert!((plate.position[0] - Vector2::repeat(1.25e-3)).norm() < 1e-17);
    assert_eq!(plate.half_edges, Matrix2::identity() * 1.25e-3);

    let cube = Spacing(0.1)
        .seed(&Block::new([-0.3, 0.1, 7.0], [0.3, 0.5, 7.2]))
        .unwrap();
    assert_eq!(cube.len(), 6 * 4 * 2);
    close(cube.total_volume(), 0.6 * 0.4 * 0.2, 1e-12);

    let bar = Spacing(0.5).seed(&Block::new([1.0], [4.0])).unwrap();
    assert_eq!((bar.len(), bar.total_volume()), (6, 3.0));
}

#[test]
fn a_spacing_that_does_not_divide_the_block_stays_what_it_is() {
    let seeds = Spacing(0.3).seed(&Block::new([0.0], [1.0])).unwrap();
    assert_eq!(seeds.len(), 3);
    for (x, expected) in seeds.position.iter().zip([0.15, 0.45, 0.75]) {
        close(x[0], expected, 1e-15);
    }
    close(seeds.total_volume(), 0.9, 1e-15);
}

#[test]
fn particles_per_cell_lie_at_cell_uniform_places_wherever_the_region_lies() {
    let rule = PerCell {
        origin: [0.1, -0.2],
        cell: 0.5,
        per_axis: 2,
    };
    let region = Block::new([0.1 - 0.5, 0.3], [0.1 + 1.0, 1.3]);
    let seeds = rule.seed(&region).unwrap();
    assert_eq!(seeds.len(), 6 * 4);
    close(seeds.total_volume(), 1.5, 1e-14);
    for x in &seeds.position {
        for (value, origin) in x.iter().zip(rule.origin) {
            let place = ((value - origin) / rule.cell).rem_euclid(1.0);
            let nearest = (place - 0.25).abs().min((place - 0.75).abs());
            assert!(nearest < 1e-13, "{place}");
        }
    }
}

#[test]
fn adjoining_blocks_share_their_lattice_and_lose_no_place() {
    // The seam runs through places of the lattice.
    let rule = PerCell {
        origin: [0.0, 0.0],
        cell: 0.1,
        per_axis: 1,
    };
    for seam in [0.35, 0.45, 0.65, 0.7] {
        let left = rule.seed(&Block::new([0.0, 0.0], [seam, 1.0])).unwrap();
        let right = rule.seed(&Block::new([seam, 0.0], [1.0, 1.0])).unwrap();
        assert_eq!(left.len() + right.len(), 100, "seam at {seam}");
    }
}

#[test]
fn a_turned_filling_has_as_many_particles_of_the_same_volume() {
    let block = Block::new([0.0, 0.0], [1.0, 0.25]);
    let (angle, centre) = (FRAC_PI_6, [0.3, 0.1]);
    let straight = Spacing(0.05).seed(&block).unwrap();
    let turned = Turned {
        inner: Spacing(0.05),
        angle,
        centre,
    }
    .seed(&block)
    .unwrap();
    assert_eq!(turned.len(), straight.len());
    assert_eq!(turned.volume, straight.volume);
    let region = block.rotated(angle, centre);
    assert!(turned.position.iter().all(|x| region.contains(x)));
    let (edge, half) = (turned.half_edges.column(0), 0.025);
    close(edge[0], half * angle.cos(), 1e-14);
    close(edge[1], half * angle.sin(), 1e-14);
    close(4.0 * turned.half_edges.determinant(), 0.05 * 0.05, 1e-13);
    let shortest = (turned.position[1] - turned.position[0]).norm();
    close(shortest, 0.05, 1e-13);
}

#[test]
fn aligned_particles_fill_a_round_region_better_the_finer_they_are() {
    for (spacing, error) in [(0.1, 0.03), (0.01, 0.002)] {
        let disc = Spacing(spacing).seed(&Ball::new([0.0, 0.0], 1.0)).unwrap();
        close(disc.total_volume(), PI, error);
    }
}

#[test]
fn clipping_is_exact_where_the_edge_lies_between_samples() {
    let rule = |clip| InCell {
        origin: [0.0, 0.0],
        cell: 1.0,
        per_axis: 2,
        clip,
    };
    // The right-hand sub-cells reach half a cell, of which three quarters lie inside.
    let region = Block::new([0.0, 0.0], [0.875, 1.0]);
    let clipped = rule(true).seed(&region).unwrap();
    assert_eq!(clipped.volume, [0.25, 0.1875, 0.25, 0.1875]);
    assert_eq!(clipped.total_volume(), 0.875);
    assert_eq!(rule(false).seed(&region).unwrap().volume, [0.25; 4]);

    let cube = Block::new([0.0, 0.0, 0.0], [0.875, 1.0, 1.0]);
    let rule = InCell {
        origin: [0.0; 3],
        cell: 1.0,
        per_axis: 2,
        clip: true,
    };
    close(rule.seed(&cube).unwrap().total_volume(), 0.875, 1e-15);
}

#[test]
fn clipped_volumes_in_a_turned_region_are_short_by_about_an_eighth_of_the_edge_layer() {
    let (length, height, spacing) = (1.0, 0.4, 0.02);
    let region = Block::new([0.0, 0.0], [length, height]).rotated(0.4, [0.0, 0.0]);
    let rule = |clip| InCell {
        origin: [0.0, 0.0],
        cell: 2.0 * spacing,
        per_axis: 2,
        clip,
    };
    let (whole, clipped) = (
        rule(false).seed(&region).unwrap(),
        rule(true).seed(&region).unwrap(),
    );
    assert_eq!(whole.position, clipped.position);
    assert!(whole.position.iter().all(|x| region.contains(x)));
    close(whole.total_volume(), length * height, 0.01);
    let layer = 2.0 * (length + height) * spacing;
    let short = (length * height - clipped.total_volume()) / layer;
    assert!((0.08..0.16).contains(&short), "{short}");
    assert!(
        clipped
            .volume
            .iter()
            .zip(&whole.volume)
            .all(|(c, w)| *c > 0.0 && c <= w)
    );
}

proptest! {
    #[test]
    fn a_clipped_fraction_keeps_the_documented_error(angle in -PI..PI, depth in 0.0_f64..0.5) {
        // One sub-cell, the unit square about the origin, cut by a line at `depth` from its centre.
        let normal = [angle.cos(), angle.sin()];
        let point = [depth * normal[0], depth * normal[1]];
        let square = Block::new([-0.5, -0.5], [0.5, 0.5]);
        let rule = InCell { origin: [-0.5, -0.5], cell: 1.0, per_axis: 1, clip: true };
        let seeds = rule.seed(&square.within(HalfSpace::new(point, normal))).unwrap();
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(Vector2::from);
        let height = |x: &Vector2<f64>| (x - Vector2::from(point)).dot(&Vector2::from(normal));
        let mut inside = Vec::new();
        for (i, a) in corners.iter().enumerate() {
            let b = &corners[(i + 1) % 4];
            let (at_a, at_b) = (height(a), height(b));
            if at_a <= 0.0 {
                inside.push([a.x, a.y]);
            }
            if (at_a <= 0.0) != (at_b <= 0.0) {
                let x = a + (b - a) * (at_a / (at_a - at_b));
                inside.push([x.x, x.y]);
            }
        }
        let exact = Polygon::new(inside).signed_area();
        prop_assert!((seeds.total_volume() - exact).abs() <= 31.0 / 512.0);
    }
}

#[test]
fn filled_particles_carry_the_mass_of_the_region() {
    let region = Block::new([0.0, 0.0], [0.2, 0.1]).minus(Ball::new([0.1, 0.05], 0.02));
    let seeds = Spacing(1e-3).seed(&region).unwrap();
    let mut particles = Particles::<2>::default();
    assert_eq!(
        particles.extend_from_seeds(&seeds, 2350.0, 0.06).unwrap(),
        0..seeds.len()
    );
    let area = 0.02 - PI * 4e-4;
    close(particles.volume.iter().sum(), area * 0.06, 1e-3);
    close(particles.mass.iter().sum(), area * 0.06 * 2350.0, 1e-3);
    particles.check().unwrap();
}

#[test]
fn unusable_numbers_are_refused() {
    let block = Block::new([0.0, 0.0], [1.0, 1.0]);
    for bad in [f64::NAN, f64::INFINITY, 0.0, -0.1] {
        assert!(matches!(
            Spacing(bad).seed(&block),
            Err(SeedError::Length { .. })
        ));
        let origin = [0.0, 0.0];
        let (cell, per_axis, clip) = (bad, 2, true);
        let per_cell = PerCell {
            origin,
            cell,
            per_axis,
        };
        assert!(matches!(
            per_cell.seed(&block),
            Err(SeedError::Length { .. })
        ));
        let in_cell = InCell {
            origin,
            cell,
            per_axis,
            clip,
        };
        assert!(matches!(
            in_cell.seed(&block),
            Err(SeedError::Length { .. })
        ));
    }
    let nowhere = PerCell {
        origin: [f64::NAN, 0.0],
        cell: 0.1,
        per_axis: 2,
    };
    assert!(matches!(
        nowhere.seed(&block),
        Err(SeedError::NotFinite { .. })
    ));
    let none = PerCell {
        origin: [0.0, 0.0],
        cell: 0.1,
        per_axis: 0,
    };
    assert_eq!(none.seed(&block), Err(SeedError::PerAxis { value: 0 }));
    for (angle, x) in [(f64::NAN, 0.0), (0.0, f64::INFINITY)] {
        let turned = Turned {
            inner: Spacing(0.1),
            angle,
            centre: [x, 0.0],
        };
        assert!(matches!(
            turned.seed(&block),
            Err(SeedError::NotFinite { .. })
        ));
    }
}

#[test]
fn unusable_regions_are_refused() {
    let fill = |region: &dyn Region<2>| Spacing(0.1).seed(region);
    assert!(matches!(
        fill(&Block::new([0.0, 0.0], [f64::NAN, 1.0])),
        Err(SeedError::Region(RegionError::Extent { axis: 0, .. }))
    ));
    assert!(matches!(
        fill(&HalfSpace::new([0.0, 0.0], [1.0, 0.0])),
        Err(SeedError::Bounds { axis: 0, .. })
    ));
    let (left, right) = (Ball::new([0.0, 0.0], 1.0), Ball::new([5.0, 0.0], 1.0));
    assert!(matches!(
        fill(&left.within(right)),
        Err(SeedError::Bounds { .. })
    ));
    assert!(matches!(
        fill(&Where::new([0.0, 0.0], [1.0, 1.0], |_| false)),
        Err(SeedError::NoParticles { spacing: 0.1 })
    ));
    assert!(matches!(
        fill(&Block::new([0.0, 0.0], [0.04, 0.04])),
        Err(SeedError::NoParticles { .. })
    ));
    assert!(matches!(
        fill(&Block::new([1e18, 0.0], [2e18, 1.0])),
        Err(SeedError::Unresolved { .. })
    ));
}

#[test]
fn more_places_than_ids_are_refused_before_they_are_made() {
    let block = Block::new([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]);
    match Spacing(1e-4).seed(&block) {
        Err(SeedError::TooMany { asked, limit }) => {
            assert!(asked > 1e12 && limit == u32::MAX);
        }
        other => panic!("{:?}", other.map(|seeds| seeds.len())),
    }
}

#[test]
fn a_region_behind_a_pointer_is_filled_as_itself() {
    let regions: Vec<Box<dyn Region<3>>> = vec![
        Box::new(Block::new([0.0; 3], [1.0; 3])),
        Box::new(Ball::new([0.0; 3], 0.5)),
    ];
    let union = regions
        .iter()
        .map(|region| Spacing(0.25).seed(region).unwrap());
    let counts: Vec<usize> = union.map(|seeds| seeds.len()).collect();
    assert_eq!(counts[0], 64);
    assert!(regions[1].contains(&Vector3::zeros()) && counts[1] < 64);
    assert!(Box::new(Ball::new([0.0; 3], f64::NAN)).check().is_err());
}
