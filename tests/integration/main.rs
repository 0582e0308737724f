//! The integration tests, in one binary. wasm32 runs `tests/bindings/` instead.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test fails by panicking")]

mod analyses;
mod bands;
mod bilateral;
mod bounds;
mod cholesky;
mod constrained;
mod constrained_invariants;
mod constraint_sets;
mod critical;
mod data;
mod definite;
mod dense_reference;
mod exact;
mod extremes;
mod family;
mod family_choice;
mod family_curves;
mod family_data;
mod family_growth;
mod features;
mod fem;
mod filters;
#[cfg(feature = "render")]
mod golden;
mod hierarchy;
mod intrinsic;
mod intrinsic_properties;
mod io_damaged;
mod io_data;
mod io_malformed;
mod io_peers;
mod io_read;
mod io_reported;
mod io_tables;
mod io_write;
mod iterative;
mod layering;
mod level_sets;
mod mesh;
mod missing;
mod morse;
mod operators;
mod ordering;
mod persistence;
#[cfg(feature = "render")]
mod pictures;
mod pinches;
mod prescribe;
mod prescribe_data;
mod prescribe_dense;
mod prescribe_peer;
mod readme;
mod refusals;
mod reuse;
mod routes;
mod saddle_levels;
mod simplify;
mod smooth;
mod smooth_iterative;
mod smooth_missing;
mod smooth_stopped;
mod solve;
mod solve_watch;
mod stopping;
mod support;
mod thin;
mod thresholds;
#[cfg(feature = "render")]
mod ticks;
mod weld;
