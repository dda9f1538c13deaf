//! Optional columns, keyed by their type.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{ExtraError, ParticleError};
use crate::extra_column::{AnyColumn, TypedColumn};
use crate::order::check_permutation;

/// The entry type of an optional column, one entry per particle.
pub trait Column: Copy + Default + Serialize + DeserializeOwned + Send + Sync + 'static {
    /// The name under which checkpoints hold the column. No two types used in one body may share
    /// it.
    const NAME: &'static str;
}

/// The optional columns of a body: those which a solver or a law asked for, each of its own type.
///
/// Columns are found by type and, for checkpoints, by name. All have as many rows as the body has
/// particles and are permuted together with the others. They are held in the order of their names,
/// so that going through them is deterministic.
///
/// ```
/// use fissure_particles::{Column, Extra};
/// use serde::{Deserialize, Serialize};
///
/// #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
/// struct Temperature(f64);
/// impl Column for Temperature {
///     const NAME: &'static str = "temperature";
/// }
///
/// let mut extra = Extra::with_len(2);
/// extra.ensure::<Temperature>()?[1].0 = 293.0;
/// let bytes = extra.save("temperature")?;
///
/// let mut restored = Extra::with_len(2);
/// restored.ensure::<Temperature>()?;
/// restored.load("temperature", &bytes)?;
/// assert_eq!(restored.get::<Temperature>(), extra.get::<Temperature>());
/// # Ok::<(), fissure_particles::ExtraError>(())
/// ```
#[derive(Default)]
pub struct Extra {
    len: usize,
    columns: BTreeMap<&'static str, Box<dyn AnyColumn>>,
}

impl Extra {
    /// No columns yet, for a body of `len` particles.
    pub fn with_len(len: usize) -> Self {
        Self {
            len,
            columns: BTreeMap::new(),
        }
    }

    /// Rows of every column.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the columns have no rows.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The names of the columns there are, in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.columns.keys().copied()
    }

    /// Makes all columns `len` rows long; new rows hold the default.
    pub fn resize(&mut self, len: usize) {
        self.len = len;
        for column in self.columns.values_mut() {
            column.resize(len);
        }
    }

    /// The column of type `T`, made and filled with the default if there is none yet.
    ///
    /// # Errors
    /// [`ExtraError::NameTaken`] if a column of another type has the name `T::NAME`.
    pub fn ensure<T: Column>(&mut self) -> Result<&mut [T], ExtraError> {
        let len = self.len;
        let column = self
            .columns
            .entry(T::NAME)
            .or_insert_with(|| Box::new(TypedColumn::new(vec![T::default(); len])));
        let held = column.type_name();
        match column.as_any_mut().downcast_mut::<TypedColumn<T>>() {
            Some(column) => Ok(&mut column.values),
            None => Err(name_taken::<T>(held)),
        }
    }

    /// The column of type `T`, if there is one.
    pub fn get<T: Column>(&self) -> Option<&[T]> {
        let column = self.columns.get(T::NAME)?.as_any();
        Some(&column.downcast_ref::<TypedColumn<T>>()?.values)
    }

    /// The column of type `T` to write, if there is one.
    pub fn get_mut<T: Column>(&mut self) -> Option<&mut [T]> {
        let column = self.columns.get_mut(T::NAME)?.as_any_mut();
        Some(&mut column.downcast_mut::<TypedColumn<T>>()?.values)
    }

    /// Takes the column of type `T` out, so that several can be written at once; [`Extra::put`]
    /// puts it back. A column which is out takes no part in reordering, resizing and saving.
    pub fn take<T: Column>(&mut self) -> Option<Vec<T>> {
        let column = self.columns.get_mut(T::NAME)?.as_any_mut();
        let values = std::mem::take(&mut column.downcast_mut::<TypedColumn<T>>()?.values);
        self.columns.remove(T::NAME);
        Some(values)
    }

    /// Puts a column in, in place of the one of its type if there is one.
    ///
    /// # Errors
    /// [`ExtraError::Length`] if it has not one entry per particle, [`ExtraError::NameTaken`] if a
    /// column of another type has its name.
    pub fn put<T: Column>(&mut self, values: Vec<T>) -> Result<(), ExtraError> {
        if values.len() != self.len {
            return Err(ExtraError::Length {
                name: T::NAME,
                found: values.len() as u64,
                expected: self.len,
            });
        }
        if let Some(column) = self.columns.get_mut(T::NAME) {
            let held = column.type_name();
            match column.as_any_mut().downcast_mut::<TypedColumn<T>>() {
                Some(column) => column.values = values,
                None => return Err(name_taken::<T>(held)),
            }
        } else {
            self.columns
                .insert(T::NAME, Box::new(TypedColumn::new(values)));
        }
        Ok(())
    }

    /// Brings all columns into a new order: row `i` becomes what row `order[i]` was.
    ///
    /// # Errors
    /// [`ParticleError::ColumnLength`] or [`ParticleError::NotAPermutation`]; nothing is moved
    /// then.
    pub fn reorder(&mut self, order: &[u32]) -> Result<(), ParticleError> {
        check_permutation(order, self.len, &mut Vec::new())?;
        self.reorder_checked(order);
        Ok(())
    }

    pub(crate) fn reorder_checked(&mut self, order: &[u32]) {
        for column in self.columns.values_mut() {
            column.reorder(order);
        }
    }

    /// The column called `name` as bytes (postcard: the count, then the entries; floats bit for
    /// bit).
    ///
    /// # Errors
    /// [`ExtraError::UnknownColumn`] if there is none of this name, [`ExtraError::Encode`] if an
    /// entry refuses.
    pub fn save(&self, name: &str) -> Result<Vec<u8>, ExtraError> {
        match self.columns.get(name) {
            Some(column) => column.save(),
            None => Err(self.unknown(name)),
        }
    }

    /// Fills the column called `name` from what [`Extra::save`] gave. On an error the column stays
    /// as it was.
    ///
    /// Only the type knows how to read its bytes, so that the column must have been made with
    /// [`Extra::ensure`]: a checkpoint with a column which nobody asked for is refused rather than
    /// read in part.
    ///
    /// # Errors
    /// [`ExtraError::UnknownColumn`] if there is none of this name, [`ExtraError::Length`] if the
    /// count differs from the number of particles, [`ExtraError::Decode`] or
    /// [`ExtraError::LeftOver`] if the bytes are not those of the type.
    pub fn load(&mut self, name: &str, bytes: &[u8]) -> Result<(), ExtraError> {
        match self.columns.get_mut(name) {
            Some(column) => column.load(bytes),
            None => Err(self.unknown(name)),
        }
    }

    fn unknown(&self, name: &str) -> ExtraError {
        ExtraError::UnknownColumn {
            name: name.to_owned(),
            present: self.names().collect(),
        }
    }
}

fn name_taken<T: Column>(held: &'static str) -> ExtraError {
    ExtraError::NameTaken {
        name: T::NAME,
        held,
        asked: std::any::type_name::<T>(),
    }
}

impl Clone for Extra {
    fn clone(&self) -> Self {
        let columns = self.columns.iter();
        Self {
            len: self.len,
            columns: columns
                .map(|(name, column)| (*name, column.boxed_clone()))
                .collect(),
        }
    }
}

impl fmt::Debug for Extra {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Extra")
            .field("len", &self.len)
            .field("columns", &self.columns.keys())
            .finish()
    }
}
