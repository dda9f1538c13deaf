//! From nodes to particles and on to the nodes again, tile by tile.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use fissure_grid::simd::{EIGHT, Lanes, SimdTask};
use fissure_grid::{FIELD, Gathered, SUMS, Shape, Stencils};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::{KernelFailure, Kinematics, Run, RunConstants, RunKernel, WindowKernel};
use fissure_tensor::Sym;
use nalgebra::{Matrix3, SMatrix, SVector};

use super::settings::Transfer;
use crate::nodes::{Field, MASSIVE, NodeSums, vector};
use crate::transfers::{Transfers, add_stress, momentum_gift};
use crate::window::{CUBE, SQUARE, WindowSums};

/// What particles give to the nodes at the end of a pass over them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Giving {
    /// Mass and the momentum they have now, at the place they came from.
    MomentumBack,
    /// Mass and momentum, at the place they have moved to.
    MomentumOn,
    /// Mass, the momentum they came with, and internal force, at the place they came from.
    AllBack,
    /// Mass, momentum and internal force, at the place they have moved to.
    AllOn,
}

/// What the kernels of a pass share.
pub(crate) struct StepKernel<'a, S, const D: usize> {
    pub transfers: &'a Transfers<'a, S, D>,
    /// What moves and strains the particles.
    pub field: &'a Field,
    /// What their velocity takes up, if that is another field.
    pub carried: Option<&'a Field>,
    pub sums: &'a NodeSums<D>,
    pub half_edges: SMatrix<f64, D, D>,
    pub transfer: Transfer,
    /// `D⁻¹` of APIC on splines, 1/m²; without it the affine part is the velocity gradient.
    pub affine_inverse: Option<f64>,
    pub dt: f64,
    /// Whether positions and velocities are moved.
    pub moves: bool,
    /// Whether the deformation gradient follows the field.
    pub strains: bool,
    /// Whether the velocities are those the particles came here with (stress first): the gradient
    /// is then one at the end of the motion, `F ← (1 − Δt L)⁻¹ F`, else one at its start,
    /// `F ← (1 + Δt L) F`. With the other one a spinning body grows or shrinks.
    pub backward: bool,
    pub giving: Giving,
    /// Set when a particle has left its tile's window, so that it could give nothing.
    pub strayed: &'a AtomicBool,
}

impl<S: Shape<D>, const D: usize> RunKernel<D> for StepKernel<'_, S, D> {
    fn on_window(
        &self,
        window: u32,
        work: &mut dyn FnMut(&mut dyn WindowKernel<D>) -> Result<(), KernelFailure>,
    ) -> Result<(), KernelFailure> {
        match D {
            2 => self.on_window_of::<SQUARE, 65>(window, work),
            _ => self.on_window_of::<CUBE, 513>(window, work),
        }
    }
}

impl<S: Shape<D>, const D: usize> StepKernel<'_, S, D> {
    fn on_window_of<const N: usize, const PADDED: usize>(
        &self,
        window: u32,
        work: &mut dyn FnMut(&mut dyn WindowKernel<D>) -> Result<(), KernelFailure>,
    ) -> Result<(), KernelFailure> {
        let placement = self.transfers.placement;
        let nodes = placement.nodes(window);
        let mut field = [[0.0; FIELD]; PADDED];
        nodes.load(self.field, &mut field);
        let carried = self.carried.map(|carried| {
            let mut values = [[0.0; FIELD]; PADDED];
            nodes.load(carried, &mut values);
            values
        });
        let mut sums = WindowSums::<N>::zero();
        let done = work(&mut Tile {
            pass: self,
            coordinates: placement.coordinates(window),
            field: field.as_flattened(),
            carried: carried.as_ref().map(|values| values.as_flattened()),
            sums: &mut sums.0,
            strains: [Strain::default(); Run::MAX],
            work: 0.0,
        });
        nodes.add(&sums.0, self.sums);
        done
    }

    fn is_affine(&self) -> bool {
        self.transfer == Transfer::Apic
    }
}

/// A pass at work on a tile.
struct Tile<'a, S, const D: usize> {
    pass: &'a StepKernel<'a, S, D>,
    coordinates: [i32; D],
    field: &'a [f64],
    carried: Option<&'a [f64]>,
    sums: &'a mut [[f64; SUMS]],
    /// Of the rows of the run at work, where their new stresses are to do work on them.
    strains: [Strain<D>; Run::MAX],
    /// Work on these strains, J: with the stress first that of the old stresses, else that of the new ones.
    work: f64,
}

/// Velocity gradient times the length of the step.
#[derive(Clone, Copy)]
struct Strain<const D: usize> {
    /// Columns, with a fourth number that is not used.
    columns: [[f64; FIELD]; D],
    /// Around the axis.
    hoop: f64,
}

impl<const D: usize> Default for Strain<D> {
    fn default() -> Self {
        Self {
            columns: [[0.0; FIELD]; D],
            hoop: 0.0,
        }
    }
}

impl<const D: usize> Strain<D> {
    /// Work of a stress per present volume, J/m³.
    #[inline(always)]
    fn work(&self, stress: &Sym) -> f64 {
        let full = stress.to_matrix();
        let mut work = full.m33 * self.hoop;
        for j in 0..D {
            for i in 0..D {
                work += full[(i, j)] * self.columns[j][i];
            }
        }
        work
    }
}

impl<S: Shape<D>, const D: usize> WindowKernel<D> for Tile<'_, S, D> {
    fn gather(
        &mut self,
        run: &Run,
        constants: &RunConstants<'_>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> Result<(), KernelFailure> {
        let (pass, simd) = (self.pass, self.pass.transfers.simd);
        let affine = pass.moves && pass.is_affine();
        let moments = affine && pass.affine_inverse.is_some();
        macro_rules! gather {
            ($moves:literal, $strains:literal, $gradient:literal, $moment:literal) => {
                simd.run(
                    GatherRun::<'_, '_, '_, '_, S, D, $moves, $strains, $gradient, $moment> {
                        tile: self,
                        constants,
                        old,
                        new,
                    },
                )
            };
        }
        // What is known when this is compiled is not asked for each particle, and sums stay where they are made.
        let gathered = match (pass.moves, pass.strains, affine, moments) {
            (false, ..) => gather!(false, true, true, false),
            (true, true, _, false) => gather!(true, true, true, false),
            (true, true, _, true) => gather!(true, true, true, true),
            (true, false, false, _) => gather!(true, false, false, false),
            (true, false, true, false) => gather!(true, false, true, false),
            (true, false, true, true) => gather!(true, false, false, true),
        };
        gathered.map_err(|row| KernelFailure {
            index: run.start as usize + row,
        })
    }

    fn scatter(
        &mut self,
        _run: &Run,
        constants: &RunConstants<'_>,
        old: &MotionSlices<'_, D>,
        new: &MotionSlices<'_, D>,
    ) -> f64 {
        if self.pass.giving == Giving::MomentumBack {
            // Given while its weights were at hand.
            return 0.0;
        }
        let simd = self.pass.transfers.simd;
        if self.pass.is_affine() {
            simd.run(ScatterRun::<'_, '_, '_, S, D, true> {
                tile: self,
                constants,
                old,
                new,
            });
        } else {
            simd.run(ScatterRun::<'_, '_, '_, S, D, false> {
                tile: self,
                constants,
                old,
                new,
            });
        }
        std::mem::take(&mut self.work)
    }
}

/// Gathers and does what the pass is for: `MOVES` and `STRAINS` as in [`Pass`](super::phases::Pass), with sums by
/// `GRADIENT` and `MOMENT`.
struct GatherRun<
    't,
    'a,
    'c,
    'n,
    S,
    const D: usize,
    const MOVES: bool,
    const STRAINS: bool,
    const GRADIENT: bool,
    const MOMENT: bool,
> {
    tile: &'t mut Tile<'a, S, D>,
    constants: &'c RunConstants<'c>,
    old: &'c MotionSlices<'c, D>,
    new: &'c mut MotionSlicesMut<'n, D>,
}

impl<
    S: Shape<D>,
    const D: usize,
    const MOVES: bool,
    const STRAINS: bool,
    const GRADIENT: bool,
    const MOMENT: bool,
> SimdTask for GatherRun<'_, '_, '_, '_, S, D, MOVES, STRAINS, GRADIENT, MOMENT>
{
    /// The row of a particle that reaches off the grid or its tile's window.
    type Output = Result<(), usize>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Result<(), usize> {
        let Self {
            tile,
            constants,
            old,
            new,
        } = self;
        let pass = tile.pass;
        for first in (0..old.len()).step_by(EIGHT) {
            let (x, f) = (&old.position[first..], &old.deformation_gradient[first..]);
            let stencils = pass
                .transfers
                .stencils_at(&pass.half_edges, tile.coordinates, x, f);
            let rows = first..(first + EIGHT).min(old.len());
            for row in rows.clone() {
                let place = row - first;
                if !stencils.fits(place) {
                    return Err(pass.first_outside(first..row, new).unwrap_or(row));
                }
                let gathered = stencils.gather::<L, GRADIENT, MOMENT>(lanes, place, tile.field);
                if MOVES {
                    let carried = tile.carried.map(|carried| {
                        stencils
                            .gather::<L, false, false>(lanes, place, carried)
                            .value
                    });
                    pass.move_particle(lanes, row, &gathered, carried, old, new);
                    if MOMENT || (GRADIENT && pass.is_affine()) {
                        new.affine[row] = pass.affine_part::<L, MOMENT>(lanes, &gathered);
                    }
                }
                if STRAINS {
                    let f = &old.deformation_gradient[row];
                    let change = scaled(lanes, &gradient(lanes, &gathered), pass.dt);
                    let hoop = pass.hoop(lanes, &gathered, &old.position[row]);
                    let mut strain = Strain {
                        columns: [[0.0; FIELD]; D],
                        hoop,
                    };
                    for (column, change) in strain.columns.iter_mut().zip(change) {
                        *column = lanes.store4(change);
                    }
                    if pass.backward {
                        let volume = constants.volume[row] * f.determinant();
                        tile.work += volume * strain.work(&old.stress[row]);
                    } else {
                        tile.strains[row] = strain;
                    }
                    new.deformation_gradient[row] = pass.strained(lanes, change, hoop, f);
                }
                if MOVES && !STRAINS && pass.giving == Giving::MomentumBack {
                    let affine = if MOMENT || GRADIENT {
                        new.affine.get(row)
                    } else {
                        None
                    };
                    let gift = momentum_gift(constants.mass[row], &new.velocity[row], affine);
                    if affine.is_some() {
                        stencils.scatter::<L, true>(lanes, place, &gift, tile.sums);
                    } else {
                        stencils.scatter::<L, false>(lanes, place, &gift, tile.sums);
                    }
                }
            }
            if MOVES && let Some(row) = pass.first_outside(rows, new) {
                return Err(row);
            }
        }
        Ok(())
    }
}

struct ScatterRun<'t, 'a, 'c, S, const D: usize, const AFFINE: bool> {
    tile: &'t mut Tile<'a, S, D>,
    constants: &'c RunConstants<'c>,
    old: &'c MotionSlices<'c, D>,
    new: &'c MotionSlices<'c, D>,
}

impl<S: Shape<D>, const D: usize, const AFFINE: bool> SimdTask
    for ScatterRun<'_, '_, '_, S, D, AFFINE>
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self {
            tile,
            constants,
            old,
            new,
        } = self;
        let pass = tile.pass;
        let back = pass.giving == Giving::AllBack;
        let place = if back { old } else { new };
        // Straining alone leaves the velocities of the trial as they were.
        let velocity = if back { old } else { new };
        let forces = pass.giving != Giving::MomentumOn;
        let works = pass.giving == Giving::AllOn;
        for first in (0..new.len()).step_by(EIGHT) {
            // Without motion or strain in this pass the trial holds them from the pass before.
            let (x, f) = (
                &place.position[first..],
                &place.deformation_gradient[first..],
            );
            let stencils = pass
                .transfers
                .stencils_at(&pass.half_edges, tile.coordinates, x, f);
            for row in first..(first + EIGHT).min(new.len()) {
                if !stencils.fits(row - first) {
                    pass.strayed.store(true, Relaxed);
                    continue;
                }
                let affine = if AFFINE {
                    velocity.affine.get(row)
                } else {
                    None
                };
                let mut gift = momentum_gift(constants.mass[row], &velocity.velocity[row], affine);
                if forces {
                    let volume =
                        constants.volume[row] * new.deformation_gradient[row].determinant();
                    let (stress, x) = (&new.stress[row], &place.position[row]);
                    add_stress(&mut gift, pass.transfers.kinematics, stress, volume, x);
                    if works {
                        tile.work += volume * tile.strains[row].work(stress);
                    }
                }
                if forces || AFFINE {
                    stencils.scatter::<L, true>(lanes, row - first, &gift, tile.sums);
                } else {
                    stencils.scatter::<L, false>(lanes, row - first, &gift, tile.sums);
                }
            }
        }
    }
}

impl<S: Shape<D>, const D: usize> StepKernel<'_, S, D> {
    /// The first of these rows that the trial has outside the grid.
    #[inline(always)]
    fn first_outside(
        &self,
        mut rows: std::ops::Range<usize>,
        new: &MotionSlicesMut<'_, D>,
    ) -> Option<usize> {
        let grid = self.transfers.grid;
        let mut all_inside = true;
        for x in &new.position[rows.clone()] {
            all_inside &= grid.contains(x);
        }
        if all_inside {
            return None;
        }
        rows.find(|&row| !grid.contains(&new.position[row]))
    }

    #[inline(always)]
    fn move_particle<L: Lanes>(
        &self,
        lanes: L,
        row: usize,
        gathered: &Gathered<L::Four, D>,
        carried: Option<L::Four>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) {
        let end: SVector<f64, D> = vector(&lanes.store4(gathered.value));
        new.position[row] = old.position[row] + end * self.dt;
        let carried = carried.map(|carried| vector(&lanes.store4(carried)));
        new.velocity[row] = match (self.transfer, carried) {
            (Transfer::Flip { pic }, Some(gain)) => {
                (old.velocity[row] + gain) * (1.0 - pic) + end * pic
            }
            (_, Some(filtered)) => filtered,
            (_, None) => end,
        };
    }

    /// By the moments on splines, else the velocity gradient.
    #[inline(always)]
    fn affine_part<L: Lanes, const MOMENT: bool>(
        &self,
        lanes: L,
        gathered: &Gathered<L::Four, D>,
    ) -> SMatrix<f64, D, D> {
        let columns = if MOMENT {
            scaled(lanes, &gathered.moment, self.affine_inverse.unwrap_or(0.0))
        } else {
            gradient(lanes, gathered)
        };
        matrix(lanes, &columns)
    }

    #[inline(always)]
    fn strained<L: Lanes>(
        &self,
        lanes: L,
        mut change: [L::Four; D],
        hoop: f64,
        f_old: &Matrix3<f64>,
    ) -> Matrix3<f64> {
        if self.backward {
            let one = SMatrix::<f64, D, D>::identity();
            if let Some(inverse) = (one - matrix(lanes, &change)).try_inverse() {
                change = columns(lanes, &(inverse - one));
            }
        }
        // Columns of F with a fourth number that is not used.
        let mut f = *f_old;
        for k in 0..3 {
            let mut column = lanes.load4([f_old[(0, k)], f_old[(1, k)], f_old[(2, k)], 0.0]);
            for j in 0..D {
                column = lanes.mul_add4(change[j], lanes.splat4(f_old[(j, k)]), column);
            }
            let column = lanes.store4(column);
            for i in 0..3 {
                f[(i, k)] = column[i];
            }
        }
        if self.transfers.kinematics == Kinematics::Axisymmetric {
            f.m33 *= if self.backward {
                1.0 / (1.0 - hoop)
            } else {
                1.0 + hoop
            };
        }
        f
    }

    /// Strain around the axis in the step.
    #[inline(always)]
    fn hoop<L: Lanes>(
        &self,
        lanes: L,
        gathered: &Gathered<L::Four, D>,
        x: &SVector<f64, D>,
    ) -> f64 {
        if self.transfers.kinematics == Kinematics::Axisymmetric {
            self.dt * lanes.store4(gathered.value)[0] / x[0]
        } else {
            0.0
        }
    }
}

/// Columns of the velocity gradient. Σ∇N = 0, so the particle's own velocity may be taken off; a node
/// without mass (N = 0 but ∇N ≠ 0, on the face of a cell) then moves with the particle.
#[inline(always)]
fn gradient<L: Lanes, const D: usize>(lanes: L, gathered: &Gathered<L::Four, D>) -> [L::Four; D] {
    let mut columns = gathered.gradient;
    for column in &mut columns {
        let massive = lanes.store4(*column)[MASSIVE];
        *column = lanes.mul_add4(gathered.value, lanes.splat4(-massive), *column);
    }
    columns
}

/// Columns times a number.
#[inline(always)]
fn scaled<L: Lanes, const D: usize>(lanes: L, columns: &[L::Four; D], factor: f64) -> [L::Four; D] {
    let mut scaled = *columns;
    for column in &mut scaled {
        *column = lanes.mul4(*column, lanes.splat4(factor));
    }
    scaled
}

/// The matrix of these columns.
#[inline(always)]
fn matrix<L: Lanes, const D: usize>(lanes: L, columns: &[L::Four; D]) -> SMatrix<f64, D, D> {
    let mut matrix = SMatrix::zeros();
    for j in 0..D {
        let column = lanes.store4(columns[j]);
        for i in 0..D {
            matrix[(i, j)] = column[i];
        }
    }
    matrix
}

/// The columns of a matrix.
#[inline(always)]
fn columns<L: Lanes, const D: usize>(lanes: L, matrix: &SMatrix<f64, D, D>) -> [L::Four; D] {
    let mut columns = [lanes.splat4(0.0); D];
    for j in 0..D {
        let mut column = [0.0; 4];
        for i in 0..D {
            column[i] = matrix[(i, j)];
        }
        columns[j] = lanes.load4(column);
    }
    columns
}
