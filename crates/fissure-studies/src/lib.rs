//! The experiments of the source documents, one sub-command each.

pub mod framework;
