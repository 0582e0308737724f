//! Loops that never bound on complexes whose sheets meet, where duality fails.

use core::mem;

use super::classes::{Classes, Sum};
use crate::error::{FieldError, OutOfMemory};
use crate::field::arrays::{filled, numbers};
use crate::field::order::VertexOrder;
use crate::field::sorting::sort_by_value;
use crate::mesh::Connectivity;
use crate::support::memory;
use crate::support::pieces::ranges;
use crate::support::union_find::UnionFind;
use crate::support::watch::Watch;

/// The work with one vertex, and with one triangle of its star.
pub(super) const VERTEX: u64 = 40;
pub(super) const TRIANGLE: u64 = 20;

/// So much work is told at a time.
const TOLD: u64 = 100_000;

/// The vertices of the essential classes of dimension one of the sublevel sets, by ascending (value, id).
pub(super) fn essential_saddles(
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    let mut vertices = numbers(connectivity.vertex_count())?;
    sort_by_value(&mut vertices, order.values(), watch)?;
    let mut sweep = Annotated::new(connectivity, &vertices)?;
    for range in ranges(vertices.len(), VERTEX, watch) {
        for rank in range? {
            sweep.add(vertices[rank])?;
            if sweep.classes.work >= TOLD {
                watch.tick(mem::take(&mut sweep.classes.work))?;
            }
        }
    }
    watch.tick(sweep.classes.work)?;
    Ok(sweep.classes.essential()?)
}

/// The sublevel set of the vertices added so far. Every edge is annotated \[Busaryev12\] with the classes of loops that pass it: the
/// annotations of the edges of a loop add up, modulo 2, to its homology class, and to nothing where it bounds.
///
/// A vertex comes with the cone over its lower link. The edges to one component of the link get annotations along a tree, such that
/// triangles add up to nothing; of the first edges to the components, one that joins nothing new closes a loop and begins a
/// class. Loops of the link that are not in the tree are filled by the cone: where they do not add up to nothing, the youngest of
/// their classes ends, and is from then on the sum of the others. Where links are connected, as in dense complexes, few classes are
/// there at a time, and hardly an edge has an annotation.
struct Annotated<'a> {
    connectivity: &'a Connectivity,
    ranks: Vec<u32>,
    components: UnionFind,
    /// By edge.
    annotations: Vec<Sum>,
    classes: Classes,
    link: LowerLink,
}

/// The lower link of one vertex; room that is used again.
struct LowerLink {
    /// For every vertex of the mesh its place among the nodes; `NONE` outside of the link.
    places: Vec<u32>,
    nodes: Vec<u32>,
    /// For every node the edge of the mesh that leads to it.
    spokes: Vec<u32>,
    /// Places of the ends and the edge of the mesh.
    edges: Vec<([u32; 2], u32)>,
    /// For every node its edges in compressed rows: place of the other end, number among the edges.
    starts: Vec<u32>,
    beside: Vec<[u32; 2]>,
    reached: Vec<bool>,
    in_tree: Vec<bool>,
    queue: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl<'a> Annotated<'a> {
    fn new(connectivity: &'a Connectivity, vertices: &[u32]) -> Result<Self, OutOfMemory> {
        let mut ranks = filled(0, vertices.len())?;
        for (rank, &v) in vertices.iter().enumerate() {
            ranks[v as usize] = rank as u32;
        }
        Ok(Self {
            connectivity,
            ranks,
            components: UnionFind::new(numbers(vertices.len())?),
            annotations: filled(Sum::Nothing, connectivity.edges().len())?,
            classes: Classes::default(),
            link: LowerLink {
                places: filled(NONE, vertices.len())?,
                nodes: Vec::new(),
                spokes: Vec::new(),
                edges: Vec::new(),
                starts: Vec::new(),
                beside: Vec::new(),
                reached: Vec::new(),
                in_tree: Vec::new(),
                queue: Vec::new(),
            },
        })
    }

    fn add(&mut self, vertex: u32) -> Result<(), OutOfMemory> {
        self.classes.work += TRIANGLE * self.connectivity.star(vertex).len() as u64;
        self.link.gather(self.connectivity, &self.ranks, vertex)?;
        self.link.index_edges();
        for root in 0..self.link.nodes.len() as u32 {
            if !self.link.reached[root as usize] {
                let joins = self.components.unite(vertex, self.link.nodes[root as usize]);
                let first = if joins { Sum::Nothing } else { self.classes.begin(vertex)? };
                self.annotate(root, first)?;
            }
        }
        // The cone fills what the trees leave out.
        for i in 0..self.link.edges.len() {
            if self.link.in_tree[i] {
                continue;
            }
            let ([a, b], edge) = self.link.edges[i];
            let [a, b] = [a, b].map(|place| self.annotations[self.link.spokes[place as usize] as usize]);
            let sides = self.classes.add(a, b)?;
            let around = self.classes.add(sides, self.annotations[edge as usize])?;
            self.classes.fill(around)?;
        }
        Ok(())
    }

    /// Annotates the edges to a component of the link, from that to `root` on.
    fn annotate(&mut self, root: u32, first: Sum) -> Result<(), OutOfMemory> {
        let link = &mut self.link;
        link.queue.clear();
        link.queue.push(root);
        link.reached[root as usize] = true;
        self.annotations[link.spokes[root as usize] as usize] = first;
        let mut next = 0;
        while next < link.queue.len() {
            let at = link.queue[next] as usize;
            next += 1;
            let here = self.annotations[link.spokes[at] as usize];
            for &[other, i] in &link.beside[link.starts[at] as usize..link.starts[at + 1] as usize] {
                if mem::replace(&mut link.reached[other as usize], true) {
                    continue;
                }
                link.in_tree[i as usize] = true;
                link.queue.push(other);
                let along = self.annotations[link.edges[i as usize].1 as usize];
                let there = self.classes.add(here, along)?;
                self.annotations[link.spokes[other as usize] as usize] = there;
            }
        }
        Ok(())
    }
}

/// Stars with more triangles take memory worth speaking of, so much for each triangle.
const LARGE: usize = 256;
const BYTES_EACH: u64 = 160;

impl LowerLink {
    fn gather(&mut self, connectivity: &Connectivity, ranks: &[u32], vertex: u32) -> Result<(), OutOfMemory> {
        for &node in &self.nodes {
            self.places[node as usize] = NONE;
        }
        self.nodes.clear();
        self.spokes.clear();
        self.edges.clear();
        let star = connectivity.star(vertex);
        if star.len() > LARGE {
            memory::ensure(BYTES_EACH * star.len() as u64)?;
        }
        let rank = ranks[vertex as usize];
        for &t in star {
            let corners = connectivity.triangles()[t as usize];
            let [first, second, third] = connectivity.triangle_edges()[t as usize];
            let (j, k, to_j, across, to_k) = if corners[0] == vertex {
                (corners[1], corners[2], first, second, third)
            } else if corners[1] == vertex {
                (corners[2], corners[0], second, third, first)
            } else {
                (corners[0], corners[1], third, first, second)
            };
            let (j_is_lower, k_is_lower) = (ranks[j as usize] < rank, ranks[k as usize] < rank);
            let j = if j_is_lower { self.place(j, to_j) } else { NONE };
            let k = if k_is_lower { self.place(k, to_k) } else { NONE };
            if j_is_lower && k_is_lower {
                self.edges.push(([j, k], across));
            }
        }
        Ok(())
    }

    fn place(&mut self, v: u32, spoke: u32) -> u32 {
        let place = &mut self.places[v as usize];
        if *place == NONE {
            *place = self.nodes.len() as u32;
            self.nodes.push(v);
            self.spokes.push(spoke);
        }
        *place
    }

    fn index_edges(&mut self) {
        let (nodes, edges) = (self.nodes.len(), self.edges.len());
        self.starts.clear();
        self.starts.resize(nodes + 1, 0);
        for ([a, b], _) in &self.edges {
            self.starts[*a as usize] += 1;
            self.starts[*b as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.beside.clear();
        self.beside.resize(2 * edges, [0; 2]);
        for (i, &([a, b], _)) in self.edges.iter().enumerate() {
            for [from, to] in [[a, b], [b, a]] {
                let start = &mut self.starts[from as usize];
                *start -= 1;
                self.beside[*start as usize] = [to, i as u32];
            }
        }
        self.reached.clear();
        self.reached.resize(nodes, false);
        self.in_tree.clear();
        self.in_tree.resize(edges, false);
    }
}
