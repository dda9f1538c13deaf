//! Opening a checkpoint: nothing is handed out before everything has been verified.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use super::element::{self, Element};
use super::format::{self, Content, Entry, MAGIC, PREAMBLE};
use super::{CheckpointError, VERSION};
use crate::FileError;

/// A checkpoint found whole. The file stays open and sections are read as they are asked for, so that memory holds one of
/// them and not the file; a newer checkpoint renamed over this one does not disturb the reader.
#[derive(Debug)]
pub struct CheckpointReader {
    path: PathBuf,
    file: File,
    sections: Vec<Section>,
}

#[derive(Debug)]
struct Section {
    entry: Entry,
    /// Bytes from the start of the file.
    offset: u64,
}

impl CheckpointReader {
    /// Opens and verifies the whole file.
    ///
    /// # Errors
    /// Any of [`CheckpointError`]'s refusals, naming the header or the first section that is truncated or damaged.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, CheckpointError> {
        let path = path.as_ref().to_owned();
        let file = File::open(&path).map_err(FileError::on("open", &path))?;
        let length = file.metadata().map_err(FileError::on("read", &path))?.len();
        let (entries, start) = read_header(&path, &file, length)?;
        let sections = lay_out(&path, entries, start, length)?;
        let reader = Self {
            path,
            file,
            sections,
        };
        for section in &reader.sections {
            reader.verify(section)?;
        }
        Ok(reader)
    }

    /// The sections' names and contents, in the order they were put.
    pub fn sections(&self) -> impl Iterator<Item = (&str, Content)> {
        self.sections
            .iter()
            .map(|section| (section.entry.name.as_str(), section.entry.content))
    }

    /// A column of numbers, bit for bit as put.
    ///
    /// # Errors
    /// [`CheckpointError::Missing`]; [`CheckpointError::Content`] if the section was put as another type;
    /// [`CheckpointError::File`] or [`CheckpointError::Damaged`] if the file was spoilt while open.
    pub fn get<T: Element>(&self, name: &str) -> Result<Vec<T>, CheckpointError> {
        let section = self.find(name, T::CONTENT)?;
        let size = size_of::<T>().max(1);
        let mut values = vec![T::zeroed(); section.entry.length as usize / size];
        self.fill(section, bytemuck::cast_slice_mut(&mut values))?;
        element::decode(&mut values);
        Ok(values)
    }

    /// A serde value.
    ///
    /// # Errors
    /// As [`get`](Self::get), and [`CheckpointError::Decode`] if it is not a `T`.
    pub fn get_value<T: DeserializeOwned>(&self, name: &str) -> Result<T, CheckpointError> {
        let section = self.find(name, Content::Value)?;
        let bytes = self.read(section)?;
        let decode = |source| CheckpointError::Decode {
            path: self.path.clone(),
            section: name.to_owned(),
            source,
        };
        match postcard::take_from_bytes(&bytes).map_err(decode)? {
            (value, []) => Ok(value),
            // What is left over shows that another type was put.
            _ => Err(decode(postcard::Error::DeserializeBadEncoding)),
        }
    }

    /// Bytes put as such.
    ///
    /// # Errors
    /// As [`get`](Self::get).
    pub fn get_bytes(&self, name: &str) -> Result<Vec<u8>, CheckpointError> {
        self.read(self.find(name, Content::Bytes)?)
    }

    fn find(&self, name: &str, wanted: Content) -> Result<&Section, CheckpointError> {
        let section = self
            .sections
            .iter()
            .find(|section| section.entry.name == name);
        let section = section.ok_or_else(|| CheckpointError::Missing {
            path: self.path.clone(),
            section: name.to_owned(),
        })?;
        if section.entry.content != wanted {
            return Err(CheckpointError::Content {
                path: self.path.clone(),
                section: name.to_owned(),
                found: section.entry.content,
                wanted,
            });
        }
        Ok(section)
    }

    fn read(&self, section: &Section) -> Result<Vec<u8>, CheckpointError> {
        let mut bytes = vec![0; section.entry.length as usize];
        self.fill(section, &mut bytes)?;
        Ok(bytes)
    }

    /// Reads a section and checks it once more: the hash costs far less than the reading, and the file could have changed.
    fn fill(&self, section: &Section, bytes: &mut [u8]) -> Result<(), CheckpointError> {
        let mut file = &self.file;
        file.seek(SeekFrom::Start(section.offset))
            .and_then(|_| file.read_exact(bytes))
            .map_err(FileError::on("read", &self.path))?;
        self.compare(section, xxh3_64(bytes), bytes.len() as u64)
    }

    /// Hashes a section without holding it.
    fn verify(&self, section: &Section) -> Result<(), CheckpointError> {
        let mut file = &self.file;
        file.seek(SeekFrom::Start(section.offset))
            .map_err(FileError::on("read", &self.path))?;
        let mut limited = file.take(section.entry.length);
        let mut hasher = Xxh3::new();
        let mut buffer = vec![0; 1 << 16];
        let mut found = 0;
        loop {
            match limited.read(&mut buffer) {
                Ok(0) => break,
                Ok(count) => {
                    hasher.update(&buffer[..count]);
                    found += count as u64;
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(FileError::on("read", &self.path)(error).into()),
            }
        }
        self.compare(section, hasher.digest(), found)
    }

    fn compare(&self, section: &Section, hash: u64, length: u64) -> Result<(), CheckpointError> {
        if hash == section.entry.hash && length == section.entry.length {
            return Ok(());
        }
        Err(CheckpointError::Damaged {
            path: self.path.clone(),
            section: section.entry.name.clone(),
        })
    }
}

/// The header's entries, and where it ends.
fn read_header(
    path: &Path,
    mut file: &File,
    length: u64,
) -> Result<(Vec<Entry>, u64), CheckpointError> {
    let mut preamble = Vec::with_capacity(PREAMBLE);
    file.take(PREAMBLE as u64)
        .read_to_end(&mut preamble)
        .map_err(FileError::on("read", path))?;
    let known = preamble.len().min(MAGIC.len());
    if preamble[..known] != MAGIC[..known] || preamble.is_empty() {
        return Err(CheckpointError::Magic {
            path: path.to_owned(),
        });
    }
    let truncated = || CheckpointError::HeaderTruncated {
        path: path.to_owned(),
    };
    let (fields, hash) = preamble
        .split_at_checked(PREAMBLE - 8)
        .ok_or_else(truncated)?;
    let (Some(found), Some(size), Some(hash)) =
        (field(&fields[8..]), field(&fields[12..]), field(hash))
    else {
        return Err(truncated());
    };
    // The version comes before the hash: another format may hash differently.
    let found = u32::from_le_bytes(found);
    if found != VERSION {
        return Err(CheckpointError::Version {
            path: path.to_owned(),
            found,
        });
    }
    let size = u64::from_le_bytes(size);
    // Before anything is allocated: a damaged length may be astronomical.
    if size > length.saturating_sub(PREAMBLE as u64) {
        return Err(truncated());
    }
    let mut header = vec![0; size as usize];
    file.read_exact(&mut header)
        .map_err(FileError::on("read", path))?;
    if format::header_hash(fields, &header) != u64::from_le_bytes(hash) {
        return Err(CheckpointError::HeaderDamaged {
            path: path.to_owned(),
        });
    }
    let entries =
        postcard::from_bytes(&header).map_err(|source| CheckpointError::HeaderUnreadable {
            path: path.to_owned(),
            source,
        })?;
    Ok((entries, PREAMBLE as u64 + size))
}

/// Places the sections and holds their lengths against the file's, before any of them is read.
fn lay_out(
    path: &Path,
    entries: Vec<Entry>,
    start: u64,
    length: u64,
) -> Result<Vec<Section>, CheckpointError> {
    let mut offset = start;
    let mut sections = Vec::with_capacity(entries.len());
    for entry in entries {
        let found = length - offset;
        if entry.length > found {
            let (section, expected) = (entry.name, entry.length);
            return Err(CheckpointError::Truncated {
                path: path.to_owned(),
                section,
                expected,
                found,
            });
        }
        let next = offset + entry.length;
        sections.push(Section { entry, offset });
        offset = next;
    }
    match length - offset {
        0 => Ok(sections),
        excess => Err(CheckpointError::Trailing {
            path: path.to_owned(),
            excess,
        }),
    }
}

/// The first `N` bytes.
fn field<const N: usize>(bytes: &[u8]) -> Option<[u8; N]> {
    bytes.first_chunk().copied()
}
