//! What a mesh file holds, and in which format.

use core::str::FromStr;

use crate::error::{Diagnostic, ParseError};
use crate::support::named::named;

/// A file format for meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// Object File Format.
    Off,
    /// Polygon file format.
    Ply,
    /// Stereolithography.
    Stl,
    /// VTK legacy data sets.
    Vtk,
    /// VTK XML surfaces.
    Vtp,
    /// VTK XML unstructured grids.
    Vtu,
    /// glTF.
    Glb,
    /// GMSH's own.
    Msh,
    /// GIFTI.
    Gii,
    /// Surfaces of FreeSurfer.
    FreeSurfer,
    /// ESRI ASCII grids.
    Asc,
}

named! { MeshFormat any case {
    Obj = "obj", Off = "off", Ply = "ply", Stl = "stl", Vtk = "vtk", Vtp = "vtp", Vtu = "vtu",
    Glb = "glb", Msh = "msh", Gii = "gii", FreeSurfer = "freesurfer", Asc = "asc",
} }

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
    /// Three vertex ids for every triangle; polygons are cut into triangles.
    pub triangles: Vec<u32>,
    /// Scalar fields by name, in the order of the file, one value per vertex.
    pub fields: Vec<(String, Vec<f64>)>,
    /// Scalar fields by name with one value per triangle; where a face became several triangles each has its value.
    pub triangle_fields: Vec<(String, Vec<f64>)>,
    /// For every vertex its number in the file; none where they are the same.
    pub vertex_map: Option<Vec<u32>>,
    /// The format read.
    pub format: MeshFormat,
    /// What was skipped or put right.
    pub warnings: Vec<Diagnostic>,
}
