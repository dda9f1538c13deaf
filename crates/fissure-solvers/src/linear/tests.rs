//! Systems of elastic grids: small enough for dense algebra, or large enough to show growth.

use nalgebra::{DMatrix, DVector, SMatrix};

use super::*;

/// Stiffness of an elastic grid of unit cells with `n` nodes along each axis, the nodes at the lower end of
/// axis 0 held; positions of the nodes.
pub(super) fn elastic<const D: usize>(n: [usize; D]) -> (BlockMatrix<D>, Vec<[f64; D]>) {
    elastic_with(n, 0.0)
}

/// The same with a tangent whose share `skew` of λ answers one normal strain more than the other.
fn elastic_with<const D: usize>(n: [usize; D], skew: f64) -> (BlockMatrix<D>, Vec<[f64; D]>) {
    let count: usize = n.iter().product();
    let at = |mut node: usize| -> [usize; D] {
        std::array::from_fn(|axis| {
            let k = node % n[axis];
            node /= n[axis];
            k
        })
    };
    let stride = |axis: usize| n[..axis].iter().product::<usize>();
    let corners = 1_usize << D;
    let mut elements: Vec<u32> = Vec::new();
    for node in 0..count {
        let place = at(node);
        if (0..D).all(|axis| place[axis] + 1 < n[axis]) {
            elements.extend((0..corners).map(|corner| {
                let offset = |axis: usize| ((corner >> axis) & 1) * stride(axis);
                (node + (0..D).map(offset).sum::<usize>()) as u32
            }));
        }
    }
    let mut matrix = BlockMatrix::zeros(BlockPattern::of_elements(count, elements.chunks(corners)));
    let stiffness = element::<D>(skew);
    for nodes in elements.chunks(corners) {
        for (i, &row) in nodes.iter().enumerate() {
            for (j, &column) in nodes.iter().enumerate() {
                let place = matrix
                    .pattern()
                    .place(row as usize, column as usize)
                    .unwrap();
                matrix.blocks[place] += stiffness[i * corners + j];
            }
        }
    }
    for node in (0..count).filter(|&node| at(node)[0] == 0) {
        matrix.hold(node, &SMatrix::identity(), D);
    }
    (
        matrix,
        (0..count).map(|node| at(node).map(|k| k as f64)).collect(),
    )
}

/// Blocks of a cell by Gauss points, λ = 1, μ = 0.8.
fn element<const D: usize>(skew: f64) -> Vec<SMatrix<f64, D, D>> {
    let corners = 1_usize << D;
    let mut blocks = vec![SMatrix::zeros(); corners * corners];
    let points = [0.5 - 0.5 / 3_f64.sqrt(), 0.5 + 0.5 / 3_f64.sqrt()];
    for point in 0..corners {
        let x: [f64; D] = std::array::from_fn(|axis| points[(point >> axis) & 1]);
        let gradient = |corner: usize| -> [f64; D] {
            std::array::from_fn(|along| {
                (0..D)
                    .map(|axis| match ((corner >> axis) & 1 == 1, axis == along) {
                        (true, true) => 1.0,
                        (false, true) => -1.0,
                        (true, false) => x[axis],
                        (false, false) => 1.0 - x[axis],
                    })
                    .product()
            })
        };
        for i in 0..corners {
            for j in 0..corners {
                let (a, b) = (gradient(i), gradient(j));
                let product: f64 = (0..D).map(|k| a[k] * b[k]).sum();
                blocks[i * corners + j] += SMatrix::<f64, D, D>::from_fn(|r, c| {
                    let unit = if r == c { product } else { 0.0 };
                    (a[r] * b[c] * (1.0 + skew * (c as f64 - r as f64))
                        + 0.8 * (a[c] * b[r] + unit))
                        / corners as f64
                });
            }
        }
    }
    blocks
}

fn dense<const D: usize>(matrix: &BlockMatrix<D>) -> DMatrix<f64> {
    let size = matrix.size();
    let mut whole = DMatrix::zeros(size, size);
    for row in 0..matrix.pattern().nodes() {
        for k in matrix.pattern().row(row) {
            let column = matrix.pattern().column(k);
            let mut view = whole.fixed_view_mut::<D, D>(D * row, D * column);
            view.copy_from(&matrix.blocks[k]);
        }
    }
    whole
}

/// Some right side without symmetry.
fn right(size: usize) -> Vec<f64> {
    (0..size).map(|i| (0.7 * i as f64).sin() + 0.1).collect()
}

fn error(x: &[f64], exact: &[f64]) -> f64 {
    let difference: Vec<f64> = x.iter().zip(exact).map(|(a, b)| a - b).collect();
    norm(&difference) / norm(exact)
}

fn check_direct<const D: usize>(
    matrix: &BlockMatrix<D>,
    positions: &[[f64; D]],
    expected: Factor,
) -> Direct<D> {
    let mut direct = Direct::new(matrix.pattern(), positions).unwrap();
    direct.factorise(matrix, 0.0).unwrap();
    let b = right(matrix.size());
    let mut x = b.clone();
    let solved = direct.solve(matrix, &mut x).unwrap();
    assert_eq!(direct.factor(), Some(expected));
    let exact = dense(matrix)
        .lu()
        .solve(&nalgebra::DVector::from_vec(b))
        .unwrap();
    assert!(error(&x, exact.as_slice()) <= 1e-8, "{solved:?}");
    direct
}

#[test]
fn every_factorisation_solves_and_counts_its_negative_pivots() {
    let (matrix, positions) = elastic([9, 7]);
    let direct = check_direct(&matrix, &positions, Factor::Cholesky);
    assert_eq!(direct.negative_pivots(), Some(0));
    let (space, places) = elastic([4, 5, 3]);
    check_direct(&space, &places, Factor::Cholesky);

    // Moving the spectrum down makes eigenvalues negative; Sylvester: as many pivots.
    let mut shifted = matrix.clone();
    for node in 0..shifted.pattern().nodes() {
        shifted.add_to_diagonal(node, -0.3);
    }
    let negative = dense(&shifted).symmetric_eigenvalues();
    let negative = negative.iter().filter(|&&value| value < 0.0).count();
    assert!(negative > 3);
    let direct = check_direct(&shifted, &positions, Factor::SignedCholesky);
    assert_eq!(direct.negative_pivots(), Some(negative));

    let mut skew = matrix.clone();
    for node in 0..skew.pattern().nodes() {
        let place = skew.pattern().row(node).start;
        skew.blocks[place][(0, 1)] += 0.4;
    }
    let direct = check_direct(&skew, &positions, Factor::SignedCholesky);
    assert!(!direct.is_symmetric());
    // As a law would make it: iterations do not grow with the grid.
    let products = [12, 48].map(|n| {
        let (matrix, positions) = elastic_with([n, n], 0.5);
        let mut direct = Direct::new(matrix.pattern(), &positions).unwrap();
        direct.factorise(&matrix, 0.0).unwrap();
        let solved = direct.solve(&matrix, &mut right(matrix.size())).unwrap();
        assert_eq!(direct.factor(), Some(Factor::Cholesky));
        assert!(!direct.is_symmetric());
        solved.refinements
    });
    assert!(
        products[1] <= 24 && products[1] <= products[0] + 6,
        "{products:?}"
    );
    // Of a matrix that is next to skew the symmetric part is no help.
    let mut turning = matrix.clone();
    for node in 0..turning.pattern().nodes() {
        let place = turning.pattern().diagonal(node);
        turning.blocks[place] = SMatrix::<f64, 2, 2>::new(1e-6, -9.0, 9.0, 1e-6);
    }
    check_direct(&turning, &positions, Factor::Lu);
}

#[test]
fn a_factorisation_is_used_again_and_refuses_what_it_cannot_solve() {
    let (matrix, positions) = elastic([6, 6]);
    let mut direct = Direct::new(matrix.pattern(), &positions).unwrap();
    let mut b = right(matrix.size());
    assert_eq!(direct.solve(&matrix, &mut b), Err(LinearError::Singular));
    for factor in [1.0, 4.0] {
        let mut scaled = matrix.clone();
        scaled.blocks.iter_mut().for_each(|block| *block *= factor);
        direct.factorise(&scaled, 0.0).unwrap();
        let mut x = right(matrix.size());
        direct.solve(&scaled, &mut x).unwrap();
        let mut product = vec![0.0; x.len()];
        scaled.multiply(&x, &mut product);
        assert!(error(&product, &right(matrix.size())) <= 1e-12);
    }
    let (other, _) = elastic([5, 6]);
    assert_eq!(direct.factorise(&other, 0.0), Err(LinearError::Pattern));
    let mut spoilt = matrix.clone();
    spoilt.blocks[7][(0, 1)] = f64::NAN;
    assert_eq!(direct.factorise(&spoilt, 0.0), Err(LinearError::NotFinite));
    let zero = BlockMatrix::zeros(matrix.pattern().clone());
    let solved = direct
        .factorise(&zero, 0.0)
        .and_then(|()| direct.solve(&zero, &mut b));
    assert_eq!(solved, Err(LinearError::Singular));
}

/// George (1973): entries grow as n log n in the plane. Rows of the factor in the order given fill a band.
#[test]
fn dissection_is_a_permutation_and_fills_little() {
    let entries = |n: usize| {
        let (matrix, positions) = elastic([n, n]);
        let mut order = nested_dissection(matrix.pattern(), &positions);
        let direct = Direct::new(matrix.pattern(), &positions).unwrap();
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..(n * n) as u32));
        direct.factor_entries() as f64
    };
    let (coarse, fine) = (entries(24), entries(96));
    let unknowns = 2.0 * 96.0 * 96.0;
    assert!(fine <= 8.0 * unknowns * f64::log2(unknowns), "{fine}");
    // 16 times the unknowns: 16·log(18432)/log(1152) = 22 times; a band would have 64 times.
    assert!(fine / coarse <= 28.0, "{}", fine / coarse);
}

/// D11: the residual reported is that of the solution, and the recursion's agrees with it.
#[test]
fn iterations_report_true_residuals_and_preconditioners_help() {
    let (mut matrix, _) = elastic([20, 20]);
    let b = right(matrix.size());
    let blocks = NodeBlocks::new(&matrix).unwrap();
    let cholesky = Incomplete::cholesky(&matrix).unwrap();
    let lu = Incomplete::lu(&matrix).unwrap();
    let settings = KrylovSettings::default();
    let mut counts = Vec::new();
    let preconditioners: [&dyn Preconditioner; 4] = [&Identity, &blocks, &cholesky, &lu];
    for preconditioner in preconditioners {
        for conjugate in [true, false] {
            let mut x = vec![0.0; b.len()];
            let outcome = if conjugate {
                conjugate_gradients(&mut matrix, preconditioner, &b, &mut x, &settings)
            } else {
                gmres(&mut matrix, preconditioner, &b, &mut x, &settings)
            };
            let Ok(outcome) = outcome;
            assert_eq!(outcome.stop, Stop::Converged, "{outcome:?}");
            let mut product = vec![0.0; b.len()];
            matrix.multiply(&x, &mut product);
            assert!((error(&product, &b) - outcome.residual).abs() <= 1e-14);
            assert!(
                (outcome.estimate / outcome.residual - 1.0).abs() <= 1e-3,
                "{outcome:?}"
            );
            counts.push(outcome.iterations);
        }
    }
    assert!(
        2 * counts[4] < counts[0] && 2 * counts[5] < counts[1],
        "{counts:?}"
    );
    // Of a symmetric matrix both incomplete factorisations are the same.
    assert_eq!(counts[4..6], counts[6..8]);
}

#[test]
fn an_iteration_says_why_it_stopped() {
    let (mut matrix, _) = elastic([8, 8]);
    let b = right(matrix.size());
    let settings = KrylovSettings::default();
    let mut x = vec![0.0; b.len()];
    let few = KrylovSettings {
        max_iterations: 5,
        ..settings
    };
    for conjugate in [true, false] {
        x.fill(0.0);
        let Ok(outcome) = if conjugate {
            conjugate_gradients(&mut matrix, &Identity, &b, &mut x, &few)
        } else {
            gmres(&mut matrix, &Identity, &b, &mut x, &few)
        };
        assert_eq!((outcome.stop, outcome.iterations), (Stop::Iterations, 5));
        assert!(!outcome.converged());
    }
    // Restarts too short to get anywhere: a rotation by a right angle.
    let pattern = BlockPattern::of_elements(1, [[0_u32].as_slice()].into_iter());
    let mut quarter = BlockMatrix::<2>::zeros(pattern);
    quarter.blocks[0] = SMatrix::<f64, 2, 2>::new(0.0, -1.0, 1.0, 0.0);
    let short = KrylovSettings {
        restart: 1,
        ..settings
    };
    let mut x = vec![0.0; 2];
    let Ok(outcome) = gmres(&mut quarter, &Identity, &[1.0, 0.0], &mut x, &short);
    assert_eq!(outcome.stop, Stop::Stagnation);
    // Two directions are all there are.
    let Ok(outcome) = gmres(&mut quarter, &Identity, &[1.0, 0.0], &mut x, &settings);
    assert_eq!((outcome.stop, outcome.iterations), (Stop::Exact, 2));
    assert!(error(&x, &[0.0, -1.0]) <= 1e-15);
    let Ok(outcome) = conjugate_gradients(
        &mut quarter,
        &Identity,
        &[1.0, 0.0],
        &mut [0.0; 2],
        &settings,
    );
    assert_eq!(outcome.stop, Stop::Indefinite);
    let Ok(outcome) = gmres(
        &mut quarter,
        &Identity,
        &[f64::NAN, 0.0],
        &mut [0.0; 2],
        &settings,
    );
    assert_eq!(outcome.stop, Stop::NotFinite);
    let Ok(outcome) = gmres(&mut quarter, &Identity, &[0.0; 2], &mut x, &settings);
    assert_eq!(
        (outcome.stop, outcome.iterations, x),
        (Stop::Converged, 0, vec![0.0; 2])
    );
}

/// Restarts need more products and come to the same; a start at the solution needs none.
#[test]
fn restarts_come_to_the_same_solution() {
    let (mut matrix, _) = elastic_with([12, 12], 0.3);
    let b = right(matrix.size());
    let exact = dense(&matrix)
        .lu()
        .solve(&DVector::from_column_slice(&b))
        .unwrap();
    let mut counts = Vec::new();
    for restart in [10, 40, 1000] {
        let settings = KrylovSettings {
            tolerance: 1e-10,
            restart,
            ..KrylovSettings::default()
        };
        let mut x = vec![0.0; b.len()];
        let Ok(outcome) = gmres(&mut matrix, &Identity, &b, &mut x, &settings);
        assert!(outcome.converged(), "{outcome:?}");
        assert!(error(&x, exact.as_slice()) <= 1e-7, "{outcome:?}");
        counts.push(outcome.iterations);
        let Ok(again) = gmres(&mut matrix, &Identity, &b, &mut x, &settings);
        assert_eq!((again.stop, again.iterations), (Stop::Converged, 0));
    }
    // The first restarts several times, the last not at all.
    assert!(
        counts[0] > counts[1] && counts[1] > counts[2] && counts[2] <= b.len(),
        "{counts:?}"
    );
}

/// A matrix with rounding of its own, as differences of residuals have: every product is off by a share of its size.
struct Rough<'a>(&'a mut BlockMatrix<2>, f64, u32);

impl Operator for Rough<'_> {
    type Error = std::convert::Infallible;

    fn size(&self) -> usize {
        self.0.size()
    }

    fn apply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Self::Error> {
        self.0.apply(x, y)?;
        let size = crate::linear::norm(y);
        for (k, y) in y.iter_mut().enumerate() {
            self.2 += 1;
            *y += self.1 * size * (f64::from(self.2) * 0.7 + k as f64).sin();
        }
        Ok(())
    }
}

/// What the recursion believes is not taken for the residual: with a product that is off the true one decides.
#[test]
fn a_rough_operator_is_not_taken_at_its_recursions_word() {
    let (mut matrix, _) = elastic([12, 12]);
    let b = right(matrix.size());
    let settings = KrylovSettings {
        tolerance: 1e-9,
        restart: 400,
        ..KrylovSettings::default()
    };
    for conjugate in [false, true] {
        let mut x = vec![0.0; b.len()];
        let mut rough = Rough(&mut matrix, 1e-6, 0);
        let Ok(outcome) = if conjugate {
            conjugate_gradients(&mut rough, &Identity, &b, &mut x, &settings)
        } else {
            gmres(&mut rough, &Identity, &b, &mut x, &settings)
        };
        assert!(!outcome.converged(), "{outcome:?}");
        assert!(outcome.residual > settings.tolerance, "{outcome:?}");
        // The recursion of GMRES believed otherwise.
        assert!(
            conjugate || outcome.estimate <= settings.tolerance,
            "{outcome:?}"
        );
        let mut product = vec![0.0; b.len()];
        matrix.multiply(&x, &mut product);
        // As good as its products are, and reported as good as it is.
        let miss = error(&product, &b);
        assert!(
            miss <= 1e-3 && miss <= 2.0 * outcome.residual + 1e-5,
            "{miss} {outcome:?}"
        );
    }
}

/// A chain has no entries beyond its pattern: the incomplete factorisation is complete.
#[test]
fn an_incomplete_factorisation_of_a_chain_is_exact() {
    let (mut matrix, _) = elastic([2, 12]);
    let links: Vec<[u32; 2]> = (0..11).map(|i| [i, i + 1]).collect();
    let mut chain = BlockMatrix::<2>::zeros(BlockPattern::of_elements(
        12,
        links.iter().map(|link| link.as_slice()),
    ));
    for row in 0..12 {
        for k in chain.pattern().row(row) {
            let column = chain.pattern().column(k);
            let place = matrix.pattern().place(2 * row + 1, 2 * column + 1).unwrap();
            chain.blocks[k] = matrix.blocks[place];
        }
    }
    let b = right(chain.size());
    for preconditioner in [
        Incomplete::cholesky(&chain).unwrap(),
        Incomplete::lu(&chain).unwrap(),
    ] {
        assert_eq!(preconditioner.shift(), 0.0);
        let mut x = vec![0.0; b.len()];
        let settings = KrylovSettings::default();
        let Ok(outcome) = gmres(&mut chain, &preconditioner, &b, &mut x, &settings);
        assert_eq!(outcome.iterations, 1, "{outcome:?}");
    }
    // Where a pivot is negative the diagonal is raised until none is.
    let mut shifts = Vec::new();
    for _ in 0..10 {
        for node in 0..matrix.pattern().nodes() {
            matrix.add_to_diagonal(node, -0.1);
        }
        shifts.extend(Incomplete::cholesky(&matrix).map(|raised| raised.shift()));
    }
    assert!(shifts.iter().any(|&shift| shift > 0.0), "{shifts:?}");
}

/// Held components along skew directions: the solution is that of the dense system with its rows replaced.
#[test]
fn held_directions_are_taken_out() {
    let (mut matrix, positions) = elastic([4, 4]);
    let (sin, cos) = 0.5_f64.sin_cos();
    let directions = SMatrix::<f64, 2, 2>::new(cos, -sin, sin, cos);
    let whole = dense(&matrix);
    let node = 9;
    matrix.hold(node, &directions, 1);
    let mut turn = DMatrix::identity(whole.nrows(), whole.nrows());
    turn.fixed_view_mut::<2, 2>(2 * node, 2 * node)
        .copy_from(&directions);
    let mut expected = turn.transpose() * whole * &turn;
    expected.row_mut(2 * node).fill(0.0);
    expected.column_mut(2 * node).fill(0.0);
    expected[(2 * node, 2 * node)] = 1.0;
    assert!((dense(&matrix) - expected).amax() <= 1e-15);
    check_direct(&matrix, &positions, Factor::Cholesky);
}
