//! Least squares with constraints, eq. (7) of \[Patane09\].

use super::constrained;
use super::regularized::{Regularization, Regularized, term};
use crate::error::{Result, SmoothError};
use crate::field::{Features, Missing};
#[cfg(doc)]
use crate::smooth::Smoother;
use crate::smooth::constraints::{ConstraintSet, Constraints, leave_out_constant_components};
use crate::smooth::data_term::Norm;
use crate::smooth::input::Input;
use crate::smooth::names::{Equation, MethodName};
use crate::smooth::report::{About, Smoothed};
use crate::smooth::run::run;
use crate::smooth::schedule::{Forecast, Schedule, Stages, Work};
use crate::smooth::systems::Systems;
use crate::support::watch::Watch;

/// Options of [`Smoother::least_squares`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSquaresOptions<'a> {
    /// Which vertices are fitted to their values. Default none.
    pub constraints: Constraints<'a>,
    /// The trade-off: large fits the constrained values, small smooths. Positive and finite. Default 0.05.
    pub epsilon: f64,
    /// Weights of the constrained vertices, positive and finite: for [`Features::Vertices`] without stars one for each vertex as
    /// they are listed (of a vertex that is listed twice the larger one counts), else one for each constrained vertex in
    /// ascending order. Default 1 each.
    pub weights: Option<&'a [f64]>,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`. Default 1.
    pub channels: usize,
    /// What NaN means. Default an error.
    pub missing: Missing,
}

impl Default for LeastSquaresOptions<'_> {
    fn default() -> Self {
        Self {
            constraints: Constraints::default(),
            epsilon: 0.05,
            weights: None,
            channels: 1,
            missing: Missing::default(),
        }
    }
}

pub(in crate::smooth) fn start(
    input: &Input<'_>,
    systems: &mut Systems,
    options: &LeastSquaresOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Smoothed> {
    let operators = input.operators;
    let schedule = Schedule::new(&Forecast {
        rule: options.constraints.is_rule(),
        work: Work::expected(operators.options, operators.is_symmetric(), true),
        analysis: !systems.is_analysed(),
        factorization: true,
        groups: input.channels.group_count(),
    });
    let mut stages = schedule.stages(watch);
    let Regularization { about, mut unknowns, term } = regularization(input, options, &mut stages)?;
    let leave_out = |set| leave_out_constant_components(&operators.active, set, &mut unknowns);
    let constant = about.constraints.as_ref().map_or(0, leave_out);
    let system = systems.regularized(operators, &unknowns, &term, watch)?;
    let mut procedure = Regularized { system, epsilon: options.epsilon, options: operators.options, constant };
    run(input, &about, &mut procedure, stages)
}

/// What is solved, whatever ε is.
pub(in crate::smooth) fn regularization(
    input: &Input<'_>,
    options: &LeastSquaresOptions<'_>,
    stages: &mut Stages<'_, '_>,
) -> Result<Regularization> {
    let operators = input.operators;
    let (set, components) = constrained(input, &options.constraints, stages)?;
    let norm = Norm::Weights { vertices: set.vertices.clone(), weights: weights(&set, options)? };
    let unknowns = components.remaining(&operators.active);
    // The weights are zero where values are missing, as no such vertex is constrained.
    let about = About {
        method: MethodName::LeastSquares,
        equation: Equation::LeastSquares,
        epsilon: Some(options.epsilon),
        constraints: Some(set),
        unconstrained: Some(components),
    };
    Ok(Regularization { about, unknowns, term: term(norm, None) })
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
