//! Bytes in, positions, triangles and named fields out, and back. Takes bytes, never paths.
//!
//! Numbers in text have double precision whatever type a header declares. Sizes that a header promises are checked against
//! the bytes that are there before memory is set aside. `nan` and `inf` are read as they are, and a number beyond double
//! precision is infinite: the mesh and its fields refuse them with their vertex, so that a field with gaps does not keep the rest of the file from loading.

mod assembly;
mod columns;
mod cursor;
mod formats;
mod mesh_data;
mod obj;
mod off;
mod ply;
mod scan;
mod table;
mod vtk;
mod write;

pub use columns::{Table, read_table};
pub use formats::{FormatInfo, formats};
pub use mesh_data::{MeshData, MeshFormat};
pub use table::{Column, FieldFormat, FieldReadOptions, read_field};
pub use write::{WriteOptions, write_mesh};

use crate::error::ParseError;
use scan::Scanner;

/// How to read a mesh.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The format; default: from the content, else from [`ReadOptions::file_name`].
    pub format: Option<MeshFormat>,
    /// A name whose ending tells the format when the content does not. Default none.
    pub file_name: Option<String>,
}

/// Reads a mesh file: OBJ, OFF, PLY or legacy VTK `PolyData`.
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
    if scan::without_byte_order_mark(bytes).trim_ascii().is_empty() {
        return Err(ParseError::EmptyFile {});
    }
    let format = options
        .format
        .or_else(|| sniff(bytes))
        .or_else(|| from_file_name(options.file_name.as_deref()?))
        .ok_or(ParseError::UnknownFormat {})?;
    match format {
        MeshFormat::Obj => obj::read(bytes),
        MeshFormat::Off => off::read(bytes),
        MeshFormat::Ply => ply::read(bytes),
        MeshFormat::Vtk => vtk::read(bytes),
        MeshFormat::Stl | MeshFormat::Vtp | MeshFormat::Glb | MeshFormat::Asc => Err(format.unsupported()),
    }
}

/// The format that the content shows.
fn sniff(bytes: &[u8]) -> Option<MeshFormat> {
    if bytes.starts_with(b"glTF") {
        return Some(MeshFormat::Glb);
    }
    let mut text = Scanner::new(bytes);
    text.next_row();
    let start = text.rest();
    let first = text.word_in_row()?;
    if first == b"ply" {
        return Some(MeshFormat::Ply);
    }
    if start.get(..vtk::MAGIC.len()).is_some_and(|start| start.eq_ignore_ascii_case(vtk::MAGIC)) {
        return Some(MeshFormat::Vtk);
    }
    if first.starts_with(b"<?xml") || first.starts_with(b"<VTKFile") {
        let head = &start[..start.len().min(1024)];
        return head.windows(8).any(|window| window == b"<VTKFile").then_some(MeshFormat::Vtp);
    }
    if first.eq_ignore_ascii_case(b"ncols") {
        return Some(MeshFormat::Asc);
    }
    if is_binary_stl(bytes) || first == b"solid" {
        return Some(MeshFormat::Stl);
    }
    // These two may start with comments.
    let mut text = Scanner::new(bytes).with_comments();
    let first = text.word()?;
    if off::keyword(first).is_some() {
        return Some(MeshFormat::Off);
    }
    obj::KEYWORDS.contains(&first).then_some(MeshFormat::Obj)
}

/// A header of 80 bytes, the number of triangles, and 50 bytes for each: nothing else marks these files.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..).and_then(|rest| rest.first_chunk()).map(|&raw| u64::from(u32::from_le_bytes(raw)));
    count.is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * count)
}

fn from_file_name(name: &str) -> Option<MeshFormat> {
    MeshFormat::from_name(name.rsplit_once('.')?.1)
}
