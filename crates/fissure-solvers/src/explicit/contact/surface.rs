//! The particles that reach split nodes: where they are and how far they extend.

use fissure_grid::{Shape, Stencil};
use fissure_scene::{Body, Run, Scene};
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use crate::splits::{NONE, SplitWindow};
use crate::transfers::Transfers;

/// A weight below this is round-off: the particle does not reach the node.
const REACHED: f64 = 1e-10;

/// The particles near split nodes.
pub(super) struct Surface<'a, S, const D: usize> {
    pub transfers: &'a Transfers<'a, S, D>,
    pub scene: &'a Scene<D>,
}

/// The particles of a field that reach a node.
#[derive(Clone, Debug, Default)]
pub(super) struct Cloud<const D: usize> {
    pub places: Vec<SVector<f64, D>>,
    /// Half edges of their domains, as columns.
    edges: Vec<SMatrix<f64, D, D>>,
}

impl<const D: usize> Cloud<D> {
    /// The farthest place of their domains along `normal`, m. The domain counts as the ellipsoid in
    /// it, `r² = Σ_k (n·F e_k)²`, which is as wide as the domain along its edges and does not stick
    /// out at its corners.
    pub(super) fn extent(&self, normal: &SVector<f64, D>) -> f64 {
        let particles = self.places.iter().zip(&self.edges);
        particles
            .map(|(x, edges)| x.dot(normal) + edges.tr_mul(normal).norm())
            .fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Corners of the box around a cloud.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<const D: usize> {
    low: SVector<f64, D>,
    high: SVector<f64, D>,
}

impl<const D: usize> Bounds<D> {
    const EMPTY: Self = Self {
        low: SVector::<f64, D>::from_array_storage(nalgebra::ArrayStorage([[f64::INFINITY; D]])),
        high: SVector::<f64, D>::from_array_storage(nalgebra::ArrayStorage([
            [f64::NEG_INFINITY; D]
        ])),
    };

    fn merge(&mut self, other: &Self) {
        self.low = self.low.inf(&other.low);
        self.high = self.high.sup(&other.high);
    }

    /// Whether the boxes are nearer than `margin` along every axis.
    pub(super) fn is_near(&self, other: &Self, margin: f64) -> bool {
        let gap = (other.low - self.high).sup(&(self.low - other.high));
        gap.iter().all(|&gap| gap < margin)
    }
}

impl<S: Shape<D>, const D: usize> Surface<'_, S, D> {
    /// The box around the particles of every field at split nodes.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(super) fn bounds(&self) -> Result<Vec<Bounds<D>>, (usize, usize)> {
        let parts: Vec<_> = self
            .windows()
            .par_iter()
            .map(|&(body, window, runs)| {
                let mut boxes = vec![Bounds::EMPTY; window.copies.len()];
                self.each_particle(body, window, runs, |entry, place, edges| {
                    let half = SVector::from_fn(|axis, _| edges.row(axis).norm());
                    boxes[entry].merge(&Bounds {
                        low: place - half,
                        high: place + half,
                    });
                })?;
                Ok((window, boxes))
            })
            .collect::<Result<_, (usize, usize)>>()?;
        let copies = self.transfers.placement.splits.copies.len();
        let mut bounds = vec![Bounds::EMPTY; copies];
        for (window, boxes) in parts {
            for (&copy, part) in window.copies.iter().zip(&boxes) {
                if copy != NONE {
                    bounds[copy as usize].merge(part);
                }
            }
        }
        Ok(bounds)
    }

    /// The particles of the `wanted` fields at split nodes.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(super) fn clouds(&self, wanted: &[bool]) -> Result<Vec<Cloud<D>>, (usize, usize)> {
        let parts: Vec<Vec<_>> = self
            .windows()
            .par_iter()
            .map(|&(body, window, runs)| {
                let mut points = Vec::new();
                let is_wanted = |&copy: &u32| copy != NONE && wanted[copy as usize];
                if window.copies.iter().any(is_wanted) {
                    self.each_particle(body, window, runs, |entry, place, edges| {
                        let copy = window.copies[entry];
                        if is_wanted(&copy) {
                            points.push((copy, place, edges));
                        }
                    })?;
                }
                Ok(points)
            })
            .collect::<Result<_, (usize, usize)>>()?;
        let mut clouds = vec![Cloud::default(); wanted.len()];
        for (copy, place, edges) in parts.into_iter().flatten() {
            let cloud = &mut clouds[copy as usize];
            cloud.places.push(place);
            cloud.edges.push(edges);
        }
        Ok(clouds)
    }

    /// The windows with split nodes and the runs of each body in them.
    fn windows(&self) -> Vec<(usize, &SplitWindow, &[Run])> {
        let placement = self.transfers.placement;
        let mut windows = Vec::new();
        for (body, runs) in placement.runs.iter().enumerate() {
            for runs in runs.chunk_by(|a, b| a.window == b.window) {
                if let Some(window) = placement.split_window(runs[0].window) {
                    windows.push((body, window, runs));
                }
            }
        }
        windows
    }

    /// Calls `visit(window entry, place, half edges)` for every split node that a particle of the
    /// runs reaches.
    fn each_particle(
        &self,
        body: usize,
        window: &SplitWindow,
        runs: &[Run],
        mut visit: impl FnMut(usize, SVector<f64, D>, SMatrix<f64, D, D>),
    ) -> Result<(), (usize, usize)> {
        let around = self.transfers.placement.window(runs[0].window);
        let owner = &self.scene.bodies()[body];
        let motion = owner.motion();
        let particles = runs
            .iter()
            .flat_map(|run| run.start as usize..run.end as usize);
        for index in particles {
            let stencil = self.transfers.stencil(owner, &around, index);
            let place = motion.position[index];
            let f = Body::<D>::in_space(&motion.deformation_gradient[index]);
            let edges = f * owner.half_edges();
            stencil.ok_or((body, index))?.visit_values(|entry, weight| {
                if weight > REACHED && window.copies[entry] != NONE {
                    visit(entry, place, edges);
                }
            });
        }
        Ok(())
    }
}
