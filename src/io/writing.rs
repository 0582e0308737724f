//! What the writers share. Text has the shortest decimals that read back as the same doubles; binary files hold doubles where the
//! format has them.

use std::io::Write;

use super::scan::room;
use crate::error::ParseError;

/// Room for a header, names apart.
pub(super) const HEADER: usize = 512;

/// The longest text of a number, with the blank before it: 24 letters for `-2.2250738585072014e-308` and `-0.00001…`.
pub(super) const LONGEST_NUMBER: usize = 32;

/// The longest row of a face: three ids of ten digits.
pub(super) const LONGEST_FACE: usize = 48;

pub(super) struct Mesh<'a> {
    pub(super) positions: &'a [f64],
    pub(super) triangles: &'a [u32],
    pub(super) fields: &'a [(&'a str, &'a [f64])],
}

impl Mesh<'_> {
    pub(super) fn vertex_count(&self) -> usize {
        self.positions.len() / 3
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.triangles.len() / 3
    }

    /// Bytes of a binary file, up to its header.
    pub(super) fn binary_size(&self) -> usize {
        let numbers =
            self.fields.iter().fold(self.positions.len(), |sum, (_, values)| sum.saturating_add(values.len()));
        // Up to four bytes say how many corners a triangle has.
        numbers.saturating_mul(8).saturating_add(self.triangle_count().saturating_mul(16)).saturating_add(HEADER)
    }
}

pub(super) fn named(name: &str) -> &str {
    if name.is_empty() { "field" } else { name }
}

pub(super) fn push_faces(out: &mut Vec<u8>, triangles: &[u32]) -> Result<(), ParseError> {
    for corners in triangles.chunks_exact(3) {
        room(out, LONGEST_FACE)?;
        print(out, format_args!("3 {} {} {}\n", corners[0], corners[1], corners[2]));
    }
    Ok(())
}

pub(super) fn push_row(out: &mut Vec<u8>, row: &[f64]) -> Result<(), ParseError> {
    push_cells(out, row, b' ')
}

/// Numbers in one line.
pub(super) fn push_cells(out: &mut Vec<u8>, row: &[f64], separator: u8) -> Result<(), ParseError> {
    room(out, LONGEST_NUMBER * row.len() + 1)?;
    for (place, value) in row.iter().enumerate() {
        if place > 0 {
            out.push(separator);
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
pub(super) fn print(out: &mut Vec<u8>, text: core::fmt::Arguments<'_>) {
    let _ = out.write_fmt(text);
}
