//! What a format of meshes is: every file of this folder that reads one has such a constant, and `formats.rs` lists them.

use super::mesh_data::MeshData;
use super::writing::Mesh;
use crate::error::ParseError;

/// What there is of a format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormatInfo {
    /// Its name, as options take it.
    pub name: &'static str,
    /// The usual endings of its files, without a dot.
    pub extensions: &'static [&'static str],
    /// Whether it can be read.
    pub reads: bool,
    /// Whether it can be written.
    pub writes: bool,
    /// One line for people.
    pub description: &'static str,
}

/// A format of meshes.
pub(super) struct Format {
    pub(super) name: &'static str,
    /// The usual endings of its files.
    pub(super) extensions: &'static [&'static str],
    pub(super) description: &'static str,
    /// Whether bytes are of this format. Formats that are further down in the list are asked first.
    pub(super) sniff: fn(&[u8]) -> bool,
    pub(super) read: fn(&[u8]) -> Result<MeshData, ParseError>,
    pub(super) write: Option<Writer>,
}

/// How a format is written.
#[derive(Clone, Copy)]
pub(super) struct Writer {
    /// Whether it can be text, and whether it can be binary.
    pub(super) text: bool,
    pub(super) binary: bool,
    /// Whether there is room for fields.
    pub(super) fields: bool,
    /// Writes a mesh that was checked; the last argument says whether as binary.
    pub(super) write: fn(&mut Vec<u8>, &Mesh<'_>, bool) -> Result<(), ParseError>,
}

impl Format {
    /// What users are told of it.
    pub(super) const fn info(&self) -> FormatInfo {
        FormatInfo {
            name: self.name,
            extensions: self.extensions,
            reads: true,
            writes: self.write.is_some(),
            description: self.description,
        }
    }
}
