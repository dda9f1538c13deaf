//! Meshes of quadrilaterals from gmsh: MSH 4.1 and 2.2, as text.
//!
//! [`GmshMesh::read`] takes the quadrilaterals of first order (type 3) in a plane of constant z as a
//! [`QuadMesh`]; those that run clockwise are turned. Points (15) and lines (1) serve the physical groups alone.
//! Any other type is refused: gmsh leaves triangles where it cannot recombine, which
//! `Mesh.SubdivisionAlgorithm = 1` divides.
//!
//! A named physical group becomes a [`Group`]: its nodes, and its elements if it is of surfaces. Groups without
//! a name are not kept; of elements without a group gmsh saves none, unless told to.
//!
//! The nodes of a group are what [`Scene::hold_places`](fissure_scene::Scene::hold_places) wants, its elements what
//! [`GmshMesh::seeds`] fills with particles.
//!
//! The file is read here and not by a crate: `mshio` (0.4.2, of 2020) knows neither physical names nor MSH 2.2.

mod error;
mod parse;
mod sections;

use std::path::Path;

use fissure_grid::QuadMesh;
use fissure_particles::Seeds;
use nalgebra::{Matrix2, Vector2};

pub use error::GmshError;

use crate::file::FileError;
use parse::{Cell, Parsed};

/// A mesh and its named groups.
#[derive(Clone, Debug, PartialEq)]
pub struct GmshMesh {
    /// The mesh.
    pub mesh: QuadMesh,
    groups: Vec<Group>,
}

/// A named physical group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Of points (0), curves (1) or surfaces (2).
    pub dimension: usize,
    /// Its nodes by their numbers in the mesh, ascending.
    pub nodes: Vec<u32>,
    /// Its elements by their numbers in the mesh, ascending; none but of surfaces.
    pub elements: Vec<usize>,
}

impl GmshMesh {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, that is no MSH file of a known version or not text, without quadrilaterals or with
    /// elements of another type, not in a plane, or whose elements are no mesh.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, GmshError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(FileError::on("read", path))?;
        // Binary files are refused by what their first lines say, which are text.
        Self::parse(path, &String::from_utf8_lossy(&bytes))
    }

    /// Takes the text of a file; `path` names it in errors.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(path: impl AsRef<Path>, text: &str) -> Result<Self, GmshError> {
        let path = path.as_ref();
        let parsed = parse::parse(path, text)?;
        build(path, parsed)
    }

    /// The named groups, by dimension and number.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The group of this name.
    ///
    /// # Errors
    /// There is none.
    pub fn group(&self, name: &str) -> Result<&Group, GmshError> {
        let found = self.groups.iter().find(|group| group.name == name);
        found.ok_or_else(|| GmshError::UnknownGroup {
            name: name.to_owned(),
            present: self.groups.iter().map(|group| group.name.clone()).collect(),
        })
    }

    /// Positions of the nodes of a group, m.
    ///
    /// # Errors
    /// As [`group`](Self::group).
    pub fn places(&self, name: &str) -> Result<Vec<Vector2<f64>>, GmshError> {
        let nodes = self.group(name)?.nodes.iter();
        Ok(nodes
            .map(|&node| self.mesh.nodes()[node as usize])
            .collect())
    }

    /// `per_side`² particles in every element of a group of surfaces, at the middles of parts that are equal in natural
    /// coordinates. The domain of all is the square of the mean area.
    ///
    /// # Errors
    /// As [`group`](Self::group), and a group without elements or no particles.
    pub fn seeds(&self, name: &str, per_side: usize) -> Result<Seeds<2>, GmshError> {
        let elements = &self.group(name)?.elements;
        let parts = self.mesh.parts(elements, per_side);
        if parts.is_empty() {
            return Err(GmshError::NoElements {
                name: name.to_owned(),
            });
        }
        let (position, volume): (Vec<_>, Vec<f64>) = parts.into_iter().unzip();
        let mean = volume.iter().sum::<f64>() / volume.len() as f64;
        Ok(Seeds {
            position,
            volume,
            half_edges: Matrix2::identity() * (0.5 * mean.sqrt()),
        })
    }
}

/// Part of the mesh's size by which the third coordinate may vary.
const FLAT: f64 = 1e-9;

fn build(path: &Path, parsed: Parsed) -> Result<GmshMesh, GmshError> {
    let Parsed {
        names,
        nodes,
        cells,
    } = parsed;
    let corner = |cell: &Cell, tag: u64| {
        let found = nodes.binary_search_by_key(&tag, |node| node.tag);
        found.map_err(|_| GmshError::UnknownNode {
            path: path.to_owned(),
            line: cell.line,
            node: tag,
        })
    };
    // Rows of the file's nodes that quadrilaterals have; the others, such as centres of arcs, are no nodes of the mesh.
    let mut used = vec![false; nodes.len()];
    let mut quads: Vec<[usize; 4]> = Vec::new();
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for cell in &cells {
        let corners: Result<Vec<usize>, GmshError> =
            cell.nodes.iter().map(|&tag| corner(cell, tag)).collect();
        rows.push(corners?);
    }
    // An element of several groups stands in a file of version 2.2 several times.
    let mut numbers = vec![None; cells.len()];
    let mut known = std::collections::HashMap::new();
    for (row, number) in rows.iter().zip(&mut numbers) {
        let &[a, b, c, d] = row.as_slice() else {
            continue;
        };
        let mut key = [a, b, c, d];
        key.sort_unstable();
        let element = *known.entry(key).or_insert_with(|| {
            quads.push([a, b, c, d]);
            quads.len() - 1
        });
        *number = Some(element);
        row.iter().for_each(|&node| used[node] = true);
    }
    if quads.is_empty() {
        return Err(GmshError::NoQuadrilaterals {
            path: path.to_owned(),
        });
    }
    flat(path, &nodes, &used)?;
    let mut place = vec![None; nodes.len()];
    let mut kept = Vec::new();
    for (row, node) in nodes.iter().enumerate().filter(|(row, _)| used[*row]) {
        place[row] = Some(kept.len() as u32);
        kept.push(Vector2::new(node.x[0], node.x[1]));
    }
    let number = |row: usize| place[row].unwrap_or(0);
    let elements = quads
        .iter()
        .map(|corners| counter_clockwise(&kept, corners.map(number)))
        .collect();
    let mesh = QuadMesh::new(kept, elements).map_err(|source| GmshError::Mesh {
        path: path.to_owned(),
        source,
    })?;
    let mut groups = Vec::new();
    for ((dimension, tag), name) in names {
        let mut group = Group {
            name,
            dimension,
            nodes: Vec::new(),
            elements: Vec::new(),
        };
        let of_group = |cell: &Cell| cell.dimension == dimension && cell.groups.contains(&tag);
        for (index, _) in cells.iter().enumerate().filter(|(_, cell)| of_group(cell)) {
            for &row in &rows[index] {
                let node = place[row].ok_or_else(|| GmshError::StrayNode {
                    path: path.to_owned(),
                    name: group.name.clone(),
                    node: nodes[row].tag,
                })?;
                group.nodes.push(node);
            }
            group.elements.extend(numbers[index]);
        }
        group.nodes.sort_unstable();
        group.nodes.dedup();
        group.elements.sort_unstable();
        group.elements.dedup();
        groups.push(group);
    }
    Ok(GmshMesh { mesh, groups })
}

/// The corners in the sense that the mesh wants; what is neither is left for it to refuse.
fn counter_clockwise(nodes: &[Vector2<f64>], corners: [u32; 4]) -> [u32; 4] {
    let [a, b, c, d] = corners.map(|node| nodes[node as usize]);
    if (c - a).perp(&(d - b)) < 0.0 {
        let [a, b, c, d] = corners;
        return [a, d, c, b];
    }
    corners
}

/// Refuses nodes that are not in one plane of constant z.
fn flat(path: &Path, nodes: &[parse::Node], used: &[bool]) -> Result<(), GmshError> {
    let kept = || nodes.iter().zip(used).filter(|(_, used)| **used);
    let Some((first, _)) = kept().next() else {
        return Ok(());
    };
    let away = |node: &parse::Node, axis: usize| (node.x[axis] - first.x[axis]).abs();
    let size = kept().fold(0.0_f64, |size, (node, _)| {
        size.max(away(node, 0)).max(away(node, 1))
    });
    match kept().find(|(node, _)| !(away(node, 2) <= FLAT * size)) {
        None => Ok(()),
        Some((node, _)) => Err(GmshError::NotPlane {
            path: path.to_owned(),
            node: node.tag,
            z: node.x[2],
        }),
    }
}
