//! The components of the lower and upper link of a vertex, one by one and in their order around it.

use crate::mesh::{Connectivity, LinkKind};

/// One component of the lower or upper link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Component {
    /// Lower rather than upper.
    pub(super) lower: bool,
    start: u32,
    end: u32,
}

/// Room that is used again for every vertex.
#[derive(Debug)]
pub(super) struct LinkSides {
    /// For every vertex of the mesh its place among the nodes; `NONE` outside of the link.
    places: Vec<u32>,
    /// The vertices of the link as they are met.
    nodes: Vec<u32>,
    edges: Vec<[u32; 2]>,
    degrees: Vec<u32>,
    /// The nodes next to each one, where the link is a cycle or a path.
    beside: Vec<[u32; 2]>,
    parents: Vec<u32>,
    /// The vertices of the link, those of one component together.
    members: Vec<u32>,
    components: Vec<Component>,
}

const NONE: u32 = u32::MAX;

impl LinkSides {
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            places: vec![NONE; vertices],
            nodes: Vec::new(),
            edges: Vec::new(),
            degrees: Vec::new(),
            beside: Vec::new(),
            parents: Vec::new(),
            members: Vec::new(),
            components: Vec::new(),
        }
    }

    /// Looks at the link of `vertex`. In a cycle the components come in their order around it, lower and upper ones in turn,
    /// a lower one first; in a path in their order along it.
    #[inline(never)]
    pub(super) fn inspect(&mut self, connectivity: &Connectivity, vertex: u32, is_lower: impl Fn(u32) -> bool + Copy) {
        self.gather(connectivity, vertex);
        self.members.clear();
        self.components.clear();
        match connectivity.link_kinds()[vertex as usize] {
            LinkKind::Isolated => {}
            LinkKind::Cycle | LinkKind::Path => self.walk(is_lower),
            LinkKind::NonManifold => self.unite(is_lower),
        }
    }

    pub(super) fn components(&self) -> &[Component] {
        &self.components
    }

    /// How many of the components are lower ones.
    pub(super) fn lower_components(&self) -> u32 {
        self.components.iter().filter(|component| component.lower).count() as u32
    }

    pub(super) fn members(&self, component: Component) -> &[u32] {
        &self.members[component.start as usize..component.end as usize]
    }

    fn gather(&mut self, connectivity: &Connectivity, vertex: u32) {
        for &node in &self.nodes {
            self.places[node as usize] = NONE;
        }
        self.nodes.clear();
        self.degrees.clear();
        self.edges.clear();
        self.beside.clear();
        for &t in connectivity.star(vertex) {
            let [a, b, c] = connectivity.triangles()[t as usize];
            let (j, k) = if a == vertex {
                (b, c)
            } else if b == vertex {
                (c, a)
            } else {
                (a, b)
            };
            let (j, k) = (self.place(j), self.place(k));
            self.edges.push([j, k]);
            self.put_beside(j, k);
            self.put_beside(k, j);
        }
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

    /// Goes along a cycle or a path once.
    fn walk(&mut self, is_lower: impl Fn(u32) -> bool) {
        let lower = |this: &Self, place: u32| is_lower(this.nodes[place as usize]);
        let (mut start, mut towards) = (0, self.beside[0][0]);
        for place in 0..self.nodes.len() as u32 {
            let [a, b] = self.beside[place as usize];
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
            self.members.push(self.nodes[here as usize]);
            if let Some(last) = self.components.last_mut() {
                last.end = self.members.len() as u32;
            }
            if next == NONE || next == start {
                break;
            }
            let [a, b] = self.beside[next as usize];
            (here, next) = (next, if a == here { b } else { a });
        }
    }

    /// Components of any graph, the lower ones first.
    fn unite(&mut self, is_lower: impl Fn(u32) -> bool) {
        self.parents.clear();
        self.parents.extend(0..self.nodes.len() as u32);
        for i in 0..self.edges.len() {
            let [a, b] = self.edges[i];
            if is_lower(self.nodes[a as usize]) == is_lower(self.nodes[b as usize]) {
                let (a, b) = (self.root(a), self.root(b));
                self.parents[a.max(b) as usize] = a.min(b);
            }
        }
        for side in [true, false] {
            let mut members = Vec::new();
            for place in 0..self.nodes.len() as u32 {
                if is_lower(self.nodes[place as usize]) == side {
                    members.push(u64::from(self.root(place)) << 32 | u64::from(place));
                }
            }
            members.sort_unstable();
            for group in members.chunk_by(|a, b| a >> 32 == b >> 32) {
                let start = self.members.len() as u32;
                self.members.extend(group.iter().map(|&key| self.nodes[key as u32 as usize]));
                let end = self.members.len() as u32;
                self.components.push(Component { lower: side, start, end });
            }
        }
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
