//! The buffers of a glTF file and the numbers in them.

use std::borrow::Cow;

use super::super::cursor::{Cursor, NumberType};
use super::super::json::Json;
use super::super::mesh_data::MeshFormat;
use super::super::packed::{base64, damaged};
use super::super::scan::{push, require};
use crate::error::ParseError;

/// How binary files begin, and what their chunks are called.
pub(super) const MAGIC: &[u8] = b"glTF";
pub(super) const JSON_CHUNK: u32 = 0x4e4f_534a;
pub(super) const BINARY_CHUNK: u32 = 0x004e_4942;

/// A document with its buffers.
pub(super) struct Scene<'a> {
    pub(super) json: Json<'a>,
    buffers: Vec<Cow<'a, [u8]>>,
}

/// Numbers of a buffer: so many items of so many components.
pub(super) struct Accessor {
    pub(super) count: u64,
    pub(super) components: u64,
    kind: NumberType,
    /// Where the first item starts, how far the items are apart, in which buffer.
    start: u64,
    stride: u64,
    buffer: usize,
    /// What integers are divided by.
    scale: f64,
}

impl<'a> Scene<'a> {
    pub(super) fn new(json: Json<'a>, binary: &'a [u8]) -> Result<Self, ParseError> {
        let mut buffers = Vec::new();
        for buffer in json.list("buffers") {
            let content = match buffer.get("uri").and_then(Json::text) {
                None => Cow::Borrowed(binary),
                Some(uri) => {
                    let data = uri.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,"));
                    let data = data.ok_or_else(|| unsupported("buffers in other files"))?.1;
                    Cow::Owned(base64(data.as_bytes(), usize::MAX)?)
                }
            };
            push(&mut buffers, content)?;
        }
        Ok(Self { json, buffers })
    }

    /// What a list of the document has at a place.
    pub(super) fn item(&self, list: &str, place: u64) -> Result<&Json<'a>, ParseError> {
        let items = self.json.list(list);
        items.get(place as usize).ok_or_else(|| damaged(&format!("`{list}` has no entry {place}")))
    }

    /// An accessor, once its bytes are known to be there.
    pub(super) fn accessor(&self, place: u64) -> Result<Accessor, ParseError> {
        let accessor = self.item("accessors", place)?;
        if accessor.get("sparse").is_some() {
            return Err(unsupported("sparse accessors"));
        }
        let (kind, largest) = match accessor.count_of("componentType") {
            Some(5120) => (NumberType::I8, 127.0),
            Some(5121) => (NumberType::U8, 255.0),
            Some(5122) => (NumberType::I16, 32_767.0),
            Some(5123) => (NumberType::U16, 65_535.0),
            Some(5125) => (NumberType::U32, 4_294_967_295.0),
            Some(5126) => (NumberType::F32, 1.0),
            _ => return Err(damaged("an accessor has no type of its components")),
        };
        let components = match accessor.get("type").and_then(Json::text) {
            Some("SCALAR") => 1,
            Some("VEC2") => 2,
            Some("VEC3") => 3,
            Some("VEC4") => 4,
            _ => return Err(unsupported("matrices as attributes")),
        };
        let count = accessor.count_of("count").unwrap_or(0);
        let view = accessor.count_of("bufferView").ok_or_else(|| unsupported("accessors without data"))?;
        let view = self.item("bufferViews", view)?;
        let buffer = view.count_of("buffer").unwrap_or(0) as usize;
        let size = components * kind.size();
        let stride = view.count_of("byteStride").unwrap_or(size).max(size);
        let within = accessor.count_of("byteOffset").unwrap_or(0);
        let start = view.count_of("byteOffset").unwrap_or(0).saturating_add(within);
        let available = self.buffers.get(buffer).map_or(0, |buffer| buffer.len());
        if count > 0 {
            let end = start.saturating_add(stride.saturating_mul(count - 1)).saturating_add(size);
            require(end, available)?;
        }
        // Only where the file says so do integers stand for fractions.
        let is_normalized = matches!(accessor.get("normalized"), Some(Json::True));
        let scale = if is_normalized { largest } else { 1.0 };
        Ok(Accessor { count, components, kind, start, stride, buffer, scale })
    }

    /// Hands on all numbers.
    pub(super) fn numbers(
        &self,
        accessor: &Accessor,
        visit: &mut dyn FnMut(f64) -> Result<(), ParseError>,
    ) -> Result<(), ParseError> {
        for item in 0..accessor.count {
            let start = (accessor.start + item * accessor.stride) as usize;
            let mut data = Cursor::new(&self.buffers[accessor.buffer][start..], false);
            for _ in 0..accessor.components {
                visit(data.number(accessor.kind)? / accessor.scale)?;
            }
        }
        Ok(())
    }
}

#[cold]
pub(super) fn unsupported(feature: &str) -> ParseError {
    ParseError::UnsupportedFeature { format: MeshFormat::Glb.name().to_owned(), feature: feature.to_owned() }
}
