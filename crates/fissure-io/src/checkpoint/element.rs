//! Which columns of numbers go to a checkpoint as raw bytes.

use std::borrow::Cow;

use super::format::{Content, Scalar};

/// A number, or a fixed array of numbers, that a checkpoint stores as raw little-endian bytes: `f64`, `u8`, `u32`, `u64`
/// and arrays of these such as `[f64; 9]`. Sealed: other types go through
/// [`put_value`](super::CheckpointWriter::put_value).
pub trait Element: bytemuck::Pod + sealed::Sealed {
    /// What a section of such elements is marked as holding.
    const CONTENT: Content;
    /// The element whose bytes in memory are this one's little-endian bytes; the identity on little-endian machines.
    #[doc(hidden)]
    fn to_little_endian(self) -> Self;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for u8 {}
    impl Sealed for u32 {}
    impl Sealed for u64 {}
    impl<T: Sealed, const N: usize> Sealed for [T; N] {}
}

impl Element for f64 {
    const CONTENT: Content = Content::Array {
        scalar: Scalar::F64,
        width: 1,
    };
    fn to_little_endian(self) -> Self {
        // Through the bits: a NaN keeps its payload.
        Self::from_bits(self.to_bits().to_le())
    }
}

macro_rules! integer {
    ($($type:ty => $scalar:ident),*) => {$(
        impl Element for $type {
            const CONTENT: Content = Content::Array { scalar: Scalar::$scalar, width: 1 };
            fn to_little_endian(self) -> Self {
                self.to_le()
            }
        }
    )*};
}
integer!(u8 => U8, u32 => U32, u64 => U64);

impl<T: Element, const N: usize> Element for [T; N] {
    const CONTENT: Content = {
        // The file knows bytes, not elements: a column of empty arrays would lose its length.
        assert!(N > 0, "a checkpoint cannot hold elements of no size");
        match T::CONTENT {
            Content::Array { scalar, width } => Content::Array {
                scalar,
                width: width * N as u32,
            },
            other => other,
        }
    };
    fn to_little_endian(self) -> Self {
        self.map(T::to_little_endian)
    }
}

/// The bytes to write for a column, copied only where the machine's order differs.
pub(super) fn encode<T: Element>(values: &[T]) -> Cow<'_, [u8]> {
    if cfg!(target_endian = "little") {
        return Cow::Borrowed(bytemuck::cast_slice(values));
    }
    let turned: Vec<T> = values
        .iter()
        .map(|value| value.to_little_endian())
        .collect();
    Cow::Owned(bytemuck::cast_slice(&turned).to_vec())
}

/// Undoes [`encode`] in place, on values whose memory was filled with the file's bytes.
pub(super) fn decode<T: Element>(values: &mut [T]) {
    if cfg!(target_endian = "big") {
        for value in values {
            *value = value.to_little_endian();
        }
    }
}
