//! Orders the vertices of flat regions so that every one has a lower and a higher neighbour.

use core::cmp::Ordering;

use crate::mesh::{Connectivity, LinkKind};

/// What becomes of a vertex, from bottom to top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// To lie below all its neighbours.
    Minimum,
    /// To be regular or a saddle.
    Ordinary,
    /// To lie above all its neighbours.
    Maximum,
}

/// Bits of what a vertex has for neighbours.
const HIGHER: u8 = 1;
const LOWER: u8 = 2;
const LEVEL: u8 = 4;
/// On the same level, with a greater or a smaller id.
const LEVEL_AFTER: u8 = 8;
const LEVEL_BEFORE: u8 = 16;

/// Numbers of the two imaginary vertices that stand for all that is lower and all that is higher.
const BOTTOM: u32 = 0;
const TOP: u32 = 1;
const FIRST: u32 = 2;
const NONE: u32 = u32::MAX;

/// What every vertex has for neighbours, on a surface of levels.
#[derive(Debug)]
pub(super) struct Surroundings {
    bits: Vec<u8>,
    /// The neighbours on the same level, in compressed rows.
    offsets: Vec<u32>,
    level: Vec<u32>,
}

impl Surroundings {
    /// Two passes over the edges.
    #[inline(never)]
    pub(super) fn new(connectivity: &Connectivity, levels: &[f64], roles: &[Role]) -> Self {
        let mut bits = vec![0_u8; levels.len()];
        let mut offsets = vec![0_u32; levels.len() + 1];
        for &[a, b] in connectivity.edges() {
            let (a, b) = (a as usize, b as usize);
            let (of_a, of_b) = if levels[a] < levels[b] {
                (HIGHER, LOWER)
            } else if levels[a] > levels[b] {
                (LOWER, HIGHER)
            } else {
                offsets[a] += 1;
                offsets[b] += 1;
                match (roles[a] as u8).cmp(&(roles[b] as u8)) {
                    Ordering::Less => (HIGHER, LOWER),
                    Ordering::Greater => (LOWER, HIGHER),
                    // The ends of an edge ascend.
                    Ordering::Equal => (LEVEL | LEVEL_AFTER, LEVEL | LEVEL_BEFORE),
                }
            };
            bits[a] |= of_a;
            bits[b] |= of_b;
        }
        let mut total = 0;
        for offset in &mut offsets {
            total += *offset;
            *offset = total;
        }
        // Filled from the ends, so that these become starts.
        let mut level = vec![0; total as usize];
        for &[a, b] in connectivity.edges() {
            if levels[a as usize] == levels[b as usize] {
                for (this, that) in [(a, b), (b, a)] {
                    let place = &mut offsets[this as usize];
                    *place -= 1;
                    level[*place as usize] = that;
                }
            }
        }
        Self { bits, offsets, level }
    }

    /// The neighbours on the same level.
    #[inline]
    pub(super) fn level(&self, v: u32) -> &[u32] {
        &self.level[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize]
    }

    #[inline]
    fn has(&self, v: u32, bits: u8) -> bool {
        self.bits[v as usize] & bits != 0
    }
}

/// All vertices but isolated ones, so that on each level the minima come first and the maxima last, and every ordinary vertex
/// of a flat region has a neighbour before and one behind it, as far as the mesh has room for that.
///
/// # Definition
/// A flat region, its minima and maxima taken out, gets a bottom (all its lower neighbours and wanted minima) and a top.
/// An st-numbering of that graph is wanted: every vertex but the bottom and the top has a neighbour with a smaller and one
/// with a greater number. There is one where no single vertex cuts off others from both \[Tarjan86\], hence on every surface:
/// around a vertex of a surface, the others hang together. A region where ids are such a numbering is left to them. Linear
/// time.
#[inline(never)]
pub(super) fn ordered(connectivity: &Connectivity, around: &Surroundings, roles: &[Role]) -> Vec<u32> {
    let mut order: Vec<u32> = Vec::with_capacity(roles.len());
    let kinds = connectivity.link_kinds();
    let mut region = Region {
        roles,
        around,
        numbers: vec![NONE; roles.len()],
        counted: FIRST,
        vertices: Vec::new(),
        parents: Vec::new(),
        lows: Vec::new(),
        stack: Vec::new(),
        next: Vec::new(),
        previous: Vec::new(),
        is_reached_from_below: Vec::new(),
    };
    let all = 0..roles.len() as u32;
    order.extend(all.clone().filter(|&v| roles[v as usize] == Role::Minimum));
    // From the top downwards; a region that nothing is above comes last and keeps a maximum.
    for wanted in [HIGHER, HIGHER | LEVEL] {
        for v in all.clone() {
            let index = v as usize;
            if roles[index] != Role::Ordinary || kinds[index] == LinkKind::Isolated || region.numbers[index] != NONE {
                continue;
            }
            if !around.has(v, LEVEL) {
                region.numbers[index] = TOP;
                order.push(v);
            } else if around.has(v, wanted) {
                region.search(v);
                if region.is_ordered_by_id() {
                    region.vertices.sort_unstable();
                    order.extend_from_slice(&region.vertices);
                } else {
                    region.number(&mut order);
                }
            }
        }
    }
    order.extend(all.filter(|&v| roles[v as usize] == Role::Maximum));
    order
}

/// One flat region after the other, searched depth first from a vertex next to the top.
struct Region<'a> {
    roles: &'a [Role],
    around: &'a Surroundings,
    /// In the order of discovery, going on from region to region.
    numbers: Vec<u32>,
    counted: u32,
    /// Of the current region, in that order: the vertices, the numbers of those they were found from, and the least numbers
    /// that they and their descendants are next to. Numbers of this region begin at `counted − vertices.len()`.
    vertices: Vec<u32>,
    parents: Vec<u32>,
    lows: Vec<u32>,
    /// Vertex and the place among its level neighbours to go on from.
    stack: Vec<(u32, u32)>,
    /// The numbering, a linked list.
    next: Vec<u32>,
    previous: Vec<u32>,
    is_reached_from_below: Vec<bool>,
}

impl Region<'_> {
    /// Number of a vertex of this region counted from [`FIRST`], as if it were the only one.
    fn own(&self, number: u32) -> u32 {
        number - (self.counted - self.vertices.len() as u32) + FIRST
    }

    fn discover(&mut self, v: u32, parent: u32) {
        self.numbers[v as usize] = self.counted;
        self.counted += 1;
        self.vertices.push(v);
        self.parents.push(parent);
        let own = self.vertices.len() as u32 - 1 + FIRST;
        self.lows.push(if self.around.has(v, LOWER) {
            BOTTOM
        } else if self.around.has(v, HIGHER) {
            TOP
        } else {
            own
        });
        self.stack.push((v, 0));
    }

    fn search(&mut self, root: u32) {
        self.vertices.clear();
        self.parents.clear();
        self.lows.clear();
        self.discover(root, TOP);
        while let Some(top) = self.stack.last_mut() {
            let (v, step) = *top;
            top.1 += 1;
            let own = self.own(self.numbers[v as usize]);
            let low = (own - FIRST) as usize;
            let Some(&w) = self.around.level(v).get(step as usize) else {
                self.stack.pop();
                let parent = self.parents[low];
                if parent >= FIRST {
                    let of_parent = (parent - FIRST) as usize;
                    self.lows[of_parent] = self.lows[of_parent].min(self.lows[low]);
                }
                continue;
            };
            if self.roles[w as usize] != Role::Ordinary {
                continue;
            }
            match self.numbers[w as usize] {
                NONE => self.discover(w, own),
                number => self.lows[low] = self.lows[low].min(self.own(number)),
            }
        }
    }

    fn is_ordered_by_id(&self) -> bool {
        let has = |v, bits| self.around.has(v, bits);
        self.vertices.iter().all(|&v| has(v, LOWER | LEVEL_BEFORE) && has(v, HIGHER | LEVEL_AFTER))
    }

    /// The st-numbering: every vertex is put just before or just behind the one it was found from, whichever keeps it between
    /// that one and the least one it can reach.
    fn number(&mut self, order: &mut Vec<u32>) {
        let size = self.vertices.len() + FIRST as usize;
        let Self { next, previous, is_reached_from_below, .. } = self;
        next.resize(size, NONE);
        previous.resize(size, NONE);
        (next[BOTTOM as usize], previous[TOP as usize]) = (TOP, BOTTOM);
        is_reached_from_below.clear();
        is_reached_from_below.resize(size, false);
        is_reached_from_below[BOTTOM as usize] = true;
        for i in 0..self.vertices.len() {
            let (v, parent) = (i as u32 + FIRST, self.parents[i]);
            let before = is_reached_from_below[self.lows[i] as usize] || parent == TOP;
            let (left, right) =
                if before { (previous[parent as usize], parent) } else { (parent, next[parent as usize]) };
            (previous[v as usize], next[v as usize]) = (left, right);
            next[left as usize] = v;
            previous[right as usize] = v;
            is_reached_from_below[parent as usize] = !before;
        }
        let mut at = next[BOTTOM as usize];
        while at != TOP {
            order.push(self.vertices[(at - FIRST) as usize]);
            at = next[at as usize];
        }
    }
}
