//! Building meshes.
