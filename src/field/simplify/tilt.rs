//! Doubles for vertices that are in order but have equal heights: the smallest steps that tell neighbours apart.

use super::flats::Surroundings;
use crate::error::FieldError;
use crate::field::arrays::{copied, filled};
use crate::field::sorting::sort_by_value;
use crate::mesh::Connectivity;
use crate::support::pieces::pieces;
use crate::support::watch::Watch;

/// The work with one edge, and with one vertex.
const EDGE: u64 = 4;
const VERTEX: u64 = 10;

/// Values near `heights` that ascend along every edge from the lower height to the higher, and at one height from the vertex that
/// comes first in `order` to the other one; equal values count as ascending where ids do.
///
/// A value is its height, or the least double above its neighbours before it; where that would be more than `bound` above
/// the original value, all of that height start so many steps lower, if that helps.
pub(super) fn tilted(
    connectivity: &Connectivity,
    around: &Surroundings,
    heights: &[f64],
    mut order: Vec<u32>,
    original: &[f64],
    bound: f64,
    watch: &Watch<'_>,
) -> Result<Vec<f64>, FieldError> {
    let alone = climb_alone(around, heights, &order, watch)?;
    watch.tick(VERTEX * heights.len() as u64 + EDGE * connectivity.edges().len() as u64)?;
    if stay_apart(connectivity, heights, &alone)
        && alone.iter().zip(original).all(|(value, from)| value - from <= bound)
    {
        return Ok(alone);
    }
    drop(alone);
    // Heights lie so close that the steps of one reach the next.
    sort_by_value(&mut order, heights, watch)?;
    let plain = climb(connectivity, heights, &order, heights, watch)?;
    let mut bases = copied(heights)?;
    watch.tick(4 * VERTEX * heights.len() as u64)?;
    let mut lowered = false;
    for run in order.chunk_by(|&a, &b| heights[a as usize] == heights[b as usize]) {
        let mut excess = 0;
        for &v in run {
            let v = v as usize;
            excess = steps_above(plain[v], heights[v], original[v], bound).max(excess);
        }
        if excess > 0 {
            lowered = true;
            for &v in run {
                bases[v as usize] = number((ordinal(heights[v as usize]) - excess).max(ordinal(f64::MIN)));
            }
        }
    }
    if !lowered {
        return Ok(plain);
    }
    let other = climb(connectivity, heights, &order, &bases, watch)?;
    Ok(if change(original, &other) < change(original, &plain) { other } else { plain })
}

/// The values as they would be if there were no other heights.
fn climb_alone(
    around: &Surroundings,
    heights: &[f64],
    order: &[u32],
    watch: &Watch<'_>,
) -> Result<Vec<f64>, FieldError> {
    let mut values = copied(heights)?;
    let mut placed = filled(false, heights.len())?;
    for piece in pieces(order, 2 * VERTEX, watch) {
        for &v in piece? {
            let mut value = heights[v as usize];
            for &w in around.beside(v) {
                if placed[w as usize] {
                    let below = values[w as usize];
                    value = value.max(if w < v { below } else { below.next_up() });
                }
            }
            values[v as usize] = value;
            placed[v as usize] = true;
        }
    }
    Ok(values)
}

/// Whether the values are in the order of the heights along every edge.
fn stay_apart(connectivity: &Connectivity, heights: &[f64], values: &[f64]) -> bool {
    let is_below = |a: u32, b: u32| {
        let (x, y) = (values[a as usize], values[b as usize]);
        x < y || (x == y && a < b)
    };
    connectivity.edges().iter().all(|&[a, b]| {
        let (x, y) = (heights[a as usize], heights[b as usize]);
        x == y || (x < y) == is_below(a, b)
    })
}

fn change(before: &[f64], after: &[f64]) -> f64 {
    before.iter().zip(after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How many doubles lie between `value` and the greatest one within the bound; none are counted below the height.
fn steps_above(value: f64, height: f64, original: f64, bound: f64) -> i64 {
    let (mut within, mut above) = (ordinal(height), ordinal(value));
    if value - original <= bound || above <= within {
        return 0;
    }
    let highest = above;
    while above - within > 1 {
        let middle = within + (above - within) / 2;
        if number(middle) - original <= bound {
            within = middle;
        } else {
            above = middle;
        }
    }
    highest - within
}

/// The place of a double among all, 0 for 0.
fn ordinal(value: f64) -> i64 {
    let bits = (value + 0.0).to_bits() as i64;
    if bits < 0 { i64::MIN - bits } else { bits }
}

/// The double of a place.
fn number(ordinal: i64) -> f64 {
    let size = f64::from_bits(ordinal.unsigned_abs());
    if ordinal < 0 { -size } else { size }
}

fn climb(
    connectivity: &Connectivity,
    heights: &[f64],
    order: &[u32],
    bases: &[f64],
    watch: &Watch<'_>,
) -> Result<Vec<f64>, FieldError> {
    let mut values = copied(heights)?;
    let mut placed = filled(false, heights.len())?;
    let mut highest = f64::NEG_INFINITY;
    for piece in pieces(order, 2 * VERTEX, watch) {
        for &v in piece? {
            let index = v as usize;
            let mut value = bases[index];
            // Above everything so far, there is nothing to ask. Most vertices are.
            if value <= highest {
                for [a, b] in connectivity.link(v) {
                    for w in [a, b] {
                        if placed[w as usize] {
                            let below = values[w as usize];
                            value = value.max(if w < v { below } else { below.next_up() });
                        }
                    }
                }
            }
            values[index] = value;
            placed[index] = true;
            highest = highest.max(value);
        }
    }
    Ok(values)
}
