//! A scalar field: values on a mesh, checked once.

use std::borrow::Cow;

use super::arrays::{collected, filled, with_room};
use super::order::{ValueRange, VertexOrder, value_range};
use crate::error::{FieldError, OptionError, OutOfMemory, Result};
use crate::mesh::{Submesh, TriMesh};
use crate::support::named::named;
use crate::support::watch::Watch;

/// What a value that is not a number (NaN) means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Missing {
    /// A mistake: the error `NonFiniteValue`. The default.
    #[default]
    Error,
    /// The vertex has no value, and its triangles are left out, as if the mesh had a hole there.
    Omit,
    /// The vertex has no value, and smoothing finds one.
    Fill,
}

named! { Missing { Error = "error", Omit = "omit", Fill = "fill" } }

/// One value per vertex of a mesh, checked: as many values as vertices, all finite, with a finite range.
///
/// Where values are missing and omitted, this is the field on the part of the mesh that has values ([`TriMesh::submesh`]); what is
/// found out about it is told in the ids of the whole mesh.
///
/// # Example
/// ```
/// use morse_smooth::field::ScalarField;
/// use morse_smooth::mesh::shapes;
/// let mesh = shapes::octahedron()?;
/// let field = ScalarField::new(&mesh, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0])?;
/// assert_eq!(field.range().length(), 5.0);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct ScalarField<'a> {
    mesh: TriMesh,
    values: Cow<'a, [f64]>,
    range: ValueRange,
    part: Option<Part>,
}

/// A result that names vertices or triangles of the mesh that it was found on, or has something for each vertex.
pub(super) trait OnMesh {
    /// Turns what is told of a part of a mesh into the same of the whole.
    ///
    /// # Errors
    /// `OutOfMemory`, where there is something for each vertex.
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory>;
}

/// What the part of a mesh that has values is in the whole.
#[derive(Debug, Clone)]
pub(super) struct Part {
    vertices: Vec<u32>,
    triangles: Vec<u32>,
    whole: TriMesh,
}

impl Part {
    /// The vertex of the whole that a vertex of the part is.
    pub(super) fn vertex(&self, vertex: &mut u32) {
        *vertex = self.vertices[*vertex as usize];
    }

    /// The vertices of the whole that vertices of the part are.
    pub(super) fn vertices(&self, vertices: &mut [u32]) {
        vertices.iter_mut().for_each(|vertex| self.vertex(vertex));
    }

    /// The triangles of the whole that triangles of the part are.
    pub(super) fn triangles(&self, triangles: &mut [u32]) {
        triangles.iter_mut().for_each(|triangle| *triangle = self.triangles[*triangle as usize]);
    }

    /// One element for each vertex of the whole: that of the part, where the vertex belongs to it.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub(super) fn spread<T: Copy>(&self, elements: &mut Vec<T>, elsewhere: T) -> Result<(), OutOfMemory> {
        let mut all = filled(elsewhere, self.whole.vertex_count())?;
        for (&vertex, &element) in self.vertices.iter().zip(elements.iter()) {
            all[vertex as usize] = element;
        }
        *elements = all;
        Ok(())
    }
}

impl<'a> ScalarField<'a> {
    /// Checks the values. The mesh is shared, not copied.
    ///
    /// # Errors
    /// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`.
    pub fn new(mesh: &TriMesh, values: &'a [f64]) -> Result<Self, FieldError> {
        let range = value_range(mesh.connectivity(), values)?;
        Ok(Self { mesh: mesh.clone(), values: Cow::Borrowed(values), range, part: None })
    }

    /// Checks values of which some may be missing (NaN).
    ///
    /// # Errors
    /// Those of [`ScalarField::new`], for an infinite value, too; `EmptyMesh` where no triangle has three values; `InapplicableOption` for
    /// [`Missing::Fill`]: only smoothing can fill.
    pub fn with_missing(mesh: &TriMesh, values: &'a [f64], missing: Missing) -> Result<Self> {
        Self::watched(mesh, values, missing, &Watch::none())
    }

    /// The same as [`ScalarField::with_missing`], watched: the part of the mesh that has values is made a mesh.
    ///
    /// # Errors
    /// Those of [`ScalarField::with_missing`]; `Cancelled`.
    pub fn watched(mesh: &TriMesh, values: &'a [f64], missing: Missing, watch: &Watch<'_>) -> Result<Self> {
        match missing {
            Missing::Fill => {
                let reason = "only smoothing can fill in missing values".to_owned();
                Err(OptionError::InapplicableOption { option: "missing".to_owned(), reason }.into())
            }
            Missing::Omit if values.len() == mesh.vertex_count() && values.iter().any(|value| value.is_nan()) => {
                if let Some(vertex) = values.iter().position(|value| value.is_infinite()) {
                    return Err(FieldError::NonFiniteValue { vertex: vertex as u32 }.into());
                }
                let Submesh { mesh: part, vertices, triangles } =
                    mesh.submesh_watched(&|v| !values[v as usize].is_nan(), watch)?;
                let values = collected(vertices.len(), vertices.iter().map(|&v| values[v as usize]))?;
                let range = value_range(part.connectivity(), &values)?;
                let origin = Part { vertices, triangles, whole: mesh.clone() };
                Ok(Self { mesh: part, values: Cow::Owned(values), range, part: Some(origin) })
            }
            Missing::Omit | Missing::Error => Ok(Self::new(mesh, values)?),
        }
    }

    /// The mesh, or the part of it that has values.
    #[must_use]
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// One value for each vertex of [`ScalarField::mesh`].
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Smallest and largest value at the vertices of triangles.
    #[must_use]
    pub fn range(&self) -> ValueRange {
        self.range
    }

    /// The vertices in the order of their values.
    #[must_use]
    pub fn order(&self) -> VertexOrder<'_> {
        VertexOrder::of_checked(&self.values)
    }

    /// Whether values are missing, so that [`ScalarField::mesh`] is a part of the mesh that the field was given on.
    #[must_use]
    pub fn is_partial(&self) -> bool {
        self.part.is_some()
    }

    /// The mesh that the field was given on.
    #[must_use]
    pub fn whole_mesh(&self) -> &TriMesh {
        self.part.as_ref().map_or(&self.mesh, |part| &part.whole)
    }

    /// Turns a result in the ids of [`ScalarField::mesh`] into one in those of the mesh that the field was given on.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub(super) fn on_whole<R: OnMesh>(&self, mut result: R) -> Result<R, OutOfMemory> {
        if let Some(part) = &self.part {
            result.tell_of_whole(part)?;
        }
        Ok(result)
    }

    /// Turns vertices of [`ScalarField::mesh`] into those of the mesh that the field was given on.
    pub(crate) fn to_whole(&self, vertices: &mut [u32]) {
        if let Some(part) = &self.part {
            part.vertices(vertices);
        }
    }

    /// Turns vertices of the mesh that the field was given on into those of [`ScalarField::mesh`].
    ///
    /// # Errors
    /// `IndexOutOfBounds` for what is no vertex; `MissingValue` for a vertex without a value, or without a triangle that has values.
    pub(crate) fn to_part(&self, vertices: &[u32]) -> Result<Vec<u32>, FieldError> {
        let count = self.whole_mesh().vertex_count();
        let find = |&vertex: &u32| {
            if vertex as usize >= count {
                return Err(FieldError::IndexOutOfBounds { index: vertex, vertices: count });
            }
            match &self.part {
                None => Ok(vertex),
                Some(part) => part
                    .vertices
                    .binary_search(&vertex)
                    .map(|place| place as u32)
                    .map_err(|_| FieldError::MissingValue { vertex }),
            }
        };
        let mut found = with_room(vertices.len())?;
        for vertex in vertices {
            found.push(find(vertex)?);
        }
        Ok(found)
    }
}
