//! Writes PLY files.

use super::super::names::{Names, encode_name};
use super::super::scan::room;
use super::super::writing::{HEADER, Mesh, named, print, push_faces, push_row};
use super::header::TITLE;
use crate::error::ParseError;

pub(super) fn write(out: &mut Vec<u8>, mesh: &Mesh<'_>, binary: bool) -> Result<(), ParseError> {
    room(out, HEADER)?;
    let encoding = if binary { "binary_little_endian" } else { "ascii" };
    print(out, format_args!("ply\nformat {encoding} 1.0\nelement vertex {}\n", mesh.vertex_count()));
    let mut names = Names::default();
    for axis in ["x", "y", "z"] {
        names.unique(axis);
        print(out, format_args!("property double {axis}\n"));
    }
    for (name, _) in mesh.fields {
        // Letters that not every program reads here become others, and a number may follow; a comment says what was there.
        room(out, HEADER + 4 * name.len())?;
        let clean: String = name.chars().map(|letter| if letter.is_ascii_graphic() { letter } else { '_' }).collect();
        let written = names.unique(named(&clean));
        if written != *name && !name.is_empty() {
            print(out, format_args!("comment {TITLE} {written} is {}\n", encode_name(name)));
        }
        print(out, format_args!("property double {written}\n"));
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
