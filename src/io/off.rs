//! Object File Format: a keyword, three counts, vertices, faces. Text only.

use super::assembly::{Assembly, check_count};
use super::mesh_data::{MeshData, MeshFormat};
use super::scan::{Scanner, parse_count, parse_integer, parse_number, reserve};
use crate::error::ParseError;

/// What the keyword says about the vertices.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) struct Keyword {
    /// Bytes of the keyword.
    length: usize,
    /// `4` or `n`: points of another dimension than three.
    other_dimension: bool,
    /// `C`, `N` or `ST`: more numbers follow the coordinates.
    attributes: bool,
}

/// Recognises `[ST][C][N][4][n]OFF`, with or without a count right after it (as the `ModelNet` collection writes it).
pub(super) fn keyword(word: &[u8]) -> Option<Keyword> {
    let mut rest = word;
    let mut keyword = Keyword::default();
    for prefix in ["ST", "C", "N", "4", "n"] {
        if let Some(after) = rest.strip_prefix(prefix.as_bytes()) {
            rest = after;
            match prefix {
                "4" | "n" => keyword.other_dimension = true,
                _ => keyword.attributes = true,
            }
        }
    }
    let after = rest.strip_prefix(b"OFF").or_else(|| rest.strip_prefix(b"off"))?;
    keyword.length = word.len() - after.len();
    (after.is_empty() || after[0].is_ascii_digit()).then_some(keyword)
}

/// Reads an OFF file; colors, normals and texture coordinates are left out with a warning.
pub(super) fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut text = Scanner::new(bytes).with_comments();
    let mut found = Keyword::default();
    if let Some(word) = text.peek_word()
        && let Some(keyword) = keyword(word)
    {
        found = keyword;
        text.next_row();
        text.advance(keyword.length);
    }
    if found.other_dimension {
        return Err(unsupported("points that are not three-dimensional"));
    }
    if text.peek_word() == Some(b"BINARY") {
        return Err(unsupported("binary data"));
    }
    if !text.next_row() {
        return Err(text.unexpected_end("the numbers of vertices and faces"));
    }
    let vertices = text.count_in_row("the number of vertices")?;
    let faces = text.count_in_row("the number of faces")?;
    // The number of edges, which some writers leave out and nobody needs.
    if let Some(word) = text.word_in_row()
        && parse_count(word).is_none()
    {
        return Err(text.invalid_number(word));
    }
    text.rest_of_line();
    check_count("vertices", vertices)?;
    check_count("faces", faces)?;
    text.require_numbers(vertices.saturating_mul(3).saturating_add(faces))?;

    let mut assembly = Assembly::default();
    reserve(&mut assembly.positions, vertices as usize * 3)?;
    let mut colored_vertices = 0;
    for _ in 0..vertices {
        if !text.next_row() {
            return Err(text.unexpected_end("a vertex"));
        }
        for _ in 0..3 {
            let Some(word) = text.word_in_row() else {
                return Err(text.syntax("a vertex needs three coordinates"));
            };
            assembly.positions.push(parse_number(word).ok_or_else(|| text.invalid_number(word))?);
        }
        colored_vertices += u64::from(text.word_in_row().is_some());
        text.rest_of_line();
    }
    assembly.reserve_triangles(faces)?;
    let mut colored_faces = 0;
    for _ in 0..faces {
        if !text.next_row() {
            return Err(text.unexpected_end("a face"));
        }
        let corners = text.count_in_row("the number of corners")?;
        for _ in 0..corners {
            let Some(word) = text.word_in_row() else {
                return Err(text.syntax(format!("the face has fewer than its {corners} corners")));
            };
            let corner = parse_integer(word).ok_or_else(|| text.invalid_number(word))?;
            assembly.corner(corner, vertices)?;
        }
        assembly.close_polygon()?;
        colored_faces += u64::from(text.word_in_row().is_some());
        text.rest_of_line();
    }
    if colored_vertices > 0 {
        let what = if found.attributes { "colors, normals or texture coordinates" } else { "numbers after z" };
        assembly.skipped(format!("{what} of {colored_vertices} vertices"), colored_vertices);
    }
    if colored_faces > 0 {
        assembly.skipped(format!("colors of {colored_faces} faces"), colored_faces);
    }
    if text.next_row() {
        assembly.skipped("text after the last face", 1);
    }
    assembly.finish(MeshFormat::Off)
}

fn unsupported(feature: &str) -> ParseError {
    ParseError::UnsupportedFeature { format: MeshFormat::Off.name().to_owned(), feature: feature.to_owned() }
}
