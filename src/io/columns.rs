//! All columns of a table at once.

use super::assembly::Names;
use super::scan::{FIRST_ROOM, Scanner, parse_number, push, reserve, without_byte_order_mark};
use super::table::{FieldFormat, NPY, Records, SEPARATORS, first_line, parse_cell, separator};
use crate::error::{Diagnostic, ParseError};
use crate::support::memory;

/// A table of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The columns that hold numbers, by name, in the order of the file; without a header the name is the column's number from 0.
    /// What is missing is NaN.
    pub columns: Vec<(String, Vec<f64>)>,
    /// What was left out or is missing.
    pub warnings: Vec<Diagnostic>,
}

/// Reads all columns of a table. Without a `format` columns have the separator between them that [`read_field`](super::read_field)
/// would find, or else blanks.
///
/// An empty cell is a missing value, as `nan` is. The first row is a header where a column of numbers has something else there. Columns
/// of text are left out.
///
/// Warnings: `SkippedData` for columns that are left out, `RenamedField` for a name that stands twice, `NonFiniteValue`.
///
/// # Errors
/// [`ParseError::EmptyFile`]; [`ParseError::InvalidSyntax`] for a row with another number of cells than the first;
/// [`ParseError::MissingElement`] where no column holds numbers; [`ParseError::UnsupportedFormat`] for `NumPy` arrays.
///
/// # Example
/// ```
/// use morse_smooth::io::read_table;
///
/// let table = read_table(b"id,name,height\n0,a,1.5\n1,b,\n", None)?;
/// assert_eq!(table.columns[0], ("id".to_owned(), vec![0.0, 1.0]));
/// assert_eq!(table.columns[1].0, "height");
/// assert!(table.columns[1].1[1].is_nan());
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn read_table(bytes: &[u8], format: Option<FieldFormat>) -> Result<Table, ParseError> {
    let bytes = without_byte_order_mark(bytes);
    if bytes.trim_ascii().is_empty() {
        return Err(ParseError::EmptyFile {});
    }
    let line = first_line(bytes);
    match format.unwrap_or_else(|| sniff(bytes, line)) {
        FieldFormat::Txt => between_blanks(bytes),
        FieldFormat::Csv => between_separators(bytes, separator(line)),
        format => Err(format.unsupported()),
    }
}

fn sniff(bytes: &[u8], line: &[u8]) -> FieldFormat {
    if bytes.starts_with(NPY) {
        FieldFormat::Npy
    } else if line.iter().any(|byte| SEPARATORS.contains(byte)) {
        FieldFormat::Csv
    } else {
        FieldFormat::Txt
    }
}

fn between_separators(bytes: &[u8], separator: u8) -> Result<Table, ParseError> {
    let mut records = Records::new(bytes, separator);
    let mut columns = Columns::new(bytes.len());
    while records.advance()? {
        let cells = (0..records.len()).filter_map(|place| records.cell(place));
        if !columns.add(cells, &|cell| parse_cell(cell, separator))? {
            return Err(columns.ragged(records.line(), records.len()));
        }
    }
    columns.finish(&|cell| parse_cell(cell, separator))
}

fn between_blanks(bytes: &[u8]) -> Result<Table, ParseError> {
    let mut text = Scanner::new(bytes).with_comments();
    let mut columns = Columns::new(bytes.len());
    let mut words = Vec::new();
    while text.next_row() {
        words.clear();
        while let Some(word) = text.word_in_row() {
            push(&mut words, word)?;
        }
        // A line may hold nothing but a comment.
        if !words.is_empty() && !columns.add(words.iter().copied(), &parse_number)? {
            return Err(columns.ragged(text.line(), words.len()));
        }
        text.rest_of_line();
    }
    columns.finish(&parse_number)
}

/// A column in the making.
struct Column {
    /// Its cell in the first row.
    first: Vec<u8>,
    /// Its numbers in the other rows; none once there was something else.
    values: Option<Vec<f64>>,
    /// Whether any of them was there.
    has_numbers: bool,
}

struct Columns {
    all: Vec<Column>,
    has_rows: bool,
    /// The bytes of the file: a cell has at least one, what separates it from the next.
    bytes: usize,
}

type Parse<'a> = &'a dyn Fn(&[u8]) -> Option<f64>;

impl Columns {
    fn new(bytes: usize) -> Self {
        Self { all: Vec::new(), has_rows: false, bytes }
    }

    /// Takes a row; false where it has not as many cells as the first. Cells too many may be empty.
    fn add<'a>(&mut self, cells: impl Iterator<Item = &'a [u8]>, parse: Parse<'_>) -> Result<bool, ParseError> {
        if !self.has_rows {
            self.has_rows = true;
            for cell in cells {
                memory::ensure(cell.len() as u64)?;
                push(&mut self.all, Column { first: cell.to_vec(), values: Some(Vec::new()), has_numbers: false })?;
            }
            return Ok(true);
        }
        // Where there are very many columns there are few rows, and what vectors grow by at first would be most of the memory.
        let most_rows = self.bytes / self.all.len().max(1) + 1;
        let mut count = 0;
        for cell in cells {
            let Some(column) = self.all.get_mut(count) else {
                if cell.is_empty() {
                    continue;
                }
                return Ok(false);
            };
            column.take(cell, parse, most_rows)?;
            count += 1;
        }
        Ok(count == self.all.len())
    }

    fn ragged(&self, line: u64, cells: usize) -> ParseError {
        let problem = format!("the row has {cells} cells, but the first one has {}", self.all.len());
        ParseError::InvalidSyntax { line, problem }
    }

    fn finish(self, parse: Parse<'_>) -> Result<Table, ParseError> {
        let is_text = |column: &Column| !column.first.is_empty() && parse(&column.first).is_none();
        let is_numeric = |column: &Column| column.values.is_some() && column.has_numbers;
        let has_header = self.all.iter().any(|column| is_numeric(column) && is_text(column));
        let mut table = Table { columns: Vec::new(), warnings: Vec::new() };
        let mut names = Names::default();
        for (place, mut column) in self.all.into_iter().enumerate() {
            let number = parse(&column.first);
            let is_usable = is_numeric(&column) || (!has_header && number.is_some());
            let given = match column.first.as_slice() {
                first @ [_, ..] if has_header => String::from_utf8_lossy(first).into_owned(),
                _ => place.to_string(),
            };
            let name = if has_header { names.unique(&given) } else { given.clone() };
            let mut warn =
                |code, message| table.warnings.push(Diagnostic { code, message, count: 1, examples: Vec::new() });
            let Some(mut values) = column.values.take().filter(|_| is_usable) else {
                warn("SkippedData", format!("column `{given}`, which is not of numbers, left out"));
                continue;
            };
            if name != given {
                warn("RenamedField", format!("a second column `{given}` was renamed `{name}`"));
            }
            if !has_header {
                push(&mut values, f64::NAN)?;
                values.rotate_right(1);
                values[0] = number.unwrap_or(f64::NAN);
            }
            Diagnostic::report_not_finite(&mut table.warnings, &name, &values);
            push(&mut table.columns, (name, values))?;
        }
        if table.columns.is_empty() {
            return Err(ParseError::MissingElement { element: "columns of numbers".to_owned() });
        }
        Ok(table)
    }
}

impl Column {
    fn take(&mut self, cell: &[u8], parse: Parse<'_>, most_rows: usize) -> Result<(), ParseError> {
        let Some(values) = &mut self.values else { return Ok(()) };
        if values.capacity() == 0 && most_rows < FIRST_ROOM {
            reserve(values, most_rows)?;
        }
        match parse(cell) {
            Some(number) => {
                self.has_numbers = true;
                push(values, number)?;
            }
            None if cell.is_empty() => push(values, f64::NAN)?,
            None => self.values = None,
        }
        Ok(())
    }
}
