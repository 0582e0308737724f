//! The means that Lloyd's iterations begin with: k-means++ on a line.

use super::line::Line;
use crate::error::{FieldError, OutOfMemory};
use crate::field::arrays::{filled, with_room};
use crate::support::random::Random;
use crate::support::watch::Watch;

/// No cluster on that side.
const NONE: u32 = u32::MAX;

/// The values that are nearest to one of the centres chosen so far: an interval.
struct Cluster {
    centre: u64,
    start: usize,
    end: usize,
    /// The clusters to the left and to the right.
    beside: [u32; 2],
}

/// Chooses values as centres, each with a probability that is proportional to its squared distance from the nearest one before
/// it \[Arthur07\], and cuts the line half-way between neighbours. There are fewer than `most` where no others have a distance.
///
/// A new centre takes values from the two clusters beside it alone, so that the sums of the others stay: O(log n) for each.
/// Sums are integers, hence the chosen value has a distance.
pub(super) fn seeded(
    line: &Line,
    most: usize,
    random: &mut Random,
    watch: &Watch<'_>,
) -> Result<Vec<usize>, FieldError> {
    let first = ((random.uniform() * line.len() as f64) as usize).min(line.len() - 1);
    let mut clusters = with_room(most)?;
    clusters.push(Cluster { centre: line.place(first), start: 0, end: line.len(), beside: [NONE; 2] });
    let mut spreads = SumTree::new(most)?;
    spreads.set(0, line.spread(0, line.len(), clusters[0].centre));
    while clusters.len() < most && spreads.total() > 0 {
        watch.tick(2000)?;
        let target = (random.uniform() * spreads.total() as f64) as u128;
        let (near, rest) = spreads.find(target.min(spreads.total() - 1));
        let centre = line.place(place_of(line, &clusters[near], rest));
        insert(line, &mut clusters, &mut spreads, near as u32, centre);
    }
    let mut starts = filled(false, line.len())?;
    clusters.iter().for_each(|cluster| starts[cluster.start] = true);
    let mut bounds = with_room(clusters.len() + 1)?;
    bounds.extend((0..line.len()).filter(|&i| starts[i]));
    bounds.push(line.len());
    Ok(bounds)
}

/// The first value of a cluster up to which the squared distances from its centre sum to more than `rest`.
fn place_of(line: &Line, cluster: &Cluster, rest: u128) -> usize {
    let (mut low, mut high) = (cluster.start, cluster.end - 1);
    while low < high {
        let middle = low + (high - low) / 2;
        if line.spread(cluster.start, middle + 1, cluster.centre) > rest {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

/// Adds a cluster around a value of the cluster `near` that is not its centre.
fn insert(line: &Line, clusters: &mut Vec<Cluster>, spreads: &mut SumTree, near: u32, centre: u64) {
    let (added, beside) = (clusters.len() as u32, clusters[near as usize].beside);
    let is_above = centre > clusters[near as usize].centre;
    let [left, right] = if is_above { [near, beside[1]] } else { [beside[0], near] };
    let from = if left == NONE { 0 } else { clusters[left as usize].start };
    let to = if right == NONE { line.len() } else { clusters[right as usize].end };
    // Places are below 2^63, so that two can be added.
    let [start, end] = [(left, from), (right, to)].map(|(other, outermost)| match other {
        NONE => outermost,
        _ => line.first_above(from, to, (clusters[other as usize].centre + centre) / 2),
    });
    clusters.push(Cluster { centre, start, end, beside: [left, right] });
    if left != NONE {
        clusters[left as usize].end = start;
        clusters[left as usize].beside[1] = added;
    }
    if right != NONE {
        clusters[right as usize].start = end;
        clusters[right as usize].beside[0] = added;
    }
    for changed in [left, added, right] {
        if changed != NONE {
            let cluster = &clusters[changed as usize];
            spreads.set(changed as usize, line.spread(cluster.start, cluster.end, cluster.centre));
        }
    }
}

/// Numbers in the leaves of a binary tree, in every other node the sum of the two below it.
struct SumTree {
    nodes: Vec<u128>,
}

impl SumTree {
    fn new(leaves: usize) -> Result<Self, OutOfMemory> {
        Ok(Self { nodes: filled(0, 2 * leaves.next_power_of_two())? })
    }

    fn total(&self) -> u128 {
        self.nodes[1]
    }

    fn set(&mut self, leaf: usize, number: u128) {
        let mut node = self.nodes.len() / 2 + leaf;
        self.nodes[node] = number;
        while node > 1 {
            node /= 2;
            self.nodes[node] = self.nodes[2 * node] + self.nodes[2 * node + 1];
        }
    }

    /// The leaf up to which the numbers sum to more than `rest`, and what of `rest` those before it leave. `rest` is below the
    /// total.
    fn find(&self, mut rest: u128) -> (usize, u128) {
        let mut node = 1;
        while node < self.nodes.len() / 2 {
            node *= 2;
            if rest >= self.nodes[node] {
                rest -= self.nodes[node];
                node += 1;
            }
        }
        (node - self.nodes.len() / 2, rest)
    }
}
