//! Dense work on one front: its layout in memory, and the elimination of its columns.
//!
//! A front is the lower triangle of a symmetric matrix whose first columns are eliminated. Its rows are cut into tiles of
//! [`LaneBlock::LANES`] rows; a tile stores its columns one after the other, a lane block each. So the innermost loop,
//! which multiplies two tiles, reads both of them straight through memory, and nothing is ever packed for it. Three parts:
//!
//! - the *pivot rows*: tile t holds the columns up to the end of its diagonal block;
//! - the *rows below*, all pivot columns each;
//! - the *update*, that is the rows and columns below, laid out like the pivot rows: what the front hands to its parent.
//!
//! The first two stay as part of the factor, with the reciprocals of the pivots on the diagonal. Rows that fill the last
//! tile of a part up are zero.

use core::ops::Range;

use super::scalar::{LaneBlock, Scalar};
use crate::Watch;
use crate::error::Cancelled;

/// Lane blocks in the tiles before tile `tile` of a triangle.
#[inline]
pub(super) fn triangle<B: LaneBlock>(tile: usize) -> usize {
    B::LANES * tile * (tile + 1) / 2
}

/// Lane blocks of a front's part of the factor, and of its update. They may be more than there are addresses.
pub(super) fn sizes<B: LaneBlock>(columns: usize, rows: usize) -> (u64, u64) {
    let triangle = |tiles: u64| B::LANES as u64 * tiles * (tiles + 1) / 2;
    let below = rows.div_ceil(B::LANES) as u64;
    (triangle(columns.div_ceil(B::LANES) as u64) + below * columns as u64, triangle(below))
}

/// Tiles of pivot columns that are eliminated before the columns after them are brought up to date: 64 columns.
const PANEL: usize = 64;
/// Columns that one pass of an update takes: two tiles of so many stay in the first-level cache.
const fn depth<B>() -> usize {
    8192 / size_of::<B>()
}
/// Rows whose tiles stay in the second-level cache while all tiles below pass by.
const BREADTH: usize = 128;

/// A pivot of less than so many roundings of its entry has no digit.
const ROUNDINGS: f64 = 8.0;

/// The diagonal entries as they were before any elimination, by which negligible pivots are known.
pub(super) struct Diagonal<'a, B: LaneBlock> {
    pub(super) entries: &'a [B::Element],
    /// A pivot of at most this fraction of its entry is no more than rounding.
    pub(super) negligible: f64,
    /// Whether pivots that are no more than rounding are raised to that fraction, and do not fail.
    pub(super) raises: bool,
}

impl<B: LaneBlock> Diagonal<'_, B> {
    /// The root of a column's pivot.
    #[inline]
    fn root(&self, column: usize, pivot: B::Element) -> Option<B::Element> {
        if self.raises { self.raised_root(column, pivot) } else { pivot.root(self.entries[column], self.negligible) }
    }

    #[cold]
    fn raised_root(&self, column: usize, pivot: B::Element) -> Option<B::Element> {
        // What is raised if it is nothing but rounding need not be told from rounding for certain.
        let entry = self.entries[column];
        let root = pivot.root(entry, ROUNDINGS * B::Element::EPSILON);
        root.or_else(|| pivot.raised_root(entry, self.negligible))
    }
}

impl<B: LaneBlock> Clone for Diagonal<'_, B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B: LaneBlock> Copy for Diagonal<'_, B> {}

/// What ends an elimination early.
pub(super) enum Stopped {
    /// The pivot of this column fails.
    At(usize),
    /// Whoever watches has asked for it.
    Cancelled(Cancelled),
}

impl From<Cancelled> for Stopped {
    fn from(cancelled: Cancelled) -> Self {
        Self::Cancelled(cancelled)
    }
}

/// Products of a lane block with a number that are subtracted from another, before the watch is told: well below a millisecond.
const PATIENCE: u64 = 1 << 17;

/// Nanoseconds in WebAssembly for so many such products. Complex blocks are twice as long, and take four real products.
const fn ticks<B>(products: u64) -> u64 {
    (products / 5).saturating_mul(4 * (size_of::<B>() * size_of::<B>() / 512) as u64)
}

/// The ticks of the elimination of a front with so many columns and rows below.
pub(super) fn elimination_ticks<B: LaneBlock>(columns: usize, rows: usize) -> u64 {
    // In floating point, as fronts that fit no memory are counted, too.
    let (c, r) = (columns as f64, rows as f64);
    ticks::<B>(((c * c * c / 3.0 + c * c * r + c * r * r) / (2 * B::LANES) as f64) as u64)
}

/// Tells the watch of the products of one front from time to time.
struct Pace<'w, 'a> {
    watch: &'w Watch<'a>,
    products: u64,
}

impl Pace<'_, '_> {
    #[inline]
    fn count<B>(&mut self, products: usize) -> Result<(), Cancelled> {
        self.products += products as u64;
        if self.products < PATIENCE { Ok(()) } else { self.tell::<B>() }
    }

    #[inline(never)]
    fn tell<B>(&mut self) -> Result<(), Cancelled> {
        self.watch.tick(ticks::<B>(core::mem::take(&mut self.products)))
    }
}

/// One front.
pub(super) struct Front<'a, B: LaneBlock> {
    pub(super) columns: usize,
    /// Pivot rows, then the rows below.
    pub(super) factor: &'a mut [B],
    pub(super) update: &'a mut [B],
}

impl<B: LaneBlock> Front<'_, B> {
    /// Eliminates the columns and brings the update up to date. Ends early at the first column whose pivot fails.
    pub(super) fn eliminate(&mut self, diagonal: Diagonal<'_, B>, watch: &Watch<'_>) -> Result<(), Stopped> {
        let columns = self.columns;
        let pace = &mut Pace { watch, products: 0 };
        let (pivots, below) = self.factor.split_at_mut(triangle::<B>(columns.div_ceil(B::LANES)));
        for start in (0..columns).step_by(PANEL) {
            let end = (start + PANEL).min(columns);
            update_panel(pivots, below, columns, start..end, pace)?;
            eliminate_panel(pivots, columns, start..end, diagonal, pace)?;
            for row in below.chunks_exact_mut(columns) {
                solve_tile(pivots, row, start, end);
                pace.count::<B>((end - start) * (end - start) / 2)?;
            }
        }
        update_rest(self.update, below, columns, pace)?;
        Ok(pace.tell::<B>()?)
    }
}

/// Subtracts the products of the columns before `start` from the columns `start..end`, in all rows from `start` on.
#[inline(never)]
fn update_panel<B: LaneBlock>(
    pivots: &mut [B],
    below: &mut [B],
    columns: usize,
    panel: Range<usize>,
    pace: &mut Pace<'_, '_>,
) -> Result<(), Cancelled> {
    let Range { start, end } = panel;
    let tiles = start / B::LANES..end.div_ceil(B::LANES);
    for depth in (0..start).step_by(depth::<B>()) {
        let depth = depth..(depth + self::depth::<B>()).min(start);
        for i in tiles.start..columns.div_ceil(B::LANES) {
            let (above, row) = pivots.split_at_mut(triangle::<B>(i));
            let (done, open) = row.split_at_mut(start);
            let a = &done[depth.clone()];
            for j in tiles.start..tiles.end.min(i + 1) {
                let b = if j == i { a } else { &above[triangle::<B>(j)..][depth.clone()] };
                B::update(&mut open[j * B::LANES - start..][..B::LANES], a, b);
            }
            pace.count::<B>(tiles.len() * B::LANES * depth.len())?;
        }
        for row in below.chunks_exact_mut(columns) {
            let (done, open) = row.split_at_mut(start);
            for (j, result) in tiles.clone().zip(open[..end - start].chunks_mut(B::LANES)) {
                B::update(result, &done[depth.clone()], &pivots[triangle::<B>(j)..][depth.clone()]);
            }
            pace.count::<B>(tiles.len() * B::LANES * depth.len())?;
        }
    }
    Ok(())
}

/// Eliminates the columns `start..end` of the pivot rows.
#[inline(never)]
fn eliminate_panel<B: LaneBlock>(
    pivots: &mut [B],
    columns: usize,
    panel: Range<usize>,
    diagonal: Diagonal<'_, B>,
    pace: &mut Pace<'_, '_>,
) -> Result<(), Stopped> {
    let Range { start, end } = panel;
    for i in start / B::LANES..columns.div_ceil(B::LANES) {
        let (above, row) = pivots.split_at_mut(triangle::<B>(i));
        let own = i * B::LANES;
        solve_tile(above, row, start, end.min(own));
        if own < end {
            let (done, open) = row.split_at_mut(own);
            let tile = &mut open[..B::LANES];
            B::update(tile, &done[start..], &done[start..]);
            let last = columns.min(own + B::LANES);
            eliminate_tile(tile, Diagonal { entries: &diagonal.entries[own..last], ..diagonal })
                .map_err(|column| Stopped::At(own + column))?;
        }
        pace.count::<B>((end - start) * (end - start) / 2)?;
    }
    Ok(())
}

/// Solves for the entries of one tile of rows in the columns `start..end`, whose pivot rows are done.
#[inline(never)]
fn solve_tile<B: LaneBlock>(pivots: &[B], row: &mut [B], start: usize, end: usize) {
    let mut column = start;
    while column < end {
        let next = (column + B::LANES).min(end);
        let (done, open) = row.split_at_mut(column);
        let result = &mut open[..next - column];
        let pivot_row = &pivots[triangle::<B>(column / B::LANES)..];
        B::update(result, &done[start..], &pivot_row[start..column]);
        let tile = &pivot_row[column..next];
        for c in 0..result.len() {
            let solved = result[c].times(tile[c].lane(c)).without_traces();
            result[c] = solved;
            for other in c + 1..result.len() {
                result[other] = result[other].minus_scaled(&solved, tile[c].lane(other));
            }
        }
        column = next;
    }
}

/// The Cholesky factor of a diagonal tile, whose upper part comes out zero; as many columns as there are diagonal entries.
#[inline(never)]
fn eliminate_tile<B: LaneBlock>(tile: &mut [B], diagonal: Diagonal<'_, B>) -> Result<(), usize> {
    for c in 0..diagonal.entries.len() {
        let root = diagonal.root(c, tile[c].lane(c)).ok_or(c)?;
        let reciprocal = root.reciprocal();
        let mut column = B::ZERO;
        for lane in c + 1..B::LANES {
            column.set_lane(lane, tile[c].lane(lane).times(reciprocal));
        }
        column = column.without_traces();
        for other in c + 1..tile.len() {
            tile[other] = tile[other].minus_scaled(&column, column.lane(other));
        }
        column.set_lane(c, reciprocal);
        tile[c] = column;
    }
    Ok(())
}

/// Subtracts the products of all pivot columns from the update.
#[inline(never)]
fn update_rest<B: LaneBlock>(
    update: &mut [B],
    below: &[B],
    columns: usize,
    pace: &mut Pace<'_, '_>,
) -> Result<(), Cancelled> {
    let rows: usize = below.len() / columns.max(1);
    let breadth = BREADTH / B::LANES;
    for depth in (0..columns).step_by(depth::<B>()) {
        let depth = depth..(depth + self::depth::<B>()).min(columns);
        for first in (0..rows).step_by(breadth) {
            for i in first..rows {
                let a = &below[i * columns..][depth.clone()];
                let results = update[triangle::<B>(i)..].chunks_exact_mut(B::LANES);
                for (j, result) in (first..(first + breadth).min(i + 1)).zip(results.skip(first)) {
                    B::update(result, a, &below[j * columns..][depth.clone()]);
                }
                pace.count::<B>((breadth.min(i + 1 - first)) * B::LANES * depth.len())?;
            }
        }
    }
    Ok(())
}
