//! A vertex separator of a small graph, by levels.

use super::graph::Graph;
use super::refine::{Cut, LEFT, RIGHT, Refiner, SEPARATOR};

/// Graphs below this size are cut directly.
const COARSEST: usize = 80;
const TRIES: usize = 6;

/// Cuts a connected graph in two: the label of every vertex.
pub(super) fn bisect(graph: &Graph, refiner: &mut Refiner) -> Vec<u32> {
    let total: u32 = graph.weights.iter().sum();
    let most = (total / (COARSEST as u32 / 2)).max(2);
    let mut levels: Vec<(Graph, Vec<u32>)> = Vec::new();
    loop {
        let finest = levels.last().map_or(graph, |level| &level.0);
        if finest.len() <= COARSEST {
            break;
        }
        let (cluster_of, count) = finest.pairs(most);
        if count * 10 > finest.len() * 9 {
            break;
        }
        let coarser = finest.contract(&cluster_of, count);
        levels.push((coarser, cluster_of));
    }
    let coarsest = levels.last().map_or(graph, |level| &level.0);
    let (mut labels, mut cut) = first(coarsest, refiner);
    for i in (0..levels.len()).rev() {
        let finer = if i == 0 { graph } else { &levels[i - 1].0 };
        labels = levels[i].1.iter().map(|&cluster| labels[cluster as usize]).collect();
        cut.separator = (0..labels.len() as u32).filter(|&v| labels[v as usize] == SEPARATOR).collect();
        refiner.refine(finer, &mut labels, 0, &mut cut, 3, unit(finer));
    }
    labels
}

fn unit(graph: &Graph) -> i64 {
    let total: i64 = graph.weights.iter().map(|&weight| i64::from(weight)).sum();
    (total / (16 * graph.len() as i64)).max(1)
}

/// The best of several cuts that grow from different vertices.
fn first(graph: &Graph, refiner: &mut Refiner) -> (Vec<u32>, Cut) {
    let n = graph.len();
    let total: i64 = graph.weights.iter().map(|&weight| i64::from(weight)).sum();
    let mut best: Option<(Vec<u32>, Cut)> = None;
    for i in 0..TRIES {
        let seed = (i * n / TRIES) as u32;
        let mut labels = vec![RIGHT; n];
        let own = i64::from(graph.weights[seed as usize]);
        let mut cut = Cut { weights: [0, total - own, own], separator: vec![seed] };
        labels[seed as usize] = SEPARATOR;
        refiner.refine(graph, &mut labels, LEFT, &mut cut, 6, unit(graph));
        if best.as_ref().is_none_or(|(_, other)| cut.cost() < other.cost()) {
            best = Some((labels, cut));
        }
    }
    best.unwrap_or_default()
}
