//! How vertices, edges and triangles meet, without positions.

use crate::error::{Cancelled, MeshError, OutOfMemory};
use crate::support::counting_sort::{offsets, rewind};
use crate::support::memory;
use crate::support::watch::Watch;

/// The work with a triangle when stars are gathered; with each triangle of a star when edges are made, and when links are told; with an
/// edge that is looked at.
const STAR: u64 = 40;
const HALF_EDGES: u64 = 30;
const FAN: u64 = 15;
const EDGE: u64 = 10;

/// What the triangles around a vertex look like: the shape of its link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkKind {
    /// In no triangle.
    Isolated,
    /// Interior vertex of a surface: the link is one cycle.
    Cycle,
    /// Boundary vertex of a surface: the link is one open path.
    Path,
    /// Not a surface here: the link is any other graph.
    NonManifold,
}

/// The incidences of a pure triangle complex in compressed rows. A half-edge `3t + c` is the side of triangle `t` from its
/// corner `c` to its corner `(c + 1) % 3`.
#[derive(Debug, Clone)]
pub struct Connectivity {
    triangles: Vec<[u32; 3]>,
    edges: Vec<[u32; 2]>,
    triangle_edges: Vec<[u32; 3]>,
    edge_offsets: Vec<u32>,
    edge_triangles: Vec<u32>,
    star_offsets: Vec<u32>,
    stars: Vec<u32>,
    link_kinds: Vec<LinkKind>,
    special: Vec<u32>,
}

impl Connectivity {
    /// `triangles` must hold ids below `n`, no id twice in one triangle, no triangle twice: see `validate`.
    pub(super) fn new(n: usize, triangles: Vec<[u32; 3]>, watch: &Watch<'_>) -> Result<Self, MeshError> {
        watch.tick(STAR * triangles.len() as u64)?;
        let (star_offsets, stars) = stars(n, &triangles);
        let sizes = || star_offsets.windows(2).map(|pair| (pair[1] - pair[0]) as usize);
        let referenced = sizes().filter(|&size| size > 0).count();
        let largest_star = sizes().max().unwrap_or(0);
        let (m, room) = (triangles.len(), edge_room(referenced, triangles.len()));
        memory::ensure(24 * m as u64 + 12 * room as u64 + 16 * largest_star as u64)?;
        let mut this = Self {
            edges: Vec::with_capacity(room),
            triangle_edges: vec![[0; 3]; m],
            edge_offsets: Vec::with_capacity(room + 1),
            edge_triangles: Vec::with_capacity(m * 3),
            triangles,
            star_offsets,
            stars,
            link_kinds: Vec::new(),
            special: Vec::new(),
        };
        this.build_edges(n, 2 * largest_star, watch)?;
        memory::ensure(10 * n as u64)?;
        this.link_kinds = this.classify_links(watch)?;
        let is_special = |&v: &u32| matches!(this.link_kinds[v as usize], LinkKind::Path | LinkKind::NonManifold);
        let mut special = Vec::with_capacity((0..n as u32).filter(is_special).count());
        special.extend((0..n as u32).filter(is_special));
        this.special = special;
        Ok(this)
    }

    /// An estimate of the bytes that [`Connectivity::new`] takes, besides the triangles.
    pub(super) fn bytes(n: usize, m: usize) -> u64 {
        // Edges of the triangles, their stars, the triangles of edges; edges and their offsets; offsets of stars, links, special
        // vertices, and two lists that only their classification needs.
        36 * m as u64 + 12 * edge_room(n, m) as u64 + 14 * n as u64
    }

    /// Collects the half-edges of every vertex that lead to a larger id, sorted by that id, so that edges come out in
    /// lexicographic order without a global sort.
    fn build_edges(&mut self, n: usize, most_at_a_vertex: usize, watch: &Watch<'_>) -> Result<(), MeshError> {
        // The id at the other end above, the half-edge below: one integer sorts faster than a pair.
        let mut half_edges: Vec<u64> = Vec::with_capacity(most_at_a_vertex);
        self.edge_offsets.push(0);
        let packed = |end: u32, half_edge: u32| u64::from(end) << 32 | u64::from(half_edge);
        for v in 0..n as u32 {
            half_edges.clear();
            let star = star_of(&self.star_offsets, &self.stars, v);
            watch.tick(HALF_EDGES * star.len() as u64)?;
            for &t in star {
                let corners = self.triangles[t as usize];
                let c = corner_of(corners, v);
                let (next, previous) = (corners[(c + 1) % 3], corners[(c + 2) % 3]);
                if next > v {
                    half_edges.push(packed(next, 3 * t + c as u32));
                }
                if previous > v {
                    half_edges.push(packed(previous, 3 * t + ((c + 2) % 3) as u32));
                }
            }
            half_edges.sort_unstable();
            for group in half_edges.chunk_by(|a, b| a >> 32 == b >> 32) {
                let edge = self.edges.len() as u32;
                if self.edges.len() == self.edges.capacity() {
                    self.make_room_for_edges()?;
                }
                self.edges.push([v, (group[0] >> 32) as u32]);
                for &packed in group {
                    let half_edge = packed as u32;
                    self.triangle_edges[(half_edge / 3) as usize][(half_edge % 3) as usize] = edge;
                    self.edge_triangles.push(half_edge / 3);
                }
                self.edge_offsets.push(self.edge_triangles.len() as u32);
            }
        }
        Ok(())
    }

    /// Room for more edges than were expected, in small steps: only surfaces with handles and holes come here, and few times.
    #[cold]
    fn make_room_for_edges(&mut self) -> Result<(), OutOfMemory> {
        let more = self.edges.len() / 16 + 64;
        memory::ensure(12 * (self.edges.len() + more) as u64)?;
        self.edges.reserve_exact(more);
        self.edge_offsets.reserve_exact(more);
        Ok(())
    }

    fn classify_links(&self, watch: &Watch<'_>) -> Result<Vec<LinkKind>, Cancelled> {
        let n = self.vertex_count();
        let mut neighbours = vec![0_u32; n];
        let mut branching = vec![false; n];
        watch.tick(EDGE * self.edges.len() as u64)?;
        for (edge, ends) in self.edges.iter().enumerate() {
            for &v in ends {
                neighbours[v as usize] += 1;
                branching[v as usize] |= self.triangles_of_edge(edge as u32).len() > 2;
            }
        }
        let mut kinds = Vec::with_capacity(n);
        for v in 0..n as u32 {
            let star = self.star(v).len() as u32;
            watch.tick(FAN * u64::from(star))?;
            let paths = neighbours[v as usize].wrapping_sub(star);
            kinds.push(if star == 0 {
                LinkKind::Isolated
            } else if branching[v as usize] || paths > 1 || self.fan_size(v) != star {
                LinkKind::NonManifold
            } else if paths == 0 {
                LinkKind::Cycle
            } else {
                LinkKind::Path
            });
        }
        Ok(kinds)
    }

    /// Number of triangles around `v` that are reached from its first one across edges with two triangles.
    fn fan_size(&self, v: u32) -> u32 {
        let first = self.star(v)[0];
        let corner = corner_of(self.triangles[first as usize], v);
        let sides = self.triangle_edges[first as usize];
        let mut size = 1;
        for start in [sides[corner], sides[(corner + 2) % 3]] {
            let (mut t, mut edge) = (first, start);
            while let Some(next) = self.across(t, edge) {
                if next == first {
                    return size;
                }
                size += 1;
                let c = corner_of(self.triangles[next as usize], v);
                let sides = self.triangle_edges[next as usize];
                edge = if sides[c] == edge { sides[(c + 2) % 3] } else { sides[c] };
                t = next;
            }
        }
        size
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.star_offsets.len() - 1
    }

    /// Vertex ids of every triangle, in the orientation of the input.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The two ends of every edge, smaller id first, in lexicographic order.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// For every triangle, the edge of each of its half-edges.
    #[must_use]
    pub fn triangle_edges(&self) -> &[[u32; 3]] {
        &self.triangle_edges
    }

    /// The triangles at an edge: one on the boundary, two inside a surface, more where it is not a manifold.
    ///
    /// # Panics
    /// Where `edge` does not exist.
    #[must_use]
    pub fn triangles_of_edge(&self, edge: u32) -> &[u32] {
        let edge = edge as usize;
        &self.edge_triangles[self.edge_offsets[edge] as usize..self.edge_offsets[edge + 1] as usize]
    }

    /// The triangle on the other side of an edge of `triangle`; none at the boundary and where more than two meet.
    ///
    /// # Panics
    /// Where `edge` does not exist.
    #[must_use]
    pub fn across(&self, triangle: u32, edge: u32) -> Option<u32> {
        match *self.triangles_of_edge(edge) {
            [a, b] => Some(if a == triangle { b } else { a }),
            _ => None,
        }
    }

    /// The triangles at a vertex, ascending.
    ///
    /// # Panics
    /// Where `vertex` does not exist.
    #[inline]
    #[must_use]
    pub fn star(&self, vertex: u32) -> &[u32] {
        star_of(&self.star_offsets, &self.stars, vertex)
    }

    /// The edges of the link of a vertex: the side opposite to it in each triangle of its star.
    pub fn link(&self, vertex: u32) -> impl Iterator<Item = [u32; 2]> {
        self.star(vertex).iter().map(move |&t| {
            let corners = self.triangles[t as usize];
            let c = corner_of(corners, vertex);
            [corners[(c + 1) % 3], corners[(c + 2) % 3]]
        })
    }

    /// The shape of every vertex's link.
    #[must_use]
    pub fn link_kinds(&self) -> &[LinkKind] {
        &self.link_kinds
    }

    /// Vertices whose link is not a cycle, isolated ones left out; ascending.
    #[must_use]
    pub fn special_vertices(&self) -> &[u32] {
        &self.special
    }

    /// Vertices of no triangle, ascending.
    #[must_use]
    pub fn isolated_vertices(&self) -> Vec<u32> {
        (0..self.vertex_count() as u32).filter(|&v| self.link_kinds[v as usize] == LinkKind::Isolated).collect()
    }

    /// Number of vertices that belong to a triangle.
    #[must_use]
    pub fn referenced_vertex_count(&self) -> usize {
        self.link_kinds.iter().filter(|&&kind| kind != LinkKind::Isolated).count()
    }
}

/// Which corner of a triangle a vertex is.
pub(super) fn corner_of(corners: [u32; 3], vertex: u32) -> usize {
    if corners[0] == vertex {
        0
    } else if corners[1] == vertex {
        1
    } else {
        2
    }
}

#[inline]
fn star_of<'a>(offsets: &[u32], stars: &'a [u32], vertex: u32) -> &'a [u32] {
    &stars[offsets[vertex as usize] as usize..offsets[vertex as usize + 1] as usize]
}

/// How many edges a mesh probably has. Euler's formula gives no less for surfaces with at most one handle, which may have
/// boundaries, and three half-edges to two edges for all that are closed; no mesh has more than half-edges.
fn edge_room(vertices: usize, triangles: usize) -> usize {
    let half_edges = 3 * triangles;
    half_edges.div_ceil(2).max(vertices + triangles).min(half_edges)
}

/// Triangles of every vertex by a counting sort.
fn stars(n: usize, triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<u32>) {
    let mut offsets = offsets(n, &mut triangles.as_flattened().iter().copied());
    let mut stars = vec![0_u32; triangles.len() * 3];
    for (t, corners) in triangles.iter().enumerate() {
        for &v in corners {
            let place = &mut offsets[v as usize];
            stars[*place as usize] = t as u32;
            *place += 1;
        }
    }
    rewind(&mut offsets);
    (offsets, stars)
}
