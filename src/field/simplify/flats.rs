//! Orders the vertices of flat regions so that every one has a lower and a higher neighbour.

use core::cmp::Ordering;

use crate::error::FieldError;
use crate::field::arrays::{filled, push, with_room};
use crate::mesh::{Connectivity, LinkKind};
use crate::support::pieces::{pieces, ranges};
use crate::support::watch::Watch;

/// What becomes of a vertex, from bottom to top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
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
const EQUAL: u8 = 4;
/// At the same height, with a greater or a smaller id.
const EQUAL_AFTER: u8 = 8;
const EQUAL_BEFORE: u8 = 16;

/// Numbers of the two imaginary vertices that stand for all that is lower and all that is higher.
const BOTTOM: u32 = 0;
const TOP: u32 = 1;
const FIRST: u32 = 2;
const NONE: u32 = u32::MAX;

/// The work with one edge, and with one vertex.
const EDGE: u64 = 8;
const VERTEX: u64 = 15;

/// What every vertex has for neighbours, on a surface of heights.
#[derive(Debug)]
pub(super) struct Surroundings {
    bits: Vec<u8>,
    /// The neighbours at the same height, in compressed rows.
    offsets: Vec<u32>,
    beside: Vec<u32>,
}

impl Surroundings {
    /// Two passes over the edges.
    #[inline(never)]
    pub(super) fn new(
        connectivity: &Connectivity,
        heights: &[f64],
        targets: &[Target],
        watch: &Watch<'_>,
    ) -> Result<Self, FieldError> {
        let mut bits = filled(0_u8, heights.len())?;
        let mut offsets = filled(0_u32, heights.len() + 1)?;
        for piece in pieces(connectivity.edges(), EDGE, watch) {
            for &[a, b] in piece? {
                let (a, b) = (a as usize, b as usize);
                let (of_a, of_b) = if heights[a] < heights[b] {
                    (HIGHER, LOWER)
                } else if heights[a] > heights[b] {
                    (LOWER, HIGHER)
                } else {
                    offsets[a] += 1;
                    offsets[b] += 1;
                    match (targets[a] as u8).cmp(&(targets[b] as u8)) {
                        Ordering::Less => (HIGHER, LOWER),
                        Ordering::Greater => (LOWER, HIGHER),
                        // The ends of an edge ascend.
                        Ordering::Equal => (EQUAL | EQUAL_AFTER, EQUAL | EQUAL_BEFORE),
                    }
                };
                bits[a] |= of_a;
                bits[b] |= of_b;
            }
        }
        let mut total = 0;
        for offset in &mut offsets {
            total += *offset;
            *offset = total;
        }
        // Filled from the ends, so that these become starts.
        let mut beside = filled(0, total as usize)?;
        for piece in pieces(connectivity.edges(), EDGE, watch) {
            for &[a, b] in piece? {
                if heights[a as usize] == heights[b as usize] {
                    for (this, that) in [(a, b), (b, a)] {
                        let place = &mut offsets[this as usize];
                        *place -= 1;
                        beside[*place as usize] = that;
                    }
                }
            }
        }
        Ok(Self { bits, offsets, beside })
    }

    /// The neighbours at the same height.
    #[inline]
    pub(super) fn beside(&self, v: u32) -> &[u32] {
        &self.beside[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize]
    }

    #[inline]
    fn has(&self, v: u32, bits: u8) -> bool {
        self.bits[v as usize] & bits != 0
    }
}

/// All vertices but isolated ones, so that at each height the minima come first and the maxima last, and every ordinary vertex
/// of a flat region has a neighbour before and one behind it, as far as the mesh has room for that.
///
/// # Definition
/// A flat region, its minima and maxima taken out, gets a bottom (all its lower neighbours and wanted minima) and a top.
/// An st-numbering of that graph is wanted: every vertex but the bottom and the top has a neighbour with a smaller and one
/// with a greater number. There is one where no single vertex cuts off others from both \[Tarjan86\], hence on every surface:
/// around a vertex of a surface, the others hang together. A region where ids are such a numbering is left to them. Linear
/// time.
#[inline(never)]
pub(super) fn ordered(
    connectivity: &Connectivity,
    around: &Surroundings,
    targets: &[Target],
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    let mut order: Vec<u32> = with_room(targets.len())?;
    let kinds = connectivity.link_kinds();
    let mut region = Region {
        targets,
        around,
        numbers: filled(NONE, targets.len())?,
        counted: FIRST,
        vertices: Vec::new(),
        parents: Vec::new(),
        lows: Vec::new(),
        stack: Vec::new(),
        next: Vec::new(),
        previous: Vec::new(),
        is_reached_from_below: Vec::new(),
    };
    let all = 0..targets.len() as u32;
    order.extend(all.clone().filter(|&v| targets[v as usize] == Target::Minimum));
    // From the top downwards; a region that nothing is above comes last and keeps a maximum.
    for wanted in [HIGHER, HIGHER | EQUAL] {
        for range in ranges(targets.len(), VERTEX, watch) {
            for v in range? {
                let v = v as u32;
                let index = v as usize;
                if targets[index] != Target::Ordinary
                    || kinds[index] == LinkKind::Isolated
                    || region.numbers[index] != NONE
                {
                    continue;
                }
                if !around.has(v, EQUAL) {
                    region.numbers[index] = TOP;
                    order.push(v);
                } else if around.has(v, wanted) {
                    region.search(v, watch)?;
                    if region.is_ordered_by_id() {
                        region.vertices.sort_unstable();
                        order.extend_from_slice(&region.vertices);
                    } else {
                        region.number(&mut order)?;
                    }
                }
            }
        }
    }
    order.extend(all.filter(|&v| targets[v as usize] == Target::Maximum));
    Ok(order)
}

/// One flat region after the other, searched depth first from a vertex next to the top.
struct Region<'a> {
    targets: &'a [Target],
    around: &'a Surroundings,
    /// In the order of discovery, going on from region to region.
    numbers: Vec<u32>,
    counted: u32,
    /// The vertices of the current region, in that order; the numbers of those they were found from, and the least numbers
    /// that they and their descendants are next to. Numbers of this region begin at `counted − vertices.len()`.
    vertices: Vec<u32>,
    parents: Vec<u32>,
    lows: Vec<u32>,
    /// Vertex and the place among its neighbours at the same height to go on from.
    stack: Vec<(u32, u32)>,
    /// The numbering, a linked list.
    next: Vec<u32>,
    previous: Vec<u32>,
    is_reached_from_below: Vec<bool>,
}

impl Region<'_> {
    /// The number of a vertex of this region counted from [`FIRST`], as if it were the only one.
    fn own(&self, number: u32) -> u32 {
        number - (self.counted - self.vertices.len() as u32) + FIRST
    }

    fn discover(&mut self, v: u32, parent: u32) -> Result<(), FieldError> {
        self.numbers[v as usize] = self.counted;
        self.counted += 1;
        push(&mut self.vertices, v)?;
        push(&mut self.parents, parent)?;
        let own = self.vertices.len() as u32 - 1 + FIRST;
        let low = if self.around.has(v, LOWER) {
            BOTTOM
        } else if self.around.has(v, HIGHER) {
            TOP
        } else {
            own
        };
        push(&mut self.lows, low)?;
        push(&mut self.stack, (v, 0))?;
        Ok(())
    }

    fn search(&mut self, root: u32, watch: &Watch<'_>) -> Result<(), FieldError> {
        self.vertices.clear();
        self.parents.clear();
        self.lows.clear();
        self.discover(root, TOP)?;
        while let Some(top) = self.stack.last_mut() {
            let (v, step) = *top;
            top.1 += 1;
            let own = self.own(self.numbers[v as usize]);
            let low = (own - FIRST) as usize;
            let Some(&w) = self.around.beside(v).get(step as usize) else {
                watch.tick(EDGE * u64::from(step) + VERTEX)?;
                self.stack.pop();
                let parent = self.parents[low];
                if parent >= FIRST {
                    let of_parent = (parent - FIRST) as usize;
                    self.lows[of_parent] = self.lows[of_parent].min(self.lows[low]);
                }
                continue;
            };
            if self.targets[w as usize] != Target::Ordinary {
                continue;
            }
            match self.numbers[w as usize] {
                NONE => self.discover(w, own)?,
                number => self.lows[low] = self.lows[low].min(self.own(number)),
            }
        }
        Ok(())
    }

    fn is_ordered_by_id(&self) -> bool {
        let has = |v, bits| self.around.has(v, bits);
        self.vertices.iter().all(|&v| has(v, LOWER | EQUAL_BEFORE) && has(v, HIGHER | EQUAL_AFTER))
    }

    /// The st-numbering: every vertex is put just before or just behind the one it was found from, whichever keeps it between
    /// that one and the least one it can reach.
    fn number(&mut self, order: &mut Vec<u32>) -> Result<(), FieldError> {
        let size = self.vertices.len() + FIRST as usize;
        let Self { next, previous, is_reached_from_below, .. } = self;
        if next.len() < size {
            (*next, *previous) = (filled(NONE, size)?, filled(NONE, size)?);
        }
        (next[BOTTOM as usize], previous[TOP as usize]) = (TOP, BOTTOM);
        if is_reached_from_below.capacity() < size {
            *is_reached_from_below = with_room(size)?;
        }
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
        Ok(())
    }
}
