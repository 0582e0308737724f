//! The arrays of a legacy VTK file, as text or binary (big endian).

use super::super::cursor::{Cursor, NumberType};
use super::super::scan::{Scanner, excerpt, require};
use crate::error::ParseError;

/// The type of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ArrayType {
    Number(NumberType),
    /// Eight to a byte.
    Bit,
    Text,
}

impl ArrayType {
    pub(super) fn is_real(self) -> bool {
        matches!(self, Self::Number(NumberType::F32 | NumberType::F64))
    }
}

/// Numbers whose bytes are known to be there, and at which the text stands.
#[derive(Debug)]
#[must_use]
pub(super) struct Block {
    kind: ArrayType,
    count: u64,
}

/// Keywords and names are text in either encoding; what follows them may be binary.
#[derive(Debug)]
pub(super) struct Data<'a> {
    pub(super) text: Scanner<'a>,
    pub(super) binary: bool,
}

impl Data<'_> {
    /// The next word of the line as the type of an array.
    pub(super) fn array_type(&mut self) -> Result<ArrayType, ParseError> {
        let word = self.text.name_in_row("the type")?;
        Ok(match word.to_ascii_lowercase().as_slice() {
            b"bit" => ArrayType::Bit,
            b"string" | b"utf8_string" => ArrayType::Text,
            name => ArrayType::Number(
                number_type(name).ok_or_else(|| self.text.syntax(format!("unknown type `{}`", excerpt(word))))?,
            ),
        })
    }

    /// The next word of the line as a type that ids can have.
    pub(super) fn integer_type(&mut self) -> Result<NumberType, ParseError> {
        match self.array_type()? {
            ArrayType::Number(kind) if !matches!(kind, NumberType::F32 | NumberType::F64) => Ok(kind),
            _ => Err(self.text.syntax("ids must be integers")),
        }
    }

    /// Goes to where `count` numbers start and checks that their bytes are there: memory may be set aside for them then.
    pub(super) fn block(&mut self, kind: ArrayType, count: u64) -> Result<Block, ParseError> {
        let bytes = match kind {
            ArrayType::Number(kind) => count.saturating_mul(kind.size()),
            ArrayType::Bit => count.div_ceil(8),
            ArrayType::Text => return Err(self.text.syntax("text stands where numbers should")),
        };
        if self.binary {
            self.text.start_of_binary();
            require(bytes, self.text.rest().len())?;
        } else {
            self.text.require_numbers(count)?;
        }
        Ok(Block { kind, count })
    }

    /// Reads the numbers of a block.
    pub(super) fn numbers(&mut self, block: &Block, visit: &mut dyn FnMut(f64)) -> Result<(), ParseError> {
        let &Block { kind, count } = block;
        if !self.binary {
            for _ in 0..count {
                visit(self.text.number("a number")?);
            }
            return Ok(());
        }
        let data = self.text.rest();
        let used = match kind {
            ArrayType::Number(kind) => {
                let mut cursor = Cursor::new(data, true);
                for _ in 0..count {
                    visit(cursor.number(kind)?);
                }
                cursor.position()
            }
            _ => {
                let bytes = &data[..count.div_ceil(8) as usize];
                for place in 0..count as usize {
                    visit(f64::from(bytes[place / 8] >> (7 - place % 8) & 1));
                }
                bytes.len()
            }
        };
        self.text.advance(used);
        Ok(())
    }

    /// Reads `count` ids.
    pub(super) fn integers(
        &mut self,
        kind: NumberType,
        count: u64,
        visit: &mut dyn FnMut(i64) -> Result<(), ParseError>,
    ) -> Result<(), ParseError> {
        // Their bytes are there, so that a visitor may keep them.
        let Block { count, .. } = self.block(ArrayType::Number(kind), count)?;
        if !self.binary {
            for _ in 0..count {
                visit(self.text.integer("an id")?)?;
            }
            return Ok(());
        }
        let mut cursor = Cursor::new(self.text.rest(), true);
        for _ in 0..count {
            visit(cursor.integer(kind)?)?;
        }
        self.text.advance(cursor.position());
        Ok(())
    }

    /// Passes over an array.
    pub(super) fn skip(&mut self, kind: ArrayType, count: u64) -> Result<(), ParseError> {
        if kind != ArrayType::Text {
            let block = self.block(kind, count)?;
            return self.numbers(&block, &mut |_| {});
        }
        if self.binary {
            self.text.start_of_binary();
            let mut cursor = Cursor::new(self.text.rest(), true);
            require(count, cursor.available())?;
            for _ in 0..count {
                skip_string(&mut cursor)?;
            }
            self.text.advance(cursor.position());
            return Ok(());
        }
        self.text.rest_of_line();
        // Every string has its line, even an empty one.
        for _ in 0..count {
            if self.text.rest().is_empty() {
                return Err(self.text.unexpected_end("a string"));
            }
            self.text.rest_of_line();
        }
        Ok(())
    }
}

/// A string starts with its length; the two highest bits say how many bytes the length itself takes.
fn skip_string(cursor: &mut Cursor<'_>) -> Result<(), ParseError> {
    let first = cursor.integer(NumberType::U8)? as u64;
    let mut length = first & 0x3f;
    let more = match first >> 6 {
        3 => 0,
        2 => 1,
        1 => 3,
        _ => 7,
    };
    for _ in 0..more {
        length = length << 8 | cursor.integer(NumberType::U8)? as u64;
    }
    cursor.skip(length)
}

/// Sizes in binary files; `vtkIdType` is written as `int`, and `long` has the eight bytes of every 64-bit system but
/// Windows.
fn number_type(name: &[u8]) -> Option<NumberType> {
    Some(match name {
        b"char" | b"signed_char" | b"vtktypeint8" => NumberType::I8,
        b"unsigned_char" | b"vtktypeuint8" => NumberType::U8,
        b"short" | b"vtktypeint16" => NumberType::I16,
        b"unsigned_short" | b"vtktypeuint16" => NumberType::U16,
        b"int" | b"vtkidtype" | b"vtktypeint32" => NumberType::I32,
        b"unsigned_int" | b"vtktypeuint32" => NumberType::U32,
        b"long" | b"long_long" | b"vtktypeint64" | b"__int64" => NumberType::I64,
        b"unsigned_long" | b"unsigned_long_long" | b"vtktypeuint64" | b"unsigned___int64" => NumberType::U64,
        b"float" | b"vtktypefloat32" => NumberType::F32,
        b"double" | b"vtktypefloat64" => NumberType::F64,
        _ => return None,
    })
}
