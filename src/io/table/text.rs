//! The text of a table in UTF-8, whatever it was written in.

use std::borrow::Cow;

use super::super::scan::{reserve, without_byte_order_mark};
use crate::error::ParseError;

/// The text without its byte order mark, which says whether it is UTF-16.
pub(super) fn decode(bytes: &[u8]) -> Result<Cow<'_, [u8]>, ParseError> {
    let (units, big_endian) = match bytes {
        [0xff, 0xfe, units @ ..] => (units, false),
        [0xfe, 0xff, units @ ..] => (units, true),
        _ => return Ok(Cow::Borrowed(without_byte_order_mark(bytes))),
    };
    let mut text = Vec::new();
    // A unit of two bytes becomes three at most.
    reserve(&mut text, units.len() / 2 * 3)?;
    let units = units.chunks_exact(2).map(|pair| {
        let pair = [pair[0], pair[1]];
        if big_endian { u16::from_be_bytes(pair) } else { u16::from_le_bytes(pair) }
    });
    let mut buffer = [0; 4];
    for letter in char::decode_utf16(units) {
        let letter = letter.unwrap_or(char::REPLACEMENT_CHARACTER);
        text.extend_from_slice(letter.encode_utf8(&mut buffer).as_bytes());
    }
    Ok(Cow::Owned(text))
}
