//! Fields on their own: one number per line, or a column of a CSV file.

use csv_core::{ReadRecordResult, ReaderBuilder};

use super::scan::{Scanner, excerpt, parse_number, push, reserve, without_byte_order_mark};
use crate::error::ParseError;
use crate::support::memory;
use crate::support::named::named;

/// A file format for fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FieldFormat {
    /// Numbers, one per line or several with blanks between them; `#` starts a comment.
    Txt,
    /// Columns with commas, semicolons or tabs between them, with or without a header.
    Csv,
    /// An array of `NumPy`.
    Npy,
}

named! { FieldFormat any case { Txt = "txt", Csv = "csv", Npy = "npy" } }

/// How files of `NumPy` begin.
pub(super) const NPY: &[u8] = b"\x93NUMPY";

/// What stands between the columns of CSV files.
pub(super) const SEPARATORS: &[u8] = b",;\t";

impl FieldFormat {
    pub(super) fn unsupported(self) -> ParseError {
        ParseError::UnsupportedFormat { format: self.name().to_owned() }
    }
}

/// A column of a CSV file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Column {
    /// By its name in the header.
    Name(String),
    /// By its place, from 0.
    Number(usize),
}

/// How to read a field.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FieldReadOptions {
    /// The format; default: from the content.
    pub format: Option<FieldFormat>,
    /// The column; default: the first that holds numbers.
    pub column: Option<Column>,
}

/// Reads a field: one value per vertex, in the order of the file.
///
/// The separator of a CSV file is a tab if its first line has one, else a semicolon, else a comma. In a file with semicolons
/// a comma is a decimal point, as spreadsheets in many languages write it. The first line is a header when the column's
/// cell in it is no number.
///
/// # Errors
/// [`ParseError::EmptyFile`], [`ParseError::InvalidNumber`] for a cell that is empty or no number,
/// [`ParseError::UnknownColumn`], [`ParseError::UnsupportedFormat`] for `NumPy` arrays. `nan` and `inf` are read as they
/// are; whoever puts the field on a mesh refuses them with their vertex.
///
/// # Example
/// ```
/// use morse_smooth::io::{Column, FieldReadOptions, read_field};
///
/// let options = FieldReadOptions { column: Some(Column::Name("height".to_owned())), ..Default::default() };
/// assert_eq!(read_field(b"id,height\n0,1.5\n1,2.5\n", &options)?, [1.5, 2.5]);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn read_field(bytes: &[u8], options: &FieldReadOptions) -> Result<Vec<f64>, ParseError> {
    let bytes = without_byte_order_mark(bytes);
    if bytes.trim_ascii().is_empty() {
        return Err(ParseError::EmptyFile {});
    }
    let format = options.format.unwrap_or_else(|| sniff(bytes, options.column.as_ref()));
    match format {
        FieldFormat::Txt => match &options.column {
            None | Some(Column::Number(0)) => read_numbers(bytes),
            Some(column) => Err(unknown_column(column)),
        },
        FieldFormat::Csv => read_column(bytes, options.column.as_ref()),
        FieldFormat::Npy => Err(format.unsupported()),
    }
}

fn sniff(bytes: &[u8], column: Option<&Column>) -> FieldFormat {
    if bytes.starts_with(NPY) {
        return FieldFormat::Npy;
    }
    let line = first_line(bytes);
    let separated = line.iter().any(|byte| SEPARATORS.contains(byte));
    let named = matches!(column, Some(Column::Name(_)));
    let numbers = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    if separated || named || numbers.map(parse_number).any(|number| number.is_none()) {
        FieldFormat::Csv
    } else {
        FieldFormat::Txt
    }
}

/// The first line that is neither empty nor a comment, without blanks around it and without its comment.
pub(super) fn first_line(bytes: &[u8]) -> &[u8] {
    let mut text = Scanner::new(bytes).with_comments();
    text.next_row();
    let line = text.rest_of_line();
    line.split(|&byte| byte == b'#').next().unwrap_or_default().trim_ascii()
}

fn read_numbers(bytes: &[u8]) -> Result<Vec<f64>, ParseError> {
    let mut text = Scanner::new(bytes).with_comments();
    let mut values = Vec::new();
    while let Some(word) = text.word() {
        push(&mut values, parse_number(word).ok_or_else(|| text.invalid_number(word))?)?;
    }
    if values.is_empty() {
        return Err(ParseError::MissingElement { element: "numbers".to_owned() });
    }
    Ok(values)
}

fn unknown_column(column: &Column) -> ParseError {
    let column = match column {
        Column::Name(name) => name.clone(),
        Column::Number(number) => number.to_string(),
    };
    ParseError::UnknownColumn { column }
}

fn read_column(bytes: &[u8], column: Option<&Column>) -> Result<Vec<f64>, ParseError> {
    let separator = separator(first_line(bytes));
    let (place, header) = find_column(bytes, separator, column)?;
    let mut records = Records::new(bytes, separator);
    if header {
        records.advance()?;
    }
    let mut values = Vec::new();
    while records.advance()? {
        let Some(cell) = records.cell(place) else {
            let problem = format!("the record has {} cells, but column {place} is read (from 0)", records.len());
            return Err(ParseError::InvalidSyntax { line: records.line(), problem });
        };
        let value = parse_cell(cell, separator);
        let value = value.ok_or_else(|| ParseError::InvalidNumber { line: records.line(), text: excerpt(cell) })?;
        push(&mut values, value)?;
    }
    if values.is_empty() {
        return Err(ParseError::MissingElement { element: "numbers".to_owned() });
    }
    Ok(values)
}

/// Which column is read, and whether the first record is a header.
fn find_column(bytes: &[u8], separator: u8, column: Option<&Column>) -> Result<(usize, bool), ParseError> {
    let mut records = Records::new(bytes, separator);
    if !records.advance()? {
        return Err(ParseError::MissingElement { element: "numbers".to_owned() });
    }
    memory::ensure(64 * records.len() as u64 + records.cells.len() as u64)?;
    let first: Vec<Vec<u8>> = (0..records.len()).filter_map(|place| records.cell(place)).map(<[u8]>::to_vec).collect();
    let is_number = |cell: &[u8]| parse_cell(cell, separator).is_some();
    match column {
        Some(Column::Name(name)) => match first.iter().position(|cell| cell == name.trim().as_bytes()) {
            Some(place) => Ok((place, true)),
            None => Err(ParseError::UnknownColumn { column: name.clone() }),
        },
        Some(column @ Column::Number(place)) => match first.get(*place) {
            Some(cell) => Ok((*place, !is_number(cell))),
            None => Err(unknown_column(column)),
        },
        None => {
            // The second record cannot be a header, so it tells which columns hold numbers.
            records.advance()?;
            match (0..records.len()).find(|&place| records.cell(place).is_some_and(is_number)) {
                Some(place) => Ok((place, !first.get(place).is_some_and(|cell| is_number(cell)))),
                None => match first.iter().position(|cell| is_number(cell)) {
                    Some(place) => Ok((place, false)),
                    None if records.len() == 0 => Err(ParseError::MissingElement { element: "numbers".to_owned() }),
                    None => {
                        let text = excerpt(records.cell(0).unwrap_or_default());
                        Err(ParseError::InvalidNumber { line: records.line(), text })
                    }
                },
            }
        }
    }
}

pub(super) fn separator(line: &[u8]) -> u8 {
    let mut quoted = false;
    let mut found = [false; 3];
    for byte in line {
        match byte {
            b'"' => quoted = !quoted,
            b'\t' if !quoted => found[0] = true,
            b';' if !quoted => found[1] = true,
            b',' if !quoted => found[2] = true,
            _ => {}
        }
    }
    match found {
        [true, ..] => b'\t',
        [_, true, _] => b';',
        _ => b',',
    }
}

pub(super) fn parse_cell(cell: &[u8], separator: u8) -> Option<f64> {
    parse_number(cell).or_else(|| {
        let comma = cell.iter().position(|&byte| byte == b',').filter(|_| separator == b';')?;
        let mut number = cell.to_vec();
        number[comma] = b'.';
        // A second comma or a point makes this no number.
        parse_number(&number)
    })
}

/// Makes a buffer twice as long.
fn double<T: Clone + Default>(buffer: &mut Vec<T>) -> Result<(), ParseError> {
    let length = buffer.len();
    reserve(buffer, length)?;
    buffer.resize(2 * length, T::default());
    Ok(())
}

/// Walks through the records of a CSV file.
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
    pub(super) fn new(bytes: &'a [u8], separator: u8) -> Self {
        let reader = ReaderBuilder::new().delimiter(separator).comment(Some(b'#')).build();
        Self { reader, bytes, position: 0, cells: vec![0; 256], ends: vec![0; 16], count: 0 }
    }

    /// Goes to the next record that is not empty; false at the end of the file, where the record has no cells.
    pub(super) fn advance(&mut self) -> Result<bool, ParseError> {
        let mut filled = 0;
        self.count = 0;
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

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// A cell without the blanks around it.
    pub(super) fn cell(&self, place: usize) -> Option<&[u8]> {
        let end = *self.ends[..self.count].get(place)?;
        let start = if place == 0 { 0 } else { self.ends[place - 1] };
        Some(self.cells[start..end].trim_ascii())
    }

    /// The 1-based line where the record ends: counted only when an error needs it.
    pub(super) fn line(&self) -> u64 {
        let mut text = Scanner::new(self.bytes[..self.position].trim_ascii_end());
        while !text.rest().is_empty() {
            text.rest_of_line();
        }
        text.line()
    }
}
