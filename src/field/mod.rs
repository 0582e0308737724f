//! Scalar fields on a mesh: order of the vertices, critical points and their hierarchy over δ, persistence, feature points,
//! simplification, the Morse complex, level sets.

mod arrays;
mod critical;

mod delta_hierarchy;
mod features;
mod level;
mod link;
mod merging;
mod morse;
mod order;
mod persistence;
mod saddles;
mod scalar_field;
mod simplify;
mod sorting;
mod steepest;
mod sweep;

pub use critical::{
    CriticalCounts, CriticalKind, CriticalPoint, CriticalPoints, DeltaOptions, DeltaScale, ExtremumRule, LinkReading,
    critical_points, largest_edge_difference,
};
pub use delta_hierarchy::{DeltaCurve, DeltaHierarchy, HierarchyPoint, delta_hierarchy};
pub use features::{Features, feature_points, with_stars};
pub use level::{Bands, LevelSets, bands, evenly_spaced_levels, level_sets, saddle_levels};
pub use morse::{Basins, MorseComplex, MorseHierarchy, MorseNode, PathStyle, basins, morse_complex, morse_hierarchy};
pub use order::{Threshold, ValueRange, VertexOrder, value_range};
pub use persistence::{PersistenceCurve, PersistenceDiagram, PersistencePair, persistence};
pub use scalar_field::{Missing, ScalarField};
pub use simplify::{Keep, Simplified, simplify};
pub(crate) use sorting::{ascending_bits, sort_by_key, sort_by_value};
