//! From particles to nodes without the law in between, and what every transfer needs.
//!
//! The particles of a window are summed into a window on the stack of one thread and the window is added
//! to the nodes. Batches of windows are worked on one by one: those of a batch have no node in common,
//! so every sum has one order and the same bits on any number of threads.

use fissure_grid::simd::{EIGHT, Lanes, Simd, SimdTask, read_numbers};
use fissure_grid::{
    ByArms, ByArmsAndSlopes, ByNothing, FIELD, Grid, SUMS, Shape, Stencils, Window,
};
use fissure_scene::{Body, Kinematics, Run, Scene, for_each_window};
use nalgebra::{SMatrix, SVector};

use crate::eight::{
    GiftColumns, determinant, momentum_of, positions, read_matrices, read_symmetric,
};
use crate::nodes::{Field, NodeSums};
use crate::placement::Placement;
use crate::window::{CUBE, CUBE_SUMS, SQUARE, SQUARE_SUMS, WindowSums};

/// The discretisation of a scene: everything a transfer needs besides the particles' numbers.
pub(crate) struct Transfers<'a, S, const D: usize> {
    pub grid: &'a Grid<D>,
    pub shape: &'a S,
    pub placement: &'a Placement<D>,
    pub kinematics: Kinematics,
    pub simd: Simd,
}

/// What particles give to the nodes as they are.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Given {
    /// Mass and momentum.
    Momentum {
        /// With that of their affine part, if they have one.
        affine: bool,
        /// With the internal forces before the step.
        forces: bool,
        /// The factor with which these go by weighted arms in place of gradients, 1/m².
        by_arms: Option<f64>,
    },
    /// Internal forces.
    #[cfg(feature = "implicit")]
    Forces(At),
}

impl Given {
    #[inline(always)]
    fn by_arms(self) -> Option<f64> {
        match self {
            Self::Momentum { by_arms, .. } => by_arms,
            #[cfg(feature = "implicit")]
            Self::Forces(_) => None,
        }
    }

    #[inline(always)]
    fn forces(self) -> Option<At> {
        match self {
            Self::Momentum { forces, .. } => forces.then_some(At::Start),
            #[cfg(feature = "implicit")]
            Self::Forces(at) => Some(at),
        }
    }
}

/// When internal forces are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum At {
    /// Before the step: of the present stresses.
    Start,
    /// After it: of the trial stresses, with gradients at the end of the step.
    #[cfg(feature = "implicit")]
    End,
}

impl<S: Shape<D>, const D: usize> Transfers<'_, S, D> {
    /// Stencil of a particle at the start of the step.
    #[inline]
    pub(crate) fn stencil(
        &self,
        body: &Body<D>,
        window: &Window<D>,
        index: usize,
    ) -> Option<S::Stencil> {
        let motion = &body.particles().motion;
        self.stencil_at(
            body.half_edges(),
            window,
            &motion.position[index],
            &motion.deformation_gradient[index],
        )
    }

    /// Stencil of a particle at `x` with the deformation gradient `f`.
    #[inline(always)]
    pub(crate) fn stencil_at(
        &self,
        half_edges: &SMatrix<f64, D, D>,
        window: &Window<D>,
        x: &SVector<f64, D>,
        f: &nalgebra::Matrix3<f64>,
    ) -> Option<S::Stencil> {
        let domain = self.shape.domain(half_edges, &Body::<D>::in_space(f));
        self.shape.stencil(self.grid, window, x, &domain)
    }

    /// Stencils of eight particles at `x`, with the deformation gradients of the first eight of these rows; the last
    /// one stands in for those that are not there.
    #[inline(always)]
    pub(crate) fn stencils_at<L: Lanes>(
        &self,
        lanes: L,
        half_edges: &SMatrix<f64, D, D>,
        window: &Window<D>,
        x: &[[f64; EIGHT]; D],
        f: &[nalgebra::Matrix3<f64>],
    ) -> S::Stencils {
        let domain = |place: usize| {
            let f = &f[place.min(f.len() - 1)];
            self.shape.domain(half_edges, &Body::<D>::in_space(f))
        };
        self.shape.stencils(lanes, self.grid, window, x, domain)
    }

    /// Sums to the nodes what the particles give.
    ///
    /// # Errors
    /// Body and index of a particle that reaches off the grid.
    pub(crate) fn spread(
        &self,
        scene: &Scene<D>,
        sums: &mut NodeSums<D>,
        given: Given,
    ) -> Result<(), (usize, usize)> {
        self.each_window(sums, &|body_index, runs, sums| match D {
            2 => self.spread_window::<SQUARE_SUMS>(scene, body_index, runs, sums, given),
            _ => self.spread_window::<CUBE_SUMS>(scene, body_index, runs, sums, given),
        })
    }

    fn spread_window<const N: usize>(
        &self,
        scene: &Scene<D>,
        body_index: usize,
        runs: &[Run],
        sums: &NodeSums<D>,
        given: Given,
    ) -> Result<(), (usize, usize)> {
        let number = runs[0].window;
        let mut window = WindowSums::<N>::zero();
        let task = SpreadRuns {
            transfers: self,
            body: &scene.bodies()[body_index],
            window: self.placement.window(number),
            runs,
            given,
            sums: &mut window.0,
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
            2 => self.relay_window::<SQUARE_SUMS, SQUARE>(scene, body_index, runs, field, sums),
            _ => self.relay_window::<CUBE_SUMS, CUBE>(scene, body_index, runs, field, sums),
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
            window: self.placement.window(number),
            runs,
            values: values.as_flattened(),
            sums: &mut window.0,
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

struct SpreadRuns<'a, S, const D: usize> {
    transfers: &'a Transfers<'a, S, D>,
    body: &'a Body<D>,
    window: Window<D>,
    runs: &'a [Run],
    given: Given,
    sums: &'a mut [[f64; SUMS]],
}

impl<S: Shape<D>, const D: usize> SpreadRuns<'_, S, D> {
    /// What the particles in these rows give.
    #[inline(always)]
    fn gift<L: Lanes>(&self, lanes: L, rows: std::ops::Range<usize>) -> GiftColumns<L::Eight, D> {
        let particles = self.body.particles();
        let present = &particles.motion;
        let mut gift = GiftColumns::nothing(lanes);
        #[cfg_attr(not(feature = "implicit"), allow(irrefutable_let_patterns))]
        if let Given::Momentum { affine, .. } = self.given {
            let affine = affine.then_some(&present.affine);
            // A column that is not there is empty.
            let affine = affine.and_then(|affine| affine.get(rows.clone()));
            let velocity = &present.velocity[rows.clone()];
            gift = momentum_of(lanes, &particles.mass[rows.clone()], velocity, affine);
        }
        let motion = match self.given.forces() {
            None => return gift,
            Some(At::Start) => present,
            #[cfg(feature = "implicit")]
            Some(At::End) => &particles.trial,
        };
        let f = read_matrices(lanes, &motion.deformation_gradient[rows.clone()]);
        let volume = read_numbers(lanes, &particles.volume[rows.clone()]);
        let volume = lanes.mul(volume, determinant(lanes, &f));
        let stress = read_symmetric(lanes, &motion.stress[rows.clone()]);
        let x = positions(lanes, &motion.position[rows.clone()]);
        let kinematics = self.transfers.kinematics;
        gift.add_stress(lanes, kinematics, &stress, volume, &x, self.given.by_arms());
        #[cfg(feature = "implicit")]
        if self.given.forces() == Some(At::End) {
            let f_old = read_matrices(lanes, &present.deformation_gradient[rows]);
            gift.move_gradients(lanes, &f_old, &f);
        }
        gift
    }
}

impl<S: Shape<D>, const D: usize> SimdTask for SpreadRuns<'_, S, D> {
    type Output = Result<(), usize>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Result<(), usize> {
        let motion = self.body.motion();
        let affine = matches!(self.given, Given::Momentum { affine: true, .. });
        let sloped = affine || self.given.forces().is_some();
        for run in self.runs {
            let (start, end) = (run.start as usize, run.end as usize);
            for first in (start..end).step_by(EIGHT) {
                let rows = first..(first + EIGHT).min(end);
                let stencils = self.transfers.stencils_at(
                    lanes,
                    self.body.half_edges(),
                    &self.window,
                    &positions(lanes, &motion.position[rows.clone()]),
                    &motion.deformation_gradient[rows.clone()],
                );
                if let Some(row) = rows.clone().find(|row| !stencils.fits(row - first)) {
                    return Err(row);
                }
                let gift = self.gift(lanes, rows.clone());
                if S::MOMENTS && self.given.by_arms().is_some() {
                    let gifts = gift.rows::<L, true>(lanes);
                    stencils.scatter::<L, ByArms>(lanes, &gifts, rows.len(), self.sums);
                } else if sloped {
                    let gifts = gift.rows::<L, true>(lanes);
                    stencils.scatter::<L, ByArmsAndSlopes>(lanes, &gifts, rows.len(), self.sums);
                } else {
                    let gifts = gift.rows::<L, false>(lanes);
                    stencils.scatter::<L, ByNothing>(lanes, &gifts, rows.len(), self.sums);
                }
            }
        }
        Ok(())
    }
}

struct RelayRuns<'a, S, const D: usize> {
    transfers: &'a Transfers<'a, S, D>,
    body: &'a Body<D>,
    window: Window<D>,
    runs: &'a [Run],
    values: &'a [f64],
    sums: &'a mut [[f64; SUMS]],
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
                    lanes,
                    self.body.half_edges(),
                    &self.window,
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
                stencils.scatter::<L, ByNothing>(lanes, &gifts, count, self.sums);
            }
        }
        Ok(())
    }
}
