//! What is known of a legacy VTK file while it is read.

use super::super::assembly::Assembly;
use super::super::cells::Cells;
use super::data::Data;

/// What is known of the cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DataSet {
    PolyData,
    Unstructured,
    /// Points are given one by one.
    Structured,
    /// Points are given by their coordinates along each axis.
    Rectilinear,
    /// Points are given by the first one and the distances.
    Image,
}

/// What the attributes that follow belong to, and how many tuples they have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Owner {
    File,
    Points(u64),
    Cells(u64),
}

/// The corners of cells.
#[derive(Debug, Default)]
pub(super) struct Connectivity {
    pub(super) ends: Vec<usize>,
    pub(super) corners: Vec<i64>,
}

impl Connectivity {
    pub(super) fn count(&self) -> u64 {
        self.ends.len() as u64
    }

    pub(super) fn corners_of(&self, cell: usize) -> &[i64] {
        let start = if cell == 0 { 0 } else { self.ends[cell - 1] };
        &self.corners[start..self.ends[cell]]
    }
}

pub(super) struct Reader<'a> {
    pub(super) data: Data<'a>,
    pub(super) data_set: DataSet,
    pub(super) points: Option<u64>,
    /// Points of a grid in each direction.
    pub(super) size: [u64; 3],
    /// The coordinates of a rectilinear grid.
    pub(super) axes: [Vec<f64>; 3],
    pub(super) origin: [f64; 3],
    pub(super) spacing: [f64; 3],
    /// The corners of an unstructured grid, until its types are there.
    pub(super) connectivity: Option<Connectivity>,
    /// The cells, but for polygons and strips.
    pub(super) cells: Option<Cells>,
    /// Cells of points and lines, whose values come before those of polygons.
    pub(super) lines: u64,
    pub(super) has_strips: bool,
    /// Whether polygons stood before strips, as their values do.
    pub(super) is_in_order: bool,
    pub(super) owner: Owner,
    pub(super) assembly: Assembly,
}

impl<'a> Reader<'a> {
    pub(super) fn new(data: Data<'a>) -> Self {
        Self {
            data,
            data_set: DataSet::PolyData,
            points: None,
            size: [0; 3],
            axes: [const { Vec::new() }; 3],
            origin: [0.0; 3],
            spacing: [1.0; 3],
            connectivity: None,
            cells: None,
            lines: 0,
            has_strips: false,
            is_in_order: true,
            owner: Owner::File,
            assembly: Assembly::default(),
        }
    }

    /// How many cells there are.
    pub(super) fn cell_count(&self) -> u64 {
        self.cells.as_ref().map_or(self.lines + self.assembly.faces(), Cells::count)
    }
}
