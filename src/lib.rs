//! Smooths a scalar field on a triangle mesh without losing the critical points that matter.
//!
//! The crate implements G. Patanè and B. Falcidieno, *Computing Smooth Approximations of Scalar Functions with
//! Constraints* (\[Patane09\] in `references.md`). Data flows one way: [`mesh`] → [`operators`] and [`field`] → [`smooth`],
//! with [`solve`] knowing matrices only; [`mod@load`] makes meshes of the files that [`io`] reads.
//!
//! The kernels of [`solve`] are vectorised for the processor that the compiler is told: natively with
//! `RUSTFLAGS="-C target-cpu=native"`, for WebAssembly with `-C target-feature=+simd128`. Results do not depend on that.
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod error;
pub mod field;
#[cfg(feature = "files")]
pub mod io;
#[cfg(feature = "files")]
pub mod load;
pub mod mesh;
pub mod operators;
#[cfg(feature = "render")]
pub mod render;
pub mod smooth;
pub mod solve;
mod support;
// Public for `tests/bindings/` alone; the API for users is in `src/js`.
#[cfg(feature = "bindings")]
#[doc(hidden)]
pub mod wasm;

pub use error::{Diagnostic, Error, Result};
#[cfg(feature = "files")]
pub use load::load;
pub use mesh::TriMesh;
pub use smooth::{Smoother, SmootherOptions};
pub use support::watch::{Phase, Progress, Watch};

// The README's Rust runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
