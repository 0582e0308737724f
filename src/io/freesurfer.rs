//! Surfaces of FreeSurfer, binary (big endian) or text, and its values per vertex.

use super::assembly::{Assembly, check_count};
use super::cursor::{Cursor, NumberType};
use super::format::Format;
use super::mesh_data::{MeshData, MeshFormat};
use super::packed::damaged;
use super::scan::{Scanner, require, reserve};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "freesurfer",
    extensions: &["freesurfer", "white", "pial", "inflated", "sphere", "orig", "smoothwm", "reg", "surf"],
    description: "Surfaces of FreeSurfer, binary or text",
    sniff: |bytes| bytes.starts_with(TRIANGLES) || bytes.starts_with(TEXT),
    read,
    write: None,
};

/// How files begin: surfaces of triangles, the same as text, values per vertex.
const TRIANGLES: &[u8] = b"\xff\xff\xfe";
const TEXT: &[u8] = b"#!ascii";
pub(super) const VALUES: &[u8] = b"\xff\xff\xff";

fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    if bytes.starts_with(TRIANGLES) { read_binary(bytes) } else { read_text(bytes) }
}

fn read_binary(bytes: &[u8]) -> Result<MeshData, ParseError> {
    // Who made the file when, up to two line ends.
    let end = bytes.windows(2).position(|pair| pair == b"\n\n");
    let mut data = Cursor::new(&bytes[end.ok_or_else(|| damaged("the first lines have no end"))? + 2..], true);
    let vertices = count(&mut data)?;
    let faces = count(&mut data)?;
    require(12 * vertices + 12 * faces, data.available())?;
    let mut assembly = Assembly::default();
    reserve(&mut assembly.positions, 3 * vertices as usize)?;
    for _ in 0..3 * vertices {
        assembly.positions.push(data.number(NumberType::F32)?);
    }
    assembly.reserve_triangles(faces)?;
    for _ in 0..faces {
        for _ in 0..3 {
            let corner = data.integer(NumberType::I32)?;
            assembly.corner(corner, vertices)?;
        }
        assembly.close_polygon()?;
    }
    assembly.finish(MeshFormat::FreeSurfer)
}

fn count(data: &mut Cursor<'_>) -> Result<u64, ParseError> {
    let count = data.integer(NumberType::I32)?;
    u64::try_from(count).map_err(|_| damaged("a number of vertices or faces is negative"))
}

/// Every row ends in a number that says whether the vertex or face was taken away.
fn read_text(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes).with_comments();
    text.next_row();
    let vertices = text.count_in_row("the number of vertices")?;
    let faces = text.count_in_row("the number of faces")?;
    check_count("vertices", vertices)?;
    check_count("faces", faces)?;
    text.require_numbers(4 * (vertices + faces))?;
    let mut assembly = Assembly::default();
    reserve(&mut assembly.positions, 3 * vertices as usize)?;
    for _ in 0..vertices {
        for _ in 0..3 {
            assembly.positions.push(text.number("a coordinate")?);
        }
        text.rest_of_line();
    }
    assembly.reserve_triangles(faces)?;
    for _ in 0..faces {
        for _ in 0..3 {
            let corner = text.integer("a corner")?;
            assembly.corner(corner, vertices)?;
        }
        assembly.close_polygon()?;
        text.rest_of_line();
    }
    assembly.finish(MeshFormat::FreeSurfer)
}

/// Reads the values of a file such as `lh.curv`.
pub(super) fn read_values(bytes: &[u8]) -> Result<Vec<f64>, ParseError> {
    let rest = bytes.strip_prefix(VALUES).ok_or_else(|| damaged("this is no file of values of FreeSurfer"))?;
    let mut data = Cursor::new(rest, true);
    let vertices = count(&mut data)?;
    count(&mut data)?;
    if count(&mut data)? != 1 {
        return Err(damaged("there should be one value per vertex"));
    }
    require(4 * vertices, data.available())?;
    let mut values = Vec::new();
    reserve(&mut values, vertices as usize)?;
    for _ in 0..vertices {
        values.push(data.number(NumberType::F32)?);
    }
    Ok(values)
}
