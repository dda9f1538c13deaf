//! Checkpoints: named sections of bytes in one file that is whole, verified, or refused.
//!
//! A file is written beside its final name, flushed to the disk and renamed, so a crash or a power failure leaves the
//! previous checkpoint in place. On opening, the magic, the version, the header's hash, the file's length and the hash of
//! every section are checked before a single value is handed out; what is wrong is named by section.
//!
//! | bytes | content |
//! |---|---|
//! | 8 | magic `\x89FSR\r\n\x1a\n` |
//! | 4 | format version, `u32` |
//! | 8 | length of the header, `u64` |
//! | 8 | xxh3 of the three fields above and the header, `u64` |
//! | … | header in postcard: per section its name, content, length and xxh3 |
//! | … | the sections, back to back, in the header's order |
//!
//! A scene is saved and loaded in one call by [`Checkpoint`], and every so many steps by [`AutoCheckpoint`]; other things
//! go through [`CheckpointWriter`] and [`CheckpointReader`].
//!
//! All numbers are little-endian; floats keep their bits (NaN payloads and the sign of zero included).

mod auto;
mod element;
mod format;
mod reader;
mod scene;
mod writer;

use std::path::PathBuf;

pub use auto::AutoCheckpoint;
pub use element::Element;
pub use format::Content;
pub use reader::CheckpointReader;
pub use scene::Checkpoint;
pub use writer::CheckpointWriter;

use fissure_scene::PersistError;

use crate::FileError;

/// The format this crate writes; [`CheckpointReader`] reads this one only.
pub const VERSION: u32 = 2;

/// Why a checkpoint could not be written or was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The operating system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// A second section was put under a name already taken.
    #[error("checkpoint section '{section}' is put twice")]
    Duplicate {
        /// The section's name.
        section: String,
    },
    /// A value could not be written in postcard, for instance a sequence of unknown length.
    #[error("checkpoint section '{section}' cannot be encoded")]
    Encode {
        /// The section's name, or "header".
        section: String,
        /// What postcard says.
        #[source]
        source: postcard::Error,
    },
    /// The file does not begin as a checkpoint does.
    #[error("'{}' is not a fissure checkpoint: its header lacks the magic bytes", path.display())]
    Magic {
        /// The file.
        path: PathBuf,
    },
    /// The file was written in a format this crate does not read.
    #[error("'{}' has checkpoint format {found}, this program reads format {VERSION}", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// The format of the file.
        found: u32,
    },
    /// The file ends before the header does.
    #[error("'{}' is truncated within its header", path.display())]
    HeaderTruncated {
        /// The file.
        path: PathBuf,
    },
    /// The header is not the one that was written.
    #[error("'{}' has a damaged header: its hash does not match", path.display())]
    HeaderDamaged {
        /// The file.
        path: PathBuf,
    },
    /// The header's hash matches but postcard cannot read it: another program wrote this file.
    #[error("'{}' has a header that cannot be decoded", path.display())]
    HeaderUnreadable {
        /// The file.
        path: PathBuf,
        /// What postcard says.
        #[source]
        source: postcard::Error,
    },
    /// The file ends within a section.
    #[error("'{}' is truncated in section '{section}': {found} of {expected} bytes", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// The first section that is not whole.
        section: String,
        /// Bytes the header promises for it.
        expected: u64,
        /// Bytes there are.
        found: u64,
    },
    /// The bytes of a section are not those that were written.
    #[error("'{}' is damaged in section '{section}': its hash does not match", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The section's name.
        section: String,
    },
    /// Something follows the last section.
    #[error("'{}' has {excess} bytes after its last section", path.display())]
    Trailing {
        /// The file.
        path: PathBuf,
        /// Bytes too many.
        excess: u64,
    },
    /// There is no section of the name asked for.
    #[error("'{}' has no section '{section}'", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// The name asked for.
        section: String,
    },
    /// A section is read as something else than was put.
    #[error("section '{section}' of '{}' holds {found}, read as {wanted}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// The section's name.
        section: String,
        /// What was put.
        found: Content,
        /// What was asked for.
        wanted: Content,
    },
    /// A serde value does not decode as the type asked for.
    #[error("section '{section}' of '{}' cannot be decoded", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// The section's name.
        section: String,
        /// What postcard says.
        #[source]
        source: postcard::Error,
    },
    /// The scene could not be saved, or the checkpoint is of another scene than this.
    #[error("'{}' and the scene do not fit", path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// What the scene says.
        #[source]
        source: PersistError,
    },
}
