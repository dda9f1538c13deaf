//! Measures of a scene: energies, section forces, failed zones, histories.
