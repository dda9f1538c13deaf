//! From nodes to particles and on to the nodes again, tile by tile.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use fissure_grid::simd::{EIGHT, Lanes, SimdTask, prefetch_rows, write_columns};
use fissure_grid::{ByArms, ByArmsAndSlopes, ByNothing, FIELD, SUMS, Shape, Stencils, Window};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::{KernelFailure, Run, RunConstants, RunKernel, WindowKernel};
use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use super::particle::{StoredStrain, volumes};
use super::settings::Transfer;
use crate::eight::{momentum_of, positions, read_matrices, read_symmetric};
use crate::nodes::{Field, NodeSums};
use crate::transfers::Transfers;
use crate::window::{CUBE, CUBE_SUMS, SQUARE, SQUARE_SUMS, WindowSums};

/// What particles give to the nodes at the end of a pass over them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Giving {
    /// Nothing: a pass that is made again.
    Nothing,
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
    /// The same where it takes the place of the functions' gradients, for strains and forces.
    pub by_arms: Option<f64>,
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
    /// Whether particles have bands of their own.
    pub banded: bool,
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
            2 => self.on_window_of::<SQUARE_SUMS, SQUARE>(window, work),
            _ => self.on_window_of::<CUBE_SUMS, CUBE>(window, work),
        }
    }
}

impl<S: Shape<D>, const D: usize> StepKernel<'_, S, D> {
    fn on_window_of<const N: usize, const ENTRIES: usize>(
        &self,
        window: u32,
        work: &mut dyn FnMut(&mut dyn WindowKernel<D>) -> Result<(), KernelFailure>,
    ) -> Result<(), KernelFailure> {
        let placement = self.transfers.placement;
        let nodes = placement.nodes(window);
        let mut field = [[0.0; FIELD]; ENTRIES];
        nodes.load(self.field, &mut field);
        let carried = self.carried.map(|carried| {
            let mut values = [[0.0; FIELD]; ENTRIES];
            nodes.load(carried, &mut values);
            values
        });
        let mut sums = WindowSums::<N>::zero();
        let done = work(&mut Tile {
            pass: self,
            window: placement.window(window),
            field: field.as_flattened(),
            carried: carried.as_ref().map(|values| values.as_flattened()),
            sums: &mut sums.0,
            strains: [StoredStrain::NONE; Run::MAX / EIGHT],
            work: [0.0; EIGHT],
        });
        nodes.add(&sums.0, self.sums);
        done
    }

    pub(super) fn is_affine(&self) -> bool {
        self.transfer.is_affine()
    }
}

/// A pass at work on a tile.
struct Tile<'a, S, const D: usize> {
    pass: &'a StepKernel<'a, S, D>,
    window: Window<D>,
    field: &'a [f64],
    carried: Option<&'a [f64]>,
    sums: &'a mut [[f64; SUMS]],
    /// Of the run at work, eight by eight, where their new stresses are to do work on them.
    strains: [StoredStrain; Run::MAX / EIGHT],
    /// Work on these strains, J: with the stress first that of the old stresses, else that of the new ones.
    work: [f64; EIGHT],
}

impl<S, const D: usize> Tile<'_, S, D> {
    /// Adds what the first particles of eight tell, J.
    #[inline(always)]
    fn add_work<L: Lanes>(&mut self, lanes: L, work: L::Eight, count: usize) {
        let counted = lanes.first(work, count);
        let sum = lanes.add(lanes.load(&self.work), counted);
        lanes.store(sum, &mut self.work);
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
        macro_rules! gather {
            ($gradient:expr, $moment:expr) => {
                simd.run(
                    GatherRun::<'_, '_, '_, '_, S, D, { $gradient }, { $moment }> {
                        tile: self,
                        constants,
                        old,
                        new,
                    },
                )
            };
        }
        // Which sums are made is known when this is compiled; all else is asked for eight particles at a time.
        let gathered = if S::MOMENTS && pass.by_arms.is_some() {
            gather!(false, true)
        } else if pass.is_affine() && pass.moves && S::MOMENTS {
            gather!(true, true)
        } else if pass.strains || pass.is_affine() {
            gather!(true, false)
        } else {
            gather!(false, false)
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
        self.pass.transfers.simd.run(ScatterRun {
            tile: self,
            constants,
            old,
            new,
        });
        std::mem::take(&mut self.work).iter().sum()
    }

    fn sets_external(&self) -> bool {
        self.pass.banded
    }

    fn band(&self, at: &SVector<f64, D>) -> Option<Band> {
        self.pass.transfers.shape.band_at(at)
    }
}

/// Gathers, by `GRADIENT` and `MOMENT` too, and does what the pass is for.
struct GatherRun<'t, 'a, 'c, 'n, S, const D: usize, const GRADIENT: bool, const MOMENT: bool> {
    tile: &'t mut Tile<'a, S, D>,
    constants: &'c RunConstants<'c>,
    old: &'c MotionSlices<'c, D>,
    new: &'c mut MotionSlicesMut<'n, D>,
}

impl<S: Shape<D>, const D: usize, const GRADIENT: bool, const MOMENT: bool> SimdTask
    for GatherRun<'_, '_, '_, '_, S, D, GRADIENT, MOMENT>
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
            let rows = first..(first + EIGHT).min(old.len());
            prefetch(lanes, first, constants, old, new);
            let x = positions(lanes, &old.position[first..]);
            let f = &old.deformation_gradient[first..];
            let stencils = pass
                .transfers
                .stencils_at(lanes, &pass.half_edges, &tile.window, &x, f);
            if stencils.fitting() != u8::MAX {
                let outside = rows.clone().find(|row| !stencils.fits(row - first));
                return Err(outside.unwrap_or(first));
            }
            let gathered = stencils.gather::<L, GRADIENT, MOMENT>(lanes, tile.field);
            let mut inside = true;
            if pass.moves {
                // Velocities with an affine part are those of the one field.
                let carried = if MOMENT { None } else { tile.carried };
                let carried =
                    carried.map(|carried| stencils.gather::<L, false, false>(lanes, carried));
                inside = pass.move_eight(lanes, first, &x, (&gathered, carried.as_ref()), old, new);
                if (GRADIENT || MOMENT) && pass.is_affine() {
                    pass.write_affine::<L, MOMENT>(lanes, first, &gathered, new);
                }
            }
            if (GRADIENT || MOMENT) && pass.strains {
                let f_old = read_matrices(lanes, f);
                let strain = pass.strain::<L, GRADIENT>(lanes, &x, &gathered);
                if pass.backward {
                    let stress = read_symmetric(lanes, &old.stress[first..]);
                    let volume = volumes(lanes, first, constants.volume, &f_old);
                    let work = strain.work::<L, D>(lanes, &stress);
                    tile.add_work(lanes, lanes.mul(volume, work), rows.len());
                } else {
                    strain.store::<L, D>(lanes, &mut tile.strains[first / EIGHT]);
                }
                let f = pass.strained(lanes, &strain, &f_old);
                write_columns(
                    lanes,
                    f.as_flattened(),
                    &mut new.deformation_gradient[first..],
                );
            }
            if !inside {
                return Err(pass.first_outside(rows, new));
            }
        }
        Ok(())
    }
}

/// How many rows ahead of those at work columns are asked for: about as long as memory takes to answer.
const AHEAD: usize = 2 * EIGHT;

/// Asks for what the next particles will read and write. In a batch of runs they stand side by side, so that past the end
/// of a run are those of the next.
#[inline(always)]
fn prefetch<L: Lanes, const D: usize>(
    lanes: L,
    first: usize,
    constants: &RunConstants<'_>,
    old: &MotionSlices<'_, D>,
    new: &MotionSlicesMut<'_, D>,
) {
    let ahead = first + AHEAD;
    prefetch_rows(lanes, constants.mass, ahead);
    prefetch_rows(lanes, constants.volume, ahead);
    prefetch_rows(lanes, old.position, ahead);
    prefetch_rows(lanes, old.deformation_gradient, ahead);
    prefetch_rows(lanes, new.deformation_gradient, ahead);
    prefetch_rows(lanes, new.velocity, ahead);
    prefetch_rows(lanes, new.stress, ahead);
    prefetch_rows(lanes, new.affine, ahead);
}

struct ScatterRun<'t, 'a, 'c, S, const D: usize> {
    tile: &'t mut Tile<'a, S, D>,
    constants: &'c RunConstants<'c>,
    old: &'c MotionSlices<'c, D>,
    new: &'c MotionSlices<'c, D>,
}

impl<S: Shape<D>, const D: usize> SimdTask for ScatterRun<'_, '_, '_, S, D> {
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
        let (place, velocity) = match pass.giving {
            // Straining alone leaves the velocities of the trial as they were.
            Giving::AllBack => (old, old),
            Giving::MomentumBack => (old, new),
            _ => (new, new),
        };
        let forces = matches!(pass.giving, Giving::AllBack | Giving::AllOn);
        let works = pass.giving == Giving::AllOn;
        for first in (0..new.len()).step_by(EIGHT) {
            // Without motion or strain in this pass the trial holds them from the pass before.
            let x = positions(lanes, &place.position[first..]);
            let f = &place.deformation_gradient[first..];
            let stencils = pass
                .transfers
                .stencils_at(lanes, &pass.half_edges, &tile.window, &x, f);
            let rows = first..(first + EIGHT).min(new.len());
            let has_affine = pass.is_affine() && !velocity.affine.is_empty();
            let affine = has_affine.then(|| &velocity.affine[first..]);
            let mass = &constants.mass[first..];
            let mut gift = momentum_of(lanes, mass, &velocity.velocity[first..], affine);
            if forces {
                let f = read_matrices(lanes, &new.deformation_gradient[first..]);
                let volume = volumes(lanes, first, constants.volume, &f);
                let stress = read_symmetric(lanes, &new.stress[first..]);
                let kinematics = pass.transfers.kinematics;
                gift.add_stress(lanes, kinematics, &stress, volume, &x, pass.by_arms);
                if works {
                    let strain = tile.strains[first / EIGHT].load::<L, D>(lanes);
                    let work = strain.work::<L, D>(lanes, &stress);
                    tile.add_work(lanes, lanes.mul(volume, work), rows.len());
                }
            }
            // Where there are fewer than eight the last one stands in for the others.
            if stencils.fitting() != u8::MAX {
                pass.strayed.store(true, Relaxed);
            }
            if S::MOMENTS && pass.by_arms.is_some() {
                let gifts = gift.rows::<L, true>(lanes);
                stencils.scatter::<L, ByArms>(lanes, &gifts, rows.len(), tile.sums);
            } else if forces || has_affine {
                let gifts = gift.rows::<L, true>(lanes);
                stencils.scatter::<L, ByArmsAndSlopes>(lanes, &gifts, rows.len(), tile.sums);
            } else {
                let gifts = gift.rows::<L, false>(lanes);
                stencils.scatter::<L, ByNothing>(lanes, &gifts, rows.len(), tile.sums);
            }
        }
    }
}
