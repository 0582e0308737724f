//! Polygon file format: a text header declares elements and their properties, the body is text or binary of either
//! byte order.

mod header;
mod rows;
mod write;

use super::assembly::{Assembly, check_count};
use super::cursor::Cursor;
use super::format::{Format, Writer};
use super::mesh_data::{MeshData, MeshFormat};
use super::scan::{Scanner, require, reserve};
use crate::error::ParseError;
use header::{Element, Encoding, Kind, read_header};
use rows::{BinaryRows, Rows, TextRows};

pub(super) const FORMAT: Format = Format {
    name: "ply",
    extensions: &["ply"],
    description: "Polygon file format, text or binary, with fields",
    sniff: |bytes| Scanner::new(bytes).word() == Some(b"ply"),
    read,
    write: Some(Writer { text: true, binary: true, fields: true, write: write::write }),
};

/// Reads a PLY file. Every scalar property of the vertices but x, y and z becomes a field; numbers in text have double
/// precision, whatever type the header declares.
fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes);
    let (encoding, elements) = read_header(&mut text)?;
    let Some(vertices) = elements.iter().find(|element| element.name == "vertex").map(|element| element.count) else {
        return Err(ParseError::MissingElement { element: "vertices".to_owned() });
    };
    check_count("vertices", vertices)?;
    let mut assembly = Assembly::default();
    let left = match encoding {
        Encoding::Text => {
            text.rest_of_line();
            let mut rows = TextRows(text);
            read_body(&mut rows, &elements, encoding, vertices, &mut assembly)?;
            if rows.0.next_row() { rows.0.rest().len() } else { 0 }
        }
        Encoding::LittleEndian | Encoding::BigEndian => {
            text.start_of_binary();
            let data = Cursor::new(text.rest(), encoding == Encoding::BigEndian);
            let mut rows = BinaryRows { data, line: text.line() };
            read_body(&mut rows, &elements, encoding, vertices, &mut assembly)?;
            rows.data.available()
        }
    };
    if left > 0 {
        assembly.skipped(format!("{left} bytes after the last element"), left as u64);
    }
    assembly.finish(MeshFormat::Ply)
}

fn read_body(
    rows: &mut impl Rows,
    elements: &[Element],
    encoding: Encoding,
    vertices: u64,
    assembly: &mut Assembly,
) -> Result<(), ParseError> {
    for element in elements {
        require(element.smallest_size(encoding), rows.available())?;
        match element.name.as_str() {
            "vertex" => read_vertices(rows, element, assembly)?,
            "face" => read_faces(rows, element, vertices, assembly)?,
            "tristrips" => read_strips(rows, element, vertices, assembly)?,
            name => {
                skip_rows(rows, element)?;
                assembly.skipped(format!("{} elements `{name}`", element.count), element.count);
            }
        }
    }
    Ok(())
}

/// What becomes of a vertex property.
enum Role {
    Axis(usize),
    Field(Vec<f64>),
    Skipped,
}

fn read_vertices(rows: &mut impl Rows, element: &Element, assembly: &mut Assembly) -> Result<(), ParseError> {
    // The caller has checked that every row has its bytes.
    let count = element.count as usize;
    let mut axes = [false; 3];
    let mut roles = Vec::new();
    for property in &element.properties {
        let axis = ["x", "y", "z"].iter().position(|&axis| axis == property.name);
        roles.push(match (property.kind, axis) {
            (Kind::List { .. }, _) => {
                assembly.skipped(format!("list property `{}` of the vertices", property.name), element.count);
                Role::Skipped
            }
            (Kind::Scalar(_), Some(axis)) if !axes[axis] => {
                axes[axis] = true;
                Role::Axis(axis)
            }
            (Kind::Scalar(_), _) => {
                let mut values = Vec::new();
                reserve(&mut values, count)?;
                Role::Field(values)
            }
        });
    }
    if let Some(axis) = axes.iter().position(|&found| !found) {
        let element = format!("vertex property `{}`", ["x", "y", "z"][axis]);
        return Err(ParseError::MissingElement { element });
    }
    reserve(&mut assembly.positions, count * 3)?;
    for _ in 0..count {
        rows.begin(&element.name)?;
        let mut point = [0.0; 3];
        for (property, role) in element.properties.iter().zip(&mut roles) {
            match (property.kind, role) {
                (Kind::Scalar(kind), Role::Axis(axis)) => point[*axis] = rows.number(kind)?,
                (Kind::Scalar(kind), Role::Field(values)) => values.push(rows.number(kind)?),
                (kind, _) => skip_property(rows, kind)?,
            }
        }
        end(rows)?;
        assembly.positions.extend(point);
    }
    for (property, role) in element.properties.iter().zip(roles) {
        if let Role::Field(values) = role {
            assembly.field(&property.title, values);
        }
    }
    Ok(())
}

fn read_faces(
    rows: &mut impl Rows,
    element: &Element,
    vertices: u64,
    assembly: &mut Assembly,
) -> Result<(), ParseError> {
    let corners = element.properties.iter().position(|property| {
        matches!(property.kind, Kind::List { .. })
            && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
    });
    let Some(corners) = corners else {
        return Err(ParseError::MissingElement { element: "face property `vertex_indices`".to_owned() });
    };
    assembly.reserve_triangles(element.count)?;
    let mut fields: Vec<Vec<f64>> = Vec::new();
    for property in &element.properties {
        let mut values = Vec::new();
        if matches!(property.kind, Kind::Scalar(_)) {
            reserve(&mut values, element.count as usize)?;
        }
        fields.push(values);
    }
    let mut too_long = 0;
    for _ in 0..element.count {
        rows.begin(&element.name)?;
        for ((place, property), values) in element.properties.iter().enumerate().zip(&mut fields) {
            match property.kind {
                Kind::List { count, item } if place == corners => {
                    for _ in 0..rows.count(count)? {
                        let corner = rows.integer(item)?;
                        assembly.corner(corner, vertices)?;
                    }
                }
                Kind::Scalar(kind) => values.push(rows.number(kind)?),
                kind => skip_property(rows, kind)?,
            }
        }
        // MeshLab has written colors here that no property declares.
        if rows.end() {
            too_long += 1;
            rows.pass();
        }
        assembly.close_polygon()?;
    }
    for ((place, property), values) in element.properties.iter().enumerate().zip(fields) {
        match property.kind {
            Kind::Scalar(_) => assembly.face_field(&property.title, values),
            _ if place != corners => {
                assembly.skipped(format!("property `{}` of the faces", property.name), element.count);
            }
            _ => {}
        }
    }
    if too_long > 0 {
        assembly.skipped(format!("numbers of {too_long} faces that the header does not declare"), too_long);
    }
    Ok(())
}

/// Strips stand in one list or several, with -1 between those of one list.
fn read_strips(
    rows: &mut impl Rows,
    element: &Element,
    vertices: u64,
    assembly: &mut Assembly,
) -> Result<(), ParseError> {
    for _ in 0..element.count {
        rows.begin(&element.name)?;
        let mut has_strips = false;
        for property in &element.properties {
            match property.kind {
                Kind::List { count, item } if !has_strips => {
                    has_strips = true;
                    for _ in 0..rows.count(count)? {
                        match rows.integer(item)? {
                            -1 => assembly.close_strip()?,
                            corner => assembly.corner(corner, vertices)?,
                        }
                    }
                    assembly.close_open_strip()?;
                }
                kind => skip_property(rows, kind)?,
            }
        }
        end(rows)?;
    }
    Ok(())
}

/// Ends a row that has as many numbers as the header declares.
fn end(rows: &mut impl Rows) -> Result<(), ParseError> {
    if rows.end() { Err(rows.too_long()) } else { Ok(()) }
}

fn skip_rows(rows: &mut impl Rows, element: &Element) -> Result<(), ParseError> {
    // Rows without properties take no bytes, however many the header promises.
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        rows.begin(&element.name)?;
        for property in &element.properties {
            skip_property(rows, property.kind)?;
        }
        end(rows)?;
    }
    Ok(())
}

fn skip_property(rows: &mut impl Rows, kind: Kind) -> Result<(), ParseError> {
    match kind {
        Kind::Scalar(kind) => rows.skip(kind, 1),
        Kind::List { count, item } => {
            let count = rows.count(count)?;
            rows.skip(item, count)
        }
    }
}
