//! Dense work on one front: its layout in memory, and the elimination of its columns.
//!
//! A front is the lower triangle of a symmetric matrix whose first columns are eliminated. Its rows are cut into tiles of
//! [`Unit::LANES`] rows; a tile stores its columns one after the other, a [`Unit`] each. So the innermost loop, which
//! multiplies two tiles, reads both of them straight through memory, and nothing is ever packed for it. Three parts:
//!
//! - the *pivot rows*: tile t holds the columns up to the end of its diagonal block;
//! - the *rows below*, all pivot columns each;
//! - the *update*, that is the rows and columns below, laid out like the pivot rows: what the front hands to its parent.
//!
//! The first two stay as part of the factor, with the reciprocals of the pivots on the diagonal. Rows that fill the last
//! tile of a part up are zero.

use super::scalar::Scalar;
use super::unit::Unit;

/// Units in the tiles before tile `tile` of a triangle.
#[inline]
pub(super) fn triangle<U: Unit>(tile: usize) -> usize {
    U::LANES * tile * (tile + 1) / 2
}

/// Units of a front's part of the factor, and of its update. They may be more than there are addresses.
pub(super) fn sizes<U: Unit>(columns: usize, rows: usize) -> (u64, u64) {
    let triangle = |tiles: u64| U::LANES as u64 * tiles * (tiles + 1) / 2;
    let below = rows.div_ceil(U::LANES) as u64;
    (triangle(columns.div_ceil(U::LANES) as u64) + below * columns as u64, triangle(below))
}

/// Tiles of pivot columns that are eliminated before the columns after them are brought up to date: 64 columns.
const PANEL: usize = 64;
/// Columns that one pass of an update takes: two tiles of so many stay in the first-level cache.
const fn depth<U>() -> usize {
    8192 / size_of::<U>()
}
/// Rows whose tiles stay in the second-level cache while all tiles below pass by.
const BREADTH: usize = 128;

/// The diagonal entries as they were before any elimination, which tell lost pivots.
pub(super) struct Diagonal<'a, U: Unit> {
    pub(super) entries: &'a [U::Element],
    /// A pivot of this fraction of its entry is lost.
    pub(super) lost: f64,
}

impl<U: Unit> Clone for Diagonal<'_, U> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<U: Unit> Copy for Diagonal<'_, U> {}

/// One front.
pub(super) struct Front<'a, U: Unit> {
    pub(super) columns: usize,
    /// Pivot rows, then the rows below.
    pub(super) factor: &'a mut [U],
    pub(super) update: &'a mut [U],
}

impl<U: Unit> Front<'_, U> {
    /// Eliminates the columns and brings the update up to date. The first column with a lost pivot is the error.
    pub(super) fn eliminate(&mut self, diagonal: Diagonal<'_, U>) -> Result<(), usize> {
        let columns = self.columns;
        let (pivots, below) = self.factor.split_at_mut(triangle::<U>(columns.div_ceil(U::LANES)));
        for start in (0..columns).step_by(PANEL) {
            let end = (start + PANEL).min(columns);
            update_panel(pivots, below, columns, start, end);
            eliminate_panel(pivots, columns, start, end, diagonal)?;
            for row in below.chunks_exact_mut(columns) {
                solve_tile(pivots, row, start, end);
            }
        }
        update_rest(self.update, below, columns);
        Ok(())
    }
}

/// Subtracts the products of the columns before `start` from the columns `start..end`, in all rows from `start` on.
#[inline(never)]
fn update_panel<U: Unit>(pivots: &mut [U], below: &mut [U], columns: usize, start: usize, end: usize) {
    let tiles = start / U::LANES..end.div_ceil(U::LANES);
    for depth in (0..start).step_by(depth::<U>()) {
        let depth = depth..(depth + self::depth::<U>()).min(start);
        for i in tiles.start..columns.div_ceil(U::LANES) {
            let (above, row) = pivots.split_at_mut(triangle::<U>(i));
            let (done, open) = row.split_at_mut(start);
            let a = &done[depth.clone()];
            for j in tiles.start..tiles.end.min(i + 1) {
                let b = if j == i { a } else { &above[triangle::<U>(j)..][depth.clone()] };
                U::update(&mut open[j * U::LANES - start..][..U::LANES], a, b);
            }
        }
        for row in below.chunks_exact_mut(columns) {
            let (done, open) = row.split_at_mut(start);
            for (j, result) in tiles.clone().zip(open[..end - start].chunks_mut(U::LANES)) {
                U::update(result, &done[depth.clone()], &pivots[triangle::<U>(j)..][depth.clone()]);
            }
        }
    }
}

/// Eliminates the columns `start..end` of the pivot rows.
#[inline(never)]
fn eliminate_panel<U: Unit>(
    pivots: &mut [U],
    columns: usize,
    start: usize,
    end: usize,
    diagonal: Diagonal<'_, U>,
) -> Result<(), usize> {
    for i in start / U::LANES..columns.div_ceil(U::LANES) {
        let (above, row) = pivots.split_at_mut(triangle::<U>(i));
        let own = i * U::LANES;
        solve_tile(above, row, start, end.min(own));
        if own < end {
            let (done, open) = row.split_at_mut(own);
            let tile = &mut open[..U::LANES];
            U::update(tile, &done[start..], &done[start..]);
            let last = columns.min(own + U::LANES);
            eliminate_tile(tile, Diagonal { entries: &diagonal.entries[own..last], ..diagonal })
                .map_err(|column| own + column)?;
        }
    }
    Ok(())
}

/// Solves for the entries of one tile of rows in the columns `start..end`, whose pivot rows are done.
#[inline(never)]
fn solve_tile<U: Unit>(pivots: &[U], row: &mut [U], start: usize, end: usize) {
    let mut column = start;
    while column < end {
        let next = (column + U::LANES).min(end);
        let (done, open) = row.split_at_mut(column);
        let result = &mut open[..next - column];
        let pivot_row = &pivots[triangle::<U>(column / U::LANES)..];
        U::update(result, &done[start..], &pivot_row[start..column]);
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
fn eliminate_tile<U: Unit>(tile: &mut [U], diagonal: Diagonal<'_, U>) -> Result<(), usize> {
    for c in 0..diagonal.entries.len() {
        let root = tile[c].lane(c).root(diagonal.entries[c], diagonal.lost).ok_or(c)?;
        let reciprocal = root.reciprocal();
        let mut column = U::ZERO;
        for lane in c + 1..U::LANES {
            column.set_lane(lane, tile[c].lane(lane).by(reciprocal));
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
fn update_rest<U: Unit>(update: &mut [U], below: &[U], columns: usize) {
    let rows: usize = below.len() / columns.max(1);
    let breadth = BREADTH / U::LANES;
    for depth in (0..columns).step_by(depth::<U>()) {
        let depth = depth..(depth + self::depth::<U>()).min(columns);
        for first in (0..rows).step_by(breadth) {
            for i in first..rows {
                let a = &below[i * columns..][depth.clone()];
                let results = update[triangle::<U>(i)..].chunks_exact_mut(U::LANES);
                for (j, result) in (first..(first + breadth).min(i + 1)).zip(results.skip(first)) {
                    U::update(result, a, &below[j * columns..][depth.clone()]);
                }
            }
        }
    }
}
