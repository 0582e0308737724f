//! Extrema paired with saddles by persistence.

mod annotations;
mod classes;
mod loops;

use annotations::{TRIANGLE, VERTEX};
use loops::essential_saddles;

use crate::error::{OutOfMemory, Result};
use crate::field::arrays::{collected, copied, filled, numbers, push};
use crate::field::critical::CriticalKind;
use crate::field::merging::Merging;
use crate::field::saddles::Saddles;
use crate::field::scalar_field::{OnMesh, Part, ScalarField};
use crate::field::sorting::{ascending_bits, sort_by_key};
use crate::field::steepest::Steepest;
use crate::field::sweep::Sweep;
use crate::mesh::LinkKind;
use crate::support::pieces::ranges;
use crate::support::watch::{Phase, Watch};

/// An extremum and the saddle at which its component of the sublevel or superlevel set joins that of an older one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PersistencePair {
    /// The minimum or maximum.
    pub extremum: u32,
    /// The vertex at which its component ends: a saddle, or an extremum of the other kind whose link is in several pieces
    /// (where sheets hang together in a vertex).
    pub saddle: u32,
    /// Minimum or maximum.
    pub kind: CriticalKind,
    /// The lower of the two values.
    pub birth: f64,
    /// The higher of the two values.
    pub death: f64,
    /// death − birth, never negative.
    pub persistence: f64,
}

/// The pairs of a field and what has no partner.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PersistenceDiagram {
    /// The most persistent first.
    pub pairs: Vec<PersistencePair>,
    /// The lowest vertex of each component of the mesh, ascending by vertex.
    pub essential_minima: Vec<u32>,
    /// The highest vertex of each component of the mesh, ascending by vertex.
    pub essential_maxima: Vec<u32>,
    /// The vertices at which a loop appears in the sublevel sets that never bounds, once for each such loop, by ascending
    /// (value, id): as many as the first Betti number of the mesh (with coefficients modulo 2).
    pub essential_saddles: Vec<u32>,
}

impl OnMesh for PersistenceDiagram {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        for pair in &mut self.pairs {
            part.vertex(&mut pair.extremum);
            part.vertex(&mut pair.saddle);
        }
        part.vertices(&mut self.essential_minima);
        part.vertices(&mut self.essential_maxima);
        part.vertices(&mut self.essential_saddles);
        Ok(())
    }
}

/// Numbers of extrema as steps over the persistence threshold: row k holds on `threshold[k]..threshold[k + 1]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PersistenceCurve {
    /// In the units of the values; row 0 is 0.
    pub threshold: Vec<f64>,
    /// Minima of persistence above the threshold, essential ones included.
    pub minima: Vec<u32>,
    /// Maxima of persistence above the threshold, essential ones included.
    pub maxima: Vec<u32>,
}

impl PersistenceDiagram {
    /// How many extrema are more persistent than each threshold: what [`simplify`](super::simplify) leaves.
    #[must_use]
    pub fn curve(&self) -> PersistenceCurve {
        let mut curve = PersistenceCurve::default();
        let [mut minima, mut maxima] = [self.essential_minima.len() as u32, self.essential_maxima.len() as u32];
        // Down from the highest threshold: the row of a threshold counts what comes before it in the list.
        for (i, pair) in self.pairs.iter().enumerate() {
            if i == 0 || pair.persistence != self.pairs[i - 1].persistence {
                curve.push(pair.persistence, minima, maxima);
            }
            match pair.kind {
                CriticalKind::Minimum => minima += 1,
                _ => maxima += 1,
            }
        }
        if curve.threshold.last() != Some(&0.0) {
            curve.push(0.0, minima, maxima);
        }
        curve.threshold.reverse();
        curve.minima.reverse();
        curve.maxima.reverse();
        curve
    }
}

impl PersistenceCurve {
    fn push(&mut self, threshold: f64, minima: u32, maxima: u32) {
        self.threshold.push(threshold);
        self.minima.push(minima);
        self.maxima.push(maxima);
    }
}

/// Pairs minima with saddles and saddles with maxima.
///
/// # Definition
/// Vertices are added by ascending (value, id). A minimum begins a component; where components meet, that of the higher
/// minimum ends, and this minimum is paired with the vertex at which they meet. Maxima are paired so from above \[Edelsbrunner02\].
/// Persistence is the difference of the two values. The lowest and the highest vertex of every component of the mesh have no
/// partner.
///
/// # Properties
/// On a closed surface a saddle is in as many pairs as its multiplicity says, or essential, so that
/// (minima + maxima) − (pairs + essential saddles) = χ. On any triangle complex χ = b₀ − b₁ + b₂, with b₀ the essential minima
/// and b₁ the essential saddles. Linear time, but for sorting the saddles. Where sheets meet, every edge is annotated with the
/// loops that pass it, which takes ten times as long, and longer only where most edges have many loops: few have on dense
/// complexes, however many triangles an edge has.
///
/// # Units
/// Those of the values.
///
/// # Errors
/// `Cancelled`, `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
/// let diagram = field::persistence(&field::ScalarField::new(&torus, &height)?, &Watch::none())?;
/// assert_eq!((diagram.pairs.len(), diagram.essential_saddles.len()), (0, 2));
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn persistence(field: &ScalarField<'_>, watch: &Watch<'_>) -> Result<PersistenceDiagram> {
    let (mesh, values, order) = (field.mesh(), field.values(), field.order());
    let connectivity = mesh.connectivity();
    let mut steps = STEPS;
    let is_manifold = !connectivity.link_kinds().contains(&LinkKind::NonManifold);
    if !is_manifold {
        steps[5].1 = 60.0;
    }
    let mut plan = watch.plan(&steps);
    plan.begin(8 * connectivity.triangles().len() as u64 + 20 * values.len() as u64)?;
    let saddles = Saddles::new(mesh, order, watch)?;
    plan.begin(8 * connectivity.edges().len() as u64)?;
    let steepest = Steepest::by_value(connectivity, order, watch)?;
    plan.begin(90 * saddles.len() as u64)?;
    let ascending = saddles.ascending(values, watch)?;
    let mut diagram = PersistenceDiagram::default();
    let mut pairs = Vec::new();
    let mut mergers = filled([0_u32; 2], saddles.len())?;
    for sweep in [Sweep::upwards(order), Sweep::downwards(order)] {
        plan.begin(100 * saddles.len() as u64 + 2 * values.len() as u64)?;
        let (kind, paths) = if sweep.is_downwards() {
            (CriticalKind::Maximum, &steepest.up)
        } else {
            (CriticalKind::Minimum, &steepest.down)
        };
        let mut merging = Merging::new(sweep, copied(paths)?);
        merging.visit(&saddles, &ascending, &|_| false, watch, |index, merged| {
            mergers[index as usize][usize::from(sweep.is_downwards())] += 1;
            let saddle = saddles.get(index).vertex;
            let (a, b) = (values[merged.ended as usize], values[saddle as usize]);
            let (birth, death) = if a < b { (a, b) } else { (b, a) };
            let persistence = death - birth;
            push(&mut pairs, PersistencePair { extremum: merged.ended, saddle, kind, birth, death, persistence })?;
            Ok(())
        })?;
        let kinds = connectivity.link_kinds();
        let essential = match kind {
            CriticalKind::Minimum => &mut diagram.essential_minima,
            _ => &mut diagram.essential_maxima,
        };
        for range in ranges(values.len(), 2, watch) {
            for v in range? {
                if merging.is_root(v as u32) && kinds[v] != LinkKind::Isolated {
                    push(essential, v as u32)?;
                }
            }
        }
    }
    let triangles = connectivity.triangles().len() as u64;
    plan.begin(if is_manifold {
        100 * saddles.len() as u64
    } else {
        VERTEX * values.len() as u64 + 3 * TRIANGLE * triangles
    })?;
    diagram.essential_saddles = essential_saddles(mesh, order, &saddles, &ascending, &mergers, &steepest.up, watch)?;
    plan.begin(90 * pairs.len() as u64)?;
    let mut ranked = numbers(pairs.len())?;
    sort_by_key(&mut ranked, &|i| !ascending_bits(pairs[i as usize].persistence), watch)?;
    diagram.pairs = collected(pairs.len(), ranked.iter().map(|&i| pairs[i as usize]))?;
    plan.finish()?;
    Ok(field.on_whole(diagram)?)
}

/// The shares of: finding the saddles, steepest paths, sorting the saddles, the sweeps up and down, loops, sorting the pairs.
const STEPS: [(Phase, f64); 7] = [
    (Phase::Field, 3.0),
    (Phase::Field, 2.0),
    (Phase::Field, 1.5),
    (Phase::Field, 2.0),
    (Phase::Field, 2.0),
    (Phase::Field, 1.0),
    (Phase::Field, 1.0),
];
