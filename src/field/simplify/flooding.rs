//! Raises basins without a wanted minimum up to where they overflow, or cuts hills without a wanted maximum down to there.

use super::flats::Target;
use crate::error::FieldError;
use crate::field::arrays::{copied, filled, push, with_room};
use crate::field::merging::{Merged, Merging};
use crate::field::order::VertexOrder;
use crate::field::saddles::Saddles;
use crate::field::steepest::{Steepest, ends};
use crate::field::sweep::Sweep;
use crate::mesh::{LinkKind, TriMesh};
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// What a field becomes when only the wanted minima are to stay (sweeping upwards), or only the wanted maxima.
///
/// Upwards, a value rises to the least height from which a path that never climbs above it leads to a wanted minimum: the
/// morphological reconstruction of the field from these minima \[Vincent93\]. A vertex that is no extremum may be wanted; it
/// counts as the tip of a needle. No path goes on over a wanted maximum; that matters where its neighbours do not hang together.
///
/// # Errors
/// `Unconstrained` where a component of the mesh has no wanted vertex.
pub(super) fn flood(
    mesh: &TriMesh,
    order: VertexOrder<'_>,
    downwards: bool,
    targets: &[Target],
    watch: &Watch<'_>,
) -> Result<Vec<f64>, FieldError> {
    let connectivity = mesh.connectivity();
    let (own, opposite) =
        if downwards { (Target::Maximum, Target::Minimum) } else { (Target::Minimum, Target::Maximum) };
    let wanted = having(targets, own)?;
    let is_blocked =
        |v: u32| targets[v as usize] == opposite && connectivity.link_kinds()[v as usize] == LinkKind::NonManifold;
    let steepest = Steepest::by_value(connectivity, order, watch)?;
    let (sweep, mut paths) =
        if downwards { (Sweep::downwards(order), steepest.up) } else { (Sweep::upwards(order), steepest.down) };
    watch.tick(targets.len() as u64)?;
    for (v, _) in wanted.iter().enumerate().filter(|&(_, &wanted)| wanted) {
        paths[v] = v as u32;
    }
    let saddles = Saddles::with_tips(mesh, order, &wanted, downwards, watch)?;
    let ascending = saddles.ascending(order.values(), watch)?;
    let mergers = Mergers::new(mesh, sweep, &paths, &saddles, &ascending, &is_blocked, watch)?;
    drop((paths, saddles, ascending));
    let mut flooded = mergers.flood(wanted, watch)?;
    // Those that paths do not go over still lie beyond all their neighbours.
    for &v in connectivity.special_vertices() {
        if is_blocked(v) {
            let mut value = order.values()[v as usize];
            for w in connectivity.link(v).flatten().map(|w| flooded[w as usize]) {
                value = if downwards { value.min(w) } else { value.max(w) };
            }
            flooded[v as usize] = value;
        }
    }
    Ok(flooded)
}

pub(super) fn having(targets: &[Target], wanted: Target) -> Result<Vec<bool>, FieldError> {
    let mut having = with_room(targets.len())?;
    having.extend(targets.iter().map(|&target| target == wanted));
    Ok(having)
}

/// How the components of a sweep merge, from the first time to the last.
pub(super) struct Mergers<'a> {
    mesh: &'a TriMesh,
    sweep: Sweep<'a>,
    /// For every vertex the extremum of its steepest path.
    ends: Vec<u32>,
    merging: Merging<'a>,
    list: Vec<Merger>,
}

/// Two components became one at a height.
pub(super) struct Merger {
    merged: Merged,
    value: f64,
}

impl Merger {
    /// The extremum whose component ended, and its persistence.
    pub(super) fn pair(&self, values: &[f64]) -> (u32, f64) {
        (self.merged.ended, (values[self.merged.ended as usize] - self.value).abs())
    }
}

impl<'a> Mergers<'a> {
    /// Components do not merge over blocked vertices.
    pub(super) fn new(
        mesh: &'a TriMesh,
        sweep: Sweep<'a>,
        paths: &[u32],
        saddles: &Saddles,
        ascending: &[u32],
        is_blocked: &dyn Fn(u32) -> bool,
        watch: &Watch<'_>,
    ) -> Result<Self, FieldError> {
        let ends = ends(paths, watch)?;
        let mut merging = Merging::new(sweep, copied(&ends)?);
        let mut list = Vec::new();
        merging.visit(saddles, ascending, is_blocked, watch, |saddle, merged| {
            push(&mut list, Merger { merged, value: sweep.values()[saddles.get(saddle).vertex as usize] })?;
            Ok(())
        })?;
        Ok(Self { mesh, sweep, ends, merging, list })
    }

    pub(super) fn list(&self) -> &[Merger] {
        &self.list
    }

    /// The extrema whose components never ended, one for each component of the mesh where nothing is blocked.
    pub(super) fn survivors(&self) -> impl Iterator<Item = u32> {
        let kinds = self.mesh.connectivity().link_kinds();
        (0..kinds.len() as u32).filter(|&v| self.merging.is_root(v) && kinds[v as usize] != LinkKind::Isolated)
    }

    /// See [`flood`]. All of the `wanted` must be ends of paths.
    pub(super) fn flood(mut self, mut wanted: Vec<bool>, watch: &Watch<'_>) -> Result<Vec<f64>, FieldError> {
        // Forwards: whether anything wanted is in a component, before each merger.
        let mut before = with_room(self.list.len())?;
        watch.tick(20 * self.list.len() as u64)?;
        for Merger { merged: Merged { survivor, ended }, .. } in &self.list {
            let (a, b) = (wanted[*survivor as usize], wanted[*ended as usize]);
            before.push((a, b));
            wanted[*survivor as usize] = a || b;
        }
        watch.tick(wanted.len() as u64)?;
        let dry = self.survivors().find(|&v| !wanted[v as usize]);
        if let Some(dry) = dry {
            return Err(self.unconstrained(dry)?);
        }
        drop(wanted);
        // Backwards: how far the component of that time is filled, by the extremum that named it.
        let values = self.sweep.values();
        let untouched = if self.sweep.is_downwards() { f64::INFINITY } else { f64::NEG_INFINITY };
        let mut heights = filled(untouched, values.len())?;
        watch.tick(20 * self.list.len() as u64)?;
        for (merger, wanted) in self.list.iter().zip(before).rev() {
            let (a, b) = (merger.merged.survivor as usize, merger.merged.ended as usize);
            match wanted {
                (true, true) => {}
                (true, false) => heights[b] = merger.value,
                (false, true) => (heights[a], heights[b]) = (merger.value, untouched),
                (false, false) => heights[b] = heights[a],
            }
        }
        let mut flooded = copied(values)?;
        for range in ranges(flooded.len(), 4, watch) {
            let range = range?;
            for (value, &end) in flooded[range.clone()].iter_mut().zip(&self.ends[range]) {
                let height = heights[end as usize];
                if self.sweep.is_downwards() == (*value > height) {
                    *value = height;
                }
            }
        }
        Ok(flooded)
    }

    /// The error for the component that an extremum names; components are numbered by their least vertices.
    fn unconstrained(&mut self, extremum: u32) -> Result<FieldError, FieldError> {
        let kinds = self.mesh.connectivity().link_kinds();
        let mut seen = filled(false, kinds.len())?;
        let (mut component, mut vertex) = (0, 0);
        while kinds[vertex as usize] == LinkKind::Isolated || self.merging.find(vertex) != extremum {
            if kinds[vertex as usize] != LinkKind::Isolated {
                let known = core::mem::replace(&mut seen[self.merging.find(vertex) as usize], true);
                component += usize::from(!known);
            }
            vertex += 1;
        }
        Ok(FieldError::Unconstrained { component, vertex })
    }
}
