//! Gathering and scattering against the plain sum over visited nodes, for every shape, vector unit and dimension.

use fissure_grid::simd::{Lanes, Simd, SimdTask};
use fissure_grid::{FIELD, Gathered, Gift, Grid, SUMS, Shape, Stencil, shape};
use nalgebra::{SMatrix, SVector};

/// Numbers without a pattern, in [-1, 1].
fn noise(seed: usize) -> f64 {
    let x = (seed as f64 * 12.9898 + 4.1414).sin() * 43_758.545_3;
    2.0 * (x - x.floor()) - 1.0
}

struct Both<'a, S, const D: usize> {
    stencil: &'a S,
    field: &'a [f64],
    gift: &'a Gift<D>,
    sums: &'a mut [[f64; SUMS]],
}

impl<S: Stencil<D>, const D: usize> SimdTask for Both<'_, S, D> {
    type Output = Gathered<D>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Gathered<D> {
        self.stencil
            .scatter::<L, true, true>(lanes, self.gift, self.sums);
        self.stencil.gather::<L, true, true>(lanes, self.field)
    }
}

/// The same by the definition.
fn plain<S: Stencil<D>, const D: usize>(
    stencil: &S,
    field: &[f64],
    gift: &Gift<D>,
    sums: &mut [[f64; SUMS]],
) -> Gathered<D> {
    let mut found = Gathered::default();
    stencil.visit(|window, weight, gradient| {
        let arm = stencil.arm(window);
        for c in 0..FIELD {
            let v = field[FIELD * window + c];
            found.value[c] += weight * v;
            for a in 0..D {
                found.gradient[a][c] += gradient[a] * v;
                found.moment[a][c] += weight * arm[a] * v;
            }
        }
        for (c, sum) in sums[window].iter_mut().enumerate() {
            *sum += weight * gift.value[c];
            for a in 0..D {
                *sum += gradient[a] * gift.gradient[a][c] + weight * arm[a] * gift.moment[a][c];
            }
        }
    });
    found
}

fn compare<S: Shape<D>, const D: usize>(shape: &S) -> Result<(), String> {
    let grid = Grid::over([0.0; D], [3.0; D], 0.25).map_err(|error| error.to_string())?;
    let window = 8_usize.pow(D as u32);
    let field: Vec<f64> = (0..(window + 1) * FIELD).map(noise).collect();
    let gift = Gift {
        value: std::array::from_fn(|c| noise(c + 1000)),
        gradient: std::array::from_fn(|a| std::array::from_fn(|c| 0.1 * noise(c + 2000 + 10 * a))),
        moment: std::array::from_fn(|a| std::array::from_fn(|c| 9.0 * noise(c + 3000 + 10 * a))),
    };
    let domain = SMatrix::<f64, D, D>::identity() * 0.06;
    for place in 0..200 {
        // Tile 1 holds 1.0 to 2.0.
        let x = SVector::from_fn(|axis, _| 1.5 + 0.499 * noise(7 * place + axis));
        let stencil = shape
            .stencil(&grid, [1; D], &x, &domain)
            .ok_or("no stencil")?;
        for name in ["plain", "avx2", "avx512"] {
            let Some(unit) = Simd::named(name) else {
                continue;
            };
            let mut exact_sums = vec![[0.5; SUMS]; window];
            let mut sums = exact_sums.clone();
            let exact = plain(&stencil, &field, &gift, &mut exact_sums);
            let found = unit.run(Both {
                stencil: &stencil,
                field: &field,
                gift: &gift,
                sums: &mut sums,
            });
            let pairs = [(found.value, exact.value, 1.0)].into_iter();
            let pairs = pairs.chain((0..D).map(|a| (found.gradient[a], exact.gradient[a], 8.0)));
            let pairs = pairs.chain((0..D).map(|a| (found.moment[a], exact.moment[a], 0.5)));
            for (a, b, size) in pairs {
                for c in 0..FIELD {
                    if !((a[c] - b[c]).abs() <= 4e-15 * size) {
                        return Err(format!(
                            "{name} {} {D}D: {} is not {}",
                            shape.name(),
                            a[c],
                            b[c]
                        ));
                    }
                }
            }
            for (a, b) in sums.iter().flatten().zip(exact_sums.iter().flatten()) {
                if !((a - b).abs() <= 1e-14) {
                    return Err(format!("{name} {} {D}D: sum {a} is not {b}", shape.name()));
                }
            }
        }
    }
    Ok(())
}

fn compare_all<const D: usize>() -> Result<(), String> {
    compare::<_, D>(&shape::Linear)?;
    compare::<_, D>(&shape::Gimp)?;
    compare::<_, D>(&shape::Cpdi)?;
    compare::<_, D>(&shape::Bspline2)?;
    compare::<_, D>(&shape::Bspline3)
}

#[test]
fn transfers_are_the_sums_over_visited_nodes() -> Result<(), String> {
    compare_all::<1>()?;
    compare_all::<2>()?;
    compare_all::<3>()
}
