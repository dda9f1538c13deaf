//! From particles to nodes without the law in between, and what every transfer needs.
//!
//! The particles of a window are summed into a window on the stack of one thread and the window is added
//! to the nodes. Batches of windows are worked on one by one: those of a batch have no node in common,
//! so every sum has one order and the same bits on any number of threads.

use fissure_grid::simd::{EIGHT, Lanes, Simd, SimdTask, read_numbers};
use fissure_grid::{FIELD, Gift, Grid, SUMS, Shape, Stencils};
use fissure_scene::{Body, Kinematics, Run, Scene, for_each_window};
use fissure_tensor::Sym;
use nalgebra::{SMatrix, SVector};

use crate::eight::{GiftColumns, positions};
use crate::nodes::{Field, NodeSums};
use crate::placement::Placement;
use crate::window::{CUBE, SQUARE, WindowSums};

/// The discretisation of a scene: everything a transfer needs besides the particles' numbers.
pub(crate) struct Transfers<'a, S, const D: usize> {
    pub grid: &'a Grid<D>,
    pub shape: &'a S,
    pub placement: &'a Placement<D>,
    pub kinematics: Kinematics,
    pub simd: Simd,
}

/// Mass and momentum of a particle.
#[inline(always)]
pub(crate) fn momentum_gift<const D: usize>(
    mass: f64,
    velocity: &SVector<f64, D>,
    affine: Option<&SMatrix<f64, D, D>>,
) -> Gift<D> {
    let mut gift = Gift::default();
    for i in 0..D {
        gift.value[i] = mass * velocity[i];
    }
    gift.value[NodeSums::<D>::MASS] = mass;
    if let Some(affine) = affine {
        for j in 0..D {
            for i in 0..D {
                gift.sloped[j][i] = mass * affine[(i, j)];
            }
        }
    }
    gift
}

/// Adds the internal force of a stress: `−V (σ·∇N + σ_θθ N e_r / r)`, N.
#[inline(always)]
pub(crate) fn add_stress<const D: usize>(
    gift: &mut Gift<D>,
    kinematics: Kinematics,
    stress: &Sym,
    volume: f64,
    x: &SVector<f64, D>,
) {
    let full = stress.to_matrix();
    for j in 0..D {
        for i in 0..D {
            gift.sloped[j][NodeSums::<D>::FORCE + i] = -volume * full[(i, j)];
        }
    }
    if kinematics == Kinematics::Axisymmetric {
        gift.value[NodeSums::<D>::FORCE] = -volume * stress.zz() / x[0];
    }
}

impl<S: Shape<D>, const D: usize> Transfers<'_, S, D> {
    /// Stencil of a particle at the start of the step.
    #[inline]
    pub(crate) fn stencil(
        &self,
        body: &Body<D>,
        tile: [i32; D],
        index: usize,
    ) -> Option<S::Stencil> {
        let motion = &body.particles().motion;
        self.stencil_at(
            body.half_edges(),
            tile,
            &motion.position[index],
            &motion.deformation_gradient[index],
        )
    }

    /// Stencil of a particle at `x` with the deformation gradient `f`.
    #[inline(always)]
    pub(crate) fn stencil_at(
        &self,
        half_edges: &SMatrix<f64, D, D>,
        tile: [i32; D],
        x: &SVector<f64, D>,
        f: &nalgebra::Matrix3<f64>,
    ) -> Option<S::Stencil> {
        let domain = self.shape.domain(half_edges, &Body::<D>::in_space(f));
        self.shape.stencil(self.grid, tile, x, &domain)
    }

    /// Stencils of eight particles at `x`, with the deformation gradients of the first eight of these rows; the last
    /// one stands in for those that are not there.
    #[inline(always)]
    pub(crate) fn stencils_at(
        &self,
        half_edges: &SMatrix<f64, D, D>,
        tile: [i32; D],
        x: &[[f64; EIGHT]; D],
        f: &[nalgebra::Matrix3<f64>],
    ) -> S::Stencils {
        let domain = |place: usize| {
            let f = &f[place.min(f.len() - 1)];
            self.shape.domain(half_edges, &Body::<D>::in_space(f))
        };
        self.shape.stencils(self.grid, tile, x, domain)
    }

    /// Sums to the nodes what `give` says of every particle: by value, and with `SLOPED` by gradient
    /// and weighted arm.
    ///
    /// # Errors
    /// Body and index of a particle that reaches off the grid.
    pub(crate) fn spread<const SLOPED: bool>(
        &self,
        scene: &Scene<D>,
        sums: &mut NodeSums<D>,
        give: impl Fn(&Body<D>, usize) -> Gift<D> + Sync,
    ) -> Result<(), (usize, usize)> {
        self.each_window(sums, &|body_index, runs, sums| match D {
            2 => self.spread_window::<SQUARE, SLOPED>(scene, body_index, runs, sums, &give),
            _ => self.spread_window::<CUBE, SLOPED>(scene, body_index, runs, sums, &give),
        })
    }

    fn spread_window<const N: usize, const SLOPED: bool>(
        &self,
        scene: &Scene<D>,
        body_index: usize,
        runs: &[Run],
        sums: &NodeSums<D>,
        give: &(impl Fn(&Body<D>, usize) -> Gift<D> + Sync),
    ) -> Result<(), (usize, usize)> {
        let number = runs[0].window;
        let mut window = WindowSums::<N>::zero();
        let task = SpreadRuns::<'_, S, _, D, SLOPED> {
            transfers: self,
            body: &scene.bodies()[body_index],
            tile: self.placement.coordinates(number),
            runs,
            give,
            window: &mut window.0,
        };
        self.simd.run(task).map_err(|index| (body_index, index))?;
        self.placement.nodes(number).add(&window.0, sums);
        Ok(())
    }

    /// Takes a nodal field to the particles and sums their masses times it back: `S⁺S v`, as mass
    /// and momentum.
    ///
    /// # Errors
    /// As [`spread`](Self::spread).
    pub(crate) fn relay(
        &self,
        scene: &Scene<D>,
        field: &Field,
        sums: &mut NodeSums<D>,
    ) -> Result<(), (usize, usize)> {
        self.each_window(sums, &|body_index, runs, sums| match D {
            2 => self.relay_window::<SQUARE, 64>(scene, body_index, runs, field, sums),
            _ => self.relay_window::<CUBE, 512>(scene, body_index, runs, field, sums),
        })
    }

    fn relay_window<const N: usize, const ENTRIES: usize>(
        &self,
        scene: &Scene<D>,
        body_index: usize,
        runs: &[Run],
        field: &Field,
        sums: &NodeSums<D>,
    ) -> Result<(), (usize, usize)> {
        let number = runs[0].window;
        let nodes = self.placement.nodes(number);
        let mut values = [[0.0; FIELD]; ENTRIES];
        nodes.load(field, &mut values);
        let mut window = WindowSums::<N>::zero();
        let task = RelayRuns {
            transfers: self,
            body: &scene.bodies()[body_index],
            tile: self.placement.coordinates(number),
            runs,
            values: values.as_flattened(),
            window: &mut window.0,
        };
        self.simd.run(task).map_err(|index| (body_index, index))?;
        nodes.add(&window.0, sums);
        Ok(())
    }

    /// Clears the sums and calls `work` on every window of every body, batch by batch.
    fn each_window(
        &self,
        sums: &mut NodeSums<D>,
        work: &(impl Fn(usize, &[Run], &NodeSums<D>) -> Result<(), (usize, usize)> + Sync),
    ) -> Result<(), (usize, usize)> {
        sums.clear(self.placement.node_count());
        let sums = &*sums;
        for (body, runs) in self.placement.batches() {
            for_each_window(runs, &|runs| work(body, runs, sums))?;
        }
        Ok(())
    }
}

struct SpreadRuns<'a, S, G, const D: usize, const SLOPED: bool> {
    transfers: &'a Transfers<'a, S, D>,
    body: &'a Body<D>,
    tile: [i32; D],
    runs: &'a [Run],
    give: &'a G,
    window: &'a mut [[f64; SUMS]],
}

impl<S: Shape<D>, G: Fn(&Body<D>, usize) -> Gift<D>, const D: usize, const SLOPED: bool> SimdTask
    for SpreadRuns<'_, S, G, D, SLOPED>
{
    type Output = Result<(), usize>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Result<(), usize> {
        let motion = self.body.motion();
        for run in self.runs {
            let (start, end) = (run.start as usize, run.end as usize);
            for first in (start..end).step_by(EIGHT) {
                let stencils = self.transfers.stencils_at(
                    self.body.half_edges(),
                    self.tile,
                    &positions(lanes, &motion.position[first..end]),
                    &motion.deformation_gradient[first..end],
                );
                let count = EIGHT.min(end - first);
                let mut gifts = [Gift::default(); EIGHT];
                for (place, gift) in gifts.iter_mut().enumerate().take(count) {
                    if !stencils.fits(place) {
                        return Err(first + place);
                    }
                    *gift = (self.give)(self.body, first + place);
                }
                stencils.scatter::<L, SLOPED>(lanes, &gifts, count, self.window);
            }
        }
        Ok(())
    }
}

struct RelayRuns<'a, S, const D: usize> {
    transfers: &'a Transfers<'a, S, D>,
    body: &'a Body<D>,
    tile: [i32; D],
    runs: &'a [Run],
    values: &'a [f64],
    window: &'a mut [[f64; SUMS]],
}

impl<S: Shape<D>, const D: usize> SimdTask for RelayRuns<'_, S, D> {
    type Output = Result<(), usize>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Result<(), usize> {
        let particles = self.body.particles();
        let motion = self.body.motion();
        for run in self.runs {
            let (start, end) = (run.start as usize, run.end as usize);
            for first in (start..end).step_by(EIGHT) {
                let stencils = self.transfers.stencils_at(
                    self.body.half_edges(),
                    self.tile,
                    &positions(lanes, &motion.position[first..end]),
                    &motion.deformation_gradient[first..end],
                );
                let count = EIGHT.min(end - first);
                if let Some(place) = (0..count).find(|&place| !stencils.fits(place)) {
                    return Err(first + place);
                }
                let gathered = stencils.gather::<L, false, false>(lanes, self.values);
                let mut v = [lanes.splat(0.0); D];
                v.copy_from_slice(&gathered.value[..D]);
                let mass = read_numbers(lanes, &particles.mass[first..end]);
                let gifts = GiftColumns::momentum(lanes, mass, &v).rows::<L, false>(lanes);
                stencils.scatter::<L, false>(lanes, &gifts, count, self.window);
            }
        }
        Ok(())
    }
}
