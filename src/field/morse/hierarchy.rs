//! Cancels pairs of the Morse complex in order of persistence.

use super::NONE;
use super::flow::{Crossing, Flow};
use super::units::Units;
use crate::error::Result;
use crate::field::critical::CriticalKind;
use crate::field::direction::Sweep;
use crate::field::merging::Merging;
use crate::field::order::{Threshold, VertexOrder};
use crate::field::scalar_field::ScalarField;
use crate::field::sorting::{ascending_bits, sort_by_key};
use crate::field::steepest::{Steepest, ends};
use crate::mesh::{LinkKind, TriMesh};
use crate::support::union_find::UnionFind;
use crate::support::watch::Watch;

/// An extremum, or a simple saddle: one of multiplicity k is k nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MorseNode {
    /// Its vertex.
    pub vertex: u32,
    /// Its kind.
    pub kind: CriticalKind,
    /// The persistence of the pair that it is cancelled with, in the units of the values; infinite where it never is.
    pub cancelled_at: f64,
    /// The node that it is cancelled with; itself where it never is.
    pub partner: u32,
    /// Of an extremum: the node of the extremum that its arcs go to once it is cancelled. Otherwise itself.
    pub into: u32,
}

/// The Morse complex at every threshold.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MorseHierarchy {
    /// The minima, then the maxima, then the simple saddles, each by ascending vertex.
    pub nodes: Vec<MorseNode>,
    /// Nodes of a saddle and of an extremum that a steepest path leads to: on a closed surface two minima and two maxima for
    /// each simple saddle, which may coincide.
    pub arcs: Vec<[u32; 2]>,
}

impl MorseHierarchy {
    /// Whether a node is still there when all pairs of persistence up to a positive `threshold` are cancelled; at 0 all are.
    #[must_use]
    pub fn is_alive(&self, node: u32, threshold: f64) -> bool {
        threshold <= 0.0 || self.nodes[node as usize].cancelled_at > threshold
    }

    /// For every node itself, as long as it is there at a threshold, and for an extremum that is not the one that has taken over
    /// its arcs.
    #[must_use]
    pub fn successors(&self, threshold: f64) -> Vec<u32> {
        let next = |node: u32| if self.is_alive(node, threshold) { node } else { self.nodes[node as usize].into };
        let next: Vec<u32> = (0..self.nodes.len() as u32).map(next).collect();
        ends(&next)
    }

    /// Nodes of the arcs that are there at a threshold.
    pub fn arcs_at(&self, threshold: f64) -> impl Iterator<Item = [u32; 2]> {
        let successors = self.successors(threshold);
        let alive = self.arcs.iter().filter(move |&&[saddle, _]| self.is_alive(saddle, threshold));
        alive.map(move |&[saddle, extremum]| [saddle, successors[extremum as usize]])
    }
}

/// For every vertex the extrema that it belongs to; `u32::MAX` for vertices of no triangle.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Basins {
    /// The minimum at which the path downwards ends.
    pub descending: Vec<u32>,
    /// The maximum at which the path upwards ends.
    pub ascending: Vec<u32>,
}

/// An extremum and a simple saddle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cancellation {
    pub(super) extremum: u32,
    pub(super) unit: u32,
    pub(super) upwards: bool,
    pub(super) persistence: f64,
    /// The extremum that takes over.
    pub(super) into: u32,
    /// First vertices of the saddle's paths to the extremum and to the one that takes over.
    here: u32,
    beyond: u32,
}

/// All that thresholds have in common.
pub(super) struct Cancellations {
    pub(super) steepest: Steepest,
    pub(super) units: Units,
    /// For every vertex the minimum and the maximum it flows to; nothing where nothing is cancelled.
    pub(super) ends: [Vec<u32>; 2],
    /// By ascending persistence.
    list: Vec<Cancellation>,
    /// In how many pairs each simple saddle is: at a boundary it may be in one of each direction.
    pairs: Vec<u8>,
}

impl Cancellations {
    /// Pairs of persistence above `limit` are left out, and all of them where it is 0.
    pub(super) fn new(mesh: &TriMesh, order: VertexOrder<'_>, limit: f64) -> Self {
        let steepest = Steepest::by_slope(mesh, order);
        let units = Units::new(mesh, order);
        let ends = if limit > 0.0 { [ends(&steepest.down), ends(&steepest.up)] } else { [Vec::new(), Vec::new()] };
        let (mut found, mut pairs) = (Vec::new(), vec![0_u8; units.len()]);
        for upwards in [false, true].into_iter().filter(|_| limit > 0.0) {
            let sweep = if upwards { Sweep::downwards(order) } else { Sweep::upwards(order) };
            let mut merging = Merging::new(sweep, ends[usize::from(upwards)].clone());
            let paths = if upwards { &units.up } else { &units.down };
            for i in 0..units.len() {
                let unit = units.ascending[if upwards { units.len() - 1 - i } else { i }];
                let [a, b] = paths[unit as usize];
                if a == NONE || b == NONE {
                    continue;
                }
                let Some(merged) = merging.join(a, b) else { continue };
                let (extremum, saddle) = (merged.ended, units.vertices[unit as usize]);
                let persistence = (order.values()[extremum as usize] - order.values()[saddle as usize]).abs();
                pairs[unit as usize] += 1;
                if persistence <= limit {
                    found.push(Cancellation { extremum, unit, upwards, persistence, into: NONE, here: a, beyond: b });
                }
            }
        }
        // Among equals the one that a sweep met first comes first: what it joined has to be one already.
        let mut sorted: Vec<u32> = (0..found.len() as u32).collect();
        sort_by_key(&mut sorted, &|i| ascending_bits(found[i as usize].persistence));
        let mut this = Self { steepest, units, ends, list: sorted.iter().map(|&i| found[i as usize]).collect(), pairs };
        this.find_successors();
        this
    }

    /// In order of persistence, the arcs of a cancelled extremum go over to the one on the other side of its saddle.
    fn find_successors(&mut self) {
        let mut joined = self.ends.each_ref().map(|ends| UnionFind::new(ends.clone()));
        for cancellation in &mut self.list {
            let joined = &mut joined[usize::from(cancellation.upwards)];
            let Cancellation { here, beyond, extremum, .. } = *cancellation;
            let (a, b) = (joined.find(here), joined.find(beyond));
            if a == extremum {
                cancellation.into = b;
            } else {
                (cancellation.here, cancellation.beyond, cancellation.into) = (beyond, here, a);
            }
            joined.link(extremum, cancellation.into);
        }
    }

    /// The flows down and up once all of the list up to a threshold is cancelled.
    pub(super) fn flows(&self, threshold: f64) -> [Flow<'_>; 2] {
        let crossings = [false, true].map(|side| {
            let of_side = self.up_to(threshold).iter().filter(|cancellation| cancellation.upwards == side);
            of_side.map(|c| Crossing { unit: c.unit, extremum: c.extremum, sides: [c.here, c.beyond] }).collect()
        });
        let [down, up]: [Vec<Crossing>; 2] = crossings;
        [
            Flow::new(&self.steepest.down, &self.ends[0], &self.units.vertices, &down),
            Flow::new(&self.steepest.up, &self.ends[1], &self.units.vertices, &up),
        ]
    }

    /// For every vertex that is an extremum, down and up, the one that has taken its place at a threshold.
    pub(super) fn extrema(&self, threshold: f64) -> [Vec<u32>; 2] {
        let mut extrema = [(); 2].map(|()| (0..self.ends[0].len() as u32).collect::<Vec<u32>>());
        let cancelled = self.up_to(threshold);
        // The one that takes over is cancelled later, if at all.
        for cancellation in cancelled.iter().rev() {
            let extrema = &mut extrema[usize::from(cancellation.upwards)];
            extrema[cancellation.extremum as usize] = extrema[cancellation.into as usize];
        }
        extrema
    }

    /// The simple saddles that are left at a threshold: one that is in two pairs goes with the second.
    pub(super) fn alive(&self, threshold: f64) -> Vec<bool> {
        let mut pairs = self.pairs.clone();
        let mut alive = vec![true; self.units.len()];
        for cancellation in self.up_to(threshold) {
            let left = &mut pairs[cancellation.unit as usize];
            *left -= 1;
            alive[cancellation.unit as usize] = *left > 0;
        }
        alive
    }

    fn up_to(&self, threshold: f64) -> &[Cancellation] {
        let end = if threshold > 0.0 {
            self.list.partition_point(|cancellation| cancellation.persistence <= threshold)
        } else {
            0
        };
        &self.list[..end]
    }
}

/// Cancels the pairs of the Morse complex one after the other, the least persistent first \[Edelsbrunner03\].
///
/// # Definition
/// Nodes are the extrema and the saddles, arcs the steepest paths from saddles. To cancel an extremum with the saddle that it
/// is paired with by persistence, the saddle and its arcs are removed, and the arcs that led to the extremum go on to the
/// other extremum that the saddle had on that side. The field itself is not changed.
///
/// # Properties
/// On a closed surface the nodes left at a positive threshold are in number and kind the critical points of the field that
/// [`simplify`](crate::field::simplify) makes. What is left at any threshold is looked up: see [`MorseHierarchy::is_alive`],
/// [`MorseHierarchy::successors`], [`MorseHierarchy::arcs_at`].
///
/// # Errors
/// `Cancelled`.
pub fn morse_hierarchy(field: &ScalarField<'_>, watch: &Watch<'_>) -> Result<MorseHierarchy> {
    let (mesh, values, order) = (field.mesh(), field.values(), field.order());
    watch.tick(200 * values.len() as u64)?;
    let all = Cancellations::new(mesh, order, f64::INFINITY);
    let mut nodes = Vec::new();
    let mut node_of = [(); 2].map(|()| vec![NONE; values.len()]);
    let kinds = mesh.connectivity().link_kinds();
    let node = |vertex: u32, kind, place: usize| MorseNode {
        vertex,
        kind,
        cancelled_at: f64::INFINITY,
        partner: place as u32,
        into: place as u32,
    };
    for (side, kind) in [CriticalKind::Minimum, CriticalKind::Maximum].into_iter().enumerate() {
        for v in 0..values.len() as u32 {
            if all.ends[side][v as usize] == v && kinds[v as usize] != LinkKind::Isolated {
                node_of[side][v as usize] = nodes.len() as u32;
                nodes.push(node(v, kind, nodes.len()));
            }
        }
    }
    let saddles = nodes.len();
    nodes.extend(all.units.vertices.iter().enumerate().map(|(i, &v)| node(v, CriticalKind::Saddle, saddles + i)));
    for cancellation in &all.list {
        let of_side = &node_of[usize::from(cancellation.upwards)];
        let extremum = of_side[cancellation.extremum as usize];
        let saddle = saddles as u32 + cancellation.unit;
        let gone = &mut nodes[extremum as usize];
        (gone.cancelled_at, gone.partner) = (cancellation.persistence, saddle);
        gone.into = of_side[cancellation.into as usize];
        let gone = &mut nodes[saddle as usize];
        (gone.cancelled_at, gone.partner) = (cancellation.persistence, extremum);
    }
    let mut arcs = Vec::new();
    for unit in 0..all.units.len() {
        for (side, paths) in [all.units.down[unit], all.units.up[unit]].into_iter().enumerate() {
            for first in paths.into_iter().filter(|&first| first != NONE) {
                let extremum = all.ends[side][first as usize];
                arcs.push([(saddles + unit) as u32, node_of[side][extremum as usize]]);
            }
        }
    }
    Ok(MorseHierarchy { nodes, arcs })
}

/// The regions that flow to each extremum, once pairs of persistence up to a threshold are cancelled; none are at 0.
///
/// # Errors
/// `InvalidOption` where the threshold is negative or not finite; `Cancelled`.
pub fn basins(field: &ScalarField<'_>, persistence: Threshold, watch: &Watch<'_>) -> Result<Basins> {
    let (mesh, order) = (field.mesh(), field.order());
    let threshold = persistence.absolute(field.range(), "persistence")?;
    watch.tick(100 * mesh.vertex_count() as u64)?;
    let kinds = mesh.connectivity().link_kinds();
    let [descending, ascending] = if threshold > 0.0 {
        let all = Cancellations::new(mesh, order, threshold);
        let extrema = all.extrema(threshold);
        [0, 1].map(|side| all.ends[side].iter().map(|&end| extrema[side][end as usize]).collect())
    } else {
        let steepest = Steepest::by_slope(mesh, order);
        [ends(&steepest.down), ends(&steepest.up)]
    };
    let connected = |labels: Vec<u32>| {
        labels
            .into_iter()
            .zip(kinds)
            .map(|(label, &kind)| if kind == LinkKind::Isolated { NONE } else { label })
            .collect()
    };
    Ok(Basins { descending: connected(descending), ascending: connected(ascending) })
}
