//! A mesh cut into patches, as a grid is into tiles.
//!
//! A **patch** is a set of elements with all nodes that its particles may reach: at most as many as the window of a tile
//! has entries. Where there is room the elements around it are included, so that a particle may leave the patch a
//! little before it is sorted anew. Patches of one colour have no node in common.

use nalgebra::SVector;

use crate::quads::MeshError;

/// Most nodes of a patch: the entries of the window of a narrow tile in the plane.
const MOST_NODES: usize = 64;
/// Most colours.
const MOST_COLOURS: usize = 256;

/// The nodes of a mesh and the patches that its elements fall into.
#[derive(Clone, Debug)]
pub struct Patches<const D: usize> {
    nodes: Vec<SVector<f64, D>>,
    /// The patch of each element.
    homes: Vec<u32>,
    /// The lowest element of each patch.
    first: Vec<u32>,
    /// Nodes of each patch, ascending.
    windows: Vec<Box<[u32]>>,
    colours: Vec<u8>,
}

impl<const D: usize> Patches<D> {
    /// Halves the set of elements along its longer side until the nodes of each part are few enough.
    pub(crate) fn of_elements<const C: usize>(
        nodes: &[SVector<f64, D>],
        elements: &[[u32; C]],
    ) -> Result<Self, MeshError> {
        let around = Around::new(nodes.len(), elements);
        let middles: Vec<SVector<f64, D>> = elements
            .iter()
            .map(|corners| {
                let sum: SVector<f64, D> = corners.iter().map(|&node| nodes[node as usize]).sum();
                sum / C as f64
            })
            .collect();
        let mut all: Vec<u32> = (0..elements.len() as u32).collect();
        let mut patches = Self {
            nodes: nodes.to_vec(),
            homes: vec![0; elements.len()],
            first: Vec::new(),
            windows: Vec::new(),
            colours: Vec::new(),
        };
        patches.cut(elements, &middles, &around, &mut all);
        patches.colour()?;
        Ok(patches)
    }

    fn cut<const C: usize>(
        &mut self,
        elements: &[[u32; C]],
        middles: &[SVector<f64, D>],
        around: &Around,
        part: &mut [u32],
    ) {
        // A conforming mesh has more nodes than elements.
        if part.len() >= MOST_NODES {
            return self.halve(elements, middles, around, part);
        }
        let reached = part.iter().flat_map(|&e| elements[e as usize]);
        let ring = reached.clone().flat_map(|node| around.node(node));
        let with_ring = distinct(ring.flat_map(|&e| elements[e as usize]));
        let window = match part {
            // An element always has room, if not always what is around it.
            [_] if with_ring.len() > MOST_NODES => distinct(reached),
            _ => with_ring,
        };
        if window.len() <= MOST_NODES {
            let number = self.windows.len() as u32;
            part.iter().for_each(|&e| self.homes[e as usize] = number);
            self.first.push(part.iter().copied().min().unwrap_or(0));
            self.windows.push(window.into());
            return;
        }
        self.halve(elements, middles, around, part);
    }

    fn halve<const C: usize>(
        &mut self,
        elements: &[[u32; C]],
        middles: &[SVector<f64, D>],
        around: &Around,
        part: &mut [u32],
    ) {
        let middle = |e: &u32| &middles[*e as usize];
        let start = *middle(&part[0]);
        let low = part.iter().fold(start, |a, e| a.inf(middle(e)));
        let high = part.iter().fold(start, |a, e| a.sup(middle(e)));
        let axis = (high - low).imax();
        let place = |e: &u32| middle(e)[axis];
        part.sort_unstable_by(|a, b| place(a).total_cmp(&place(b)).then(a.cmp(b)));
        let (lower, upper) = part.split_at_mut(part.len() / 2);
        self.cut(elements, middles, around, lower);
        self.cut(elements, middles, around, upper);
    }

    /// Gives each patch the first colour that none before it with a common node has.
    fn colour(&mut self) -> Result<(), MeshError> {
        let around = Around::new(self.nodes.len(), &self.windows);
        self.colours = vec![0; self.windows.len()];
        for patch in 0..self.windows.len() {
            let mut taken = [false; MOST_COLOURS];
            for &node in &self.windows[patch] {
                let before = around
                    .node(node)
                    .iter()
                    .take_while(|&&p| (p as usize) < patch);
                before.for_each(|&p| taken[usize::from(self.colours[p as usize])] = true);
            }
            let Some(colour) = taken.iter().position(|taken| !taken) else {
                return Err(MeshError::TooMany {
                    what: "patches at one node",
                    count: MOST_COLOURS + 1,
                    limit: MOST_COLOURS,
                });
            };
            self.colours[patch] = colour as u8;
        }
        Ok(())
    }

    /// Positions of all nodes, m.
    pub fn nodes(&self) -> &[SVector<f64, D>] {
        &self.nodes
    }

    /// Number of patches.
    pub fn len(&self) -> usize {
        self.windows.len()
    }

    /// Whether there are none; never.
    pub fn is_empty(&self) -> bool {
        self.windows.is_empty()
    }

    /// Nodes of a patch, ascending: at most 64. `patch` is below [`len`](Self::len), as for a slice.
    pub fn window(&self, patch: usize) -> &[u32] {
        &self.windows[patch]
    }

    /// Colour of a patch: two of one colour have no node in common.
    pub fn colour_of(&self, patch: usize) -> u8 {
        self.colours[patch]
    }

    /// The patch of an element.
    #[inline]
    pub(crate) fn home(&self, element: u32) -> u32 {
        self.homes[element as usize]
    }

    /// Some element of a patch; the last patch stands in for what is none.
    #[inline]
    pub(crate) fn first_element(&self, patch: u32) -> u32 {
        self.first[(patch as usize).min(self.first.len() - 1)]
    }

    /// Place of a node in the window of a patch.
    #[inline]
    pub(crate) fn entry(&self, patch: u32, node: u32) -> Option<u8> {
        let window = self.windows.get(patch as usize)?;
        window.binary_search(&node).ok().map(|entry| entry as u8)
    }
}

/// For every node the sets it is in, ascending.
struct Around {
    starts: Vec<u32>,
    sets: Vec<u32>,
}

impl Around {
    fn new<S: AsRef<[u32]>>(nodes: usize, sets: &[S]) -> Self {
        let mut starts = vec![0; nodes + 1];
        for &node in sets.iter().flat_map(|set| set.as_ref()) {
            starts[node as usize + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut listed = vec![0; starts[nodes] as usize];
        for (number, set) in sets.iter().enumerate() {
            for &node in set.as_ref() {
                listed[next[node as usize] as usize] = number as u32;
                next[node as usize] += 1;
            }
        }
        Self {
            starts,
            sets: listed,
        }
    }

    fn node(&self, node: u32) -> &[u32] {
        let node = node as usize;
        &self.sets[self.starts[node] as usize..self.starts[node + 1] as usize]
    }
}

fn distinct(nodes: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut nodes: Vec<u32> = nodes.collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
