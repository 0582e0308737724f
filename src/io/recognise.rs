//! What bytes seem to be that no reader takes, so that a message can say it.

use super::formats::formats;
use crate::error::ParseError;

/// How files begin that people take for meshes or fields, and what they are. Those that are read are here too, for the
/// calls that do not read them.
const BEGINNINGS: &[(&[u8], &str)] = &[
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"\x89PNG", "a PNG picture"),
    (b"GIF8", "a GIF picture"),
    (b"II*\0", "a TIFF picture"),
    (b"MM\0*", "a TIFF picture"),
    (b"\x1f\x8b", "compressed by gzip"),
    (b"BZh", "compressed by bzip2"),
    (b"\xfd7zXZ", "compressed by xz"),
    (b"(\xb5/\xfd", "compressed by zstd"),
    (b"7z\xbc\xaf", "a 7z archive"),
    (b"Rar!", "a RAR archive"),
    (b"PK\x03\x04", "a ZIP archive (or a document or 3MF mesh, which are archives)"),
    (b"%PDF", "a PDF document"),
    (b"\x89HDF", "an HDF5 file"),
    (b"CDF\x01", "a NetCDF file"),
    (b"CDF\x02", "a NetCDF file"),
    (b"\x93NUMPY", "an array of NumPy, which is a field and no mesh"),
    (b"MATLAB", "a MATLAB file"),
    (b"n+1\0", "a NIfTI volume"),
    (b"Kaydara FBX", "an FBX scene"),
    (b"ISO-10303-21", "a STEP model, which has no triangles yet"),
    (b"#VRML", "a VRML scene"),
    (b"DSAA", "a Surfer grid"),
    (b"<svg", "an SVG picture"),
];

/// Names in XML documents that tell what they are.
const DOCUMENTS: &[(&[u8], &str)] = &[
    (b"<GIFTI", "a GIFTI file"),
    (b"<VTKFile", "a VTK XML file"),
    (b"<COLLADA", "a COLLADA scene"),
    (b"<X3D", "an X3D scene"),
    (b"<svg", "an SVG picture"),
    (b"<html", "a page of the web, perhaps an error message of a server"),
    (b"<!doctype html", "a page of the web, perhaps an error message of a server"),
];

/// What bytes seem to be, as it stands after "it seems to be".
pub(super) fn guess(bytes: &[u8]) -> &'static str {
    let start = &bytes[..bytes.len().min(2048)];
    let text = start.trim_ascii_start();
    if let Some((_, what)) = BEGINNINGS.iter().find(|(beginning, _)| start.starts_with(beginning)) {
        return what;
    }
    let holds = |name: &[u8]| start.windows(name.len()).any(|window| window.eq_ignore_ascii_case(name));
    if text.starts_with(b"<") {
        let known = DOCUMENTS.iter().find(|(name, _)| holds(name));
        return known.map_or("an XML document", |(_, what)| what);
    }
    if text.starts_with(b"{") || text.starts_with(b"[") {
        return "JSON";
    }
    if start.contains(&0) || core::str::from_utf8(start).is_err_and(|error| error.error_len().is_some()) {
        return "binary data of a kind that is not known here";
    }
    let numbers = text.split(|byte| b" \t\r\n,;|".contains(byte)).filter(|word| !word.is_empty()).take(20);
    let are_numbers = numbers.map(super::number::parse_number).filter(Option::is_some).count() >= 3;
    if are_numbers { "a table of numbers, which is a field and no mesh" } else { "text" }
}

/// The error that says what bytes seem to be, and what could be read.
#[cold]
pub(super) fn unknown_format(bytes: &[u8]) -> ParseError {
    let names: Vec<&str> = formats().iter().filter(|format| format.reads).map(|format| format.name).collect();
    ParseError::UnknownFormat { seems: guess(bytes).to_owned(), formats: names.join(", ") }
}
