//! Polygon file format: a text header declares elements and their properties, the body is text or binary of either
//! byte order.

use super::assembly::{Assembly, check_count};
use super::cursor::{Cursor, NumberType};
use super::mesh_data::{MeshData, MeshFormat};
use super::scan::{Scanner, excerpt, parse_integer, parse_number, require, reserve};
use crate::error::ParseError;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Scalar(NumberType),
    List { count: NumberType, item: NumberType },
}

#[derive(Debug)]
struct Property {
    name: String,
    kind: Kind,
}

#[derive(Debug)]
struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

impl Element {
    /// Bytes that its rows have at least: empty lists, and in text a digit and a blank for every number.
    fn smallest_size(&self, encoding: Encoding) -> u64 {
        let row: u64 = match encoding {
            Encoding::Text => 2 * self.properties.len() as u64,
            _ => self
                .properties
                .iter()
                .map(|property| match property.kind {
                    Kind::Scalar(kind) | Kind::List { count: kind, .. } => kind.size(),
                })
                .sum(),
        };
        let size = self.count.saturating_mul(row);
        // The last line may lack its end.
        if encoding == Encoding::Text { size.saturating_sub(1) } else { size }
    }
}

/// Reads a PLY file. Every scalar property of the vertices but x, y and z becomes a field; numbers in text have double
/// precision, whatever type the header declares.
pub(super) fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes);
    let (encoding, elements) = read_header(&mut text)?;
    let Some(vertices) = elements.iter().find(|element| element.name == "vertex").map(|element| element.count) else {
        return Err(ParseError::MissingElement { element: "vertices".to_owned() });
    };
    check_count("vertices", vertices)?;
    let mut assembly = Assembly::default();
    let left = match encoding {
        Encoding::Text => {
            text.rest_of_line();
            let mut rows = TextRows(text);
            read_body(&mut rows, &elements, encoding, vertices, &mut assembly)?;
            if rows.0.next_row() { rows.0.rest().len() } else { 0 }
        }
        Encoding::LittleEndian | Encoding::BigEndian => {
            text.start_of_binary();
            let data = Cursor::new(text.rest(), encoding == Encoding::BigEndian);
            let mut rows = BinaryRows { data, line: text.line() };
            read_body(&mut rows, &elements, encoding, vertices, &mut assembly)?;
            rows.data.available()
        }
    };
    if left > 0 {
        assembly.skipped(format!("{left} bytes after the last element"), left as u64);
    }
    assembly.finish(MeshFormat::Ply)
}

fn read_header(text: &mut Scanner<'_>) -> Result<(Encoding, Vec<Element>), ParseError> {
    if text.word() != Some(b"ply") {
        return Err(text.syntax("a PLY file starts with `ply`"));
    }
    text.rest_of_line();
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let keyword = text.word().ok_or_else(|| text.unexpected_end("`end_header`"))?;
        match keyword {
            b"comment" | b"obj_info" => {}
            b"format" => {
                encoding = Some(match text.name_in_row("the format")? {
                    b"ascii" => Encoding::Text,
                    b"binary_little_endian" => Encoding::LittleEndian,
                    b"binary_big_endian" => Encoding::BigEndian,
                    other => return Err(text.syntax(format!("unknown format `{}`", excerpt(other)))),
                });
            }
            b"element" => {
                let name = String::from_utf8_lossy(text.name_in_row("the element's name")?).into_owned();
                let count = text.count_in_row("the number of elements")?;
                if matches!(name.as_str(), "vertex" | "face") && elements.iter().any(|other| other.name == name) {
                    return Err(text.syntax(format!("element `{name}` is declared twice")));
                }
                elements.push(Element { name, count, properties: Vec::new() });
            }
            b"property" => {
                let property = read_property(text)?;
                let Some(element) = elements.last_mut() else {
                    return Err(text.syntax("a property stands before any element"));
                };
                element.properties.push(property);
            }
            // What follows on this line's end depends on the encoding.
            b"end_header" => break,
            other => return Err(text.syntax(format!("unknown keyword `{}`", excerpt(other)))),
        }
        text.rest_of_line();
    }
    let encoding = encoding.ok_or_else(|| text.syntax("the header names no format"))?;
    Ok((encoding, elements))
}

fn read_property(text: &mut Scanner<'_>) -> Result<Property, ParseError> {
    let kind = match text.name_in_row("the property's type")? {
        b"list" => {
            let count = read_type(text)?;
            if matches!(count, NumberType::F32 | NumberType::F64) {
                return Err(text.syntax("a list cannot be counted in floating point"));
            }
            Kind::List { count, item: read_type(text)? }
        }
        word => Kind::Scalar(number_type(word).ok_or_else(|| unknown_type(text, word))?),
    };
    let name = String::from_utf8_lossy(text.name_in_row("the property's name")?).into_owned();
    Ok(Property { name, kind })
}

fn read_type(text: &mut Scanner<'_>) -> Result<NumberType, ParseError> {
    let word = text.name_in_row("the type")?;
    number_type(word).ok_or_else(|| unknown_type(text, word))
}

fn unknown_type(text: &Scanner<'_>, word: &[u8]) -> ParseError {
    text.syntax(format!("unknown type `{}`", excerpt(word)))
}

fn number_type(word: &[u8]) -> Option<NumberType> {
    Some(match word {
        b"char" | b"int8" => NumberType::I8,
        b"uchar" | b"uint8" => NumberType::U8,
        b"short" | b"int16" => NumberType::I16,
        b"ushort" | b"uint16" => NumberType::U16,
        b"int" | b"int32" => NumberType::I32,
        b"uint" | b"uint32" => NumberType::U32,
        b"int64" => NumberType::I64,
        b"uint64" => NumberType::U64,
        b"float" | b"float32" => NumberType::F32,
        b"double" | b"float64" => NumberType::F64,
        _ => return None,
    })
}

/// The body, row by row, whichever way it is encoded.
trait Rows {
    fn available(&self) -> usize;
    fn begin(&mut self, element: &str) -> Result<(), ParseError>;
    fn number(&mut self, kind: NumberType) -> Result<f64, ParseError>;
    fn integer(&mut self, kind: NumberType) -> Result<i64, ParseError>;
    fn skip(&mut self, kind: NumberType, count: u64) -> Result<(), ParseError>;
    fn end(&mut self) -> Result<(), ParseError>;
    fn invalid_count(&self, count: i64) -> ParseError;

    /// The length of a list.
    fn count(&mut self, kind: NumberType) -> Result<u64, ParseError> {
        let count = self.integer(kind)?;
        u64::try_from(count).map_err(|_| self.invalid_count(count))
    }
}

struct BinaryRows<'a> {
    data: Cursor<'a>,
    /// The line where the binary data start.
    line: u64,
}

impl Rows for BinaryRows<'_> {
    fn available(&self) -> usize {
        self.data.available()
    }
    fn begin(&mut self, _element: &str) -> Result<(), ParseError> {
        Ok(())
    }
    fn number(&mut self, kind: NumberType) -> Result<f64, ParseError> {
        self.data.number(kind)
    }
    fn integer(&mut self, kind: NumberType) -> Result<i64, ParseError> {
        self.data.integer(kind)
    }
    fn skip(&mut self, kind: NumberType, count: u64) -> Result<(), ParseError> {
        self.data.skip(count.saturating_mul(kind.size()))
    }
    fn end(&mut self) -> Result<(), ParseError> {
        Ok(())
    }
    fn invalid_count(&self, count: i64) -> ParseError {
        let problem = format!("the binary data have a list of {count} items at byte {}", self.data.position());
        ParseError::InvalidSyntax { line: self.line, problem }
    }
}

/// One row of an element is one line, so that a number too few or too many is found at once.
struct TextRows<'a>(Scanner<'a>);

impl<'a> TextRows<'a> {
    fn word(&mut self) -> Result<&'a [u8], ParseError> {
        self.0.word_in_row().ok_or_else(|| self.0.syntax("the line has fewer numbers than the header declares"))
    }
}

impl Rows for TextRows<'_> {
    fn available(&self) -> usize {
        self.0.rest().len()
    }
    fn begin(&mut self, element: &str) -> Result<(), ParseError> {
        if self.0.next_row() { Ok(()) } else { Err(self.0.unexpected_end(&format!("element `{element}`"))) }
    }
    fn number(&mut self, _kind: NumberType) -> Result<f64, ParseError> {
        let word = self.word()?;
        parse_number(word).ok_or_else(|| self.0.invalid_number(word))
    }
    fn integer(&mut self, _kind: NumberType) -> Result<i64, ParseError> {
        let word = self.word()?;
        parse_integer(word).ok_or_else(|| self.0.invalid_number(word))
    }
    fn skip(&mut self, _kind: NumberType, count: u64) -> Result<(), ParseError> {
        for _ in 0..count {
            self.word()?;
        }
        Ok(())
    }
    fn end(&mut self) -> Result<(), ParseError> {
        if self.0.word_in_row().is_some() {
            return Err(self.0.syntax("the line has more numbers than the header declares"));
        }
        self.0.rest_of_line();
        Ok(())
    }
    fn invalid_count(&self, count: i64) -> ParseError {
        self.0.syntax(format!("a list of {count} items"))
    }
}

fn read_body(
    rows: &mut impl Rows,
    elements: &[Element],
    encoding: Encoding,
    vertices: u64,
    assembly: &mut Assembly,
) -> Result<(), ParseError> {
    for element in elements {
        require(element.smallest_size(encoding), rows.available())?;
        match element.name.as_str() {
            "vertex" => read_vertices(rows, element, assembly)?,
            "face" => read_faces(rows, element, vertices, assembly)?,
            "tristrips" => {
                let format = MeshFormat::Ply.name().to_owned();
                return Err(ParseError::UnsupportedFeature { format, feature: "triangle strips".to_owned() });
            }
            name => {
                skip_rows(rows, element)?;
                assembly.skipped(format!("{} elements `{name}`", element.count), element.count);
            }
        }
    }
    Ok(())
}

/// What becomes of a vertex property.
enum Role {
    Axis(usize),
    Field(Vec<f64>),
    Skipped,
}

fn read_vertices(rows: &mut impl Rows, element: &Element, assembly: &mut Assembly) -> Result<(), ParseError> {
    // The caller has checked that every row has its bytes.
    let count = element.count as usize;
    let mut axes = [false; 3];
    let mut roles = Vec::new();
    for property in &element.properties {
        let axis = ["x", "y", "z"].iter().position(|&axis| axis == property.name);
        roles.push(match (property.kind, axis) {
            (Kind::List { .. }, _) => {
                assembly.skipped(format!("list property `{}` of the vertices", property.name), element.count);
                Role::Skipped
            }
            (Kind::Scalar(_), Some(axis)) if !axes[axis] => {
                axes[axis] = true;
                Role::Axis(axis)
            }
            (Kind::Scalar(_), _) => {
                let mut values = Vec::new();
                reserve(&mut values, count)?;
                Role::Field(values)
            }
        });
    }
    if let Some(axis) = axes.iter().position(|&found| !found) {
        let element = format!("vertex property `{}`", ["x", "y", "z"][axis]);
        return Err(ParseError::MissingElement { element });
    }
    reserve(&mut assembly.positions, count * 3)?;
    for _ in 0..count {
        rows.begin(&element.name)?;
        let mut point = [0.0; 3];
        for (property, role) in element.properties.iter().zip(&mut roles) {
            match (property.kind, role) {
                (Kind::Scalar(kind), Role::Axis(axis)) => point[*axis] = rows.number(kind)?,
                (Kind::Scalar(kind), Role::Field(values)) => values.push(rows.number(kind)?),
                (kind, _) => skip_property(rows, kind)?,
            }
        }
        rows.end()?;
        assembly.positions.extend(point);
    }
    for (property, role) in element.properties.iter().zip(roles) {
        if let Role::Field(values) = role {
            assembly.field(&property.name, values);
        }
    }
    Ok(())
}

fn read_faces(
    rows: &mut impl Rows,
    element: &Element,
    vertices: u64,
    assembly: &mut Assembly,
) -> Result<(), ParseError> {
    let corners = element.properties.iter().position(|property| {
        matches!(property.kind, Kind::List { .. })
            && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
    });
    let Some(corners) = corners else {
        return Err(ParseError::MissingElement { element: "face property `vertex_indices`".to_owned() });
    };
    assembly.reserve_triangles(element.count)?;
    for _ in 0..element.count {
        rows.begin(&element.name)?;
        for (place, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::List { count, item } if place == corners => {
                    for _ in 0..rows.count(count)? {
                        let corner = rows.integer(item)?;
                        assembly.corner(corner, vertices)?;
                    }
                }
                kind => skip_property(rows, kind)?,
            }
        }
        rows.end()?;
        assembly.close_polygon()?;
    }
    for (_, property) in element.properties.iter().enumerate().filter(|(place, _)| *place != corners) {
        assembly.skipped(format!("property `{}` of the faces", property.name), element.count);
    }
    Ok(())
}

fn skip_rows(rows: &mut impl Rows, element: &Element) -> Result<(), ParseError> {
    // Rows without properties take no bytes, however many the header promises.
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        rows.begin(&element.name)?;
        for property in &element.properties {
            skip_property(rows, property.kind)?;
        }
        rows.end()?;
    }
    Ok(())
}

fn skip_property(rows: &mut impl Rows, kind: Kind) -> Result<(), ParseError> {
    match kind {
        Kind::Scalar(kind) => rows.skip(kind, 1),
        Kind::List { count, item } => {
            let count = rows.count(count)?;
            rows.skip(item, count)
        }
    }
}
