//! Union–find: disjoint sets of numbers that are joined one by one.

/// Disjoint sets of the numbers from 0, each named by one of its members.
#[derive(Debug, Default)]
pub(crate) struct UnionFind {
    /// For every number one that is nearer to the name of its set; a name has itself.
    parents: Vec<u32>,
}

impl UnionFind {
    /// Sets as given by their trees: the parent of each number, itself for names.
    pub(crate) fn new(parents: Vec<u32>) -> Self {
        Self { parents }
    }

    /// `size` sets of one member each.
    pub(crate) fn singletons(size: usize) -> Self {
        Self { parents: (0..size as u32).collect() }
    }

    /// Starts again with `size` sets of one member each, in the memory there is.
    pub(crate) fn reset(&mut self, size: usize) {
        self.parents.clear();
        self.parents.extend(0..size as u32);
    }

    /// The name of the set of `v`.
    #[inline]
    pub(crate) fn find(&mut self, mut v: u32) -> u32 {
        loop {
            let parent = self.parents[v as usize];
            if parent == v {
                return v;
            }
            // Half of the way becomes shorter each time.
            let above = self.parents[parent as usize];
            self.parents[v as usize] = above;
            v = above;
        }
    }

    /// Whether `v` is the name of its set.
    pub(crate) fn is_name(&self, v: u32) -> bool {
        self.parents[v as usize] == v
    }

    /// Joins the sets with the names `from` and `to`; the name is `to`.
    pub(crate) fn link(&mut self, from: u32, to: u32) {
        self.parents[from as usize] = to;
    }

    /// Joins the sets of `a` and `b` and tells whether they were different ones.
    pub(crate) fn unite(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.link(a, b);
        a != b
    }
}
