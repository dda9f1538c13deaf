//! Gathering and scattering against the plain sum over visited nodes, for every shape, vector unit and dimension.

use std::marker::PhantomData;

use fissure_grid::simd::{EIGHT, Lanes, Simd, SimdTask};
use fissure_grid::{
    By, ByArms, ByArmsAndSlopes, ByNothing, FIELD, Gathered, Gift, Grid, SUMS, Shape, Stencil,
    Stencils, Window, shape, sums_entry,
};
use nalgebra::{SMatrix, SVector};

/// Numbers without a pattern, in [-1, 1].
fn noise(seed: usize) -> f64 {
    let x = (seed as f64 * 12.9898 + 4.1414).sin() * 43_758.545_3;
    2.0 * (x - x.floor()) - 1.0
}

struct Both<'a, S, B, const D: usize> {
    by: PhantomData<B>,
    shape: &'a S,
    grid: &'a Grid<D>,
    window: &'a Window<D>,
    x: &'a [[f64; EIGHT]; D],
    domain: SMatrix<f64, D, D>,
    place: usize,
    field: &'a [f64],
    gifts: &'a [Gift<D>; EIGHT],
    sums: &'a mut [[f64; SUMS]],
}

impl<S: Shape<D>, B: By, const D: usize> SimdTask for Both<'_, S, B, D> {
    type Output = Gathered<f64, D>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Self::Output {
        let place = self.place;
        let domain = |_| self.domain;
        let stencils = self
            .shape
            .stencils(lanes, self.grid, self.window, self.x, domain);
        for other in 0..EIGHT {
            let fits = (1..=3).all(|ahead| other != (place + ahead) % EIGHT);
            assert_eq!(stencils.fits(other), fits, "{}: {other}", self.shape.name());
        }
        stencils.scatter::<L, B>(lanes, self.gifts, EIGHT, self.sums);
        let found = stencils.gather::<L, true, true>(lanes, self.field);
        let of_place = |eight: L::Eight| {
            let mut all = [0.0; EIGHT];
            lanes.store(eight, &mut all);
            all[place]
        };
        Gathered {
            value: found.value.map(of_place),
            gradient: found.gradient.map(|of_axis| of_axis.map(of_place)),
            moment: found.moment.map(|of_axis| of_axis.map(of_place)),
        }
    }
}

/// The same by the definition.
fn plain<S: Stencil<D>, B: By, const D: usize>(
    stencil: &S,
    _by: B,
    field: &[f64],
    gift: &Gift<D>,
    sums: &mut [[f64; SUMS]],
) -> Gathered<f64, D> {
    let mut found = Gathered {
        value: [0.0; FIELD],
        gradient: [[0.0; FIELD]; D],
        moment: [[0.0; FIELD]; D],
    };
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
        for (c, sum) in sums[sums_entry::<D>(window)].iter_mut().enumerate() {
            *sum += weight * gift.value[c];
            for a in 0..D {
                let factor = match c < FIELD || B::ARMS {
                    _ if B::NOTHING => 0.0,
                    true => weight * arm[a],
                    false => gradient[a],
                };
                *sum += gift.sloped[a][c] * factor;
            }
        }
    });
    found
}

fn compare<S: Shape<D>, const D: usize>(shape: &S) -> Result<(), String> {
    // Cells 4 to 8 are a tile of four, and half of one of eight.
    compare_in(shape, ByNothing, &Window::of_tile([1; D], 4))?;
    compare_in(shape, ByArms, &Window::of_tile([1; D], 4))?;
    compare_in(shape, ByArmsAndSlopes, &Window::of_tile([1; D], 4))?;
    if D < 3 {
        compare_in(shape, ByArms, &Window::of_tile([0; D], 8))?;
        compare_in(shape, ByArmsAndSlopes, &Window::of_tile([0; D], 8))?;
    }
    Ok(())
}

fn compare_in<S: Shape<D>, B: By + Copy, const D: usize>(
    shape: &S,
    by: B,
    window: &Window<D>,
) -> Result<(), String> {
    let grid = Grid::over([0.0; D], [3.0; D], 0.25).map_err(|error| error.to_string())?;
    let elements = Window::<D>::ELEMENTS;
    let field: Vec<f64> = (0..elements * FIELD).map(noise).collect();
    let gift = Gift {
        value: std::array::from_fn(|c| noise(c + 1000)),
        sloped: std::array::from_fn(|a| {
            std::array::from_fn(|c| {
                let size = if c < FIELD { 9.0 } else { 0.1 };
                size * noise(c + 2000 + 10 * a)
            })
        }),
    };
    let domain = SMatrix::<f64, D, D>::identity() * 0.06;
    for eight in 0..25 {
        // In cells 4 to 8.
        let at =
            |particle: usize| SVector::from_fn(|axis, _| 1.5 + 0.499 * noise(7 * particle + axis));
        let mut all: [SVector<f64, D>; EIGHT] = std::array::from_fn(|place| at(8 * eight + place));
        let place = eight % EIGHT;
        let stencil = shape
            .stencil(&grid, window, &all[place], &domain)
            .ok_or("no stencil")?;
        // One that is off the grid, one in another tile and one that is nowhere do not disturb the others.
        all[(place + 1) % EIGHT] = SVector::repeat(-1.0);
        all[(place + 2) % EIGHT] = SVector::repeat(2.9);
        all[(place + 3) % EIGHT][eight % D] = f64::NAN;
        let columns = std::array::from_fn(|axis| all.map(|x| x[axis]));
        let mut gifts = [Gift::default(); EIGHT];
        gifts[place] = gift;
        for name in ["plain", "avx2", "avx512"] {
            let Some(unit) = Simd::named(name) else {
                continue;
            };
            let mut exact_sums = vec![[0.5; SUMS]; sums_entry::<D>(elements)];
            let mut sums = exact_sums.clone();
            let exact = plain(&stencil, by, &field, &gift, &mut exact_sums);
            let found = unit.run(Both {
                by: PhantomData::<B>,
                shape,
                grid: &grid,
                window,
                x: &columns,
                domain,
                place,
                field: &field,
                gifts: &gifts,
                sums: &mut sums,
            });
            let pairs = [(found.value, exact.value, 1.0)].into_iter();
            let pairs = pairs.chain((0..D).map(|a| (found.gradient[a], exact.gradient[a], 8.0)));
            let pairs = pairs.chain((0..D).map(|a| (found.moment[a], exact.moment[a], 0.5)));
            // The last number is summed where it is needed, and there to the gradient alone.
            let known = |c: usize| c < D || (c == FIELD - 1 && !S::Stencils::SMOOTH);
            for (a, b, size) in pairs {
                for c in (0..FIELD).filter(|&c| known(c)) {
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
