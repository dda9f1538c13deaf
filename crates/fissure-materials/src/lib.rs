//! Constitutive laws, the material-point driver and the public battery of contract checks.
