//! One optional column behind an interface which does not name its type.

use std::any::Any;

use crate::error::ExtraError;
use crate::extra::Column;
use crate::order::gather;

/// What can be done with an optional column without knowing its type.
pub(crate) trait AnyColumn: Any + Send + Sync {
    fn type_name(&self) -> &'static str;
    fn resize(&mut self, len: usize);
    /// The entries of `order` are valid rows.
    fn reorder(&mut self, order: &[u32]);
    fn save(&self) -> Result<Vec<u8>, ExtraError>;
    /// Leaves the column as it was unless all is well.
    fn load(&mut self, bytes: &[u8]) -> Result<(), ExtraError>;
    fn boxed_clone(&self) -> Box<dyn AnyColumn>;
    fn as_any(&self) -> &dyn Any;
    fn as_any_mut(&mut self) -> &mut dyn Any;
}

/// The entries of an optional column and the scratch of its reordering.
#[derive(Default)]
pub(crate) struct TypedColumn<T> {
    pub(crate) values: Vec<T>,
    spare: Vec<T>,
}

impl<T: Column> TypedColumn<T> {
    pub(crate) fn new(values: Vec<T>) -> Self {
        Self {
            values,
            spare: Vec::new(),
        }
    }
}

impl<T: Column> AnyColumn for TypedColumn<T> {
    fn type_name(&self) -> &'static str {
        std::any::type_name::<T>()
    }

    fn resize(&mut self, len: usize) {
        self.values.resize(len, T::default());
    }

    fn reorder(&mut self, order: &[u32]) {
        gather(order, &self.values, &mut self.spare);
        std::mem::swap(&mut self.values, &mut self.spare);
    }

    fn save(&self) -> Result<Vec<u8>, ExtraError> {
        postcard::to_stdvec(&self.values).map_err(|error| ExtraError::Encode {
            name: T::NAME,
            source: Box::new(error),
        })
    }

    fn load(&mut self, bytes: &[u8]) -> Result<(), ExtraError> {
        let decode = |error: postcard::Error| ExtraError::Decode {
            name: T::NAME,
            source: Box::new(error),
        };
        // The count comes first and is looked at alone, so that a corrupted one is not worked
        // through.
        let (count, _) = postcard::take_from_bytes::<u64>(bytes).map_err(decode)?;
        if count != self.values.len() as u64 {
            return Err(ExtraError::Length {
                name: T::NAME,
                found: count,
                expected: self.values.len(),
            });
        }
        let (values, rest) = postcard::take_from_bytes::<Vec<T>>(bytes).map_err(decode)?;
        if !rest.is_empty() {
            return Err(ExtraError::LeftOver {
                name: T::NAME,
                left: rest.len(),
            });
        }
        self.values = values;
        Ok(())
    }

    fn boxed_clone(&self) -> Box<dyn AnyColumn> {
        Box::new(Self::new(self.values.clone()))
    }

    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }
}
