//! Wavefront OBJ: `v` and `f` rows; ids count from 1, negative ones back from the last vertex. Text only.

use super::assembly::{Assembly, check_count};
use super::format::{Format, Writer};
use super::mesh_data::{MeshData, MeshFormat};
use super::number::{parse_integer, parse_number};
use super::scan::{Scanner, excerpt, push, room};
use super::writing::{LONGEST_FACE, Mesh, print, push_row};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "obj",
    extensions: &["obj"],
    description: "Wavefront OBJ, text",
    sniff,
    read,
    write: Some(Writer { text: true, binary: false, fields: false, write }),
};

/// Keywords that a file of this format starts with.
const KEYWORDS: [&[u8]; 14] =
    [b"v", b"vt", b"vn", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"mg", b"mtllib", b"usemtl", b"usemap"];

/// Rows that a mesh does not need, and that are passed over without a word: names, materials, attributes of corners.
const SILENT: [&[u8]; 9] = [b"vt", b"vn", b"o", b"g", b"s", b"mg", b"mtllib", b"usemtl", b"usemap"];

/// Comments may come first.
fn sniff(bytes: &[u8]) -> bool {
    Scanner::new(bytes).with_comments().word().is_some_and(|first| KEYWORDS.contains(&first))
}

/// Reads an OBJ file: vertex ids follow the order of the `v` rows, also of vertices that no face names.
fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes).with_comments().with_continuations();
    let mut assembly = Assembly::default();
    let mut largest = Largest { index: 0, face: 0 };
    let mut colors = 0;
    let mut lines_and_points = 0;
    let mut unknown = 0;
    let mut first_unknown = String::new();
    while text.next_row() {
        let keyword = text.word_in_row().unwrap_or_default();
        match keyword {
            b"v" => colors += u64::from(read_vertex(&mut text, &mut assembly)?),
            b"f" => read_face(&mut text, &mut assembly, &mut largest)?,
            b"l" | b"p" => lines_and_points += 1,
            _ if SILENT.contains(&keyword) => {}
            _ => {
                if unknown == 0 {
                    first_unknown = excerpt(keyword);
                }
                unknown += 1;
            }
        }
        text.rest_of_line();
    }
    let vertices = (assembly.positions.len() / 3) as u64;
    check_count("vertices", vertices)?;
    if largest.index > vertices as i64 && vertices > 0 {
        return Err(ParseError::FaceIndexOutOfBounds { face: largest.face, index: largest.index, vertices });
    }
    if colors > 0 {
        assembly.skipped(format!("weights or colors of {colors} vertices"), colors);
    }
    if lines_and_points > 0 {
        assembly.skipped(format!("{lines_and_points} line and point elements"), lines_and_points);
    }
    if unknown > 0 {
        assembly.skipped(format!("{unknown} rows with keywords such as `{first_unknown}`"), unknown);
    }
    assembly.finish(MeshFormat::Obj)
}

/// The largest id as it is written, and its face: faces may come before the vertices that they name.
struct Largest {
    index: i64,
    face: u64,
}

/// Whether a weight or color follows the coordinates.
fn read_vertex(text: &mut Scanner<'_>, assembly: &mut Assembly) -> Result<bool, ParseError> {
    for _ in 0..3 {
        let Some(word) = text.word_in_row() else {
            return Err(text.syntax("a vertex needs three coordinates"));
        };
        push(&mut assembly.positions, parse_number(word).ok_or_else(|| text.invalid_number(word))?)?;
    }
    Ok(text.word_in_row().is_some())
}

fn read_face(text: &mut Scanner<'_>, assembly: &mut Assembly, largest: &mut Largest) -> Result<(), ParseError> {
    let vertices = (assembly.positions.len() / 3) as i64;
    while let Some(word) = text.word_in_row() {
        // vertex/texture/normal: only the first counts.
        let digits = word.split(|&byte| byte == b'/').next().unwrap_or_default();
        let index = parse_integer(digits).ok_or_else(|| text.invalid_number(word))?;
        let corner = match index {
            0 => -1,
            1.. => index - 1,
            _ => vertices.saturating_add(index),
        };
        let face = assembly.faces();
        if !(0..i64::from(u32::MAX)).contains(&corner) {
            return Err(ParseError::FaceIndexOutOfBounds { face, index, vertices: vertices as u64 });
        }
        if index > largest.index {
            *largest = Largest { index, face };
        }
        // Whether the vertex exists is known at the end of the file only.
        assembly.corner(corner, u64::from(u32::MAX))?;
    }
    assembly.close_polygon()
}

fn write(out: &mut Vec<u8>, mesh: &Mesh<'_>, _binary: bool) -> Result<(), ParseError> {
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
