//! The vertices and edges of one link.

use crate::error::OutOfMemory;
use crate::field::arrays::filled;
use crate::mesh::Connectivity;
use crate::support::memory;
use crate::support::union_find::UnionFind;

/// Where there is nothing to name.
pub(super) const NONE: u32 = u32::MAX;

/// Stars with more triangles take memory worth speaking of, so much for each triangle: for all that is known of a link, and for
/// vectors that grow.
const LARGE: usize = 256;
const BYTES_EACH: u64 = 160;

/// The link of a vertex as a graph; room that is used again for every vertex.
#[derive(Debug)]
pub(super) struct LinkGraph {
    /// For every vertex of the mesh its place among the nodes; `NONE` outside of the link.
    places: Vec<u32>,
    /// The vertices of the link as they are met.
    pub(super) nodes: Vec<u32>,
    /// Places of both ends.
    pub(super) edges: Vec<[u32; 2]>,
    pub(super) degrees: Vec<u32>,
    /// The places next to each one, where the link is a cycle or a path.
    pub(super) beside: Vec<[u32; 2]>,
    /// Sets of places, for who needs components.
    pub(super) sets: UnionFind,
}

impl LinkGraph {
    pub(super) fn new(vertices: usize) -> Result<Self, OutOfMemory> {
        Ok(Self {
            places: filled(NONE, vertices)?,
            nodes: Vec::new(),
            edges: Vec::new(),
            degrees: Vec::new(),
            beside: Vec::new(),
            sets: UnionFind::default(),
        })
    }

    /// Takes up the link of `vertex`.
    #[inline(never)]
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub(super) fn gather(&mut self, connectivity: &Connectivity, vertex: u32) -> Result<(), OutOfMemory> {
        for &node in &self.nodes {
            self.places[node as usize] = NONE;
        }
        self.nodes.clear();
        self.degrees.clear();
        self.edges.clear();
        self.beside.clear();
        let star = connectivity.star(vertex);
        if star.len() > LARGE {
            memory::ensure(BYTES_EACH * star.len() as u64)?;
        }
        for &t in star {
            let [j, k] = opposite(connectivity.triangles()[t as usize], vertex);
            let (j, k) = (self.place(j), self.place(k));
            self.edges.push([j, k]);
            self.put_beside(j, k);
            self.put_beside(k, j);
        }
        Ok(())
    }

    fn place(&mut self, v: u32) -> u32 {
        let place = &mut self.places[v as usize];
        if *place == NONE {
            *place = self.nodes.len() as u32;
            self.nodes.push(v);
            self.degrees.push(0);
            self.beside.push([NONE; 2]);
        }
        *place
    }

    fn put_beside(&mut self, this: u32, that: u32) {
        let degree = &mut self.degrees[this as usize];
        if *degree < 2 {
            self.beside[this as usize][*degree as usize] = that;
        }
        *degree += 1;
    }
}

/// The other two corners of a triangle, in its orientation.
#[inline]
pub(in crate::field) fn opposite([a, b, c]: [u32; 3], vertex: u32) -> [u32; 2] {
    if a == vertex {
        [b, c]
    } else if b == vertex {
        [c, a]
    } else {
        [a, b]
    }
}
