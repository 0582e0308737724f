//! Fields on their own: columns of tables, in text or binary.

mod columns;
mod dialect;
mod raw;
mod rows;
mod text;

use super::names::Names;
use super::number::parse_number;
use super::scan::{Scanner, push, with_room};
use super::{freesurfer, gifti, npy, packed};
use crate::error::{Diagnostic, NameList, ParseError};
use crate::support::named::named;
use dialect::Dialect;
use raw::Raw;
use rows::Rows;

/// A file format for fields and tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FieldFormat {
    /// Numbers or columns with blanks between them; `#` starts a comment.
    Txt,
    /// Columns with commas, semicolons, tabs or bars between them, with or without a header.
    Csv,
    /// An array of `NumPy`.
    Npy,
    /// Values of GIFTI.
    Gii,
    /// Values of `FreeSurfer`, binary.
    Curv,
}

named! { FieldFormat any case { Txt = "txt", Csv = "csv", Npy = "npy", Gii = "gii", Curv = "curv" } }

/// A column of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Column {
    /// By its name in the header.
    Name(String),
    /// By its place, from 0.
    Number(usize),
}

/// The mesh that a field is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExpectedRows {
    /// Its vertices, of which each needs a value.
    pub vertices: u64,
    /// Its triangles, if they are known: a field that has as many values belongs to them.
    pub triangles: Option<u64>,
}

/// How to read a field.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FieldReadOptions {
    /// The format; default: from the content.
    pub format: Option<FieldFormat>,
    /// The column; default: the only one that holds numbers.
    pub column: Option<Column>,
    /// How many values there must be. Default: any number.
    pub expected: Option<ExpectedRows>,
}

/// A table of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The columns that hold numbers, by name, in the order of the file; without a header the name is the column's number from 0.
    /// What is missing is NaN.
    pub columns: Vec<(String, Vec<f64>)>,
    /// What was left out or is missing.
    pub warnings: Vec<Diagnostic>,
}

/// Reads all columns of a table. How it is written is told from the whole of it: what stands between the cells (commas, semicolons,
/// tabs, bars or blanks), whether commas are decimal, whether the first row is a header. Text may be UTF-8 or, with a byte order mark,
/// UTF-16.
///
/// An empty cell is a missing value, as `nan` and `NA` are. Columns of text are left out.
///
/// Warnings: `SkippedData` for columns that are left out, `RenamedField` for a name that stands twice, `NonFiniteValue`.
///
/// # Errors
/// [`ParseError::EmptyFile`]; [`ParseError::InvalidSyntax`] for a row with another number of cells than the first;
/// [`ParseError::MissingElement`] where no column holds numbers.
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
    let bytes = &*packed::unpack(bytes)?;
    let columns = match binary_columns(bytes, format)? {
        Some(columns) => columns,
        None => Text::of(bytes, format)?.read()?,
    };
    let mut table = Table { columns: Vec::new(), warnings: Vec::new() };
    let mut names = Names::default();
    for column in columns {
        let given = column.name;
        let mut warn =
            |code, message| table.warnings.push(Diagnostic { code, message, count: 1, examples: Vec::new() });
        if !column.is_numeric {
            warn("SkippedData", format!("column `{given}`, which is not of numbers, left out"));
            continue;
        }
        let name = names.unique(&given);
        if name != given {
            warn("RenamedField", format!("a second column `{given}` was renamed `{name}`"));
        }
        Diagnostic::report_not_finite(&mut table.warnings, &name, &column.values);
        push(&mut table.columns, (name, column.values))?;
    }
    if table.columns.is_empty() {
        return Err(no_numbers());
    }
    Ok(table)
}

/// Reads a field: one value per vertex, in the order of the file. A table is read as by [`read_table`].
///
/// # Errors
/// [`ParseError::AmbiguousColumn`] where several columns hold numbers and none is named; [`ParseError::UnknownColumn`];
/// [`ParseError::InvalidNumber`] for a cell that holds something else; [`ParseError::WrongRowCount`] where there are not as many values
/// as expected; those of [`read_table`]. `nan` and `inf` are read as they are, and missing values as NaN; whoever puts the field on a
/// mesh refuses them with their vertex.
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
    let bytes = &*packed::unpack(bytes)?;
    let column = options.column.as_ref();
    let values = match binary_columns(bytes, options.format)? {
        Some(columns) => choose(None, columns, column)?,
        None => {
            let text = Text::of(bytes, options.format)?;
            match (text.read_wrapped()?, column) {
                (Some(values), None | Some(Column::Number(0))) => values,
                (Some(_), Some(column)) => return Err(unknown(column)),
                (None, column) => choose(Some(&text), text.read()?, column)?,
            }
        }
    };
    if values.is_empty() {
        return Err(no_numbers());
    }
    match options.expected {
        Some(expected) if expected.vertices != values.len() as u64 => Err(wrong_count(values.len() as u64, expected)),
        _ => Ok(values),
    }
}

/// The columns of a file that is no text; none where it is.
fn binary_columns(bytes: &[u8], format: Option<FieldFormat>) -> Result<Option<Vec<Raw>>, ParseError> {
    if bytes.is_empty() {
        return Err(ParseError::EmptyFile {});
    }
    let columns = match format {
        Some(FieldFormat::Npy) => npy::read(bytes)?,
        None if bytes.starts_with(npy::MAGIC) => npy::read(bytes)?,
        Some(FieldFormat::Gii) => gifti::read_columns(bytes)?,
        None if gifti::is_gifti(bytes) => gifti::read_columns(bytes)?,
        Some(FieldFormat::Curv) => vec![("value".to_owned(), freesurfer::read_values(bytes)?)],
        None if bytes.starts_with(freesurfer::VALUES) => vec![("value".to_owned(), freesurfer::read_values(bytes)?)],
        _ => return Ok(None),
    };
    let raw = |(name, values): (String, Vec<f64>)| Raw { name, is_numeric: !values.is_empty(), values, bad: None };
    Ok(Some(columns.into_iter().map(raw).collect()))
}

/// Columns that an error names.
const MOST_NAMES: usize = 100;

/// The column that is asked for, or the only one.
fn choose(text: Option<&Text<'_>>, columns: Vec<Raw>, column: Option<&Column>) -> Result<Vec<f64>, ParseError> {
    let place = match column {
        Some(Column::Number(place)) => Some(*place),
        Some(Column::Name(name)) => columns.iter().position(|column| column.name == name.trim()),
        None => {
            let mut numeric: Vec<usize> = with_room(columns.len())?;
            numeric.extend((0..columns.len()).filter(|&place| columns[place].is_numeric));
            match *numeric {
                [place] => Some(place),
                [] if columns.len() != 1 => return Err(no_numbers()),
                [] => Some(0),
                _ => {
                    // Nobody chooses among more.
                    let listed = numeric.iter().take(MOST_NAMES).map(|&place| columns[place].name.clone());
                    let more = (numeric.len() > MOST_NAMES).then(|| "…".to_owned());
                    let columns = NameList(listed.chain(more).collect());
                    return Err(ParseError::AmbiguousColumn { columns });
                }
            }
        }
    };
    let place = place.filter(|&place| place < columns.len());
    let chosen = place.and_then(|place| columns.into_iter().nth(place));
    match (chosen, column) {
        (Some(Raw { bad: Some((row, cell)), .. }), _) => {
            let line = text.map_or(Ok(row), |text| text.line_of(row))?;
            Err(ParseError::InvalidNumber { line, text: cell })
        }
        (Some(chosen), _) if chosen.is_numeric => Ok(chosen.values),
        (None, Some(column)) => Err(unknown(column)),
        _ => Err(no_numbers()),
    }
}

fn unknown(column: &Column) -> ParseError {
    let column = match column {
        Column::Name(name) => name.clone(),
        Column::Number(number) => number.to_string(),
    };
    ParseError::UnknownColumn { column }
}

fn no_numbers() -> ParseError {
    ParseError::MissingElement { element: "columns of numbers".to_owned() }
}

/// Both numbers, and what may have happened.
fn wrong_count(actual: u64, ExpectedRows { vertices, triangles }: ExpectedRows) -> ParseError {
    let cause = if triangles == Some(actual) {
        "there is one for each triangle".to_owned()
    } else if actual == vertices + 1 {
        "the first may be a header that is a number".to_owned()
    } else if actual + 1 == vertices {
        "the first row may have been taken for a header".to_owned()
    } else if vertices > 0 && actual.is_multiple_of(vertices) {
        format!("there are {} for each vertex, as of several fields or meshes", actual / vertices)
    } else if actual == 3 * triangles.unwrap_or(u64::MAX / 3) {
        "there is one for each corner of each triangle".to_owned()
    } else {
        "the field may be that of another mesh".to_owned()
    };
    ParseError::WrongRowCount { expected: vertices, actual, cause }
}

/// A table in text, and how to read it.
struct Text<'a> {
    bytes: std::borrow::Cow<'a, [u8]>,
    dialect: Dialect,
    /// Bytes of the line that only says what the separator is.
    start: usize,
}

impl<'a> Text<'a> {
    fn of(bytes: &'a [u8], format: Option<FieldFormat>) -> Result<Self, ParseError> {
        let bytes = text::decode(bytes)?;
        if bytes.trim_ascii().is_empty() {
            return Err(ParseError::EmptyFile {});
        }
        let (declared, rest) = dialect::declared(&bytes);
        let start = bytes.len() - rest.len();
        let dialect = match declared {
            Some(dialect) => dialect,
            None => dialect::find(rest, format.map(|format| format == FieldFormat::Txt))?,
        };
        Ok(Self { bytes, dialect, start })
    }

    fn content(&self) -> &[u8] {
        &self.bytes[self.start..]
    }

    fn read(&self) -> Result<Vec<Raw>, ParseError> {
        columns::read(self.content(), self.dialect)
    }

    /// The numbers that fill lines, or one line, if that is what there is.
    fn read_wrapped(&self) -> Result<Option<Vec<f64>>, ParseError> {
        if !columns::is_wrapped(self.content(), self.dialect)? {
            return Ok(None);
        }
        let mut text = Scanner::new(self.content()).with_comments();
        let mut values = Vec::new();
        while let Some(word) = text.word() {
            push(&mut values, parse_number(word).ok_or_else(|| text.invalid_number(word))?)?;
        }
        Ok(Some(values))
    }

    /// The line of a row, by its number from 1.
    fn line_of(&self, row: u64) -> Result<u64, ParseError> {
        let mut rows = Rows::new(self.content(), self.dialect.separator);
        for _ in 0..row {
            rows.advance()?;
        }
        let lines_before = self.bytes[..self.start].iter().filter(|&&byte| byte == b'\n').count();
        Ok(rows.line() + lines_before as u64)
    }
}
