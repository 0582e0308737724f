//! Which vertices are constrained, and what becomes of the components that have none.

use std::sync::Arc;

use super::active::ActiveVertices;
use super::channels::{Channel, Channels};
use super::input::Input;
use super::missing::{Gaps, Holes, KnownPart, missing_vertices};
use super::schedule::Stages;
use crate::error::{FieldError, MeshError, Result};
use crate::field::{Features, Missing, ScalarField, feature_points, with_stars};
use crate::mesh::TriMesh;
use crate::support::memory;
use crate::support::named::named;
use crate::support::watch::{Phase, Watch};

/// What becomes of a component of the mesh without a constrained vertex, where the equations say nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unconstrained {
    /// An error with the component. The default.
    #[default]
    Error,
    /// Its values stay, also missing ones.
    Keep,
    /// All its vertices get the mean of its values; where all of them are missing, the mean of all values that there are.
    Mean,
}

named! { Unconstrained { Error = "error", Keep = "keep", Mean = "mean" } }

/// Which vertices are constrained.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraints<'a> {
    /// The feature points. With several channels, those of all of them together. Default none.
    pub features: Features<'a>,
    /// Whether their 1-stars are constrained, too: what interpolation needs to keep critical points with their types.
    /// Default false.
    pub stars: bool,
    /// Components without a constrained vertex. Default an error.
    pub unconstrained: Unconstrained,
}

impl Default for Constraints<'_> {
    fn default() -> Self {
        Self { features: Features::Vertices(&[]), stars: false, unconstrained: Unconstrained::default() }
    }
}

/// The vertices that constraints come to, ascending, each once: stars included, with several channels those of all of them.
///
/// # Missing values
/// They are the vertices that smoothing constrains with the same `missing`. Vertices at which the value of some channel is missing are
/// none of them, and rules look at the triangles that have three values. Stars are those of these triangles with [`Missing::Omit`],
/// of the whole mesh with [`Missing::Fill`].
///
/// # Errors
/// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`, `IndexOutOfBounds`, `InvalidOption`; where values are missing `MissingValue` and
/// `EmptyMesh`, too; `Cancelled`.
pub fn constrained_vertices(
    mesh: &TriMesh,
    values: &[f64],
    channels: usize,
    missing: Missing,
    constraints: &Constraints<'_>,
    watch: &Watch<'_>,
) -> Result<Vec<u32>> {
    let gone = match missing {
        Missing::Error => Vec::new(),
        Missing::Omit | Missing::Fill => missing_vertices(mesh, values, channels)?,
    };
    if gone.is_empty() {
        let channels = Channels::new(mesh, values, channels, Arc::default())?;
        return Ok(ConstraintSet::found(mesh, &channels, None, constraints, watch)?.vertices);
    }
    let known = KnownPart::without(mesh, &gone, watch)?;
    if missing == Missing::Fill {
        let holes = Holes { missing: &gone, known: known.as_ref() };
        let channels = Channels::new(mesh, values, channels, gone.as_slice().into())?;
        return Ok(ConstraintSet::found(mesh, &channels, Some(holes), constraints, watch)?.vertices);
    }
    let known = known.ok_or(MeshError::EmptyMesh { vertices: 0, triangles: 0 })?;
    let listed = match constraints.features {
        Features::Vertices(vertices) => Some(known.find(vertices, mesh.vertex_count())?),
        _ => None,
    };
    let features = listed.as_deref().map_or(constraints.features, Features::Vertices);
    // The values of the part.
    memory::ensure(8 * (known.vertices.len() * channels) as u64)?;
    let of_part = known.gather(values, channels);
    let of_part = Channels::new(&known.mesh, &of_part, channels, Arc::default())?;
    let constraints = Constraints { features, ..*constraints };
    let mut vertices = ConstraintSet::found(&known.mesh, &of_part, None, &constraints, watch)?.vertices;
    vertices.iter_mut().for_each(|v| *v = known.vertices[*v as usize]);
    Ok(vertices)
}

impl Constraints<'_> {
    /// Whether the vertices are to be found by a rule.
    pub(super) fn is_rule(&self) -> bool {
        !matches!(self.features, Features::Vertices(_))
    }
}

/// The vertices that the rules came to.
#[derive(Debug, Clone)]
pub(super) struct ConstraintSet {
    /// The feature points, without stars. Ascending.
    pub(super) features: Vec<u32>,
    /// The constrained vertices. Ascending.
    pub(super) vertices: Vec<u32>,
}

impl ConstraintSet {
    /// Rules look at the part of the mesh that has values, and vertices without values are not constrained.
    pub(super) fn new(input: &Input<'_>, constraints: &Constraints<'_>, stages: &mut Stages<'_, '_>) -> Result<Self> {
        if constraints.is_rule() {
            stages.begin(Phase::Field, 0)?;
        }
        Self::found(
            &input.operators.mesh,
            &input.channels,
            input.gaps.as_ref().map(Gaps::holes),
            constraints,
            stages.watch,
        )
    }

    fn found(
        mesh: &TriMesh,
        channels: &Channels<'_>,
        holes: Option<Holes<'_>>,
        constraints: &Constraints<'_>,
        watch: &Watch<'_>,
    ) -> Result<Self> {
        // The values of a channel, also of the part that has values; the lists and marks that become the set.
        memory::ensure(40 * mesh.vertex_count() as u64)?;
        let mut features = Vec::new();
        match (&constraints.features, holes) {
            (Features::Vertices(vertices), _) => {
                let count = mesh.vertex_count();
                for &vertex in *vertices {
                    if vertex as usize >= count {
                        return Err(FieldError::IndexOutOfBounds { index: vertex, vertices: count }.into());
                    }
                    if holes.is_some_and(|holes| !holes.has_value(vertex)) {
                        return Err(FieldError::MissingValue { vertex }.into());
                    }
                }
                features.extend_from_slice(vertices);
            }
            (rule, None) => {
                for c in 0..channels.count() {
                    let values = channels.values(c);
                    features.extend(feature_points(&[ScalarField::new(mesh, &values)?], rule, watch)?);
                }
            }
            (rule, Some(holes)) => {
                let Some(known) = holes.known else {
                    return Err(MeshError::EmptyMesh { vertices: 0, triangles: 0 }.into());
                };
                for c in 0..channels.count() {
                    let values = known.gather(&channels.values(c), 1);
                    let field = ScalarField::new(&known.mesh, &values)?;
                    let found = feature_points(&[field], rule, watch)?;
                    features.extend(found.into_iter().map(|v| known.vertices[v as usize]));
                }
            }
        }
        features.sort_unstable();
        features.dedup();
        let mut vertices =
            if constraints.stars { with_stars(mesh.connectivity(), &features) } else { features.clone() };
        if let Some(holes) = holes {
            vertices.retain(|&v| holes.has_value(v));
        }
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

/// Components with a single constrained vertex have its value everywhere by every method, whatever the values are: they need not be
/// solved for. Takes their vertices out of `unknowns`, and tells the number of vertices of the largest one, 0 where there is none.
pub(super) fn leave_out_constant_components(
    active: &ActiveVertices,
    set: &ConstraintSet,
    unknowns: &mut Vec<u32>,
) -> usize {
    let mut constrained = vec![0_u32; active.first_vertices().len()];
    for &v in &set.vertices {
        if let Some(component) = active.component(v) {
            constrained[component] += 1;
        }
    }
    let mut sizes = vec![0; constrained.len()];
    for component in active.list().iter().filter_map(|&v| active.component(v)) {
        sizes[component] += usize::from(constrained[component] == 1);
    }
    unknowns.retain(|&v| active.component(v).is_none_or(|component| sizes[component] == 0));
    sizes.into_iter().max().unwrap_or(0)
}
