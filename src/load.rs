//! From the bytes of a file to a checked mesh with its fields.

use crate::error::{Diagnostic, Result};
use crate::io::{self, MeshFormat, ReadOptions};
use crate::mesh::{TriMesh, WeldOptions, weld};
use crate::support::memory;
use crate::support::named::named;

/// How to load a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LoadOptions {
    /// How to read the file. Default: the format comes from the content.
    pub read: ReadOptions,
    /// Whether vertices that lie together are joined, and up to which distance. Default: they are not.
    pub weld: Option<WeldOptions>,
    /// What becomes of fields on triangles. Default: they stay there.
    pub triangle_fields: TriangleFields,
}

/// What becomes of fields with one value per triangle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum TriangleFields {
    /// They are fields on triangles.
    #[default]
    Keep,
    /// They are also fields on vertices: the mean of the triangles around, weighted by their areas.
    Average,
}

named! { TriangleFields { Keep = "keep", Average = "average" } }

/// What a file holds, as plain arrays: vertices are joined, but nothing has been checked as a mesh.
#[derive(Debug, Clone)]
pub struct LoadedArrays {
    /// x, y, z of every vertex, one after the other.
    pub positions: Vec<f64>,
    /// Three vertices for every triangle.
    pub triangles: Vec<u32>,
    /// As in [`LoadedMesh::fields`].
    pub fields: Vec<(String, Vec<f64>)>,
    /// Scalar fields by name, one value per triangle.
    pub triangle_fields: Vec<(String, Vec<f64>)>,
    /// The format read.
    pub format: MeshFormat,
    /// As in [`LoadedMesh::vertex_map`].
    pub vertex_map: Option<Vec<u32>>,
    /// For every vertex its number in the file, or the first one of those that were joined; none where they are the same.
    pub file_vertices: Option<Vec<u32>>,
    /// What was skipped or put right in the file.
    pub warnings: Vec<Diagnostic>,
}

/// A mesh read from a file.
#[derive(Debug, Clone)]
pub struct LoadedMesh {
    /// The mesh.
    pub mesh: TriMesh,
    /// Scalar fields by name, one value per vertex of the mesh. They are as the file has them: NaN and infinity leave a
    /// warning and are refused where the field is used, so that one bad field does not hide the others.
    pub fields: Vec<(String, Vec<f64>)>,
    /// The format read.
    pub format: MeshFormat,
    /// For every vertex that the file has, or those of them that are not left out, the vertex of the mesh that it became by welding; none
    /// where they are the same.
    pub vertex_map: Option<Vec<u32>>,
    /// What was skipped or put right, from the file and from the mesh.
    pub warnings: Vec<Diagnostic>,
}

/// Reads a mesh file, joins vertices where that is asked for, and checks the mesh.
///
/// Fields are carried along as [`Welded::field`](crate::mesh::Welded::field) says. Warnings, besides those of [`io::read_mesh`] and
/// [`TriMesh::new`]: `WeldedValues` where joined vertices had different values, `NonFiniteValue`.
///
/// # Errors
/// Those of [`io::read_mesh`], [`weld`] and [`TriMesh::new`].
///
/// # Example
/// ```
/// use morse_smooth::load::{LoadOptions, load};
/// let file = b"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
/// let loaded = load(file, &LoadOptions::default())?;
/// assert_eq!((loaded.mesh.area(), loaded.format.name()), (1.0, "off"));
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn load(bytes: &[u8], options: &LoadOptions) -> Result<LoadedMesh> {
    let LoadedArrays { positions, triangles, fields, format, vertex_map, mut warnings, .. } =
        load_arrays(bytes, options)?;
    let mesh = TriMesh::new(positions, triangles)?;
    warnings.extend_from_slice(mesh.warnings());
    Ok(LoadedMesh { mesh, fields, format, vertex_map, warnings })
}

/// Reads a mesh file and joins vertices where that is asked for, as [`load`] does, but leaves the mesh to be made of it: by
/// [`TriMesh::new`], which checks positions and triangles.
///
/// # Errors
/// Those of [`io::read_mesh`] and [`weld`].
pub fn load_arrays(bytes: &[u8], options: &LoadOptions) -> Result<LoadedArrays> {
    let data = io::read_mesh(bytes, &options.read)?;
    let mut warnings = data.warnings;
    let mut fields = data.fields;
    let triangle_fields = data.triangle_fields;
    if options.triangle_fields == TriangleFields::Average && !triangle_fields.is_empty() {
        let averaged = io::average_on_vertices(&data.positions, &data.triangles, &triangle_fields, &mut fields)?;
        warnings.push(averaged);
    }
    let (mut positions, mut triangles, mut vertex_map) = (data.positions, data.triangles, None);
    let mut file_vertices = data.vertex_map;
    if let Some(options) = &options.weld {
        let welded = weld(&positions, Some(&triangles), options)?;
        if welded.joins_any() {
            for (name, values) in &mut fields {
                let one_each = welded.field(values)?;
                *values = one_each.values;
                let mut disagreeing = one_each.disagreeing.into_iter();
                Diagnostic::report(&mut warnings, "WeldedValues", &mut disagreeing, &|count| {
                    format!("{count} welded vertices had several values of `{name}`; their mean was taken")
                });
            }
            (positions, triangles) = (welded.positions, welded.triangles);
            file_vertices = Some(first_of_each(&welded.map, positions.len() / 3, file_vertices.as_deref())?);
            vertex_map = Some(welded.map);
        }
    }
    for (name, values) in &fields {
        Diagnostic::report_not_finite(&mut warnings, name, values);
    }
    let format = data.format;
    Ok(LoadedArrays { positions, triangles, fields, triangle_fields, format, vertex_map, file_vertices, warnings })
}

/// For each of `count` vertices the first that became it, by its number in the file.
fn first_of_each(map: &[u32], count: usize, file_vertices: Option<&[u32]>) -> Result<Vec<u32>> {
    memory::ensure(4 * count as u64)?;
    let mut first = memory::with_room(count)?;
    for (vertex, &new) in map.iter().enumerate() {
        if new as usize == first.len() {
            first.push(file_vertices.map_or(vertex as u32, |numbers| numbers[vertex]));
        }
    }
    Ok(first)
}
