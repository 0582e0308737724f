//! What the two benches of the solver, `benches/solver.rs` (native) and `benches/peers` (WebAssembly), build and run.
#![allow(dead_code, reason = "neither bench uses everything")]

pub(crate) mod accuracy;
pub(crate) mod csc;
pub(crate) mod extended;
pub(crate) mod faer;
pub(crate) mod meshes;
pub(crate) mod ours;
pub(crate) mod systems;
