//! The appended section of a VTK XML file: raw arrays, each behind a header of 64-bit lengths.

use std::borrow::Cow;
use std::io::{self, Write};

/// How a frame's arrays are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Compression {
    /// Raw bytes: fastest to write and to read.
    #[default]
    None,
    /// LZ4 in blocks (`vtkLZ4DataCompressor`).
    Lz4,
}

/// Bytes per LZ4 block: matches reach back at most this far.
const BLOCK: usize = 1 << 16;

/// Arrays on their way into one file. Offsets are needed before the first array is written, hence the collecting.
#[derive(Debug)]
pub(super) struct Appended<'a> {
    compression: Compression,
    arrays: Vec<Encoded<'a>>,
    length: u64,
}

#[derive(Debug)]
struct Encoded<'a> {
    header: Vec<u64>,
    payload: Cow<'a, [u8]>,
}

impl<'a> Appended<'a> {
    pub fn new(compression: Compression) -> Self {
        Self {
            compression,
            arrays: Vec::new(),
            length: 0,
        }
    }

    /// Adds an array and returns its offset from the first byte after the underscore.
    pub fn push(&mut self, bytes: Cow<'a, [u8]>) -> u64 {
        let encoded = match self.compression {
            Compression::None => Encoded {
                header: vec![bytes.len() as u64],
                payload: bytes,
            },
            Compression::Lz4 => compress(&bytes),
        };
        let offset = self.length;
        self.length += (8 * encoded.header.len() + encoded.payload.len()) as u64;
        self.arrays.push(encoded);
        offset
    }

    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        for array in &self.arrays {
            // In the machine's order, which the file states.
            out.write_all(bytemuck::cast_slice(&array.header))?;
            out.write_all(&array.payload)?;
        }
        Ok(())
    }
}

/// Header: number of blocks, bytes of a full block, bytes of the last one if it is not full (else 0), and per block its
/// compressed length.
fn compress(bytes: &[u8]) -> Encoded<'static> {
    let blocks = bytes.len().div_ceil(BLOCK);
    let mut header = Vec::with_capacity(3 + blocks);
    header.extend([blocks as u64, BLOCK as u64, (bytes.len() % BLOCK) as u64]);
    let mut payload = Vec::with_capacity(bytes.len() / 2);
    for block in bytes.chunks(BLOCK) {
        let packed = lz4_flex::block::compress(block);
        header.push(packed.len() as u64);
        payload.extend_from_slice(&packed);
    }
    Encoded {
        header,
        payload: Cow::Owned(payload),
    }
}
