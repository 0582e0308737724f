//! Reads bytes as binary numbers of either byte order.

use super::scan::require;
use crate::error::ParseError;

/// The type of a number in a binary file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl NumberType {
    /// Bytes of one number.
    pub(super) fn size(self) -> u64 {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
}

/// A position in binary data.
#[derive(Debug)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
    big_endian: bool,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8], big_endian: bool) -> Self {
        Self { bytes, position: 0, big_endian }
    }

    /// Bytes read so far.
    pub(super) fn position(&self) -> usize {
        self.position
    }

    /// Bytes that are left.
    pub(super) fn available(&self) -> usize {
        self.bytes.len() - self.position
    }

    /// Passes over bytes.
    #[inline(never)]
    pub(super) fn skip(&mut self, count: u64) -> Result<(), ParseError> {
        require(count, self.available())?;
        // No more than a slice's length, so it fits.
        self.position += count as usize;
        Ok(())
    }

    /// The next number; integers of 64 bits are rounded to double precision.
    #[inline(never)]
    pub(super) fn number(&mut self, kind: NumberType) -> Result<f64, ParseError> {
        Ok(match kind {
            NumberType::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            NumberType::F64 => f64::from_le_bytes(self.take()?),
            NumberType::U64 => u64::from_le_bytes(self.take()?) as f64,
            _ => self.integer(kind)? as f64,
        })
    }

    /// The next number as an integer. What is none (a fraction, NaN, more than 63 bits) becomes an id that cannot exist.
    #[inline(never)]
    pub(super) fn integer(&mut self, kind: NumberType) -> Result<i64, ParseError> {
        Ok(match kind {
            NumberType::I8 => i64::from(i8::from_le_bytes(self.take()?)),
            NumberType::U8 => i64::from(u8::from_le_bytes(self.take()?)),
            NumberType::I16 => i64::from(i16::from_le_bytes(self.take()?)),
            NumberType::U16 => i64::from(u16::from_le_bytes(self.take()?)),
            NumberType::I32 => i64::from(i32::from_le_bytes(self.take()?)),
            NumberType::U32 => i64::from(u32::from_le_bytes(self.take()?)),
            NumberType::I64 => i64::from_le_bytes(self.take()?),
            NumberType::U64 => i64::try_from(u64::from_le_bytes(self.take()?)).unwrap_or(i64::MAX),
            NumberType::F32 | NumberType::F64 => {
                let value = self.number(kind)?;
                if value.fract() == 0.0 { value as i64 } else { i64::MIN }
            }
        })
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], ParseError> {
        let Some(&found) = self.bytes[self.position..].first_chunk::<N>() else {
            return Err(ParseError::Truncated { expected: N as u64, available: self.available() as u64 });
        };
        self.position += N;
        let mut raw = found;
        if self.big_endian {
            raw.reverse();
        }
        Ok(raw)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_byte_orders_and_all_types_are_read() {
        let mut little = Cursor::new(&[0xfe, 0xff, 0xff, 0x00, 0x00, 0x80, 0x3f], false);
        assert_eq!(little.integer(NumberType::I16), Ok(-2));
        assert_eq!(little.integer(NumberType::U8), Ok(255));
        assert_eq!(little.number(NumberType::F32), Ok(1.0));
        let mut big = Cursor::new(&[0x3f, 0xf8, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0x01], true);
        assert_eq!(big.number(NumberType::F64), Ok(1.5));
        assert_eq!(big.number(NumberType::U32), Ok(4_294_967_295.0));
        assert_eq!(big.number(NumberType::I16), Err(ParseError::Truncated { expected: 2, available: 1 }));
    }

    #[test]
    fn ids_that_cannot_be_are_no_ids() {
        assert_eq!(Cursor::new(&[0xff; 8], false).integer(NumberType::U64), Ok(i64::MAX));
        for (value, id) in [(f32::NAN, i64::MIN), (1.5, i64::MIN), (f32::INFINITY, i64::MIN), (-1.0, -1), (7.0, 7)] {
            assert_eq!(Cursor::new(&value.to_le_bytes(), false).integer(NumberType::F32), Ok(id));
        }
    }
}
