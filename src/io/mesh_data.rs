//! What a mesh file holds, and in which format.

use core::str::FromStr;

use crate::error::{Diagnostic, ParseError};
use crate::support::named::named;

/// A file format for meshes. Its name is also the usual ending of its files.
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
    /// Legacy VTK `PolyData`.
    Vtk,
    /// VTK XML `PolyData`.
    Vtp,
    /// Binary glTF.
    Glb,
    /// ESRI ASCII grid.
    Asc,
}

named! { MeshFormat any case {
    Obj = "obj", Off = "off", Ply = "ply", Stl = "stl", Vtk = "vtk", Vtp = "vtp", Glb = "glb", Asc = "asc",
} }

impl MeshFormat {
    pub(super) fn unsupported(self) -> ParseError {
        ParseError::UnsupportedFormat { format: self.name().to_owned() }
    }
}

impl FromStr for MeshFormat {
    type Err = ParseError;

    fn from_str(name: &str) -> Result<Self, ParseError> {
        Self::from_name(name).ok_or_else(|| ParseError::UnsupportedFormat { format: name.to_owned() })
    }
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
