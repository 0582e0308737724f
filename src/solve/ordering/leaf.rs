//! Minimum degree on bit sets, for small parts.

use super::graph::Graph;
use super::ids::{NONE, filled};

/// Orders the unknowns of small parts by exact minimum degree; unknowns around the part, eliminated later, count.
pub(super) struct LeafOrder {
    /// The bit of a vertex.
    bits: Vec<u32>,
    rows: Vec<u64>,
    scores: Vec<u32>,
    around: Vec<u32>,
}

impl LeafOrder {
    pub(super) fn new(n: usize) -> Self {
        Self { bits: filled(n), rows: Vec::new(), scores: Vec::new(), around: Vec::new() }
    }

    #[inline(never)]
    pub(super) fn order(&mut self, graph: &Graph, part: &mut [u32]) {
        let n = part.len();
        if n < 2 {
            return;
        }
        for (bit, &v) in part.iter().enumerate() {
            self.bits[v as usize] = bit as u32;
        }
        self.around.clear();
        for &v in &*part {
            for &u in graph.of(v) {
                if self.bits[u as usize] == NONE {
                    self.bits[u as usize] = (n + self.around.len()) as u32;
                    self.around.push(u);
                }
            }
        }
        let words = (n + self.around.len()).div_ceil(64);
        self.rows.clear();
        self.rows.resize(n * words, 0);
        self.scores.clear();
        for (i, &v) in part.iter().enumerate() {
            let row = &mut self.rows[i * words..(i + 1) * words];
            for &u in graph.of(v) {
                let bit = self.bits[u as usize];
                row[bit as usize / 64] |= 1 << (bit % 64);
            }
            self.scores.push(score(graph.of(v).len() as u32, 0));
        }
        for v in part.iter().chain(&self.around) {
            self.bits[*v as usize] = NONE;
        }
        let old = part.to_vec();
        for place in part.iter_mut() {
            let pivot = self.next();
            self.eliminate(pivot, n, words);
            *place = old[pivot];
        }
    }

    fn next(&self) -> usize {
        let (mut best, mut least) = (0, NONE);
        for (i, &degree) in self.scores.iter().enumerate() {
            if degree < least {
                (best, least) = (i, degree);
            }
        }
        best
    }

    fn eliminate(&mut self, pivot: usize, n: usize, words: usize) {
        self.scores[pivot] = NONE;
        let clique = self.rows[pivot * words..(pivot + 1) * words].to_vec();
        let size: u32 = clique.iter().map(|a| a.count_ones()).sum();
        for word in 0..n.div_ceil(64) {
            let mut left = clique[word];
            while left != 0 {
                let i = word * 64 + left.trailing_zeros() as usize;
                left &= left - 1;
                if i >= n {
                    break;
                }
                let row = &mut self.rows[i * words..(i + 1) * words];
                let mut degree = 0;
                for (a, b) in row.iter_mut().zip(&clique) {
                    *a |= b;
                    degree += a.count_ones();
                }
                // Neither the unknown itself nor the pivot.
                row[i / 64] &= !(1 << (i % 64));
                row[pivot / 64] &= !(1 << (pivot % 64));
                self.scores[i] = score(degree.saturating_sub(2), size.saturating_sub(1));
            }
        }
    }
}

/// Twice the pairs of neighbours less those that the last pivot has linked: near to the fill (\[Rothberg98\]), but with some
/// weight on the degree, which is better here than either.
fn score(degree: u32, linked: u32) -> u32 {
    (2 * degree * degree.saturating_sub(1)).saturating_sub(linked * linked.saturating_sub(1))
}
