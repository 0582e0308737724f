//! Level sets of the piecewise linear field, and the bands between them.

mod bands;
mod level_set;
mod saddle_levels;

pub use bands::{Bands, bands};
pub use level_set::{LevelSets, evenly_spaced_levels, level_sets};
pub use saddle_levels::saddle_levels;
