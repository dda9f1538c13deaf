//! Cracks are carried by the nodes: both faces of every vertex move with the field of their side.

use fissure_grid::{Grid, Shape, Stencil, shape::Linear, tile_of, window_node};
use fissure_scene::{CarriedCrack, CrackLine, End, EndState, Scene, SolveError, VertexMotion};
use nalgebra::{SMatrix, SVector, Vector2};

use crate::groups::{between, plane};
use crate::placement::Placement;
use crate::release::SplittingCrack;

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

/// The cracks of a scene as a step leaves them.
pub(crate) struct CarriedCracks {
    cracks: Vec<CarriedCrack>,
    /// The longest way of a vertex, m.
    farthest: f64,
}

impl CarriedCracks {
    /// Makes them the present ones.
    pub(crate) fn accept<const D: usize>(self, scene: &mut Scene<D>, placement: &mut Placement<D>) {
        placement.note_crack_motion(self.farthest);
        for (crack, carried) in scene.cracks_mut().iter_mut().zip(self.cracks) {
            crack.accept(carried);
        }
    }
}

/// All cracks, moved by nodal displacements. `way(node)` is how much a node counts, in [0, 1], and its displacement,
/// m; `None` where nothing moves it. Faces are interpolated linearly from the nodes of their side; a face without
/// nodes moves with the other.
///
/// # Errors
/// A crack that would have no length left somewhere.
pub(crate) fn carried<const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<D>,
    placement: &Placement<D>,
    way: impl Fn(usize) -> Option<(f64, SVector<f64, D>)>,
) -> Result<CarriedCracks, SolveError> {
    let faces = Faces {
        cracks: SplittingCrack::all(scene.cracks(), grid.spacing()),
        grid,
        placement,
        way: &way,
    };
    let mut moved = CarriedCracks {
        cracks: Vec::with_capacity(scene.cracks().len()),
        farthest: 0.0,
    };
    for crack in scene.cracks() {
        let motions = faces.motions(crack);
        let ways = motions.iter().map(|motion| motion.displacement.norm());
        moved.farthest = ways.fold(moved.farthest, f64::max);
        let carried = crack.carried(|vertex, _| motions[vertex]);
        let carried = carried.map_err(|source| SolveError::Crack {
            crack: crack.name().to_owned(),
            source,
            step: scene.step() + 1,
            time: scene.time(),
        })?;
        moved.cracks.push(carried);
    }
    Ok(moved)
}

struct Faces<'a, F, const D: usize> {
    cracks: Vec<SplittingCrack<'a>>,
    grid: &'a Grid<D>,
    placement: &'a Placement<D>,
    way: &'a F,
}

impl<F: Fn(usize) -> Option<(f64, SVector<f64, D>)>, const D: usize> Faces<'_, F, D> {
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
            let cracks = between(&self.cracks, 0..self.cracks.len(), x, &node);
            if let Some((counts, way)) = self.way_at(index, cracks) {
                sum += plane(&way) * (weight * counts);
                weights += weight * counts;
            }
        });
        // A far corner alone says nothing of the face.
        (weights > 0.05).then(|| sum / weights)
    }

    /// Weight and displacement of the field at a node that has these cracks in between.
    fn way_at(&self, index: [i32; D], cracks: u64) -> Option<(f64, SVector<f64, D>)> {
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

/// Normal from the first to the second face of a crack near `x`, and how far they are open, m: by
/// the displacements of its vertices since it was made, which is exact for a crack that was closed.
pub(crate) fn faces<const D: usize>(
    crack: &CrackLine,
    in_order: bool,
    x: &SVector<f64, D>,
) -> (SVector<f64, D>, f64) {
    let (normal, jump) = crack.face_at(&plane(x));
    let sign = if in_order { 1.0 } else { -1.0 };
    let mut towards = SVector::zeros();
    (towards[0], towards[1]) = (normal.x * sign, normal.y * sign);
    (towards, jump.dot(&normal))
}
