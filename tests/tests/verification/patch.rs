//! D3. A uniform velocity gradient strains every interior particle by exactly that gradient, and a
//! uniform stress exerts no force on interior nodes.
//!
//! What is exact, and why. On particles that repeat from cell to cell, whatever their place in the
//! cell, ΣN = 1 and Σ∇N = 0 over nodes are also sums over particles at one node: uniform stress
//! leaves no force with any shape. Velocities need a lattice that is symmetric about the nodes
//! besides, so that the mean of a linear field over a node's particles is its value at the node;
//! with axisymmetric masses, which grow with the radius, that is so for fields that depend on the
//! axial coordinate alone. APIC carries the gradient and needs no symmetry at all. The lattice
//! breaks off at the body's faces, and each transfer carries that in by its support, so the
//! interior is what lies deeper than the transfers of one step reach.

use fissure::nalgebra::{SMatrix, SVector};
use fissure::prelude::*;
use fissure_tests::{Build, Case, Space, Table, cases, rubber};

const H: f64 = 0.125;
const EXACT: f64 = 1e-12;

/// Cells from a face that one step spoils.
fn depth(case: &Case, per_axis: u32) -> f64 {
    let rounds = case.order() + usize::from(case.update != StressUpdate::Last);
    2.0 * case.shape.support(per_axis) * rounds as f64
}

/// A cube of rubber on a lattice that fills its cells, and the test for its interior.
struct Cube<const D: usize> {
    scene: Scene<D>,
    solver: Box<dyn Solver<D>>,
    low: SVector<f64, D>,
    high: SVector<f64, D>,
}

impl<const D: usize> Cube<D>
where
    Table: Build<D>,
{
    fn new(case: &Case) -> Self {
        let per_axis = if D == 3 { 1 } else { 2 };
        let depth = depth(case, per_axis);
        let cells = 2.0 * depth.ceil() + 2.0;
        // The axis of an axisymmetric scene is far; elsewhere zero lies inside.
        let corner = if case.space == Space::Axisymmetric {
            4.0
        } else {
            -2.0
        };
        let (min, max) = ([corner * H; D], [(corner + cells) * H; D]);
        let mut scene = Table::scene(case.space);
        let seeding = Spacing(H / f64::from(per_axis));
        let block = Block::new(min, max);
        scene.fill("cube", rubber(), &block, &seeding).unwrap();
        let (min, max) = (SVector::from(min), SVector::from(max));
        let margin = SVector::repeat(4.0 * H);
        let grid = Grid::over((min - margin).into(), (max + margin).into(), H).unwrap();
        let inset = SVector::repeat(depth * H);
        Self {
            scene,
            solver: Table::row(case, grid, 0.4).unwrap(),
            low: min + inset,
            high: max - inset,
        }
    }

    fn particles(&mut self) -> &mut Particles<D> {
        self.scene.bodies_mut()[0].particles_mut()
    }

    /// Rows of interior particles by where they were.
    fn interior(&self, start: &[SVector<f64, D>]) -> Vec<usize> {
        let inside =
            |x: &SVector<f64, D>| (0..D).all(|a| x[a] > self.low[a] && x[a] < self.high[a]);
        let rows: Vec<usize> = (0..start.len()).filter(|&i| inside(&start[i])).collect();
        assert!(rows.len() >= 1 << D, "{} interior particles", rows.len());
        rows
    }
}

/// Whether particles carry an affine part.
fn carries_affine(transfer: Transfer) -> bool {
    matches!(transfer, Transfer::Apic | Transfer::Mls)
}

/// A gradient without symmetry; about 0.2 % strain in a step.
fn gradient<const D: usize>(case: &Case) -> SMatrix<f64, D, D> {
    let full =
        SMatrix::from_fn(|i, j| [[3.0, -2.0, 1.0], [5.0, 1.0, -4.0], [-1.0, 2.0, 2.5]][i][j]);
    match (case.space, case.transfer, case.update) {
        // A hoop strain that varies is a stress out of balance before the nodes move.
        (Space::Axisymmetric, _, StressUpdate::First) => {
            SMatrix::from_fn(|i, j| if (i, j) == (1, 1) { full[(1, 1)] } else { 0.0 })
        }
        (Space::Axisymmetric, transfer, _) if !carries_affine(transfer) => {
            SMatrix::from_fn(|i, j| if j == 1 { full[(i, 1)] } else { 0.0 })
        }
        _ => full,
    }
}

fn affine_velocities<const D: usize>(case: &Case)
where
    Table: Build<D>,
{
    let mut cube = Cube::<D>::new(case);
    let rate = gradient::<D>(case);
    cube.scene.set_velocity("cube", |x| rate * x).unwrap();
    if carries_affine(case.transfer) {
        let particles = cube.particles();
        particles.motion.affine = vec![rate; particles.len()];
    }
    // The first step sorts: match the rows by id.
    let start = by_id(&cube.scene, |motion| motion.position.to_vec());
    let report = cube.solver.step(&mut cube.scene, f64::INFINITY).unwrap();
    let velocity = by_id(&cube.scene, |motion| motion.velocity.to_vec());
    let position = by_id(&cube.scene, |motion| motion.position.to_vec());
    let strained = by_id(&cube.scene, |motion| motion.deformation_gradient.to_vec());
    for row in cube.interior(&start) {
        let mut exact = Matrix3::identity();
        for (i, j) in (0..D).flat_map(|i| (0..D).map(move |j| (i, j))) {
            exact[(i, j)] += report.dt * rate[(i, j)];
        }
        let v = rate * start[row];
        if case.space == Space::Axisymmetric {
            exact.m33 += report.dt * v[0] / start[row][0];
        }
        if case.update == StressUpdate::First {
            // The velocities brought the particles here: their gradient is one at the end.
            exact = (Matrix3::identity() * 2.0 - exact).try_inverse().unwrap();
        }
        assert!(
            (exact - Matrix3::identity()).norm() >= 1e-4,
            "{case:?}: no strain to see"
        );
        let error = (strained[row] - exact).norm();
        assert!(
            error <= EXACT,
            "{case:?}: F is off by {error:e} at {}",
            start[row]
        );
        let error = (velocity[row] - v).norm() / v.norm();
        assert!(
            error <= EXACT,
            "{case:?}: v is off by {error:e} at {}",
            start[row]
        );
        let error = (position[row] - start[row] - v * report.dt).norm();
        assert!(
            error <= EXACT,
            "{case:?}: x is off by {error:e} at {}",
            start[row]
        );
    }
}

fn uniform_stress<const D: usize>(case: &Case)
where
    Table: Build<D>,
{
    let mut cube = Cube::<D>::new(case);
    let mut strained = Matrix3::new(1.02, 0.01, 0.0, -0.03, 0.99, 0.0, 0.0, 0.0, 1.0);
    match case.space {
        Space::Plane => {}
        // Without body forces only σ_rr = σ_θθ and σ_rz = 0 are in balance.
        Space::Axisymmetric => strained = Matrix3::from_diagonal(&Vector3::new(1.02, 0.99, 1.02)),
        Space::Solid => (strained.m13, strained.m32, strained.m33) = (0.02, -0.01, 1.01),
    }
    let stress = rubber()
        .update(&Increment::to(strained), &())
        .unwrap()
        .stress;
    let particles = cube.particles();
    particles.motion.deformation_gradient.fill(strained);
    particles.motion.stress.fill(stress);
    let start = by_id(&cube.scene, |motion| motion.position.to_vec());
    let report = cube.solver.step(&mut cube.scene, f64::INFINITY).unwrap();
    let velocity = by_id(&cube.scene, |motion| motion.velocity.to_vec());
    let scale = stress.norm() * report.dt / (rubber().density() * H);
    for row in cube.interior(&start) {
        let error = velocity[row].norm() / scale;
        assert!(
            error <= EXACT,
            "{case:?}: force {error:e} at {}",
            start[row]
        );
    }
    let largest = velocity.iter().map(|v| v.norm()).fold(0.0, f64::max);
    assert!(
        largest >= 1e-2 * scale,
        "{case:?}: nothing moved at the faces"
    );
}

/// A column in the order of the ids.
fn by_id<T: Clone, const D: usize>(
    scene: &Scene<D>,
    column: impl Fn(&MotionSlices<'_, D>) -> Vec<T>,
) -> Vec<T> {
    let body = &scene.bodies()[0];
    let values = column(&body.motion());
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_unstable_by_key(|&i| body.particles().id[i]);
    order.into_iter().map(|i| values[i].clone()).collect()
}

#[test]
fn d3_affine_velocities_strain_the_interior_exactly_in_plane() {
    cases(Space::Plane).iter().for_each(affine_velocities::<2>);
}

#[test]
fn d3_affine_velocities_strain_the_interior_exactly_axisymmetric() {
    cases(Space::Axisymmetric)
        .iter()
        .for_each(affine_velocities::<2>);
}

#[test]
fn d3_affine_velocities_strain_the_interior_exactly_in_space() {
    cases(Space::Solid).iter().for_each(affine_velocities::<3>);
}

#[test]
fn d3_uniform_stress_leaves_the_interior_at_rest_in_plane() {
    cases(Space::Plane).iter().for_each(uniform_stress::<2>);
}

#[test]
fn d3_uniform_stress_leaves_the_interior_at_rest_axisymmetric() {
    cases(Space::Axisymmetric)
        .iter()
        .for_each(uniform_stress::<2>);
}

#[test]
fn d3_uniform_stress_leaves_the_interior_at_rest_in_space() {
    cases(Space::Solid).iter().for_each(uniform_stress::<3>);
}
