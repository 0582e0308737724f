//! The Morse complex: which extrema steepest paths join to which saddles, and what is left of it when pairs are cancelled.

mod basins;
mod cancellations;
mod hierarchy;
mod paths;
mod separatrices;
mod simple_saddles;

pub use basins::{Basins, basins};
pub use hierarchy::{MorseHierarchy, MorseNode, morse_hierarchy};
pub use separatrices::{MorseComplex, PathStyle, morse_complex};

/// Where there is nothing to name.
const NONE: u32 = u32::MAX;
