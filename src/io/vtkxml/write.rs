//! Writes VTK XML PolyData: text, or bytes after the document.

use super::super::names::Names;
use super::super::scan::room;
use super::super::writing::{HEADER, LONGEST_FACE, Mesh, named, print, push_row};
use crate::error::ParseError;

/// How the numbers of arrays are written, and how many bytes were appended so far.
struct Arrays {
    binary: bool,
    offset: usize,
}

impl Arrays {
    fn start(
        &mut self,
        out: &mut Vec<u8>,
        kind: &str,
        name: &str,
        components: usize,
        bytes: usize,
    ) -> Result<(), ParseError> {
        room(out, HEADER + 6 * name.len())?;
        print(out, format_args!("<DataArray type=\"{kind}\" Name=\""));
        for letter in name.chars() {
            match letter {
                '&' => print(out, format_args!("&amp;")),
                '<' => print(out, format_args!("&lt;")),
                '>' => print(out, format_args!("&gt;")),
                '"' => print(out, format_args!("&quot;")),
                letter if letter.is_control() => out.push(b' '),
                letter => print(out, format_args!("{letter}")),
            }
        }
        print(out, format_args!("\" NumberOfComponents=\"{components}\" format="));
        if self.binary {
            print(out, format_args!("\"appended\" offset=\"{}\"/>\n", self.offset));
            self.offset += 8 + bytes;
        } else {
            print(out, format_args!("\"ascii\">\n"));
        }
        Ok(())
    }

    fn reals(&mut self, out: &mut Vec<u8>, name: &str, components: usize, values: &[f64]) -> Result<(), ParseError> {
        self.start(out, "Float64", name, components, 8 * values.len())?;
        if !self.binary {
            for row in values.chunks(components) {
                push_row(out, row)?;
            }
            self.end(out)?;
        }
        Ok(())
    }

    fn end(&self, out: &mut Vec<u8>) -> Result<(), ParseError> {
        room(out, HEADER)?;
        print(out, format_args!("</DataArray>\n"));
        Ok(())
    }
}

/// Ids have eight bytes, as VTK itself has them.
pub(super) fn write(out: &mut Vec<u8>, mesh: &Mesh<'_>, binary: bool) -> Result<(), ParseError> {
    let (vertices, triangles) = (mesh.vertex_count(), mesh.triangle_count());
    let mut arrays = Arrays { binary, offset: 0 };
    room(out, HEADER)?;
    print(
        out,
        format_args!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        ),
    );
    print(
        out,
        format_args!(
            "<PolyData>\n<Piece NumberOfPoints=\"{vertices}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{triangles}\">\n<PointData>\n"
        ),
    );
    let mut names = Names::default();
    for (name, values) in mesh.fields {
        arrays.reals(out, &names.unique(named(name)), 1, values)?;
    }
    room(out, HEADER)?;
    print(out, format_args!("</PointData>\n<Points>\n"));
    arrays.reals(out, "Points", 3, mesh.positions)?;
    room(out, HEADER)?;
    print(out, format_args!("</Points>\n<Polys>\n"));
    arrays.start(out, "Int64", "connectivity", 1, 24 * triangles)?;
    if !binary {
        for corners in mesh.triangles.chunks_exact(3) {
            room(out, LONGEST_FACE)?;
            print(out, format_args!("{} {} {}\n", corners[0], corners[1], corners[2]));
        }
        arrays.end(out)?;
    }
    arrays.start(out, "Int64", "offsets", 1, 8 * triangles)?;
    if !binary {
        for triangle in 1..=triangles {
            room(out, LONGEST_FACE)?;
            print(out, format_args!("{}\n", 3 * triangle));
        }
        arrays.end(out)?;
    }
    room(out, HEADER)?;
    print(out, format_args!("</Polys>\n</Piece>\n</PolyData>\n"));
    if binary {
        append(out, mesh)?;
    }
    room(out, HEADER)?;
    print(out, format_args!("</VTKFile>\n"));
    Ok(())
}

/// The arrays in the order in which they were started, each after its length.
fn append(out: &mut Vec<u8>, mesh: &Mesh<'_>) -> Result<(), ParseError> {
    let triangles = mesh.triangle_count();
    room(out, HEADER)?;
    print(out, format_args!("<AppendedData encoding=\"raw\">\n_"));
    for values in mesh.fields.iter().map(|(_, values)| *values).chain([mesh.positions]) {
        room(out, 8 + 8 * values.len())?;
        out.extend((8 * values.len() as u64).to_le_bytes());
        out.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }
    room(out, 16 + 32 * triangles)?;
    out.extend((24 * triangles as u64).to_le_bytes());
    out.extend(mesh.triangles.iter().flat_map(|&corner| i64::from(corner).to_le_bytes()));
    out.extend((8 * triangles as u64).to_le_bytes());
    out.extend((1..=triangles as u64).flat_map(|triangle| (3 * triangle).to_le_bytes()));
    room(out, HEADER)?;
    print(out, format_args!("\n</AppendedData>\n"));
    Ok(())
}
