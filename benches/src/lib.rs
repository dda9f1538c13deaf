//! Time per step and per call of a law: `cargo bench -p fissure-benches`.
//!
//! The benchmarks are in `benches/benches`; this library is empty.
