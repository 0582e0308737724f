//! From the bytes of a file to a checked mesh with its fields.

use super::{TriMesh, validate, weld};
use crate::error::{Diagnostic, Result};
use crate::io::{self, MeshFormat, ReadOptions};

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
    /// What was skipped or put right, from the file and from the mesh.
    pub warnings: Vec<Diagnostic>,
}

/// Reads a mesh file; `welded` joins vertices at identical positions, each with the first of their values.
///
/// # Errors
/// As [`io::read_mesh`], [`weld`](super::weld()) and [`TriMesh::new`].
///
/// # Example
/// ```
/// use morse_smooth::{io::ReadOptions, mesh};
/// let file = b"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
/// let loaded = mesh::load(file, &ReadOptions::default(), false)?;
/// assert_eq!((loaded.mesh.area(), loaded.format.name()), (1.0, "off"));
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn load(bytes: &[u8], options: &ReadOptions, welded: bool) -> Result<LoadedMesh> {
    let data = io::read_mesh(bytes, options)?;
    let mut warnings = data.warnings;
    let mut fields = data.fields;
    let mesh = if welded {
        let joined = weld(&data.positions, &data.triangles)?;
        for (name, values) in &mut fields {
            let (one_each, disagreeing) = joined.field(values);
            *values = one_each;
            validate::report(&mut warnings, "WeldedValues", &disagreeing, &|count| {
                format!("{count} welded vertices had several values of `{name}`; the first was kept")
            });
        }
        TriMesh::new(joined.positions, joined.triangles)?
    } else {
        TriMesh::new(data.positions, data.triangles)?
    };
    for (name, values) in &fields {
        let not_finite: Vec<u32> =
            (0..values.len() as u32).filter(|&vertex| !values[vertex as usize].is_finite()).collect();
        validate::report(&mut warnings, "NonFiniteValue", &not_finite, &|count| {
            format!("{count} values of `{name}` are not finite; using the field will fail")
        });
    }
    warnings.extend_from_slice(mesh.warnings());
    Ok(LoadedMesh { mesh, fields, format: data.format, warnings })
}
