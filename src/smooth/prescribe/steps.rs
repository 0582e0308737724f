//! The steps that a field with the chosen extrema has: from one vertex up to a neighbour.
//!
//! Every vertex but the chosen minima has a step from its lowest neighbour, every one but the chosen maxima a step to its highest, and
//! chosen extrema have steps to or from all their neighbours. Whatever field takes all these steps has no other extrema than the chosen
//! ones; and as they all go up in the order of one field, there is such a field.

use super::extrema::Chosen;
use super::ranking::around;
use crate::error::{Result, SmoothError};
use crate::field::{VertexOrder, sort_by_value};
use crate::mesh::{Connectivity, LinkKind};
use crate::support::memory;
use crate::support::watch::Watch;

/// The work with a vertex whose steps are found, and with a step that is checked.
const FOUND: u64 = 120;
const CHECKED: u64 = 150;

/// No vertex: the value 0.
pub(super) const GROUND: u32 = u32::MAX;

/// The value at `to` less that at `from` is at least `least`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) least: f64,
}

/// The neighbour that comes first and the one that comes last in the order, for every vertex; itself where it has none.
struct Ends {
    lowest: Vec<u32>,
    highest: Vec<u32>,
}

impl Ends {
    fn new(connectivity: &Connectivity, order: VertexOrder<'_>) -> Self {
        let all: Vec<u32> = (0..connectivity.vertex_count() as u32).collect();
        let mut ends = Self { lowest: all.clone(), highest: all };
        for &[a, b] in connectivity.edges() {
            let (low, high) = if order.is_below(a, b) { (a, b) } else { (b, a) };
            let (lowest, highest) = (&mut ends.lowest[high as usize], &mut ends.highest[low as usize]);
            if order.is_below(low, *lowest) {
                *lowest = low;
            }
            if order.is_below(*highest, high) {
                *highest = high;
            }
        }
        ends
    }
}

/// The steps, sorted, each pair of vertices once.
pub(super) fn steps(
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    extrema: &Chosen,
    margin: f64,
    watch: &Watch<'_>,
) -> Result<Vec<Step>> {
    let n = connectivity.vertex_count();
    let Chosen { minima, maxima } = extrema;
    let rings: usize = minima.iter().chain(maxima).map(|&v| 2 * connectivity.star(v).len()).sum();
    memory::ensure((8 * n + size_of::<Step>() * (2 * n + rings)) as u64)?;
    watch.tick(FOUND * n as u64)?;
    let ends = Ends::new(connectivity, order);
    let mut steps = Vec::with_capacity(2 * n + rings);
    let mut push = |from: u32, to: u32| steps.push(Step { from, to, least: margin });
    let [mut next_minimum, mut next_maximum] = [minima, maxima].map(|list| list.iter().peekable());
    for v in 0..n as u32 {
        if connectivity.link_kinds()[v as usize] == LinkKind::Isolated {
            continue;
        }
        if next_minimum.next_if_eq(&&v).is_some() {
            around(connectivity, v).for_each(|w| push(v, w));
        } else {
            push(ends.lowest[v as usize], v);
        }
        if next_maximum.next_if_eq(&&v).is_some() {
            around(connectivity, v).for_each(|w| push(w, v));
        } else {
            push(v, ends.highest[v as usize]);
        }
    }
    steps.sort_unstable_by_key(|step| (step.from, step.to));
    steps.dedup_by_key(|step| (step.from, step.to));
    Ok(steps)
}

/// Checks that values can be found though some vertices have theirs already and others have bounds: goes up through all steps.
///
/// # Errors
/// `Infeasible` with a vertex from which steps lead up to another one whose value is not so much higher.
pub(super) fn check(
    steps: &[Step],
    order: VertexOrder<'_>,
    fixed: &dyn Fn(u32) -> Option<f64>,
    watch: &Watch<'_>,
) -> Result<()> {
    let n = order.values().len();
    memory::ensure((28 * n + 8 * steps.len()) as u64)?;
    watch.tick(CHECKED * steps.len() as u64)?;
    let mut ascending: Vec<u32> = (0..n as u32).collect();
    sort_by_value(&mut ascending, order.values(), watch)?;
    let mut rank = vec![0_u32; n];
    for (place, &v) in (0..).zip(&ascending) {
        rank[v as usize] = place;
    }
    // From the ground come first, to the ground last.
    let key = |step: &Step| if step.from == GROUND { 0 } else { rank[step.from as usize] + 1 };
    let mut up: Vec<u32> = (0..steps.len() as u32).collect();
    up.sort_unstable_by_key(|&k| key(&steps[k as usize]));
    let mut least = vec![f64::NEG_INFINITY; n];
    let mut origin = vec![GROUND; n];
    let mut next = 0;
    let mut ceilings = Vec::new();
    for place in 0..=n {
        let vertex = place.checked_sub(1).and_then(|place| ascending.get(place).copied());
        if let Some((v, value)) = vertex.and_then(|v| Some((v, fixed(v)?))) {
            if value < least[v as usize] {
                return Err(SmoothError::Infeasible { from: origin[v as usize], to: v }.into());
            }
            (least[v as usize], origin[v as usize]) = (value, v);
        }
        while let Some(step) = up.get(next).map(|&k| &steps[k as usize]).filter(|step| key(step) as usize == place) {
            next += 1;
            if step.to == GROUND {
                ceilings.push(*step);
                continue;
            }
            let (base, from) = match step.from {
                GROUND => (0.0, step.to),
                from => (least[from as usize], origin[from as usize]),
            };
            if base + step.least > least[step.to as usize] {
                least[step.to as usize] = base + step.least;
                origin[step.to as usize] = from;
            }
        }
    }
    for step in ceilings {
        let v = step.from as usize;
        if -least[v] < step.least {
            return Err(SmoothError::Infeasible { from: origin[v], to: step.from }.into());
        }
    }
    Ok(())
}
