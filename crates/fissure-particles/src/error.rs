//! What can go wrong with particle columns.

use std::error::Error;

/// A refused change of a body's particles.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ParticleError {
    /// A column is longer or shorter than the body has particles.
    #[error("column '{column}' has {found} rows; every column of a body must have {expected}")]
    ColumnLength {
        /// Name of the column.
        column: &'static str,
        /// Rows it has.
        found: usize,
        /// Rows it must have.
        expected: usize,
    },
    /// An order handed to a reordering is not a permutation of the rows.
    #[error("entry {row} of the order is {value}; the entries must be 0..{len}, each of them once")]
    NotAPermutation {
        /// Index of the first offending entry of the order.
        row: usize,
        /// That entry.
        value: u32,
        /// Number of particles.
        len: usize,
    },
    /// Two particles of one body carry the same id.
    #[error("particle id {id} occurs more than once; ids must be unique in a body")]
    RepeatedId {
        /// The id.
        id: u32,
    },
    /// A body would hold more particles than ids can tell apart.
    #[error("{asked} particles asked for; a body holds at most {limit}")]
    TooMany {
        /// Particles the body would have.
        asked: usize,
        /// Greatest permitted number.
        limit: usize,
    },
    /// A number given for a new particle is outside its range.
    #[error("{quantity} is {value}; it must be finite and {rule}")]
    OutOfRange {
        /// What the number is, with its unit.
        quantity: &'static str,
        /// The number.
        value: f64,
        /// The permitted range.
        rule: &'static str,
    },
}

/// A refused use of the optional columns.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExtraError {
    /// Two column types claim one name.
    #[error("column name '{name}' already belongs to {held}; {asked} must have a name of its own")]
    NameTaken {
        /// The name both claim.
        name: &'static str,
        /// The type which has it.
        held: &'static str,
        /// The type which was refused.
        asked: &'static str,
    },
    /// No column of this name is there, so that nothing says how its bytes are to be read.
    #[error("no optional column is named '{name}'; present are {present:?} (call `ensure` first)")]
    UnknownColumn {
        /// The name asked for.
        name: String,
        /// The names there are.
        present: Vec<&'static str>,
    },
    /// A column is longer or shorter than the body has particles.
    #[error("column '{name}' has {found} rows; it must have {expected}, one per particle")]
    Length {
        /// Name of the column.
        name: &'static str,
        /// Rows it has.
        found: u64,
        /// Rows it must have.
        expected: usize,
    },
    /// The entries could not be turned into bytes.
    #[error("column '{name}' could not be written as bytes")]
    Encode {
        /// Name of the column.
        name: &'static str,
        /// What the encoder said.
        source: Box<dyn Error + Send + Sync>,
    },
    /// The bytes are not those of such a column.
    #[error("the bytes for column '{name}' could not be read")]
    Decode {
        /// Name of the column.
        name: &'static str,
        /// What the decoder said.
        source: Box<dyn Error + Send + Sync>,
    },
    /// The bytes go on after the last entry.
    #[error("{left} bytes are left over after column '{name}'; there must be none")]
    LeftOver {
        /// Name of the column.
        name: &'static str,
        /// Bytes left over.
        left: usize,
    },
}
