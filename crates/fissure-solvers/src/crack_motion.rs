//! Cracks are carried by the nodes: both faces of every vertex move with the field of their side.
//!
//! A step may strain the particles with another field than the one that moves them. The line goes with the particles; how
//! far its faces have parted is the sum of what strained, for that is what the stress beside them answers to. Were it the
//! sum of what moved, the two would drift apart while the faces touch, since contact stops only one way: a crack that has
//! been shut would be held open, at rest, by faces that believe they touch.

use fissure_grid::{Grid, Shape, Stencil, Window, shape::Linear, tile_of};
use fissure_scene::{
    CarriedCrack, CrackLine, End, EndState, Scene, Side, SolveError, VertexMotion,
};
use nalgebra::{SMatrix, SVector, Vector2};

use crate::groups::{between, plane};
use crate::placement::{CRACKS_MOVE, Placement};
use crate::release::SplittingCrack;

/// How far beside the line a face is asked for, in cells: enough to be beyond round-off.
const BESIDE: f64 = 1e-6;

/// Segments longer than this, in cells, are divided.
const LONGEST: f64 = 0.5;

/// Divides long segments of cracks that are new or have grown, so that the vertices see what the faces do between nodes.
/// Others are left as they are, though strain may have made a segment longer: an edit of something else is not to change
/// them.
pub(crate) fn refine<const D: usize>(
    scene: &mut Scene<D>,
    grid: &Grid<D>,
    placement: &Placement<D>,
) {
    let known = placement.crack_vertices(scene);
    if vertices(scene).eq(known.iter().copied()) {
        return;
    }
    let longest = LONGEST * grid.spacing();
    for (index, crack) in scene.cracks_mut().iter_mut().enumerate() {
        if known.get(index) != Some(&crack.line().points().len()) {
            crack.refine(longest);
        }
    }
}

/// Of each crack how many vertices it has.
pub(crate) fn vertices<const D: usize>(scene: &Scene<D>) -> impl Iterator<Item = usize> {
    scene
        .cracks()
        .iter()
        .map(|crack| crack.line().points().len())
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

/// What a node does to the faces of cracks in a step.
pub(crate) struct NodeWay<const D: usize> {
    /// How much it counts, in [0, 1].
    pub weight: f64,
    /// Its displacement, m.
    pub moved: SVector<f64, D>,
    /// The one that strains the particles, m.
    pub straining: SVector<f64, D>,
}

impl<const D: usize> NodeWay<D> {
    /// Of a scheme that strains with what moves.
    #[cfg(feature = "implicit")]
    pub(crate) fn of(displacement: SVector<f64, D>) -> Self {
        Self {
            weight: 1.0,
            moved: displacement,
            straining: displacement,
        }
    }
}

/// All cracks, moved by what `way` says of each node; `None` where nothing moves it. Faces are interpolated linearly from the nodes of their side; a face without
/// nodes moves with the other.
///
/// # Errors
/// A crack that would have no length left somewhere.
pub(crate) fn carried<const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<D>,
    placement: &Placement<D>,
    way: impl Fn(usize) -> Option<NodeWay<D>>,
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
    for (index, crack) in scene.cracks().iter().enumerate() {
        let motions = faces.motions(index, crack);
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

/// What a face does in a step, m: as of [`NodeWay`].
#[derive(Clone, Copy, Default)]
struct FaceWay {
    moved: Vector2<f64>,
    straining: Vector2<f64>,
}

/// A point beside a crack.
struct Face {
    x: Vector2<f64>,
    /// Which crack.
    of: usize,
    side: Side,
}

struct Faces<'a, F, const D: usize> {
    cracks: Vec<SplittingCrack<'a>>,
    grid: &'a Grid<D>,
    placement: &'a Placement<D>,
    way: &'a F,
}

impl<F: Fn(usize) -> Option<NodeWay<D>>, const D: usize> Faces<'_, F, D> {
    fn motions(&self, of: usize, crack: &CrackLine) -> Vec<VertexMotion> {
        let line = crack.line();
        let last = line.points().len() - 1;
        let moved = line.points().iter().enumerate().map(|(vertex, x)| {
            let aside = line.normal_at(vertex) * (BESIDE * self.grid.spacing());
            let face = |x, side| self.face(&Face { x, of, side });
            let [plus, minus] = [face(x + aside, Side::Plus), face(x - aside, Side::Minus)];
            let both = [plus.or(minus), minus.or(plus)];
            let [plus, minus] = both.map(Option::unwrap_or_default);
            // Behind a tip the faces part; at the tip they are one.
            let end = match vertex {
                0 => Some(End::First),
                v if v == last => Some(End::Last),
                _ => None,
            };
            let tip = end.is_some_and(|end| crack.end(end) == EndState::Tip);
            VertexMotion {
                displacement: (plus.moved + minus.moved) * 0.5,
                jump: if tip {
                    Vector2::zeros()
                } else {
                    plus.straining - minus.straining
                },
            }
        });
        moved.collect()
    }

    /// Displacements of a point beside a crack; `None` off the grid and where no node of its side
    /// moves.
    fn face(&self, face: &Face) -> Option<FaceWay> {
        let place = SVector::from_fn(|axis, _| face.x[axis]);
        let cells = self.placement.tiles.cells();
        let window = Window::of_tile(tile_of(self.grid.cell(&place)?, cells), cells);
        let stencil = Linear.stencil(self.grid, &window, &place, &SMatrix::zeros())?;
        let (mut sum, mut weights) = (FaceWay::default(), 0.0);
        stencil.visit_values(|entry, weight| {
            let index = window.node(entry);
            if let Some(way) = self.way_at(index, face) {
                let share = weight * way.weight;
                sum.moved += plane(&way.moved) * share;
                sum.straining += plane(&way.straining) * share;
                weights += share;
            }
        });
        // A far corner alone says nothing of the face.
        (weights > 0.05).then(|| FaceWay {
            moved: sum.moved / weights,
            straining: sum.straining / weights,
        })
    }

    /// What the field of a face's side does at a node.
    fn way_at(&self, index: [i32; D], face: &Face) -> Option<NodeWay<D>> {
        let node = self.placement.node(index)?;
        let splits = &self.placement.splits;
        let copies = splits.copies_of(node);
        if copies.is_empty() {
            return (self.way)(node);
        }
        let copies = &splits.copies[copies];
        let all = copies.iter().fold(0, |all, copy| all | copy.label.cracks);
        let cracks = self.cracks_between(face, &plane(&self.grid.node(index)), all);
        copies.iter().find_map(|copy| {
            let same = copy.label.cracks == cracks;
            same.then(|| (self.way)(copy.node as usize)).flatten()
        })
    }

    /// The cracks between a face and a node, as in a label; `all` are those of the node's labels.
    ///
    /// A node all but on the face's own crack may have been on its other side when the particles were told apart. On
    /// which it was the labels know: its own side's particles do not have the crack in between.
    fn cracks_between(&self, face: &Face, node: &Vector2<f64>, all: u64) -> u64 {
        let cracks = between(&self.cracks, 0..self.cracks.len(), &face.x, node);
        let near = CRACKS_MOVE * self.grid.spacing();
        if self.cracks[face.of].line.foot(node).distance > near {
            return cracks;
        }
        let [plus, minus] = [1, 2].map(|bit: u64| bit << (2 * face.of));
        let own = match face.side {
            Side::Plus => plus,
            Side::Minus => minus,
        };
        match all & (plus | minus) {
            one if one == plus || one == minus => cracks & !(plus | minus) | own & one,
            _ => cracks,
        }
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
