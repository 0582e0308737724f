//! The columns of a table in text.

use super::super::names::Names;
use super::super::number::is_missing;
use super::super::scan::{FIRST_ROOM, Scanner, excerpt, push, reserve, with_room};
use super::dialect::Dialect;
use super::raw::Raw;
use super::rows::{BLANKS, Rows};
use crate::error::ParseError;
use crate::support::memory;

/// A column in the making.
struct Column {
    /// Its cell in the first row.
    first: Vec<u8>,
    /// Its numbers in the other rows; none once there was something else.
    values: Vec<f64>,
    /// The first cell that is no number, with its row from 1.
    bad: Option<(u64, String)>,
    /// Whether any number was there.
    has_numbers: bool,
    /// Whether every cell has a decimal point or an exponent.
    has_fractions: bool,
}

struct Columns {
    all: Vec<Column>,
    dialect: Dialect,
    rows: u64,
    /// The bytes of the file: a cell has at least one, what separates it from the next.
    bytes: usize,
}

/// Whether numbers between blanks fill lines, of which the last may be shorter, or just one.
pub(super) fn is_wrapped(bytes: &[u8], dialect: Dialect) -> Result<bool, ParseError> {
    if dialect.separator != BLANKS {
        return Ok(false);
    }
    let mut rows = Rows::new(bytes, dialect.separator);
    let (mut first, mut count) = (0, 0);
    while rows.advance()? {
        count += 1;
        if count == 1 {
            first = rows.len();
        }
        let are_numbers = (0..rows.len()).all(|place| dialect.parse(rows.cell(place)).is_some());
        if first < 2 || !are_numbers || rows.len() > first {
            return Ok(false);
        }
        if rows.len() < first {
            return Ok(!rows.advance()?);
        }
    }
    Ok(count == 1)
}

/// Reads all columns.
pub(super) fn read(bytes: &[u8], dialect: Dialect) -> Result<Vec<Raw>, ParseError> {
    let mut rows = Rows::new(bytes, dialect.separator);
    let mut columns = Columns { all: Vec::new(), dialect, rows: 0, bytes: bytes.len() };
    while rows.advance()? {
        if !columns.add(&rows)? {
            let problem = format!("the row has {} cells, but the first one has {}", rows.len(), columns.all.len());
            return Err(ParseError::InvalidSyntax { line: rows.line(), problem });
        }
    }
    let titles = if columns.all.len() > 1 { commented_header(bytes, dialect)? } else { Vec::new() };
    columns.finish(&titles)
}

/// The cells of the last comment before the first row: programs such as `NumPy` write a header so.
fn commented_header(bytes: &[u8], dialect: Dialect) -> Result<Vec<Vec<u8>>, ParseError> {
    let mut text = Scanner::new(bytes);
    let mut last = None;
    while text.next_row() && text.rest().starts_with(b"#") {
        last = Some(text.rest_of_line());
    }
    let mut titles = Vec::new();
    if let Some(line) = last {
        let mut rows = Rows::new(line.trim_ascii_start().trim_ascii_start_of(b'#'), dialect.separator);
        if rows.advance()? {
            memory::ensure(line.len() as u64 + 48 * rows.len() as u64)?;
            titles.extend((0..rows.len()).map(|place| rows.cell(place).to_vec()));
        }
    }
    Ok(titles)
}

trait TrimStartOf {
    fn trim_ascii_start_of(&self, byte: u8) -> &[u8];
}

impl TrimStartOf for [u8] {
    fn trim_ascii_start_of(&self, byte: u8) -> &[u8] {
        let start = self.iter().position(|&other| other != byte).unwrap_or(self.len());
        self[start..].trim_ascii_start()
    }
}

impl Columns {
    /// Takes a row; false where it has not as many cells as the first. Cells too many may be empty.
    fn add(&mut self, rows: &Rows<'_>) -> Result<bool, ParseError> {
        self.rows += 1;
        if self.rows == 1 {
            for place in 0..rows.len() {
                self.add_column(self.all.len(), rows.cell(place))?;
            }
            return Ok(true);
        }
        // A row of names may leave out that of the first column, as R does.
        let may_be_named = matches!(self.dialect.separator, BLANKS | b'\t');
        if may_be_named
            && self.rows == 2
            && rows.len() == self.all.len() + 1
            && !self.all.iter().any(|column| self.is_number(column))
        {
            self.add_column(0, b"")?;
        }
        // Where there are very many columns there are few rows, and what vectors grow by at first would be most of the memory.
        let most_rows = self.bytes / self.all.len().max(1) + 1;
        for place in 0..rows.len() {
            let cell = rows.cell(place);
            match self.all.get_mut(place) {
                Some(column) => column.take(cell, self.dialect, most_rows, self.rows)?,
                None if cell.is_empty() => {}
                None => return Ok(false),
            }
        }
        Ok(rows.len() >= self.all.len())
    }

    fn add_column(&mut self, place: usize, first: &[u8]) -> Result<(), ParseError> {
        memory::ensure(first.len() as u64)?;
        let column =
            Column { first: first.to_vec(), values: Vec::new(), bad: None, has_numbers: false, has_fractions: true };
        push(&mut self.all, column)?;
        self.all[place..].rotate_right(1);
        Ok(())
    }

    fn is_number(&self, column: &Column) -> bool {
        self.dialect.parse(&column.first).is_some()
    }

    /// Whether the first row holds names.
    fn has_header(&self) -> bool {
        let is_text = |column: &Column| !is_missing(&column.first) && !self.is_number(column);
        if self.all.iter().any(|column| column.is_numeric() && is_text(column)) {
            return true;
        }
        if self.rows < 2 || self.dialect.separator == BLANKS {
            return false;
        }
        // Names may be numbers that count on, as programs give them to columns without a name: there they are the only integers, or the
        // first of all columns, that of the rows' numbers, has no name.
        let is_index = self.all.first().is_some_and(|column| column.first.is_empty() && column.is_numeric());
        let named = &self.all[usize::from(is_index)..];
        let integer = |column: &Column| core::str::from_utf8(&column.first).ok()?.parse::<i64>().ok();
        let count_on = named.windows(2).all(|pair| match (integer(&pair[0]), integer(&pair[1])) {
            (Some(first), Some(second)) => second == first.saturating_add(1),
            _ => false,
        });
        let is_one = named.len() == 1 && named.first().and_then(integer) == Some(0);
        let are_reals = named.iter().all(|column| column.is_numeric() && column.has_fractions);
        count_on && if is_index { named.len() > 1 || is_one } else { named.len() > 1 && self.rows > 3 && are_reals }
    }

    fn finish(self, titles: &[Vec<u8>]) -> Result<Vec<Raw>, ParseError> {
        let has_header = self.has_header();
        let dialect = self.dialect;
        let has_titles = !has_header && titles.len() == self.all.len();
        let mut is_usable = with_room(self.all.len())?;
        is_usable.extend(self.all.iter().map(|column| column.is_numeric() || column.bad.is_none()));
        // Names that are numbers, which columns without a name must not have. Few tables have any.
        let mut taken = Names::default();
        for column in self.all.iter().filter(|column| has_header && column.first.iter().all(u8::is_ascii_digit)) {
            taken.unique(&String::from_utf8_lossy(&column.first));
        }
        let mut table = Vec::new();
        for (place, mut column) in self.all.into_iter().enumerate() {
            let number = dialect.parse(&column.first);
            let own = if has_titles { titles[place].as_slice() } else { column.first.as_slice() };
            let name = match own {
                name @ [_, ..] if has_header || has_titles => String::from_utf8_lossy(name).into_owned(),
                _ if has_header && taken.has(&place.to_string()) => format!("column {place}"),
                _ => place.to_string(),
            };
            let mut has_numbers = column.has_numbers;
            if !has_header {
                if number.is_none() && !is_missing(&column.first) && column.bad.is_none() {
                    column.bad = Some((1, excerpt(&column.first)));
                }
                has_numbers |= number.is_some();
                if column.bad.is_none() {
                    push(&mut column.values, f64::NAN)?;
                    column.values.rotate_right(1);
                    column.values[0] = number.unwrap_or(f64::NAN);
                }
            }
            let is_numeric = is_usable[place] && column.bad.is_none() && has_numbers;
            push(&mut table, Raw { name, values: column.values, bad: column.bad, is_numeric })?;
        }
        Ok(table)
    }
}

impl Column {
    /// Whether all cells below the first that are not missing are numbers, and one is there.
    fn is_numeric(&self) -> bool {
        self.bad.is_none() && self.has_numbers
    }

    fn take(&mut self, cell: &[u8], dialect: Dialect, most_rows: usize, row: u64) -> Result<(), ParseError> {
        if self.bad.is_some() {
            return Ok(());
        }
        if self.values.capacity() == 0 && most_rows < FIRST_ROOM {
            reserve(&mut self.values, most_rows)?;
        }
        match dialect.parse(cell) {
            Some(number) => {
                self.has_numbers = true;
                self.has_fractions &= cell.iter().any(|byte| matches!(byte, b'.' | b',' | b'e' | b'E'));
                push(&mut self.values, number)?;
            }
            None if is_missing(cell) => push(&mut self.values, f64::NAN)?,
            None => {
                self.bad = Some((row, excerpt(cell)));
                self.values = Vec::new();
            }
        }
        Ok(())
    }
}
