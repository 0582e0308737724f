//! The analyses of a field as calls of a mesh and values: each checks the field and watches nothing.

use morse_smooth::field::{
    self, Bands, Basins, CriticalPoints, DeltaHierarchy, DeltaOptions, Features, Keep, LevelSets, LinkReading,
    MorseComplex, MorseHierarchy, PathStyle, PersistenceDiagram, ScalarField, Threshold,
};
use morse_smooth::mesh::TriMesh;
use morse_smooth::{Result, Watch};

pub(crate) fn critical_points(mesh: &TriMesh, values: &[f64], options: &DeltaOptions) -> Result<CriticalPoints> {
    field::critical_points(&ScalarField::new(mesh, values)?, options, &Watch::none())
}

pub(crate) fn largest_edge_difference(mesh: &TriMesh, values: &[f64]) -> f64 {
    field::largest_edge_difference(&ScalarField::new(mesh, values).expect("a field"))
}

pub(crate) fn delta_hierarchy(mesh: &TriMesh, values: &[f64], link: LinkReading) -> Result<DeltaHierarchy> {
    field::delta_hierarchy(&ScalarField::new(mesh, values)?, link, &Watch::none())
}

pub(crate) fn persistence(mesh: &TriMesh, values: &[f64]) -> Result<PersistenceDiagram> {
    field::persistence(&ScalarField::new(mesh, values)?, &Watch::none())
}

/// The values alone.
pub(crate) fn simplify(mesh: &TriMesh, values: &[f64], keep: Keep<'_>) -> Result<Vec<f64>> {
    Ok(field::simplify(&ScalarField::new(mesh, values)?, keep, &Watch::none())?.values)
}

pub(crate) fn morse_complex(
    mesh: &TriMesh,
    values: &[f64],
    persistence: Threshold,
    style: PathStyle,
) -> Result<MorseComplex> {
    field::morse_complex(&ScalarField::new(mesh, values)?, persistence, style, &Watch::none())
}

pub(crate) fn morse_hierarchy(mesh: &TriMesh, values: &[f64]) -> Result<MorseHierarchy> {
    field::morse_hierarchy(&ScalarField::new(mesh, values)?, &Watch::none())
}

pub(crate) fn basins(mesh: &TriMesh, values: &[f64], persistence: Threshold) -> Result<Basins> {
    field::basins(&ScalarField::new(mesh, values)?, persistence, &Watch::none())
}

pub(crate) fn level_sets(mesh: &TriMesh, values: &[f64], levels: &[f64]) -> Result<LevelSets> {
    field::level_sets(&ScalarField::new(mesh, values)?, levels, &Watch::none())
}

pub(crate) fn bands(mesh: &TriMesh, values: &[f64], levels: &[f64]) -> Result<Bands> {
    field::bands(&ScalarField::new(mesh, values)?, levels, &Watch::none())
}

pub(crate) fn evenly_spaced_levels(mesh: &TriMesh, values: &[f64], count: usize) -> Result<Vec<f64>> {
    field::evenly_spaced_levels(&ScalarField::new(mesh, values)?, count)
}

pub(crate) fn saddle_levels(mesh: &TriMesh, values: &[f64], vertices: Option<&[u32]>, offset: f64) -> Result<Vec<f64>> {
    field::saddle_levels(&ScalarField::new(mesh, values)?, vertices, offset, &Watch::none())
}

pub(crate) fn feature_points(mesh: &TriMesh, values: &[f64], features: &Features<'_>) -> Result<Vec<u32>> {
    field::feature_points(&[ScalarField::new(mesh, values)?], features, &Watch::none())
}
