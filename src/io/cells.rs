//! Cells of unstructured grids, with the numbers that VTK gives their types: those of surfaces become faces, and of those that fill a
//! volume the outer surface does.

use super::assembly::Assembly;
use super::scan::{push, sort_ids, with_room};
use crate::error::ParseError;

/// What a cell's type means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A point, line or curve.
    Line,
    Strip,
    /// As many corners as there are.
    Polygon,
    /// Four corners row by row.
    Pixel,
    /// That many corners, and then perhaps points in the middle of edges.
    Face(usize),
    Voxel,
    Tetrahedron,
    Hexahedron,
    Wedge,
    Pyramid,
    Unknown,
}

/// The kind of the cell type with this number.
pub(super) fn kind(number: i64) -> Kind {
    match number {
        1..=4 | 21 | 35 | 68 => Kind::Line,
        5 | 22 | 34 | 69 => Kind::Face(3),
        6 => Kind::Strip,
        7 => Kind::Polygon,
        8 => Kind::Pixel,
        9 | 23 | 28 | 30 | 70 => Kind::Face(4),
        10 | 24 | 71 => Kind::Tetrahedron,
        11 => Kind::Voxel,
        12 | 25 | 29 | 33 | 72 => Kind::Hexahedron,
        13 | 26 | 31 | 32 | 73 => Kind::Wedge,
        14 | 27 | 37 | 74 => Kind::Pyramid,
        _ => Kind::Unknown,
    }
}

impl Kind {
    /// The sides of a cell that fills a volume, each with a corner of the cell that it does not have: none for other cells.
    fn sides(self) -> &'static [(&'static [usize], usize)] {
        match self {
            Self::Tetrahedron => &[(&[0, 1, 3], 2), (&[1, 2, 3], 0), (&[2, 0, 3], 1), (&[0, 2, 1], 3)],
            Self::Hexahedron => &[
                (&[0, 4, 7, 3], 6),
                (&[1, 2, 6, 5], 7),
                (&[0, 1, 5, 4], 6),
                (&[3, 7, 6, 2], 5),
                (&[0, 3, 2, 1], 6),
                (&[4, 5, 6, 7], 2),
            ],
            Self::Voxel => &[
                (&[0, 4, 6, 2], 7),
                (&[1, 3, 7, 5], 6),
                (&[0, 1, 5, 4], 7),
                (&[2, 6, 7, 3], 5),
                (&[0, 2, 3, 1], 7),
                (&[4, 5, 7, 6], 3),
            ],
            Self::Wedge => {
                &[(&[0, 1, 2], 3), (&[3, 5, 4], 0), (&[0, 3, 4, 1], 2), (&[1, 4, 5, 2], 0), (&[2, 5, 3, 0], 1)]
            }
            Self::Pyramid => &[(&[0, 3, 2, 1], 4), (&[0, 1, 4], 2), (&[1, 2, 4], 3), (&[2, 3, 4], 0), (&[3, 0, 4], 1)],
            _ => &[],
        }
    }

    /// Whether it fills a volume.
    pub(super) fn is_volume(self) -> bool {
        !self.sides().is_empty()
    }

    /// Corners that it must have.
    fn corners(self) -> usize {
        match self {
            Self::Face(corners) => corners,
            Self::Pixel | Self::Tetrahedron => 4,
            Self::Hexahedron | Self::Voxel => 8,
            Self::Wedge => 6,
            Self::Pyramid => 5,
            _ => 0,
        }
    }
}

/// A side of a cell that fills a volume.
struct Side {
    /// Its corners in rising order, by which the same side of another cell is found.
    key: [u32; 4],
    /// Its corners in their order; the last of a triangle is [`NONE`].
    corners: [u32; 4],
    /// A corner of its cell that it does not have.
    inner: u32,
    cell: u32,
}

const NONE: u32 = u32::MAX;

/// Cells in the making.
pub(super) struct Cells {
    /// Whether cells that fill a volume were announced, so that those of surfaces are left out.
    has_volumes: bool,
    vertices: u64,
    sides: Vec<Side>,
    /// The cell of every face.
    of_face: Vec<u32>,
    cells: u32,
    lines: u64,
    surfaces: u64,
    unknown: u64,
    middles: u64,
}

impl Cells {
    /// `has_volumes` says whether any cell will fill a volume.
    pub(super) fn new(vertices: u64, has_volumes: bool) -> Self {
        Self {
            has_volumes,
            vertices,
            sides: Vec::new(),
            of_face: Vec::new(),
            cells: 0,
            lines: 0,
            surfaces: 0,
            unknown: 0,
            middles: 0,
        }
    }

    /// The cells of a grid whose points stand row by row: those of a surface where there is one point in some direction, else the outer
    /// surface of a block. The bytes of a number for each point must have been checked.
    pub(super) fn of_grid(assembly: &mut Assembly, size: [u64; 3]) -> Result<Self, ParseError> {
        let mut all = Self::new(size.iter().product(), size.iter().all(|&count| count > 1));
        // How far apart points and cells are that are next to each other in a direction.
        let point_steps = [1, size[0], size[0] * size[1]];
        let cells = size.map(|count| count.saturating_sub(1).max(1));
        let cell_steps = [1, cells[0], cells[0] * cells[1]];
        all.cells = u32::try_from(cells.iter().product::<u64>()).unwrap_or(u32::MAX);
        for normal in (0..3).rev() {
            let (u, v) = ((normal + 1) % 3, (normal + 2) % 3);
            if size[u] < 2 || size[v] < 2 || (!all.has_volumes && size[normal] != 1) {
                continue;
            }
            let ends: &[u64] = if all.has_volumes { &[0, size[normal] - 1] } else { &[0] };
            for &end in ends {
                let is_reversed = all.has_volumes && end == 0;
                for (j, i) in (0..size[v] - 1).flat_map(|j| (0..size[u] - 1).map(move |i| (j, i))) {
                    let corner = end * point_steps[normal] + i * point_steps[u] + j * point_steps[v];
                    let (right, up) = (point_steps[u], point_steps[v]);
                    let mut corners = [corner, corner + right, corner + right + up, corner + up];
                    if is_reversed {
                        corners.reverse();
                    }
                    for corner in corners {
                        assembly.corner(corner as i64, all.vertices)?;
                    }
                    assembly.close_polygon()?;
                    let layer = end.min(cells[normal] - 1);
                    let cell = layer * cell_steps[normal] + i * cell_steps[u] + j * cell_steps[v];
                    push(&mut all.of_face, cell as u32)?;
                }
            }
        }
        if all.has_volumes {
            assembly.keep_only_used();
        }
        Ok(all)
    }

    /// Takes the next cell.
    pub(super) fn add(&mut self, assembly: &mut Assembly, number: i64, corners: &[i64]) -> Result<(), ParseError> {
        let kind = kind(number);
        let cell = self.cells;
        self.cells += 1;
        let needed = kind.corners();
        if corners.len() < needed {
            let problem = format!("cell {cell} has {} corners, but its type {number} has {needed}", corners.len());
            return Err(ParseError::InvalidSyntax { line: 1, problem });
        }
        if kind.is_volume() {
            self.middles += (corners.len() - needed) as u64;
            return self.add_volume(kind, cell, corners);
        }
        match kind {
            Kind::Line => self.lines += 1,
            Kind::Unknown => self.unknown += 1,
            _ if self.has_volumes => self.surfaces += 1,
            _ => {
                let corners = match kind {
                    Kind::Face(count) => {
                        self.middles += (corners.len() - count) as u64;
                        &corners[..count]
                    }
                    _ => corners,
                };
                let order: &[usize] = if kind == Kind::Pixel { &[0, 1, 3, 2] } else { &[] };
                for place in 0..corners.len() {
                    let place = order.get(place).copied().unwrap_or(place);
                    assembly.corner(corners[place], self.vertices)?;
                }
                if kind == Kind::Strip {
                    assembly.close_strip()?;
                } else {
                    assembly.close_polygon()?;
                }
                push(&mut self.of_face, cell)?;
            }
        }
        Ok(())
    }

    fn add_volume(&mut self, kind: Kind, cell: u32, corners: &[i64]) -> Result<(), ParseError> {
        let vertices = self.vertices;
        let corner = |place: usize| match u32::try_from(corners[place]) {
            Ok(corner) if u64::from(corner) < vertices => Ok(corner),
            _ => Err(ParseError::FaceIndexOutOfBounds { face: u64::from(cell), index: corners[place], vertices }),
        };
        for (places, inner) in kind.sides() {
            let mut own = [NONE; 4];
            for (slot, &place) in own.iter_mut().zip(*places) {
                *slot = corner(place)?;
            }
            let mut key = own;
            key.sort_unstable();
            push(&mut self.sides, Side { key, corners: own, inner: corner(*inner)?, cell })?;
        }
        Ok(())
    }

    /// Adds the outer surface of the volumes, once all cells and positions are there. Its faces look away from their cells.
    pub(super) fn finish(&mut self, assembly: &mut Assembly) -> Result<(), ParseError> {
        let sides = core::mem::take(&mut self.sides);
        let mut order = with_room(sides.len())?;
        order.extend(0..sides.len() as u32);
        let side = |place: u32| &sides[place as usize];
        sort_ids(&mut order, &mut |a, b| side(a).key.cmp(&side(b).key));
        // Sides that have no twin.
        let mut outer = 0;
        let mut start = 0;
        while start < order.len() {
            let key = side(order[start]).key;
            let end = start + order[start..].iter().take_while(|&&place| side(place).key == key).count();
            if end == start + 1 {
                order[outer] = order[start];
                outer += 1;
            }
            start = end;
        }
        order.truncate(outer);
        // In the order of the cells.
        sort_ids(&mut order, &mut |a, b| a.cmp(&b));
        for place in order {
            let side = side(place);
            let count = if side.corners[3] == NONE { 3 } else { 4 };
            let corners = &side.corners[..count];
            let is_reversed = looks_at(&assembly.positions, corners, side.inner);
            for place in 0..count {
                let corner = if is_reversed { corners[count - 1 - place] } else { corners[place] };
                assembly.corner(i64::from(corner), self.vertices)?;
            }
            assembly.close_polygon()?;
            push(&mut self.of_face, side.cell)?;
        }
        if self.has_volumes || self.middles > 0 {
            assembly.keep_only_used();
        }
        for (count, what) in [
            (self.lines, "points and lines"),
            (self.surfaces, "cells of surfaces, beside those that fill volumes,"),
            (self.unknown, "cells of unknown types"),
            (self.middles, "points in the middle of edges or faces"),
        ] {
            if count > 0 {
                assembly.skipped(format!("{count} {what}"), count);
            }
        }
        Ok(())
    }

    /// How many cells there were.
    pub(super) fn count(&self) -> u64 {
        u64::from(self.cells)
    }

    /// Adds a field with one value per cell.
    pub(super) fn field(&self, assembly: &mut Assembly, name: &str, values: &[f64]) -> Result<(), ParseError> {
        self.field_from(assembly, name, 0, values)
    }

    /// Adds a field with one value per cell of a piece whose faces begin at `first`.
    pub(super) fn field_from(
        &self,
        assembly: &mut Assembly,
        name: &str,
        first: u64,
        values: &[f64],
    ) -> Result<(), ParseError> {
        let mut of_faces = with_room(self.of_face.len())?;
        of_faces.extend(self.of_face.iter().map(|&cell| values.get(cell as usize).copied().unwrap_or(f64::NAN)));
        assembly.more_of_face_field(name, first, of_faces)
    }
}

/// Whether a face's normal points to a vertex.
fn looks_at(positions: &[f64], corners: &[u32], vertex: u32) -> bool {
    let point = |id: u32| [0, 1, 2].map(|axis| positions[3 * id as usize + axis]);
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let first = point(corners[0]);
    // The diagonals of a quadrilateral, or two sides of a triangle.
    let (u, v) = match *corners {
        [_, b, c, d] => (minus(point(c), first), minus(point(d), point(b))),
        _ => (minus(point(corners[1]), first), minus(point(corners[2]), first)),
    };
    let to = minus(point(vertex), first);
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2] > 0.0
}
