//! Lower and upper link of a vertex whose link may be any graph.

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
}

const NONE: u32 = u32::MAX;

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
