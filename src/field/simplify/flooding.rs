//! Raises basins without a wanted minimum up to where they overflow, or cuts hills without a wanted maximum down to there.

use crate::error::FieldError;
use crate::field::merging::{Merged, Merging};
use crate::field::order::VertexOrder;
use crate::field::saddles::Saddles;
use crate::field::steepest::{Steepest, ends};
use crate::field::sweep::Sweep;
use crate::mesh::{LinkKind, TriMesh};

/// What a field becomes when only the `wanted` minima are to stay (sweeping upwards), or only the wanted maxima.
///
/// Upwards, a value rises to the least height from which a path that never climbs above it leads to a wanted minimum: the
/// morphological reconstruction of the field from these minima \[Vincent93\]. A vertex that is no extremum may be wanted; it
/// counts as the tip of a needle.
///
/// # Errors
/// `Unconstrained` where a component of the mesh has no wanted vertex.
pub(super) fn flood(
    mesh: &TriMesh,
    order: VertexOrder<'_>,
    downwards: bool,
    wanted: Vec<bool>,
) -> Result<Vec<f64>, FieldError> {
    let steepest = Steepest::by_value(mesh.connectivity(), order);
    let (sweep, mut paths) =
        if downwards { (Sweep::downwards(order), steepest.up) } else { (Sweep::upwards(order), steepest.down) };
    for (v, _) in wanted.iter().enumerate().filter(|&(_, &wanted)| wanted) {
        paths[v] = v as u32;
    }
    let saddles = Saddles::with_tips(mesh, order, &wanted, downwards);
    let ascending = saddles.ascending(order.values());
    Mergers::new(mesh, sweep, &paths, &saddles, &ascending).flood(wanted)
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
    pub(super) fn new(
        mesh: &'a TriMesh,
        sweep: Sweep<'a>,
        paths: &[u32],
        saddles: &Saddles,
        ascending: &[u32],
    ) -> Self {
        let ends = ends(paths);
        let mut merging = Merging::new(sweep, ends.clone());
        let mut list = Vec::new();
        merging.visit(saddles, ascending, |saddle, merged| {
            list.push(Merger { merged, value: sweep.values()[saddles.get(saddle).vertex as usize] });
        });
        Self { mesh, sweep, ends, merging, list }
    }

    pub(super) fn list(&self) -> &[Merger] {
        &self.list
    }

    /// The extrema whose components never ended, one for each component of the mesh.
    pub(super) fn survivors(&self) -> impl Iterator<Item = u32> {
        let kinds = self.mesh.connectivity().link_kinds();
        (0..kinds.len() as u32).filter(|&v| self.merging.is_root(v) && kinds[v as usize] != LinkKind::Isolated)
    }

    /// See [`flood`]. All of the `wanted` must be ends of paths.
    pub(super) fn flood(mut self, mut wanted: Vec<bool>) -> Result<Vec<f64>, FieldError> {
        // Forwards: whether anything wanted is in a component, before each merger.
        let mut before = Vec::with_capacity(self.list.len());
        for Merger { merged: Merged { survivor, ended }, .. } in &self.list {
            let (a, b) = (wanted[*survivor as usize], wanted[*ended as usize]);
            before.push((a, b));
            wanted[*survivor as usize] = a || b;
        }
        let dry = self.survivors().find(|&v| !wanted[v as usize]);
        if let Some(dry) = dry {
            return Err(self.unconstrained(dry));
        }
        drop(wanted);
        // Backwards: how far the component of that time is filled, by the extremum that named it.
        let values = self.sweep.values();
        let untouched = if self.sweep.is_downwards() { f64::INFINITY } else { f64::NEG_INFINITY };
        let mut levels = vec![untouched; values.len()];
        for (merger, wanted) in self.list.iter().zip(before).rev() {
            let (a, b) = (merger.merged.survivor as usize, merger.merged.ended as usize);
            match wanted {
                (true, true) => {}
                (true, false) => levels[b] = merger.value,
                (false, true) => (levels[a], levels[b]) = (merger.value, untouched),
                (false, false) => levels[b] = levels[a],
            }
        }
        let mut flooded = values.to_vec();
        for (value, &end) in flooded.iter_mut().zip(&self.ends) {
            let level = levels[end as usize];
            if self.sweep.is_downwards() == (*value > level) {
                *value = level;
            }
        }
        Ok(flooded)
    }

    /// For the component that an extremum names; components are numbered by their least vertices.
    fn unconstrained(&mut self, extremum: u32) -> FieldError {
        let kinds = self.mesh.connectivity().link_kinds();
        let mut seen = vec![false; kinds.len()];
        let (mut component, mut vertex) = (0, 0);
        while kinds[vertex as usize] == LinkKind::Isolated || self.merging.find(vertex) != extremum {
            if kinds[vertex as usize] != LinkKind::Isolated {
                let known = core::mem::replace(&mut seen[self.merging.find(vertex) as usize], true);
                component += usize::from(!known);
            }
            vertex += 1;
        }
        FieldError::Unconstrained { component, vertex }
    }
}
