//! How many components the lower and the upper link have, and until which δ.

use super::graph::LinkGraph;
use crate::error::OutOfMemory;
use crate::field::sorting::sort;
use crate::mesh::Connectivity;

/// What the link of a vertex looks like once every link vertex has a sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::field) struct SignedLink {
    /// Components of the lower link, link vertices of sign 0 joining their neighbours.
    pub(in crate::field) lower_components: u32,
    /// Components of the upper link, link vertices of sign 0 joining their neighbours.
    pub(in crate::field) upper_components: u32,
    /// Euler characteristic of the lower link proper: its vertices less its edges.
    pub(in crate::field) lower_characteristic: i64,
    /// The vertex is the end of an edge with one triangle.
    pub(in crate::field) on_boundary: bool,
}

/// Room that is used again for every vertex.
#[derive(Debug)]
pub(in crate::field) struct LinkScratch {
    graph: LinkGraph,
    signs: Vec<i8>,
    counted: Vec<bool>,
    /// f_j − f_i of the link vertices, or f_i − f_j.
    differences: Vec<f64>,
    /// The edges by ascending height.
    order: Vec<u32>,
    heights: Vec<f64>,
}

/// So few numbers are sorted fastest by insertion.
pub(in crate::field) const FEW: usize = 32;

fn push_positive(ends: &mut Vec<u64>, end: f64) {
    if end > 0.0 {
        ends.push(end.to_bits());
    }
}

impl LinkScratch {
    pub(in crate::field) fn new(vertices: usize) -> Result<Self, OutOfMemory> {
        Ok(Self {
            graph: LinkGraph::new(vertices)?,
            signs: Vec::new(),
            counted: Vec::new(),
            differences: Vec::new(),
            order: Vec::new(),
            heights: Vec::new(),
        })
    }

    /// Looks at the link of `vertex` with the signs that `sign` gives to its vertices: −1 below, 0 within δ, 1 above.
    pub(in crate::field) fn inspect(
        &mut self,
        connectivity: &Connectivity,
        vertex: u32,
        sign: impl Fn(u32) -> i8,
    ) -> Result<SignedLink, OutOfMemory> {
        self.graph.gather(connectivity, vertex)?;
        self.signs.clear();
        self.signs.extend(self.graph.nodes.iter().map(|&v| sign(v)));
        let lower_vertices = self.signs.iter().filter(|&&s| s < 0).count() as i64;
        let lower_edges =
            self.graph.edges.iter().filter(|e| e.iter().all(|&v| self.signs[v as usize] < 0)).count() as i64;
        Ok(SignedLink {
            lower_components: self.components(-1),
            upper_components: self.components(1),
            lower_characteristic: lower_vertices - lower_edges,
            on_boundary: self.graph.degrees.contains(&1),
        })
    }

    /// Takes the link of `vertex` with the differences f_j − f_i: what [`LinkScratch::component_ends`] asks for.
    pub(in crate::field) fn measure(
        &mut self,
        connectivity: &Connectivity,
        vertex: u32,
        difference: impl Fn(u32) -> f64,
    ) -> Result<(), OutOfMemory> {
        self.graph.gather(connectivity, vertex)?;
        self.differences.clear();
        self.differences.extend(self.graph.nodes.iter().map(|&v| difference(v)));
        Ok(())
    }

    /// Exchanges below and above.
    pub(in crate::field) fn turn_over(&mut self) {
        for difference in &mut self.differences {
            *difference = -*difference;
        }
    }

    /// The δ at which the components of the lower link stop being counted, as the bits of positive numbers, descending: for
    /// every δ ≥ 0 as many of them are above δ as the lower link has components, link vertices within δ joining their
    /// neighbours.
    ///
    /// A component is a class of the link vertices with difference ≤ δ, and counts as long as its lowest vertex is below −δ.
    /// As δ grows, classes merge. The elder rule lets the one with the lower vertex live on; so every class has one δ at which it
    /// ends, by its depth or by a merger.
    pub(in crate::field) fn component_ends(&mut self, ends: &mut Vec<u64>) -> Result<(), OutOfMemory> {
        self.sort_edges()?;
        self.graph.sets.reset(self.graph.nodes.len());
        ends.clear();
        for i in 0..self.order.len() {
            let edge = self.order[i] as usize;
            let [a, b] = self.graph.edges[edge];
            let (a, b) = (self.graph.sets.find(a), self.graph.sets.find(b));
            if a == b {
                continue;
            }
            // Roots are the lowest vertices of their classes.
            let is_elder = self.differences[a as usize] <= self.differences[b as usize];
            let (elder, younger) = if is_elder { (a, b) } else { (b, a) };
            self.graph.sets.link(younger, elder);
            push_positive(ends, (-self.differences[younger as usize]).min(self.heights[edge]));
        }
        for v in 0..self.graph.nodes.len() {
            if self.graph.sets.is_name(v as u32) {
                push_positive(ends, -self.differences[v]);
            }
        }
        ends.sort_unstable();
        ends.reverse();
        Ok(())
    }

    /// Puts the edges in the order of their heights, the higher difference of their two ends.
    fn sort_edges(&mut self) -> Result<(), OutOfMemory> {
        self.heights.clear();
        for &[a, b] in &self.graph.edges {
            let (x, y) = (self.differences[a as usize], self.differences[b as usize]);
            self.heights.push(if x > y { x } else { y });
        }
        self.order.clear();
        if self.heights.len() > FEW {
            self.order.extend(sort(&self.heights)?.1.iter().map(|&edge| edge as u32));
            return Ok(());
        }
        for edge in 0..self.heights.len() {
            self.order.push(edge as u32);
            let mut place = edge;
            while place > 0 && self.heights[self.order[place - 1] as usize] > self.heights[edge] {
                self.order.swap(place - 1, place);
                place -= 1;
            }
        }
        Ok(())
    }

    /// Components of the link vertices of sign `side` and 0 that hold one of sign `side`.
    fn components(&mut self, side: i8) -> u32 {
        self.graph.sets.reset(self.graph.nodes.len());
        for i in 0..self.graph.edges.len() {
            let [a, b] = self.graph.edges[i];
            if self.signs[a as usize] != -side && self.signs[b as usize] != -side {
                self.graph.sets.unite(a, b);
            }
        }
        self.counted.clear();
        self.counted.resize(self.graph.nodes.len(), false);
        let mut count = 0;
        for v in 0..self.graph.nodes.len() as u32 {
            if self.signs[v as usize] == side {
                let root = self.graph.sets.find(v) as usize;
                count += u32::from(!core::mem::replace(&mut self.counted[root], true));
            }
        }
        count
    }
}
