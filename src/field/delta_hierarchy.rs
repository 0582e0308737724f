//! At which δ every critical vertex stops being one, and so C_δ for all δ at once \[Patane09, section 3\].

use super::arrays::{filled, with_room};
use super::critical::{CriticalCounts, CriticalKind, CriticalPoint, LinkReading, Measured, measured};
use super::link::{FEW, LinkScratch};
use super::scalar_field::{OnMesh, Part, ScalarField};
use crate::error::{FieldError, OutOfMemory, Result};
use crate::mesh::{Connectivity, LinkKind};
use crate::support::pieces::pieces;
use crate::support::watch::{Phase, Watch};

/// A critical vertex and the δ at which it stops being one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HierarchyPoint {
    /// Its id.
    pub vertex: u32,
    /// Its kind.
    pub kind: CriticalKind,
    /// The least relative δ at which it is not critical: 0 where only its id tells it from an equal neighbour.
    pub vanishes_at: f64,
    /// The same in the units of the values.
    pub vanishes_at_absolute: f64,
}

/// Numbers of critical points as steps over the relative δ: row 0 is δ = 0, row k holds from `delta[k]` up to, not including,
/// `delta[k + 1]`, the last one for ever.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DeltaCurve {
    /// Where each row begins, ascending. What is critical by its id alone is so at 0 only, and row 1 then begins at the least
    /// positive number.
    pub delta: Vec<f64>,
    /// Number of minima.
    pub minima: Vec<u32>,
    /// Number of maxima.
    pub maxima: Vec<u32>,
    /// Number of saddles, with multiplicity.
    pub saddles: Vec<u32>,
}

/// The critical points of a field for all δ.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DeltaHierarchy {
    /// All that are critical at δ = 0, by ascending vertex.
    pub points: Vec<HierarchyPoint>,
    /// Their numbers at every δ.
    pub curve: DeltaCurve,
    /// Σ (1 − χ(lower link)) over all vertices at δ = 0: see [`CriticalCounts::index_sum`].
    pub index_sum: i64,
}

impl DeltaHierarchy {
    /// The counts that [`critical_points`](super::critical_points) has at a relative δ ≥ 0.
    #[must_use]
    pub fn counts_at(&self, delta: f64) -> CriticalCounts {
        let curve = &self.curve;
        let row = curve.delta.partition_point(|&start| start <= delta).saturating_sub(1);
        let at = |counts: &[u32]| counts.get(row).copied().unwrap_or_default();
        CriticalCounts {
            minima: at(&curve.minima),
            maxima: at(&curve.maxima),
            saddles: at(&curve.saddles),
            index_sum: (delta == 0.0).then_some(self.index_sum),
        }
    }

    /// The points of C_δ for a relative δ ≥ 0.
    pub fn points_at(&self, delta: f64) -> impl Iterator<Item = &HierarchyPoint> {
        self.points.iter().filter(move |point| delta == 0.0 || point.vanishes_at > delta)
    }
}

impl OnMesh for DeltaHierarchy {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        self.points.iter_mut().for_each(|point| part.vertex(&mut point.vertex));
        Ok(())
    }
}

/// For every critical vertex the δ at which it stops being one, by the strict rule for extrema.
///
/// # Definition
/// A vertex is in C_δ where [`critical_points`](super::critical_points) has it at δ. The sets are nested, C_δ ⊆ C_δ′ for δ ≥ δ′, so
/// one number for each vertex tells them all: it is critical at δ = 0, and for δ > 0 exactly while δ is below that number. An
/// extremum vanishes at the least |f_j − f_i| of its link. A saddle of multiplicity k loses one of its k parts after the other.
///
/// # Properties
/// Agrees with `critical_points` to the last bit: the relative δ are the least doubles t for which t · D, rounded, is not below
/// the absolute ones, where D is [`largest_edge_difference`](super::largest_edge_difference). One pass over the triangles, and a sort.
///
/// # Errors
/// `Cancelled`, `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
/// let height = field::ScalarField::new(&torus, &height)?;
/// let hierarchy = field::delta_hierarchy(&height, field::LinkReading::Consecutive, &Watch::none())?;
/// assert_eq!(hierarchy.counts_at(0.0).saddles, 2);
/// assert_eq!(hierarchy.points_at(0.9).count(), 0);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn delta_hierarchy(field: &ScalarField<'_>, link: LinkReading, watch: &Watch<'_>) -> Result<DeltaHierarchy> {
    let (connectivity, values, order) = (field.mesh().connectivity(), field.values(), field.order());
    let mut plan = watch.plan(&[(Phase::Field, 2.0), (Phase::Field, 3.0)]);
    plan.begin(16 * connectivity.triangles().len() as u64 + 10 * values.len() as u64)?;
    let Measured { found, nearest, largest } = measured(connectivity, order, watch)?;
    plan.begin(200 * found.points.len() as u64)?;
    let kinds = connectivity.link_kinds();
    let mut thresholds = Thresholds { connectivity, values, link, scratch: None, parts: Vec::new(), upper: Vec::new() };
    let mut points = with_room(found.points.len())?;
    let counts = found.counts;
    let mut keys = with_room((counts.minima + counts.maxima + counts.saddles) as usize)?;
    for piece in pieces(&found.points, 100, watch) {
        for &CriticalPoint { vertex, kind, multiplicity, .. } in piece? {
            let is_simple =
                multiplicity == 1 && kinds[vertex as usize] == LinkKind::Cycle && link == LinkReading::Consecutive;
            let (vanishes_at_absolute, vanishes_at);
            if kind != CriticalKind::Saddle || is_simple {
                // A strict extremum lasts until δ reaches the nearest of its link vertices. A simple saddle has four link edges with
                // its ends on opposite sides, and needs them all.
                vanishes_at_absolute = f64::from_bits(nearest[vertex as usize] & !SIGN);
                vanishes_at = relative(vanishes_at_absolute, largest);
                keys.push(key(vanishes_at, kind));
            } else {
                thresholds.find(vertex)?;
                // Parts without a positive δ are told from equal neighbours by ids alone.
                let absolute = |part: usize| thresholds.parts.get(part).map_or(0.0, |&bits| f64::from_bits(bits));
                vanishes_at_absolute = absolute(0);
                vanishes_at = relative(vanishes_at_absolute, largest);
                for part in 0..multiplicity as usize {
                    keys.push(key(relative(absolute(part), largest), kind));
                }
            }
            points.push(HierarchyPoint { vertex, kind, vanishes_at, vanishes_at_absolute });
        }
    }
    drop(nearest);
    watch.tick(60 * keys.len() as u64)?;
    let sorted = sorted(&keys)?;
    drop(keys);
    watch.tick(40 * sorted.len() as u64)?;
    let curve = curve(&sorted, &counts)?;
    plan.finish()?;
    Ok(field.on_whole(DeltaHierarchy { points, curve, index_sum: counts.index_sum.unwrap_or_default() })?)
}

/// The bit of a number that has its sign.
const SIGN: u64 = 1 << 63;

/// Finds the absolute δ at which the parts of saddles vanish.
struct Thresholds<'a> {
    connectivity: &'a Connectivity,
    values: &'a [f64],
    link: LinkReading,
    /// Made for the first vertex that needs it: many fields have none.
    scratch: Option<LinkScratch>,
    /// The result, as the bits of positive numbers: for every part of a saddle its δ, descending.
    parts: Vec<u64>,
    upper: Vec<u64>,
}

impl Thresholds<'_> {
    /// Finds the δ of the parts of one saddle.
    fn find(&mut self, vertex: u32) -> Result<(), OutOfMemory> {
        let is_cycle = self.connectivity.link_kinds()[vertex as usize] == LinkKind::Cycle;
        self.parts.clear();
        if !is_cycle || self.link == LinkReading::Skip {
            self.components(vertex, is_cycle)
        } else {
            self.changes(vertex);
            Ok(())
        }
    }

    /// A link edge with its ends on opposite sides counts until δ reaches the nearer one; a saddle of multiplicity k needs
    /// 2k + 2 of them.
    fn changes(&mut self, saddle: u32) {
        let value = self.values[saddle as usize];
        for [a, b] in self.connectivity.link(saddle) {
            let (x, y) = (self.values[a as usize] - value, self.values[b as usize] - value);
            // Where one is equal, what is counted or not is zero.
            if (x < 0.0) != (y < 0.0) {
                self.parts.push(x.abs().min(y.abs()).to_bits());
            }
        }
        // The bits of numbers that are not negative are ordered as the numbers are.
        self.parts.sort_unstable();
        self.parts.reverse();
        let mut parts = 0;
        for place in (3..self.parts.len()).step_by(2) {
            self.parts[parts] = self.parts[place];
            parts += 1;
        }
        self.parts.truncate(parts);
    }

    /// Part j of a saddle lasts while the lower or the upper link has more than j components, and both have one.
    fn components(&mut self, vertex: u32, is_cycle: bool) -> Result<(), OutOfMemory> {
        let (connectivity, values) = (self.connectivity, self.values);
        let scratch = match &mut self.scratch {
            Some(scratch) => scratch,
            none => none.insert(LinkScratch::new(connectivity.vertex_count())?),
        };
        scratch.measure(connectivity, vertex, |j| values[j as usize] - values[vertex as usize])?;
        scratch.component_ends(&mut self.parts)?;
        if !is_cycle {
            scratch.turn_over();
            scratch.component_ends(&mut self.upper)?;
            let deepest = |ends: &[u64]| ends.first().copied().unwrap_or_default();
            let both = deepest(&self.parts).min(deepest(&self.upper));
            self.parts.resize(self.parts.len().max(self.upper.len()), 0);
            for (end, &upper) in self.parts.iter_mut().zip(&self.upper) {
                *end = (*end).max(upper);
            }
            for end in &mut self.parts {
                *end = (*end).min(both);
            }
        }
        // Around a cycle components below and above alternate: two below have two above between them.
        if !self.parts.is_empty() {
            self.parts.remove(0);
        }
        Ok(())
    }
}

/// The least t for which t · `largest`, rounded as [`critical_points`](super::critical_points) does, is not below `threshold`.
#[inline(never)]
fn relative(threshold: f64, largest: f64) -> f64 {
    if threshold <= 0.0 {
        return 0.0;
    }
    let reaches = |bits: u64| f64::from_bits(bits) * largest >= threshold;
    // The threshold is the difference of an edge, so 1 is enough. The quotient is a few units of rounding away at most, …
    let first = (threshold / largest).to_bits().saturating_sub(3);
    let steps: u64 = (0..5).map(|step| u64::from(!reaches(first + step))).sum();
    if steps > 0 && reaches(first + steps) {
        return f64::from_bits(first + steps);
    }
    // … unless numbers are so small that they have few digits.
    let (mut below, mut enough) = (0, 1.0_f64.to_bits());
    while enough - below > 1 {
        let middle = below + (enough - below) / 2;
        if reaches(middle) {
            enough = middle;
        } else {
            below = middle;
        }
    }
    f64::from_bits(enough)
}

/// A relative δ and below it the kind, in one integer that sorts by δ: a number in [0, 1] leaves the two highest bits free. What
/// vanishes at 0 is there at 0 still, and gone at the next number.
fn key(relative: f64, kind: CriticalKind) -> u64 {
    relative.to_bits().max(1) << 2 | kind as u64
}

/// Sorts keys: into buckets of equal width over [0, 1] first, which for most fields hold few each.
// By itself, as `curve` is: engines optimise a function when it is called again, not within one call.
#[inline(never)]
fn sorted(keys: &[u64]) -> Result<Vec<u64>, FieldError> {
    let buckets = (keys.len() / 2).max(1);
    let bucket = |key: u64| ((f64::from_bits(key >> 2) * buckets as f64) as usize).min(buckets - 1);
    let mut ends = filled(0_u32, buckets + 1)?;
    for &key in keys {
        ends[bucket(key) + 1] += 1;
    }
    for i in 0..buckets {
        ends[i + 1] += ends[i];
    }
    let mut sorted = filled(0, keys.len())?;
    for &key in keys {
        // Starts turn into ends.
        let place = &mut ends[bucket(key)];
        sorted[*place as usize] = key;
        *place += 1;
    }
    let mut start = 0;
    for &end in &ends[..buckets] {
        let end = end as usize;
        if end - start > FEW {
            sorted[start..end].sort_unstable();
        }
        start = end;
    }
    // Nothing is far from its place now.
    for i in 1..sorted.len() {
        let key = sorted[i];
        let mut place = i;
        while place > 0 && sorted[place - 1] > key {
            sorted[place] = sorted[place - 1];
            place -= 1;
        }
        sorted[place] = key;
    }
    Ok(sorted)
}

#[inline(never)]
fn curve(keys: &[u64], counts: &CriticalCounts) -> Result<DeltaCurve, OutOfMemory> {
    let mut left = [counts.minima, counts.saddles, counts.maxima];
    // Row 0, and one for every key that is another than the one before.
    let rows = 1 + keys.len().min(1) + keys.windows(2).filter(|pair| pair[0] >> 2 != pair[1] >> 2).count();
    let mut curve = DeltaCurve {
        delta: with_room(rows)?,
        minima: with_room(rows)?,
        maxima: with_room(rows)?,
        saddles: with_room(rows)?,
    };
    let mut delta = 0;
    for &key in keys.iter().chain(&[u64::MAX]) {
        if key >> 2 != delta {
            curve.delta.push(f64::from_bits(delta));
            curve.minima.push(left[0]);
            curve.saddles.push(left[1]);
            curve.maxima.push(left[2]);
            delta = key >> 2;
        }
        if key != u64::MAX {
            left[(key & 3) as usize] -= 1;
        }
    }
    Ok(curve)
}
