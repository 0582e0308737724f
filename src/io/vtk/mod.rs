//! Legacy VTK files with a `PolyData` set, as text or binary (big endian).

mod data;

use data::{ArrayType, Data};

use super::assembly::{Assembly, check_count, check_length};
use super::cursor::NumberType;
use super::mesh_data::{MeshData, MeshFormat};
use super::scan::{Scanner, excerpt, parse_count, push, reserve};
use crate::error::ParseError;
use crate::support::memory;

/// How a file of this format starts.
pub(super) const MAGIC: &[u8] = b"# vtk DataFile";

/// What a field's name takes at most in two lists that double, besides its letters.
const BYTES_PER_NAME: u64 = 512;

/// What the attributes that follow belong to, and how many tuples they have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Owner {
    File,
    Points(u64),
    Cells(u64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cells {
    Polygons,
    Strips,
}

/// Reads a legacy VTK file. Arrays of the points become fields; of an array `v` with several components each becomes a
/// field `v_0`, `v_1`, …
pub(super) fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes);
    text.next_row();
    let first = text.rest_of_line();
    if !first.get(..MAGIC.len()).is_some_and(|start| start.eq_ignore_ascii_case(MAGIC)) {
        return Err(text.syntax("a VTK file starts with `# vtk DataFile Version`"));
    }
    // The title, which may be empty.
    text.rest_of_line();
    let encoding = text.word().ok_or_else(|| text.unexpected_end("`ASCII` or `BINARY`"))?;
    let binary = encoding.eq_ignore_ascii_case(b"binary");
    if !binary && !encoding.eq_ignore_ascii_case(b"ascii") {
        return Err(text.syntax(format!("`ASCII` or `BINARY` should stand here, not `{}`", excerpt(encoding))));
    }
    text.rest_of_line();
    let mut reader =
        Reader { data: Data { text, binary }, points: None, owner: Owner::File, assembly: Assembly::default() };
    while let Some(keyword) = reader.data.text.word() {
        reader.section(&keyword.to_ascii_uppercase())?;
    }
    if reader.points.is_none() {
        return Err(ParseError::MissingElement { element: "vertices".to_owned() });
    }
    reader.assembly.finish(MeshFormat::Vtk)
}

struct Reader<'a> {
    data: Data<'a>,
    points: Option<u64>,
    owner: Owner,
    assembly: Assembly,
}

impl Reader<'_> {
    /// Reads what follows a keyword.
    fn section(&mut self, keyword: &[u8]) -> Result<(), ParseError> {
        match keyword {
            b"DATASET" => {
                let kind = self.data.text.name_in_row("the kind of data set")?;
                if !kind.eq_ignore_ascii_case(b"polydata") {
                    let format = MeshFormat::Vtk.name().to_owned();
                    return Err(ParseError::UnsupportedFeature {
                        format,
                        feature: format!("DATASET {}", excerpt(kind)),
                    });
                }
                Ok(())
            }
            b"POINTS" => self.read_points(),
            b"POLYGONS" => self.read_cells(Some(Cells::Polygons), "polygons"),
            b"TRIANGLE_STRIPS" => self.read_cells(Some(Cells::Strips), "strips"),
            b"VERTICES" => self.read_cells(None, "vertex cells"),
            b"LINES" => self.read_cells(None, "lines"),
            b"POINT_DATA" => {
                let count = self.data.text.count_in_row("the number of points")?;
                check_length("POINT_DATA", self.points.unwrap_or(0), count)?;
                self.owner = Owner::Points(count);
                Ok(())
            }
            b"CELL_DATA" => {
                self.owner = Owner::Cells(self.data.text.count_in_row("the number of cells")?);
                Ok(())
            }
            b"METADATA" => {
                // It ends with an empty line.
                self.data.text.rest_of_line();
                while !self.data.text.rest().is_empty() && !self.data.text.rest_of_line().trim_ascii().is_empty() {}
                Ok(())
            }
            b"FIELD" => self.read_field_data(),
            _ => self.attribute(keyword),
        }
    }

    fn read_points(&mut self) -> Result<(), ParseError> {
        let count = self.data.text.count_in_row("the number of points")?;
        let kind = self.data.array_type()?;
        if self.points.replace(count).is_some() {
            return Err(self.data.text.syntax("POINTS stands twice"));
        }
        check_count("vertices", count)?;
        let block = self.data.block(kind, count.saturating_mul(3))?;
        let positions = &mut self.assembly.positions;
        reserve(positions, count as usize * 3)?;
        self.data.numbers(&block, |value| positions.push(value))?;
        Ok(())
    }

    /// Reads cells of either layout; without `kind` passes over them.
    fn read_cells(&mut self, kind: Option<Cells>, what: &str) -> Result<(), ParseError> {
        let first = self.data.text.count_in_row("the number of cells")?;
        let second = self.data.text.count_in_row("the number of ids")?;
        let Some(vertices) = self.points else {
            return Err(self.data.text.syntax(format!("{what} stand before POINTS")));
        };
        let offsets = self.data.text.peek_word().is_some_and(|word| word.eq_ignore_ascii_case(b"OFFSETS"));
        let cells = if offsets {
            self.read_offset_cells(kind, first, second, vertices)?
        } else {
            self.read_counted_cells(kind, first, second, vertices)?
        };
        if kind.is_none() && cells > 0 {
            self.assembly.skipped(format!("{cells} {what}"), cells);
        }
        Ok(())
    }

    /// Every cell is its number of corners and then its corners.
    fn read_counted_cells(
        &mut self,
        kind: Option<Cells>,
        cells: u64,
        size: u64,
        vertices: u64,
    ) -> Result<u64, ParseError> {
        check_count("cells", cells)?;
        let line = self.data.text.line();
        let assembly = &mut self.assembly;
        let mut left = 0;
        let mut found = 0;
        self.data.integers(NumberType::I32, size, |value| {
            if left > 0 {
                left -= 1;
                if kind.is_some() {
                    assembly.corner(value, vertices)?;
                }
            } else {
                left = u64::try_from(value).map_err(|_| ParseError::InvalidSyntax {
                    line,
                    problem: format!("cell {found} has {value} corners"),
                })?;
                found += 1;
            }
            if left == 0 {
                close(assembly, kind)?;
            }
            Ok(())
        })?;
        if left != 0 || found != cells {
            let problem = format!("{cells} cells with {size} numbers were announced, but they do not add up");
            return Err(ParseError::InvalidSyntax { line, problem });
        }
        Ok(cells)
    }

    /// Version 5: where every cell starts, and then all corners.
    fn read_offset_cells(
        &mut self,
        kind: Option<Cells>,
        offset_count: u64,
        corners: u64,
        vertices: u64,
    ) -> Result<u64, ParseError> {
        check_count("cells", offset_count)?;
        let line = self.data.text.line();
        self.data.text.word();
        let id_type = self.data.integer_type()?;
        // One byte or more for each is there, or this fails before the vector grows.
        let mut offsets = Vec::new();
        self.data.integers(id_type, offset_count, |value| push(&mut offsets, value))?;
        if !self.data.text.word().is_some_and(|word| word.eq_ignore_ascii_case(b"CONNECTIVITY")) {
            return Err(self.data.text.syntax("CONNECTIVITY should follow OFFSETS"));
        }
        let id_type = self.data.integer_type()?;
        let rising = offsets.windows(2).all(|pair| pair[0] <= pair[1]);
        let ends = (offsets.first().copied().unwrap_or(0), offsets.last().copied().unwrap_or(0));
        if !rising || ends != (0, i64::try_from(corners).unwrap_or(i64::MAX)) {
            let problem = format!("the offsets should rise from 0 to {corners}");
            return Err(ParseError::InvalidSyntax { line, problem });
        }
        let assembly = &mut self.assembly;
        let mut ends = offsets.iter().skip(1).peekable();
        let mut read = 0;
        self.data.integers(id_type, corners, |value| {
            // Cells without corners end where they start.
            while ends.next_if(|&&end| end <= read).is_some() {
                close(assembly, kind)?;
            }
            if kind.is_some() {
                assembly.corner(value, vertices)?;
            }
            read += 1;
            Ok(())
        })?;
        for _ in ends {
            close(assembly, kind)?;
        }
        Ok(offset_count.saturating_sub(1))
    }

    /// Reads an attribute of the points, or passes over one of the cells.
    fn attribute(&mut self, keyword: &[u8]) -> Result<(), ParseError> {
        let unknown = || self.data.text.syntax(format!("unknown keyword `{}`", excerpt(keyword)));
        let count = match self.owner {
            Owner::Points(count) | Owner::Cells(count) => count,
            Owner::File if keyword == b"LOOKUP_TABLE" => 0,
            Owner::File => return Err(unknown()),
        };
        if !matches!(
            keyword,
            b"SCALARS"
                | b"VECTORS"
                | b"NORMALS"
                | b"TENSORS"
                | b"TENSORS6"
                | b"TEXTURE_COORDINATES"
                | b"COLOR_SCALARS"
                | b"LOOKUP_TABLE"
                | b"GLOBAL_IDS"
                | b"PEDIGREE_IDS"
                | b"EDGE_FLAGS"
        ) {
            return Err(unknown());
        }
        let name = decode_name(self.data.text.name_in_row("the name")?);
        match keyword {
            b"COLOR_SCALARS" => {
                let components = self.data.text.count_in_row("the number of color components")?;
                self.skip_colors(&format!("colors `{name}`"), count.saturating_mul(components))
            }
            b"LOOKUP_TABLE" => {
                let size = self.data.text.count_in_row("the size of the table")?;
                self.skip_colors(&format!("lookup table `{name}`"), size.saturating_mul(4))
            }
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" | b"EDGE_FLAGS" => {
                let kind = self.data.array_type()?;
                self.data.skip(kind, count)?;
                self.assembly.skipped(format!("ids or flags `{name}`"), count);
                Ok(())
            }
            b"TEXTURE_COORDINATES" => {
                let components = self.data.text.count_in_row("the number of texture coordinates")?;
                let kind = self.data.array_type()?;
                self.read_array(&name, kind, components, count)
            }
            b"SCALARS" => {
                let kind = self.data.array_type()?;
                let components = match self.data.text.word_in_row() {
                    Some(word) => parse_count(word).ok_or_else(|| self.data.text.invalid_number(word))?,
                    None => 1,
                };
                // The name of a table that colors the values; some writers leave it out.
                if self.data.text.peek_word().is_some_and(|word| word.eq_ignore_ascii_case(b"LOOKUP_TABLE")) {
                    self.data.text.word();
                    self.data.text.word_in_row();
                }
                self.read_array(&name, kind, components, count)
            }
            _ => {
                let kind = self.data.array_type()?;
                let components = match keyword {
                    b"TENSORS" => 9,
                    b"TENSORS6" => 6,
                    _ => 3,
                };
                self.read_array(&name, kind, components, count)
            }
        }
    }

    /// `FIELD name n` and n arrays: fields where they belong to the points.
    fn read_field_data(&mut self) -> Result<(), ParseError> {
        self.data.text.name_in_row("the name")?;
        let arrays = self.data.text.count_in_row("the number of arrays")?;
        for _ in 0..arrays {
            let mut name = self.data.text.word().ok_or_else(|| self.data.text.unexpected_end("an array"))?;
            while name.eq_ignore_ascii_case(b"METADATA") {
                self.section(b"METADATA")?;
                name = self.data.text.word().ok_or_else(|| self.data.text.unexpected_end("an array"))?;
            }
            let name = decode_name(name);
            let components = self.data.text.count_in_row("the number of components")?;
            let tuples = self.data.text.count_in_row("the number of tuples")?;
            let kind = self.data.array_type()?;
            if let Owner::Points(count) = self.owner
                && components > 0
            {
                check_length(&name, count, tuples)?;
            }
            self.read_array(&name, kind, components, tuples)?;
        }
        Ok(())
    }

    /// Reads an array into one field for each component, or passes over it where it does not belong to the points.
    fn read_array(&mut self, name: &str, kind: ArrayType, components: u64, tuples: u64) -> Result<(), ParseError> {
        let size = components.saturating_mul(tuples);
        if !matches!(self.owner, Owner::Points(_)) || kind == ArrayType::Text || size == 0 {
            self.data.skip(kind, size)?;
            let of = match self.owner {
                Owner::File => "of the file",
                Owner::Points(_) => "of the points",
                Owner::Cells(_) => "of the cells",
            };
            if size > 0 {
                self.assembly.skipped(format!("array `{name}` {of}"), size);
            }
            return Ok(());
        }
        let block = self.data.block(kind, size)?;
        // There are no more components and tuples than numbers, and those are there.
        let mut columns: Vec<Vec<f64>> = Vec::new();
        reserve(&mut columns, components as usize)?;
        // The names of many short columns take more than these.
        memory::ensure(components.saturating_mul(BYTES_PER_NAME + 2 * name.len() as u64))?;
        for _ in 0..components {
            let mut column = Vec::new();
            reserve(&mut column, tuples as usize)?;
            columns.push(column);
        }
        let mut place = 0;
        self.data.numbers(&block, |value| {
            columns[place].push(value);
            place = if place + 1 == columns.len() { 0 } else { place + 1 };
        })?;
        if columns.len() == 1 {
            for values in columns {
                self.assembly.field(name, values);
            }
        } else {
            for (component, values) in columns.into_iter().enumerate() {
                self.assembly.field(&format!("{name}_{component}"), values);
            }
        }
        Ok(())
    }

    /// Colors are fractions in text and bytes in binary files.
    fn skip_colors(&mut self, what: &str, count: u64) -> Result<(), ParseError> {
        self.data.skip(ArrayType::Number(NumberType::U8), count)?;
        self.assembly.skipped(what, count);
        Ok(())
    }
}

fn close(assembly: &mut Assembly, kind: Option<Cells>) -> Result<(), ParseError> {
    match kind {
        Some(Cells::Polygons) => assembly.close_polygon(),
        Some(Cells::Strips) => assembly.close_strip(),
        None => Ok(()),
    }
}

/// Undoes `%20` and the like.
fn decode_name(name: &[u8]) -> String {
    let mut decoded = Vec::with_capacity(name.len());
    let mut rest = name;
    while let [first, after @ ..] = rest {
        let code = match after {
            [high, low, ..] if *first == b'%' => hexadecimal(*high).zip(hexadecimal(*low)),
            _ => None,
        };
        if let Some((high, low)) = code {
            decoded.push(high << 4 | low);
            rest = &after[2..];
        } else {
            decoded.push(*first);
            rest = after;
        }
    }
    String::from_utf8_lossy(&decoded).into_owned()
}

fn hexadecimal(digit: u8) -> Option<u8> {
    char::from(digit).to_digit(16).and_then(|digit| u8::try_from(digit).ok())
}
