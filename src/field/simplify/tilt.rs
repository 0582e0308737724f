//! Doubles for vertices that are in order but have equal levels: the smallest steps that tell neighbours apart.

use super::flats::Surroundings;
use crate::field::sorting::sort_by_value;
use crate::mesh::Connectivity;

/// Values near `levels` that ascend along every edge from the lower level to the higher, and on one level from the vertex that
/// comes first in `order` to the other one; equal values count as ascending where ids do.
///
/// A value is its level, or the least double above its neighbours before it; where that would be more than `bound` above
/// the original value, the whole level starts so many steps lower, if that helps.
pub(super) fn tilted(
    connectivity: &Connectivity,
    around: &Surroundings,
    levels: &[f64],
    mut order: Vec<u32>,
    original: &[f64],
    bound: f64,
) -> Vec<f64> {
    let alone = climb_alone(around, levels, &order);
    if stay_apart(connectivity, levels, &alone) && alone.iter().zip(original).all(|(value, from)| value - from <= bound)
    {
        return alone;
    }
    drop(alone);
    // Levels lie so close that the steps of one reach the next.
    sort_by_value(&mut order, levels);
    let plain = climb(connectivity, levels, &order, levels);
    let mut bases = levels.to_vec();
    let mut lowered = false;
    for run in order.chunk_by(|&a, &b| levels[a as usize] == levels[b as usize]) {
        let mut excess = 0;
        for &v in run {
            let v = v as usize;
            excess = steps_above(plain[v], levels[v], original[v], bound).max(excess);
        }
        if excess > 0 {
            lowered = true;
            for &v in run {
                bases[v as usize] = number((ordinal(levels[v as usize]) - excess).max(ordinal(f64::MIN)));
            }
        }
    }
    if !lowered {
        return plain;
    }
    let other = climb(connectivity, levels, &order, &bases);
    if change(original, &other) < change(original, &plain) { other } else { plain }
}

/// As if there were no other levels.
fn climb_alone(around: &Surroundings, levels: &[f64], order: &[u32]) -> Vec<f64> {
    let mut values = levels.to_vec();
    let mut placed = vec![false; levels.len()];
    for &v in order {
        let mut value = levels[v as usize];
        for &w in around.level(v) {
            if placed[w as usize] {
                let below = values[w as usize];
                value = value.max(if w < v { below } else { below.next_up() });
            }
        }
        values[v as usize] = value;
        placed[v as usize] = true;
    }
    values
}

/// Whether the values are in the order of the levels along every edge.
fn stay_apart(connectivity: &Connectivity, levels: &[f64], values: &[f64]) -> bool {
    let is_below = |a: u32, b: u32| {
        let (x, y) = (values[a as usize], values[b as usize]);
        x < y || (x == y && a < b)
    };
    connectivity.edges().iter().all(|&[a, b]| {
        let (x, y) = (levels[a as usize], levels[b as usize]);
        x == y || (x < y) == is_below(a, b)
    })
}

fn change(before: &[f64], after: &[f64]) -> f64 {
    before.iter().zip(after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How many doubles lie between `value` and the greatest one within the bound; none are counted below the level.
fn steps_above(value: f64, level: f64, original: f64, bound: f64) -> i64 {
    let (mut within, mut above) = (ordinal(level), ordinal(value));
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

fn climb(connectivity: &Connectivity, levels: &[f64], order: &[u32], bases: &[f64]) -> Vec<f64> {
    let mut values = levels.to_vec();
    let mut placed = vec![false; levels.len()];
    let mut highest = f64::NEG_INFINITY;
    for &v in order {
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
    values
}
