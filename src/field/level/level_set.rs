//! Level sets of the piecewise linear field as polylines.

use core::ops::Range;

use crate::error::{FieldError, OptionError, OutOfMemory, Result};
use crate::field::arrays::{copied, filled};
use crate::field::scalar_field::{OnMesh, Part, ScalarField};
use crate::field::sorting::sort;
use crate::mesh::TriMesh;
use crate::support::memory;
use crate::support::pieces::{pieces, ranges};
use crate::support::watch::{Phase, Watch};

/// More levels than anyone can tell apart; the bound keeps a slip from filling the memory.
pub(super) const MOST_LEVELS: usize = 10_000;

/// Level sets as polylines: line k has the points `offsets[k]..offsets[k + 1]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LevelSets {
    /// x, y, z of every point.
    pub points: Vec<f64>,
    /// Where each line starts among the points, and the number of points at the end.
    pub offsets: Vec<u32>,
    /// The level of every line.
    pub levels: Vec<f64>,
    /// Whether a line closes; its first point is not repeated.
    pub closed: Vec<bool>,
    /// For every point the two ends of its edge, smaller id first; of an edge that the level cuts, where the point is a vertex.
    pub edges: Vec<[u32; 2]>,
    /// For every point its place along that edge: 0 at the first end, 1 at the second.
    pub parameters: Vec<f64>,
}

impl OnMesh for LevelSets {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        part.vertices(self.edges.as_flattened_mut());
        Ok(())
    }
}

/// `count` levels that cut the range of the values into equal parts, without its ends; none for a constant field. They are
/// different ones, in ascending order: where the range holds fewer doubles between its ends, there are fewer levels.
///
/// # Errors
/// `InvalidOption` where `count` is above 10,000.
pub fn evenly_spaced_levels(field: &ScalarField<'_>, count: usize) -> Result<Vec<f64>> {
    if count > MOST_LEVELS {
        let expected = format!("at most {MOST_LEVELS} levels");
        return Err(OptionError::InvalidOption { option: "count".to_owned(), expected }.into());
    }
    let range = field.range();
    if range.length() <= 0.0 {
        return Ok(Vec::new());
    }
    let level = |k: usize| range.min + range.length() * (k as f64 / (count + 1) as f64);
    let mut levels: Vec<f64> = (1..=count).map(level).filter(|&level| range.min < level && level < range.max).collect();
    levels.dedup();
    Ok(levels)
}

/// Traces the level sets {f = level} of the piecewise linear field.
///
/// # Definition
/// A vertex is above a level where its value is at least the level; a point of the level set lies on every edge with one
/// end above and one below. The lines are those of a level smaller by an infinitesimal, so a level through vertices or
/// along a plateau needs no special case. Lines run from triangle to triangle across edges with two triangles; they end at
/// the boundary and at edges with more than two triangles.
///
/// The lines so part what is below the level from what is at it or above. A plateau at the level is outlined where lower ground
/// is beside it. Around a single vertex at the level, a maximum, the line shrinks to a point and is left out; at a minimum, and
/// along a plateau without lower ground beside it, there is nothing below that a line could part from it.
///
/// # Properties
/// Lines come by level in the order given, open ones first. Neighbouring points of a line are different, the last and the first of
/// a closed one included: those that have the same coordinates, because edges meet in a vertex at the level or because rounding
/// makes them so, are one point, of the edge that comes first. A line has at least two points; a closed one of two runs to and
/// fro along a plateau of a single edge. O(triangles + levels + points).
///
/// # Units
/// Points in the units of the positions, levels in those of the values.
///
/// # Errors
/// `NonFiniteLevel`; `InvalidOption` for more than 10,000 levels;
/// `OutOfMemory` where the levels have more points than fit, as many levels of noise do.
pub fn level_sets(field: &ScalarField<'_>, levels: &[f64], watch: &Watch<'_>) -> Result<LevelSets> {
    let (mesh, values) = (field.mesh(), field.values());
    check_levels(levels)?;
    let mut plan = watch.plan(&[(Phase::Field, 1.0), (Phase::Field, 2.0), (Phase::Field, 4.0)]);
    plan.begin(LOCATE * mesh.edge_count() as u64)?;
    let (sorted, order) = sort(levels)?;
    let extent = Extent::count(mesh, values, &sorted, watch)?;
    let visited = filled(false, mesh.triangle_count())?;
    let sets = extent.empty_sets()?;
    plan.begin(2 * LOCATE * mesh.triangle_count() as u64)?;
    let crossings = Crossings::new(mesh, values, &sorted, &order, extent.room(extent.crossings)?, watch)?;
    plan.begin(TRACE * extent.crossings)?;
    let mut walk = Walk { mesh, values, visited, sets, watch };
    for (place, &level) in levels.iter().enumerate() {
        walk.trace(level, crossings.triangles(place))?;
    }
    plan.finish()?;
    Ok(field.on_whole(walk.sets)?)
}

/// The work of finding the levels that cut a simplex, and with one triangle on a line.
const LOCATE: u64 = 20;
const TRACE: u64 = 80;

pub(super) fn check_levels(levels: &[f64]) -> Result<()> {
    if let Some(index) = levels.iter().position(|level| !level.is_finite()) {
        return Err(FieldError::NonFiniteLevel { index }.into());
    }
    if levels.len() > MOST_LEVELS {
        let expected = format!("at most {MOST_LEVELS} levels");
        return Err(OptionError::InvalidOption { option: "levels".to_owned(), expected }.into());
    }
    Ok(())
}

/// Room for so many items, in a result of so many bytes.
pub(super) fn room<T>(length: u64, bytes: u64) -> Result<Vec<T>, FieldError> {
    let mut room = Vec::new();
    let reserved = usize::try_from(length).is_ok_and(|length| room.try_reserve_exact(length).is_ok());
    if reserved { Ok(room) } else { Err(FieldError::OutOfMemory { bytes }) }
}

/// How much the levels cut, known before anything is allocated for it: many levels of a noisy field can have more points than
/// there is memory.
struct Extent {
    points: u64,
    /// At most so many.
    lines: u64,
    /// Pairs of a triangle and a level that cuts it.
    crossings: u64,
}

impl Extent {
    fn count(mesh: &TriMesh, values: &[f64], sorted: &[f64], watch: &Watch<'_>) -> Result<Self, FieldError> {
        let connectivity = mesh.connectivity();
        let (mut points, mut ends, mut sides) = (0, 0, 0);
        for range in ranges(connectivity.edges().len(), LOCATE, watch) {
            for edge in range? {
                let ends_of_edge = connectivity.edges()[edge];
                let levels = cut(sorted, &ends_of_edge.map(|v| values[v as usize])).len() as u64;
                let triangles = connectivity.triangles_of_edge(edge as u32).len() as u64;
                sides += levels * triangles;
                // Between two triangles a line goes on; otherwise one ends in each.
                let ending = if triangles == 2 { 0 } else { levels * triangles };
                ends += ending;
                points += if triangles == 2 { levels } else { ending };
            }
        }
        let crossings = sides / 2;
        // A closed line passes three triangles at least.
        Ok(Self { points, lines: ends / 2 + crossings / 3, crossings })
    }

    fn empty_sets(&self) -> Result<LevelSets, FieldError> {
        // Offsets are u32.
        if self.points > u64::from(u32::MAX) {
            return Err(FieldError::OutOfMemory { bytes: self.bytes() });
        }
        memory::ensure(self.bytes())?;
        let mut sets = LevelSets {
            points: self.room(3 * self.points)?,
            offsets: self.room(self.lines + 1)?,
            levels: self.room(self.lines)?,
            closed: self.room(self.lines)?,
            edges: self.room(self.points)?,
            parameters: self.room(self.points)?,
        };
        sets.offsets.push(0);
        Ok(sets)
    }

    fn room<T>(&self, length: u64) -> Result<Vec<T>, FieldError> {
        room(length, self.bytes())
    }

    fn bytes(&self) -> u64 {
        // Three coordinates, two ends and a parameter; an offset, a level and a flag; a triangle.
        40 * self.points + 13 * self.lines + 4 + 4 * self.crossings
    }
}

/// The ranks of the sorted levels that cut a simplex with the given values: min < level ≤ max, so that one corner is below and
/// one is not.
#[inline(never)]
fn cut(sorted: &[f64], values: &[f64]) -> Range<usize> {
    let min = values.iter().copied().fold(f64::INFINITY, f64::min);
    let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    sorted.partition_point(|&level| level <= min)..sorted.partition_point(|&level| level <= max)
}

/// The triangles that each level cuts, in compressed rows.
struct Crossings {
    offsets: Vec<usize>,
    triangles: Vec<u32>,
}

impl Crossings {
    /// Every triangle finds its levels by bisection, so that many levels cost no more than their points. `order` is the place of
    /// each sorted level, `triangles` is room for all.
    fn new(
        mesh: &TriMesh,
        values: &[f64],
        sorted: &[f64],
        order: &[usize],
        mut triangles: Vec<u32>,
        watch: &Watch<'_>,
    ) -> Result<Self, FieldError> {
        let cut = |corners: &[u32; 3]| cut(sorted, &corners.map(|v| values[v as usize]));
        let mut offsets = filled(0_usize, sorted.len() + 1)?;
        for piece in pieces(mesh.connectivity().triangles(), LOCATE, watch) {
            for rank in piece?.iter().flat_map(cut) {
                offsets[order[rank] + 1] += 1;
            }
        }
        for place in 0..sorted.len() {
            offsets[place + 1] += offsets[place];
        }
        let mut next = copied(&offsets)?;
        triangles.resize(offsets[sorted.len()], 0);
        for range in ranges(mesh.triangle_count(), LOCATE, watch) {
            for t in range? {
                for rank in cut(&mesh.connectivity().triangles()[t]) {
                    triangles[next[order[rank]]] = t as u32;
                    next[order[rank]] += 1;
                }
            }
        }
        Ok(Self { offsets, triangles })
    }

    fn triangles(&self, place: usize) -> &[u32] {
        &self.triangles[self.offsets[place]..self.offsets[place + 1]]
    }
}

struct Walk<'a, 'w> {
    mesh: &'a TriMesh,
    values: &'a [f64],
    /// Triangles of the current level that a line has passed.
    visited: Vec<bool>,
    sets: LevelSets,
    watch: &'a Watch<'w>,
}

impl Walk<'_, '_> {
    fn trace(&mut self, level: f64, triangles: &[u32]) -> Result<(), FieldError> {
        let connectivity = self.mesh.connectivity();
        for &t in triangles {
            self.visited[t as usize] = false;
        }
        for piece in pieces(triangles, TRACE / 4, self.watch) {
            for &t in piece? {
                for edge in connectivity.triangle_edges()[t as usize] {
                    let ends_here = self.is_cut(edge, level) && connectivity.across(t, edge).is_none();
                    if ends_here && !self.visited[t as usize] {
                        self.line(level, t, edge, false)?;
                    }
                }
            }
        }
        for piece in pieces(triangles, TRACE / 4, self.watch) {
            for &t in piece? {
                if !self.visited[t as usize] {
                    let cut =
                        connectivity.triangle_edges()[t as usize].into_iter().find(|&edge| self.is_cut(edge, level));
                    if let Some(edge) = cut {
                        self.line(level, t, edge, true)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Follows one line that enters triangle `t` through `edge`.
    fn line(&mut self, level: f64, mut t: u32, mut edge: u32, closed: bool) -> Result<(), FieldError> {
        let connectivity = self.mesh.connectivity();
        let start = self.sets.parameters.len();
        self.point(level, edge, start);
        loop {
            self.visited[t as usize] = true;
            self.watch.tick(TRACE / 2)?;
            let exit = connectivity.triangle_edges()[t as usize]
                .into_iter()
                .find(|&other| other != edge && self.is_cut(other, level));
            let Some(exit) = exit else { break };
            let next = connectivity.across(t, exit);
            // A closed line has come round where the next triangle is its first one again.
            if next.is_some_and(|next| self.visited[next as usize]) {
                break;
            }
            self.point(level, exit, start);
            let Some(next) = next else { break };
            (t, edge) = (next, exit);
        }
        while closed
            && self.sets.parameters.len() > start + 1
            && self.place(start) == self.place(self.sets.parameters.len() - 1)
        {
            self.cut_back(self.sets.parameters.len() - 1);
        }
        if self.sets.parameters.len() < start + 2 {
            // The line has shrunk to a point.
            self.cut_back(start);
            return Ok(());
        }
        self.sets.offsets.push(self.sets.parameters.len() as u32);
        self.sets.levels.push(level);
        self.sets.closed.push(closed);
        Ok(())
    }

    /// The coordinates of a point.
    fn place(&self, point: usize) -> &[f64] {
        &self.sets.points[3 * point..3 * point + 3]
    }

    /// Takes away the points from one on.
    fn cut_back(&mut self, point: usize) {
        self.sets.points.truncate(3 * point);
        self.sets.edges.truncate(point);
        self.sets.parameters.truncate(point);
    }

    fn is_cut(&self, edge: u32, level: f64) -> bool {
        let [a, b] = self.mesh.connectivity().edges()[edge as usize];
        (self.values[a as usize] >= level) != (self.values[b as usize] >= level)
    }

    /// Adds the point on an edge to the line that begins at `start`, unless the line is there already.
    fn point(&mut self, level: f64, edge: u32, start: usize) {
        let [a, b] = self.mesh.connectivity().edges()[edge as usize];
        let (f, g) = (self.values[a as usize], self.values[b as usize]);
        let parameter = ((level - f) / (g - f)).clamp(0.0, 1.0);
        let (p, q) = (self.mesh.position(a), self.mesh.position(b));
        // The second end itself: the sum may differ from it by rounding.
        let place = if parameter < 1.0 { [0, 1, 2].map(|i| p[i] + parameter * (q[i] - p[i])) } else { q };
        let count = self.sets.parameters.len();
        if count > start && *self.place(count - 1) == place {
            return;
        }
        self.sets.points.extend(place);
        self.sets.edges.push([a, b]);
        self.sets.parameters.push(parameter);
    }
}
