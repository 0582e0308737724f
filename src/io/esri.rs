//! ESRI ASCII grids: heights row by row from the north. A mesh has a vertex at the centre of every cell that is not missing.

use super::assembly::{Assembly, check_count};
use super::format::Format;
use super::mesh_data::{MeshData, MeshFormat};
use super::number::parse_number;
use super::scan::{Scanner, excerpt, filled, reserve, with_room};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "asc",
    extensions: &["asc", "grd"],
    description: "ESRI ASCII grid: heights; missing cells become holes",
    sniff: |bytes| Scanner::new(bytes).word().is_some_and(|word| word.eq_ignore_ascii_case(b"ncols")),
    read,
    write: None,
};

/// What a header says.
struct Header {
    columns: u64,
    rows: u64,
    origin: [f64; 2],
    /// Whether the origin is the corner of the south-western cell, or else its centre.
    is_corner: [bool; 2],
    size: [f64; 2],
    missing: Option<f64>,
}

fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes);
    let header = read_header(&mut text)?;
    let count = header.columns.saturating_mul(header.rows);
    check_count("vertices", count)?;
    text.require_numbers(count)?;
    let mut values = Vec::new();
    reserve(&mut values, count as usize)?;
    for _ in 0..count {
        values.push(text.number("a height")?);
    }
    let is_missing = |value: f64| header.missing == Some(value) || !value.is_finite();
    let (columns, rows) = (header.columns as usize, header.rows as usize);
    let mut assembly = Assembly::default();
    let mut ids = filled(u32::MAX, values.len())?;
    let present = values.iter().filter(|&&value| !is_missing(value)).count();
    reserve(&mut assembly.positions, 3 * present)?;
    let mut heights = with_room(present)?;
    for (place, &value) in values.iter().enumerate().filter(|(_, value)| !is_missing(**value)) {
        let steps = [place % columns, rows - 1 - place / columns];
        let [x, y] = [0, 1].map(|axis| {
            let shift = if header.is_corner[axis] { 0.5 } else { 0.0 };
            header.origin[axis] + (steps[axis] as f64 + shift) * header.size[axis]
        });
        ids[place] = heights.len() as u32;
        heights.push(value);
        assembly.positions.extend([x, y, value]);
    }
    let missing = (values.len() - present) as u64;
    if missing > 0 {
        assembly.skipped(format!("{missing} missing cells"), missing);
    }
    drop(values);
    for row in 0..rows.saturating_sub(1) {
        for column in 0..columns.saturating_sub(1) {
            let north = row * columns + column;
            let south = north + columns;
            // Counterclockwise as seen from above; three corners are a triangle.
            let corners = [south, south + 1, north + 1, north].map(|place| ids[place]);
            if corners.iter().filter(|&&id| id != u32::MAX).count() < 3 {
                continue;
            }
            for id in corners.into_iter().filter(|&id| id != u32::MAX) {
                assembly.corner(i64::from(id), present as u64)?;
            }
            assembly.close_polygon()?;
        }
    }
    assembly.field("height", heights);
    assembly.finish(MeshFormat::Asc)
}

fn read_header(text: &mut Scanner<'_>) -> Result<Header, ParseError> {
    let mut header =
        Header { columns: 0, rows: 0, origin: [0.0; 2], is_corner: [true; 2], size: [1.0; 2], missing: None };
    // The header ends where a row starts with a number.
    while text.peek_word().is_some_and(|word| parse_number(word).is_none()) {
        let word = text.word().unwrap_or_default();
        let keyword = word.to_ascii_lowercase();
        match keyword.as_slice() {
            b"ncols" => header.columns = text.count_in_row("the number of columns")?,
            b"nrows" => header.rows = text.count_in_row("the number of rows")?,
            b"xllcorner" | b"xllcenter" => {
                header.origin[0] = text.number("a coordinate")?;
                header.is_corner[0] = keyword == b"xllcorner";
            }
            b"yllcorner" | b"yllcenter" => {
                header.origin[1] = text.number("a coordinate")?;
                header.is_corner[1] = keyword == b"yllcorner";
            }
            b"cellsize" => header.size = [text.number("the size of cells")?; 2],
            b"dx" => header.size[0] = text.number("the size of cells")?,
            b"dy" => header.size[1] = text.number("the size of cells")?,
            b"nodata_value" | b"nodata" => header.missing = Some(text.number("the value for missing cells")?),
            _ => return Err(text.syntax(format!("unknown keyword `{}`", excerpt(word)))),
        }
        text.rest_of_line();
    }
    Ok(header)
}
