//! Doubles for vertices that are in order but have equal levels: the smallest steps that tell neighbours apart.

use crate::mesh::Connectivity;

/// Values near `levels` that ascend along every edge from the vertex that comes first in `order` to the other one, equal
/// values counting as ascending where ids do. `order` must not contradict the levels.
///
/// A value is its level, or the least double above its neighbours before it; where that would be more than `bound` above
/// the original value, the whole level starts so many steps lower, if that helps.
pub(super) fn tilted(
    connectivity: &Connectivity,
    levels: &[f64],
    order: &[u32],
    original: &[f64],
    bound: f64,
) -> Vec<f64> {
    let plain = climb(connectivity, levels, order, levels);
    let mut bases = levels.to_vec();
    let mut lowered = false;
    for run in order.chunk_by(|&a, &b| levels[a as usize] == levels[b as usize]) {
        let excess =
            run.iter().map(|&v| steps_above(plain[v as usize], levels[v as usize], original[v as usize], bound));
        let excess = excess.max().unwrap_or(0);
        if excess > 0 {
            lowered = true;
            for &v in run {
                bases[v as usize] = (0..excess).fold(levels[v as usize], |base, _| base.next_down());
            }
        }
    }
    if !lowered {
        return plain;
    }
    let other = climb(connectivity, levels, order, &bases);
    if change(original, &other) < change(original, &plain) { other } else { plain }
}

fn change(before: &[f64], after: &[f64]) -> f64 {
    before.iter().zip(after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How many doubles lie between `value` and the greatest one within the bound; none are counted below the level.
fn steps_above(mut value: f64, level: f64, original: f64, bound: f64) -> u32 {
    let mut steps = 0;
    while value > level && value - original > bound {
        value = value.next_down();
        steps += 1;
    }
    steps
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
