//! All vertices at which components of sublevel or superlevel sets can meet.

use super::arrays::{append, numbers, push};
use super::critical::{ONE_CHANGE, exact_changes};
use super::link::{LinkSides, opposite};
use super::order::VertexOrder;
use super::sorting::{ascending_bits, sort_by_key};
use super::steepest::steepest_of;
use crate::error::{FieldError, OutOfMemory};
use crate::mesh::{LinkKind, TriMesh};
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// The work with one vertex; with one whose sides are inspected, as most are where a field is noisy.
const EACH: u64 = 20;
const INSPECTED: u64 = 120;

/// One vertex with several components of its lower or upper link.
#[derive(Debug, Clone, Copy)]
pub(super) struct Saddle<'a> {
    pub(super) vertex: u32,
    /// Vertices of the lower link, of every component at least one.
    pub(super) lower: &'a [u32],
    /// Vertices of the upper link, of every component at least one.
    pub(super) upper: &'a [u32],
    /// Components of the lower link.
    pub(super) lower_components: u32,
}

/// The saddles of a field, ascending by vertex. An extremum whose link is in several pieces is among them: components meet
/// there all the same.
#[derive(Debug)]
pub(super) struct Saddles {
    vertices: Vec<u32>,
    /// Where the link vertices of each begin: lower and upper ones in turn.
    offsets: Vec<u32>,
    first: Vec<u32>,
    lower_components: Vec<u32>,
}

impl Saddles {
    /// Takes up some vertices of each component, found in the least time.
    pub(super) fn new(mesh: &TriMesh, order: VertexOrder<'_>, watch: &Watch<'_>) -> Result<Self, FieldError> {
        Self::with_tips(mesh, order, &[], false, watch)
    }

    /// Does so as if the vertices in `tips` were raised a little (`upper`), or lowered: around such a vertex, what is farther out in that
    /// direction is joined to the vertex itself. Nothing changes at one that is an extremum.
    #[inline(never)]
    pub(super) fn with_tips(
        mesh: &TriMesh,
        order: VertexOrder<'_>,
        tips: &[bool],
        upper: bool,
        watch: &Watch<'_>,
    ) -> Result<Self, FieldError> {
        let connectivity = mesh.connectivity();
        let states = exact_changes(connectivity, order, watch)?;
        let kinds = connectivity.link_kinds();
        let mut sides = LinkSides::new(mesh.vertex_count())?;
        let mut this = Self::empty()?;
        let mut above = Vec::new();
        for range in ranges(states.len(), EACH, watch) {
            for v in range? {
                let v = v as u32;
                let changes = states[v as usize] / ONE_CHANGE;
                let kind = kinds[v as usize];
                let is_tip = !tips.is_empty() && tips[v as usize];
                if kind == LinkKind::Cycle && !is_tip {
                    if changes >= 4 {
                        this.push_changes(mesh, order, v, &mut above)?;
                        this.close(v, changes / 2)?;
                    }
                    continue;
                }
                sides.inspect(connectivity, v, |j| order.is_below(j, v))?;
                let tip = is_tip.then_some(upper);
                this.push_components(v, &sides, tip, &|members| members[0])?;
                this.close(v, sides.lower_components())?;
            }
        }
        Ok(this)
    }

    /// Takes up the steepest vertex of each component, once each. Where the link is a cycle, `upper[i]` lies between `lower[i]` and
    /// the next one.
    #[inline(never)]
    pub(super) fn steepest(mesh: &TriMesh, order: VertexOrder<'_>, watch: &Watch<'_>) -> Result<Self, FieldError> {
        let connectivity = mesh.connectivity();
        let states = exact_changes(connectivity, order, watch)?;
        let kinds = connectivity.link_kinds();
        let mut sides = LinkSides::new(mesh.vertex_count())?;
        let mut this = Self::empty()?;
        for range in ranges(states.len(), INSPECTED, watch) {
            for v in range? {
                let v = v as u32;
                if kinds[v as usize] == LinkKind::Cycle && states[v as usize] < 4 * ONE_CHANGE {
                    continue;
                }
                sides.inspect(connectivity, v, |j| order.is_below(j, v))?;
                this.push_components(v, &sides, None, &|members| steepest_of(mesh, order, v, members))?;
                this.close(v, sides.lower_components())?;
            }
        }
        Ok(this)
    }

    fn empty() -> Result<Self, OutOfMemory> {
        let mut this =
            Self { vertices: Vec::new(), offsets: Vec::new(), first: Vec::new(), lower_components: Vec::new() };
        push(&mut this.offsets, 0)?;
        Ok(this)
    }

    /// One vertex of each component; before them the vertex itself, on the upper or lower side, if it is a tip there.
    fn push_components(
        &mut self,
        v: u32,
        sides: &LinkSides,
        upper_tip: Option<bool>,
        pick: &dyn Fn(&[u32]) -> u32,
    ) -> Result<(), OutOfMemory> {
        for upper in [false, true] {
            if upper_tip == Some(upper) {
                push(&mut self.first, v)?;
            }
            for &component in sides.components() {
                if component.lower != upper {
                    push(&mut self.first, pick(sides.members(component)))?;
                }
            }
            push(&mut self.offsets, self.first.len() as u32)?;
        }
        Ok(())
    }

    /// Around a cycle, both ends of every edge between a lower and an upper vertex: each component has two, or twice the same.
    fn push_changes(
        &mut self,
        mesh: &TriMesh,
        order: VertexOrder<'_>,
        v: u32,
        above: &mut Vec<u32>,
    ) -> Result<(), OutOfMemory> {
        above.clear();
        for &t in mesh.connectivity().star(v) {
            let [j, k] = opposite(mesh.connectivity().triangles()[t as usize], v);
            let j_is_lower = order.is_below(j, v);
            if j_is_lower != order.is_below(k, v) {
                let (low, high) = if j_is_lower { (j, k) } else { (k, j) };
                push(&mut self.first, low)?;
                push(above, high)?;
            }
        }
        push(&mut self.offsets, self.first.len() as u32)?;
        append(&mut self.first, above)?;
        push(&mut self.offsets, self.first.len() as u32)
    }

    /// Takes up the vertex whose link vertices were put in last, unless there is but one of each side.
    fn close(&mut self, v: u32, lower_components: u32) -> Result<(), OutOfMemory> {
        let [.., start, middle, end] = self.offsets[..] else { return Ok(()) };
        if middle - start > 1 || end - middle > 1 {
            push(&mut self.vertices, v)?;
            push(&mut self.lower_components, lower_components)?;
        } else {
            self.first.truncate(start as usize);
            self.offsets.truncate(self.offsets.len() - 2);
        }
        Ok(())
    }

    pub(super) fn len(&self) -> usize {
        self.vertices.len()
    }

    #[inline]
    pub(super) fn get(&self, index: u32) -> Saddle<'_> {
        let index = index as usize;
        let offsets = &self.offsets[2 * index..2 * index + 3];
        let (start, middle, end) = (offsets[0] as usize, offsets[1] as usize, offsets[2] as usize);
        Saddle {
            vertex: self.vertices[index],
            lower: &self.first[start..middle],
            upper: &self.first[middle..end],
            lower_components: self.lower_components[index],
        }
    }

    /// Indices of the saddles by ascending (value, id).
    pub(super) fn ascending(&self, values: &[f64], watch: &Watch<'_>) -> Result<Vec<u32>, FieldError> {
        let mut indices = numbers(self.vertices.len())?;
        sort_by_key(&mut indices, &|i| ascending_bits(values[self.vertices[i as usize] as usize]), watch)?;
        Ok(indices)
    }
}
