//! Solves with a factor, front by front: forward with L, backward with Lᵀ.
//!
//! Small loops are functions of their own, never inlined: there are four kinds of factors, and the module is downloaded.

use super::front::triangle;
use super::scalar::Scalar;
use super::symbolic::Symbolic;
use super::unit::Unit;

/// One front's part of the factor.
struct Part<'a, U: Unit> {
    /// Tiles of the pivot rows.
    pivots: &'a [U],
    /// Tiles of the rows below.
    below: &'a [U],
    columns: core::ops::Range<usize>,
    rows: &'a [u32],
}

#[inline(never)]
fn part<'a, U: Unit>(symbolic: &'a Symbolic, factor: &'a [Vec<U>], s: usize) -> Part<'a, U> {
    let (columns, rows) = (symbolic.columns(s), symbolic.rows_of(s));
    let (pivots, below) = factor[s].split_at(triangle::<U>(columns.len().div_ceil(U::LANES)));
    Part { pivots, below, columns, rows }
}

/// Overwrites a right-hand side, in the order of elimination, with the solution.
#[inline(never)]
pub(super) fn solve_one<U: Unit>(symbolic: &Symbolic, factor: &[Vec<U>], x: &mut [U::Element]) {
    for s in 0..factor.len() {
        forward(&part(symbolic, factor, s), x);
    }
    let mut sums = Vec::new();
    for s in (0..factor.len()).rev() {
        backward(&part(symbolic, factor, s), x, &mut sums);
    }
}

#[inline(never)]
fn forward<U: Unit>(part: &Part<'_, U>, x: &mut [U::Element]) {
    let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
    for tile in (0..own.len()).step_by(U::LANES) {
        let row = &part.pivots[triangle::<U>(tile / U::LANES)..];
        let (done, open) = own.split_at_mut(tile);
        let mut sums = minus_products(&row[..tile], done);
        for (c, value) in open.iter_mut().take(U::LANES).enumerate() {
            let unit = &row[tile + c];
            *value = value.plus(sums.lane(c)).by(unit.lane(c));
            sums = sums.minus_scaled(unit, *value);
        }
    }
    for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(U::LANES)) {
        let sums = minus_products(row, own);
        for (lane, &id) in ids.iter().enumerate() {
            let value = &mut later[id as usize - part.columns.end];
            *value = value.plus(sums.lane(lane));
        }
    }
}

/// `sums` is for its use only.
#[inline(never)]
fn backward<U: Unit>(part: &Part<'_, U>, x: &mut [U::Element], sums: &mut Vec<U>) {
    let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
    sums.clear();
    sums.resize(own.len(), U::ZERO);
    for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(U::LANES)) {
        let mut values = U::ZERO;
        for (lane, &id) in ids.iter().enumerate() {
            values.set_lane(lane, later[id as usize - part.columns.end]);
        }
        add_products(sums, row, &values);
    }
    for tile in (0..own.len()).step_by(U::LANES).rev() {
        let row = &part.pivots[triangle::<U>(tile / U::LANES)..];
        let mut values = U::ZERO;
        for c in (tile..own.len().min(tile + U::LANES)).rev() {
            // The lanes of `values` up to this one are still zero.
            let known = sums[c].plus_product(&row[c], &values).sum();
            own[c] = own[c].minus(known).by(row[c].lane(c - tile));
            values.set_lane(c - tile, own[c]);
        }
        add_products(&mut sums[..tile], row, &values);
    }
}

/// − Σ `units[k]` · `x[k]`, in two sums that do not wait for each other.
#[inline(never)]
fn minus_products<U: Unit>(units: &[U], x: &[U::Element]) -> U {
    let (mut even, mut odd) = (U::ZERO, U::ZERO);
    let (pairs, last) = units.as_chunks::<2>();
    let (xs, last_x) = x.as_chunks::<2>();
    for (unit, x) in pairs.iter().zip(xs) {
        even = even.minus_scaled(&unit[0], x[0]);
        odd = odd.minus_scaled(&unit[1], x[1]);
    }
    for (unit, &x) in last.iter().zip(last_x) {
        even = even.minus_scaled(unit, x);
    }
    even.plus(&odd)
}

/// `sums[k]` += `row[k]` · `values`, lane by lane.
#[inline(never)]
fn add_products<U: Unit>(sums: &mut [U], row: &[U], values: &U) {
    for (sum, unit) in sums.iter_mut().zip(row) {
        *sum = sum.plus_product(unit, values);
    }
}

/// Overwrites as many right-hand sides as a unit has lanes, a unit for each unknown, with their solutions.
#[inline(never)]
pub(super) fn solve_block<U: Unit>(symbolic: &Symbolic, factor: &[Vec<U>], x: &mut [U]) {
    let mut gathered: Vec<U> = vec![U::ZERO; U::LANES];
    for s in 0..factor.len() {
        let part = part(symbolic, factor, s);
        let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
        for tile in (0..own.len()).step_by(U::LANES) {
            let row = &part.pivots[triangle::<U>(tile / U::LANES)..];
            let (done, open) = own.split_at_mut(tile);
            let open = &mut open[..U::LANES.min(part.columns.len() - tile)];
            U::update(open, done, &row[..tile]);
            solve_tile(open, &row[tile..]);
        }
        for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(U::LANES)) {
            for (unit, &id) in gathered.iter_mut().zip(ids) {
                *unit = later[id as usize - part.columns.end];
            }
            U::update(&mut gathered, own, row);
            for (unit, &id) in gathered.iter().zip(ids) {
                later[id as usize - part.columns.end] = *unit;
            }
        }
    }
    for s in (0..factor.len()).rev() {
        let part = part(symbolic, factor, s);
        let (own, later) = x[part.columns.start..].split_at_mut(part.columns.len());
        for (row, ids) in part.below.chunks_exact(own.len()).zip(part.rows.chunks(U::LANES)) {
            // The rows that fill the last tile up are zero, whatever has been gathered for them before.
            for (unit, &id) in gathered.iter_mut().zip(ids) {
                *unit = later[id as usize - part.columns.end];
            }
            subtract_transposed(own, row, &gathered);
        }
        for tile in (0..own.len()).step_by(U::LANES).rev() {
            let row = &part.pivots[triangle::<U>(tile / U::LANES)..];
            let (before, open) = own.split_at_mut(tile);
            let open = &mut open[..U::LANES.min(part.columns.len() - tile)];
            solve_transposed_tile(open, &row[tile..]);
            subtract_transposed(before, &row[..tile], open);
        }
    }
}

/// Forward within a diagonal tile.
#[inline(never)]
fn solve_tile<U: Unit>(open: &mut [U], tile: &[U]) {
    for c in 0..open.len() {
        let solved = open[c].times(tile[c].lane(c));
        open[c] = solved;
        for (other, unit) in open.iter_mut().enumerate().skip(c + 1) {
            *unit = unit.minus_scaled(&solved, tile[c].lane(other));
        }
    }
}

/// Backward within a diagonal tile.
#[inline(never)]
fn solve_transposed_tile<U: Unit>(open: &mut [U], tile: &[U]) {
    for c in (0..open.len()).rev() {
        let (before, after) = open.split_at_mut(c + 1);
        let mut value = before[c];
        for (k, unit) in after.iter().enumerate() {
            value = value.minus_scaled(unit, tile[c].lane(c + 1 + k));
        }
        before[c] = value.times(tile[c].lane(c));
    }
}

/// `results[k]` −= Σ over i of lane i of `row[k]` · `values[i]`
#[inline(never)]
fn subtract_transposed<U: Unit>(results: &mut [U], row: &[U], values: &[U]) {
    for (result, unit) in results.iter_mut().zip(row) {
        for (lane, value) in values.iter().enumerate() {
            *result = result.minus_scaled(value, unit.lane(lane));
        }
    }
}
