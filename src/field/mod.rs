//! Scalar fields on a mesh: order of the vertices, critical points and their hierarchy over δ, level sets, bands.

mod bands;
mod critical;
mod hierarchy;
mod level_set;
mod link;
mod order;
mod saddle_levels;

pub use bands::{Bands, bands};
pub use critical::{
    CriticalCounts, CriticalKind, CriticalPoint, CriticalPoints, DeltaOptions, DeltaScale, ExtremumRule, LinkReading,
    critical_points, largest_edge_difference,
};
pub use hierarchy::{DeltaCurve, DeltaHierarchy, HierarchyPoint, delta_hierarchy};
pub use level_set::{LevelSets, evenly_spaced_levels, level_sets};
pub use order::{ValueRange, VertexOrder, value_range};
pub use saddle_levels::saddle_levels;
