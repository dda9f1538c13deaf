//! What the verification tests share: the table of discretisations, scenes to start from, exact
//! sums, and laws that exist for tests only.

// Errors are those of the solver; `!(a <= b)` is how a comparison is written so that NaN fails it.
#![allow(clippy::neg_cmp_op_on_partial_ord, clippy::result_large_err)]

mod case;
mod laws;
mod measure;
mod space;

pub use case::{Case, ShapeKind, Space, cases};
pub use laws::{Dense, Refusing, rubber};
pub use measure::{
    Order, bits, compensated, largest_difference, momentum, momentum_scale, observed_orders,
};
pub use space::{Build, Table};
