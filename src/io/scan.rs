//! Reads bytes as text: rows, words and numbers, whatever the line ends (LF, CRLF, CR), without copying.
//!
//! Functions with many callers are kept from being inlined: in WebAssembly the copies only grow the download (measured: by 1 %).

use core::cmp::Ordering;

use super::number::{parse_count, parse_integer, parse_number};
use crate::error::ParseError;
use crate::support::memory;

/// Elements that a vector has room for when it grows for the first time.
pub(super) const FIRST_ROOM: usize = 64;

/// Longest piece of the input that an error message repeats.
const EXCERPT: usize = 40;

/// How the lines of a file end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LineEnd {
    Lf,
    CrLf,
    Cr,
}

/// A position in a text, with its line for error messages.
#[derive(Debug, Clone)]
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    position: usize,
    line: u64,
    line_end: LineEnd,
    /// What starts a comment up to the end of the line; a blank when nothing does, as blanks end words anyway.
    comment: u8,
    /// Whether a backslash at the end of a line joins the next one.
    continuations: bool,
}

impl<'a> Scanner<'a> {
    /// Starts at the first byte after a byte order mark.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let bytes = without_byte_order_mark(bytes);
        let line_end = match bytes.iter().position(|&byte| is_line_end(byte)) {
            Some(at) if bytes[at] == b'\r' && bytes.get(at + 1) == Some(&b'\n') => LineEnd::CrLf,
            Some(at) if bytes[at] == b'\r' => LineEnd::Cr,
            _ => LineEnd::Lf,
        };
        Self { bytes, position: 0, line: 1, line_end, comment: b' ', continuations: false }
    }

    /// Leaves out `#` and what follows it on its line.
    pub(super) fn with_comments(mut self) -> Self {
        self.comment = b'#';
        self
    }

    /// Joins a line that ends in a backslash with the next one.
    pub(super) fn with_continuations(mut self) -> Self {
        self.continuations = true;
        self
    }

    /// Everything from here on.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position..]
    }

    /// Goes on after `count` bytes that were read as binary.
    pub(super) fn advance(&mut self, count: usize) {
        self.position = (self.position + count).min(self.bytes.len());
    }

    /// 1-based line.
    pub(super) fn line(&self) -> u64 {
        self.line
    }

    /// Goes to the next line that holds a word; false at the end of the text.
    #[inline(never)]
    pub(super) fn next_row(&mut self) -> bool {
        loop {
            self.skip_blanks();
            match self.bytes.get(self.position) {
                None => return false,
                Some(&byte) if is_line_end(byte) => self.pass_line_end(),
                Some(_) => return true,
            }
        }
    }

    /// The next word on this line.
    #[inline(never)]
    pub(super) fn word_in_row(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let rest = self.rest();
        // A comment starts where a word could: in `1.#INF` the sign belongs to the word.
        let is_comment = rest.first().is_some_and(|&byte| byte == self.comment);
        let end = rest.iter().position(|&byte| is_blank(byte) || is_line_end(byte));
        let mut length = if is_comment { 0 } else { end.unwrap_or(rest.len()) };
        // A continuation may follow a number without a blank.
        if self.continuations && length > 0 && rest[length - 1] == b'\\' && is_end_of_line(&rest[length..]) {
            length -= 1;
        }
        self.position += length;
        (length > 0).then(|| &rest[..length])
    }

    /// The next word on this or a later line.
    #[inline(never)]
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        if self.next_row() { self.word_in_row() } else { None }
    }

    /// The next word, without moving on to it.
    #[inline(never)]
    pub(super) fn peek_word(&self) -> Option<&'a [u8]> {
        self.clone().word()
    }

    /// What is left of this line, without the line end, and goes to the next line.
    #[inline(never)]
    pub(super) fn rest_of_line(&mut self) -> &'a [u8] {
        let start = self.position;
        loop {
            let rest = self.rest();
            let length = rest.iter().position(|&byte| is_line_end(byte)).unwrap_or(rest.len());
            self.position += length;
            let end = self.position;
            let continued = self.continuations && length > 0 && rest[length - 1] == b'\\' && end < self.bytes.len();
            self.pass_line_end();
            if !continued {
                return &self.bytes[start..end];
            }
        }
    }

    /// Passes the end of a line after which binary data start.
    ///
    /// The kind of line end comes from the first line: after a lone CR, a first data byte 10 is no line end.
    pub(super) fn start_of_binary(&mut self) {
        self.skip_blanks();
        let rest = self.rest();
        let length = match (self.line_end, rest.first(), rest.get(1)) {
            (LineEnd::Cr, Some(b'\r'), _) | (_, Some(b'\n'), _) => 1,
            (_, Some(b'\r'), Some(b'\n')) => 2,
            _ => 0,
        };
        self.position += length;
        self.line += u64::from(length > 0);
    }

    /// The next word of this or a later line as a number.
    #[inline(never)]
    pub(super) fn number(&mut self, what: &str) -> Result<f64, ParseError> {
        let word = self.word().ok_or_else(|| self.unexpected_end(what))?;
        parse_number(word).ok_or_else(|| self.invalid_number(word))
    }

    /// The next word of this or a later line as an integer.
    #[inline(never)]
    pub(super) fn integer(&mut self, what: &str) -> Result<i64, ParseError> {
        let word = self.word().ok_or_else(|| self.unexpected_end(what))?;
        parse_integer(word).ok_or_else(|| self.invalid_number(word))
    }

    /// The next word of this line as a number of things.
    #[inline(never)]
    pub(super) fn count_in_row(&mut self, what: &str) -> Result<u64, ParseError> {
        let word = self.word_in_row().ok_or_else(|| self.syntax(format!("{what} is missing")))?;
        parse_count(word).ok_or_else(|| self.invalid_number(word))
    }

    /// The next word of this line as a name.
    #[inline(never)]
    pub(super) fn name_in_row(&mut self, what: &str) -> Result<&'a [u8], ParseError> {
        self.word_in_row().ok_or_else(|| self.syntax(format!("{what} is missing")))
    }

    /// Fails unless `numbers` words can be there: one byte each, with a blank between them.
    pub(super) fn require_numbers(&self, numbers: u64) -> Result<(), ParseError> {
        require(numbers.saturating_mul(2).saturating_sub(1), self.rest().len())
    }

    #[cold]
    #[inline(never)]
    pub(super) fn invalid_number(&self, word: &[u8]) -> ParseError {
        ParseError::InvalidNumber { line: self.line, text: excerpt(word) }
    }

    #[cold]
    #[inline(never)]
    pub(super) fn syntax(&self, problem: impl Into<String>) -> ParseError {
        ParseError::InvalidSyntax { line: self.line, problem: problem.into() }
    }

    #[cold]
    #[inline(never)]
    pub(super) fn unexpected_end(&self, expected: &str) -> ParseError {
        ParseError::UnexpectedEnd { line: self.line, expected: expected.to_owned() }
    }

    fn skip_blanks(&mut self) {
        loop {
            let rest = self.rest();
            let blanks = rest.iter().position(|&byte| !is_blank(byte)).unwrap_or(rest.len());
            self.position += blanks;
            match self.bytes.get(self.position) {
                Some(b'\\') if self.continuations && is_end_of_line(&rest[blanks + 1..]) => {
                    self.position += 1;
                    self.pass_line_end();
                }
                Some(&byte) if byte == self.comment => {
                    let rest = self.rest();
                    self.position += rest.iter().position(|&byte| is_line_end(byte)).unwrap_or(rest.len());
                    return;
                }
                _ => return,
            }
        }
    }

    fn pass_line_end(&mut self) {
        let rest = self.rest();
        let length = match rest {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => 0,
        };
        self.position += length;
        self.line += u64::from(length > 0);
    }
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0b | 0x0c)
}

fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

fn is_end_of_line(rest: &[u8]) -> bool {
    rest.first().is_some_and(|&byte| is_line_end(byte))
}

/// The text after a UTF-8 byte order mark, if there is one.
pub(super) fn without_byte_order_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The beginning of a piece of input, for messages.
#[cold]
#[inline(never)]
pub(super) fn excerpt(piece: &[u8]) -> String {
    let mut text = String::from_utf8_lossy(&piece[..piece.len().min(EXCERPT)]).into_owned();
    if piece.len() > EXCERPT {
        text.push('…');
    }
    text
}

/// Fails unless `expected` bytes are there: called before memory is set aside for what a header promises.
#[inline(never)]
pub(super) fn require(expected: u64, available: usize) -> Result<(), ParseError> {
    if expected > available as u64 {
        return Err(ParseError::Truncated { expected, available: available as u64 });
    }
    Ok(())
}

/// Room for `additional` more and no others, or an error instead of an abort.
pub(super) fn reserve<T>(vector: &mut Vec<T>, additional: usize) -> Result<(), ParseError> {
    if additional <= vector.capacity() - vector.len() {
        return Ok(());
    }
    let bytes = (vector.len() as u64 + additional as u64).saturating_mul(size_of::<T>() as u64);
    memory::ensure(bytes)?;
    vector.try_reserve_exact(additional).map_err(|_| ParseError::OutOfMemory { bytes })
}

/// `count` copies of an element, or an error instead of an abort.
pub(super) fn filled<T: Clone>(element: T, count: usize) -> Result<Vec<T>, ParseError> {
    let mut vector = with_room(count)?;
    vector.resize(count, element);
    Ok(vector)
}

/// Sorts ids by what a comparison says of them: one function for all, for a sort is large.
#[inline(never)]
pub(super) fn sort_ids(ids: &mut [u32], compare: &mut dyn FnMut(u32, u32) -> Ordering) {
    ids.sort_unstable_by(|&a, &b| compare(a, b));
}

/// An empty vector with room for `count` elements, or an error instead of an abort.
pub(super) fn with_room<T>(count: usize) -> Result<Vec<T>, ParseError> {
    let mut vector = Vec::new();
    reserve(&mut vector, count)?;
    Ok(vector)
}

/// Room for `additional` more, or an error instead of an abort. A vector that has to grow at all grows by half, so that many small
/// additions take no more than linear time.
#[inline]
pub(super) fn room<T>(vector: &mut Vec<T>, additional: usize) -> Result<(), ParseError> {
    if additional <= vector.capacity() - vector.len() { Ok(()) } else { grow(vector, additional) }
}

#[cold]
#[inline(never)]
fn grow<T>(vector: &mut Vec<T>, additional: usize) -> Result<(), ParseError> {
    reserve(vector, additional.max(vector.len() / 2).max(FIRST_ROOM))
}

/// Adds an element, or fails where there is no memory for it.
#[inline]
pub(super) fn push<T>(vector: &mut Vec<T>, element: T) -> Result<(), ParseError> {
    room(vector, 1)?;
    vector.push(element);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(scanner: &mut Scanner<'_>) -> Vec<(u64, String)> {
        let mut all = Vec::new();
        while let Some(word) = scanner.word() {
            all.push((scanner.line(), excerpt(word)));
        }
        all
    }

    #[test]
    fn lines_are_counted_whatever_ends_them() {
        let expected = [(1, "a"), (1, "b"), (3, "c"), (4, "d")].map(|(line, word)| (line, word.to_owned()));
        for text in ["a b\n\nc\nd", "a\tb\r\n\r\nc \r\nd\r\n", "a b\r\rc\rd", "\u{feff}a b\n\n c\nd\n"] {
            assert_eq!(words(&mut Scanner::new(text.as_bytes())), expected, "{text:?}");
        }
    }

    #[test]
    fn comments_and_continuations_are_left_out() {
        let mut scanner = Scanner::new(b"# x \\\na \\\n b\\\r\nc#d #e\ne\\f \\").with_comments().with_continuations();
        let expected = [(2, "a"), (3, "b"), (4, "c#d"), (5, "e\\f"), (5, "\\")];
        let found = words(&mut scanner);
        // A backslash that ends the text joins nothing.
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(expected) {
            assert_eq!((found.0, found.1.as_str()), expected);
        }
    }

    #[test]
    fn the_rest_of_a_line_spans_continuations() {
        let mut scanner = Scanner::new(b"f 1 2 \\\n 3\nv").with_continuations();
        assert_eq!(scanner.word(), Some(&b"f"[..]));
        assert_eq!(scanner.rest_of_line(), b" 1 2 \\\n 3");
        assert_eq!(scanner.word(), Some(&b"v"[..]));
        assert_eq!(scanner.line(), 3);
    }

    #[test]
    fn binary_data_start_after_one_line_end_of_the_files_kind() {
        for (text, rest) in [("a\nb\n\nx", "\nx"), ("a\r\nb\r\n\nx", "\nx"), ("a\rb\r\nx", "\nx"), ("a\nb \t\nx", "x")]
        {
            let mut scanner = Scanner::new(text.as_bytes());
            scanner.rest_of_line();
            scanner.word_in_row();
            scanner.start_of_binary();
            assert_eq!(scanner.rest(), rest.as_bytes(), "{text:?}");
        }
    }
}
