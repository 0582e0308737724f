//! The components of the lower and upper link of a vertex, one by one and in their order around it.

use super::graph::{LinkGraph, NONE};
use crate::error::OutOfMemory;
use crate::mesh::{Connectivity, LinkKind};

/// One component of the lower or upper link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::field) struct Component {
    /// Lower rather than upper.
    pub(in crate::field) lower: bool,
    start: u32,
    end: u32,
}

/// Room that is used again for every vertex.
#[derive(Debug)]
pub(in crate::field) struct LinkSides {
    graph: LinkGraph,
    /// The vertices of the link, those of one component together.
    members: Vec<u32>,
    components: Vec<Component>,
}

impl LinkSides {
    pub(in crate::field) fn new(vertices: usize) -> Result<Self, OutOfMemory> {
        Ok(Self { graph: LinkGraph::new(vertices)?, members: Vec::new(), components: Vec::new() })
    }

    /// Looks at the link of `vertex`. In a cycle the components come in their order around it, lower and upper ones in turn,
    /// a lower one first; in a path in their order along it.
    #[inline(never)]
    pub(in crate::field) fn inspect(
        &mut self,
        connectivity: &Connectivity,
        vertex: u32,
        is_lower: impl Fn(u32) -> bool + Copy,
    ) -> Result<(), OutOfMemory> {
        self.graph.gather(connectivity, vertex)?;
        self.members.clear();
        self.components.clear();
        match connectivity.link_kinds()[vertex as usize] {
            LinkKind::Isolated => {}
            LinkKind::Cycle | LinkKind::Path => self.walk(is_lower),
            LinkKind::NonManifold => self.unite(is_lower),
        }
        Ok(())
    }

    pub(in crate::field) fn components(&self) -> &[Component] {
        &self.components
    }

    /// How many of the components are lower ones.
    pub(in crate::field) fn lower_components(&self) -> u32 {
        self.components.iter().filter(|component| component.lower).count() as u32
    }

    pub(in crate::field) fn members(&self, component: Component) -> &[u32] {
        &self.members[component.start as usize..component.end as usize]
    }

    /// Goes along a cycle or a path once.
    fn walk(&mut self, is_lower: impl Fn(u32) -> bool) {
        let lower = |this: &Self, place: u32| is_lower(this.graph.nodes[place as usize]);
        let (mut start, mut towards) = (0, self.graph.beside[0][0]);
        for place in 0..self.graph.nodes.len() as u32 {
            let [a, b] = self.graph.beside[place as usize];
            if b == NONE {
                // The end of a path.
                (start, towards) = (place, a);
                break;
            }
            // The first node of a lower component, where there is one: the neighbour behind it is upper.
            if lower(self, place) && !(lower(self, a) && lower(self, b)) {
                (start, towards) = (place, if lower(self, a) { a } else { b });
            }
        }
        let (mut here, mut next) = (start, towards);
        loop {
            let side = lower(self, here);
            if self.components.last().is_none_or(|last| last.lower != side) {
                let start = self.members.len() as u32;
                self.components.push(Component { lower: side, start, end: start });
            }
            self.members.push(self.graph.nodes[here as usize]);
            if let Some(last) = self.components.last_mut() {
                last.end = self.members.len() as u32;
            }
            if next == NONE || next == start {
                break;
            }
            let [a, b] = self.graph.beside[next as usize];
            (here, next) = (next, if a == here { b } else { a });
        }
    }

    /// Components of any graph, the lower ones first.
    fn unite(&mut self, is_lower: impl Fn(u32) -> bool) {
        self.graph.sets.reset(self.graph.nodes.len());
        for i in 0..self.graph.edges.len() {
            let [a, b] = self.graph.edges[i];
            if is_lower(self.graph.nodes[a as usize]) == is_lower(self.graph.nodes[b as usize]) {
                self.graph.sets.unite(a, b);
            }
        }
        for side in [true, false] {
            let mut members = Vec::new();
            for place in 0..self.graph.nodes.len() as u32 {
                if is_lower(self.graph.nodes[place as usize]) == side {
                    members.push(u64::from(self.graph.sets.find(place)) << 32 | u64::from(place));
                }
            }
            members.sort_unstable();
            for group in members.chunk_by(|a, b| a >> 32 == b >> 32) {
                let start = self.members.len() as u32;
                self.members.extend(group.iter().map(|&key| self.graph.nodes[key as u32 as usize]));
                let end = self.members.len() as u32;
                self.components.push(Component { lower: side, start, end });
            }
        }
    }
}
