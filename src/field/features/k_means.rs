//! Clusters of values by Lloyd's iterations on a line.

use core::ops::Range;

use super::line::Line;
use super::seeding::seeded;
use crate::error::FieldError;
use crate::field::arrays::{collected, copied, filled, with_room};
use crate::field::scalar_field::ScalarField;
use crate::field::sorting::{ascending_bits, sort_by_key};
use crate::support::pieces::ranges;
use crate::support::random::Random;
use crate::support::watch::{Phase, Watch};

/// So many bounds may be moved in all: Lloyd's iterations can be as many as the square of the clusters, and the last ones move
/// hardly anything.
const MOST_MOVES: usize = 2_000_000;
/// The work with one bound.
const MOVE: u64 = 300;
/// So many iterations are done even so.
const FEWEST_MOST_ITERATIONS: usize = 20;

/// For each cluster of the values the vertex whose value is nearest to its mean, and of several the one with the smallest id.
pub(super) fn representatives(
    field: &ScalarField<'_>,
    clusters: usize,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    let mut plan = watch.plan(&[(Phase::Field, 2.0), (Phase::Field, 1.0), (Phase::Field, 2.0)]);
    plan.begin(110 * field.values().len() as u64)?;
    let (line, values) = (Line::new(field, watch)?, field.values());
    let ids = line.ids();
    // Ids of equal values ascend, so the first of each value has the smallest.
    let is_first = |i: usize| i == 0 || values[ids[i - 1] as usize] != values[ids[i] as usize];
    let different = (0..ids.len()).filter(|&i| is_first(i)).count();
    if clusters >= different {
        return Ok(collected(different, (0..ids.len()).filter(|&i| is_first(i)).map(|i| ids[i]))?);
    }
    plan.begin(2_000 * clusters as u64)?;
    let mut bounds = seeded(&line, clusters, &mut Random::new(seed), watch)?;
    // Nobody knows how many iterations there will be.
    plan.begin(40 * MOVE * clusters as u64)?;
    for _ in 0..(MOST_MOVES / clusters).max(FEWEST_MOST_ITERATIONS) {
        let mut next = moved(&line, &bounds, watch)?;
        if next.len() <= clusters {
            next = divided(&line, &next, &gains(&line, &next, watch)?, clusters, watch)?;
        }
        if next == bounds {
            match exchanged(&line, &bounds, clusters, watch)? {
                Some(better) => next = better,
                None => break,
            }
        }
        bounds = next;
    }
    plan.finish()?;
    let nearest = bounds.windows(2).map(|ends| nearest_to_mean(&line, ends[0], ends[1]));
    Ok(collected(bounds.len(), nearest)?)
}

/// Where clusters begin, and where the last one ends, after each value went to the nearest mean, the lower one of two. Clusters
/// that become empty drop out.
fn moved(line: &Line, bounds: &[usize], watch: &Watch<'_>) -> Result<Vec<usize>, FieldError> {
    let mut next = with_room(bounds.len())?;
    next.push(0);
    for range in ranges(bounds.len().saturating_sub(2), MOVE, watch) {
        for i in range? {
            let (start, middle, end) = (bounds[i], bounds[i + 1], bounds[i + 2]);
            // (s/m + t/n) / 2, rounded down, as a place is an integer. Clusters are never empty.
            let (m, n) = ((middle - start) as u128, (end - middle) as u128);
            let half_way = (line.sum(start, middle) * n + line.sum(middle, end) * m) / (2 * m * n);
            let bound = line.first_above(start, end, half_way as u64);
            if bound > next[next.len() - 1] {
                next.push(bound);
            }
        }
    }
    next.push(line.len());
    Ok(next)
}

/// By how much a bound lessens the sum of squared distances from means: mn/(m + n) (s/m − t/n)².
fn worth(line: &Line, start: usize, middle: usize, end: usize) -> f64 {
    let (m, n) = ((middle - start) as u128, (end - middle) as u128);
    let difference = (line.sum(middle, end) * m).abs_diff(line.sum(start, middle) * n) as f64;
    if m * n == 0 { 0.0 } else { difference * difference / ((m * n) as f64 * (m + n) as f64) }
}

/// What dividing each cluster at its mean is worth: 0 where all its places are equal.
fn gains(line: &Line, bounds: &[usize], watch: &Watch<'_>) -> Result<Vec<f64>, FieldError> {
    let mut gains = with_room(bounds.len())?;
    for range in ranges(bounds.len() - 1, MOVE, watch) {
        let Range { start, end } = range?;
        gains.extend(bounds[start..=end].windows(2).map(|ends| worth(line, ends[0], middle_of(line, ends), ends[1])));
    }
    Ok(gains)
}

fn middle_of(line: &Line, ends: &[usize]) -> usize {
    line.first_above(ends[0], ends[1], line.mean(ends[0], ends[1]))
}

/// Divides as many clusters at their means as are missing, those that gain most.
fn divided(
    line: &Line,
    bounds: &[usize],
    gains: &[f64],
    clusters: usize,
    watch: &Watch<'_>,
) -> Result<Vec<usize>, FieldError> {
    let mut best = collected(gains.len(), (0..gains.len() as u32).filter(|&i| gains[i as usize] > 0.0))?;
    sort_by_key(&mut best, &|i| !ascending_bits(gains[i as usize]), watch)?;
    best.truncate(clusters + 1 - bounds.len());
    let mut is_divided = filled(false, gains.len())?;
    best.iter().for_each(|&i| is_divided[i as usize] = true);
    let mut next = with_room(clusters + 1)?;
    for (i, ends) in bounds.windows(2).enumerate() {
        next.push(ends[0]);
        if is_divided[i] {
            next.push(middle_of(line, ends));
        }
    }
    next.push(line.len());
    Ok(next)
}

/// Takes away the bound that is worth least, and divides a cluster, where that is worth more by more than rounding: Lloyd's
/// iterations alone stay where too few means began.
fn exchanged(
    line: &Line,
    bounds: &[usize],
    clusters: usize,
    watch: &Watch<'_>,
) -> Result<Option<Vec<usize>>, FieldError> {
    watch.tick(20 * bounds.len() as u64)?;
    let (mut least, mut at) = (f64::INFINITY, 0);
    for i in 1..bounds.len() - 1 {
        let loss = worth(line, bounds[i - 1], bounds[i], bounds[i + 1]);
        if loss < least {
            (least, at) = (loss, i);
        }
    }
    if at == 0 {
        return Ok(None);
    }
    let mut fewer = copied(bounds)?;
    fewer.remove(at);
    let gains = gains(line, &fewer, watch)?;
    let is_better = gains.iter().any(|&gain| gain > least * (1.0 + 1e-9));
    if is_better { Ok(Some(divided(line, &fewer, &gains, clusters, watch)?)) } else { Ok(None) }
}

fn nearest_to_mean(line: &Line, start: usize, end: usize) -> u32 {
    // Distances times the length of the interval, so that they are integers.
    let (length, sum) = ((end - start) as u128, line.sum(start, end));
    let distance = |i: usize| sum.abs_diff(u128::from(line.place(i)) * length);
    let after = line.first_above(start, end, line.mean(start, end));
    let least = if after < end { distance(after - 1).min(distance(after)) } else { distance(after - 1) };
    let below = (start..after).rev().take_while(|&i| distance(i) == least);
    let above = (after..end).take_while(|&i| distance(i) == least);
    below.chain(above).map(|i| line.ids()[i]).min().unwrap_or(line.ids()[start])
}
