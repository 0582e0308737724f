//! Writes legacy VTK files.

use super::super::names::{Names, encode_name};
use super::super::scan::room;
use super::super::writing::{HEADER, Mesh, named, print, push_faces, push_row};
use crate::error::ParseError;

pub(super) fn write(out: &mut Vec<u8>, mesh: &Mesh<'_>, binary: bool) -> Result<(), ParseError> {
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
