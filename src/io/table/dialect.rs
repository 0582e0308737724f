//! How a table is written: what stands between its cells, and whether commas are decimal. Told from all of its rows.

use super::super::number::{is_missing, parse_number, parse_with_comma};
use super::super::scan::Scanner;
use super::rows::{BLANKS, Rows};
use crate::error::ParseError;

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Dialect {
    /// What stands between the cells, [`BLANKS`] included.
    pub(super) separator: u8,
    /// Whether numbers may have a comma where others have a point.
    pub(super) has_commas: bool,
}

impl Dialect {
    fn between(separator: u8) -> Self {
        Self { separator, has_commas: separator != b',' }
    }

    pub(super) fn parse(self, cell: &[u8]) -> Option<f64> {
        if self.has_commas { parse_with_comma(cell) } else { parse_number(cell) }
    }
}

/// Separators, those first that seldom stand for anything else.
const SEPARATORS: [u8; 5] = [b'\t', b';', b'|', b',', BLANKS];

/// Takes off the line `sep=;` with which Excel is told the separator.
pub(super) fn declared(bytes: &[u8]) -> (Option<Dialect>, &[u8]) {
    let mut text = Scanner::new(bytes);
    let line = text.rest_of_line();
    let start = line.get(..4).is_some_and(|start| start.eq_ignore_ascii_case(b"sep="));
    match line.get(4..) {
        Some(&[separator]) if start && SEPARATORS.contains(&separator) => {
            (Some(Dialect::between(separator)), text.rest())
        }
        _ => (None, bytes),
    }
}

/// How the table is written. `between_blanks` is a format that was named: true for blanks, false for separators.
pub(super) fn find(bytes: &[u8], between_blanks: Option<bool>) -> Result<Dialect, ParseError> {
    let mut best: Option<(Dialect, Survey)> = None;
    for separator in SEPARATORS {
        let is_asked = between_blanks.is_none_or(|blanks| blanks == (separator == BLANKS));
        // One column has no separator, and is between blanks as well as anything else.
        if !is_asked || (separator != BLANKS && !bytes.contains(&separator)) {
            continue;
        }
        let dialect = Dialect::between(separator);
        let survey = Survey::take(bytes, dialect)?;
        if survey.is_table() && best.as_ref().is_none_or(|(_, other)| survey.is_better_than(other)) {
            best = Some((dialect, survey));
        }
    }
    match best {
        Some((Dialect { separator: b',', .. }, _)) if between_blanks.is_none() && commas_are_decimal(bytes)? => {
            Ok(Dialect::between(BLANKS))
        }
        Some((dialect, _)) => Ok(dialect),
        None if between_blanks == Some(true) => Ok(Dialect::between(BLANKS)),
        None => Ok(Dialect::between(of_first_line(bytes, between_blanks))),
    }
}

/// The separator of a text that is no table whatever stands between its cells: the errors should be about the likeliest one.
fn of_first_line(bytes: &[u8], between_blanks: Option<bool>) -> u8 {
    let mut text = Scanner::new(bytes).with_comments();
    text.next_row();
    let line = text.rest_of_line();
    let found = SEPARATORS[..4].iter().copied().find(|separator| line.contains(separator));
    found.unwrap_or(if between_blanks.is_none() { BLANKS } else { b',' })
}

/// Rows without any number after which a way to write tables is given up.
const NO_NUMBERS: u64 = 1000;

/// What a way to write tables makes of one.
struct Survey {
    columns: usize,
    is_ragged: bool,
    /// Cells below the first row that are not missing, and how many of them are numbers.
    cells: u64,
    numbers: u64,
    /// Whether the first row has a text with a comma, which should then have been a separator.
    has_comma_in_header: bool,
}

impl Survey {
    fn take(bytes: &[u8], dialect: Dialect) -> Result<Self, ParseError> {
        let mut rows = Rows::new(bytes, dialect.separator);
        let mut survey = Self { columns: 0, is_ragged: false, cells: 0, numbers: 0, has_comma_in_header: false };
        let mut row = 0_u64;
        let mut header_numbers = 0;
        while rows.advance()? {
            let count = (0..rows.len()).rev().find(|&place| !rows.cell(place).is_empty()).map_or(0, |last| last + 1);
            if row == 0 {
                survey.columns = rows.len();
                for place in 0..rows.len() {
                    let is_number = dialect.parse(rows.cell(place)).is_some();
                    header_numbers += u64::from(is_number);
                    survey.has_comma_in_header |=
                        dialect.separator == BLANKS && !is_number && rows.cell(place).contains(&b',');
                }
            } else {
                // The first column may have no name.
                let may_be_named = matches!(dialect.separator, BLANKS | b'\t');
                if may_be_named && row == 1 && header_numbers == 0 && rows.len() == survey.columns + 1 {
                    survey.columns += 1;
                }
                survey.is_ragged |= count > survey.columns || rows.len() < survey.columns;
                for place in 0..count {
                    let cell = rows.cell(place);
                    let is_number = dialect.parse(cell).is_some();
                    survey.numbers += u64::from(is_number);
                    survey.cells += u64::from(is_number || !is_missing(cell));
                }
            }
            row += 1;
            // No table whatever follows.
            if survey.is_ragged || (row > NO_NUMBERS && survey.numbers == 0) {
                break;
            }
        }
        if row == 1 {
            (survey.cells, survey.numbers) = (survey.columns as u64, header_numbers);
        }
        Ok(survey)
    }

    fn is_table(&self) -> bool {
        !self.is_ragged && self.numbers > 0 && !self.has_comma_in_header
    }

    /// More of its cells are numbers; where as many are, there are more columns.
    fn is_better_than(&self, other: &Self) -> bool {
        let (ours, theirs) =
            (u128::from(self.numbers) * u128::from(other.cells), u128::from(other.numbers) * u128::from(self.cells));
        ours > theirs || (ours == theirs && self.columns > other.columns)
    }
}

/// Whether rows such as `0,25` are one number each and not two. Two columns of integers look the same, but they do not begin all alike,
/// and integers are not written with zeros before them.
fn commas_are_decimal(bytes: &[u8]) -> Result<bool, ParseError> {
    let mut rows = Rows::new(bytes, b',');
    let mut first_cell: Option<Vec<u8>> = None;
    let (mut count, mut is_constant, mut is_counting, mut has_zeros) = (0_i64, true, true, false);
    let (mut digits, mut trailing) = (0, 0);
    while rows.advance()? {
        let (whole, fraction) = (rows.cell(0), rows.cell(1));
        let unsigned = whole.strip_prefix(b"-").unwrap_or(whole);
        let are_digits = |cell: &[u8]| !cell.is_empty() && cell.iter().all(u8::is_ascii_digit);
        if rows.len() != 2 || !are_digits(unsigned) || !are_digits(fraction) {
            return Ok(false);
        }
        let first = first_cell.get_or_insert_with(|| whole.to_vec());
        is_constant &= first == whole;
        let number = core::str::from_utf8(whole).ok().and_then(|text| text.parse::<i64>().ok());
        is_counting &= number.is_some_and(|number| number == count || number == count + 1);
        has_zeros |= (fraction.len() > 1 && fraction[0] == b'0') || whole == b"-0";
        digits += fraction.len() as i64;
        trailing += i64::from(fraction.len() > 1 && fraction.ends_with(b"0"));
        count += 1;
    }
    // Programs that write the shortest decimals leave no zero at the end; a tenth of all integers have one.
    let are_shortest = count >= 30 && trailing == 0 && digits >= 4 * count;
    Ok(count > 1 && (is_constant || (!is_counting && (has_zeros || are_shortest))))
}
