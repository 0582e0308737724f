//! Raises basins without a wanted minimum up to where they overflow, or cuts hills without a wanted maximum down to there.

use crate::error::FieldError;
use crate::field::direction::Sweep;
use crate::field::merging::Merging;
use crate::field::order::VertexOrder;
use crate::field::saddles::Saddles;
use crate::field::steepest::Steepest;
use crate::mesh::{LinkKind, TriMesh};

/// The end of a list.
const NONE: u32 = u32::MAX;

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
    wanted: &[bool],
) -> Result<Vec<f64>, FieldError> {
    let steepest = Steepest::by_value(mesh.connectivity(), order);
    let (sweep, mut paths) =
        if downwards { (Sweep::downwards(order), steepest.up) } else { (Sweep::upwards(order), steepest.down) };
    for (v, _) in wanted.iter().enumerate().filter(|&(_, &wanted)| wanted) {
        paths[v] = v as u32;
    }
    let saddles = Saddles::with_tips(mesh, order, wanted, downwards);
    let ascending = saddles.ascending(order.values());
    flood_along(mesh, sweep, paths, &saddles, &ascending, wanted)
}

/// As [`flood`], for who has the saddles and the steepest paths already. All of the `wanted` must be ends of paths.
pub(super) fn flood_along(
    mesh: &TriMesh,
    sweep: Sweep<'_>,
    paths: Vec<u32>,
    saddles: &Saddles,
    ascending: &[u32],
    wanted: &[bool],
) -> Result<Vec<f64>, FieldError> {
    let values = sweep.values();
    let mut merging = Merging::new(sweep, paths);
    let ends: Vec<u32> = (0..values.len() as u32).map(|v| merging.find(v)).collect();
    let mut basins = Basins {
        wanted: wanted.to_vec(),
        levels: vec![if sweep.is_downwards() { f64::INFINITY } else { f64::NEG_INFINITY }; values.len()],
        next: vec![NONE; values.len()],
        last: (0..values.len() as u32).collect(),
    };
    merging.visit(saddles, ascending, |saddle, merged| {
        basins.join(merged.survivor, merged.ended, values[saddles.get(saddle).vertex as usize]);
    });
    let kinds = mesh.connectivity().link_kinds();
    let dry = (0..values.len() as u32)
        .find(|&v| kinds[v as usize] != LinkKind::Isolated && !basins.wanted[merging.find(v) as usize]);
    if let Some(vertex) = dry {
        return Err(unconstrained(&mut merging, kinds, vertex));
    }
    let level = |v: usize| basins.levels[ends[v] as usize];
    let flooded = values
        .iter()
        .enumerate()
        .map(|(v, &value)| if sweep.is_downwards() == (value > level(v)) { level(v) } else { value });
    Ok(flooded.collect())
}

/// Numbers the components by their least vertices.
fn unconstrained(merging: &mut Merging<'_>, kinds: &[LinkKind], vertex: u32) -> FieldError {
    let mut seen = vec![false; kinds.len()];
    let mut component = 0;
    for v in (0..vertex).filter(|&v| kinds[v as usize] != LinkKind::Isolated) {
        let known = core::mem::replace(&mut seen[merging.find(v) as usize], true);
        component += usize::from(!known);
    }
    FieldError::Unconstrained { component, vertex }
}

/// The basins of the extrema, gathered in lists as long as nothing wanted is among them.
struct Basins {
    /// Of the extremum that names a component: whether there is anything wanted in it.
    wanted: Vec<bool>,
    /// How far the basin of each extremum is filled.
    levels: Vec<f64>,
    next: Vec<u32>,
    last: Vec<u32>,
}

impl Basins {
    fn join(&mut self, survivor: u32, ended: u32, level: f64) {
        let (a, b) = (survivor as usize, ended as usize);
        match (self.wanted[a], self.wanted[b]) {
            (true, true) => {}
            (true, false) => self.fill(ended, level),
            (false, true) => {
                self.fill(survivor, level);
                self.wanted[a] = true;
            }
            (false, false) => {
                self.next[self.last[a] as usize] = ended;
                self.last[a] = self.last[b];
            }
        }
    }

    fn fill(&mut self, mut extremum: u32, level: f64) {
        while extremum != NONE {
            self.levels[extremum as usize] = level;
            extremum = self.next[extremum as usize];
        }
    }
}
