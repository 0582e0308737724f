//! The body of a PLY file, row by row.

use super::super::cursor::{Cursor, NumberType};
use super::super::number::{parse_integer, parse_number};
use super::super::scan::Scanner;
use crate::error::ParseError;

/// The body, row by row, whichever way it is encoded.
pub(super) trait Rows {
    fn available(&self) -> usize;
    fn begin(&mut self, element: &str) -> Result<(), ParseError>;
    fn number(&mut self, kind: NumberType) -> Result<f64, ParseError>;
    fn integer(&mut self, kind: NumberType) -> Result<i64, ParseError>;
    fn skip(&mut self, kind: NumberType, count: u64) -> Result<(), ParseError>;
    /// Ends a row; whether it has more than the header declares.
    fn end(&mut self) -> bool;
    fn too_long(&self) -> ParseError;
    /// Passes over what is left of a row.
    fn pass(&mut self);
    fn invalid_count(&self, count: i64) -> ParseError;

    /// The length of a list.
    fn count(&mut self, kind: NumberType) -> Result<u64, ParseError> {
        let count = self.integer(kind)?;
        u64::try_from(count).map_err(|_| self.invalid_count(count))
    }
}

pub(super) struct BinaryRows<'a> {
    pub(super) data: Cursor<'a>,
    /// The line where the binary data start.
    pub(super) line: u64,
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
    fn end(&mut self) -> bool {
        false
    }
    fn too_long(&self) -> ParseError {
        ParseError::InvalidSyntax { line: self.line, problem: "the row is too long".to_owned() }
    }
    fn pass(&mut self) {}
    fn invalid_count(&self, count: i64) -> ParseError {
        let problem = format!("the binary data have a list of {count} items at byte {}", self.data.position());
        ParseError::InvalidSyntax { line: self.line, problem }
    }
}

/// One row of an element is one line, so that a number too few or too many is found at once.
pub(super) struct TextRows<'a>(pub(super) Scanner<'a>);

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
    fn end(&mut self) -> bool {
        let has_more = self.0.word_in_row().is_some();
        if !has_more {
            self.0.rest_of_line();
        }
        has_more
    }
    fn too_long(&self) -> ParseError {
        self.0.syntax("the line has more numbers than the header declares")
    }
    fn pass(&mut self) {
        self.0.rest_of_line();
    }
    fn invalid_count(&self, count: i64) -> ParseError {
        self.0.syntax(format!("a list of {count} items"))
    }
}
