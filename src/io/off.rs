//! Object File Format: a keyword, three counts, vertices, faces. Text only; what counts is words, not lines.

use super::assembly::{Assembly, check_count};
use super::format::{Format, Writer};
use super::mesh_data::{MeshData, MeshFormat};
use super::number::{parse_count, parse_integer, parse_number};
use super::scan::{Scanner, reserve, room};
use super::writing::{HEADER, Mesh, print, push_faces, push_row};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "off",
    extensions: &["off"],
    description: "Object File Format, text",
    sniff,
    read,
    write: Some(Writer { text: true, binary: false, fields: false, write }),
};

/// What the keyword says about the vertices.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
struct Keyword {
    /// Bytes of the keyword.
    length: usize,
    /// `4` or `n`: points of another dimension than three.
    other_dimension: bool,
    /// `C`, `N` or `ST`: more numbers follow the coordinates.
    attributes: bool,
}

/// Comments may come first.
fn sniff(bytes: &[u8]) -> bool {
    Scanner::new(bytes).with_comments().word().is_some_and(|first| keyword(first).is_some())
}

/// Recognises `[ST][C][N][4][n]OFF`, with or without a count right after it (as the `ModelNet` collection writes it).
fn keyword(word: &[u8]) -> Option<Keyword> {
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
fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
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
    let mut rows = Rows { has_lines: has_lines(text.clone(), vertices + faces), is_continued: None, text };

    let mut assembly = Assembly::default();
    reserve(&mut assembly.positions, vertices as usize * 3)?;
    let mut colored_vertices = 0;
    for _ in 0..vertices {
        rows.begin("a vertex")?;
        for _ in 0..3 {
            let word = rows.word("a vertex needs three coordinates")?;
            assembly.positions.push(parse_number(word).ok_or_else(|| rows.text.invalid_number(word))?);
        }
        colored_vertices += u64::from(rows.end()?);
    }
    assembly.reserve_triangles(faces)?;
    let mut colored_faces = 0;
    for _ in 0..faces {
        rows.begin("a face")?;
        let corners = rows.text.count_in_row("the number of corners")?;
        for _ in 0..corners {
            let word = rows.word("the face has fewer corners than it says")?;
            let corner = parse_integer(word).ok_or_else(|| rows.text.invalid_number(word))?;
            assembly.corner(corner, vertices)?;
        }
        assembly.close_polygon()?;
        colored_faces += u64::from(rows.end()?);
    }
    let mut text = rows.text;
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

/// Whether there are lines enough for every vertex and every face to have its own.
fn has_lines(mut text: Scanner<'_>, wanted: u64) -> bool {
    (0..wanted).all(|_| {
        let is_there = text.next_row();
        text.rest_of_line();
        is_there
    })
}

/// Vertices and faces. Where there are lines enough, each has its own, with perhaps more numbers at the end, or fills several of them;
/// otherwise they just follow each other.
struct Rows<'a> {
    text: Scanner<'a>,
    has_lines: bool,
    /// The line where the vertex or face began that goes on in another one.
    is_continued: Option<u64>,
}

impl<'a> Rows<'a> {
    fn begin(&mut self, what: &str) -> Result<(), ParseError> {
        if self.text.next_row() { Ok(()) } else { Err(self.text.unexpected_end(what)) }
    }

    /// The next word. One that is missing on its line may stand on the next, which has nothing else then: otherwise that is another
    /// vertex or face, and this one is too short.
    fn word(&mut self, problem: &'static str) -> Result<&'a [u8], ParseError> {
        if let Some(word) = self.text.word_in_row() {
            return Ok(word);
        }
        let here = self.text.clone();
        let word = self.text.word().ok_or_else(|| here.syntax(problem))?;
        self.is_continued.get_or_insert(here.line());
        Ok(word)
    }

    /// Passes over what is left of the line; whether there was anything.
    fn end(&mut self) -> Result<bool, ParseError> {
        if !self.has_lines {
            return Ok(false);
        }
        let has_more = self.text.word_in_row().is_some();
        if let Some(line) = self.is_continued.take()
            && has_more
        {
            let problem = "this line has fewer numbers than it needs, and the next one more".to_owned();
            return Err(ParseError::InvalidSyntax { line, problem });
        }
        self.text.rest_of_line();
        Ok(has_more)
    }
}

fn write(out: &mut Vec<u8>, mesh: &Mesh<'_>, _binary: bool) -> Result<(), ParseError> {
    room(out, HEADER)?;
    print(out, format_args!("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.triangle_count()));
    for point in mesh.positions.chunks_exact(3) {
        push_row(out, point)?;
    }
    push_faces(out, mesh.triangles)
}

fn unsupported(feature: &str) -> ParseError {
    ParseError::UnsupportedFeature { format: MeshFormat::Off.name().to_owned(), feature: feature.to_owned() }
}
