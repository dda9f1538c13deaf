//! The header: which sections follow, and what proves them whole.

use std::fmt;

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3;

use super::VERSION;

/// As in PNG: a byte beyond ASCII and both line ends show a transfer as text at once.
pub(super) const MAGIC: [u8; 8] = *b"\x89FSR\r\n\x1a\n";
/// Magic, version, length of the header, its hash.
pub(super) const PREAMBLE: usize = 8 + 4 + 8 + 8;

/// What a section holds; reading it as anything else is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Content {
    /// Bytes without a meaning of their own.
    Bytes,
    /// One serde value in postcard.
    Value,
    /// Raw little-endian numbers.
    Array {
        /// The kind of number.
        scalar: Scalar,
        /// Numbers per element: 1 for `f64`, 3 for `[f64; 3]`.
        width: u32,
    },
}

/// The kind of number in an array section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scalar {
    /// Double precision.
    F64,
    /// Bytes and flags.
    U8,
    /// Ids and indices.
    U32,
    /// Counters and random seeds.
    U64,
}

impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scalar, width) = match self {
            Self::Bytes => return f.write_str("plain bytes"),
            Self::Value => return f.write_str("a serde value"),
            Self::Array { scalar, width } => (scalar, width),
        };
        let name = match scalar {
            Scalar::F64 => "f64",
            Scalar::U8 => "u8",
            Scalar::U32 => "u32",
            Scalar::U64 => "u64",
        };
        match width {
            1 => f.write_str(name),
            _ => write!(f, "[{name}; {width}]"),
        }
    }
}

/// One line of the header.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Entry {
    pub name: String,
    pub content: Content,
    /// Bytes.
    pub length: u64,
    pub hash: u64,
}

/// The whole front of a file, ready to write.
pub(super) fn front(entries: &[Entry]) -> Result<Vec<u8>, postcard::Error> {
    let header = postcard::to_stdvec(entries)?;
    let mut bytes = Vec::with_capacity(PREAMBLE + header.len());
    bytes.extend_from_slice(&MAGIC);
    bytes.extend_from_slice(&VERSION.to_le_bytes());
    bytes.extend_from_slice(&(header.len() as u64).to_le_bytes());
    let hash = header_hash(&bytes, &header);
    bytes.extend_from_slice(&hash.to_le_bytes());
    bytes.extend_from_slice(&header);
    Ok(bytes)
}

/// The hash covers the fields before it too, so that no byte of a file goes unchecked.
pub(super) fn header_hash(fields: &[u8], header: &[u8]) -> u64 {
    let mut hasher = Xxh3::new();
    hasher.update(fields);
    hasher.update(header);
    hasher.digest()
}
