//! XML as the readers need it: elements with their attributes, and the text between.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::packed::damaged;
use super::scan::push;
use crate::error::ParseError;

/// What comes next in a document.
pub(super) enum Part<'a> {
    Start(Element),
    End(String),
    Text(&'a [u8]),
}

/// The start of an element.
pub(super) struct Element {
    pub(super) name: String,
    attributes: Vec<(String, String)>,
}

impl Element {
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// An attribute that is a number of things.
    pub(super) fn count(&self, name: &str) -> Result<Option<u64>, ParseError> {
        let Some(value) = self.attribute(name) else { return Ok(None) };
        let count = value.trim().parse().map_err(|_| damaged(&format!("`{name}=\"{value}\"` is no number")))?;
        Ok(Some(count))
    }

    fn new(start: &BytesStart<'_>) -> Result<Self, ParseError> {
        let mut attributes = Vec::new();
        for attribute in start.attributes().with_checks(false).flatten() {
            let value = &attribute.value;
            let value = if value.contains('&') { unescape(value) } else { value.clone().into_owned() };
            push(&mut attributes, (attribute.key.as_ref().to_owned(), value))?;
        }
        Ok(Self { name: start.name().as_ref().to_owned(), attributes })
    }
}

/// Undoes the five entities that every document has.
fn unescape(text: &str) -> String {
    let plain = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&apos;", "'");
    plain.replace("&amp;", "&")
}

/// Goes through a document.
pub(super) struct Document<'a> {
    reader: Reader<&'a [u8]>,
    bytes: &'a [u8],
    /// The end of an element without content, which is told as a start and an end.
    end: Option<String>,
}

impl<'a> Document<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let mut reader = Reader::from_reader(bytes);
        reader.config_mut().check_end_names = false;
        Self { reader, bytes, end: None }
    }

    /// What is next, or nothing at the end. Comments and the like are passed over.
    pub(super) fn next(&mut self) -> Result<Option<Part<'a>>, ParseError> {
        if let Some(name) = self.end.take() {
            return Ok(Some(Part::End(name)));
        }
        loop {
            let before = self.reader.buffer_position() as usize;
            let event = self.reader.read_event();
            // Without the error's own words, which would be a large part of the reader.
            let event = event.map_err(|_| damaged("the XML document is damaged"))?;
            return Ok(Some(match event {
                Event::Start(start) => Part::Start(Element::new(&start)?),
                Event::Empty(start) => {
                    let element = Element::new(&start)?;
                    self.end = Some(element.name.clone());
                    Part::Start(element)
                }
                Event::End(end) => Part::End(end.name().as_ref().to_owned()),
                Event::Text(_) => Part::Text(self.between(before)),
                Event::CData(_) => {
                    let text = self.between(before);
                    let text = text.strip_prefix(b"<![CDATA[").unwrap_or(text);
                    Part::Text(text.strip_suffix(b"]]>").unwrap_or(text))
                }
                Event::Eof => return Ok(None),
                _ => continue,
            }));
        }
    }

    /// Everything that has not been gone through.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.between_ends(self.reader.buffer_position() as usize, self.bytes.len())
    }

    fn between(&self, start: usize) -> &'a [u8] {
        self.between_ends(start, self.reader.buffer_position() as usize)
    }

    fn between_ends(&self, start: usize, end: usize) -> &'a [u8] {
        self.bytes.get(start..end.min(self.bytes.len())).unwrap_or_default()
    }
}

/// Whether a document's first element has this name.
pub(super) fn starts_with(bytes: &[u8], name: &[u8]) -> bool {
    let start = super::scan::without_byte_order_mark(bytes).trim_ascii_start();
    let head = &start[..start.len().min(1024)];
    start.starts_with(b"<") && head.windows(name.len()).any(|window| window == name)
}
