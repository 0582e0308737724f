//! What the readers share: faces become triangles, fields get unique names, what is left out becomes a warning.

use super::mesh_data::{MeshData, MeshFormat};
use super::names::Names;
use super::polygon::{self, Shape};
use super::scan::{filled, push, reserve, room, with_room};
use crate::error::{Diagnostic, ParseError};

/// Counts things of a kind and keeps the first few.
#[derive(Debug, Default)]
struct Tally {
    count: usize,
    examples: Vec<u32>,
}

impl Tally {
    fn add(&mut self, id: u64) {
        self.count += 1;
        if self.examples.len() < Diagnostic::EXAMPLES {
            self.examples.extend(u32::try_from(id));
        }
    }
}

/// A face that became another number of triangles than one.
#[derive(Debug, Clone, Copy)]
struct Uneven {
    face: u32,
    /// With [`STRIP`] where these are no fan.
    triangles: u32,
}

const STRIP: u32 = 1 << 31;

/// A mesh in the making.
#[derive(Debug, Default)]
pub(super) struct Assembly {
    pub(super) positions: Vec<f64>,
    triangles: Vec<u32>,
    fields: Vec<(String, Vec<f64>)>,
    face_fields: Vec<(String, Vec<f64>)>,
    names: Names,
    face_names: Names,
    warnings: Vec<Diagnostic>,
    corners: Vec<u32>,
    faces: u64,
    uneven: Vec<Uneven>,
    short: Tally,
    polygons: Tally,
    /// Whether vertices that no triangle has are left out.
    only_used: bool,
}

impl Assembly {
    /// Faces closed so far: the id of the face that is being read.
    pub(super) fn faces(&self) -> u64 {
        self.faces
    }

    /// Room for triangles that a header promises; the bytes must have been checked.
    pub(super) fn reserve_triangles(&mut self, count: u64) -> Result<(), ParseError> {
        reserve(&mut self.triangles, (count as usize).saturating_mul(3))
    }

    /// Leaves out the vertices that no triangle has: those inside of a volume, or in the middle of edges.
    pub(super) fn keep_only_used(&mut self) {
        self.only_used = true;
    }

    /// Adds a corner to the face that is being read.
    #[inline(never)]
    pub(super) fn corner(&mut self, index: i64, vertices: u64) -> Result<(), ParseError> {
        match u32::try_from(index) {
            Ok(corner) if u64::from(corner) < vertices => push(&mut self.corners, corner),
            _ => Err(ParseError::FaceIndexOutOfBounds { face: self.faces, index, vertices }),
        }
    }

    /// Ends a polygon. It is a fan around its first corner until all vertices are known.
    #[inline(never)]
    pub(super) fn close_polygon(&mut self) -> Result<(), ParseError> {
        match self.corners.as_slice() {
            [] | [_] | [_, _] => {
                self.short.add(self.faces);
                self.close(0, 0)?;
            }
            [first, others @ ..] => {
                let count = others.len() - 1;
                room(&mut self.triangles, 3 * count)?;
                for pair in others.windows(2) {
                    self.triangles.extend([*first, pair[0], pair[1]]);
                }
                if count > 1 {
                    self.polygons.add(self.faces);
                }
                self.close(count, 0)?;
            }
        }
        Ok(())
    }

    /// Ends a triangle strip: every second triangle is turned round, so that all look the same way.
    pub(super) fn close_strip(&mut self) -> Result<(), ParseError> {
        if self.corners.len() < 3 {
            self.short.add(self.faces);
        }
        let count = self.corners.len().saturating_sub(2);
        room(&mut self.triangles, 3 * count)?;
        for (place, corners) in self.corners.windows(3).enumerate() {
            let [a, b] = if place % 2 == 0 { [corners[0], corners[1]] } else { [corners[1], corners[0]] };
            self.triangles.extend([a, b, corners[2]]);
        }
        self.close(count, STRIP)
    }

    /// Ends a strip, if one has begun.
    pub(super) fn close_open_strip(&mut self) -> Result<(), ParseError> {
        if self.corners.is_empty() { Ok(()) } else { self.close_strip() }
    }

    fn close(&mut self, triangles: usize, kind: u32) -> Result<(), ParseError> {
        if triangles != 1 {
            // More faces or corners than 32-bit ids are refused at the end.
            push(&mut self.uneven, Uneven { face: self.faces as u32, triangles: triangles as u32 & !STRIP | kind })?;
        }
        self.faces += 1;
        self.corners.clear();
        Ok(())
    }

    /// Adds a field with one value per vertex; a name that was there before gets a number.
    #[inline(never)]
    pub(super) fn field(&mut self, name: &str, values: Vec<f64>) {
        let unique = self.names.unique(name);
        self.note_name(name, &unique);
        self.fields.push((unique, values));
    }

    /// Adds a field with one value per face, in the order in which faces are closed.
    #[inline(never)]
    pub(super) fn face_field(&mut self, name: &str, values: Vec<f64>) {
        let unique = self.face_names.unique(name);
        self.note_name(name, &unique);
        self.face_fields.push((unique, values));
    }

    /// Adds values to a field whose pieces come one after the other; these are of the vertices from `first`. What earlier pieces did not
    /// have is missing.
    pub(super) fn more_of_field(&mut self, name: &str, first: u64, values: Vec<f64>) -> Result<(), ParseError> {
        match self.fields.iter_mut().find(|(other, _)| other == name).filter(|_| first > 0) {
            Some((_, all)) => extend(all, first, &values),
            None if first == 0 => {
                self.field(name, values);
                Ok(())
            }
            None => {
                let mut all = Vec::new();
                extend(&mut all, first, &values)?;
                self.field(name, all);
                Ok(())
            }
        }
    }

    /// Adds values to a field on faces, as [`Self::more_of_field`] does.
    pub(super) fn more_of_face_field(&mut self, name: &str, first: u64, values: Vec<f64>) -> Result<(), ParseError> {
        match self.face_fields.iter_mut().find(|(other, _)| other == name).filter(|_| first > 0) {
            Some((_, all)) => extend(all, first, &values),
            None if first == 0 => {
                self.face_field(name, values);
                Ok(())
            }
            None => {
                let mut all = Vec::new();
                extend(&mut all, first, &values)?;
                self.face_field(name, all);
                Ok(())
            }
        }
    }

    /// Fields that the last pieces did not have are missing there.
    pub(super) fn fill_up(&mut self) -> Result<(), ParseError> {
        let vertices = (self.positions.len() / 3) as u64;
        self.fields.iter_mut().try_for_each(|(_, values)| extend(values, vertices, &[]))?;
        let faces = self.faces;
        self.face_fields.iter_mut().try_for_each(|(_, values)| extend(values, faces, &[]))
    }

    fn note_name(&mut self, name: &str, unique: &str) {
        if unique != name {
            self.warn("RenamedField", format!("a second field `{name}` was renamed `{unique}`"), 1);
        }
    }

    /// Says that something was left out.
    #[inline(never)]
    pub(super) fn skipped(&mut self, what: impl Into<String>, count: u64) {
        let what = what.into();
        self.warn("SkippedData", format!("{what} left out"), usize::try_from(count).unwrap_or(usize::MAX));
    }

    #[inline(never)]
    fn warn(&mut self, code: &'static str, message: String, count: usize) {
        self.warnings.push(Diagnostic { code, message, count, examples: Vec::new() });
    }

    fn report(&mut self, tally: Tally, code: &'static str, message: &str) {
        let Tally { count, examples } = tally;
        if count > 0 {
            self.warnings.push(Diagnostic { code, message: format!("{count} {message}"), count, examples });
        }
    }

    /// The mesh, once everything was read.
    #[inline(never)]
    pub(super) fn finish(mut self, format: MeshFormat) -> Result<MeshData, ParseError> {
        let vertices = (self.positions.len() / 3) as u64;
        let triangles = (self.triangles.len() / 3) as u64;
        if vertices == 0 {
            return Err(ParseError::MissingElement { element: "vertices".to_owned() });
        }
        if triangles == 0 {
            return Err(ParseError::MissingElement { element: "faces".to_owned() });
        }
        check_count("vertices", vertices)?;
        check_count("triangles", triangles)?;
        check_count("faces", self.faces)?;
        self.leave_out_wrong_lengths(vertices as usize);
        let (short, polygons) = (core::mem::take(&mut self.short), core::mem::take(&mut self.polygons));
        self.report(short, "SkippedFace", "faces with fewer than three corners were left out");
        self.report(polygons, "PolygonTriangulated", "faces with more than three corners were cut into triangles");
        self.cut_polygons()?;
        let vertex_map = self.leave_out_vertices()?;
        self.spread_face_fields()?;
        Ok(MeshData {
            positions: self.positions,
            triangles: self.triangles,
            fields: self.fields,
            triangle_fields: self.face_fields,
            vertex_map,
            format,
            warnings: self.warnings,
        })
    }

    /// One array too short need not keep the rest of the file from being read.
    fn leave_out_wrong_lengths(&mut self, vertices: usize) {
        let faces = self.faces as usize;
        for (wanted, of_what, fields) in
            [(vertices, "vertices", &mut self.fields), (faces, "faces", &mut self.face_fields)]
        {
            let warnings = &mut self.warnings;
            fields.retain(|(name, values)| {
                let fits = values.len() == wanted;
                if !fits {
                    let message = format!(
                        "array `{name}` of {} values, where there are {wanted} {of_what}, left out",
                        values.len()
                    );
                    warnings.push(Diagnostic {
                        code: "SkippedData",
                        message,
                        count: values.len(),
                        examples: Vec::new(),
                    });
                }
                fits
            });
        }
    }

    /// Puts right the fans of polygons for which these are wrong.
    fn cut_polygons(&mut self) -> Result<(), ParseError> {
        let mut irregular = Tally::default();
        let (mut next_face, mut start) = (0, 0);
        for &Uneven { face, triangles } in &self.uneven {
            start += (face - next_face) as usize;
            let count = (triangles & !STRIP) as usize;
            if count > 1 && triangles & STRIP == 0 {
                let fan = &mut self.triangles[3 * start..3 * (start + count)];
                if polygon::triangulate(fan, &self.positions)? == Shape::Irregular {
                    irregular.add(u64::from(face));
                }
            }
            start += count;
            next_face = face + 1;
        }
        self.report(
            irregular,
            "IrregularPolygon",
            "faces are not planar or cross themselves; their triangles are a guess",
        );
        Ok(())
    }

    /// Leaves out vertices that no triangle has: those that are nowhere, and all where that is asked for. The map has the number in the
    /// file of every vertex that is left.
    fn leave_out_vertices(&mut self) -> Result<Option<Vec<u32>>, ParseError> {
        if !self.only_used && self.positions.iter().all(|value| value.is_finite()) {
            return Ok(None);
        }
        let count = self.positions.len() / 3;
        let mut new_ids = filled(u32::MAX, count)?;
        for &corner in &self.triangles {
            new_ids[corner as usize] = 0;
        }
        let (mut map, mut nowhere, mut unused) = (Vec::new(), Tally::default(), 0_u64);
        let mut next = 0;
        for vertex in 0..count {
            let is_somewhere = self.positions[3 * vertex..3 * vertex + 3].iter().all(|value| value.is_finite());
            if new_ids[vertex] == u32::MAX && (self.only_used || !is_somewhere) {
                if is_somewhere {
                    unused += 1;
                } else {
                    nowhere.add(vertex as u64);
                }
                continue;
            }
            new_ids[vertex] = next;
            next += 1;
            push(&mut map, vertex as u32)?;
        }
        if map.len() == count {
            return Ok(None);
        }
        self.report(nowhere, "DroppedVertex", "vertices without finite coordinates that no face has were left out");
        if unused > 0 {
            self.warn("DroppedVertex", format!("{unused} vertices that no face has were left out"), unused as usize);
        }
        for (place, &vertex) in map.iter().enumerate() {
            self.positions.copy_within(3 * vertex as usize..3 * vertex as usize + 3, 3 * place);
            for (_, values) in &mut self.fields {
                values[place] = values[vertex as usize];
            }
        }
        self.positions.truncate(3 * map.len());
        self.fields.iter_mut().for_each(|(_, values)| values.truncate(map.len()));
        self.triangles.iter_mut().for_each(|corner| *corner = new_ids[*corner as usize]);
        Ok(Some(map))
    }

    /// Gives every triangle the value of its face.
    fn spread_face_fields(&mut self) -> Result<(), ParseError> {
        if self.uneven.is_empty() {
            return Ok(());
        }
        let count = self.triangles.len() / 3;
        for (_, values) in &mut self.face_fields {
            let mut spread = with_room(count)?;
            let mut next = 0;
            for &Uneven { face, triangles } in &self.uneven {
                spread.extend_from_slice(&values[next..face as usize]);
                let value = values[face as usize];
                spread.extend((0..triangles & !STRIP).map(|_| value));
                next = face as usize + 1;
            }
            spread.extend_from_slice(&values[next..]);
            *values = spread;
        }
        Ok(())
    }
}

/// Adds values that begin at a place; what is missing before it is NaN.
fn extend(all: &mut Vec<f64>, first: u64, values: &[f64]) -> Result<(), ParseError> {
    let missing = (first as usize).saturating_sub(all.len());
    room(all, missing + values.len())?;
    all.extend((0..missing).map(|_| f64::NAN));
    all.extend_from_slice(values);
    Ok(())
}

/// Fails when 32-bit ids cannot name `count` elements.
pub(super) fn check_count(element: &str, count: u64) -> Result<(), ParseError> {
    if count > u64::from(u32::MAX) {
        return Err(ParseError::TooLarge { element: element.to_owned(), count });
    }
    Ok(())
}

/// Fails unless a field has the length it needs.
pub(super) fn check_length(field: &str, expected: u64, actual: u64) -> Result<(), ParseError> {
    if expected != actual {
        return Err(ParseError::LengthMismatch { field: field.to_owned(), expected, actual });
    }
    Ok(())
}
