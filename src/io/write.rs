//! Writers. Text has the shortest decimals that read back as the same doubles; binary files hold doubles.

use std::io::Write;

use super::assembly::{Names, check_count, check_length};
use super::mesh_data::MeshFormat;
use super::scan::{reserve, room};
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
    match format {
        MeshFormat::Ply | MeshFormat::Vtk => {}
        MeshFormat::Obj | MeshFormat::Off => {
            if options.binary {
                return Err(ParseError::BinaryNotSupported { format: name() });
            }
            if !fields.is_empty() {
                return Err(ParseError::FieldsNotSupported { format: name() });
            }
        }
        MeshFormat::Stl | MeshFormat::Vtp | MeshFormat::Glb | MeshFormat::Asc => return Err(format.unsupported()),
    }
    check(positions, triangles, fields, options.missing)?;
    let mesh = Mesh { positions, triangles, fields };
    let mut out = Vec::new();
    if options.binary {
        reserve(&mut out, mesh.binary_size())?;
    }
    match format {
        MeshFormat::Obj => write_obj(&mut out, &mesh)?,
        MeshFormat::Off => write_off(&mut out, &mesh)?,
        MeshFormat::Ply => write_ply(&mut out, &mesh, options.binary)?,
        _ => write_vtk(&mut out, &mesh, options.binary)?,
    }
    Ok(out)
}

/// Room for a header, names apart.
const HEADER: usize = 512;

/// The longest text of a number, with the blank before it: 24 letters for `-2.2250738585072014e-308` and `-0.00001…`.
const LONGEST_NUMBER: usize = 32;

/// The longest row of a face: three ids of ten digits.
const LONGEST_FACE: usize = 48;

struct Mesh<'a> {
    positions: &'a [f64],
    triangles: &'a [u32],
    fields: &'a [(&'a str, &'a [f64])],
}

impl Mesh<'_> {
    fn vertex_count(&self) -> usize {
        self.positions.len() / 3
    }

    fn triangle_count(&self) -> usize {
        self.triangles.len() / 3
    }

    /// Bytes of a binary file, up to its header.
    fn binary_size(&self) -> usize {
        let numbers =
            self.fields.iter().fold(self.positions.len(), |sum, (_, values)| sum.saturating_add(values.len()));
        // Up to four bytes say how many corners a triangle has.
        numbers.saturating_mul(8).saturating_add(self.triangle_count().saturating_mul(16)).saturating_add(HEADER)
    }
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

fn write_obj(out: &mut Vec<u8>, mesh: &Mesh<'_>) -> Result<(), ParseError> {
    for point in mesh.positions.chunks_exact(3) {
        room(out, 2)?;
        out.extend_from_slice(b"v ");
        push_row(out, point)?;
    }
    for corners in mesh.triangles.chunks_exact(3) {
        room(out, LONGEST_FACE)?;
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(|corner| u64::from(corner) + 1);
        print(out, format_args!("f {a} {b} {c}\n"));
    }
    Ok(())
}

fn write_off(out: &mut Vec<u8>, mesh: &Mesh<'_>) -> Result<(), ParseError> {
    room(out, HEADER)?;
    print(out, format_args!("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.triangle_count()));
    for point in mesh.positions.chunks_exact(3) {
        push_row(out, point)?;
    }
    push_faces(out, mesh.triangles)
}

fn write_ply(out: &mut Vec<u8>, mesh: &Mesh<'_>, binary: bool) -> Result<(), ParseError> {
    room(out, HEADER)?;
    let encoding = if binary { "binary_little_endian" } else { "ascii" };
    print(out, format_args!("ply\nformat {encoding} 1.0\nelement vertex {}\n", mesh.vertex_count()));
    let mut names = Names::default();
    for axis in ["x", "y", "z"] {
        names.unique(axis);
        print(out, format_args!("property double {axis}\n"));
    }
    for (name, _) in mesh.fields {
        // Letters that cannot stand here become shorter ones, and a number may follow.
        room(out, HEADER + name.len())?;
        let clean: String = name
            .chars()
            .map(|letter| if letter.is_whitespace() || letter.is_control() { '_' } else { letter })
            .collect();
        print(out, format_args!("property double {}\n", names.unique(named(&clean))));
    }
    room(out, HEADER)?;
    // Nearly all writers use `int` and some readers know nothing else.
    let id_type = if i32::try_from(mesh.vertex_count()).is_ok() { "int" } else { "uint" };
    print(out, format_args!("element face {}\n", mesh.triangle_count()));
    print(out, format_args!("property list uchar {id_type} vertex_indices\nend_header\n"));
    let mut row = Vec::with_capacity(3 + mesh.fields.len());
    for (vertex, point) in mesh.positions.chunks_exact(3).enumerate() {
        row.clear();
        row.extend_from_slice(point);
        row.extend(mesh.fields.iter().map(|(_, values)| values[vertex]));
        if binary {
            room(out, 8 * row.len())?;
            out.extend(row.iter().flat_map(|value| value.to_le_bytes()));
        } else {
            push_row(out, &row)?;
        }
    }
    if !binary {
        return push_faces(out, mesh.triangles);
    }
    room(out, 13 * mesh.triangle_count())?;
    for corners in mesh.triangles.chunks_exact(3) {
        out.push(3);
        out.extend(corners.iter().flat_map(|corner| corner.to_le_bytes()));
    }
    Ok(())
}

fn write_vtk(out: &mut Vec<u8>, mesh: &Mesh<'_>, binary: bool) -> Result<(), ParseError> {
    // The format's ids are signed.
    if i32::try_from(mesh.vertex_count()).is_err() {
        return Err(ParseError::TooLarge { element: "vertices".to_owned(), count: mesh.vertex_count() as u64 });
    }
    room(out, HEADER)?;
    let encoding = if binary { "BINARY" } else { "ASCII" };
    // Version 3 is understood by every reader; 5 changed how cells are stored.
    print(out, format_args!("# vtk DataFile Version 3.0\nmorse-smooth\n{encoding}\nDATASET POLYDATA\n"));
    print(out, format_args!("POINTS {} double\n", mesh.vertex_count()));
    push_block(out, mesh.positions, 3, binary)?;
    room(out, HEADER)?;
    let count = mesh.triangle_count();
    print(out, format_args!("POLYGONS {count} {}\n", count as u64 * 4));
    if binary {
        room(out, 16 * count + 1)?;
        for corners in mesh.triangles.chunks_exact(3) {
            out.extend_from_slice(&3_u32.to_be_bytes());
            out.extend(corners.iter().flat_map(|corner| corner.to_be_bytes()));
        }
        out.push(b'\n');
    } else {
        push_faces(out, mesh.triangles)?;
    }
    room(out, HEADER)?;
    if !mesh.fields.is_empty() {
        print(out, format_args!("POINT_DATA {}\n", mesh.vertex_count()));
    }
    let mut names = Names::default();
    for (name, values) in mesh.fields {
        let name = encode_name(&names.unique(named(name)));
        room(out, HEADER + name.len())?;
        print(out, format_args!("SCALARS {name} double 1\nLOOKUP_TABLE default\n"));
        push_block(out, values, 1, binary)?;
    }
    Ok(())
}

fn named(name: &str) -> &str {
    if name.is_empty() { "field" } else { name }
}

/// Writes what cannot stand in a VTK name as `%20` and the like.
fn encode_name(name: &str) -> String {
    let mut encoded = String::with_capacity(name.len());
    for byte in name.bytes() {
        if matches!(byte, b'!'..=b'~') && !matches!(byte, b'%' | b'"') {
            encoded.push(char::from(byte));
        } else {
            encoded.push_str(&format!("%{byte:02X}"));
        }
    }
    encoded
}

fn push_block(out: &mut Vec<u8>, values: &[f64], columns: usize, binary: bool) -> Result<(), ParseError> {
    if binary {
        room(out, 8 * values.len() + 1)?;
        out.extend(values.iter().flat_map(|value| value.to_be_bytes()));
        out.push(b'\n');
    } else {
        for row in values.chunks_exact(columns) {
            push_row(out, row)?;
        }
    }
    Ok(())
}

fn push_faces(out: &mut Vec<u8>, triangles: &[u32]) -> Result<(), ParseError> {
    for corners in triangles.chunks_exact(3) {
        room(out, LONGEST_FACE)?;
        print(out, format_args!("3 {} {} {}\n", corners[0], corners[1], corners[2]));
    }
    Ok(())
}

fn push_row(out: &mut Vec<u8>, row: &[f64]) -> Result<(), ParseError> {
    room(out, LONGEST_NUMBER * row.len() + 1)?;
    for (place, value) in row.iter().enumerate() {
        if place > 0 {
            out.push(b' ');
        }
        // Without an exponent 1e300 would take 301 digits.
        let size = value.abs();
        if size == 0.0 || (1e-5..1e16).contains(&size) {
            print(out, format_args!("{value}"));
        } else {
            print(out, format_args!("{value:e}"));
        }
    }
    out.push(b'\n');
    Ok(())
}

/// Writing to memory cannot fail; the caller has made room.
fn print(out: &mut Vec<u8>, text: core::fmt::Arguments<'_>) {
    let _ = out.write_fmt(text);
}
