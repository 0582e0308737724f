//! Missing values: the part of a mesh that has values, and the gaps that are to be filled.

use std::sync::Arc;

use super::operators::Operators;
use crate::error::{Error, FieldError, MeshError, Result, SmoothError, SolveError};
use crate::mesh::{Submesh, TriMesh};
use crate::smooth::SmootherOptions;
use crate::support::memory;
use crate::support::watch::Watch;

/// The triangles whose three vertices have values, as a mesh of its own.
#[derive(Debug)]
pub(super) struct KnownPart {
    /// For every vertex of the part its id in the whole mesh; ascending.
    pub(super) vertices: Vec<u32>,
    pub(super) mesh: TriMesh,
}

/// That part with its operators.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) known: KnownPart,
    pub(super) operators: Arc<Operators>,
}

/// Vertices without a value that smoothing is to fill in.
#[derive(Debug, Clone)]
pub(super) struct Gaps<'a> {
    /// Those vertices, ascending.
    pub(super) missing: Arc<[u32]>,
    /// The part of the mesh with values; nothing where no triangle has three.
    pub(super) part: Option<&'a Arc<Part>>,
}

/// What the search for constraints has to know of gaps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Holes<'a> {
    /// The vertices without a value, ascending.
    pub(super) missing: &'a [u32],
    /// The part of the mesh with values; nothing where no triangle has three.
    pub(super) known: Option<&'a KnownPart>,
}

impl Gaps<'_> {
    /// Whether a vertex has a value.
    pub(super) fn has_value(&self, vertex: u32) -> bool {
        self.holes().has_value(vertex)
    }

    pub(super) fn holes(&self) -> Holes<'_> {
        Holes { missing: &self.missing, known: self.part.map(|part| &part.known) }
    }
}

impl Holes<'_> {
    /// Whether a vertex has a value.
    pub(super) fn has_value(&self, vertex: u32) -> bool {
        self.missing.binary_search(&vertex).is_err()
    }
}

/// The vertices at which the value of some channel is missing, ascending. What is wrong with lengths is left for others to say.
///
/// # Errors
/// `NonFiniteValue` for an infinite value.
pub(super) fn missing_vertices(mesh: &TriMesh, values: &[f64], channels: usize) -> Result<Vec<u32>, FieldError> {
    if channels == 0 || mesh.vertex_count().checked_mul(channels) != Some(values.len()) {
        return Ok(Vec::new());
    }
    if !values.iter().any(|value| value.is_nan()) {
        return Ok(Vec::new());
    }
    let mut missing = Vec::new();
    for (vertex, values) in (0_u32..).zip(values.chunks_exact(channels)) {
        if values.iter().any(|value| value.is_infinite()) {
            return Err(FieldError::NonFiniteValue { vertex });
        }
        if values.iter().any(|value| value.is_nan()) {
            missing.push(vertex);
        }
    }
    Ok(missing)
}

impl Part {
    /// The part of a mesh without some vertices, which ascend; nothing where no triangle is left.
    ///
    /// # Errors
    /// Those of [`Operators::new`].
    pub(super) fn without(
        mesh: &TriMesh,
        missing: &[u32],
        options: SmootherOptions,
        watch: &Watch<'_>,
    ) -> Result<Option<Self>> {
        let Some(known) = KnownPart::without(mesh, missing, watch)? else { return Ok(None) };
        let operators =
            Operators::new(&known.mesh, options, watch).map_err(|error| to_whole(&known.vertices, error))?;
        Ok(Some(Self { known, operators: Arc::new(operators) }))
    }
}

impl KnownPart {
    /// The part of a mesh without some vertices, which ascend; nothing where no triangle is left.
    ///
    /// # Errors
    /// `Cancelled`, `OutOfMemory`.
    pub(super) fn without(mesh: &TriMesh, missing: &[u32], watch: &Watch<'_>) -> Result<Option<Self>> {
        memory::ensure(mesh.vertex_count() as u64)?;
        let mut has = vec![true; mesh.vertex_count()];
        missing.iter().for_each(|&v| has[v as usize] = false);
        match mesh.submesh_watched(&|v| has[v as usize], watch) {
            Ok(Submesh { mesh, vertices, .. }) => Ok(Some(Self { vertices, mesh })),
            Err(MeshError::EmptyMesh { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// The values of the part among those of the whole mesh, `channels` for each vertex.
    pub(super) fn gather(&self, values: &[f64], channels: usize) -> Vec<f64> {
        let mut gathered = Vec::with_capacity(self.vertices.len() * channels);
        for &v in &self.vertices {
            gathered.extend_from_slice(&values[v as usize * channels..(v as usize + 1) * channels]);
        }
        gathered
    }

    /// Writes values of the part over those of the whole mesh.
    pub(super) fn scatter(&self, part: &[f64], channels: usize, whole: &mut [f64]) {
        for (&v, values) in self.vertices.iter().zip(part.chunks_exact(channels)) {
            whole[v as usize * channels..(v as usize + 1) * channels].copy_from_slice(values);
        }
    }

    /// Vertices of the whole mesh as those of the part.
    ///
    /// # Errors
    /// `IndexOutOfBounds`, with the `count` of vertices of the whole mesh; `MissingValue` for what is not in the part.
    pub(super) fn find(&self, vertices: &[u32], count: usize) -> Result<Vec<u32>, FieldError> {
        let find = |&vertex: &u32| match self.vertices.binary_search(&vertex) {
            Ok(place) => Ok(place as u32),
            Err(_) if vertex as usize >= count => Err(FieldError::IndexOutOfBounds { index: vertex, vertices: count }),
            Err(_) => Err(FieldError::MissingValue { vertex }),
        };
        vertices.iter().map(find).collect()
    }
}

/// An error with vertices of a part as one with those of the whole mesh.
pub(super) fn to_whole(vertices: &[u32], error: Error) -> Error {
    let whole = |vertex: u32| vertices.get(vertex as usize).copied().unwrap_or(vertex);
    match error {
        Error::Mesh(MeshError::ZeroWeightSum { vertex }) => MeshError::ZeroWeightSum { vertex: whole(vertex) }.into(),
        Error::Smooth(SmoothError::Unconstrained { component, vertex }) => {
            SmoothError::Unconstrained { component, vertex: whole(vertex) }.into()
        }
        Error::Smooth(SmoothError::ConflictingExtremum { vertex }) => {
            SmoothError::ConflictingExtremum { vertex: whole(vertex) }.into()
        }
        Error::Smooth(SmoothError::AdjacentExtrema { first, second, kind }) => {
            SmoothError::AdjacentExtrema { first: whole(first), second: whole(second), kind }.into()
        }
        Error::Smooth(SmoothError::Infeasible { from, to }) => {
            SmoothError::Infeasible { from: whole(from), to: whole(to) }.into()
        }
        Error::Field(FieldError::NotAnExtremum { vertex }) => {
            FieldError::NotAnExtremum { vertex: whole(vertex) }.into()
        }
        Error::Field(FieldError::Unconstrained { component, vertex }) => {
            FieldError::Unconstrained { component, vertex: whole(vertex) }.into()
        }
        Error::Field(FieldError::UnavoidableExtremum { vertex }) => {
            FieldError::UnavoidableExtremum { vertex: whole(vertex) }.into()
        }
        Error::Smooth(SmoothError::InvalidWeight { index, vertex }) => {
            SmoothError::InvalidWeight { index, vertex: whole(vertex) }.into()
        }
        Error::Smooth(SmoothError::NotPositiveDefinite { column }) => {
            SmoothError::NotPositiveDefinite { column: whole(column as u32) as usize }.into()
        }
        Error::Solve(SolveError::NonFiniteEntry { row }) => {
            SolveError::NonFiniteEntry { row: whole(row as u32) as usize }.into()
        }
        other => other,
    }
}
