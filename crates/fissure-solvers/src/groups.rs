//! Groups of particles: those whose numbers go to the same fields of the same nodes.
//!
//! A particle's field at a node depends on the body it is of (contact gives bodies fields of their
//! own) and on the cracks between the particle and the node: Nairn's rule [Nairn 2003, CRAMP] asks
//! whether the straight way from the particle to the node crosses a crack, and from which side.
//! Nodes that no way to crosses, ahead of a tip for example, keep one field, so that a tip need not
//! lie on a node. Particles that agree at all nodes of their tile's window make a group.

use fissure_grid::{Grid, Window};
use fissure_scene::{Scene, Side, SolveError};
use nalgebra::{SVector, Vector2};

use crate::release::SplittingCrack;

/// Most cracks of a scene: two bits each of a [`Label`].
const MOST_CRACKS: usize = 32;

/// Which field a particle's numbers go to at a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Label {
    /// [`Scene::velocity_field`] of its body.
    pub body: u32,
    /// Cracks between the particle and the node: bit `2 c` if the particle is on the plus side of
    /// crack `c`, bit `2 c + 1` if it is on its minus side.
    pub cracks: u64,
}

impl Label {
    /// The first crack that only one of the labels has between it and the node, and whether the
    /// second label is on its plus side.
    pub(crate) fn crack_between(self, other: Self) -> Option<(usize, bool)> {
        let difference = self.cracks ^ other.cracks;
        let bit = difference.trailing_zeros();
        // Who has the bit is on the side it names, the other on the opposite one.
        let plus = bit.is_multiple_of(2);
        let of_other = other.cracks >> bit.min(63) & 1 == 1;
        (difference != 0).then_some((bit as usize / 2, plus == of_other))
    }
}

/// Of every number up to a window's last entry the cracks in between, none for those that are no entry; `None` where there
/// are none at all.
pub(crate) type Pattern = Option<Box<[u64]>>;

/// The groups of a scene's particles, in an order that depends on what they are alone.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups {
    groups: Vec<(u32, Pattern)>,
}

impl Groups {
    /// The groups among these, as `(field of the body, pattern)`.
    pub(crate) fn of(mut all: Vec<(u32, &Pattern)>) -> Self {
        all.sort_unstable();
        all.dedup();
        let owned = all
            .into_iter()
            .map(|(body, pattern)| (body, pattern.clone()));
        Self {
            groups: owned.collect(),
        }
    }

    /// Number of a group.
    pub(crate) fn find(&self, body: u32, pattern: &Pattern) -> u32 {
        let key = (body, pattern);
        let found = self.groups.binary_search_by(|(b, p)| (*b, p).cmp(&key));
        found.unwrap_or(0) as u32
    }

    /// Its label at an entry of a window.
    pub(crate) fn label(&self, group: u32, entry: usize) -> Label {
        let (body, pattern) = &self.groups[group as usize];
        Label {
            body: *body,
            cracks: pattern.as_ref().map_or(0, |cracks| cracks[entry]),
        }
    }

    /// The cracks between its particles and the nodes of their window.
    pub(crate) fn pattern(&self, group: u32) -> &Pattern {
        &self.groups[group as usize].1
    }

    /// Whether two groups may have different labels somewhere.
    pub(crate) fn may_differ(&self, a: u32, b: u32) -> bool {
        let (a, b) = (&self.groups[a as usize], &self.groups[b as usize]);
        a.0 != b.0 || a.1.is_some() || b.1.is_some()
    }
}

/// The cracks near a tile, asked for one particle after another.
pub(crate) struct Between<'a, const D: usize> {
    grid: &'a Grid<D>,
    cracks: Vec<SplittingCrack<'a>>,
    window: Option<Window<D>>,
    near: Vec<usize>,
}

impl<'a, const D: usize> Between<'a, D> {
    /// # Errors
    /// More cracks than labels have bits for, or a crack in space.
    pub(crate) fn new(grid: &'a Grid<D>, scene: &'a Scene<D>) -> Result<Self, SolveError> {
        let cracks = scene.cracks();
        if cracks.len() > MOST_CRACKS {
            return Err(SolveError::Unsupported {
                what: "more than 32 cracks",
            });
        }
        Ok(Self {
            grid,
            cracks: SplittingCrack::all(cracks, grid.spacing()),
            window: None,
            near: Vec::new(),
        })
    }

    /// The cracks between a particle at `x` and the nodes of its window.
    pub(crate) fn pattern(&mut self, window: &Window<D>, x: &SVector<f64, D>) -> Pattern {
        if self.cracks.is_empty() || D != 2 {
            return None;
        }
        if self.window != Some(*window) {
            self.window = Some(*window);
            self.find_near(window);
        }
        if self.near.is_empty() {
            return None;
        }
        let x = plane(x);
        let mut pattern = vec![0; window.last() + 1];
        for entry in window.entries() {
            pattern[entry] = self.cracks_between(&x, &self.node(window, entry));
        }
        let split = pattern.iter().any(|&cracks| cracks != 0);
        split.then(|| pattern.into())
    }

    fn cracks_between(&self, from: &Vector2<f64>, to: &Vector2<f64>) -> u64 {
        between(&self.cracks, self.near.iter().copied(), from, to)
    }

    fn find_near(&mut self, window: &Window<D>) {
        let corner = |entry| self.node(window, entry);
        let (low, high) = (corner(0), corner(window.last()));
        let near = |index: &usize| {
            let [from, to] = self.cracks[*index].line.bounds();
            (0..2).all(|axis| from[axis] <= high[axis] && to[axis] >= low[axis])
        };
        self.near = (0..self.cracks.len()).filter(near).collect();
    }

    fn node(&self, window: &Window<D>, entry: usize) -> Vector2<f64> {
        plane(&self.grid.node(window.node(entry)))
    }
}

/// The cracks that the way from a particle to a node crosses, as in a [`Label`], with [`SplittingCrack`]s.
pub(crate) fn between(
    cracks: &[SplittingCrack<'_>],
    near: impl Iterator<Item = usize>,
    from: &Vector2<f64>,
    to: &Vector2<f64>,
) -> u64 {
    near.map(|crack| match cracks[crack].crossing(from, to) {
        None => 0,
        Some(Side::Minus) => 1 << (2 * crack),
        Some(Side::Plus) => 2 << (2 * crack),
    })
    .sum()
}

/// A point of a plane scene.
pub(crate) fn plane<const D: usize>(x: &SVector<f64, D>) -> Vector2<f64> {
    Vector2::new(x[0], x[1])
}
