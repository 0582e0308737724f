//! Data that are packed: base64, deflate with the heads of zlib and gzip.

use miniz_oxide::inflate::TINFLStatus;
use miniz_oxide::inflate::core::inflate_flags::{
    TINFL_FLAG_COMPUTE_ADLER32, TINFL_FLAG_PARSE_ZLIB_HEADER, TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF,
};
use miniz_oxide::inflate::core::{DecompressorOxide, decompress};

use std::borrow::Cow;

use super::scan::reserve;
use crate::error::ParseError;

/// How much more than a file its content may be, and what any file may unpack to: a few bytes can stand for more than there is memory.
const MOST_TIMES: u64 = 20;
const MOST_ANYWAY: u64 = 64 << 20;

/// Bytes by which unpacked data grow at first.
const FIRST: usize = 1 << 12;

/// The bytes that a file of this length may unpack to.
pub(super) fn most_unpacked(file: usize) -> u64 {
    (file as u64).saturating_mul(MOST_TIMES).saturating_add(MOST_ANYWAY)
}

/// The error for packed data that are damaged.
#[cold]
pub(super) fn damaged(problem: &str) -> ParseError {
    ParseError::DamagedData { problem: problem.to_owned() }
}

/// Bytes of base64, blanks left out, until there are `most`. After padding another piece may begin.
pub(super) fn base64(text: &[u8], most: usize) -> Result<Vec<u8>, ParseError> {
    let mut bytes = Vec::new();
    reserve(&mut bytes, most.min(text.len() / 4 * 3 + 3))?;
    let (mut bits, mut count) = (0_u32, 0);
    for &letter in text {
        if bytes.len() >= most {
            break;
        }
        let value = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            b'=' => {
                (bits, count) = (0, 0);
                continue;
            }
            _ if letter.is_ascii_whitespace() => continue,
            _ => return Err(damaged("there is a letter in base64 that has no meaning")),
        };
        bits = bits << 6 | u32::from(value);
        count += 1;
        // The second, third and fourth letter of four complete a byte each.
        if count > 1 {
            let byte = bits >> (2 * (4 - count)) & 0xff;
            bytes.push(byte as u8);
        }
        if count == 4 {
            (bits, count) = (0, 0);
        }
    }
    Ok(bytes)
}

/// Unpacks deflated data, with the head of zlib or without one, at the end of `out`; returns how many bytes of `data` they were. `expected`
/// is how many there will be, where that is known.
pub(super) fn inflate(
    data: &[u8],
    out: &mut Vec<u8>,
    expected: Option<usize>,
    most: u64,
    has_head: bool,
) -> Result<usize, ParseError> {
    let head = if has_head { TINFL_FLAG_PARSE_ZLIB_HEADER | TINFL_FLAG_COMPUTE_ADLER32 } else { 0 };
    let flags = head | TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF;
    let mut state = Box::<DecompressorOxide>::default();
    let start = out.len();
    let (mut read, mut written) = (0, 0);
    let mut room = expected.unwrap_or(FIRST);
    loop {
        if room as u64 > most {
            return Err(ParseError::TooLarge { element: "unpacked bytes".to_owned(), count: room as u64 });
        }
        reserve(out, room - written)?;
        out.resize(start + room, 0);
        let (status, more, new) = decompress(&mut state, &data[read..], &mut out[start..], written, flags);
        read += more;
        written += new;
        match status {
            TINFLStatus::Done => {
                out.truncate(start + written);
                return Ok(read);
            }
            TINFLStatus::HasMoreOutput if expected.is_none() => room *= 2,
            _ => return Err(damaged("the packed data are damaged or end too early")),
        }
    }
}

/// The content of a file that gzip has packed, perhaps in several pieces, or the file itself.
pub(super) fn unpack(bytes: &[u8]) -> Result<Cow<'_, [u8]>, ParseError> {
    if !bytes.starts_with(b"\x1f\x8b\x08") {
        return Ok(Cow::Borrowed(bytes));
    }
    let most = most_unpacked(bytes.len());
    let mut out = Vec::new();
    let mut rest = bytes;
    while rest.starts_with(b"\x1f\x8b\x08") {
        let body = after_gzip_head(rest).ok_or_else(|| damaged("the head of the gzip file is damaged"))?;
        let read = inflate(body, &mut out, None, most, false)?;
        if out.len() as u64 > most {
            return Err(ParseError::TooLarge { element: "unpacked bytes".to_owned(), count: out.len() as u64 });
        }
        // A checksum and the length.
        rest = body.get(read + 8..).unwrap_or_default();
    }
    Ok(Cow::Owned(out))
}

fn after_gzip_head(bytes: &[u8]) -> Option<&[u8]> {
    let flags = *bytes.get(3)?;
    let mut rest = bytes.get(10..)?;
    if flags & 4 != 0 {
        let length = usize::from(u16::from_le_bytes(*rest.first_chunk()?));
        rest = rest.get(2 + length..)?;
    }
    // A name and a comment.
    for flag in [8, 16] {
        if flags & flag != 0 {
            let end = rest.iter().position(|&byte| byte == 0)?;
            rest = rest.get(end + 1..)?;
        }
    }
    if flags & 2 != 0 { rest.get(2..) } else { Some(rest) }
}
