//! An edge cut of a small graph, by levels.

use super::edge_cut::{EdgeCut, EdgeRefiner};
use super::graph::Graph;
use super::refine::{LEFT, RIGHT};

/// Graphs below this size are cut directly.
fn coarsest_size() -> usize {
    super::tune("COARSEST", 80.) as usize
}
fn tries() -> usize {
    super::tune("TRIES", 4.) as usize
}

/// Cuts a connected graph in two: the side of every vertex.
pub(super) fn bisect(graph: &Graph, refiner: &mut EdgeRefiner) -> Vec<u32> {
    let all: i64 = graph.edge_weights.iter().map(|&weight| i64::from(weight)).sum();
    let all = all as f64;
    let tries = if graph.len() as f64 > super::tune("VMIN", 0.) { super::tune("V", 1.) as usize } else { 1 };
    let s0 = super::tune("S0", 2.) as usize;
    let mut best = bisect_once(graph, refiner, [1, 7919, 104_729, 1_299_709, 15_485_863][s0 % 5], s0);
    for variant in 1..tries {
        let other = bisect_once(graph, refiner, [1, 7919, 104_729, 1_299_709, 15_485_863][(variant + s0) % 5], variant);
        if other.1.cost(all) < best.1.cost(all) {
            best = other;
        }
    }
    best.0
}
#[inline(never)]
fn bisect_once(graph: &Graph, refiner: &mut EdgeRefiner, stride: usize, variant: usize) -> (Vec<u32>, EdgeCut) {
    let total: u32 = graph.weights.iter().sum();
    let most = (total / (coarsest_size() as u32 / 2)).max(2);
    let mut levels: Vec<(Graph, Vec<u32>)> = Vec::new();
    loop {
        let finest = levels.last().map_or(graph, |level| &level.0);
        if finest.len() <= coarsest_size() {
            break;
        }
        let (cluster_of, count) = finest.pairs(most, stride);
        if count * 10 > finest.len() * 9 {
            break;
        }
        let coarser = finest.contract(&cluster_of, count);
        levels.push((coarser, cluster_of));
    }
    let coarsest = levels.last().map_or(graph, |level| &level.0);
    let (mut labels, mut cut) = first(coarsest, refiner, variant);
    for i in (0..levels.len()).rev() {
        let finer = if i == 0 { graph } else { &levels[i - 1].0 };
        labels = levels[i].1.iter().map(|&cluster| labels[cluster as usize]).collect();
        refiner.refine(finer, &mut labels, &mut cut, super::tune("CP", 3.) as usize);
    }
    (labels, cut)
}

/// The best of several cuts that grow from different vertices.
#[inline(never)]
fn first(graph: &Graph, refiner: &mut EdgeRefiner, variant: usize) -> (Vec<u32>, EdgeCut) {
    let n = graph.len();
    let total: i64 = graph.weights.iter().map(|&weight| i64::from(weight)).sum();
    let mut best: Option<(Vec<u32>, EdgeCut)> = None;
    let all: i64 = graph.edge_weights.iter().map(|&weight| i64::from(weight)).sum();
    for i in 0..tries() {
        let seed = (i * n / tries() + variant) % n;
        let mut labels = vec![RIGHT; n];
        let own = i64::from(graph.weights[seed]);
        let edges = graph.range(seed as u32).map(|edge| i64::from(graph.edge_weight(edge))).sum();
        let mut cut = EdgeCut { weights: [own, total - own], edges };
        labels[seed] = LEFT;
        refiner.refine(graph, &mut labels, &mut cut, 6);
        if best.as_ref().is_none_or(|(_, other)| cut.cost(all as f64) < other.cost(all as f64)) {
            best = Some((labels, cut));
        }
    }
    best.unwrap_or_default()
}
