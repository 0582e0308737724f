//! The Morse complex at every threshold: its pairs cancelled in order of persistence.

use super::NONE;
use super::cancellations::Cancellations;
use crate::error::{OutOfMemory, Result};
use crate::field::arrays::{filled, push};
use crate::field::critical::CriticalKind;
use crate::field::scalar_field::{OnMesh, Part, ScalarField};
use crate::mesh::LinkKind;
use crate::support::pieces::{pieces, ranges};
use crate::support::watch::{Phase, Watch};

/// An extremum, or a simple saddle: one of multiplicity k is k nodes. An extremum whose link is in k + 1 pieces is the node of an
/// extremum, and k simple saddles beside, as components join there.
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
    /// The node of the extremum that an extremum's arcs go to once it is cancelled; for other nodes itself.
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

impl OnMesh for MorseHierarchy {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        self.nodes.iter_mut().for_each(|node| part.vertex(&mut node.vertex));
        Ok(())
    }
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
        let mut successors: Vec<u32> = (0..self.nodes.len() as u32).map(next).collect();
        for node in 0..successors.len() {
            let mut last = node as u32;
            while successors[last as usize] != last {
                last = successors[last as usize];
            }
            // What leads to the last one is led to it at once from now on.
            let mut at = node as u32;
            while at != last {
                at = core::mem::replace(&mut successors[at as usize], last);
            }
        }
        successors
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
/// `Cancelled`, `OutOfMemory`.
pub fn morse_hierarchy(field: &ScalarField<'_>, watch: &Watch<'_>) -> Result<MorseHierarchy> {
    let (mesh, n) = (field.mesh(), field.values().len());
    let mut plan = watch.plan(&[(Phase::Field, 6.0), (Phase::Field, 1.0)]);
    plan.begin(0)?;
    let all = Cancellations::new(mesh, field.order(), f64::INFINITY, watch)?;
    plan.begin(10 * n as u64 + 50 * all.simple_saddles.len() as u64)?;
    let mut nodes = Vec::new();
    let mut node_of = [filled(NONE, n)?, filled(NONE, n)?];
    let kinds = mesh.connectivity().link_kinds();
    let node = |vertex: u32, kind, place: usize| MorseNode {
        vertex,
        kind,
        cancelled_at: f64::INFINITY,
        partner: place as u32,
        into: place as u32,
    };
    for (side, kind) in [CriticalKind::Minimum, CriticalKind::Maximum].into_iter().enumerate() {
        for range in ranges(n, 5, watch) {
            for v in range? {
                if all.ends[side][v] == v as u32 && kinds[v] != LinkKind::Isolated {
                    node_of[side][v] = nodes.len() as u32;
                    let place = nodes.len();
                    push(&mut nodes, node(v as u32, kind, place))?;
                }
            }
        }
    }
    let saddles = nodes.len();
    for (i, &v) in all.simple_saddles.vertices.iter().enumerate() {
        push(&mut nodes, node(v, CriticalKind::Saddle, saddles + i))?;
    }
    for piece in pieces(&all.list, 20, watch) {
        for cancellation in piece? {
            let of_side = &node_of[usize::from(cancellation.upwards)];
            let extremum = of_side[cancellation.extremum as usize];
            let saddle = saddles as u32 + cancellation.simple;
            let gone = &mut nodes[extremum as usize];
            (gone.cancelled_at, gone.partner) = (cancellation.persistence, saddle);
            gone.into = of_side[cancellation.into as usize];
            let gone = &mut nodes[saddle as usize];
            (gone.cancelled_at, gone.partner) = (cancellation.persistence, extremum);
        }
    }
    let mut arcs = Vec::new();
    for range in ranges(all.simple_saddles.len(), 20, watch) {
        for simple in range? {
            for (side, paths) in
                [all.simple_saddles.down[simple], all.simple_saddles.up[simple]].into_iter().enumerate()
            {
                for first in paths.into_iter().filter(|&first| first != NONE) {
                    let extremum = all.ends[side][first as usize];
                    push(&mut arcs, [(saddles + simple) as u32, node_of[side][extremum as usize]])?;
                }
            }
        }
    }
    plan.finish()?;
    Ok(field.on_whole(MorseHierarchy { nodes, arcs })?)
}
