//! The arrays of VTK's XML files: text, base64 or appended bytes, perhaps compressed.

use super::super::cursor::{Cursor, NumberType};
use super::super::number::{parse_integer, parse_number};
use super::super::packed::{base64, damaged, inflate, most_unpacked};
use super::super::scan::{Scanner, require};
use super::super::xml::Element;
use crate::error::ParseError;

/// Where an array's numbers are.
#[derive(Debug, Clone, Copy)]
enum Source<'a> {
    Nowhere,
    Text(&'a [u8]),
    Base64(&'a [u8]),
    /// So many bytes after the start of the appended data.
    Appended(u64),
}

/// An array as it is declared.
#[derive(Debug, Clone)]
pub(super) struct DataArray<'a> {
    pub(super) name: String,
    /// None for texts and bits.
    kind: Option<NumberType>,
    pub(super) components: u64,
    source: Source<'a>,
    is_binary: bool,
}

impl<'a> DataArray<'a> {
    pub(super) fn new(element: &Element) -> Result<Self, ParseError> {
        let kind = match element.attribute("type").unwrap_or_default() {
            "Int8" => Some(NumberType::I8),
            "UInt8" => Some(NumberType::U8),
            "Int16" => Some(NumberType::I16),
            "UInt16" => Some(NumberType::U16),
            "Int32" => Some(NumberType::I32),
            "UInt32" => Some(NumberType::U32),
            "Int64" => Some(NumberType::I64),
            "UInt64" => Some(NumberType::U64),
            "Float32" => Some(NumberType::F32),
            "Float64" => Some(NumberType::F64),
            _ => None,
        };
        let format = element.attribute("format").unwrap_or("ascii");
        let source = match (format, element.count("offset")?) {
            ("appended", Some(offset)) => Source::Appended(offset),
            ("appended", None) => return Err(damaged("an appended array has no offset")),
            _ => Source::Nowhere,
        };
        let name = element.attribute("Name").unwrap_or_default().to_owned();
        let components = element.count("NumberOfComponents")?.unwrap_or(1).max(1);
        Ok(Self { name, kind, components, source, is_binary: format == "binary" })
    }

    /// Takes the text in an array's element; other elements may stand in it, and blanks around them.
    pub(super) fn take_text(&mut self, text: &'a [u8]) {
        if matches!(self.source, Source::Nowhere) && !text.trim_ascii().is_empty() {
            self.source = if self.is_binary { Source::Base64(text) } else { Source::Text(text) };
        }
    }

    /// Whether it holds numbers.
    pub(super) fn is_numeric(&self) -> bool {
        self.kind.is_some()
    }

    pub(super) fn is_real(&self) -> bool {
        matches!(self.kind, Some(NumberType::F32 | NumberType::F64))
    }
}

/// What a file says about its arrays.
pub(super) struct Storage<'a> {
    pub(super) big_endian: bool,
    /// Whether sizes have eight bytes, or else four.
    pub(super) has_long_sizes: bool,
    pub(super) compressor: Option<String>,
    /// What comes after the mark of appended data.
    pub(super) appended: &'a [u8],
    pub(super) is_appended_base64: bool,
    /// The bytes of the file.
    pub(super) length: usize,
}

impl<'a> Storage<'a> {
    /// Hands on the numbers of an array.
    pub(super) fn numbers(&self, array: &DataArray<'a>, visit: &mut dyn FnMut(f64)) -> Result<(), ParseError> {
        let Some(kind) = array.kind else { return Ok(()) };
        if let Source::Text(text) = array.source {
            let mut text = Scanner::new(text);
            while let Some(word) = text.word() {
                visit(parse_number(word).ok_or_else(|| text.invalid_number(word))?);
            }
            return Ok(());
        }
        self.with_bytes(array, &mut |bytes| {
            let mut data = Cursor::new(bytes, self.big_endian);
            for _ in 0..bytes.len() as u64 / kind.size() {
                visit(data.number(kind)?);
            }
            Ok(())
        })
    }

    /// Hands on the ids of an array.
    pub(super) fn ids(
        &self,
        array: &DataArray<'a>,
        visit: &mut dyn FnMut(i64) -> Result<(), ParseError>,
    ) -> Result<(), ParseError> {
        let Some(kind) = array.kind else { return Err(damaged("ids are texts or bits")) };
        if let Source::Text(text) = array.source {
            let mut text = Scanner::new(text);
            while let Some(word) = text.word() {
                visit(parse_integer(word).ok_or_else(|| text.invalid_number(word))?)?;
            }
            return Ok(());
        }
        self.with_bytes(array, &mut |bytes| {
            let mut data = Cursor::new(bytes, self.big_endian);
            for _ in 0..bytes.len() as u64 / kind.size() {
                visit(data.integer(kind)?)?;
            }
            Ok(())
        })
    }

    /// An array's bytes, unpacked.
    fn with_bytes(
        &self,
        array: &DataArray<'a>,
        visit: &mut dyn FnMut(&[u8]) -> Result<(), ParseError>,
    ) -> Result<(), ParseError> {
        let (text, is_base64) = match array.source {
            Source::Nowhere | Source::Text(_) => return Ok(()),
            Source::Base64(text) => (text, true),
            Source::Appended(offset) => {
                require(offset, self.appended.len())?;
                (&self.appended[offset as usize..], self.is_appended_base64)
            }
        };
        let word = if self.has_long_sizes { 8 } else { 4 };
        if !is_base64 {
            return self.unpack(text, visit);
        }
        // How much of the text belongs to the array stands at its beginning.
        let sizes = |count: usize| base64(text, word * count);
        let head = match &self.compressor {
            None => 1,
            Some(_) => 3 + self.size(&sizes(1)?, 0)? as usize,
        };
        require((head as u64).saturating_mul(word as u64), text.len())?;
        let start = sizes(head)?;
        let body = if self.compressor.is_none() {
            self.size(&start, 0)?
        } else {
            (3..head)
                .try_fold(0_u64, |sum, place| Ok::<_, ParseError>(sum.saturating_add(self.size(&start, place)?)))?
        };
        let whole = (head * word) as u64;
        require(body, text.len())?;
        self.unpack(&base64(text, (whole + body) as usize)?, visit)
    }

    /// One of the sizes at the beginning of an array's bytes.
    fn size(&self, bytes: &[u8], place: usize) -> Result<u64, ParseError> {
        let kind = if self.has_long_sizes { NumberType::U64 } else { NumberType::U32 };
        let mut data = Cursor::new(bytes, self.big_endian);
        data.skip(kind.size() * place as u64)?;
        let size = data.integer(kind)?;
        Ok(size as u64)
    }

    fn unpack(&self, bytes: &[u8], visit: &mut dyn FnMut(&[u8]) -> Result<(), ParseError>) -> Result<(), ParseError> {
        let word = if self.has_long_sizes { 8 } else { 4 };
        let Some(compressor) = &self.compressor else {
            let length = self.size(bytes, 0)?;
            let body = &bytes[word..];
            require(length, body.len())?;
            return visit(&body[..length as usize]);
        };
        if compressor != "vtkZLibDataCompressor" {
            let feature = format!("data packed by `{compressor}`");
            return Err(ParseError::UnsupportedFeature { format: "VTK XML".to_owned(), feature });
        }
        let blocks = self.size(bytes, 0)?;
        require(blocks.saturating_add(3).saturating_mul(word as u64), bytes.len())?;
        let (size, last) = (self.size(bytes, 1)?, self.size(bytes, 2)?);
        let mut rest = &bytes[word * (3 + blocks as usize)..];
        let most = most_unpacked(self.length);
        let mut out = Vec::new();
        for block in 0..blocks as usize {
            let packed = self.size(bytes, 3 + block)?;
            require(packed, rest.len())?;
            let (own, others) = rest.split_at(packed as usize);
            rest = others;
            let is_last = block + 1 == blocks as usize && last > 0;
            let expected = if is_last { last } else { size };
            let left = most.saturating_sub(out.len() as u64);
            if expected > left {
                return Err(ParseError::TooLarge { element: "unpacked bytes".to_owned(), count: expected });
            }
            inflate(own, &mut out, Some(expected as usize), left, true)?;
        }
        visit(&out)
    }
}
