//! Feature points: the vertices that stand for a field, chosen by a rule \[Patane09, sections 1 and 4.3\].

mod k_means;
mod line;
mod seeding;

use crate::error::{FieldError, OptionError, Result};
use crate::field::arrays::{collected, filled};
use crate::field::critical::{DeltaOptions, critical_points};
use crate::field::order::Threshold;
use crate::field::persistence::persistence;
use crate::field::scalar_field::ScalarField;
use crate::mesh::Connectivity;
use crate::support::watch::{Phase, Watch};

/// Where feature points come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Features<'a> {
    /// Vertices named by the caller; repeated ones count once.
    Vertices(&'a [u32]),
    /// The critical points that are left at a δ, all of them at δ = 0: C_δ of \[Patane09, section 3\].
    CriticalPoints(DeltaOptions),
    /// Both ends of every pair of persistence above the threshold, and the essential minima, maxima and saddles, which have no
    /// partner. The extrema among them are those that [`simplify`](super::simplify) leaves.
    Persistence(Threshold),
    /// For each of so many clusters of the values, the vertex whose value is nearest to the mean of its cluster; of several the
    /// one with the smallest id.
    KMeans {
        /// How many, at least 1. With as many as there are different values or more, each value is a cluster.
        clusters: usize,
        /// The seed of the random numbers that the search begins with. The same seed gives the same clusters everywhere.
        seed: u64,
    },
}

/// Chooses vertices of one field, or of several on the same mesh, by a rule.
///
/// # Definition
/// See [`Features`]. Clusters are those of k-means in one dimension. Over the vertices that belong to a triangle, Σ (f_i − mean of
/// the cluster of i)² has a local minimum: every value is in the cluster with the nearest mean, the lower of two. Means begin at
/// values chosen by k-means++ \[Arthur07\] and follow Lloyd's iterations \[Lloyd82\]. What becomes empty is replaced by dividing
/// the cluster that gains most; so is, where Lloyd's iterations end, the bound that is worth least, as long as the sum decreases.
///
/// # Properties
/// Ascending, each vertex once; of several fields those that the rule chooses in any of them. Empty where a rule finds nothing, as at a large δ. Isolated vertices are features only where they
/// are named.
///
/// Clusters are found in integers: sums are exact whatever the range and however far from zero it lies. For them, values nearer
/// to each other than 2⁻⁵² of the range (up to a million vertices; 2⁻⁴⁶ with as many as ids allow) are equal, and clusters fewer
/// where too few others are left. Time is O(n) for sorting and O(k log n) for each iteration with k clusters. The number of
/// iterations is bounded, the more tightly the more clusters there are: of thousands, some values may still be with the second
/// nearest mean.
///
/// # Errors
/// `LengthMismatch` for fields on meshes of different sizes; `IndexOutOfBounds` for a named vertex that does not exist; `InvalidOption`
/// where δ or the threshold is negative or not finite, and for 0 clusters.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
/// let height = [field::ScalarField::new(&torus, &height)?];
/// let essential = field::Features::Persistence(field::Threshold::Relative(0.1));
/// assert_eq!(field::feature_points(&height, &essential, &Watch::none())?.len(), 4);
/// let spread = field::Features::KMeans { clusters: 7, seed: 1 };
/// assert_eq!(field::feature_points(&height, &spread, &Watch::none())?.len(), 7);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn feature_points(fields: &[ScalarField<'_>], features: &Features<'_>, watch: &Watch<'_>) -> Result<Vec<u32>> {
    let expected = fields.first().map_or(0, |field| field.whole_mesh().vertex_count());
    let mut chosen = filled(false, expected)?;
    let steps = collected(fields.len(), fields.iter().map(|_| (Phase::Field, 1.0)))?;
    let mut plan = watch.plan(&steps);
    for field in fields {
        let actual = field.whole_mesh().vertex_count();
        if actual != expected {
            return Err(FieldError::length_mismatch(expected, actual, 0).into());
        }
        plan.begin(0)?;
        choose_in(field, features, &mut |vertex| chosen[vertex as usize] = true, watch)?;
    }
    plan.finish()?;
    let count = chosen.iter().filter(|&&chosen| chosen).count();
    Ok(collected(count, (0..expected as u32).filter(|&v| chosen[v as usize]))?)
}

fn choose_in(
    field: &ScalarField<'_>,
    features: &Features<'_>,
    choose: &mut dyn FnMut(u32),
    watch: &Watch<'_>,
) -> Result<()> {
    match *features {
        Features::Vertices(vertices) => {
            field.to_part(vertices)?;
            vertices.iter().for_each(|&v| choose(v));
        }
        Features::CriticalPoints(options) => {
            critical_points(field, &options, watch)?.points.iter().for_each(|point| choose(point.vertex));
        }
        Features::Persistence(threshold) => {
            let bound = threshold.absolute(field.range(), "threshold")?;
            let diagram = persistence(field, watch)?;
            for pair in diagram.pairs.iter().take_while(|pair| pair.persistence > bound) {
                choose(pair.extremum);
                choose(pair.saddle);
            }
            for essential in [&diagram.essential_minima, &diagram.essential_maxima, &diagram.essential_saddles] {
                essential.iter().for_each(|&v| choose(v));
            }
        }
        Features::KMeans { clusters: 0, .. } => {
            let expected = "a whole number that is at least 1".to_owned();
            return Err(OptionError::InvalidOption { option: "clusters".to_owned(), expected }.into());
        }
        Features::KMeans { clusters, seed } => {
            let mut representatives = k_means::representatives(field, clusters, seed, watch)?;
            field.to_whole(&mut representatives);
            representatives.iter().for_each(|&v| choose(v));
        }
    }
    Ok(())
}

/// The vertices and their neighbours: I = C ∪ N(C) of \[Patane09, section 4.3\]. Ascending, each once.
///
/// # Panics
/// Where a vertex does not exist.
#[must_use]
pub fn with_stars(connectivity: &Connectivity, vertices: &[u32]) -> Vec<u32> {
    let mut chosen = vec![false; connectivity.vertex_count()];
    for &vertex in vertices {
        chosen[vertex as usize] = true;
        for &triangle in connectivity.star(vertex) {
            for corner in connectivity.triangles()[triangle as usize] {
                chosen[corner as usize] = true;
            }
        }
    }
    ascending(&chosen)
}

fn ascending(chosen: &[bool]) -> Vec<u32> {
    (0..chosen.len() as u32).filter(|&v| chosen[v as usize]).collect()
}
