//! What the readers share: faces become triangles, fields get unique names, what is left out becomes a warning.

use std::collections::BTreeMap;

use super::mesh_data::{MeshData, MeshFormat};
use super::scan::{push, reserve, room};
use crate::error::{Diagnostic, ParseError};

/// Counts faces of a kind and keeps the first few.
#[derive(Debug, Default)]
struct Tally {
    count: usize,
    examples: Vec<u32>,
}

impl Tally {
    fn add(&mut self, face: u64) {
        self.count += 1;
        if self.examples.len() < Diagnostic::EXAMPLES {
            self.examples.extend(u32::try_from(face));
        }
    }
}

/// A mesh in the making.
#[derive(Debug, Default)]
pub(super) struct Assembly {
    pub(super) positions: Vec<f64>,
    triangles: Vec<u32>,
    fields: Vec<(String, Vec<f64>)>,
    names: Names,
    warnings: Vec<Diagnostic>,
    corners: Vec<u32>,
    faces: u64,
    short: Tally,
    polygons: Tally,
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

    /// Adds a corner to the face that is being read.
    #[inline(never)]
    pub(super) fn corner(&mut self, index: i64, vertices: u64) -> Result<(), ParseError> {
        match u32::try_from(index) {
            Ok(corner) if u64::from(corner) < vertices => push(&mut self.corners, corner),
            _ => Err(ParseError::FaceIndexOutOfBounds { face: self.faces, index, vertices }),
        }
    }

    /// Ends a polygon: a fan around its first corner.
    #[inline(never)]
    pub(super) fn close_polygon(&mut self) -> Result<(), ParseError> {
        match self.corners.as_slice() {
            [] | [_] | [_, _] => self.short.add(self.faces),
            [first, others @ ..] => {
                room(&mut self.triangles, 3 * (others.len() - 1))?;
                for pair in others.windows(2) {
                    self.triangles.extend([*first, pair[0], pair[1]]);
                }
                if others.len() > 2 {
                    self.polygons.add(self.faces);
                }
            }
        }
        self.faces += 1;
        self.corners.clear();
        Ok(())
    }

    /// Ends a triangle strip: every second triangle is turned round, so that all look the same way.
    pub(super) fn close_strip(&mut self) -> Result<(), ParseError> {
        if self.corners.len() < 3 {
            self.short.add(self.faces);
        }
        room(&mut self.triangles, 3 * self.corners.len().saturating_sub(2))?;
        for (place, corners) in self.corners.windows(3).enumerate() {
            let [a, b] = if place % 2 == 0 { [corners[0], corners[1]] } else { [corners[1], corners[0]] };
            self.triangles.extend([a, b, corners[2]]);
        }
        self.faces += 1;
        self.corners.clear();
        Ok(())
    }

    /// Adds a field; a name that was there before gets a number.
    #[inline(never)]
    pub(super) fn field(&mut self, name: &str, values: Vec<f64>) {
        let unique = self.names.unique(name);
        if unique != name {
            self.warn("RenamedField", format!("a second field `{name}` was renamed `{unique}`"), 1);
        }
        self.fields.push((unique, values));
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
        for (name, values) in &self.fields {
            check_length(name, vertices, values.len() as u64)?;
        }
        let tallies = [
            (self.short, "SkippedFace", "faces with fewer than three corners were left out"),
            (self.polygons, "PolygonTriangulated", "faces with more than three corners were cut into triangles"),
        ];
        for (tally, code, message) in tallies {
            if tally.count > 0 {
                self.warnings.push(Diagnostic {
                    code,
                    message: format!("{} {message}", tally.count),
                    count: tally.count,
                    examples: tally.examples,
                });
            }
        }
        Ok(MeshData {
            positions: self.positions,
            triangles: self.triangles,
            fields: self.fields,
            format,
            warnings: self.warnings,
        })
    }
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

/// Names given so far, each with the number that its next namesake tries first. In order, because a table may have very many.
#[derive(Debug, Default)]
pub(super) struct Names(BTreeMap<String, u64>);

impl Names {
    /// `name`, or `name_2`, `name_3`, … when it was there before.
    pub(super) fn unique(&mut self, name: &str) -> String {
        let Some(&last) = self.0.get(name) else {
            self.0.insert(name.to_owned(), 1);
            return name.to_owned();
        };
        let mut number = last;
        // More than one round only where `name_2` is itself a name of the file.
        let unique = loop {
            number += 1;
            let candidate = format!("{name}_{number}");
            if !self.0.contains_key(&candidate) {
                break candidate;
            }
        };
        self.0.insert(name.to_owned(), number);
        self.0.insert(unique.clone(), 1);
        unique
    }
}
