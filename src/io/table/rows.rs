//! The rows of a table in text, between separators or between blanks.

use csv_core::{ReadRecordResult, ReaderBuilder};

use super::super::number::is_spreadsheet_error;
use super::super::scan::{Scanner, push, reserve};
use crate::error::ParseError;

/// What stands for blanks, however many, among the separators.
pub(super) const BLANKS: u8 = b' ';

/// Goes through the rows of a table.
pub(super) enum Rows<'a> {
    Separated(Box<Records<'a>>),
    Blanks { text: Scanner<'a>, words: Vec<&'a [u8]> },
}

impl<'a> Rows<'a> {
    pub(super) fn new(bytes: &'a [u8], separator: u8) -> Self {
        if separator == BLANKS {
            Self::Blanks { text: Scanner::new(bytes).with_comments(), words: Vec::new() }
        } else {
            Self::Separated(Box::new(Records::new(bytes, separator)))
        }
    }

    /// Goes to the next row that is not empty; false at the end.
    pub(super) fn advance(&mut self) -> Result<bool, ParseError> {
        match self {
            Self::Separated(records) => records.advance(),
            Self::Blanks { text, words } => {
                words.clear();
                while text.next_row() {
                    while let Some(word) = text.word_in_row() {
                        push(words, word)?;
                    }
                    // A line may hold nothing but a comment.
                    if !words.is_empty() {
                        return Ok(true);
                    }
                }
                Ok(false)
            }
        }
    }

    /// The cells of the row.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Separated(records) => records.count,
            Self::Blanks { words, .. } => words.len(),
        }
    }

    /// A cell without the blanks and quotes around it.
    pub(super) fn cell(&self, place: usize) -> &[u8] {
        match self {
            Self::Separated(records) => records.cell(place).unwrap_or_default(),
            Self::Blanks { words, .. } => {
                let word = words.get(place).copied().unwrap_or_default();
                word.strip_prefix(b"\"").and_then(|inner| inner.strip_suffix(b"\"")).unwrap_or(word)
            }
        }
    }

    /// The 1-based line where the row ends: counted only when an error needs it.
    pub(super) fn line(&self) -> u64 {
        match self {
            Self::Separated(records) => records.line(),
            Self::Blanks { text, .. } => text.line(),
        }
    }
}

/// Makes a buffer twice as long.
fn double<T: Clone + Default>(buffer: &mut Vec<T>) -> Result<(), ParseError> {
    let length = buffer.len();
    reserve(buffer, length)?;
    buffer.resize(2 * length, T::default());
    Ok(())
}

/// Goes through the records of a CSV file.
pub(super) struct Records<'a> {
    reader: csv_core::Reader,
    bytes: &'a [u8],
    /// Bytes read so far.
    position: usize,
    /// The record's cells one after the other, in a buffer that grows to the longest record.
    cells: Vec<u8>,
    /// Where each cell ends, in such a buffer.
    ends: Vec<usize>,
    count: usize,
}

impl<'a> Records<'a> {
    fn new(bytes: &'a [u8], separator: u8) -> Self {
        let reader = ReaderBuilder::new().delimiter(separator).build();
        Self { reader, bytes, position: 0, cells: vec![0; 256], ends: vec![0; 16], count: 0 }
    }

    fn advance(&mut self) -> Result<bool, ParseError> {
        let mut filled = 0;
        self.count = 0;
        self.pass_comments();
        loop {
            let (result, read, written, ended) = self.reader.read_record(
                &self.bytes[self.position..],
                &mut self.cells[filled..],
                &mut self.ends[self.count..],
            );
            self.position += read;
            filled += written;
            self.count += ended;
            match result {
                // Called again without input, the reader ends its last record.
                ReadRecordResult::InputEmpty => {}
                ReadRecordResult::OutputFull => double(&mut self.cells)?,
                ReadRecordResult::OutputEndsFull => double(&mut self.ends)?,
                ReadRecordResult::Record => return Ok(true),
                ReadRecordResult::End => {
                    self.count = 0;
                    return Ok(false);
                }
            }
        }
    }

    /// Passes over lines that start with `#`, but not for a value that a spreadsheet could not compute.
    fn pass_comments(&mut self) {
        loop {
            let rest = &self.bytes[self.position..];
            let start = rest.iter().position(|byte| !matches!(byte, b'\r' | b'\n')).unwrap_or(0);
            if rest.get(start) != Some(&b'#') || is_spreadsheet_error(&rest[start..]) {
                return;
            }
            let line = &rest[start..];
            self.position += start + line.iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(line.len());
        }
    }

    fn cell(&self, place: usize) -> Option<&[u8]> {
        let end = *self.ends[..self.count].get(place)?;
        let start = if place == 0 { 0 } else { self.ends[place - 1] };
        Some(self.cells[start..end].trim_ascii())
    }

    fn line(&self) -> u64 {
        let mut text = Scanner::new(self.bytes[..self.position].trim_ascii_end());
        while !text.rest().is_empty() {
            text.rest_of_line();
        }
        text.line()
    }
}
