//! Which vertices are constrained, and what becomes of the components that have none.

use super::channels::{Channel, Channels};
use super::system::Reach;
use crate::error::{Result, SmoothError};
use crate::field::{Features, ScalarField, feature_points, with_stars};
use crate::mesh::TriMesh;
use crate::support::watch::Watch;

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
            let values = channels.values(c);
            let field = [ScalarField::new(mesh, &values)?];
            features.extend(feature_points(&field, &constraints.features, &Watch::none())?);
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

/// The components that have no constrained vertex: their vertices are no unknowns.
#[derive(Debug)]
pub(super) struct LeftOut {
    /// Per component.
    is_left_out: Vec<bool>,
    takes_mean: bool,
}

impl LeftOut {
    /// # Errors
    /// `Unconstrained` with the first such component, where that is an error.
    pub(super) fn new(reach: &Reach, set: &ConstraintSet, unconstrained: Unconstrained) -> Result<Self, SmoothError> {
        let mut is_left_out = vec![true; reach.first_vertices().len()];
        for &v in &set.vertices {
            if let Some(component) = reach.component(v) {
                is_left_out[component] = false;
            }
        }
        if unconstrained == Unconstrained::Error
            && let Some(component) = is_left_out.iter().position(|&left_out| left_out)
        {
            return Err(SmoothError::Unconstrained { component, vertex: reach.first_vertices()[component] });
        }
        Ok(Self { is_left_out, takes_mean: unconstrained == Unconstrained::Mean })
    }

    /// Whether no component is left out.
    pub(super) fn is_empty(&self) -> bool {
        !self.is_left_out.contains(&true)
    }

    /// The vertices of components that are not left out.
    pub(super) fn remaining(&self, reach: &Reach) -> Vec<u32> {
        let remains = |v: u32| reach.component(v).is_some_and(|component| !self.is_left_out[component]);
        reach.active().iter().copied().filter(|&v| remains(v)).collect()
    }

    /// Writes what becomes of the components left out into normalised values.
    pub(super) fn write(&self, reach: &Reach, x: &mut [f64]) {
        if !self.takes_mean || self.is_empty() {
            return;
        }
        let mut sums = vec![(0.0, 0_u32); self.is_left_out.len()];
        for &v in reach.active() {
            if let Some(component) = reach.component(v) {
                let (sum, count) = &mut sums[component];
                *sum += x[v as usize];
                *count += 1;
            }
        }
        for &v in reach.active() {
            if let Some(component) = reach.component(v)
                && self.is_left_out[component]
            {
                let (sum, count) = sums[component];
                x[v as usize] = sum / f64::from(count);
            }
        }
    }

    /// Whether a vertex gets another value than it had, though it is no unknown.
    pub(super) fn moves(&self, reach: &Reach, vertex: u32) -> bool {
        self.takes_mean && reach.component(vertex).is_some_and(|component| self.is_left_out[component])
    }
}

/// Components in which all constrained values are the same have this value everywhere by every method. A solver comes to it but
/// for rounding, which would have critical points; so these values are written as they are, into the normalised ones and the
/// others.
pub(super) fn level_constant_components(
    reach: &Reach,
    set: &ConstraintSet,
    channel: &Channel,
    x: &mut [f64],
    smoothed: &mut [f64],
) {
    let mut example = vec![None; reach.first_vertices().len()];
    let mut varies = vec![false; example.len()];
    for &v in &set.vertices {
        if let Some(component) = reach.component(v) {
            let first = *example[component].get_or_insert(v);
            varies[component] |= channel.values[v as usize] != channel.values[first as usize];
        }
    }
    for &v in reach.active() {
        if let Some(component) = reach.component(v)
            && let Some(first) = example[component]
            && !varies[component]
        {
            x[v as usize] = channel.normalized[first as usize];
            smoothed[v as usize] = channel.values[first as usize];
        }
    }
}
