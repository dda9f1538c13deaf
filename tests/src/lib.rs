//! What the verification tests share: the table of discretisations, scenes to start from, exact
//! sums, and laws that exist for tests only.

mod case;
mod laws;
mod measure;
mod space;

pub use case::{Case, ShapeKind, Space, cases};
pub use laws::{Refusing, rubber};
pub use measure::{
    Order, bits, compensated, largest_difference, momentum, momentum_scale, observed_orders,
};
pub use space::{Build, Table};
