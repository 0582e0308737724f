//! Parts of a mesh that hang on by a single vertex: no field does without an extremum there.

use super::flats::Target;
use crate::error::FieldError;
use crate::field::arrays::{filled, push};
use crate::field::order::VertexOrder;
use crate::mesh::{Connectivity, LinkKind};
use crate::support::watch::Watch;

/// Numbers of the two imaginary vertices that stand for all wanted minima and all wanted maxima.
const BOTTOM: u32 = 0;
const TOP: u32 = 1;
const FIRST: u32 = 2;
const NONE: u32 = u32::MAX;

/// The work with one neighbour of a vertex.
const LOOK: u64 = 4;

/// Gives every part that needs an extremum of its own one as a target, and returns these. Ascending.
///
/// # Definition
/// No path along which a field ascends goes on over a minimum or a maximum. So all wanted minima are taken for one vertex, the
/// bottom, and all wanted maxima for another, the top, and an edge is put between these two. Where a single vertex cuts off others
/// from both of them, the lowest or the highest of these others is an extremum, whatever the field. One is enough for every block
/// that has one such vertex and no other; and with these there is a field that has no more \[Tarjan86\].
///
/// # Properties
/// Surfaces have no such parts: around a vertex of a surface, the others hang together. Linear time.
pub(super) fn unavoidable(
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    targets: &mut [Target],
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    if !connectivity.link_kinds().contains(&LinkKind::NonManifold) {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    let count = targets.len();
    let mut search = Search {
        connectivity,
        targets,
        numbers: filled(NONE, count)?,
        discovered: Vec::new(),
        parents: Vec::new(),
        lows: Vec::new(),
        has_cut: Vec::new(),
        stack: Vec::new(),
        leaves: Vec::new(),
    };
    for (from, start) in [(TOP, Target::Maximum), (BOTTOM, Target::Minimum)] {
        for v in 0..count as u32 {
            let is_new = search.targets[v as usize] == Target::Ordinary && search.numbers[v as usize] == NONE;
            if is_new && search.has_neighbour(v, start) {
                search.grow(v, from, watch)?;
                search.choose(from, order, &mut found)?;
            }
        }
    }
    for &(vertex, target) in &found {
        targets[vertex as usize] = target;
    }
    let mut vertices = Vec::new();
    for (vertex, _) in found {
        push(&mut vertices, vertex)?;
    }
    vertices.sort_unstable();
    Ok(vertices)
}

/// A search in depth for blocks, tree after tree of ordinary vertices.
struct Search<'a> {
    connectivity: &'a Connectivity,
    targets: &'a [Target],
    /// The numbers of vertices, in the order of discovery.
    numbers: Vec<u32>,
    /// The vertices in that order; the numbers of those they were found from, and the least numbers that they and their
    /// descendants are next to; and whether anything below them is cut off by a single vertex.
    discovered: Vec<u32>,
    parents: Vec<u32>,
    lows: Vec<u32>,
    has_cut: Vec<bool>,
    /// A vertex and the place among its neighbours to go on from.
    stack: Vec<(u32, u32)>,
    leaves: Vec<Leaf>,
}

/// A block behind a single vertex.
#[derive(Clone, Copy)]
struct Leaf {
    /// That vertex, by its number.
    cut: u32,
    /// The other vertices of the block, as a range in the order of discovery.
    start: u32,
    end: u32,
}

impl Search<'_> {
    /// A neighbour of `v`; most neighbours have two places.
    fn neighbour(&self, v: u32, place: u32) -> Option<u32> {
        let triangle = *self.connectivity.star(v).get(place as usize / 2)?;
        let [a, b, c] = self.connectivity.triangles()[triangle as usize];
        let [first, second] = if a == v {
            [b, c]
        } else if b == v {
            [c, a]
        } else {
            [a, b]
        };
        Some(if place.is_multiple_of(2) { first } else { second })
    }

    fn has_neighbour(&self, v: u32, target: Target) -> bool {
        (0..).map_while(|place| self.neighbour(v, place)).any(|w| self.targets[w as usize] == target)
    }

    fn discover(&mut self, v: u32, parent: u32) -> Result<(), FieldError> {
        let number = self.discovered.len() as u32 + FIRST;
        self.numbers[v as usize] = number;
        push(&mut self.discovered, v)?;
        push(&mut self.parents, parent)?;
        push(&mut self.lows, number)?;
        push(&mut self.has_cut, false)?;
        push(&mut self.stack, (v, 0))?;
        Ok(())
    }

    /// Searches all that hangs together with `root`, which is next to the imaginary vertex `from`, and lists the leaves.
    fn grow(&mut self, root: u32, from: u32, watch: &Watch<'_>) -> Result<(), FieldError> {
        self.leaves.clear();
        self.discover(root, from)?;
        while let Some(top) = self.stack.last_mut() {
            let (v, place) = *top;
            top.1 += 1;
            let own = (self.numbers[v as usize] - FIRST) as usize;
            if let Some(w) = self.neighbour(v, place) {
                let next_to = match self.targets[w as usize] {
                    Target::Minimum => BOTTOM,
                    Target::Maximum => TOP,
                    Target::Ordinary => self.numbers[w as usize],
                };
                if next_to == NONE {
                    self.discover(w, self.numbers[v as usize])?;
                } else {
                    self.lows[own] = self.lows[own].min(next_to);
                }
                continue;
            }
            watch.tick(LOOK * u64::from(place))?;
            self.stack.pop();
            let parent = self.parents[own];
            let is_cut = self.lows[own] >= parent;
            if is_cut && !self.has_cut[own] {
                let leaf = Leaf { cut: parent, start: own as u32, end: self.discovered.len() as u32 };
                push(&mut self.leaves, leaf)?;
            }
            if parent >= FIRST {
                let above = (parent - FIRST) as usize;
                self.lows[above] = self.lows[above].min(self.lows[own]);
                self.has_cut[above] |= is_cut || self.has_cut[own];
            }
        }
        Ok(())
    }

    /// Chooses an extremum for each leaf of the tree that was searched last: what reaches the top alone needs a minimum, what
    /// reaches the bottom alone a maximum, and a leaf of what reaches both the one that stands out more.
    fn choose(&self, from: u32, order: VertexOrder<'_>, found: &mut Vec<(u32, Target)>) -> Result<(), FieldError> {
        let values = order.values();
        let Some(root) = self.parents.iter().rposition(|&parent| parent < FIRST) else { return Ok(()) };
        let hangs = self.lows[root] >= from;
        for &Leaf { cut, start, end } in &self.leaves {
            let inside = &self.discovered[start as usize..end as usize];
            let (mut lowest, mut highest) = (inside[0], inside[0]);
            for &v in inside {
                lowest = if order.is_below(v, lowest) { v } else { lowest };
                highest = if order.is_below(highest, v) { v } else { highest };
            }
            let takes_highest = if hangs {
                from == BOTTOM
            } else {
                let height = values[self.discovered[(cut - FIRST) as usize] as usize];
                values[highest as usize] - height >= height - values[lowest as usize]
            };
            push(found, if takes_highest { (highest, Target::Maximum) } else { (lowest, Target::Minimum) })?;
        }
        Ok(())
    }
}
