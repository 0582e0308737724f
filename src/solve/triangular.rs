//! Solves with a factor, front by front: forward with L, backward with Lᵀ.

use super::front::triangle;
use super::scalar::{Scalar, Unit};
use super::symbolic::Symbolic;

/// Overwrites a right-hand side, in the order of elimination, with the solution.
pub(super) fn solve_one<U: Unit>(symbolic: &Symbolic, factor: &[U], x: &mut [U::Element]) {
    let mut start = 0;
    for s in 0..symbolic.fronts() {
        let columns = symbolic.columns(s);
        let (own, later) = x[columns.start..].split_at_mut(columns.len());
        let rows = symbolic.rows_of(s);
        let pivots = triangle::<U>(columns.len().div_ceil(U::LANES));
        for (t, tile) in own.len().div_ceil(U::LANES).checked_sub(1).map_or(0..0, |last| 0..last + 1).map(|t| (t, t * U::LANES)) {
            let row = &factor[start + triangle::<U>(t)..];
            let (done, open) = own.split_at_mut(tile);
            let mut sums = dot(&row[..tile], done);
            for c in 0..open.len().min(U::LANES) {
                let unit = &row[tile + c];
                let value = open[c].plus(sums.lane(c)).by(unit.lane(c));
                open[c] = value;
                sums = sums.minus_scaled(unit, value);
            }
        }
        let below = &factor[start + pivots..];
        for (row, ids) in below.chunks_exact(own.len()).zip(rows.chunks(U::LANES)) {
            let sums = dot(row, own);
            for (lane, &id) in ids.iter().enumerate() {
                let target = &mut later[id as usize - columns.end];
                *target = target.plus(sums.lane(lane));
            }
        }
        start += pivots + rows.len().div_ceil(U::LANES) * own.len();
    }
    let mut sums: Vec<U> = Vec::new();
    for s in (0..symbolic.fronts()).rev() {
        let columns = symbolic.columns(s);
        let (own, later) = x[columns.start..].split_at_mut(columns.len());
        let rows = symbolic.rows_of(s);
        let pivots = triangle::<U>(columns.len().div_ceil(U::LANES));
        start -= pivots + rows.len().div_ceil(U::LANES) * own.len();
        let (front, below) = factor[start..].split_at(pivots);
        sums.clear();
        sums.resize(own.len(), U::ZERO);
        for (row, ids) in below.chunks_exact(own.len()).zip(rows.chunks(U::LANES)) {
            let mut values = U::ZERO;
            for (lane, &id) in ids.iter().enumerate() {
                values.set_lane(lane, later[id as usize - columns.end]);
            }
            for (sum, unit) in sums.iter_mut().zip(row) {
                *sum = sum.plus_product(unit, &values);
            }
        }
        for t in (0..own.len().div_ceil(U::LANES)).rev() {
            let tile = t * U::LANES;
            let row = &front[triangle::<U>(t)..];
            let mut values = U::ZERO;
            for c in (tile..own.len().min(tile + U::LANES)).rev() {
                let unit = &row[c];
                // The lanes of `values` up to this one are still zero.
                let known = sums[c].plus_product(unit, &values).sum();
                let value = own[c].minus(known).by(unit.lane(c - tile));
                own[c] = value;
                values.set_lane(c - tile, value);
            }
            for (sum, unit) in sums[..tile].iter_mut().zip(row) {
                *sum = sum.plus_product(unit, &values);
            }
        }
    }
}

/// − Σ `units[k]` · `x[k]`, in two sums that do not wait for each other.
#[inline(always)]
fn dot<U: Unit>(units: &[U], x: &[U::Element]) -> U {
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
    for lane in 0..U::LANES {
        even.set_lane(lane, even.lane(lane).plus(odd.lane(lane)));
    }
    even
}

/// Overwrites as many right-hand sides as a unit has lanes, a unit for each unknown, with their solutions.
pub(super) fn solve_block<U: Unit>(symbolic: &Symbolic, factor: &[U], x: &mut [U]) {
    let mut gathered: Vec<U> = vec![U::ZERO; U::LANES];
    let mut start = 0;
    for s in 0..symbolic.fronts() {
        let columns = symbolic.columns(s);
        let (own, later) = x[columns.start..].split_at_mut(columns.len());
        let rows = symbolic.rows_of(s);
        let pivots = triangle::<U>(columns.len().div_ceil(U::LANES));
        for tile in (0..own.len()).step_by(U::LANES) {
            let row = &factor[start + triangle::<U>(tile / U::LANES)..];
            let (done, open) = own.split_at_mut(tile);
            let open = &mut open[..U::LANES.min(columns.len() - tile)];
            U::update(open, done, &row[..tile]);
            for c in 0..open.len() {
                let unit = &row[tile + c];
                let solved = scaled(&open[c], unit.lane(c));
                open[c] = solved;
                for other in c + 1..open.len() {
                    open[other] = open[other].minus_scaled(&solved, unit.lane(other));
                }
            }
        }
        let below = &factor[start + pivots..];
        for (row, ids) in below.chunks_exact(own.len()).zip(rows.chunks(U::LANES)) {
            for (unit, &id) in gathered.iter_mut().zip(ids) {
                *unit = later[id as usize - columns.end];
            }
            U::update(&mut gathered, own, row);
            for (unit, &id) in gathered.iter().zip(ids) {
                later[id as usize - columns.end] = *unit;
            }
        }
        start += pivots + rows.len().div_ceil(U::LANES) * own.len();
    }
    for s in (0..symbolic.fronts()).rev() {
        let columns = symbolic.columns(s);
        let (own, later) = x[columns.start..].split_at_mut(columns.len());
        let rows = symbolic.rows_of(s);
        let pivots = triangle::<U>(columns.len().div_ceil(U::LANES));
        start -= pivots + rows.len().div_ceil(U::LANES) * own.len();
        let (front, below) = factor[start..].split_at(pivots);
        for (row, ids) in below.chunks_exact(own.len()).zip(rows.chunks(U::LANES)) {
            gathered.fill(U::ZERO);
            for (unit, &id) in gathered.iter_mut().zip(ids) {
                *unit = later[id as usize - columns.end];
            }
            subtract_transposed(own, row, &gathered);
        }
        for tile in (0..own.len()).step_by(U::LANES).rev() {
            let row = &front[triangle::<U>(tile / U::LANES)..];
            let (before, open) = own.split_at_mut(tile);
            let open = &mut open[..U::LANES.min(columns.len() - tile)];
            for c in (0..open.len()).rev() {
                let unit = &row[tile + c];
                let mut value = open[c];
                for other in c + 1..open.len() {
                    value = value.minus_scaled(&open[other], unit.lane(other));
                }
                open[c] = scaled(&value, unit.lane(c));
            }
            gathered.fill(U::ZERO);
            gathered[..open.len()].copy_from_slice(open);
            subtract_transposed(before, &row[..tile], &gathered);
        }
    }
}

/// `results[k]` −= Σ over lanes of lane i of `row[k]` · `values[i]`
#[inline(always)]
fn subtract_transposed<U: Unit>(results: &mut [U], row: &[U], values: &[U]) {
    for (result, unit) in results.iter_mut().zip(row) {
        for (lane, value) in values.iter().enumerate() {
            *result = result.minus_scaled(value, unit.lane(lane));
        }
    }
}

#[inline(always)]
fn scaled<U: Unit>(unit: &U, factor: U::Element) -> U {
    U::ZERO.minus_scaled(unit, U::Element::ZERO.minus(factor))
}
