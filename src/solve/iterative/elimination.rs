//! Exact elimination of the few unknowns that tie others together so stiffly that no smoother loosens them.
//!
//! A needle triangle with an obtuse corner c between a and b couples the three by a large multiple of (x_a − 2x_c + x_b)²: all
//! that is linear along it costs nothing, and point by point the smoother hardly moves such errors. Without c that term is
//! gone. Iterations of multigrid fall from 56 to 18 on a jittered torus of 100,000 vertices, for 7 % of its unknowns.

use super::rows::{Rows, SymmetricRows};
use crate::Watch;
use crate::error::SolveError;
use crate::support::memory;

/// An unknown i is stiff where a_ij² ≥ this · a_ii a_jj for a neighbour j with a_jj ≤ a_ii. Regular meshes have 1/36, long
/// rows of equal couplings at most 1/4, needles up to 1.
const STIFF: f64 = 0.3;
/// Eliminating an unknown links its neighbours pairwise; past this many that costs more than it helps.
const MOST_NEIGHBOURS: usize = 12;
/// Rows longer than this are not searched for entries to change.
const LONG_ROW: usize = 64;

/// What rows that change take for each entry of the matrix, with the matrix that is left.
const BYTES_PER_ENTRY: usize = 120;

/// An entry of the matrix, while stiff unknowns are sought.
const TICKS_PER_ENTRY: u64 = 50;
/// An unknown that is eliminated.
const TICKS_PER_UNKNOWN: u64 = 2000;

/// The unknowns eliminated and what is needed to put them back.
#[derive(Debug, Clone, Default)]
pub(super) struct Elimination {
    /// In the order of elimination.
    eliminated: Vec<u32>,
    /// Reciprocals of their pivots.
    inverse: Vec<f64>,
    /// The weights −a_ij/a_ii of their neighbours at that time.
    weights: Rows,
    /// The unknowns that are left, ascending.
    pub(super) kept: Vec<u32>,
}

/// A symmetric matrix whose rows change one by one.
struct Changing<'a> {
    matrix: &'a SymmetricRows,
    /// Where among `changed` a row is, if at all.
    places: Vec<u32>,
    changed: Vec<Vec<(u32, f64)>>,
}

const UNCHANGED: u32 = u32::MAX;
const GONE: u32 = u32::MAX - 1;

impl Elimination {
    /// Eliminates what is stiff; the matrix on the unknowns that are left.
    pub(super) fn new(matrix: SymmetricRows, watch: &Watch<'_>) -> Result<(Self, SymmetricRows), SolveError> {
        let n = matrix.size();
        let mut rows = Changing { matrix: &matrix, places: vec![UNCHANGED; n], changed: Vec::new() };
        let mut elimination = Self::default();
        elimination.weights.offsets.push(0);
        let mut open: Vec<u32> = Vec::new();
        for i in 0..n {
            if rows.is_stiff(i) {
                memory::make_room(&mut open, 1)?;
                open.push(i as u32);
            }
            watch.tick(TICKS_PER_ENTRY * matrix.rows.range(i).len() as u64)?;
        }
        if !open.is_empty() {
            memory::ensure((BYTES_PER_ENTRY * matrix.rows.values.len()) as u64)?;
        }
        while !open.is_empty() {
            let mut next = Vec::new();
            for i in open {
                if rows.places[i as usize] != GONE && rows.is_stiff(i as usize) {
                    elimination.eliminate(&mut rows, i, &mut next)?;
                    watch.tick(TICKS_PER_UNKNOWN)?;
                }
            }
            open = next;
        }
        elimination.kept = (0..n as u32).filter(|&i| rows.places[i as usize] != GONE).collect();
        if elimination.eliminated.is_empty() {
            return Ok((elimination, matrix));
        }
        let reduced = rows.reduced(&elimination.kept);
        // Symmetric, so transposing does no more than sort.
        let reduced =
            SymmetricRows::from_rows(reduced.transposed(watch)?).map_err(|error| elimination.name_unknown(error))?;
        Ok((elimination, reduced))
    }

    /// Eliminates one unknown and lists its neighbours, which may have become stiff.
    fn eliminate(&mut self, rows: &mut Changing<'_>, i: u32, next: &mut Vec<u32>) -> Result<(), SolveError> {
        let row: Vec<(u32, f64)> = rows.row(i as usize).collect();
        let pivot = row.iter().find(|&&(j, _)| j == i).map_or(0.0, |&(_, value)| value);
        if !(pivot > 0.0 && (1.0 / pivot).is_finite()) {
            return Err(SolveError::NotPositiveDefinite { column: i as usize });
        }
        let scale = 1.0 / pivot.sqrt();
        rows.places[i as usize] = GONE;
        for &(j, value) in row.iter().filter(|&&(j, _)| j != i) {
            let other = rows.change(j as usize);
            other.retain(|&(k, _)| k != i);
            for &(k, beside) in row.iter().filter(|&&(k, _)| k != i) {
                // The same in both triangles to the last digit.
                let change = -(value * scale) * (beside * scale);
                match other.iter_mut().find(|(column, _)| *column == k) {
                    Some((_, entry)) => *entry += change,
                    None => other.push((k, change)),
                }
            }
            next.push(j);
            self.weights.columns.push(j);
            self.weights.values.push(-value / pivot);
        }
        self.weights.offsets.push(self.weights.columns.len() as u32);
        self.eliminated.push(i);
        self.inverse.push(1.0 / pivot);
        Ok(())
    }

    /// The right-hand side for the unknowns that are left; `r` is changed for [`Elimination::backward`].
    pub(super) fn forward(&self, r: &mut [f64]) -> Vec<f64> {
        for (row, &i) in self.eliminated.iter().enumerate() {
            let value = r[i as usize];
            for (j, weight) in self.weights.row(row) {
                r[j] += weight * value;
            }
        }
        self.kept.iter().map(|&i| r[i as usize]).collect()
    }

    /// Makes the solution for all unknowns of that for those left.
    pub(super) fn backward(&self, solution: &[f64], r: &mut [f64]) {
        for (&i, &x) in self.kept.iter().zip(solution) {
            r[i as usize] = x;
        }
        for (row, &i) in self.eliminated.iter().enumerate().rev() {
            r[i as usize] = r[i as usize] * self.inverse[row] + self.weights.gather(self.weights.range(row), r);
        }
    }

    /// Puts the original name of an unknown into an error.
    pub(super) fn name_unknown(&self, error: SolveError) -> SolveError {
        match error {
            SolveError::NotPositiveDefinite { column } => {
                SolveError::NotPositiveDefinite { column: self.kept.get(column).map_or(column, |&i| i as usize) }
            }
            other => other,
        }
    }
}

impl Changing<'_> {
    /// (column, value) of a row, in any order.
    fn row(&self, i: usize) -> impl Iterator<Item = (u32, f64)> {
        let changed = self.changed.get(self.places[i] as usize).map_or(&[][..], |row| &row[..]);
        let range = if self.places[i] == UNCHANGED { self.matrix.rows.range(i) } else { 0..0 };
        let original = self.matrix.rows.columns[range.clone()].iter().zip(&self.matrix.rows.values[range]);
        original.map(|(&j, &value)| (j, value)).chain(changed.iter().copied())
    }

    fn length(&self, i: usize) -> usize {
        self.changed.get(self.places[i] as usize).map_or_else(|| self.matrix.rows.range(i).len(), Vec::len)
    }

    fn diagonal(&self, i: usize) -> f64 {
        self.changed.get(self.places[i] as usize).map_or_else(
            || self.matrix.diagonal(i),
            |row| row.iter().find(|&&(j, _)| j as usize == i).map_or(0.0, |&(_, value)| value),
        )
    }

    fn is_stiff(&self, i: usize) -> bool {
        if self.length(i) > MOST_NEIGHBOURS + 1 {
            return false;
        }
        let own = self.diagonal(i);
        let stiff = |(j, value): (u32, f64)| {
            let j = j as usize;
            // Ratios, because squares may leave the range of double precision.
            let other = self.diagonal(j);
            i != j && other <= own && (value.abs() / own) * (value.abs() / other) >= STIFF
        };
        self.row(i).any(stiff) && self.row(i).all(|(j, _)| self.length(j as usize) <= LONG_ROW)
    }

    /// A row to be changed.
    fn change(&mut self, i: usize) -> &mut Vec<(u32, f64)> {
        if self.places[i] == UNCHANGED {
            let row = self.row(i).collect();
            self.places[i] = self.changed.len() as u32;
            self.changed.push(row);
        }
        &mut self.changed[self.places[i] as usize]
    }

    /// The rows and columns in `kept`, under new names.
    fn reduced(&self, kept: &[u32]) -> Rows {
        let mut names = vec![0; self.places.len()];
        for (new, &old) in kept.iter().enumerate() {
            names[old as usize] = new as u32;
        }
        let mut reduced = Rows { offsets: vec![0], width: kept.len(), ..Rows::default() };
        for &i in kept {
            // Rows beside an eliminated one have lost it, so all their columns are kept ones.
            for (j, value) in self.row(i as usize) {
                reduced.columns.push(names[j as usize]);
                reduced.values.push(value);
            }
            reduced.offsets.push(reduced.columns.len() as u32);
        }
        reduced
    }
}
