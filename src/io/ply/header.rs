//! The header of a PLY file: elements and their properties.

use super::super::cursor::NumberType;
use super::super::names::decode_name;
use super::super::scan::{Scanner, excerpt};
use crate::error::ParseError;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(NumberType),
    List { count: NumberType, item: NumberType },
}

#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    /// What a field is called: the name, or what it was before it became one that every program reads.
    pub(super) title: String,
    pub(super) kind: Kind,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Bytes that its rows have at least: empty lists, and in text a digit and a blank for every number.
    pub(super) fn smallest_size(&self, encoding: Encoding) -> u64 {
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

pub(super) fn read_header(text: &mut Scanner<'_>) -> Result<(Encoding, Vec<Element>), ParseError> {
    if text.word() != Some(b"ply") {
        return Err(text.syntax("a PLY file starts with `ply`"));
    }
    text.rest_of_line();
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut title = None;
    loop {
        let keyword = text.word().ok_or_else(|| text.unexpected_end("`end_header`"))?;
        match keyword {
            b"obj_info" => {}
            b"comment" => title = read_title(text).or(title),
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
                let property = read_property(text, title.take())?;
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

fn read_property(text: &mut Scanner<'_>, title: Option<(Vec<u8>, String)>) -> Result<Property, ParseError> {
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
    let word = text.name_in_row("the property's name")?;
    let name = String::from_utf8_lossy(word).into_owned();
    let title = title.filter(|(of, _)| of == word).map_or_else(|| name.clone(), |(_, title)| title);
    Ok(Property { name, title, kind })
}

/// How a comment begins that tells what the next property was called; see [`super::write`].
pub(super) const TITLE: &str = "morse-smooth:";

/// The name of a property and what it stands for.
fn read_title(text: &mut Scanner<'_>) -> Option<(Vec<u8>, String)> {
    text.word_in_row().filter(|&word| word == TITLE.as_bytes())?;
    let name = text.word_in_row()?.to_vec();
    text.word_in_row().filter(|&word| word == b"is")?;
    Some((name, decode_name(text.word_in_row()?)))
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
