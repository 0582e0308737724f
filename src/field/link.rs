//! Lower and upper link of a vertex whose link may be any graph.

use super::sorting::sort;
use crate::mesh::Connectivity;

/// What the link of a vertex looks like once every link vertex has a sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct SignedLink {
    /// Components of the lower link, link vertices of sign 0 joining their neighbours.
    pub(super) lower_components: u32,
    /// Components of the upper link, link vertices of sign 0 joining their neighbours.
    pub(super) upper_components: u32,
    /// Euler characteristic of the lower link proper: its vertices less its edges.
    pub(super) lower_characteristic: i64,
    /// The vertex is the end of an edge with one triangle.
    pub(super) on_boundary: bool,
}

/// Room that is used again for every vertex.
#[derive(Debug)]
pub(super) struct LinkScratch {
    /// The vertices of the link.
    nodes: Vec<u32>,
    /// For every vertex of the mesh its place among the nodes; `NONE` outside of the link.
    places: Vec<u32>,

    edges: Vec<[u32; 2]>,
    signs: Vec<i8>,
    degrees: Vec<u32>,
    parents: Vec<u32>,
    counted: Vec<bool>,
    /// f_j − f_i of the link vertices, or f_i − f_j.
    differences: Vec<f64>,
    /// The edges by ascending level.
    order: Vec<u32>,
    levels: Vec<f64>,
}

const NONE: u32 = u32::MAX;
/// So few numbers are sorted fastest by insertion.
pub(super) const FEW: usize = 32;

fn push_positive(ends: &mut Vec<u64>, end: f64) {
    if end > 0.0 {
        ends.push(end.to_bits());
    }
}

impl LinkScratch {
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            nodes: Vec::new(),
            places: vec![NONE; vertices],
            edges: Vec::new(),
            signs: Vec::new(),
            degrees: Vec::new(),
            parents: Vec::new(),
            counted: Vec::new(),
            differences: Vec::new(),
            order: Vec::new(),
            levels: Vec::new(),
        }
    }

    /// Looks at the link of `vertex` with the signs that `sign` gives to its vertices: −1 below, 0 within δ, 1 above.
    pub(super) fn inspect(&mut self, connectivity: &Connectivity, vertex: u32, sign: impl Fn(u32) -> i8) -> SignedLink {
        self.gather(connectivity, vertex);
        self.signs.clear();
        self.signs.extend(self.nodes.iter().map(|&v| sign(v)));
        let lower_vertices = self.signs.iter().filter(|&&s| s < 0).count() as i64;
        let lower_edges = self.edges.iter().filter(|e| e.iter().all(|&v| self.signs[v as usize] < 0)).count() as i64;
        SignedLink {
            lower_components: self.components(-1),
            upper_components: self.components(1),
            lower_characteristic: lower_vertices - lower_edges,
            on_boundary: self.degrees.contains(&1),
        }
    }

    /// Takes the link of `vertex` with the differences f_j − f_i: what [`LinkScratch::component_ends`] asks for.
    pub(super) fn measure(&mut self, connectivity: &Connectivity, vertex: u32, difference: impl Fn(u32) -> f64) {
        self.gather(connectivity, vertex);
        self.differences.clear();
        self.differences.extend(self.nodes.iter().map(|&v| difference(v)));
    }

    /// Exchanges below and above.
    pub(super) fn turn_over(&mut self) {
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
    pub(super) fn component_ends(&mut self, ends: &mut Vec<u64>) {
        self.sort_edges();
        self.parents.clear();
        self.parents.extend(0..self.nodes.len() as u32);
        ends.clear();
        for i in 0..self.order.len() {
            let edge = self.order[i] as usize;
            let [a, b] = self.edges[edge];
            let (a, b) = (self.root(a), self.root(b));
            if a == b {
                continue;
            }
            // Roots are the lowest vertices of their classes.
            let is_elder = self.differences[a as usize] <= self.differences[b as usize];
            let (elder, younger) = if is_elder { (a, b) } else { (b, a) };
            self.parents[younger as usize] = elder;
            push_positive(ends, (-self.differences[younger as usize]).min(self.levels[edge]));
        }
        for v in 0..self.nodes.len() {
            if self.parents[v] == v as u32 {
                push_positive(ends, -self.differences[v]);
            }
        }
        ends.sort_unstable();
        ends.reverse();
    }

    /// Puts the edges in the order of their levels, the higher difference of their two ends.
    fn sort_edges(&mut self) {
        self.levels.clear();
        for &[a, b] in &self.edges {
            let (x, y) = (self.differences[a as usize], self.differences[b as usize]);
            self.levels.push(if x > y { x } else { y });
        }
        self.order.clear();
        if self.levels.len() > FEW {
            self.order.extend(sort(&self.levels).1.iter().map(|&edge| edge as u32));
            return;
        }
        for edge in 0..self.levels.len() {
            self.order.push(edge as u32);
            let mut place = edge;
            while place > 0 && self.levels[self.order[place - 1] as usize] > self.levels[edge] {
                self.order.swap(place - 1, place);
                place -= 1;
            }
        }
    }

    /// Fills nodes, edges (places among the nodes) and degrees.
    fn gather(&mut self, connectivity: &Connectivity, vertex: u32) {
        for &node in &self.nodes {
            self.places[node as usize] = NONE;
        }
        self.nodes.clear();
        self.degrees.clear();
        self.edges.clear();
        for ends in connectivity.link(vertex) {
            let places = ends.map(|v| {
                if self.places[v as usize] == NONE {
                    self.places[v as usize] = self.nodes.len() as u32;
                    self.nodes.push(v);
                    self.degrees.push(0);
                }
                let place = self.places[v as usize];
                self.degrees[place as usize] += 1;
                place
            });
            self.edges.push(places);
        }
    }

    /// Components of the link vertices of sign `side` and 0 that hold one of sign `side`.
    fn components(&mut self, side: i8) -> u32 {
        self.parents.clear();
        self.parents.extend(0..self.nodes.len() as u32);
        for i in 0..self.edges.len() {
            let [a, b] = self.edges[i];
            if self.signs[a as usize] != -side && self.signs[b as usize] != -side {
                let (a, b) = (self.root(a), self.root(b));
                self.parents[a.max(b) as usize] = a.min(b);
            }
        }
        self.counted.clear();
        self.counted.resize(self.nodes.len(), false);
        let mut count = 0;
        for v in 0..self.nodes.len() as u32 {
            if self.signs[v as usize] == side {
                let root = self.root(v) as usize;
                count += u32::from(!core::mem::replace(&mut self.counted[root], true));
            }
        }
        count
    }

    fn root(&mut self, mut v: u32) -> u32 {
        while self.parents[v as usize] != v {
            let above = self.parents[self.parents[v as usize] as usize];
            self.parents[v as usize] = above;
            v = above;
        }
        v
    }
}
