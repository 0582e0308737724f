//! Aggregates of strongly coupled unknowns, and the prolongation from them \[Vanek96\].

use super::rows::{Rows, SymmetricRows};
use crate::Watch;
use crate::error::Cancelled;

/// Unknowns i and j are strongly coupled where −a_ij ≥ θ √(a_ii a_jj) \[Vanek96\]. Positive entries, those of
/// obtuse triangles, push errors apart and so never bind.
const STRONG: f64 = 0.08;
/// A row whose off-diagonal entries sum to no more than this fraction of its diagonal needs no coarse unknown: smoothing
/// alone divides its error by the reciprocal.
const DOMINATED: f64 = 0.2;
/// ω of the step that smooths the prolongation: 4/3 over the largest eigenvalue of the filtered D⁻¹A \[Vanek96\], which is at
/// most 2, because its rows are the identity's minus positive weights with a sum of at most 1.
const RELAXATION: f64 = 2.0 / 3.0;
/// An entry of the matrix in a pass over it.
const TICKS_PER_ENTRY: u64 = 15;
/// In no aggregate yet.
const FREE: u32 = u32::MAX;
/// Needs none.
const LEFT_OUT: u32 = u32::MAX - 1;

/// The prolongation to the unknowns from their aggregates.
pub(super) fn prolongation(matrix: &SymmetricRows, watch: &Watch<'_>) -> Result<Rows, Cancelled> {
    let strength: Vec<f64> = (0..matrix.size()).map(|i| matrix.diagonal(i).sqrt() * STRONG.sqrt()).collect();
    let (aggregates, count) = aggregate(matrix, &strength, watch)?;
    smoothed(matrix, &strength, &aggregates, count, watch)
}

/// The strong neighbours of an unknown with their weights −a_ij.
fn strong<'a>(matrix: &'a SymmetricRows, strength: &'a [f64], i: usize) -> impl Iterator<Item = (usize, f64)> + 'a {
    // The diagonal is positive and so never among them.
    matrix.rows.row(i).filter(move |&(j, value)| -value >= strength[i] * strength[j]).map(|(j, value)| (j, -value))
}

/// The aggregate of every unknown, in the order of the unknowns, and how many there are.
fn aggregate(matrix: &SymmetricRows, strength: &[f64], watch: &Watch<'_>) -> Result<(Vec<u32>, usize), Cancelled> {
    let tick = |i: usize| watch.tick(TICKS_PER_ENTRY * matrix.rows.range(i).len() as u64);
    let n = matrix.size();
    let mut aggregates = vec![FREE; n];
    for i in 0..n {
        let sides: f64 = matrix.rows.row(i).map(|(_, value)| value.abs()).sum::<f64>() - matrix.diagonal(i);
        if sides <= DOMINATED * matrix.diagonal(i) {
            aggregates[i] = LEFT_OUT;
        }
        tick(i)?;
    }
    // Neighbourhoods that nobody has taken from …
    let mut count = 0;
    for i in 0..n {
        let mut neighbours = strong(matrix, strength, i).peekable();
        if aggregates[i] == FREE && neighbours.peek().is_some() && neighbours.all(|(j, _)| aggregates[j] >= LEFT_OUT) {
            take(matrix, strength, &mut aggregates, i, count);
            count += 1;
        }
        tick(i)?;
    }
    // … what is left joins the one it is coupled to most …
    let first = aggregates.clone();
    for i in (0..n).filter(|&i| first[i] == FREE) {
        let taken = strong(matrix, strength, i).filter(|&(j, _)| first[j] < LEFT_OUT);
        if let Some(best) = strongest(taken) {
            aggregates[i] = first[best];
        }
        tick(i)?;
    }
    // … and what has no such neighbour makes aggregates of its own, or follows a weak one.
    for i in 0..n {
        if aggregates[i] != FREE {
            continue;
        }
        if strong(matrix, strength, i).next().is_none() {
            let weak = matrix.rows.row(i).map(|(j, value)| (j, -value));
            if let Some(best) = strongest(weak.filter(|&(j, weight)| weight > 0.0 && aggregates[j] < LEFT_OUT)) {
                aggregates[i] = aggregates[best];
                continue;
            }
        }
        take(matrix, strength, &mut aggregates, i, count);
        count += 1;
    }
    Ok((aggregates, count as usize))
}

/// Makes an aggregate of an unknown and its free strong neighbours.
fn take(matrix: &SymmetricRows, strength: &[f64], aggregates: &mut [u32], i: usize, name: u32) {
    aggregates[i] = name;
    for (j, _) in strong(matrix, strength, i) {
        if aggregates[j] == FREE {
            aggregates[j] = name;
        }
    }
}

/// The first of largest weight.
fn strongest(neighbours: impl Iterator<Item = (usize, f64)>) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (j, weight) in neighbours {
        if best.is_none_or(|(_, most)| weight > most) {
            best = Some((j, weight));
        }
    }
    best.map(|(j, _)| j)
}

/// One step of Jacobi's iteration for the filtered matrix on the indicators of the aggregates. Filtered: weak entries are
/// moved to the diagonal, which keeps sums of rows.
fn smoothed(
    matrix: &SymmetricRows,
    strength: &[f64],
    aggregates: &[u32],
    count: usize,
    watch: &Watch<'_>,
) -> Result<Rows, Cancelled> {
    let mut result = Rows { offsets: vec![0], width: count, ..Rows::default() };
    for (i, &own) in aggregates.iter().enumerate() {
        if own < LEFT_OUT {
            let start = result.columns.len();
            let couplings: f64 = strong(matrix, strength, i).map(|(_, weight)| weight).sum();
            // A negative sum of a row is noise, or the work of positive entries that the filter takes away.
            let excess = matrix.rows.row(i).map(|(_, value)| value).sum::<f64>().max(0.0);
            let step = if couplings > 0.0 { RELAXATION / (couplings + excess) } else { 0.0 };
            let mut add =
                |name: u32, weight: f64| match result.columns[start..].iter().position(|&column| column == name) {
                    Some(place) => result.values[start + place] += weight,
                    None => {
                        result.columns.push(name);
                        result.values.push(weight);
                    }
                };
            add(own, 1.0 - step * (couplings + excess));
            for (j, weight) in strong(matrix, strength, i) {
                if aggregates[j] < LEFT_OUT {
                    add(aggregates[j], step * weight);
                }
            }
        }
        result.offsets.push(result.columns.len() as u32);
        watch.tick(2 * TICKS_PER_ENTRY * matrix.rows.range(i).len() as u64)?;
    }
    Ok(result)
}
