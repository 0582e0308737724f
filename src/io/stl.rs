//! Stereolithography: triangles with three positions each, as text or binary. Positions that are equal become one vertex.

use super::assembly::{Assembly, check_count};
use super::format::{Format, Writer};
use super::mesh_data::{MeshData, MeshFormat};
use super::number::parse_number;
use super::scan::{Scanner, filled, push, require, reserve, room};
use super::writing::{Mesh, print, push_row};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "stl",
    extensions: &["stl", "stla", "stlb"],
    description: "Stereolithography, text or binary; equal positions become one vertex",
    sniff: |bytes| is_text(bytes) || is_whole_binary(bytes),
    read,
    write: Some(Writer { text: true, binary: true, fields: false, write }),
};

/// Bytes of the header, and of a triangle: a normal, three positions, two bytes that nobody agrees on.
const HEADER: usize = 80;
const TRIANGLE: usize = 50;

fn binary_count(bytes: &[u8]) -> Option<u32> {
    bytes.get(HEADER..)?.first_chunk().map(|&raw| u32::from_le_bytes(raw))
}

/// Whether the number of triangles is that of the bytes: nothing else marks these files.
fn is_whole_binary(bytes: &[u8]) -> bool {
    binary_count(bytes)
        .is_some_and(|count| count > 0 && bytes.len() as u64 == HEADER as u64 + 4 + TRIANGLE as u64 * u64::from(count))
}

/// Headers of binary files may start with `solid`, too.
fn is_text(bytes: &[u8]) -> bool {
    let mut text = Scanner::new(bytes);
    let starts_so = text.word().is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    text.rest_of_line();
    let next = text.word().unwrap_or_default();
    starts_so && (next.eq_ignore_ascii_case(b"facet") || next.eq_ignore_ascii_case(b"endsolid"))
}

/// Reads an STL file of either kind.
fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    if is_text(bytes) && !is_whole_binary(bytes) { read_text(bytes) } else { read_binary(bytes) }
}

fn read_text(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes);
    let mut corners = Corners::default();
    let mut unknown = 0;
    while let Some(word) = text.word() {
        match word.to_ascii_lowercase().as_slice() {
            b"vertex" => {
                let mut point = [0.0; 3];
                for value in &mut point {
                    let word = text.word_in_row().ok_or_else(|| text.syntax("a vertex needs three coordinates"))?;
                    *value = parse_number(word).ok_or_else(|| text.invalid_number(word))?;
                }
                corners.add(point)?;
            }
            b"endloop" => corners.close()?,
            b"outer" | b"endfacet" => {}
            b"solid" | b"endsolid" | b"facet" | b"color" => {}
            _ => unknown += 1,
        }
        text.rest_of_line();
    }
    if unknown > 0 {
        corners.assembly.skipped(format!("{unknown} lines with unknown keywords"), unknown);
    }
    corners.finish()
}

fn read_binary(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let missing = ParseError::Truncated { expected: 84, available: bytes.len() as u64 };
    let count = u64::from(binary_count(bytes).ok_or(missing)?);
    let body = &bytes[HEADER + 4..];
    require(count.saturating_mul(TRIANGLE as u64), body.len())?;
    check_count("corners", 3 * count)?;
    let mut corners = Corners::default();
    corners.assembly.reserve_triangles(count)?;
    let mut attributes = 0;
    for triangle in body.chunks_exact(TRIANGLE).take(count as usize) {
        for corner in triangle[12..48].chunks_exact(12) {
            let x = f32::from_le_bytes([corner[0], corner[1], corner[2], corner[3]]);
            let y = f32::from_le_bytes([corner[4], corner[5], corner[6], corner[7]]);
            let z = f32::from_le_bytes([corner[8], corner[9], corner[10], corner[11]]);
            corners.add([f64::from(x), f64::from(y), f64::from(z)])?;
        }
        corners.close()?;
        attributes += u64::from(triangle[48..] != [0, 0]);
    }
    if attributes > 0 {
        corners.assembly.skipped(format!("attribute bytes (perhaps colors) of {attributes} triangles"), attributes);
    }
    let left = body.len() - count as usize * TRIANGLE;
    if left > 0 {
        corners.assembly.skipped(format!("{left} bytes after the last triangle"), left as u64);
    }
    corners.finish()
}

/// Corners by their positions, of which equal ones have one id: a table of ids in which a position is looked for where its bits say.
#[derive(Default)]
struct Corners {
    assembly: Assembly,
    /// Ids from 1, in a number of places that is a power of two.
    table: Vec<u32>,
    count: u32,
    face: Vec<u32>,
    /// Triangles of which two corners are one.
    collapsed: u64,
}

impl Corners {
    fn add(&mut self, point: [f64; 3]) -> Result<(), ParseError> {
        if 2 * self.count as usize >= self.table.len() {
            self.grow()?;
        }
        // Without the sign of zero.
        let point = [point[0] + 0.0, point[1] + 0.0, point[2] + 0.0];
        let mut place = self.place_of(point);
        let mask = self.table.len() - 1;
        let id = loop {
            match self.table[place] {
                0 => {
                    check_count("vertices", u64::from(self.count) + 2)?;
                    room(&mut self.assembly.positions, 3)?;
                    self.assembly.positions.extend(point);
                    self.count += 1;
                    self.table[place] = self.count;
                    break self.count - 1;
                }
                id => {
                    let start = 3 * (id as usize - 1);
                    let known = &self.assembly.positions[start..start + 3];
                    let [x, y, z] = point;
                    let is_same = known[0].to_bits() == x.to_bits()
                        && known[1].to_bits() == y.to_bits()
                        && known[2].to_bits() == z.to_bits();
                    if is_same {
                        break id - 1;
                    }
                }
            }
            place = (place + 1) & mask;
        };
        push(&mut self.face, id)
    }

    fn close(&mut self) -> Result<(), ParseError> {
        if let [a, b, c] = *self.face
            && (a == b || b == c || c == a)
        {
            self.collapsed += 1;
        } else {
            for &id in &self.face {
                self.assembly.corner(i64::from(id), u64::from(self.count))?;
            }
            self.assembly.close_polygon()?;
        }
        self.face.clear();
        Ok(())
    }

    fn finish(mut self) -> Result<MeshData, ParseError> {
        if self.collapsed > 0 {
            self.assembly.skipped(format!("{} triangles with two equal corners", self.collapsed), self.collapsed);
        }
        self.assembly.finish(MeshFormat::Stl)
    }

    /// Where a position is looked for first. The constants are odd numbers without a pattern, of the golden ratio and the square roots of
    /// three and five.
    fn place_of(&self, point: [f64; 3]) -> usize {
        const MIX: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0xbb67_ae85_84ca_a73b, 0x3c6e_f372_fe94_f82b];
        // Written out, as is the comparison: the module is compiled for size and does not inline loops of closures.
        let [x, y, z] = point;
        let mut hash = x.to_bits().wrapping_mul(MIX[0]);
        hash = (hash.rotate_left(23) ^ y.to_bits()).wrapping_mul(MIX[1]);
        hash = (hash.rotate_left(23) ^ z.to_bits()).wrapping_mul(MIX[2]);
        hash ^= hash >> 32;
        hash = hash.wrapping_mul(MIX[0]);
        (hash >> 20) as usize & (self.table.len() - 1)
    }

    fn grow(&mut self) -> Result<(), ParseError> {
        self.table = filled(0, (2 * self.table.len()).max(64))?;
        let mask = self.table.len() - 1;
        for id in 0..self.count {
            let start = 3 * id as usize;
            let positions = &self.assembly.positions;
            let mut place = self.place_of([positions[start], positions[start + 1], positions[start + 2]]);
            while self.table[place] != 0 {
                place = (place + 1) & mask;
            }
            self.table[place] = id + 1;
        }
        Ok(())
    }
}

/// Writes triangles with their normals, in single precision where binary.
fn write(out: &mut Vec<u8>, mesh: &Mesh<'_>, binary: bool) -> Result<(), ParseError> {
    let count = mesh.triangle_count();
    if binary {
        reserve(out, HEADER + 4 + TRIANGLE * count)?;
        out.extend_from_slice(b"morse-smooth");
        out.resize(HEADER, b' ');
        out.extend((count as u32).to_le_bytes());
    } else {
        room(out, HEADER)?;
        print(out, format_args!("solid morse-smooth\n"));
    }
    for corners in mesh.triangles.chunks_exact(3) {
        let points = [0, 1, 2].map(|place| {
            let start = 3 * corners[place] as usize;
            [0, 1, 2].map(|axis| mesh.positions[start + axis])
        });
        let normal = normal(points);
        if binary {
            let values = normal.iter().chain(points.iter().flatten());
            out.extend(values.flat_map(|&value| (value as f32).to_le_bytes()));
            out.extend([0, 0]);
            continue;
        }
        room(out, HEADER)?;
        print(out, format_args!("facet normal "));
        push_row(out, &normal)?;
        room(out, HEADER)?;
        print(out, format_args!("outer loop\n"));
        for point in points {
            room(out, HEADER)?;
            print(out, format_args!("vertex "));
            push_row(out, &point)?;
        }
        room(out, HEADER)?;
        print(out, format_args!("endloop\nendfacet\n"));
    }
    if !binary {
        room(out, HEADER)?;
        print(out, format_args!("endsolid morse-smooth\n"));
    }
    Ok(())
}

/// The unit normal of a triangle; nothing where it has no area.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = ([0, 1, 2].map(|axis| b[axis] - a[axis]), [0, 1, 2].map(|axis| c[axis] - a[axis]));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt();
    if length > 0.0 && length.is_finite() { cross.map(|part| part / length) } else { [0.0; 3] }
}
