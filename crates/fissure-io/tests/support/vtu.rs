//! A small reader of VTK's appended format, written from its description alone.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// What one `DataArray` element says, and the bytes its offset leads to.
pub struct Array {
    pub vtk_type: String,
    pub components: usize,
    pub bytes: Vec<u8>,
}

pub struct Document {
    pub points: usize,
    pub time: Option<f64>,
    pub arrays: HashMap<String, Array>,
}

pub fn attribute<'a>(element: &'a str, key: &str) -> Option<&'a str> {
    element
        .split_once(&format!(" {key}=\""))?
        .1
        .split_once('"')
        .map(|(value, _)| value)
}

fn word(bytes: &[u8], index: usize) -> usize {
    usize::try_from(u64::from_ne_bytes(
        bytes[8 * index..8 * index + 8].try_into().unwrap(),
    ))
    .unwrap()
}

/// Reads a document and demands that the arrays fill the appended section without gap or overlap.
pub fn read(path: &Path) -> Document {
    let file = fs::read(path).unwrap();
    let opening = b"<AppendedData encoding=\"raw\">\n   _";
    let at = file
        .windows(opening.len())
        .position(|window| window == opening)
        .unwrap();
    let head = std::str::from_utf8(&file[..at]).unwrap();
    let closing = b"\n  </AppendedData>\n</VTKFile>\n";
    assert!(file.ends_with(closing));
    let data = &file[at + opening.len()..file.len() - closing.len()];
    assert!(head.contains("header_type=\"UInt64\""));
    let packed = head.contains("compressor=\"vtkLZ4DataCompressor\"");

    let piece = head.lines().find(|line| line.contains("<Piece")).unwrap();
    let points = attribute(piece, "NumberOfPoints").unwrap().parse().unwrap();
    assert_eq!(
        attribute(piece, "NumberOfCells"),
        attribute(piece, "NumberOfPoints")
    );
    let value = head.lines().find(|line| line.contains("TimeValue"));
    let time = value.map(|line| line.split(['>', '<']).nth(2).unwrap().parse().unwrap());

    let mut end = 0;
    let mut arrays = HashMap::new();
    for element in head
        .lines()
        .filter(|line| line.contains("format=\"appended\""))
    {
        let offset: usize = attribute(element, "offset").unwrap().parse().unwrap();
        assert_eq!(offset, end, "arrays lie back to back: {element}");
        let rest = &data[offset..];
        let (bytes, length) = if packed {
            unpack(rest)
        } else {
            (rest[8..8 + word(rest, 0)].to_vec(), 8 + word(rest, 0))
        };
        end += length;
        let components =
            attribute(element, "NumberOfComponents").map_or(1, |count| count.parse().unwrap());
        let vtk_type = attribute(element, "type").unwrap().to_owned();
        arrays.insert(
            attribute(element, "Name").unwrap().to_owned(),
            Array {
                vtk_type,
                components,
                bytes,
            },
        );
    }
    assert_eq!(end, data.len(), "nothing follows the last array");
    Document {
        points,
        time,
        arrays,
    }
}

/// An array in LZ4 blocks: its bytes, and how many it took in the file.
fn unpack(data: &[u8]) -> (Vec<u8>, usize) {
    let (blocks, full, last) = (word(data, 0), word(data, 1), word(data, 2));
    let mut bytes = Vec::new();
    let mut at = 8 * (3 + blocks);
    for block in 0..blocks {
        let size = if block + 1 == blocks && last != 0 {
            last
        } else {
            full
        };
        let length = word(data, 3 + block);
        let plain = lz4_flex::block::decompress(&data[at..at + length], size).unwrap();
        assert_eq!(plain.len(), size);
        bytes.extend(plain);
        at += length;
    }
    (bytes, at)
}
