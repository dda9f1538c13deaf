//! What stands in a file, as [gmsh's manual](https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format) says: version 4.1
//! groups nodes and elements by the entity (curve, surface, …) that they are of, and the entities have the physical groups;
//! in 2.2 every element has its own.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use super::GmshError;
use super::sections::Words;

/// A node of the file.
pub(super) struct Node {
    pub tag: u64,
    pub x: [f64; 3],
}

/// An element of the file.
pub(super) struct Cell {
    /// Line in the file, from 1.
    pub line: usize,
    pub dimension: usize,
    /// Tags of its nodes.
    pub nodes: Vec<u64>,
    /// Physical groups it is of.
    pub groups: Vec<i64>,
}

/// What is of use in a file.
pub(super) struct Parsed {
    /// Names of physical groups by dimension and tag.
    pub names: BTreeMap<(usize, i64), String>,
    /// Ascending by tag.
    pub nodes: Vec<Node>,
    pub cells: Vec<Cell>,
}

/// Physical groups of the entities, by dimension and tag.
type Entities = HashMap<(usize, i64), Vec<i64>>;

pub(super) fn parse(path: &Path, text: &str) -> Result<Parsed, GmshError> {
    let lines: Vec<&str> = text.lines().collect();
    let Some(mut format) = Words::of(path, &lines, "MeshFormat")? else {
        let path = path.to_owned();
        return Err(GmshError::NotGmsh { path });
    };
    let version = format.word("a version")?;
    if format.number::<u64>("a file type")? != 0 {
        let path = path.to_owned();
        return Err(GmshError::Binary { path });
    }
    let names = names(path, &lines)?;
    let (mut nodes, cells) = match version {
        "4.1" => {
            let entities = entities(path, &lines)?;
            (nodes_4(path, &lines)?, cells_4(path, &lines, &entities)?)
        }
        "2.2" | "2" => (nodes_2(path, &lines)?, cells_2(path, &lines)?),
        _ => {
            return Err(GmshError::Version {
                path: path.to_owned(),
                version: version.to_owned(),
            });
        }
    };
    nodes.sort_by_key(|node| node.tag);
    if let Some(pair) = nodes.windows(2).find(|pair| pair[0].tag == pair[1].tag) {
        return Err(GmshError::TwoNodes {
            path: path.to_owned(),
            node: pair[0].tag,
        });
    }
    Ok(Parsed {
        names,
        nodes,
        cells,
    })
}

fn names(path: &Path, lines: &[&str]) -> Result<BTreeMap<(usize, i64), String>, GmshError> {
    let mut names = BTreeMap::new();
    let Some(mut words) = Words::of(path, lines, "PhysicalNames")? else {
        return Ok(names);
    };
    for _ in 0..words.number::<usize>("a number of names")? {
        let dimension = words.number("a dimension")?;
        let tag = words.number("a tag")?;
        let name = words.quoted()?;
        if names.values().any(|known| *known == name) {
            let path = path.to_owned();
            return Err(GmshError::TwoGroups { path, name });
        }
        names.insert((dimension, tag), name);
    }
    Ok(names)
}

fn entities(path: &Path, lines: &[&str]) -> Result<Entities, GmshError> {
    let mut entities = Entities::new();
    // A mesh without a geometry has none.
    let Some(mut words) = Words::of(path, lines, "Entities")? else {
        return Ok(entities);
    };
    let mut counts = [0_usize; 4];
    for count in &mut counts {
        *count = words.number("a number of entities")?;
    }
    for (dimension, count) in counts.into_iter().enumerate() {
        for _ in 0..count {
            let tag = words.number("a tag")?;
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                words.word("a coordinate")?;
            }
            let mut groups = Vec::new();
            for _ in 0..words.number::<usize>("a number of physical groups")? {
                groups.push(group(&mut words)?);
            }
            if dimension > 0 {
                for _ in 0..words.number::<usize>("a number of bounding entities")? {
                    words.number::<i64>("a tag")?;
                }
            }
            entities.insert((dimension, tag), groups);
        }
    }
    Ok(entities)
}

/// The tag of a physical group: negative for an entity that runs against it.
fn group(words: &mut Words<'_>) -> Result<i64, GmshError> {
    Ok(words.number::<i64>("a tag")?.saturating_abs())
}

fn point(words: &mut Words<'_>) -> Result<[f64; 3], GmshError> {
    Ok([words.finite()?, words.finite()?, words.finite()?])
}

fn nodes_4(path: &Path, lines: &[&str]) -> Result<Vec<Node>, GmshError> {
    let mut words = Words::required(path, lines, "Nodes")?;
    let blocks: usize = words.number("a number of blocks")?;
    for _ in 0..3 {
        words.number::<u64>("a number")?;
    }
    let mut nodes = Vec::new();
    for _ in 0..blocks {
        let dimension: usize = words.number("a dimension")?;
        words.number::<i64>("a tag")?;
        let parametric = words.number::<u64>("0 or 1")? != 0;
        let count: usize = words.number("a number of nodes")?;
        let mut tags = Vec::new();
        for _ in 0..count {
            tags.push(words.number("the tag of a node")?);
        }
        for tag in tags {
            let x = point(&mut words)?;
            for _ in 0..if parametric { dimension } else { 0 } {
                words.finite()?;
            }
            nodes.push(Node { tag, x });
        }
    }
    Ok(nodes)
}

fn nodes_2(path: &Path, lines: &[&str]) -> Result<Vec<Node>, GmshError> {
    let mut words = Words::required(path, lines, "Nodes")?;
    let mut nodes = Vec::new();
    for _ in 0..words.number::<usize>("a number of nodes")? {
        let tag = words.number("the tag of a node")?;
        let x = point(&mut words)?;
        nodes.push(Node { tag, x });
    }
    Ok(nodes)
}

/// Dimension and number of nodes of a type of elements.
fn kind(kind: u64) -> Option<(usize, usize)> {
    match kind {
        15 => Some((0, 1)),
        1 => Some((1, 2)),
        3 => Some((2, 4)),
        _ => None,
    }
}

/// The rest of an element's line, after its type.
fn cell(
    path: &Path,
    words: &mut Words<'_>,
    (element, of_kind): (u64, u64),
    groups: Vec<i64>,
) -> Result<Cell, GmshError> {
    let Some((dimension, count)) = kind(of_kind) else {
        return Err(GmshError::Element {
            path: path.to_owned(),
            line: words.line(),
            element,
            kind: of_kind,
        });
    };
    let mut nodes = Vec::with_capacity(count);
    for _ in 0..count {
        nodes.push(words.number("the tag of a node")?);
    }
    Ok(Cell {
        line: words.line(),
        dimension,
        nodes,
        groups,
    })
}

fn cells_4(path: &Path, lines: &[&str], entities: &Entities) -> Result<Vec<Cell>, GmshError> {
    let mut words = Words::required(path, lines, "Elements")?;
    let blocks: usize = words.number("a number of blocks")?;
    for _ in 0..3 {
        words.number::<u64>("a number")?;
    }
    let mut cells = Vec::new();
    for _ in 0..blocks {
        let entity = (words.number("a dimension")?, words.number("a tag")?);
        let of_kind = words.number("a type of elements")?;
        let count: usize = words.number("a number of elements")?;
        let groups = entities.get(&entity).cloned().unwrap_or_default();
        for _ in 0..count {
            let element = words.number("the tag of an element")?;
            cells.push(cell(path, &mut words, (element, of_kind), groups.clone())?);
        }
    }
    Ok(cells)
}

fn cells_2(path: &Path, lines: &[&str]) -> Result<Vec<Cell>, GmshError> {
    let mut words = Words::required(path, lines, "Elements")?;
    let mut cells = Vec::new();
    for _ in 0..words.number::<usize>("a number of elements")? {
        let element = words.number("the tag of an element")?;
        let of_kind = words.number("a type of elements")?;
        let mut tags = Vec::new();
        for _ in 0..words.number::<usize>("a number of tags")? {
            tags.push(group(&mut words)?);
        }
        // The first is the physical group, 0 for none.
        tags.truncate(1);
        cells.push(cell(path, &mut words, (element, of_kind), tags)?);
    }
    Ok(cells)
}
