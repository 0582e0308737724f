//! Bytes in, positions, triangles and named fields out, and back. Takes bytes, never paths.
//!
//! Numbers in text have double precision whatever type a header declares. Sizes that a header promises are checked against
//! the bytes that are there before memory is set aside. `nan` and `inf` are read as they are, and a number beyond double
//! precision is infinite: the mesh and its fields refuse them with their vertex, so that a field with gaps does not keep the rest of the file from loading.

mod arrays;
mod assembly;
mod average;
mod cells;
mod cursor;
mod esri;
mod format;
mod formats;
mod freesurfer;
mod gifti;
mod gltf;
mod gmsh;
mod json;
mod mesh_data;
mod names;
mod npy;
mod number;
mod obj;
mod off;
mod packed;
mod ply;
mod polygon;
mod recognise;
mod scan;
mod stl;
mod table;
mod vtk;
mod vtkxml;
mod write;
mod writing;
mod xml;

pub use average::average_on_vertices;
pub use format::FormatInfo;
pub use formats::formats;
pub use mesh_data::{MeshData, MeshFormat};
pub use table::{Column, ExpectedRows, FieldFormat, FieldReadOptions, Table, read_field, read_table};
pub use write::{WriteOptions, write_mesh};

use crate::error::ParseError;

/// How to read a mesh.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The format; default: from the content, else from [`ReadOptions::file_name`].
    pub format: Option<MeshFormat>,
    /// A name whose ending tells the format when the content does not. Default none.
    pub file_name: Option<String>,
}

/// Reads a mesh file of any of the [`formats`].
///
/// Vertices keep their order, also those that no face names. Fields are the scalar vertex properties of PLY files and the
/// point data of VTK files; an array `v` of several components makes the fields `v_0`, `v_1`, … A name that stands twice
/// gets a number.
///
/// Warnings: `SkippedFace` (fewer than three corners), `PolygonTriangulated` (more than three), `SkippedData` (content
/// without a place in [`MeshData`], such as colors or lines), `RenamedField`.
///
/// # Errors
/// [`ParseError`], see its variants.
///
/// # Example
/// ```
/// use morse_smooth::io::{MeshFormat, ReadOptions, read_mesh};
///
/// let data = read_mesh(b"OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", &ReadOptions::default())?;
/// assert_eq!(data.format, MeshFormat::Off);
/// assert_eq!(data.triangles, [0, 1, 2]);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn read_mesh(bytes: &[u8], options: &ReadOptions) -> Result<MeshData, ParseError> {
    let bytes = &*packed::unpack(bytes)?;
    if scan::without_byte_order_mark(bytes).trim_ascii().is_empty() {
        return Err(ParseError::EmptyFile {});
    }
    let by_name = || formats::of_file_name(options.file_name.as_deref()?);
    let format = options.format.or_else(|| formats::sniff(bytes)).or_else(by_name);
    let format = format.ok_or_else(|| recognise::unknown_format(bytes))?;
    (format.format().read)(bytes)
}
