//! Scalar fields on a mesh: order of the vertices, critical points and their hierarchy over δ, level sets, bands.

mod bands;
mod critical;
mod direction;
mod flats;
mod flooding;
mod hierarchy;
mod level_set;
mod link;
mod link_sides;
mod loops;
mod merging;
mod morse;
mod order;
mod persistence;
mod saddle_levels;
mod saddles;
mod simplify;
mod sorting;
mod steepest;
mod tilt;

pub use bands::{Bands, bands};
pub use critical::{
    CriticalCounts, CriticalKind, CriticalPoint, CriticalPoints, DeltaOptions, DeltaScale, ExtremumRule, LinkReading,
    critical_points, largest_edge_difference,
};
pub use hierarchy::{DeltaCurve, DeltaHierarchy, HierarchyPoint, delta_hierarchy};
pub use level_set::{LevelSets, evenly_spaced_levels, level_sets};
pub use morse::{Basins, MorseComplex, MorseHierarchy, MorseNode, PathStyle, basins, morse_complex, morse_hierarchy};
pub use order::{ValueRange, VertexOrder, value_range};
pub use persistence::{PersistenceCurve, PersistenceDiagram, PersistencePair, persistence};
pub use saddle_levels::saddle_levels;
pub use simplify::{Keep, ThresholdScale, simplify};
