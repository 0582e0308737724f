//! Writes a mesh in the format that is asked for.

use super::assembly::{check_count, check_length};
use super::mesh_data::MeshFormat;
use super::scan::reserve;
use super::writing::Mesh;
use crate::error::ParseError;

/// How to write a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WriteOptions {
    /// The format. Default PLY.
    pub format: MeshFormat,
    /// Whether the numbers are binary: little endian in PLY, big endian in VTK. Default false.
    pub binary: bool,
    /// Whether values of fields may be missing: NaN, written as `NaN`. Default false, and then NaN is an error.
    pub missing: bool,
}

impl Default for WriteOptions {
    fn default() -> Self {
        Self { format: MeshFormat::Ply, binary: false, missing: false }
    }
}

/// Writes a mesh, and in PLY and VTK files its fields.
///
/// PLY has no blanks in names, so they become `_`; VTK writes them as `%20`. An empty name becomes `field`, and a name that
/// is there already (in PLY also `x`, `y`, `z`) gets a number.
///
/// # Errors
/// [`ParseError::UnsupportedFormat`], [`ParseError::FieldsNotSupported`] and [`ParseError::BinaryNotSupported`] for OBJ
/// and OFF, [`ParseError::LengthMismatch`], [`ParseError::FaceIndexOutOfBounds`], [`ParseError::NonFinitePosition`],
/// [`ParseError::NonFiniteValue`], [`ParseError::TooLarge`], [`ParseError::OutOfMemory`].
///
/// # Example
/// ```
/// use morse_smooth::io::{MeshFormat, ReadOptions, WriteOptions, read_mesh, write_mesh};
///
/// let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// let options = WriteOptions { format: MeshFormat::Vtk, binary: true, ..WriteOptions::default() };
/// let bytes = write_mesh(&positions, &[0, 1, 2], &[("height", &[0.1, 0.2, 0.3])], &options)?;
/// let data = read_mesh(&bytes, &ReadOptions::default())?;
/// assert_eq!(data.fields, [("height".to_owned(), vec![0.1, 0.2, 0.3])]);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn write_mesh(
    positions: &[f64],
    triangles: &[u32],
    fields: &[(&str, &[f64])],
    options: &WriteOptions,
) -> Result<Vec<u8>, ParseError> {
    let format = options.format;
    let name = || format.name().to_owned();
    let Some(writer) = format.format().write else {
        return Err(ParseError::UnsupportedFormat { format: name() });
    };
    if options.binary && !writer.binary {
        return Err(ParseError::BinaryNotSupported { format: name() });
    }
    if !fields.is_empty() && !writer.fields {
        return Err(ParseError::FieldsNotSupported { format: name() });
    }
    check(positions, triangles, fields, options.missing)?;
    let mesh = Mesh { positions, triangles, fields };
    let binary = options.binary || !writer.text;
    let mut out = Vec::new();
    if binary {
        reserve(&mut out, mesh.binary_size())?;
    }
    (writer.write)(&mut out, &mesh, binary)?;
    Ok(out)
}

fn check(positions: &[f64], triangles: &[u32], fields: &[(&str, &[f64])], missing: bool) -> Result<(), ParseError> {
    for (name, length) in [("positions", positions.len()), ("triangles", triangles.len())] {
        check_length(name, length as u64 / 3 * 3, length as u64)?;
    }
    let vertices = positions.len() as u64 / 3;
    check_count("vertices", vertices)?;
    check_count("triangles", triangles.len() as u64 / 3)?;
    if let Some(place) = positions.iter().position(|value| !value.is_finite()) {
        // There are no more vertices than 32-bit ids.
        return Err(ParseError::NonFinitePosition { vertex: (place / 3) as u32 });
    }
    if let Some(place) = triangles.iter().position(|&corner| u64::from(corner) >= vertices) {
        let (face, index) = (place as u64 / 3, i64::from(triangles[place]));
        return Err(ParseError::FaceIndexOutOfBounds { face, index, vertices });
    }
    for &(name, values) in fields {
        check_length(name, vertices, values.len() as u64)?;
        let is_written = |value: &f64| value.is_finite() || (missing && value.is_nan());
        if let Some(vertex) = values.iter().position(|value| !is_written(value)) {
            return Err(ParseError::NonFiniteValue { field: name.to_owned(), vertex: vertex as u32 });
        }
    }
    Ok(())
}
