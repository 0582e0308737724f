//! Levels just below and just above saddles, where level sets change their shape.

use super::level_set::MOST_LEVELS;
use crate::error::{OptionError, OutOfMemory, Result};
use crate::field::arrays::collected;
use crate::field::critical::{CriticalKind, exact};
use crate::field::scalar_field::ScalarField;
use crate::field::sorting::sort;
use crate::support::watch::{Phase, Watch};

/// Two levels for each value of a saddle, or of the given vertices: one just below and one just above.
///
/// # Definition
/// For a value c and `offset` o, relative to the range R of the field: c − oR and c + oR, the latter at least the next double
/// after c. [`level_sets`](super::level_sets) takes a vertex at its level for one above, so for o = 0 the lines of c pass below
/// the vertex, those of the next double above it, and both touch it.
///
/// # Properties
/// Ascending, each level once, so fewer than two for each value where values or levels coincide. The vertices need not be saddles.
/// By default every saddle of [`critical_points`](crate::field::critical_points) at δ = 0 is taken.
///
/// # Errors
/// `IndexOutOfBounds` for a vertex that does not exist; `InvalidOption` where
/// `offset` is negative or not finite, and for more than 10,000 levels; `MissingValue`, `Cancelled`, `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
/// let height = field::ScalarField::new(&torus, &height)?;
/// let levels = field::saddle_levels(&height, None, 0.0, &Watch::none())?;
/// let sets = field::level_sets(&height, &levels, &Watch::none())?;
/// // One circle below the lower saddle, two between the two, one above the upper one.
/// let lines = levels.iter().map(|level| sets.levels.iter().filter(|&at| at == level).count());
/// assert_eq!(lines.collect::<Vec<_>>(), [1, 2, 2, 1]);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn saddle_levels(
    field: &ScalarField<'_>,
    vertices: Option<&[u32]>,
    offset: f64,
    watch: &Watch<'_>,
) -> Result<Vec<f64>> {
    let (values, range) = (field.values(), field.range());
    if !(offset.is_finite() && offset >= 0.0) {
        let expected = "a finite number that is not negative".to_owned();
        return Err(OptionError::InvalidOption { option: "offset".to_owned(), expected }.into());
    }
    let mut plan = watch.plan(&[(Phase::Field, 4.0), (Phase::Field, 1.0)]);
    plan.begin(0)?;
    let at: Vec<f64> = match vertices {
        Some(vertices) => {
            let vertices = field.to_part(vertices)?;
            collected(vertices.len(), vertices.iter().map(|&v| values[v as usize]))?
        }
        None => {
            let found = exact(field.mesh().connectivity(), field.order(), watch)?;
            let saddles = found.points.iter().filter(|p| p.kind == CriticalKind::Saddle);
            collected(found.points.len(), saddles.map(|p| values[p.vertex as usize]))?
        }
    };
    plan.begin(600 * at.len() as u64)?;
    watch.tick(200 * at.len() as u64)?;
    let at = distinct(&at)?;
    // Those beyond the finite numbers have no lines.
    let width = (offset * range.length()).min(f64::MAX);
    let both = at.iter().flat_map(|&c| [c - width, (c + width).max(c.next_up())]);
    let levels = collected(2 * at.len(), both.filter(|level| level.is_finite()))?;
    watch.tick(200 * levels.len() as u64)?;
    let levels = distinct(&levels)?;
    if levels.len() > MOST_LEVELS {
        let expected = format!(
            "saddles with at most {} different values: name those that matter, or smooth the field first",
            MOST_LEVELS / 2
        );
        return Err(OptionError::InvalidOption { option: "saddles".to_owned(), expected }.into());
    }
    plan.finish()?;
    Ok(levels)
}

/// Ascending, each once.
pub(super) fn distinct(numbers: &[f64]) -> Result<Vec<f64>, OutOfMemory> {
    let (mut sorted, _) = sort(numbers)?;
    sorted.dedup();
    Ok(sorted)
}
