//! The Morse complex at every threshold: its pairs cancelled in order of persistence.

use super::NONE;
use super::cancellations::Cancellations;
use crate::error::Result;
use crate::field::critical::CriticalKind;
use crate::field::scalar_field::ScalarField;
use crate::field::steepest::ends;
use crate::mesh::LinkKind;
use crate::support::watch::Watch;

/// An extremum, or a simple saddle: one of multiplicity k is k nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MorseNode {
    /// Its vertex.
    pub vertex: u32,
    /// Its kind.
    pub kind: CriticalKind,
    /// The persistence of the pair that it is cancelled with, in the simple_saddles of the values; infinite where it never is.
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
    nodes.extend(
        all.simple_saddles.vertices.iter().enumerate().map(|(i, &v)| node(v, CriticalKind::Saddle, saddles + i)),
    );
    for cancellation in &all.list {
        let of_side = &node_of[usize::from(cancellation.upwards)];
        let extremum = of_side[cancellation.extremum as usize];
        let saddle = saddles as u32 + cancellation.simple;
        let gone = &mut nodes[extremum as usize];
        (gone.cancelled_at, gone.partner) = (cancellation.persistence, saddle);
        gone.into = of_side[cancellation.into as usize];
        let gone = &mut nodes[saddle as usize];
        (gone.cancelled_at, gone.partner) = (cancellation.persistence, extremum);
    }
    let mut arcs = Vec::new();
    for simple in 0..all.simple_saddles.len() {
        for (side, paths) in [all.simple_saddles.down[simple], all.simple_saddles.up[simple]].into_iter().enumerate() {
            for first in paths.into_iter().filter(|&first| first != NONE) {
                let extremum = all.ends[side][first as usize];
                arcs.push([(saddles + simple) as u32, node_of[side][extremum as usize]]);
            }
        }
    }
    Ok(MorseHierarchy { nodes, arcs })
}
