//! The formats that can be read or written, as users are told of them.

/// What there is of a format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormatInfo {
    /// Its name, as options take it.
    pub name: &'static str,
    /// The usual endings of its files, without a dot.
    pub extensions: &'static [&'static str],
    /// Whether it can be read.
    pub reads: bool,
    /// Whether it can be written.
    pub writes: bool,
    /// One line for people.
    pub description: &'static str,
}

/// All formats: those of meshes, then those of fields and tables.
#[must_use]
pub fn formats() -> &'static [FormatInfo] {
    const MESH: FormatInfo = FormatInfo { name: "", extensions: &[], reads: true, writes: true, description: "" };
    const TABLE: FormatInfo = FormatInfo { writes: false, ..MESH };
    &[
        FormatInfo { name: "obj", extensions: &["obj"], description: "Wavefront OBJ, text", ..MESH },
        FormatInfo { name: "off", extensions: &["off"], description: "Object File Format, text", ..MESH },
        FormatInfo {
            name: "ply",
            extensions: &["ply"],
            description: "Polygon file format, text or binary, with fields",
            ..MESH
        },
        FormatInfo {
            name: "vtk",
            extensions: &["vtk"],
            description: "VTK legacy PolyData, text or binary, with fields",
            ..MESH
        },
        FormatInfo {
            name: "csv",
            extensions: &["csv"],
            description: "Columns with commas, semicolons or tabs between them",
            ..TABLE
        },
        FormatInfo { name: "txt", extensions: &["txt"], description: "Numbers with blanks between them", ..TABLE },
    ]
}
