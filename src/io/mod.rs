//! Bytes in, positions, triangles and named fields out, and back. Takes bytes, never paths.

use crate::error::{Diagnostic, ParseError};

/// A file format for meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// Object File Format.
    Off,
    /// Polygon file format, ASCII or binary.
    Ply,
    /// Stereolithography.
    Stl,
    /// Legacy VTK PolyData.
    Vtk,
    /// VTK XML PolyData.
    Vtp,
    /// Binary glTF.
    Glb,
    /// ESRI ASCII grid.
    Asc,
}

/// What a mesh file holds, before it is checked as a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshData {
    /// x, y, z of every vertex, one after the other.
    pub positions: Vec<f64>,
    /// Three vertex ids for every triangle; polygons are triangulated as a fan of their first corner.
    pub triangles: Vec<u32>,
    /// Scalar fields by name, in the order of the file, one value per vertex.
    pub fields: Vec<(String, Vec<f64>)>,
    /// The format read.
    pub format: MeshFormat,
    /// What was skipped or put right.
    pub warnings: Vec<Diagnostic>,
}

/// How to read a mesh.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The format; default: from the content, else from [`ReadOptions::file_name`].
    pub format: Option<MeshFormat>,
    /// A name whose ending tells the format when the content does not. Default none.
    pub file_name: Option<String>,
}

/// Reads a mesh file.
///
/// # Errors
/// [`ParseError`], see its variants.
pub fn read_mesh(_bytes: &[u8], _options: &ReadOptions) -> Result<MeshData, ParseError> {
    Err(ParseError::UnknownFormat {})
}
