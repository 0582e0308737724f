//! What a smoothing did.

use nalgebra_sparse::CscMatrix;

use super::Smoother;
use super::channels::Channel;
use super::constraints::ConstraintSet;
use super::maximum_principle::MaximumPrinciple;
use super::routes::difference;
use super::system::{Solution, Solved};
use crate::error::{FieldError, Result};
use crate::field::{
    CriticalCounts, CriticalKind, CriticalPoint, CriticalPoints, DeltaOptions, ScalarField, VertexOrder,
    critical_points,
};
use crate::solve::{norm, product};
use crate::support::watch::Watch;

/// Smoothed values and their reports.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothed {
    /// As long and interleaved as the input, in its units.
    pub values: Vec<f64>,
    /// One per channel.
    pub reports: Vec<SmoothReport>,
}

/// What a smoothing did to one channel. Norms and errors are of the field normalised to [0, 1] by the range of the input.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct SmoothReport {
    /// Name of the method.
    pub method: &'static str,
    /// The equation of \[Patane09\] solved, `"fem"` for the finite-element operator, or the reference of a filter.
    pub equation: &'static str,
    /// The trade-off used; `None` where there is none.
    pub epsilon: Option<f64>,
    /// Number of constrained vertices.
    pub constraint_count: usize,
    /// Critical points of the input at δ = 0.
    pub before: CriticalCounts,
    /// Critical points of the values returned at δ = 0.
    pub after: CriticalCounts,
    /// max |x − f|.
    pub l_infinity: f64,
    /// ‖x − f‖₂.
    pub l2: f64,
    /// ‖x − f‖_B in the metric used: for least squares (Σ w(x − f)²)^½ over the constrained vertices with their weights w.
    pub metric_norm: f64,
    /// ‖Lx‖₂.
    pub laplacian_norm: f64,
    /// fᵀLf, the Sobolev semi-norm S(f) of \[Patane09, section 4.1\].
    pub sobolev_before: f64,
    /// xᵀLx.
    pub sobolev_after: f64,
    /// Critical points of the input among the feature points, without their stars; `None` without constraints.
    pub constrained_critical_points: Option<usize>,
    /// Those of them that are critical points of the same type and multiplicity still.
    pub preserved: Option<usize>,
    /// Extrema outside of the constrained set; `None` without constraints.
    pub free_extrema: Option<usize>,
    /// Bound on ‖x − x_e‖₂/‖e‖₂ for a perturbation e of f (of the constrained values, for interpolation): \[Patane09, sections
    /// 4.2 and 4.3\]. `None` unless asked for, for the bilateral filter, which is not linear, and where rounding hides it.
    pub perturbation_factor: Option<f64>,
    /// For harmonic interpolation.
    pub maximum_principle: Option<MaximumPrinciple>,
    /// How the system was solved.
    pub solver: SolverReport,
}

/// How a system was solved.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct SolverReport {
    /// `"complexCholesky"` or `"cholesky"`: a factor, complex on the pattern of L or real on that of LᵀL;
    /// `"cgComplexCholesky"`: conjugate gradients preconditioned by the complex factor; `"cgMultigrid"`, `"cgJacobi"`:
    /// without a factor; `"none"` where there was nothing to solve.
    pub route: &'static str,
    /// `"double"`, `"single"`, or `"doubleAfterSingle"` where single precision was asked for and was not enough.
    pub precision: &'static str,
    /// Size of the system.
    pub unknowns: usize,
    /// Entries of the factor.
    pub factor_nonzeros: u64,
    /// ‖b − Ax‖₂/‖b‖₂ with the matrix in factored form.
    pub relative_residual: f64,
    /// Refinement steps taken.
    pub refinement_steps: usize,
    /// Iterations of an iterative solver.
    pub iterations: usize,
}

/// fᵀLf and ‖Lf‖₂.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct SmoothnessEnergies {
    /// fᵀLf, the Sobolev semi-norm S(f) of \[Patane09, section 4.1\].
    pub sobolev: f64,
    /// ‖Lf‖₂.
    pub laplacian_norm: f64,
}

/// Measures how smooth values are, as they are given: nothing is normalised.
///
/// # Errors
/// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`, the last also where the result overflows.
pub fn smoothness(laplacian: &CscMatrix<f64>, values: &[f64]) -> Result<SmoothnessEnergies, FieldError> {
    VertexOrder::new(values, laplacian.ncols())?;
    let energies = energies(laplacian, values);
    if energies.sobolev.is_finite() && energies.laplacian_norm.is_finite() {
        Ok(energies)
    } else {
        Err(FieldError::RangeOverflow {})
    }
}

fn energies(laplacian: &CscMatrix<f64>, values: &[f64]) -> SmoothnessEnergies {
    let image = product(laplacian, values);
    let sobolev = image.iter().zip(values).map(|(a, b)| a * b).sum();
    SmoothnessEnergies { sobolev, laplacian_norm: norm(&image) }
}

/// What only the method knows of a result.
pub(super) struct Facts<'a> {
    pub(super) method: &'static str,
    pub(super) equation: &'static str,
    pub(super) epsilon: Option<f64>,
    pub(super) constraints: Option<&'a ConstraintSet>,
    /// ‖x − f‖_B; nothing for the identity.
    pub(super) metric_norm: Option<f64>,
    pub(super) perturbation_factor: Option<f64>,
    pub(super) maximum_principle: Option<MaximumPrinciple>,
    pub(super) solver: SolverReport,
}

/// Measures a result: x normalised, and the same in the units of the input.
pub(super) fn measure(
    smoother: &Smoother,
    channel: &Channel,
    x: &[f64],
    smoothed: &[f64],
    facts: Facts<'_>,
) -> Result<SmoothReport> {
    let f = &channel.normalized;
    let difference = difference(x, f);
    let energies_before = energies(&smoother.laplacian, f);
    let energies_after = energies(&smoother.laplacian, x);
    let exact = |values: &[f64]| {
        critical_points(&ScalarField::new(&smoother.mesh, values)?, &DeltaOptions::default(), &Watch::none())
    };
    let (before, after) = (exact(&channel.values)?, exact(smoothed)?);
    let kept = facts.constraints.map(|set| Kept::new(set, &before, &after));
    let l2 = norm(&difference);
    Ok(SmoothReport {
        method: facts.method,
        equation: facts.equation,
        epsilon: facts.epsilon,
        constraint_count: facts.constraints.map_or(0, |set| set.vertices.len()),
        before: before.counts,
        after: after.counts,
        l_infinity: largest(&difference),
        l2,
        metric_norm: facts.metric_norm.unwrap_or(l2),
        laplacian_norm: energies_after.laplacian_norm,
        sobolev_before: energies_before.sobolev,
        sobolev_after: energies_after.sobolev,
        constrained_critical_points: kept.as_ref().map(|kept| kept.constrained),
        preserved: kept.as_ref().map(|kept| kept.preserved),
        free_extrema: kept.as_ref().map(|kept| kept.free_extrema),
        perturbation_factor: facts.perturbation_factor,
        maximum_principle: facts.maximum_principle,
        solver: facts.solver,
    })
}

fn largest(values: &[f64]) -> f64 {
    let mut largest = 0.0_f64;
    for v in values {
        largest = if v.abs() > largest { v.abs() } else { largest };
    }
    largest
}

/// What became of critical points under constraints.
struct Kept {
    constrained: usize,
    preserved: usize,
    free_extrema: usize,
}

impl Kept {
    fn new(set: &ConstraintSet, before: &CriticalPoints, after: &CriticalPoints) -> Self {
        let is_feature = |vertex: u32| set.features.binary_search(&vertex).is_ok();
        let (mut constrained, mut preserved) = (0, 0);
        for point in before.points.iter().filter(|point| is_feature(point.vertex)) {
            constrained += 1;
            let place = after.points.binary_search_by_key(&point.vertex, |other| other.vertex);
            preserved += usize::from(place.is_ok_and(|place| {
                let other = &after.points[place];
                (other.kind, other.multiplicity) == (point.kind, point.multiplicity)
            }));
        }
        let is_free = |point: &&CriticalPoint| {
            point.kind != CriticalKind::Saddle && set.vertices.binary_search(&point.vertex).is_err()
        };
        Self { constrained, preserved, free_extrema: after.points.iter().filter(is_free).count() }
    }
}

impl SolverReport {
    /// Of one channel.
    pub(super) fn new(solved: &Solved, solution: &Solution) -> Self {
        Self {
            route: solved.route,
            precision: solved.precision,
            unknowns: solved.unknowns,
            factor_nonzeros: solved.factor_nonzeros,
            relative_residual: solution.relative_residual,
            refinement_steps: solution.refinement_steps,
            iterations: solution.iterations,
        }
    }

    /// Of a method that solves no system, or of one where there was nothing to solve.
    pub(super) fn none(iterations: usize) -> Self {
        Self {
            route: "none",
            precision: "double",
            unknowns: 0,
            factor_nonzeros: 0,
            relative_residual: 0.0,
            refinement_steps: 0,
            iterations,
        }
    }
}
