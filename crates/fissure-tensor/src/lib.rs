//! Symmetric tensors in Mandel form, fourth-order tangents, rotations and spectral decompositions.
