//! Minima, maxima and saddles, with and without a tolerance \[Patane09, section 3\].

use super::arrays::{filled, push};
use super::link::LinkScratch;
use super::order::VertexOrder;
use super::scalar_field::{OnMesh, Part, ScalarField};
use crate::error::{FieldError, OptionError, OutOfMemory, Result};
use crate::mesh::{Connectivity, LinkKind};
use crate::support::named::named;
use crate::support::pieces::{pieces, ranges};
use crate::support::watch::{Phase, Watch};

/// What kind of critical point a vertex is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CriticalKind {
    /// Empty lower link.
    Minimum,
    /// Several components of the lower or upper link.
    Saddle,
    /// Empty upper link.
    Maximum,
}

named! { CriticalKind { Minimum = "minimum", Saddle = "saddle", Maximum = "maximum" } }

/// One critical vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CriticalPoint {
    /// Its id.
    pub vertex: u32,
    /// Its kind.
    pub kind: CriticalKind,
    /// 1 for extrema and simple saddles, k where k + 1 components of the lower or upper link meet.
    pub multiplicity: u32,
    /// It lies on an edge with one triangle.
    pub on_boundary: bool,
}

/// How many critical points there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct CriticalCounts {
    /// Number of minima.
    pub minima: u32,
    /// Number of maxima.
    pub maxima: u32,
    /// Number of saddles, with multiplicity.
    pub saddles: u32,
    /// Σ (1 − χ(lower link)) over all vertices at δ = 0: equals the Euler characteristic of any triangle complex
    /// (\[Banchoff67\]). `None` where δ > 0.
    pub index_sum: Option<i64>,
}

/// The critical points of a field.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct CriticalPoints {
    /// The points by ascending vertex.
    pub points: Vec<CriticalPoint>,
    /// How many there are of each kind.
    pub counts: CriticalCounts,
}

impl OnMesh for CriticalPoints {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        self.points.iter_mut().for_each(|point| part.vertex(&mut point.vertex));
        Ok(())
    }
}

/// What δ is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DeltaScale {
    /// A fraction of the largest |f_i − f_j| over the edges (\[Patane09, section 3\]). The default.
    #[default]
    Relative,
    /// The units of the values.
    Absolute,
}

named! { DeltaScale { Relative = "relative", Absolute = "absolute" } }

/// How saddles are found where link vertices lie within δ of the vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LinkReading {
    /// As printed in the paper: with c link edges whose ends lie beyond δ on opposite sides, a saddle has c ≥ 4 and
    /// multiplicity ⌊c/2⌋ − 1. The default.
    #[default]
    Consecutive,
    /// Link vertices within δ are dropped before the changes of side are counted around the link.
    Skip,
}

named! { LinkReading { Consecutive = "consecutive", Skip = "skip" } }

/// When a vertex is an extremum at δ > 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ExtremumRule {
    /// Every link vertex lies beyond δ on the same side. The default.
    #[default]
    Strict,
    /// No link vertex lies beyond δ on one side, as the paper's text has it. Extrema then grow with δ, so that the sets
    /// are not nested; a vertex with all its link within δ counts as a minimum. For comparison only.
    Literal,
}

named! { ExtremumRule { Strict = "strict", Literal = "literal" } }

/// How [`critical_points`] classifies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DeltaOptions {
    /// The tolerance, at least 0. Default 0: every difference counts, ties are broken by vertex id.
    pub delta: f64,
    /// What [`DeltaOptions::delta`] is measured in. Default relative.
    pub scale: DeltaScale,
    /// How saddles are found at δ > 0. Default consecutive.
    pub link: LinkReading,
    /// When a vertex is an extremum at δ > 0. Default strict.
    pub rule: ExtremumRule,
}

/// Classifies the vertices of a mesh.
///
/// # Definition
/// Link vertices have the δ-sensitive sign of f_j − f_i \[Patane09, section 3\]. At δ = 0 vertices are compared by
/// (value, id). Let l and u be the numbers of components of the lower and upper link: a minimum has l = 0, a maximum
/// u = 0, a saddle neither, but max(l, u) ≥ 2, with multiplicity max(l, u) − 1. On a link that is a cycle this is the
/// paper's number of changes of sign. At δ > 0 see [`LinkReading`] and [`ExtremumRule`]; where the link is no cycle,
/// vertices within δ are dropped first for both readings. Isolated vertices are not critical.
///
/// So every vertex is of one kind, in all functions: where sheets hang together in a vertex with nothing below it, it is a
/// minimum, in however many pieces its upper link is, and never counted as a saddle. Components of superlevel sets join there all
/// the same, so [`persistence`](super::persistence) and the Morse complex name it as the place where they do: as the `saddle` of a
/// pair, of a line, and of nodes beside that of the minimum. (Maxima likewise.)
///
/// # Properties
/// One pass over the triangles. With the strict rule, sets for growing δ are nested. On a constant field every δ > 0
/// gives no critical point.
///
/// # Errors
/// `InvalidOption` where δ is negative or not finite; `Cancelled`, `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
/// let height = field::ScalarField::new(&torus, &height)?;
/// let counts = field::critical_points(&height, &field::DeltaOptions::default(), &Watch::none())?.counts;
/// assert_eq!((counts.minima, counts.maxima, counts.saddles, counts.index_sum), (1, 1, 2, Some(0)));
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn critical_points(field: &ScalarField<'_>, options: &DeltaOptions, watch: &Watch<'_>) -> Result<CriticalPoints> {
    let (connectivity, values, order) = (field.mesh().connectivity(), field.values(), field.order());
    if !(options.delta.is_finite() && options.delta >= 0.0) {
        return Err(OptionError::invalid("delta", "a finite number that is not negative").into());
    }
    if options.delta == 0.0 {
        return Ok(field.on_whole(exact(connectivity, order, watch)?)?);
    }
    watch.tick(3 * connectivity.edges().len() as u64)?;
    let delta = match options.scale {
        DeltaScale::Absolute => options.delta,
        DeltaScale::Relative => options.delta * largest_edge_difference(field),
    };
    let sign = |i: u32, j: u32| {
        let difference = values[j as usize] - values[i as usize];
        i8::from(difference > delta) - i8::from(difference < -delta)
    };
    let mut plan = watch.plan(&STEPS);
    plan.begin(TICKS[0] * connectivity.triangles().len() as u64)?;
    let states = sign_changes(connectivity, sign, watch)?;
    plan.begin(TICKS[1] * values.len() as u64)?;
    let found = classify(connectivity, options, false, &states, sign, watch)?;
    plan.finish()?;
    Ok(field.on_whole(found)?)
}

/// The shares of the pass over the triangles and of that over the vertices.
const STEPS: [(Phase, f64); 2] = [(Phase::Field, 2.0), (Phase::Field, 1.0)];
/// The work with one triangle and with one vertex.
const TICKS: [u64; 2] = [8, 10];

/// The critical points at δ = 0, where no link vertex is neutral and so all readings and rules agree.
pub(super) fn exact(
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    watch: &Watch<'_>,
) -> Result<CriticalPoints, FieldError> {
    let mut plan = watch.plan(&STEPS);
    plan.begin(TICKS[0] * connectivity.triangles().len() as u64)?;
    let states = exact_changes(connectivity, order, watch)?;
    plan.begin(TICKS[1] * connectivity.vertex_count() as u64)?;
    let found = exact_from(connectivity, order, &states, watch)?;
    plan.finish()?;
    Ok(found)
}

#[inline(never)]
fn exact_from(
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    states: &[u32],
    watch: &Watch<'_>,
) -> Result<CriticalPoints, FieldError> {
    let options = DeltaOptions::default();
    classify(connectivity, &options, true, states, |i, j| 2 * i8::from(order.is_below(i, j)) - 1, watch)
}

/// The critical points at δ = 0, and how near the values around them are.
pub(super) struct Measured {
    pub(super) found: CriticalPoints,
    /// For every vertex, as the bits of a number: for one with changes of sign around it the least, over the link edges with
    /// ends on opposite sides, of |f_j − f_i| at the nearer end; for others the least over the link, with the sign bit set.
    pub(super) nearest: Vec<u64>,
    /// [`largest_edge_difference`].
    pub(super) largest: f64,
}

/// Does what [`sign_changes`] does for δ = 0, and finds the differences. (Bits of numbers that are not negative are ordered as the numbers are.)
#[inline(never)]
pub(super) fn measured(
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    watch: &Watch<'_>,
) -> Result<Measured, FieldError> {
    let values = order.values();
    let mut states = filled(0_u32, connectivity.vertex_count())?;
    let mut nearest = filled(u64::MAX, connectivity.vertex_count())?;
    let mut largest = 0_u64;
    for piece in pieces(connectivity.triangles(), 2 * TICKS[0], watch) {
        for &[a, b, c] in piece? {
            let (f, g, h) = (values[a as usize], values[b as usize], values[c as usize]);
            let (ab, bc, ca) = (order.is_below(a, b), order.is_below(b, c), order.is_below(c, a));
            let (x, y, z) = ((g - f).abs().to_bits(), (h - g).abs().to_bits(), (f - h).abs().to_bits());
            let (xy, yz, zx) = (x.min(y), y.min(z), z.min(x));
            largest = largest.max(x.max(y).max(z));
            // Three calls: a loop would not be unrolled.
            let mut corner = |v: u32, next: bool, previous: bool, near: u64| {
                // The vertex is below the next, and the previous one is below it: a change.
                let is_change = u32::from(next == previous);
                let (below, above) = (u32::from(!next | previous), u32::from(next | !previous));
                let state = &mut states[v as usize];
                *state = (*state + is_change * ONE_CHANGE) | (below * SAW_BELOW) | (above * SAW_ABOVE);
                let near = near | u64::from(1 - is_change) << 63;
                let known = &mut nearest[v as usize];
                *known = near.min(*known);
            };
            corner(a, ab, ca, zx);
            corner(b, bc, ab, xy);
            corner(c, ca, bc, yz);
        }
    }
    let found = exact_from(connectivity, order, &states, watch)?;
    Ok(Measured { found, nearest, largest: f64::from_bits(largest) })
}

/// The largest |f_i − f_j| over the edges: what a relative δ is a fraction of.
#[must_use]
pub fn largest_edge_difference(field: &ScalarField<'_>) -> f64 {
    let values = field.values();
    let edges = field.mesh().connectivity().edges();
    edges
        .iter()
        .map(|&[a, b]| (values[a as usize] - values[b as usize]).abs())
        .fold(0.0, |largest, x| if x > largest { x } else { largest })
}

/// The states of all vertices at δ = 0, see [`sign_changes`].
#[inline(never)]
pub(super) fn exact_changes(
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    sign_changes(connectivity, |i, j| 2 * i8::from(order.is_below(i, j)) - 1, watch)
}

/// Bits of the state that [`sign_changes`] leaves at a vertex: which signs its link vertices have, and above them the number of
/// link edges with opposite signs.
const SAW_BELOW: u32 = 1;
const SAW_NEUTRAL: u32 = 2;
const SAW_ABOVE: u32 = 4;
const SAW_BOTH: u32 = SAW_BELOW | SAW_ABOVE;
const SAW_ANY: u32 = SAW_BOTH | SAW_NEUTRAL;
pub(super) const ONE_CHANGE: u32 = 8;

/// One pass over the triangles: a triangle (i, j, k) adds a change of sign to i exactly where j and k lie on opposite
/// sides of i, so no link needs to be ordered. `sign(i, j)` is antisymmetric: the side of i on which j lies.
fn sign_changes(
    connectivity: &Connectivity,
    sign: impl Fn(u32, u32) -> i8,
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    let mut states = filled(0_u32, connectivity.vertex_count())?;
    for piece in pieces(connectivity.triangles(), TICKS[0], watch) {
        for &[a, b, c] in piece? {
            let (ab, bc, ca) = (i32::from(sign(a, b)), i32::from(sign(b, c)), i32::from(sign(c, a)));
            // Three calls: a loop would not be unrolled.
            let mut corner = |v: u32, next: i32, previous: i32| {
                let state = &mut states[v as usize];
                let change = u32::from(next * previous < 0) * ONE_CHANGE;
                *state = (*state + change) | (SAW_BELOW << (next + 1)) | (SAW_BELOW << (previous + 1));
            };
            corner(a, ab, -ca);
            corner(b, bc, -ab);
            corner(c, ca, -bc);
        }
    }
    Ok(states)
}

fn classify(
    connectivity: &Connectivity,
    options: &DeltaOptions,
    exact: bool,
    states: &[u32],
    sign: impl Fn(u32, u32) -> i8,
    watch: &Watch<'_>,
) -> Result<CriticalPoints, FieldError> {
    let mut scratch = LinkScratch::new(connectivity.vertex_count())?;
    let mut found = CriticalPoints::default();
    let mut index_sum = 0_i64;
    let kinds = connectivity.link_kinds();
    for range in ranges(states.len(), TICKS[1], watch) {
        for index in range? {
            let (vertex, state, link_kind) = (index as u32, states[index], kinds[index]);
            let changes = state / ONE_CHANGE;
            let mut on_boundary = false;
            let saddle_multiplicity = match link_kind {
                LinkKind::Isolated => {
                    index_sum += 1;
                    continue;
                }
                LinkKind::Cycle if options.link == LinkReading::Consecutive || state & SAW_NEUTRAL == 0 => {
                    // Lower and upper link alternate around the cycle: as many components each as half the changes; a whole
                    // cycle below, as an empty one, has characteristic 0.
                    index_sum += 1 - i64::from(changes / 2);
                    if changes == 2 {
                        continue;
                    }
                    (changes / 2).saturating_sub(1)
                }
                _ => {
                    let link = scratch.inspect(connectivity, vertex, |j| sign(vertex, j))?;
                    on_boundary = link.on_boundary;
                    index_sum += 1 - link.lower_characteristic;
                    link.lower_components.max(link.upper_components).saturating_sub(1)
                }
            };
            let kind = match (options.rule, state & SAW_ANY) {
                (_, SAW_ABOVE) => CriticalKind::Minimum,
                (_, SAW_BELOW) => CriticalKind::Maximum,
                (ExtremumRule::Literal, signs) if signs & SAW_BELOW == 0 => CriticalKind::Minimum,
                (ExtremumRule::Literal, signs) if signs & SAW_ABOVE == 0 => CriticalKind::Maximum,
                // On a link in several pieces one side alone may have several components: that is no saddle, or an extremum
                // would turn into one where δ reaches its first link vertex.
                (_, signs) if saddle_multiplicity > 0 && signs & SAW_BOTH == SAW_BOTH => CriticalKind::Saddle,
                _ => continue,
            };
            let multiplicity = match kind {
                CriticalKind::Saddle => saddle_multiplicity,
                CriticalKind::Minimum | CriticalKind::Maximum => 1,
            };
            match kind {
                CriticalKind::Minimum => found.counts.minima += 1,
                CriticalKind::Maximum => found.counts.maxima += 1,
                CriticalKind::Saddle => found.counts.saddles += multiplicity,
            }
            push(&mut found.points, CriticalPoint { vertex, kind, multiplicity, on_boundary })?;
        }
    }
    found.counts.index_sum = exact.then_some(index_sum);
    Ok(found)
}
