//! Arrays of NumPy: a header in the words of Python, then numbers row by row or column by column.

use super::cursor::{Cursor, NumberType};
use super::packed::damaged;
use super::scan::{excerpt, push, require, reserve};
use crate::error::ParseError;

/// How files begin.
pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// The type of a column, and its name where it has one.
struct Item {
    name: Option<String>,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    Number(NumberType),
    Half,
}

impl Kind {
    fn size(self) -> u64 {
        match self {
            Self::Number(kind) => kind.size(),
            Self::Half => 2,
        }
    }
}

/// Reads the columns of an array, by name where its type is made of several.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<(String, Vec<f64>)>, ParseError> {
    let not_npy = || damaged("this is no array of NumPy");
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(not_npy)?;
    let &[major, _, low, high, ..] = rest else { return Err(not_npy()) };
    let (length, start) = match major {
        1 => (u64::from(u16::from_le_bytes([low, high])), 4),
        2 | 3 => (u64::from(rest[2..].first_chunk().map_or(0, |&raw| u32::from_le_bytes(raw))), 6),
        _ => return Err(unsupported(format!("version {major}"))),
    };
    let after = rest.get(start..).unwrap_or_default();
    require(length, after.len())?;
    let (header, data) = after.split_at(length as usize);
    let (items, big_endian) = read_type(value_of(header, b"descr").ok_or_else(not_npy)?)?;
    let by_columns = value_of(header, b"fortran_order").is_some_and(|value| value.starts_with(b"True"));
    let shape = read_shape(value_of(header, b"shape").ok_or_else(not_npy)?)?;
    let count = shape.iter().fold(1_u64, |product, &length| product.saturating_mul(length));
    let size: u64 = items.iter().map(|item| item.kind.size()).sum();
    require(count.saturating_mul(size), data.len())?;
    let mut data = Cursor::new(data, big_endian);
    if let [Item { name: None, kind }] = *items {
        // An array with one long side is one column, whichever side it is.
        let longest = shape.iter().copied().max().unwrap_or(1);
        let rows = if longest == count { count } else { shape[0] };
        return read_matrix(&mut data, kind, rows, count.checked_div(rows).unwrap_or(0), by_columns);
    }
    let mut columns = Vec::new();
    for (place, item) in items.iter().enumerate() {
        let mut values = Vec::new();
        reserve(&mut values, count as usize)?;
        push(&mut columns, (item.name.clone().unwrap_or_else(|| place.to_string()), values))?;
    }
    for _ in 0..count {
        for (item, (_, values)) in items.iter().zip(&mut columns) {
            values.push(number(&mut data, item.kind)?);
        }
    }
    Ok(columns)
}

fn read_matrix(
    data: &mut Cursor<'_>,
    kind: Kind,
    rows: u64,
    width: u64,
    by_columns: bool,
) -> Result<Vec<(String, Vec<f64>)>, ParseError> {
    let mut columns = Vec::new();
    for place in 0..width {
        let mut values = Vec::new();
        reserve(&mut values, rows as usize)?;
        push(&mut columns, (place.to_string(), values))?;
    }
    if by_columns {
        for (_, values) in &mut columns {
            for _ in 0..rows {
                values.push(number(data, kind)?);
            }
        }
    } else {
        for _ in 0..rows {
            for (_, values) in &mut columns {
                values.push(number(data, kind)?);
            }
        }
    }
    Ok(columns)
}

fn number(data: &mut Cursor<'_>, kind: Kind) -> Result<f64, ParseError> {
    let kind = match kind {
        Kind::Number(kind) => kind,
        Kind::Half => return Ok(half(data.integer(NumberType::U16)? as u16)),
    };
    data.number(kind)
}

/// A number of sixteen bits.
fn half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
    let power = |exponent: i32| f64::from_bits(((1023 + exponent) as u64) << 52);
    let size = match exponent {
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        0 => fraction * power(-24),
        _ => (fraction + 1024.0) * power(exponent - 25),
    };
    if bits >> 15 == 1 { -size } else { size }
}

/// What stands after a key of the header, without blanks before it.
fn value_of<'a>(header: &'a [u8], key: &[u8]) -> Option<&'a [u8]> {
    let place = header.windows(key.len()).position(|window| window == key)?;
    let after = &header[place + key.len()..];
    let colon = after.iter().position(|&byte| byte == b':')?;
    Some(after[colon + 1..].trim_ascii_start())
}

fn read_shape(value: &[u8]) -> Result<Vec<u64>, ParseError> {
    let end = value.iter().position(|&byte| byte == b')').ok_or_else(|| damaged("the shape has no end"))?;
    let mut shape = Vec::new();
    for number in value[..end].split(|byte| b"( ,L".contains(byte)).filter(|number| !number.is_empty()) {
        let length = super::number::parse_count(number);
        push(&mut shape, length.ok_or_else(|| damaged("the shape is no list of numbers"))?)?;
    }
    Ok(shape)
}

/// A type such as `'<f8'`, or a list of names and types.
fn read_type(value: &[u8]) -> Result<(Vec<Item>, bool), ParseError> {
    let mut items = Vec::new();
    let mut big_endian = false;
    let mut add = |name: Option<String>, code: &[u8]| -> Result<(), ParseError> {
        let (order, code) = code.split_first().ok_or_else(|| damaged("the type is empty"))?;
        let kind = match code {
            b"b1" | b"u1" => NumberType::U8,
            b"i1" => NumberType::I8,
            b"i2" => NumberType::I16,
            b"u2" => NumberType::U16,
            b"i4" => NumberType::I32,
            b"u4" => NumberType::U32,
            b"i8" => NumberType::I64,
            b"u8" => NumberType::U64,
            b"f4" => NumberType::F32,
            b"f8" => NumberType::F64,
            b"f2" => {
                big_endian |= *order == b'>';
                return push(&mut items, Item { name, kind: Kind::Half });
            }
            _ => return Err(unsupported(format!("values of the type `{}`", excerpt(code)))),
        };
        big_endian |= *order == b'>';
        push(&mut items, Item { name, kind: Kind::Number(kind) })
    };
    let quoted = |text: &[u8]| {
        text.split(|byte| b"'\"".contains(byte)).skip(1).step_by(2).map(<[u8]>::to_vec).collect::<Vec<_>>()
    };
    if value.starts_with(b"[") {
        let end = value.iter().position(|&byte| byte == b']').ok_or_else(|| damaged("the types have no end"))?;
        if value[..end].windows(3).any(|window| window == b", (")
            && value[..end].windows(2).any(|window| window == b",)")
        {
            return Err(unsupported("arrays of arrays".to_owned()));
        }
        for pair in quoted(&value[..end]).chunks(2) {
            let [name, code] = pair else { return Err(damaged("a type has no name")) };
            add(Some(String::from_utf8_lossy(name).into_owned()), code)?;
        }
    } else {
        let code = quoted(&value[..value.len().min(16)]);
        add(None, code.first().ok_or_else(|| damaged("the type is missing"))?)?;
    }
    Ok((items, big_endian))
}

fn unsupported(feature: String) -> ParseError {
    ParseError::UnsupportedFeature { format: "npy".to_owned(), feature }
}
