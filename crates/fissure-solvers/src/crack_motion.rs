//! Cracks are carried by the nodes: both faces of every vertex move with the field of their side.

use fissure_grid::{Grid, Shape, Stencil, shape::Linear, tile_of, window_node};
use fissure_scene::{CrackLine, End, EndState, Scene, SolveError, VertexMotion};
use nalgebra::{SMatrix, SVector, Vector2};

use crate::groups::{between, plane};
use crate::placement::Placement;

/// How far beside the line a face is asked for, in cells: enough to be beyond round-off.
const BESIDE: f64 = 1e-6;

/// Segments longer than this, in cells, are divided.
const LONGEST: f64 = 0.5;

/// Divides long segments, so that the vertices see what the faces do between nodes.
pub(crate) fn refine<const D: usize>(scene: &mut Scene<D>, grid: &Grid<D>) {
    let longest = LONGEST * grid.spacing();
    if !scene.cracks().is_empty() {
        scene
            .cracks_mut()
            .iter_mut()
            .for_each(|crack| crack.refine(longest));
    }
}

/// Moves all vertices by nodal displacements: `way(node)` is `None` at a node that nothing moves. Faces are
/// interpolated linearly from the nodes of their side; a face without nodes moves with the other.
///
/// # Errors
/// A crack that would have no length left somewhere; none has moved then.
pub(crate) fn carry<const D: usize>(
    scene: &mut Scene<D>,
    grid: &Grid<D>,
    placement: &mut Placement<D>,
    way: impl Fn(usize) -> Option<SVector<f64, D>>,
) -> Result<(), SolveError> {
    if scene.cracks().is_empty() {
        return Ok(());
    }
    let faces = Faces {
        cracks: scene.cracks(),
        grid,
        placement: &*placement,
        way: &way,
    };
    let mut moved = scene.cracks().to_vec();
    let mut farthest = 0.0_f64;
    for crack in &mut moved {
        let motions = faces.motions(crack);
        let ways = motions.iter().map(|motion| motion.displacement.norm());
        farthest = ways.fold(farthest, f64::max);
        let carried = crack.carry(|vertex, _| motions[vertex]);
        carried.map_err(|source| SolveError::Crack {
            crack: crack.name().to_owned(),
            source,
            step: scene.step() + 1,
            time: scene.time(),
        })?;
    }
    placement.note_crack_motion(farthest);
    scene.cracks_mut().clone_from_slice(&moved);
    Ok(())
}

struct Faces<'a, F, const D: usize> {
    cracks: &'a [CrackLine],
    grid: &'a Grid<D>,
    placement: &'a Placement<D>,
    way: &'a F,
}

impl<F: Fn(usize) -> Option<SVector<f64, D>>, const D: usize> Faces<'_, F, D> {
    fn motions(&self, crack: &CrackLine) -> Vec<VertexMotion> {
        let line = crack.line();
        let last = line.points().len() - 1;
        let moved = line.points().iter().enumerate().map(|(vertex, x)| {
            let aside = line.normal_at(vertex) * (BESIDE * self.grid.spacing());
            let [plus, minus] = [x + aside, x - aside].map(|face| self.face(&face));
            let both = [plus.or(minus), minus.or(plus)];
            let [plus, minus] = both.map(|way| way.unwrap_or_else(Vector2::zeros));
            // Behind a tip the faces part; at the tip they are one.
            let end = match vertex {
                0 => Some(End::First),
                v if v == last => Some(End::Last),
                _ => None,
            };
            let tip = end.is_some_and(|end| crack.end(end) == EndState::Tip);
            VertexMotion {
                displacement: (plus + minus) * 0.5,
                jump: if tip { Vector2::zeros() } else { plus - minus },
            }
        });
        moved.collect()
    }

    /// Displacement of a point beside a crack; `None` off the grid and where no node of its side
    /// moves.
    fn face(&self, x: &Vector2<f64>) -> Option<Vector2<f64>> {
        let place = SVector::from_fn(|axis, _| x[axis]);
        let tile = tile_of(self.grid.cell(&place)?);
        let stencil = Linear.stencil(self.grid, tile, &place, &SMatrix::zeros())?;
        let (mut sum, mut weights) = (Vector2::zeros(), 0.0);
        stencil.visit_values(|entry, weight| {
            let index = window_node(tile, entry);
            let node = plane(&self.grid.node(index));
            let cracks = between(self.cracks, 0..self.cracks.len(), x, &node);
            if let Some(way) = self.way_at(index, cracks) {
                sum += plane(&way) * weight;
                weights += weight;
            }
        });
        // A far corner alone says nothing of the face.
        (weights > 0.05).then(|| sum / weights)
    }

    /// Displacement of the field at a node that has these cracks in between.
    fn way_at(&self, index: [i32; D], cracks: u64) -> Option<SVector<f64, D>> {
        let node = self.placement.node(index)?;
        let splits = &self.placement.splits;
        let mut copies = splits.copies_of(node);
        if copies.is_empty() {
            return (self.way)(node);
        }
        copies.find_map(|copy| {
            let copy = splits.copies[copy];
            let same = copy.label.cracks == cracks;
            same.then(|| (self.way)(copy.node as usize)).flatten()
        })
    }
}
