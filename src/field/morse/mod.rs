//! The Morse complex: which extrema steepest paths join to which saddles, and what is left of it when pairs are cancelled.

mod flow;
mod hierarchy;
mod separatrices;
mod units;

pub use hierarchy::{Basins, MorseHierarchy, MorseNode, basins, morse_hierarchy};
pub use separatrices::{MorseComplex, PathStyle, morse_complex};

/// Where there is nothing to name.
const NONE: u32 = u32::MAX;
