//! Orders the vertices of flat regions so that every one has a lower and a higher neighbour.

use crate::mesh::{Connectivity, LinkKind};

/// What becomes of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// To be regular or a saddle.
    Ordinary,
    /// To lie below all its neighbours.
    Minimum,
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

/// All vertices but isolated ones, so that if they are sorted by level without changing the order of equals, every ordinary
/// vertex has a neighbour before and one behind it, as far as the mesh has room for that.
///
/// # Definition
/// A flat region, its minima and maxima taken out, gets a bottom (all its lower neighbours and wanted minima) and a top.
/// An st-numbering of that graph is wanted: every vertex but the bottom and the top has a neighbour with a smaller and one
/// with a greater number. There is one where no single vertex cuts off others from both \[Tarjan86\], hence on every surface:
/// around a vertex of a surface, the others hang together. A region where ids are such a numbering is left to them. Linear
/// time.
pub(super) fn ordered(connectivity: &Connectivity, levels: &[f64], roles: &[Role]) -> Vec<u32> {
    let around = neighbourhoods(connectivity, levels, roles);
    let mut order: Vec<u32> = Vec::with_capacity(levels.len());
    let with_role = |role| (0..levels.len() as u32).filter(move |&v| roles[v as usize] == role);
    order.extend(with_role(Role::Minimum));
    let mut region = Region {
        connectivity,
        levels,
        roles,
        around: &around,
        numbers: vec![NONE; levels.len()],
        counted: FIRST,
        vertices: Vec::new(),
        parents: Vec::new(),
        lows: Vec::new(),
        stack: Vec::new(),
    };
    // From the top downwards; a region that nothing is above comes last and keeps a maximum.
    for wanted in [HIGHER, 0] {
        for v in with_role(Role::Ordinary) {
            let index = v as usize;
            if connectivity.link_kinds()[index] == LinkKind::Isolated || region.numbers[index] != NONE {
                continue;
            }
            if around[index] & LEVEL == 0 {
                region.numbers[index] = TOP;
                order.push(v);
            } else if around[index] & wanted == wanted {
                region.search(v);
                if region.is_ordered_by_id() {
                    region.vertices.sort_unstable();
                    order.extend(&region.vertices);
                } else {
                    region.number(&mut order);
                }
            }
        }
    }
    order.extend(with_role(Role::Maximum));
    order
}

/// One pass over the edges.
fn neighbourhoods(connectivity: &Connectivity, levels: &[f64], roles: &[Role]) -> Vec<u8> {
    let mut around = vec![0_u8; levels.len()];
    for &[a, b] in connectivity.edges() {
        let (a, b) = (a as usize, b as usize);
        let height = |v: usize| match roles[v] {
            Role::Minimum => -1,
            Role::Ordinary => 0,
            Role::Maximum => 1,
        };
        let (of_a, of_b) = if levels[a] == levels[b] && height(a) == height(b) {
            // The ends of an edge ascend.
            (LEVEL | LEVEL_AFTER, LEVEL | LEVEL_BEFORE)
        } else if levels[a] < levels[b] || (levels[a] == levels[b] && height(a) < height(b)) {
            (HIGHER, LOWER)
        } else {
            (LOWER, HIGHER)
        };
        around[a] |= of_a;
        around[b] |= of_b;
    }
    around
}

/// One flat region after the other, searched depth first from a vertex next to the top.
struct Region<'a> {
    connectivity: &'a Connectivity,
    levels: &'a [f64],
    roles: &'a [Role],
    around: &'a [u8],
    /// In the order of discovery, going on from region to region.
    numbers: Vec<u32>,
    counted: u32,
    /// Of the current region, in that order: the vertices, the numbers of those they were found from, and the least numbers
    /// that they and their descendants are next to. Numbers of this region begin at `counted − vertices.len()`.
    vertices: Vec<u32>,
    parents: Vec<u32>,
    lows: Vec<u32>,
    /// Vertex and the place in its star to go on from, two corners for each triangle.
    stack: Vec<(u32, u32)>,
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
        self.lows.push(match self.around[v as usize] {
            around if around & LOWER != 0 => BOTTOM,
            around if around & HIGHER != 0 => TOP,
            _ => own,
        });
        self.stack.push((v, 0));
    }

    fn search(&mut self, root: u32) {
        self.vertices.clear();
        self.parents.clear();
        self.lows.clear();
        self.discover(root, TOP);
        while let Some(&(v, step)) = self.stack.last() {
            let star = self.connectivity.star(v);
            let own = self.own(self.numbers[v as usize]);
            if step as usize == 2 * star.len() {
                self.stack.pop();
                let parent = self.parents[(own - FIRST) as usize];
                if parent >= FIRST {
                    let low = self.lows[(own - FIRST) as usize];
                    let above = &mut self.lows[(parent - FIRST) as usize];
                    *above = low.min(*above);
                }
                continue;
            }
            if let Some(top) = self.stack.last_mut() {
                top.1 += 1;
            }
            let corners = self.connectivity.triangles()[star[step as usize / 2] as usize];
            let mut others = corners.into_iter().filter(|&w| w != v);
            let Some(w) = others.nth(step as usize % 2) else { continue };
            if self.roles[w as usize] != Role::Ordinary || self.levels[w as usize] != self.levels[v as usize] {
                continue;
            }
            match self.numbers[w as usize] {
                NONE => self.discover(w, own),
                number => {
                    let other = self.own(number);
                    let low = &mut self.lows[(own - FIRST) as usize];
                    *low = other.min(*low);
                }
            }
        }
    }

    fn is_ordered_by_id(&self) -> bool {
        self.vertices.iter().all(|&v| {
            let around = self.around[v as usize];
            around & (LOWER | LEVEL_BEFORE) != 0 && around & (HIGHER | LEVEL_AFTER) != 0
        })
    }

    /// The st-numbering: every vertex is put just before or just behind the one it was found from, whichever keeps it between
    /// that one and the least one it can reach.
    fn number(&self, order: &mut Vec<u32>) {
        let size = self.vertices.len() + FIRST as usize;
        let (mut next, mut previous) = (vec![NONE; size], vec![NONE; size]);
        (next[BOTTOM as usize], previous[TOP as usize]) = (TOP, BOTTOM);
        let mut reached_from_below = vec![false; size];
        reached_from_below[BOTTOM as usize] = true;
        for i in 0..self.vertices.len() {
            let (v, parent) = (i as u32 + FIRST, self.parents[i]);
            let before = reached_from_below[self.lows[i] as usize] || parent == TOP;
            let (left, right) =
                if before { (previous[parent as usize], parent) } else { (parent, next[parent as usize]) };
            (previous[v as usize], next[v as usize]) = (left, right);
            next[left as usize] = v;
            previous[right as usize] = v;
            reached_from_below[parent as usize] = !before;
        }
        let mut at = next[BOTTOM as usize];
        while at != TOP {
            order.push(self.vertices[(at - FIRST) as usize]);
            at = next[at as usize];
        }
    }
}
