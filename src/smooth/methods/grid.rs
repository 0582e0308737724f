//! Points sorted into cubic cells, to find those that are near each other.

use core::ops::Range;

use crate::error::Cancelled;
use crate::support::counting_sort::{Buckets, grouped};

/// Bits of the number of a cell along one axis: three of them make a key.
const BITS: u32 = 21;

/// Cells along one axis. A cell has number 1 at least, and all its neighbours have numbers of [`BITS`] bits.
const MOST: f64 = (1 << (BITS - 1)) as f64;

/// Cells are wider than the radius by this factor: many times the rounding error of a number of a cell, of which there are
/// [`MOST`], so that points within the radius are in cells that touch.
const WIDER: f64 = 1.0 + 1e-6;

/// Takes the points of a cell, and all those that can be near one of them, in nine ranges.
pub(super) type Visit<'a> = &'a mut dyn FnMut(Range<usize>, &[Range<usize>; 9]) -> Result<(), Cancelled>;

/// Points in the order of their cells. Cells with following numbers along the first axis follow each other.
pub(super) struct Grid {
    /// The keys of the cells that hold points, ascending.
    cells: Vec<u64>,
    /// Where the points of each begin.
    starts: Vec<u32>,
    /// The points, by cell and id.
    points: Vec<u32>,
}

impl Grid {
    /// For the listed points, ascending, and pairs within `radius`, which is positive. The coordinates are finite, and so are
    /// their differences.
    pub(super) fn new(positions: &[f64], points: &[u32], radius: f64) -> Self {
        let position = |v: u32| &positions[3 * v as usize..3 * v as usize + 3];
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &v in points {
            for (k, &x) in position(v).iter().enumerate() {
                least[k] = least[k].min(x);
                most[k] = most[k].max(x);
            }
        }
        let extent = (0..3).fold(0.0_f64, |extent, k| extent.max(most[k] - least[k]));
        // Infinite for the largest radii: all is in one cell then.
        let width = (radius * WIDER).max(extent / MOST);
        let key = |v: u32| {
            let mut key = 0;
            for (k, &x) in position(v).iter().enumerate() {
                key |= (((x - least[k]) / width) as u64 + 1) << (k as u32 * BITS);
            }
            key
        };
        let mut cells: Vec<u64> = points.iter().map(|&v| key(v)).collect();
        cells.sort_unstable();
        cells.dedup();
        // A counting sort by the place of the key: sorting pairs would be a second sort in the module.
        let places: Vec<u32> = points.iter().map(|&v| cells.partition_point(|&cell| cell < key(v)) as u32).collect();
        let Buckets { offsets: starts, items: mut sorted } = grouped(&places, cells.len());
        sorted.iter_mut().for_each(|place| *place = points[*place as usize]);
        Self { cells, starts, points: sorted }
    }

    /// The points in the order that ranges refer to.
    pub(super) fn points(&self) -> &[u32] {
        &self.points
    }

    /// Where the points of a cell begin.
    fn start(&self, cell: usize) -> usize {
        self.starts[cell] as usize
    }

    /// Goes through all cells, in the same order whenever it is called.
    ///
    /// # Errors
    /// Those of the visitor.
    pub(super) fn visit(&self, to: Visit<'_>) -> Result<(), Cancelled> {
        // Keys ascend, and so do those of the cells beside them: each row is read along.
        let (mut first, mut end) = ([0; 9], [0; 9]);
        let mut near = [const { 0..0 }; 9];
        for (place, &key) in self.cells.iter().enumerate() {
            for row in 0..9 {
                let middle = key + ((row / 3) << (2 * BITS)) + ((row % 3) << BITS) - (1 << (2 * BITS)) - (1 << BITS);
                let row = row as usize;
                while first[row] < self.cells.len() && self.cells[first[row]] < middle - 1 {
                    first[row] += 1;
                }
                while end[row] < self.cells.len() && self.cells[end[row]] <= middle + 1 {
                    end[row] += 1;
                }
                near[row] = self.start(first[row])..self.start(end[row]);
            }
            to(self.start(place)..self.start(place + 1), &near)?;
        }
        Ok(())
    }
}
