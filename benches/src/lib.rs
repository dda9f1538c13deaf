//! Time per step and per call of a law: `cargo bench -p fissure-benches`.
//!
//! `cargo run --release -p fissure-benches --bin throughput` prints particle updates per second, and
//! `benches/peers/run` those of other codes on the same problems.
//!
//! The benchmarks are in `benches/benches`; this library is empty.
