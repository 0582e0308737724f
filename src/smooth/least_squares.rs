//! Least squares with constraints, eq. (7) of \[Patane09\].

use super::channels::Channels;
use super::constraints::{ConstraintSet, Constraints, LeftOut};
use super::regularized::{self, Regularization};
use super::report::Smoothed;
use super::system::Attraction;
use super::tikhonov::check_epsilon;
use super::{Progress, Smoother};
use crate::error::{Result, SmoothError};
use crate::field::Features;

/// Options of [`Smoother::least_squares`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSquaresOptions<'a> {
    /// Which vertices are pulled towards their values.
    pub constraints: Constraints<'a>,
    /// How strongly: large fits the constrained values, small smooths. Positive and finite.
    pub epsilon: f64,
    /// Weights of the constrained vertices, positive and finite: for [`Features::Vertices`] without stars one for each vertex as
    /// they are listed (of a vertex that is listed twice the larger one counts), else one for each constrained vertex in
    /// ascending order. Default 1 each.
    pub weights: Option<&'a [f64]>,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`.
    pub channels: usize,
}

pub(super) fn run(
    smoother: &mut Smoother,
    values: &[f64],
    options: &LeastSquaresOptions<'_>,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    check_epsilon(options.epsilon)?;
    let channels = Channels::new(&smoother.mesh, values, options.channels)?;
    let set = ConstraintSet::new(&smoother.mesh, &channels, &options.constraints)?;
    let left_out = LeftOut::new(smoother.reach(), &set, options.constraints.unconstrained)?;
    let weights = weights(&set, options)?;
    let request = Regularization {
        method: "leastSquares",
        equation: "(7)",
        epsilon: options.epsilon,
        attraction: Attraction::Constraints { vertices: set.vertices.clone(), weights },
        constraints: Some((&set, left_out)),
    };
    regularized::run(smoother, &channels, &request, progress)
}

/// One weight for each constrained vertex in ascending order.
fn weights(set: &ConstraintSet, options: &LeastSquaresOptions<'_>) -> Result<Vec<f64>, SmoothError> {
    let Some(given) = options.weights else { return Ok(vec![1.0; set.vertices.len()]) };
    let listed = match options.constraints.features {
        Features::Vertices(vertices) if !options.constraints.stars => vertices,
        _ => &set.vertices,
    };
    if given.len() != listed.len() {
        return Err(SmoothError::LengthMismatch { expected: listed.len(), actual: given.len() });
    }
    let mut weights = vec![0.0_f64; set.vertices.len()];
    for (index, (&vertex, &weight)) in listed.iter().zip(given).enumerate() {
        if !(weight.is_finite() && weight > 0.0) {
            return Err(SmoothError::InvalidWeight { index, vertex });
        }
        if let Ok(place) = set.vertices.binary_search(&vertex) {
            weights[place] = weights[place].max(weight);
        }
    }
    Ok(weights)
}
