//! JSON as far as glTF needs it.

use std::borrow::Cow;

use super::number::parse_number;
use super::packed::damaged;
use super::scan::push;
use crate::error::ParseError;

/// How deep lists and objects may be nested: no scene needs more, and the stack is not boundless.
const DEEPEST: usize = 64;

/// A value.
#[derive(Debug, PartialEq)]
pub(super) enum Json<'a> {
    /// `null` or `false`.
    Nothing,
    True,
    Number(f64),
    Text(Cow<'a, str>),
    List(Vec<Json<'a>>),
    Object(Vec<(Cow<'a, str>, Json<'a>)>),
}

impl<'a> Json<'a> {
    pub(super) fn parse(text: &'a str) -> Result<Self, ParseError> {
        let mut parser = Parser { text, position: 0, depth: 0 };
        parser.value()
    }

    /// What an object has under a name.
    pub(super) fn get(&self, name: &str) -> Option<&Self> {
        match self {
            Self::Object(entries) => entries.iter().find(|(key, _)| key == name).map(|(_, value)| value),
            _ => None,
        }
    }

    /// The entries of a list; none where this is no list or there is nothing.
    pub(super) fn list(&self, name: &str) -> &[Self] {
        match self.get(name) {
            Some(Self::List(values)) => values,
            _ => &[],
        }
    }

    pub(super) fn entries(&self) -> &[(Cow<'a, str>, Self)] {
        match self {
            Self::Object(entries) => entries,
            _ => &[],
        }
    }

    pub(super) fn text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    pub(super) fn number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }

    /// A number of things or an id.
    pub(super) fn count(&self) -> Option<u64> {
        self.number().filter(|number| number.fract() == 0.0 && (0.0..9e15).contains(number)).map(|number| number as u64)
    }

    /// What an object has under a name, as a number of things or an id.
    pub(super) fn count_of(&self, name: &str) -> Option<u64> {
        self.get(name)?.count()
    }
}

struct Parser<'a> {
    text: &'a str,
    position: usize,
    depth: usize,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a [u8] {
        &self.text.as_bytes()[self.position..]
    }

    fn peek(&mut self) -> Result<u8, ParseError> {
        let rest = self.rest();
        self.position += rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
        self.rest().first().copied().ok_or_else(|| damaged("the JSON text ends too early"))
    }

    fn expect(&mut self, byte: u8) -> Result<(), ParseError> {
        if self.peek()? != byte {
            return Err(self.error());
        }
        self.position += 1;
        Ok(())
    }

    fn error(&self) -> ParseError {
        damaged(&format!("the JSON text is damaged at byte {}", self.position))
    }

    /// Whether another entry follows, or the closing sign.
    fn goes_on(&mut self, end: u8) -> Result<bool, ParseError> {
        match self.peek()? {
            b',' => {
                self.position += 1;
                Ok(true)
            }
            byte if byte == end => {
                self.position += 1;
                Ok(false)
            }
            _ => Err(self.error()),
        }
    }

    fn open(&mut self, end: u8) -> Result<bool, ParseError> {
        self.position += 1;
        if self.peek()? == end {
            self.position += 1;
            return Ok(false);
        }
        self.depth += 1;
        if self.depth > DEEPEST { Err(self.error()) } else { Ok(true) }
    }

    fn value(&mut self) -> Result<Json<'a>, ParseError> {
        match self.peek()? {
            b'{' => {
                let mut entries = Vec::new();
                if self.open(b'}')? {
                    loop {
                        self.peek()?;
                        let key = self.string()?;
                        self.expect(b':')?;
                        let value = self.value()?;
                        push(&mut entries, (key, value))?;
                        if !self.goes_on(b'}')? {
                            break;
                        }
                    }
                    self.depth -= 1;
                }
                Ok(Json::Object(entries))
            }
            b'[' => {
                let mut values = Vec::new();
                if self.open(b']')? {
                    loop {
                        let value = self.value()?;
                        push(&mut values, value)?;
                        if !self.goes_on(b']')? {
                            break;
                        }
                    }
                    self.depth -= 1;
                }
                Ok(Json::List(values))
            }
            b'"' => self.string().map(Json::Text),
            _ => {
                let rest = self.rest();
                let is_end = |byte: &u8| b",]}".contains(byte) || byte.is_ascii_whitespace();
                let length = rest.iter().position(is_end).unwrap_or(rest.len());
                let value = match &rest[..length] {
                    b"null" | b"false" => Json::Nothing,
                    b"true" => Json::True,
                    word => Json::Number(parse_number(word).ok_or_else(|| self.error())?),
                };
                self.position += length;
                Ok(value)
            }
        }
    }

    fn string(&mut self) -> Result<Cow<'a, str>, ParseError> {
        self.expect(b'"')?;
        let start = self.position;
        let mut has_escapes = false;
        loop {
            let rest = self.rest();
            let length = rest.iter().position(|byte| matches!(byte, b'"' | b'\\')).ok_or_else(|| self.error())?;
            self.position += length;
            if rest[length] == b'"' {
                break;
            }
            has_escapes = true;
            // What follows is part of the text, whatever it is; it may have more than one byte.
            self.position += 2;
            if !self.text.is_char_boundary(self.position) {
                return Err(self.error());
            }
        }
        let text = &self.text[start..self.position];
        self.position += 1;
        Ok(if has_escapes { Cow::Owned(unescape(text)) } else { Cow::Borrowed(text) })
    }
}

fn unescape(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        if letter != '\\' {
            plain.push(letter);
            continue;
        }
        match letters.next() {
            Some('n') => plain.push('\n'),
            Some('t') => plain.push('\t'),
            Some('r') => plain.push('\r'),
            Some('b' | 'f') => plain.push(' '),
            Some('u') => {
                let code = letters.by_ref().take(4).fold(0, |code, digit| 16 * code + digit.to_digit(16).unwrap_or(0));
                plain.push(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER));
            }
            Some(other) => plain.push(other),
            None => {}
        }
    }
    plain
}
