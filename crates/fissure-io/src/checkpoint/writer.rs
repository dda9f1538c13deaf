//! Collecting sections and putting them to disk in one piece.

use std::borrow::Cow;
use std::io::Write;
use std::path::Path;

use serde::Serialize;
use xxhash_rust::xxh3::xxh3_64;

use super::CheckpointError;
use super::element::{self, Element};
use super::format::{self, Content, Entry};
use crate::file::{self, Survive};

/// Named sections, borrowed where they can be, that become one file with [`write`](Self::write).
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("bar.checkpoint");
/// use fissure_io::checkpoint::{CheckpointReader, CheckpointWriter};
///
/// let positions = [[0.0, 0.5, 0.0], [0.0, 1.5, 0.0]]; // m
/// let mut checkpoint = CheckpointWriter::new();
/// checkpoint.put("positions", &positions)?.put_value("clock", &(812_u64, 1.3e-4))?;
/// checkpoint.write(&path)?;
///
/// let checkpoint = CheckpointReader::open(&path)?;
/// assert_eq!(checkpoint.get::<[f64; 3]>("positions")?, positions);
/// let (step, time): (u64, f64) = checkpoint.get_value("clock")?;
/// # assert_eq!((step, time), (812, 1.3e-4));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Default)]
pub struct CheckpointWriter<'a> {
    sections: Vec<Section<'a>>,
}

#[derive(Debug)]
struct Section<'a> {
    name: String,
    content: Content,
    bytes: Cow<'a, [u8]>,
}

impl<'a> CheckpointWriter<'a> {
    /// A checkpoint without sections.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a column of numbers, read back bit for bit by [`get`](super::CheckpointReader::get).
    ///
    /// # Errors
    /// [`CheckpointError::Duplicate`] if the name is taken.
    pub fn put<T: Element>(
        &mut self,
        name: &str,
        values: &'a [T],
    ) -> Result<&mut Self, CheckpointError> {
        self.add(name, T::CONTENT, element::encode(values))
    }

    /// Adds a serde value in postcard: clocks, settings, counters. Columns belong in [`put`](Self::put), which is faster.
    ///
    /// # Errors
    /// [`CheckpointError::Encode`] if postcard cannot represent it, [`CheckpointError::Duplicate`] if the name is taken.
    pub fn put_value<T: Serialize + ?Sized>(
        &mut self,
        name: &str,
        value: &T,
    ) -> Result<&mut Self, CheckpointError> {
        let bytes = postcard::to_stdvec(value).map_err(|source| CheckpointError::Encode {
            section: name.to_owned(),
            source,
        })?;
        self.add(name, Content::Value, Cow::Owned(bytes))
    }

    /// Adds bytes as they are.
    ///
    /// # Errors
    /// [`CheckpointError::Duplicate`] if the name is taken.
    pub fn put_bytes(
        &mut self,
        name: &str,
        bytes: impl Into<Cow<'a, [u8]>>,
    ) -> Result<&mut Self, CheckpointError> {
        self.add(name, Content::Bytes, bytes.into())
    }

    /// Writes all sections to `path`, replacing a file that is there. When this returns the checkpoint survives a power
    /// failure; until then `path` holds what it held before. The folder must exist.
    ///
    /// # Errors
    /// [`CheckpointError::File`] if the operating system refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), CheckpointError> {
        let entry = |section: &Section<'_>| Entry {
            name: section.name.clone(),
            content: section.content,
            length: section.bytes.len() as u64,
            hash: xxh3_64(&section.bytes),
        };
        let entries: Vec<Entry> = self.sections.iter().map(entry).collect();
        let front = format::front(&entries).map_err(|source| CheckpointError::Encode {
            section: "header".to_owned(),
            source,
        })?;
        file::replace(path.as_ref(), Survive::PowerFailure, |out| {
            out.write_all(&front)?;
            self.sections
                .iter()
                .try_for_each(|section| out.write_all(&section.bytes))
        })?;
        Ok(())
    }

    fn add(
        &mut self,
        name: &str,
        content: Content,
        bytes: Cow<'a, [u8]>,
    ) -> Result<&mut Self, CheckpointError> {
        if self.sections.iter().any(|section| section.name == name) {
            return Err(CheckpointError::Duplicate {
                section: name.to_owned(),
            });
        }
        self.sections.push(Section {
            name: name.to_owned(),
            content,
            bytes,
        });
        Ok(self)
    }
}
