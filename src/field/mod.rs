//! Scalar fields on a mesh: order of the vertices, critical points, level sets.

mod critical;
mod direction;
mod flats;
mod flooding;
mod level_set;
mod link;
mod link_sides;
mod loops;
mod merging;
mod morse;
mod order;
mod persistence;
mod saddles;
mod simplify;
mod sorting;
mod steepest;
mod tilt;

pub use critical::{
    CriticalCounts, CriticalKind, CriticalPoint, CriticalPoints, DeltaOptions, DeltaScale, ExtremumRule, LinkReading,
    critical_points, largest_edge_difference,
};
pub use level_set::{LevelSets, evenly_spaced_levels, level_sets};
pub use morse::{Basins, MorseComplex, MorseHierarchy, MorseNode, PathStyle, basins, morse_complex, morse_hierarchy};
pub use order::{ValueRange, VertexOrder, value_range};
pub use persistence::{PersistenceCurve, PersistenceDiagram, PersistencePair, persistence};
pub use simplify::{Keep, ThresholdScale, simplify};
