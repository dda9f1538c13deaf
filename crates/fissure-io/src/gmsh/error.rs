//! What can be wrong with a file of gmsh.

use std::path::PathBuf;

use fissure_grid::MeshError;

use crate::file::FileError;

/// Why a file was refused, or a question to it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GmshError {
    /// The operating system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file does not begin as an MSH file does.
    #[error("'{}' is no MSH file: it has no section $MeshFormat", path.display())]
    NotGmsh {
        /// The file.
        path: PathBuf,
    },
    /// A version that is not read.
    #[error("'{}' is of MSH version {version}, must be 4.1 or 2.2", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        version: String,
    },
    /// A binary file.
    #[error("'{}' is a binary MSH file, must be text: set Mesh.Binary = 0", path.display())]
    Binary {
        /// The file.
        path: PathBuf,
    },
    /// A section is not there or has no end.
    #[error("'{}' has no whole section ${section}", path.display())]
    Section {
        /// The file.
        path: PathBuf,
        /// The section, without its dollar.
        section: &'static str,
    },
    /// What stands in a line is not what should.
    #[error("'{}', line {line}: {found:?} is not {expected}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What should stand there.
        expected: &'static str,
        /// What does.
        found: String,
    },
    /// An element that is no point, line of two nodes, or quadrilateral of four.
    #[error(
        "'{}', line {line}: element {element} is of type {kind}, must be 15 (point), 1 (line) or 3 (quadrilateral)",
        path.display()
    )]
    Element {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The element's tag.
        element: u64,
        /// Its type, as gmsh numbers them: 2 is a triangle.
        kind: u64,
    },
    /// There are no quadrilaterals.
    #[error("'{}' has no quadrilateral", path.display())]
    NoQuadrilaterals {
        /// The file.
        path: PathBuf,
    },
    /// Two nodes have one tag.
    #[error("'{}' has two nodes of tag {node}", path.display())]
    TwoNodes {
        /// The file.
        path: PathBuf,
        /// The tag.
        node: u64,
    },
    /// An element names a node that is not there.
    #[error("'{}', line {line}: there is no node {node}", path.display())]
    UnknownNode {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The node's tag.
        node: u64,
    },
    /// A node is not in the plane of the first.
    #[error("'{}': node {node} is at z = {z} m, must be in one plane with the others", path.display())]
    NotPlane {
        /// The file.
        path: PathBuf,
        /// The node's tag.
        node: u64,
        /// Its third coordinate, m.
        z: f64,
    },
    /// A group has a node that no quadrilateral has.
    #[error("'{}': group '{name}' has node {node}, which is of no quadrilateral", path.display())]
    StrayNode {
        /// The file.
        path: PathBuf,
        /// The group.
        name: String,
        /// The node's tag.
        node: u64,
    },
    /// Two groups have one name.
    #[error("'{}' has two groups named '{name}'", path.display())]
    TwoGroups {
        /// The file.
        path: PathBuf,
        /// The name.
        name: String,
    },
    /// The quadrilaterals are no mesh.
    #[error("the quadrilaterals of '{}' are no mesh", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// Why; nodes and elements are counted from 0 in the order of the file.
        #[source]
        source: MeshError,
    },
    /// There is no group of that name.
    #[error("there is no group '{name}'; there are {}", present.join(", "))]
    UnknownGroup {
        /// The name asked for.
        name: String,
        /// The names there are.
        present: Vec<String>,
    },
    /// A group has no elements to fill, or they were to be filled with nothing.
    #[error("no particle would come of filling the group '{name}'")]
    NoElements {
        /// The group.
        name: String,
    },
}
