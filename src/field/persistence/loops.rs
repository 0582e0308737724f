//! Saddles at which a loop begins that never bounds.

use std::collections::BinaryHeap;

use core::cmp::Reverse;

use crate::error::FieldError;
use crate::field::arrays::{collected, copied, filled, numbers, push, with_room};
use crate::field::order::VertexOrder;
use crate::field::saddles::Saddles;
use crate::field::sorting::{sort_by_key, sort_by_value};
use crate::mesh::{Connectivity, LinkKind, TriMesh};
use crate::support::memory;
use crate::support::pieces::ranges;
use crate::support::union_find::UnionFind;
use crate::support::watch::Watch;

/// The vertices of the essential classes of dimension one of the sublevel sets, by ascending (value, id). `mergers` has for
/// every saddle how many components merge there in the sweeps up and down, and `steepest_up` the highest neighbours.
pub(super) fn essential_saddles(
    mesh: &TriMesh,
    order: VertexOrder<'_>,
    saddles: &Saddles,
    ascending: &[u32],
    mergers: &[[u32; 2]],
    steepest_up: &[u32],
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    let connectivity = mesh.connectivity();
    if connectivity.link_kinds().contains(&LinkKind::NonManifold) {
        return Coboundaries::new(connectivity, order, watch)?.essential_saddles(watch);
    }
    // On a surface, l components of the lower link are l − 1 handles: each joins components of the sublevel set, or begins a
    // loop. By duality a loop comes to bound where components of the superlevel set join.
    watch.tick(10 * saddles.len() as u64)?;
    let first = |i: u32| saddles.get(i).lower_components.saturating_sub(1) - mergers[i as usize][0];
    let mut loops = collected(saddles.len(), (0..saddles.len() as u32).map(first))?;
    if connectivity.special_vertices().is_empty() {
        for (loops, mergers) in loops.iter_mut().zip(mergers) {
            *loops -= mergers[1].min(*loops);
        }
    } else {
        bound_from_beyond(connectivity, saddles, ascending, steepest_up, &mut loops, watch)?;
    }
    let mut essential = Vec::new();
    for &i in ascending {
        for _ in 0..loops[i as usize] {
            push(&mut essential, saddles.get(i).vertex)?;
        }
    }
    Ok(essential)
}

/// Takes away the loops that come to bound on a surface with boundary, where a vertex above everything, next to the whole
/// boundary, takes the place of what lies beyond it.
fn bound_from_beyond(
    connectivity: &Connectivity,
    saddles: &Saddles,
    ascending: &[u32],
    steepest_up: &[u32],
    loops: &mut [u32],
    watch: &Watch<'_>,
) -> Result<(), FieldError> {
    let beyond = connectivity.vertex_count() as u32;
    let mut up = with_room(steepest_up.len() + 1)?;
    up.extend_from_slice(steepest_up);
    up.push(beyond);
    for &v in connectivity.special_vertices() {
        up[v as usize] = beyond;
    }
    let mut above = UnionFind::new(up);
    for range in ranges(ascending.len(), 100, watch) {
        for i in range? {
            let i = ascending[ascending.len() - 1 - i];
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
    Ok(())
}

/// The work with one triangle of a sum that is reduced.
const REDUCED: u64 = 30;

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
    fn new(connectivity: &'a Connectivity, order: VertexOrder<'_>, watch: &Watch<'_>) -> Result<Self, FieldError> {
        let mut vertices = numbers(connectivity.vertex_count())?;
        sort_by_value(&mut vertices, order.values(), watch)?;
        let mut ranks = filled(0, vertices.len())?;
        for (rank, &v) in vertices.iter().enumerate() {
            ranks[v as usize] = rank as u32;
        }
        let triangles = connectivity.triangles().len();
        let mut this = Self {
            connectivity,
            vertices,
            ranks,
            places: filled(0, triangles)?,
            others: filled(Others::Free, triangles)?,
            lists: Vec::new(),
        };
        this.place_triangles(watch)?;
        Ok(this)
    }

    fn place_triangles(&mut self, watch: &Watch<'_>) -> Result<(), FieldError> {
        let mut place = 0;
        let mut highest_here: Vec<(u64, u32)> = Vec::new();
        for range in ranges(self.vertices.len(), 200, watch) {
            for rank in range? {
                let v = self.vertices[rank];
                highest_here.clear();
                for &t in self.connectivity.star(v) {
                    let mut corners = self.connectivity.triangles()[t as usize].map(|v| self.ranks[v as usize]);
                    corners.sort_unstable();
                    if corners[2] as usize == rank {
                        push(&mut highest_here, (u64::from(corners[1]) << 32 | u64::from(corners[0]), t))?;
                    }
                }
                highest_here.sort_unstable();
                for &(_, t) in &highest_here {
                    self.places[t as usize] = place;
                    place += 1;
                }
            }
        }
        Ok(())
    }

    fn essential_saddles(mut self, watch: &Watch<'_>) -> Result<Vec<u32>, FieldError> {
        let edges = self.edges(watch)?;
        let mut joining = filled(false, edges.len())?;
        let mut components = UnionFind::new(numbers(self.vertices.len())?);
        for range in ranges(edges.len(), 20, watch) {
            for place in range? {
                let edge = edges[place];
                let [a, b] = self.connectivity.edges()[edge as usize];
                joining[place] = components.unite(a, b);
            }
        }
        let mut essential = Vec::new();
        for place in (0..edges.len()).rev() {
            let edge = edges[place];
            if !joining[place] && self.reduce(edge, watch)? {
                let [a, b] = self.connectivity.edges()[edge as usize];
                push(&mut essential, if self.ranks[a as usize] > self.ranks[b as usize] { a } else { b })?;
            }
        }
        essential.reverse();
        Ok(essential)
    }

    /// The edges by their higher and then their lower end.
    fn edges(&self, watch: &Watch<'_>) -> Result<Vec<u32>, FieldError> {
        let rank = |edge: u32| self.connectivity.edges()[edge as usize].map(|v| self.ranks[v as usize]);
        let mut edges = numbers(self.connectivity.edges().len())?;
        let key = |edge| {
            let [a, b] = rank(edge);
            u64::from(a.max(b)) << 32 | u64::from(a.min(b))
        };
        sort_by_key(&mut edges, &key, watch)?;
        Ok(edges)
    }

    /// Whether nothing is left of the coboundary of an edge.
    fn reduce(&mut self, edge: u32, watch: &Watch<'_>) -> Result<bool, FieldError> {
        // The least place first; what is met twice cancels out.
        let mut sum: BinaryHeap<Reverse<u32>> = BinaryHeap::new();
        let mut reduced = Vec::new();
        for &t in self.connectivity.triangles_of_edge(edge) {
            sum.push(Reverse(self.places[t as usize]));
        }
        let mut watched = 0;
        while let Some(Reverse(place)) = sum.pop() {
            watched += 1;
            if sum.peek() == Some(&Reverse(place)) {
                sum.pop();
                continue;
            }
            match self.others[place as usize] {
                Others::Free => push(&mut reduced, place)?,
                Others::Nothing => {}
                Others::One(other) => sum.push(Reverse(self.follow(place, other))),
                Others::Many(list) => {
                    let list = &self.lists[list as usize];
                    if sum.capacity() - sum.len() < list.len() {
                        // A heap that grows is moved.
                        memory::ensure(4 * 2 * (sum.capacity() + list.len()) as u64)?;
                    }
                    watched += list.len() as u64;
                    sum.extend(list.iter().map(|&place| Reverse(place)));
                }
            }
            if watched >= 1024 {
                watch.tick(REDUCED * core::mem::take(&mut watched))?;
            }
        }
        watch.tick(REDUCED * (watched + 1))?;
        let Some((&first, others)) = reduced.split_first() else { return Ok(true) };
        self.others[first as usize] = match *others {
            [] => Others::Nothing,
            [one] => Others::One(one),
            _ => {
                push(&mut self.lists, copied(others)?)?;
                Others::Many(self.lists.len() as u32 - 1)
            }
        };
        Ok(false)
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
