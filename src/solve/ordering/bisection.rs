//! A small edge cut of a weighted graph, by levels (\[Hendrickson95\]): the graph is contracted until few vertices are left,
//! those are cut, and the cut is refined while the graph grows again.

use super::edge_cut::{EdgeCut, EdgeRefiner};
use super::graph::Graph;
use super::refine::{LEFT, RIGHT};
use crate::Watch;
use crate::error::{Cancelled, SolveError};

/// Graphs up to this size are cut directly: larger ones give no better cuts, but take longer.
const COARSEST: usize = 40;
/// Cuts of the coarsest graph to choose from. Below four the cuts get worse, above they hardly get better.
const TRIES: usize = 4;
/// Passes over a graph at most. Further ones hardly change anything.
const PASSES: usize = 3;
/// Vertices are visited in steps of this prime: neighbours one after the other would grow chains of pairs.
const STRIDE: usize = 104_729;

/// Cuts a connected graph in two: the side of every vertex.
#[inline(never)]
pub(super) fn bisect(graph: &Graph, refiner: &mut EdgeRefiner, watch: &Watch<'_>) -> Result<Vec<u32>, SolveError> {
    let total: u32 = graph.weights.iter().sum();
    // Heavier vertices could not be balanced.
    let most = (total / (COARSEST as u32 / 2)).max(2);
    let mut levels: Vec<(Graph, Vec<u32>)> = Vec::new();
    loop {
        let finest = levels.last().map_or(graph, |level| &level.0);
        if finest.len() <= COARSEST {
            break;
        }
        let (cluster_of, count) = finest.pairs(most, STRIDE, watch)?;
        // Stars do not shrink.
        if count * 10 > finest.len() * 9 {
            break;
        }
        let coarser = finest.contract(&cluster_of, count, watch)?;
        levels.push((coarser, cluster_of));
    }
    let (mut sides, mut cut) = grow(levels.last().map_or(graph, |level| &level.0), refiner, watch)?;
    for i in (0..levels.len()).rev() {
        let finer = if i == 0 { graph } else { &levels[i - 1].0 };
        sides = levels[i].1.iter().map(|&cluster| sides[cluster as usize]).collect();
        refiner.refine(finer, &mut sides, &mut cut, PASSES, watch)?;
    }
    Ok(sides)
}

/// The best of several cuts that grow from different vertices.
fn grow(graph: &Graph, refiner: &mut EdgeRefiner, watch: &Watch<'_>) -> Result<(Vec<u32>, EdgeCut), Cancelled> {
    let n = graph.len();
    let mut best: (Vec<u32>, EdgeCut) = Default::default();
    for i in 0..TRIES {
        let mut sides = vec![RIGHT; n];
        sides[i * n / TRIES] = LEFT;
        let mut cut = EdgeCut::of(graph, &sides);
        refiner.refine(graph, &mut sides, &mut cut, 1, watch)?;
        if i == 0 || cut.cost() < best.1.cost() {
            best = (sides, cut);
        }
    }
    refiner.refine(graph, &mut best.0, &mut best.1, PASSES, watch)?;
    Ok(best)
}
