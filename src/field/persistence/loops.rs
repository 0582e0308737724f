//! Saddles at which a loop begins that never bounds.

use std::collections::BinaryHeap;

use core::cmp::Reverse;

use crate::field::order::VertexOrder;
use crate::field::saddles::Saddles;
use crate::field::sorting::{sort_by_key, sort_by_value};
use crate::mesh::{Connectivity, LinkKind, TriMesh};
use crate::support::union_find::UnionFind;

/// The vertices of the essential classes of dimension one of the sublevel sets, by ascending (value, id). `mergers` has for
/// every saddle how many components merge there in the sweeps up and down, and `steepest_up` the highest neighbours.
pub(super) fn essential_saddles(
    mesh: &TriMesh,
    order: VertexOrder<'_>,
    saddles: &Saddles,
    ascending: &[u32],
    mergers: &[[u32; 2]],
    steepest_up: &[u32],
) -> Vec<u32> {
    let connectivity = mesh.connectivity();
    if connectivity.link_kinds().contains(&LinkKind::NonManifold) {
        return Coboundaries::new(connectivity, order).essential_saddles();
    }
    // On a surface, l components of the lower link are l − 1 handles: each joins components of the sublevel set, or begins a
    // loop. By duality a loop comes to bound where components of the superlevel set join.
    let mut loops: Vec<u32> = (0..saddles.len() as u32)
        .map(|i| saddles.get(i).lower_components.saturating_sub(1) - mergers[i as usize][0])
        .collect();
    if connectivity.special_vertices().is_empty() {
        for (loops, mergers) in loops.iter_mut().zip(mergers) {
            *loops -= mergers[1].min(*loops);
        }
    } else {
        bound_from_beyond(connectivity, saddles, ascending, steepest_up, &mut loops);
    }
    let repeated = |&i: &u32| (0..loops[i as usize]).map(move |_| saddles.get(i).vertex);
    ascending.iter().flat_map(repeated).collect()
}

/// Takes away the loops that come to bound on a surface with boundary, where a vertex above everything, next to the whole
/// boundary, takes the place of what lies beyond it.
fn bound_from_beyond(
    connectivity: &Connectivity,
    saddles: &Saddles,
    ascending: &[u32],
    steepest_up: &[u32],
    loops: &mut [u32],
) {
    let beyond = connectivity.vertex_count() as u32;
    let mut up = steepest_up.to_vec();
    up.push(beyond);
    for &v in connectivity.special_vertices() {
        up[v as usize] = beyond;
    }
    let mut above = UnionFind::new(up);
    for &i in ascending.iter().rev() {
        let saddle = saddles.get(i);
        let on_boundary = connectivity.link_kinds()[saddle.vertex as usize] == LinkKind::Path;
        let hub = if on_boundary { beyond } else { saddle.upper[0] };
        for &first in saddle.upper {
            if above.unite(hub, first) {
                loops[i as usize] = loops[i as usize].saturating_sub(1);
            }
        }
    }
}

/// Where sheets meet, duality fails, and the loops that come to bound are found from the coboundaries of the edges
/// \[DeSilva11\]: from the last edge to the first, the sum of the triangles at an edge is reduced by those of later edges,
/// until it is nothing or has a first triangle of its own, which then is the one that closes the loop. Nearly all edges have
/// two triangles, so that reducing is mostly union and find.
struct Coboundaries<'a> {
    connectivity: &'a Connectivity,
    /// The vertices in order, and the place of each.
    vertices: Vec<u32>,
    ranks: Vec<u32>,
    /// The place of every triangle in the filtration, by its vertices from the highest to the lowest.
    places: Vec<u32>,
    /// For a triangle (by its place) that is the first of a reduced coboundary: the others of that coboundary.
    others: Vec<Others>,
    /// Long ones of these.
    lists: Vec<Vec<u32>>,
}

#[derive(Clone, Copy)]
enum Others {
    /// No reduced coboundary begins with this triangle.
    Free,
    Nothing,
    One(u32),
    /// A list, by its place among them.
    Many(u32),
}

impl<'a> Coboundaries<'a> {
    fn new(connectivity: &'a Connectivity, order: VertexOrder<'_>) -> Self {
        let mut vertices: Vec<u32> = (0..connectivity.vertex_count() as u32).collect();
        sort_by_value(&mut vertices, order.values());
        let mut ranks = vec![0; vertices.len()];
        for (rank, &v) in vertices.iter().enumerate() {
            ranks[v as usize] = rank as u32;
        }
        let triangles = connectivity.triangles().len();
        let mut this = Self {
            connectivity,
            vertices,
            ranks,
            places: vec![0; triangles],
            others: vec![Others::Free; triangles],
            lists: Vec::new(),
        };
        this.place_triangles();
        this
    }

    fn place_triangles(&mut self) {
        let mut place = 0;
        let mut highest_here: Vec<(u64, u32)> = Vec::new();
        for (rank, &v) in self.vertices.iter().enumerate() {
            highest_here.clear();
            for &t in self.connectivity.star(v) {
                let mut corners = self.connectivity.triangles()[t as usize].map(|v| self.ranks[v as usize]);
                corners.sort_unstable();
                if corners[2] as usize == rank {
                    highest_here.push((u64::from(corners[1]) << 32 | u64::from(corners[0]), t));
                }
            }
            highest_here.sort_unstable();
            for &(_, t) in &highest_here {
                self.places[t as usize] = place;
                place += 1;
            }
        }
    }

    fn essential_saddles(mut self) -> Vec<u32> {
        let edges = self.edges();
        let mut joining = vec![false; edges.len()];
        let mut components = UnionFind::singletons(self.vertices.len());
        for (place, &edge) in edges.iter().enumerate() {
            let [a, b] = self.connectivity.edges()[edge as usize];
            joining[place] = components.unite(a, b);
        }
        let mut essential = Vec::new();
        for (&edge, &joins) in edges.iter().zip(&joining).rev() {
            if !joins && self.reduce(edge) {
                let [a, b] = self.connectivity.edges()[edge as usize];
                essential.push(if self.ranks[a as usize] > self.ranks[b as usize] { a } else { b });
            }
        }
        essential.reverse();
        essential
    }

    /// The edges by their higher and then their lower end.
    fn edges(&self) -> Vec<u32> {
        let rank = |edge: u32| self.connectivity.edges()[edge as usize].map(|v| self.ranks[v as usize]);
        let mut edges: Vec<u32> = (0..self.connectivity.edges().len() as u32).collect();
        sort_by_key(&mut edges, &|edge| {
            let [a, b] = rank(edge);
            u64::from(a.max(b)) << 32 | u64::from(a.min(b))
        });
        edges
    }

    /// Whether nothing is left of the coboundary of an edge.
    fn reduce(&mut self, edge: u32) -> bool {
        // The least place first; what is met twice cancels out.
        let mut sum: BinaryHeap<Reverse<u32>> = BinaryHeap::new();
        let mut reduced = Vec::new();
        for &t in self.connectivity.triangles_of_edge(edge) {
            sum.push(Reverse(self.places[t as usize]));
        }
        while let Some(Reverse(place)) = sum.pop() {
            if sum.peek() == Some(&Reverse(place)) {
                sum.pop();
                continue;
            }
            match self.others[place as usize] {
                Others::Free => reduced.push(place),
                Others::Nothing => {}
                Others::One(other) => sum.push(Reverse(self.follow(place, other))),
                Others::Many(list) => sum.extend(self.lists[list as usize].iter().map(|&place| Reverse(place))),
            }
        }
        let Some((&first, others)) = reduced.split_first() else { return true };
        self.others[first as usize] = match *others {
            [] => Others::Nothing,
            [one] => Others::One(one),
            _ => {
                self.lists.push(others.to_vec());
                Others::Many(self.lists.len() as u32 - 1)
            }
        };
        false
    }

    /// The end of the chain of single triangles that begins with `start` and `next`; the chain is shortened.
    fn follow(&mut self, mut start: u32, mut next: u32) -> u32 {
        while let Others::One(after) = self.others[next as usize] {
            self.others[start as usize] = Others::One(after);
            (start, next) = (next, after);
        }
        next
    }
}
