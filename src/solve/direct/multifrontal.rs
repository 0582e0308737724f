//! The numeric factorisation: fronts are assembled from the entries of the matrix and the updates of their children, and
//! eliminated, children before parents (\[Duff83\], \[Liu92\]).

use nalgebra_sparse::pattern::SparsityPattern;

use super::front::{Diagonal, Front, Stopped, elimination_ticks, sizes, triangle};
use super::scalar::{LaneBlock, Scalar};
use super::symbolic::Symbolic;
use crate::Watch;
use crate::error::{OutOfMemory, SolveError};
use crate::support::memory;

/// Lane blocks of the whole factor, and of the stack of updates at its fullest.
pub(super) fn storage<B: LaneBlock>(symbolic: &Symbolic) -> (u64, u64) {
    let (mut total, mut held, mut peak) = (0_u64, 0_u64, 0_u64);
    let mut stacks: [Vec<u64>; 2] = [Vec::new(), Vec::new()];
    for s in 0..symbolic.fronts() {
        let (factor, update) = sizes::<B>(symbolic.columns(s).len(), symbolic.rows_of(s).len());
        total += factor;
        held += update;
        peak = peak.max(held);
        let [own, others] = sides(&mut stacks, symbolic.odd[s]);
        own.push(update);
        for _ in 0..symbolic.children[s] {
            held -= others.pop().unwrap_or(0);
        }
    }
    (total, peak)
}

/// The side of a front, and the side of its children.
fn sides<T>(both: &mut [T; 2], odd: bool) -> [&mut T; 2] {
    let [even_side, odd_side] = both;
    if odd { [odd_side, even_side] } else { [even_side, odd_side] }
}

/// Of the last pivot of a singular matrix of n unknowns, rounding leaves less than this many times √n roundings of the
/// diagonal entry: a third of it was the most in the Laplacians, and squared Laplacians, of all kinds of meshes.
const NEGLIGIBLE: f64 = 256.0;
/// Pivots of sound matrices can be this small a fraction of their entries, where triangles are needles. It leaves single
/// precision without a sure way to tell singular matrices: there a solution has to be checked, as refinement does.
const MOST_NEGLIGIBLE: f64 = 1e-5;

/// The room for one front.
const TICKS_PER_ALLOCATION: u64 = 500;
/// Lane blocks that are set to zero for the first time before the watch is told.
const CHUNK: usize = 1 << 16;

/// A matrix, multiplied by a number.
pub(super) struct ScaledMatrix<'a, B: LaneBlock> {
    pub(super) pattern: &'a SparsityPattern,
    pub(super) values: &'a [<B::Element as Scalar>::Wide],
    pub(super) scale: f64,
}

/// The ticks of setting up a front whose part of the factor and whose update take so many lane blocks, and of adding its
/// update to its parent.
fn assembly_ticks<B: LaneBlock>(factor: u64, update: u64) -> u64 {
    let (blocks, moved) = (factor.saturating_add(update), update.saturating_mul(B::LANES as u64));
    blocks.saturating_mul(2).saturating_add(moved.saturating_mul(3)).saturating_add(500)
}

/// The ticks of the whole factorisation.
pub(super) fn factorization_ticks<B: LaneBlock>(symbolic: &Symbolic) -> u64 {
    let of_front = |s| {
        let (columns, rows) = (symbolic.columns(s).len(), symbolic.rows_of(s).len());
        let (factor, update) = sizes::<B>(columns, rows);
        assembly_ticks::<B>(factor, update).saturating_add(elimination_ticks::<B>(columns, rows))
    };
    (0..symbolic.fronts()).map(of_front).fold(0, u64::saturating_add)
}

/// What a factorisation needs besides the factor, kept for the next one.
#[derive(Debug, Clone)]
pub(super) struct Workspace<B: LaneBlock> {
    /// Updates that wait for their parents: those of fronts at an even depth from the front end, the others from the back,
    /// so that a new update never has to be moved when its children's are let go.
    stack: Vec<B>,
    /// For the columns and rows of the front at hand their places in it.
    places: Vec<u32>,
    /// For the rows of one child their places in the front at hand.
    child_places: Vec<u32>,
    diagonal: Vec<B::Element>,
}

/// Allocates, or says how much could not be had.
pub(super) fn reserve<T>(blocks: u64) -> Result<Vec<T>, SolveError> {
    let bytes = blocks.saturating_mul(size_of::<T>() as u64);
    let mut vector = Vec::new();
    match usize::try_from(blocks).map(|blocks| vector.try_reserve_exact(blocks)) {
        Ok(Ok(())) => Ok(vector),
        _ => Err(SolveError::OutOfMemory { bytes }),
    }
}

/// Memory that is asked for ahead of the fronts that are put there. WebAssembly's memory grows slowly in small steps, and
/// never shrinks: more than this is not taken where smaller pieces are still free.
const AHEAD: u64 = 16 << 20;

/// Room for every front's part of the factor. One allocation each: they find room among what earlier work left behind,
/// where the whole factor would not.
pub(super) fn reserve_fronts<B: LaneBlock>(symbolic: &Symbolic, watch: &Watch<'_>) -> Result<Vec<Vec<B>>, SolveError> {
    let size = |s| sizes::<B>(symbolic.columns(s).len(), symbolic.rows_of(s).len()).0;
    let mut fronts = memory::with_room(symbolic.fronts())?;
    let mut left: u64 = (0..symbolic.fronts()).map(size).sum::<u64>() * size_of::<B>() as u64;
    let mut ahead = 0;
    for s in 0..symbolic.fronts() {
        let bytes = size(s) * size_of::<B>() as u64;
        if bytes > ahead {
            ahead = AHEAD.max(bytes).min(left);
            // Where so much is not to be had in one piece, smaller ones may be.
            let _: Result<(), OutOfMemory> = memory::ensure(ahead);
            watch.tick(ahead / 8)?;
        }
        fronts.push(reserve(size(s))?);
        ahead -= bytes;
        left -= bytes;
        watch.tick(TICKS_PER_ALLOCATION)?;
    }
    Ok(fronts)
}

impl<B: LaneBlock> Workspace<B> {
    pub(super) fn new(symbolic: &Symbolic, stack: u64, watch: &Watch<'_>) -> Result<Self, SolveError> {
        let most = |length: &dyn Fn(usize) -> usize| (0..symbolic.fronts()).map(length).max().unwrap_or(0);
        let mut workspace = Self {
            stack: reserve(stack)?,
            places: memory::filled(0, symbolic.permutation.new_to_old().len())?,
            child_places: memory::with_room(most(&|s| symbolic.rows_of(s).len()))?,
            diagonal: memory::with_room(most(&|s| symbolic.columns(s).len()))?,
        };
        while workspace.stack.len() < stack as usize {
            let length = (workspace.stack.len() + CHUNK).min(stack as usize);
            workspace.stack.resize(length, B::ZERO);
            watch.tick((CHUNK * size_of::<B>()) as u64)?;
        }
        Ok(workspace)
    }

    /// Computes the factor of the matrix into `factor`, a vector with the capacity for it for every front. Ends early at the
    /// place of a column whose pivot fails; where it `raises` pivots, lost ones are raised instead.
    pub(super) fn factorize(
        &mut self,
        symbolic: &Symbolic,
        matrix: &ScaledMatrix<'_, B>,
        factor: &mut [Vec<B>],
        raises: bool,
        watch: &Watch<'_>,
    ) -> Result<(), Stopped> {
        let negligible = (NEGLIGIBLE * B::Element::EPSILON * (self.places.len() as f64).sqrt()).min(MOST_NEGLIGIBLE);
        // Fronts whose updates wait at either end, and where the free part of the stack begins and ends.
        let mut waiting: [Vec<u32>; 2] = [Vec::new(), Vec::new()];
        let mut free = [0, self.stack.len()];
        for (s, factor) in factor.iter_mut().enumerate() {
            let columns = symbolic.columns(s);
            let rows = symbolic.rows_of(s);
            // There is room for both, so they are addresses.
            let (factor_size, update_size) = sizes::<B>(columns.len(), rows.len());
            let (factor_size, update_size) = (factor_size as usize, update_size as usize);
            // Only now, so that the zeros are still in the cache when the front is assembled.
            set_zero(factor, factor_size);
            for (place, column) in columns.clone().enumerate() {
                self.places[column] = place as u32;
            }
            for (place, &row) in rows.iter().enumerate() {
                self.places[row as usize] = (columns.len() + place) as u32;
            }
            let odd = symbolic.odd[s];
            let (update, children) = split_stack(&mut self.stack, free, update_size, odd);
            clear(update);
            let mut front = Front { columns: columns.len(), factor, update };
            self.diagonal.clear();
            for column in columns.clone() {
                let entry = assemble_column(&mut front, symbolic, matrix, column, &self.places);
                self.diagonal.push(entry);
            }
            let [own, others] = sides(&mut waiting, odd);
            let mut released = 0;
            for _ in 0..symbolic.children[s] {
                let child_rows = others.pop().map_or(&[][..], |child| symbolic.rows_of(child as usize));
                self.child_places.clear();
                self.child_places.extend(child_rows.iter().map(|&row| self.places[row as usize]));
                let size = triangle::<B>(child_rows.len().div_ceil(B::LANES));
                // The last child lies next to the free part.
                let child = if odd {
                    let end = children.len() - released;
                    &children[end - size..end]
                } else {
                    &children[released..released + size]
                };
                add_child(&mut front, child, &self.child_places);
                released += size;
            }
            let diagonal = Diagonal { entries: &self.diagonal, negligible, raises };
            watch.tick(assembly_ticks::<B>(factor_size as u64, update_size as u64))?;
            front.eliminate(diagonal, watch).map_err(|stopped| match stopped {
                Stopped::At(column) => Stopped::At(columns.start + column),
                cancelled @ Stopped::Cancelled(_) => cancelled,
            })?;
            own.push(s as u32);
            if odd {
                free[0] -= released;
                free[1] -= update_size;
            } else {
                free[1] += released;
                free[0] += update_size;
            }
        }
        Ok(())
    }
}

// Engines compile a function better once it has been called often. What takes time is therefore kept out of the one
// function that is called once and runs long.

#[inline(never)]
fn set_zero<B: LaneBlock>(factor: &mut Vec<B>, size: usize) {
    factor.clear();
    factor.resize(size, B::ZERO);
}

#[inline(never)]
fn clear<B: LaneBlock>(blocks: &mut [B]) {
    blocks.fill(B::ZERO);
}

/// Room for an update beside the free part, at the even or odd end, and all that waits at the other end.
fn split_stack<B>(stack: &mut [B], free: [usize; 2], size: usize, odd: bool) -> (&mut [B], &[B]) {
    if odd {
        let (children, rest) = stack[..free[1]].split_at_mut(free[0]);
        let start = rest.len() - size;
        (&mut rest[start..], children)
    } else {
        let (rest, children) = stack[free[0]..].split_at_mut(free[1] - free[0]);
        (&mut rest[..size], children)
    }
}

/// Puts the entries of one column of the matrix into the front; its diagonal entry.
#[inline(never)]
fn assemble_column<B: LaneBlock>(
    front: &mut Front<'_, B>,
    symbolic: &Symbolic,
    &ScaledMatrix { pattern, values, scale }: &ScaledMatrix<'_, B>,
    column: usize,
    places: &[u32],
) -> B::Element {
    let old = symbolic.permutation.new_to_old()[column] as usize;
    let old_to_new = symbolic.permutation.old_to_new();
    let start = pattern.major_offsets()[old];
    let place = places[column] as usize;
    let below = triangle::<B>(front.columns.div_ceil(B::LANES));
    let mut diagonal = B::Element::ZERO;
    for (k, &other) in pattern.lane(old).iter().enumerate() {
        let row = old_to_new[other] as usize;
        if row < column {
            continue;
        }
        let value = B::Element::narrow(B::Element::scaled(values[start + k], scale));
        if row == column {
            diagonal = value;
        }
        let row = places[row] as usize;
        let (block, lane) = if row < front.columns {
            (triangle::<B>(row / B::LANES) + place, row % B::LANES)
        } else {
            let row = row - front.columns;
            (below + row / B::LANES * front.columns + place, row % B::LANES)
        };
        front.factor[block].set_lane(lane, value);
    }
    diagonal
}

/// Adds the update of a child, whose rows have the given places in the front.
#[inline(never)]
fn add_child<B: LaneBlock>(front: &mut Front<'_, B>, child: &[B], places: &[u32]) {
    let columns = front.columns;
    // The child's columns that are pivot columns here; the others belong to the update.
    let split = places.partition_point(|&place| (place as usize) < columns);
    let (pivots, below) = front.factor.split_at_mut(triangle::<B>(columns.div_ceil(B::LANES)));
    for (r, &place) in places.iter().enumerate() {
        let source = &child[triangle::<B>(r / B::LANES)..][..=r];
        let (from, place) = (r % B::LANES, place as usize);
        if place < columns {
            let row = &mut pivots[triangle::<B>(place / B::LANES)..];
            add_row(row, place % B::LANES, source, from, &places[..=r], 0);
        } else {
            let (tile, lane) = ((place - columns) / B::LANES, (place - columns) % B::LANES);
            add_row(&mut below[tile * columns..], lane, &source[..split], from, &places[..split], 0);
            let row = &mut front.update[triangle::<B>(tile)..];
            add_row(row, lane, &source[split..], from, &places[split..=r], columns);
        }
    }
}

/// Adds lane `from` of each block of `source` to lane `lane` of the blocks of `row` at `places` less `first`.
#[inline(always)]
fn add_row<B: LaneBlock>(row: &mut [B], lane: usize, source: &[B], from: usize, places: &[u32], first: usize) {
    for (block, &place) in source.iter().zip(places) {
        let target = &mut row[place as usize - first];
        target.set_lane(lane, target.lane(lane).plus(block.lane(from)));
    }
}
