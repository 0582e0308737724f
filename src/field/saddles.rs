//! All vertices at which components of sublevel or superlevel sets can meet.

use super::critical::{ONE_CHANGE, sweep};
use super::link_sides::LinkSides;
use super::order::VertexOrder;
use super::sorting::{ascending_bits, sort_by_key};
use super::steepest::Steepness;
use crate::mesh::{LinkKind, TriMesh};

/// One vertex with several components of its lower or upper link, each with the vertex that a steepest path goes to first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Saddle<'a> {
    pub(super) vertex: u32,
    /// First vertices of the steepest paths down, one for each component of the lower link. Where the link is a cycle,
    /// `upper[i]` lies between `lower[i]` and the next one.
    pub(super) lower: &'a [u32],
    /// First vertices of the steepest paths up.
    pub(super) upper: &'a [u32],
}

/// The saddles of a field, ascending by vertex. An extremum whose link is in several pieces is among them: components meet
/// there all the same.
#[derive(Debug, Default)]
pub(super) struct Saddles {
    vertices: Vec<u32>,
    offsets: Vec<u32>,
    /// How many first vertices of each saddle are lower ones.
    lower: Vec<u32>,
    first: Vec<u32>,
}

impl Saddles {
    pub(super) fn new(mesh: &TriMesh, order: VertexOrder<'_>, steepness: Steepness<'_>) -> Self {
        Self::with_tips(mesh, order, steepness, &[], false)
    }

    /// As if the vertices in `tips` were raised a little (`upper`), or lowered: around such a vertex, what is farther out in that
    /// direction is joined to the vertex itself. Nothing changes at one that is an extremum.
    #[inline(never)]
    pub(super) fn with_tips(
        mesh: &TriMesh,
        order: VertexOrder<'_>,
        steepness: Steepness<'_>,
        tips: &[bool],
        upper: bool,
    ) -> Self {
        let connectivity = mesh.connectivity();
        let states = sweep(connectivity, |i, j| if order.is_below(i, j) { 1 } else { -1 });
        let mut sides = LinkSides::new(mesh.vertex_count());
        let mut this = Self { offsets: vec![0], ..Self::default() };
        for (v, (&state, &kind)) in states.iter().zip(connectivity.link_kinds()).enumerate() {
            let tip = tips.get(v) == Some(&true);
            if (kind == LinkKind::Cycle && state < 4 * ONE_CHANGE && !tip) || kind == LinkKind::Isolated {
                continue;
            }
            let v = v as u32;
            sides.inspect(connectivity, v, |j| order.is_below(j, v));
            let start = this.first.len();
            let mut counts = [0, 0];
            for (count, lower) in counts.iter_mut().zip([true, false]) {
                let before = this.first.len();
                if tip && lower != upper {
                    this.first.push(v);
                }
                for &component in sides.components().iter().filter(|component| component.lower == lower) {
                    let members = sides.members(component).iter().copied();
                    let steepest =
                        members.reduce(|best, j| if steepness.is_steeper(order, v, j, best) { j } else { best });
                    this.first.extend(steepest);
                }
                *count = (this.first.len() - before) as u32;
            }
            if counts[0].max(counts[1]) < 2 {
                this.first.truncate(start);
                continue;
            }
            this.vertices.push(v);
            this.lower.push(counts[0]);
            this.offsets.push(this.first.len() as u32);
        }
        this
    }

    pub(super) fn len(&self) -> usize {
        self.vertices.len()
    }

    pub(super) fn get(&self, index: u32) -> Saddle<'_> {
        let index = index as usize;
        let first = &self.first[self.offsets[index] as usize..self.offsets[index + 1] as usize];
        let (lower, upper) = first.split_at(self.lower[index] as usize);
        Saddle { vertex: self.vertices[index], lower, upper }
    }

    /// Indices of the saddles by ascending (value, id).
    pub(super) fn ascending(&self, values: &[f64]) -> Vec<u32> {
        let mut indices: Vec<u32> = (0..self.vertices.len() as u32).collect();
        sort_by_key(&mut indices, &|i| ascending_bits(values[self.vertices[i as usize] as usize]));
        indices
    }
}
