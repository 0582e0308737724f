//! Union and find.

/// Sets of numbers, each named by one of them.
#[derive(Debug, Default)]
pub(super) struct Forest {
    /// Towards the name.
    parents: Vec<u32>,
}

impl Forest {
    pub(super) fn new(parents: Vec<u32>) -> Self {
        Self { parents }
    }

    /// `size` sets of one member each.
    pub(super) fn reset(&mut self, size: usize) {
        self.parents.clear();
        self.parents.extend(0..size as u32);
    }

    /// The name of the set of `v`.
    #[inline]
    pub(super) fn find(&mut self, mut v: u32) -> u32 {
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

    pub(super) fn is_name(&self, v: u32) -> bool {
        self.parents[v as usize] == v
    }

    /// Two names become the second one.
    pub(super) fn lead(&mut self, from: u32, to: u32) {
        self.parents[from as usize] = to;
    }

    /// Whether `a` and `b` were in different sets until now.
    pub(super) fn unite(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.lead(a, b);
        a != b
    }
}
