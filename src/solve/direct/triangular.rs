//! Solves with a factor, front by front: forward with L, backward with Lᵀ.
//!
//! Small loops are functions of their own, never inlined: there are four kinds of factors, and the module is downloaded.

use super::front::triangle;
use super::scalar::{LaneBlock, Scalar};
use super::symbolic::Symbolic;
use crate::Watch;
use crate::error::Cancelled;

/// One front's part of the factor.
struct Part<'a, B: LaneBlock> {
    /// Tiles of the pivot rows.
    pivots: &'a [B],
    /// Tiles of the rows below.
    below: &'a [B],
    columns: core::ops::Range<usize>,
    rows: &'a [u32],
}

#[inline(never)]
fn part<'a, B: LaneBlock>(symbolic: &'a Symbolic, factor: &'a [Vec<B>], s: usize) -> Part<'a, B> {
    let (columns, rows) = (symbolic.columns(s), symbolic.rows_of(s));
    let (pivots, below) = factor[s].split_at(triangle::<B>(columns.len().div_ceil(B::LANES)));
    Part { pivots, below, columns, rows }
}

/// Nanoseconds in WebAssembly for a front, and for one pass over so many lane blocks from memory.
fn ticks<B>(blocks: usize) -> u64 {
    100 + blocks as u64 * size_of::<B>() as u64 / 5
}

/// Overwrites a right-hand side, in the order of elimination, with the solution.
#[inline(never)]
pub(super) fn solve_one<B: LaneBlock>(
    symbolic: &Symbolic,
    factor: &[Vec<B>],
    x: &mut [B::Element],
    watch: &Watch<'_>,
) -> Result<(), Cancelled> {
    for s in 0..factor.len() {
        forward(&part(symbolic, factor, s), x);
        watch.tick(ticks::<B>(factor[s].len()))?;
    }
    let mut sums = Vec::new();
    for s in (0..factor.len()).rev() {
        backward(&part(symbolic, factor, s), x, &mut sums);
        watch.tick(ticks::<B>(factor[s].len()))?;
    }
    Ok(())
}

#[inline(never)]
fn forward<B: LaneBlock>(part: &Part<'_, B>, x: &mut [B::Element]) {
    let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
    for tile in (0..own.len()).step_by(B::LANES) {
        let row = &part.pivots[triangle::<B>(tile / B::LANES)..];
        let (done, open) = own.split_at_mut(tile);
        let mut sums = minus_products(&row[..tile], done);
        for (c, value) in open.iter_mut().take(B::LANES).enumerate() {
            let block = &row[tile + c];
            *value = value.plus(sums.lane(c)).times(block.lane(c));
            sums = sums.minus_scaled(block, *value);
        }
    }
    for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(B::LANES)) {
        let sums = minus_products(row, own);
        for (lane, &id) in ids.iter().enumerate() {
            let value = &mut later[id as usize - part.columns.end];
            *value = value.plus(sums.lane(lane));
        }
    }
}

/// `sums` is for its use only.
#[inline(never)]
fn backward<B: LaneBlock>(part: &Part<'_, B>, x: &mut [B::Element], sums: &mut Vec<B>) {
    let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
    sums.clear();
    sums.resize(own.len(), B::ZERO);
    for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(B::LANES)) {
        let mut values = B::ZERO;
        for (lane, &id) in ids.iter().enumerate() {
            values.set_lane(lane, later[id as usize - part.columns.end]);
        }
        add_products(sums, row, &values);
    }
    for tile in (0..own.len()).step_by(B::LANES).rev() {
        let row = &part.pivots[triangle::<B>(tile / B::LANES)..];
        let mut values = B::ZERO;
        for c in (tile..own.len().min(tile + B::LANES)).rev() {
            // The lanes of `values` up to this one are still zero.
            let known = sums[c].plus_product(&row[c], &values).sum();
            own[c] = own[c].minus(known).times(row[c].lane(c - tile));
            values.set_lane(c - tile, own[c]);
        }
        add_products(&mut sums[..tile], row, &values);
    }
}

/// − Σ `blocks[k]` · `x[k]`, in two sums that do not wait for each other.
#[inline(never)]
fn minus_products<B: LaneBlock>(blocks: &[B], x: &[B::Element]) -> B {
    let (mut even, mut odd) = (B::ZERO, B::ZERO);
    let (pairs, last) = blocks.as_chunks::<2>();
    let (xs, last_x) = x.as_chunks::<2>();
    for (block, x) in pairs.iter().zip(xs) {
        even = even.minus_scaled(&block[0], x[0]);
        odd = odd.minus_scaled(&block[1], x[1]);
    }
    for (block, &x) in last.iter().zip(last_x) {
        even = even.minus_scaled(block, x);
    }
    even.plus(&odd)
}

/// `sums[k]` += `row[k]` · `values`, lane by lane.
#[inline(never)]
fn add_products<B: LaneBlock>(sums: &mut [B], row: &[B], values: &B) {
    for (sum, block) in sums.iter_mut().zip(row) {
        *sum = sum.plus_product(block, values);
    }
}

/// Overwrites as many right-hand sides as a block has lanes, a block for each unknown, with their solutions.
#[inline(never)]
pub(super) fn solve_block<B: LaneBlock>(
    symbolic: &Symbolic,
    factor: &[Vec<B>],
    x: &mut [B],
    watch: &Watch<'_>,
) -> Result<(), Cancelled> {
    let mut gathered: Vec<B> = vec![B::ZERO; B::LANES];
    for s in 0..factor.len() {
        let part = part(symbolic, factor, s);
        let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
        for tile in (0..own.len()).step_by(B::LANES) {
            let row = &part.pivots[triangle::<B>(tile / B::LANES)..];
            let (done, open) = own.split_at_mut(tile);
            let open = &mut open[..B::LANES.min(part.columns.len() - tile)];
            B::update(open, done, &row[..tile]);
            solve_tile(open, &row[tile..]);
        }
        for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(B::LANES)) {
            for (block, &id) in gathered.iter_mut().zip(ids) {
                *block = later[id as usize - part.columns.end];
            }
            B::update(&mut gathered, own, row);
            for (block, &id) in gathered.iter().zip(ids) {
                later[id as usize - part.columns.end] = *block;
            }
        }
        // Read once, and used for every lane.
        watch.tick(ticks::<B>(B::LANES / 2 * factor[s].len()))?;
    }
    for s in (0..factor.len()).rev() {
        let part = part(symbolic, factor, s);
        let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
        for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(B::LANES)) {
            // The rows that fill the last tile up are zero, whatever has been gathered for them before.
            for (block, &id) in gathered.iter_mut().zip(ids) {
                *block = later[id as usize - part.columns.end];
            }
            subtract_transposed(own, row, &gathered);
        }
        for tile in (0..own.len()).step_by(B::LANES).rev() {
            let row = &part.pivots[triangle::<B>(tile / B::LANES)..];
            let (before, open) = own.split_at_mut(tile);
            let open = &mut open[..B::LANES.min(part.columns.len() - tile)];
            solve_transposed_tile(open, &row[tile..]);
            subtract_transposed(before, &row[..tile], open);
        }
        // Read once, and used for every lane.
        watch.tick(ticks::<B>(B::LANES / 2 * factor[s].len()))?;
    }
    Ok(())
}

/// Forward within a diagonal tile.
#[inline(never)]
fn solve_tile<B: LaneBlock>(open: &mut [B], tile: &[B]) {
    for c in 0..open.len() {
        let solved = open[c].times(tile[c].lane(c));
        open[c] = solved;
        for (other, block) in open.iter_mut().enumerate().skip(c + 1) {
            *block = block.minus_scaled(&solved, tile[c].lane(other));
        }
    }
}

/// Backward within a diagonal tile.
#[inline(never)]
fn solve_transposed_tile<B: LaneBlock>(open: &mut [B], tile: &[B]) {
    for c in (0..open.len()).rev() {
        let (before, after) = open.split_at_mut(c + 1);
        let mut value = before[c];
        for (k, block) in after.iter().enumerate() {
            value = value.minus_scaled(block, tile[c].lane(c + 1 + k));
        }
        before[c] = value.times(tile[c].lane(c));
    }
}

/// `results[k]` −= Σ over i of lane i of `row[k]` · `values[i]`
#[inline(never)]
fn subtract_transposed<B: LaneBlock>(results: &mut [B], row: &[B], values: &[B]) {
    for (result, block) in results.iter_mut().zip(row) {
        for (lane, value) in values.iter().enumerate() {
            *result = result.minus_scaled(value, block.lane(lane));
        }
    }
}
