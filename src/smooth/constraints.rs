//! Which vertices are constrained, and what becomes of the components that have none.

use super::channels::{Channel, Channels};
use super::active::ActiveVertices;
use crate::error::{Result, SmoothError};
use crate::field::{Features, feature_points, with_stars};
use crate::mesh::TriMesh;

/// What becomes of a component of the mesh without a constrained vertex, where the equations say nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unconstrained {
    /// An error with the component. The default.
    #[default]
    Error,
    /// Its values stay.
    Keep,
    /// All its vertices get the mean of its values.
    Mean,
}

/// Which vertices are constrained.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraints<'a> {
    /// The feature points. With several channels, those of all of them together.
    pub features: Features<'a>,
    /// Whether their 1-stars are constrained, too: what interpolation needs to keep critical points with their types.
    pub stars: bool,
    /// Components without a constrained vertex. Default an error.
    pub unconstrained: Unconstrained,
}

/// The vertices that constraints come to, ascending, each once: stars included, with several channels those of all of them.
///
/// # Errors
/// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`, `IndexOutOfBounds`, `InvalidOption`.
pub fn constrained_vertices(
    mesh: &TriMesh,
    values: &[f64],
    channels: usize,
    constraints: &Constraints<'_>,
) -> Result<Vec<u32>> {
    Ok(ConstraintSet::new(mesh, &Channels::new(mesh, values, channels)?, constraints)?.vertices)
}

/// The vertices that the rules came to.
#[derive(Debug)]
pub(super) struct ConstraintSet {
    /// The feature points, without stars. Ascending.
    pub(super) features: Vec<u32>,
    /// The constrained vertices. Ascending.
    pub(super) vertices: Vec<u32>,
}

impl ConstraintSet {
    pub(super) fn new(mesh: &TriMesh, channels: &Channels<'_>, constraints: &Constraints<'_>) -> Result<Self> {
        let mut features = Vec::new();
        for c in 0..channels.count() {
            features.extend(feature_points(mesh, &channels.values(c), &constraints.features)?);
            if matches!(constraints.features, Features::Vertices(_)) {
                break;
            }
        }
        features.sort_unstable();
        features.dedup();
        let vertices = if constraints.stars { with_stars(mesh.connectivity(), &features) } else { features.clone() };
        Ok(Self { features, vertices })
    }
}

/// Components in which all constrained values are the same have this value everywhere by every method. A solver comes to it but
/// for rounding, which would have critical points; so these values are written as they are, into the normalised ones and the
/// others.
pub(super) fn level_constant_components(
    active: &ActiveVertices,
    set: &ConstraintSet,
    channel: &Channel,
    x: &mut [f64],
    smoothed: &mut [f64],
) {
    let mut example = vec![None; active.first_vertices().len()];
    let mut varies = vec![false; example.len()];
    for &v in &set.vertices {
        if let Some(component) = active.component(v) {
            let first = *example[component].get_or_insert(v);
            varies[component] |= channel.values[v as usize] != channel.values[first as usize];
        }
    }
    for &v in active.list() {
        if let Some(component) = active.component(v)
            && let Some(first) = example[component]
            && !varies[component]
        {
            x[v as usize] = channel.normalized[first as usize];
            smoothed[v as usize] = channel.values[first as usize];
        }
    }
}
