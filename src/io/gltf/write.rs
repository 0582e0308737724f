//! Writes binary glTF: positions and fields in single precision, as the format has them.

use super::super::names::Names;
use super::super::scan::{reserve, room};
use super::super::writing::{HEADER, Mesh, named, print};
use super::accessor::{BINARY_CHUNK, JSON_CHUNK, MAGIC};
use crate::error::ParseError;

pub(super) fn write(out: &mut Vec<u8>, mesh: &Mesh<'_>, _binary: bool) -> Result<(), ParseError> {
    let (vertices, triangles) = (mesh.vertex_count(), mesh.triangle_count());
    let json = document(mesh)?;
    let binary = 12 * vertices + 12 * triangles + 4 * vertices * mesh.fields.len();
    let total = 12 + 8 + json.len() + 8 + binary;
    let Ok(total) = u32::try_from(total) else {
        return Err(ParseError::TooLarge { element: "bytes".to_owned(), count: total as u64 });
    };
    reserve(out, total as usize)?;
    out.extend_from_slice(MAGIC);
    for word in [2, total, json.len() as u32, JSON_CHUNK] {
        out.extend(word.to_le_bytes());
    }
    out.extend_from_slice(&json);
    for word in [binary as u32, BINARY_CHUNK] {
        out.extend(word.to_le_bytes());
    }
    out.extend(mesh.positions.iter().flat_map(|&value| (value as f32).to_le_bytes()));
    out.extend(mesh.triangles.iter().flat_map(|corner| corner.to_le_bytes()));
    for (_, values) in mesh.fields {
        out.extend(values.iter().flat_map(|&value| (value as f32).to_le_bytes()));
    }
    Ok(())
}

/// The JSON text, filled up to four bytes.
fn document(mesh: &Mesh<'_>) -> Result<Vec<u8>, ParseError> {
    let (vertices, triangles) = (mesh.vertex_count(), mesh.triangle_count());
    let mut text = Vec::new();
    room(&mut text, 4 * HEADER)?;
    print(
        &mut text,
        format_args!(
            "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"morse-smooth\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],"
        ),
    );
    print(
        &mut text,
        format_args!(
            "\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":[{{\"indices\":1,\"attributes\":{{\"POSITION\":0"
        ),
    );
    let mut names = Names::default();
    for (place, (name, _)) in mesh.fields.iter().enumerate() {
        room(&mut text, HEADER + 6 * name.len())?;
        print(&mut text, format_args!(",\"_"));
        for letter in names.unique(named(name)).chars() {
            match letter {
                '"' | '\\' => print(&mut text, format_args!("\\{letter}")),
                letter if letter.is_control() => print(&mut text, format_args!("\\u{:04x}", u32::from(letter))),
                letter => print(&mut text, format_args!("{letter}")),
            }
        }
        print(&mut text, format_args!("\":{}", place + 2));
    }
    let (low, high) = bounds(mesh.positions);
    let (points, ids) = (12 * vertices, 12 * triangles);
    room(&mut text, 4 * HEADER)?;
    print(
        &mut text,
        format_args!(
            "}}}}]}}],\"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\",\"min\":[{},{},{}],\"max\":[{},{},{}]}},",
            low[0], low[1], low[2], high[0], high[1], high[2]
        ),
    );
    print(
        &mut text,
        format_args!("{{\"bufferView\":1,\"componentType\":5125,\"count\":{},\"type\":\"SCALAR\"}}", 3 * triangles),
    );
    for place in 0..mesh.fields.len() {
        room(&mut text, HEADER)?;
        print(
            &mut text,
            format_args!(
                ",{{\"bufferView\":{},\"componentType\":5126,\"count\":{vertices},\"type\":\"SCALAR\"}}",
                place + 2
            ),
        );
    }
    room(&mut text, HEADER)?;
    print(&mut text, format_args!("],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{points},\"target\":34962}},"));
    print(&mut text, format_args!("{{\"buffer\":0,\"byteOffset\":{points},\"byteLength\":{ids},\"target\":34963}}"));
    let mut start = points + ids;
    for _ in mesh.fields {
        room(&mut text, HEADER)?;
        print(
            &mut text,
            format_args!(",{{\"buffer\":0,\"byteOffset\":{start},\"byteLength\":{},\"target\":34962}}", 4 * vertices),
        );
        start += 4 * vertices;
    }
    room(&mut text, HEADER)?;
    print(&mut text, format_args!("],\"buffers\":[{{\"byteLength\":{start}}}]}}"));
    while !text.len().is_multiple_of(4) {
        text.push(b' ');
    }
    Ok(text)
}

/// The bounds of the positions as they are written.
fn bounds(positions: &[f64]) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
    for point in positions.chunks_exact(3) {
        for axis in 0..3 {
            low[axis] = low[axis].min(f64::from(point[axis] as f32));
            high[axis] = high[axis].max(f64::from(point[axis] as f32));
        }
    }
    (low, high)
}
