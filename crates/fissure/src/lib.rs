//! Material failure with particle methods: the facade crate.
