//! What a smoothing did.

use nalgebra_sparse::CscMatrix;

use super::system::{Solution, Solved};
use super::tikhonov::{Channel, Metric, TikhonovOptions};
use super::{Operator, Smoother};
use crate::error::{FieldError, Result};
use crate::field::{CriticalCounts, DeltaOptions, ValueRange, VertexOrder, critical_points};
use crate::mesh::LinkKind;
use crate::solve::{norm, product, quadratic_form};

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
    /// The equation of \[Patane09\] solved, `"fem"` for the finite-element operator.
    pub equation: &'static str,
    /// The trade-off used.
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
    /// ‖x − f‖_B in the metric used.
    pub metric_norm: f64,
    /// ‖Lx‖₂.
    pub laplacian_norm: f64,
    /// fᵀLf, the Sobolev semi-norm S(f) of \[Patane09, section 4.1\].
    pub sobolev_before: f64,
    /// xᵀLx.
    pub sobolev_after: f64,
    /// Constrained critical points whose type survived; `None` without constraints.
    pub preserved: Option<usize>,
    /// Extrema outside of the constrained set; `None` without constraints.
    pub free_extrema: Option<usize>,
    /// Bound on ‖x − x_e‖₂/‖e‖₂ for a perturbation e of f; `None` unless asked for.
    pub perturbation_factor: Option<f64>,
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
    SmoothnessEnergies { sobolev: quadratic_form(laplacian, values), laplacian_norm: norm(&product(laplacian, values)) }
}

/// (value − min)/(max − min); zero for a constant, and at isolated vertices, which take no part in the range.
pub(super) fn normalize(values: &[f64], kinds: &[LinkKind], range: ValueRange) -> Vec<f64> {
    let length = range.length();
    let counts = |kind: LinkKind| length > 0.0 && kind != LinkKind::Isolated;
    values.iter().zip(kinds).map(|(v, &kind)| if counts(kind) { (v - range.min) / length } else { 0.0 }).collect()
}

pub(super) fn tikhonov(
    smoother: &Smoother,
    channel: &Channel,
    solution: &Solution,
    smoothed: &[f64],
    solved: &Solved,
    options: &TikhonovOptions,
) -> Result<SmoothReport> {
    let f = &channel.normalized;
    let x: Vec<f64> = solution.values.iter().zip(f).map(|(x, &f)| x.unwrap_or(f)).collect();
    let difference: Vec<f64> = x.iter().zip(f).map(|(x, f)| x - f).collect();
    let before = energies(&smoother.laplacian, f);
    let after = energies(&smoother.laplacian, &x);
    let counts = |values: &[f64]| -> Result<CriticalCounts> {
        Ok(critical_points(&smoother.mesh, values, &DeltaOptions::default())?.counts)
    };
    Ok(SmoothReport {
        method: "tikhonov",
        equation: match (smoother.options.operator, options.metric) {
            (Operator::Fem, _) => "fem",
            (Operator::Paper, Metric::Identity) => "(3)",
            (Operator::Paper, _) => "(5)",
        },
        epsilon: Some(options.epsilon),
        constraint_count: 0,
        before: counts(&channel.values)?,
        after: counts(smoothed)?,
        l_infinity: difference.iter().fold(0.0, |max, d| if d.abs() > max { d.abs() } else { max }),
        l2: norm(&difference),
        metric_norm: solution.metric_norm,
        laplacian_norm: after.laplacian_norm,
        sobolev_before: before.sobolev,
        sobolev_after: after.sobolev,
        preserved: None,
        free_extrema: None,
        perturbation_factor: None,
        solver: SolverReport {
            route: solved.route,
            precision: solved.precision,
            unknowns: solved.unknowns,
            factor_nonzeros: solved.factor_nonzeros,
            relative_residual: solution.relative_residual,
            refinement_steps: solution.refinement_steps,
            iterations: solution.iterations,
        },
    })
}
