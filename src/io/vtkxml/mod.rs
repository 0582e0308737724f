//! VTK's XML files: surfaces (`vtp`), and unstructured grids (`vtu`), of whose volumes the outer surface.

mod arrays;
mod write;

use arrays::{DataArray, Storage};

use super::arrays::Components;
use super::assembly::{Assembly, check_count};
use super::cells::{Cells, kind};
use super::format::{Format, Writer};
use super::mesh_data::{MeshData, MeshFormat};
use super::packed::damaged;
use super::scan::{push, room};
use super::xml::{self, Document, Element, Part};
use crate::error::ParseError;

pub(super) const VTP: Format = Format {
    name: "vtp",
    extensions: &["vtp"],
    description: "VTK XML PolyData, text or binary, with fields",
    sniff: |bytes| xml::starts_with(bytes, b"<VTKFile"),
    read: |bytes| read(bytes, MeshFormat::Vtp),
    write: Some(Writer { text: true, binary: true, fields: true, write: write::write }),
};

pub(super) const VTU: Format = Format {
    name: "vtu",
    extensions: &["vtu"],
    description: "VTK XML unstructured grids, text or binary, with fields; of volumes the outer surface",
    sniff: |bytes| xml::starts_with(bytes, b"UnstructuredGrid"),
    read: |bytes| read(bytes, MeshFormat::Vtu),
    write: None,
};

/// The parts of a piece, by the elements that hold them.
const SECTIONS: [&str; 8] = ["Points", "Verts", "Lines", "Strips", "Polys", "Cells", "PointData", "CellData"];

/// A piece of a data set.
#[derive(Default)]
struct Piece<'a> {
    points: u64,
    /// Arrays, each with the place of its section in [`SECTIONS`].
    arrays: Vec<(usize, DataArray<'a>)>,
}

impl<'a> Piece<'a> {
    fn section(&self, name: &str) -> impl Iterator<Item = &DataArray<'a>> {
        let place = SECTIONS.iter().position(|&section| section == name);
        self.arrays.iter().filter(move |(section, _)| Some(*section) == place).map(|(_, array)| array)
    }

    fn array(&self, section: &str, name: &str) -> Option<&DataArray<'a>> {
        self.section(section).find(|array| array.name == name)
    }
}

fn read(bytes: &[u8], format: MeshFormat) -> Result<MeshData, ParseError> {
    let mut storage = Storage {
        big_endian: false,
        has_long_sizes: false,
        compressor: None,
        appended: &[],
        is_appended_base64: false,
        length: bytes.len(),
    };
    let (pieces, is_grid) = read_document(bytes, &mut storage)?;
    let mut assembly = Assembly::default();
    let mut faces = 0;
    for piece in &pieces {
        let first = (assembly.positions.len() / 3) as u64;
        read_points(piece, &storage, &mut assembly)?;
        let vertices = (assembly.positions.len() / 3) as u64;
        check_count("vertices", vertices)?;
        let cells = if is_grid {
            read_grid(piece, &storage, &mut assembly, first)?
        } else {
            read_surface(piece, &storage, &mut assembly, first)?
        };
        read_fields(piece, "PointData", &storage, |name, values| assembly.more_of_field(name, first, values))?;
        read_fields(piece, "CellData", &storage, |name, values| match &cells {
            Values::Of(cells) => cells.field_from(&mut assembly, name, faces, &values),
            Values::After(lines) => {
                let own = values.get(*lines as usize..).unwrap_or_default();
                let mut values = Vec::new();
                room(&mut values, own.len())?;
                values.extend_from_slice(own);
                assembly.more_of_face_field(name, faces, values)
            }
        })?;
        faces = assembly.faces();
    }
    if pieces.len() > 1 {
        assembly.fill_up()?;
    }
    assembly.finish(format)
}

/// Which of the values of cells belong to faces.
enum Values {
    Of(Cells),
    /// Those after so many points and lines.
    After(u64),
}

fn read_document<'a>(bytes: &'a [u8], storage: &mut Storage<'a>) -> Result<(Vec<Piece<'a>>, bool), ParseError> {
    let mut document = Document::new(bytes);
    let mut pieces: Vec<Piece<'a>> = Vec::new();
    let mut is_grid = false;
    let mut section = None;
    let mut is_in_array = false;
    while let Some(part) = document.next()? {
        match part {
            Part::Start(element) => match element.name.as_str() {
                "VTKFile" => is_grid = read_head(&element, storage)?,
                "Piece" => {
                    let points = element.count("NumberOfPoints")?.unwrap_or(0);
                    push(&mut pieces, Piece { points, arrays: Vec::new() })?;
                }
                "DataArray" | "Array" => {
                    if let (Some(section), Some(piece)) = (section, pieces.last_mut()) {
                        push(&mut piece.arrays, (section, DataArray::new(&element)?))?;
                        is_in_array = true;
                    }
                }
                "AppendedData" => {
                    storage.is_appended_base64 = element.attribute("encoding") == Some("base64");
                    let rest = document.rest();
                    let mark = rest.iter().position(|&byte| byte == b'_');
                    let mark = mark.ok_or_else(|| damaged("the appended data do not start with `_`"))?;
                    storage.appended = &rest[mark + 1..];
                    // What follows is not XML.
                    break;
                }
                name => {
                    if let Some(place) = SECTIONS.iter().position(|&other| other == name) {
                        section = Some(place);
                    }
                }
            },
            Part::Text(text) => {
                if let Some((_, array)) = pieces.last_mut().and_then(|piece| piece.arrays.last_mut())
                    && is_in_array
                {
                    array.take_text(text);
                }
            }
            Part::End(name) => {
                if name == "DataArray" || name == "Array" {
                    is_in_array = false;
                } else if SECTIONS.contains(&name.as_str()) {
                    section = None;
                }
            }
        }
    }
    if storage.is_appended_base64 {
        let end = storage.appended.iter().position(|&byte| byte == b'<').unwrap_or(storage.appended.len());
        storage.appended = &storage.appended[..end];
    }
    Ok((pieces, is_grid))
}

/// Reads what the first element says; whether this is an unstructured grid.
fn read_head(element: &Element, storage: &mut Storage<'_>) -> Result<bool, ParseError> {
    storage.big_endian = element.attribute("byte_order") == Some("BigEndian");
    storage.has_long_sizes = element.attribute("header_type") == Some("UInt64");
    storage.compressor = element.attribute("compressor").filter(|name| !name.is_empty()).map(str::to_owned);
    match element.attribute("type") {
        Some("PolyData") => Ok(false),
        Some("UnstructuredGrid") => Ok(true),
        other => {
            let feature = format!("data sets of the type `{}`", other.unwrap_or_default());
            Err(ParseError::UnsupportedFeature { format: "VTK XML".to_owned(), feature })
        }
    }
}

fn read_points(piece: &Piece<'_>, storage: &Storage<'_>, assembly: &mut Assembly) -> Result<(), ParseError> {
    let before = assembly.positions.len() as u64;
    let positions = &mut assembly.positions;
    let mut result = Ok(());
    if let Some(array) = piece.section("Points").next() {
        storage.numbers(array, &mut |value| {
            result = core::mem::replace(&mut result, Ok(())).and(push(positions, value));
        })?;
    }
    result?;
    let found = positions.len() as u64 - before;
    if found != piece.points.saturating_mul(3) {
        let problem = format!("there are {found} coordinates for {} points", piece.points);
        return Err(ParseError::DamagedData { problem });
    }
    Ok(())
}

/// The corners of cells and where those of each cell end.
fn read_cells(piece: &Piece<'_>, section: &str, storage: &Storage<'_>) -> Result<(Vec<i64>, Vec<i64>), ParseError> {
    let (mut corners, mut ends) = (Vec::new(), Vec::new());
    for (name, values) in [("connectivity", &mut corners), ("offsets", &mut ends)] {
        if let Some(array) = piece.array(section, name) {
            storage.ids(array, &mut |value| push(values, value))?;
        }
    }
    let mut start = 0;
    for &end in &ends {
        if end < start || end > corners.len() as i64 {
            return Err(damaged("where cells end does not fit the number of their corners"));
        }
        start = end;
    }
    Ok((corners, ends))
}

fn read_surface(
    piece: &Piece<'_>,
    storage: &Storage<'_>,
    assembly: &mut Assembly,
    first: u64,
) -> Result<Values, ParseError> {
    let vertices = first + piece.points;
    let mut lines = 0;
    for section in ["Verts", "Lines"] {
        let (_, ends) = read_cells(piece, section, storage)?;
        lines += ends.len() as u64;
        if !ends.is_empty() {
            assembly.skipped(format!("{} cells of `{section}`", ends.len()), ends.len() as u64);
        }
    }
    // In this order values of cells have them.
    for section in ["Polys", "Strips"] {
        let (corners, ends) = read_cells(piece, section, storage)?;
        let mut start = 0;
        for end in ends {
            for &corner in &corners[start..end as usize] {
                assembly.corner(moved(corner, first), vertices)?;
            }
            start = end as usize;
            if section == "Strips" { assembly.close_strip()? } else { assembly.close_polygon()? }
        }
    }
    Ok(Values::After(lines))
}

/// A corner among the points of all pieces; a negative one stays what cannot be.
fn moved(corner: i64, first: u64) -> i64 {
    if corner < 0 { corner } else { corner.saturating_add(first as i64) }
}

fn read_grid(
    piece: &Piece<'_>,
    storage: &Storage<'_>,
    assembly: &mut Assembly,
    first: u64,
) -> Result<Values, ParseError> {
    let (mut corners, ends) = read_cells(piece, "Cells", storage)?;
    corners.iter_mut().for_each(|corner| *corner = moved(*corner, first));
    let mut types = Vec::new();
    if let Some(array) = piece.array("Cells", "types") {
        storage.ids(array, &mut |value| push(&mut types, value))?;
    }
    if types.len() != ends.len() {
        return Err(damaged("there are not as many types as cells"));
    }
    let mut cells = Cells::new(first + piece.points, types.iter().any(|&number| kind(number).is_volume()));
    let mut start = 0;
    for (&number, end) in types.iter().zip(ends) {
        cells.add(assembly, number, &corners[start..end as usize])?;
        start = end as usize;
    }
    drop((corners, types));
    cells.finish(assembly)?;
    Ok(Values::Of(cells))
}

fn read_fields(
    piece: &Piece<'_>,
    section: &str,
    storage: &Storage<'_>,
    mut take: impl FnMut(&str, Vec<f64>) -> Result<(), ParseError>,
) -> Result<(), ParseError> {
    for array in piece.section(section).filter(|array| array.is_numeric()) {
        let mut values = Vec::new();
        let mut result = Ok(());
        storage.numbers(array, &mut |value| {
            result = core::mem::replace(&mut result, Ok(())).and(push(&mut values, value));
        })?;
        result?;
        if array.components == 1 {
            take(&array.name, values)?;
            continue;
        }
        if values.is_empty() || array.components > values.len() as u64 {
            continue;
        }
        let mut parts = Components::new(&array.name, array.components, values.len() as u64 / array.components)?;
        if array.is_real() {
            parts = parts.with_magnitude();
        }
        values.into_iter().for_each(|value| parts.push(value));
        let mut result = Ok(());
        parts.finish(&mut |name, values| {
            if result.is_ok() {
                result = take(name, values);
            }
        })?;
        result?;
    }
    Ok(())
}
