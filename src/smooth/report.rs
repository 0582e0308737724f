//! What a smoothing did.

use nalgebra_sparse::CscMatrix;

use super::channels::Channel;
use super::choice::ChosenEpsilon;
use super::constraints::ConstraintSet;
use super::input::Input;
use super::maximum_principle::MaximumPrinciple;
use super::missing::Part;
use super::names::{Equation, MethodName, Route, UsedPrecision};
use super::operators::Operators;
use super::prescribed::PrescribedReport;
use super::routes::difference;
use super::system::{Solution, Solved};
use super::unconstrained::UnconstrainedComponents;
use crate::error::{FieldError, MeshError, Result};
use crate::field::{
    CriticalCounts, CriticalKind, CriticalPoint, CriticalPoints, DeltaOptions, ScalarField, critical_points,
};
use crate::solve::{norm, product};
use crate::support::watch::Watch;

/// Smoothed values and their reports.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothed {
    /// As long and interleaved as the input, in its units. NaN where a value is missing and was not filled in.
    pub values: Vec<f64>,
    /// One per channel.
    pub reports: Vec<SmoothReport>,
}

/// What a smoothing did to one channel. Norms and errors are of the field normalised to [0, 1] by the range of the input.
///
/// Where missing values were left out, all is about the part of the mesh that has values. Where they were filled in, differences are
/// taken over the vertices that had a value, what was *before* is about the triangles whose three vertices had one, and what is
/// *after* about all that have one now.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
#[non_exhaustive]
pub struct SmoothReport {
    /// The method.
    pub method: MethodName,
    /// The equation solved, or the reference of a filter.
    pub equation: Equation,
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
    /// How ε was chosen, where a rule did it.
    pub choice: Option<ChosenEpsilon>,
    /// What became of prescribed extrema; `None` for other methods.
    pub prescribed: Option<PrescribedReport>,
    /// For harmonic interpolation.
    pub maximum_principle: Option<MaximumPrinciple>,
    /// How the system was solved.
    pub solver: SolverReport,
}

/// How a system was solved.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
#[non_exhaustive]
pub struct SolverReport {
    /// The route that led to the solution.
    pub route: Route,
    /// The precision of the factor.
    pub precision: UsedPrecision,
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

/// How smooth a field is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct SmoothnessEnergies {
    /// fᵀLf, the Sobolev semi-norm S(f) of \[Patane09, section 4.1\].
    pub sobolev: f64,
    /// ‖Lf‖₂.
    pub laplacian_norm: f64,
}

/// Measures how smooth a field is, its values as they are given: nothing is normalised. Where values are missing, the Laplacian is
/// that of the part of the mesh that has values: [`ScalarField::mesh`].
///
/// # Errors
/// `LengthMismatch` for a Laplacian of another size; `RangeOverflow` where the result overflows.
pub fn smoothness(laplacian: &CscMatrix<f64>, field: &ScalarField<'_>) -> Result<SmoothnessEnergies, FieldError> {
    let values = field.values();
    if values.len() != laplacian.ncols() {
        return Err(FieldError::length_mismatch(laplacian.ncols(), values.len(), 0));
    }
    let energies = energies(laplacian, values);
    if energies.sobolev.is_finite() && energies.laplacian_norm.is_finite() {
        Ok(energies)
    } else {
        Err(FieldError::RangeOverflow {})
    }
}

pub(super) fn energies(laplacian: &CscMatrix<f64>, values: &[f64]) -> SmoothnessEnergies {
    let image = product(laplacian, values);
    let sobolev = image.iter().zip(values).map(|(a, b)| a * b).sum();
    SmoothnessEnergies { sobolev, laplacian_norm: norm(&image) }
}

/// What reports say of a method, and what it leaves to the loop over channels.
#[derive(Debug, Clone)]
pub(super) struct About {
    pub(super) method: MethodName,
    pub(super) equation: Equation,
    pub(super) epsilon: Option<f64>,
    pub(super) constraints: Option<ConstraintSet>,
    /// The components that the equations do not determine, for methods that have such.
    pub(super) unconstrained: Option<UnconstrainedComponents>,
}

/// What only the method can measure.
#[derive(Default)]
pub(super) struct Measures {
    /// ‖x − f‖_B; nothing for the identity.
    pub(super) metric_norm: Option<f64>,
    pub(super) maximum_principle: Option<MaximumPrinciple>,
    pub(super) prescribed: Option<PrescribedReport>,
}

/// What only the method knows of a result.
pub(super) struct Facts {
    pub(super) measures: Measures,
    pub(super) perturbation_factor: Option<f64>,
    pub(super) solver: SolverReport,
}

/// What is measured of a field on a mesh or a part of one.
struct Side {
    points: CriticalPoints,
    energies: SmoothnessEnergies,
}

impl Side {
    fn new(operators: &Operators, values: &[f64], normalized: &[f64], watch: &Watch<'_>) -> Result<Self> {
        watch.tick(6 * operators.laplacian.nnz() as u64)?;
        let energies = energies(&operators.laplacian, normalized);
        let field = ScalarField::new(&operators.mesh, values)?;
        let points = critical_points(&field, &DeltaOptions::default(), watch)?;
        Ok(Self { points, energies })
    }

    /// On the part of a mesh that has values; vertices are those of the whole.
    fn of_part(part: &Part, values: &[f64], normalized: &[f64], watch: &Watch<'_>) -> Result<Self> {
        let (values, normalized) = (part.known.gather(values, 1), part.known.gather(normalized, 1));
        let mut side = Self::new(&part.operators, &values, &normalized, watch)?;
        for point in &mut side.points.points {
            point.vertex = part.known.vertices[point.vertex as usize];
        }
        Ok(side)
    }

    /// Where no triangle has three values.
    fn empty() -> Self {
        let counts = CriticalCounts { minima: 0, maxima: 0, saddles: 0, index_sum: Some(0) };
        let energies = SmoothnessEnergies { sobolev: 0.0, laplacian_norm: 0.0 };
        Self { points: CriticalPoints { points: Vec::new(), counts }, energies }
    }
}

/// Measures a result: x normalised, and the same in the units of the input.
pub(super) fn measure(
    input: &Input<'_>,
    about: &About,
    channel: &Channel,
    x: &[f64],
    smoothed: &[f64],
    facts: Facts,
    watch: &Watch<'_>,
) -> Result<SmoothReport> {
    let Input { operators, gaps, .. } = input;
    let f = &channel.normalized;
    let mut difference = difference(x, f);
    let before = match gaps {
        None => Side::new(operators, &channel.values, f, watch)?,
        Some(gaps) => {
            gaps.missing.iter().for_each(|&v| difference[v as usize] = 0.0);
            match gaps.part {
                Some(part) => Side::of_part(part, &channel.values, f, watch)?,
                None => Side::empty(),
            }
        }
    };
    let unfilled: Vec<u32> = match gaps {
        None => Vec::new(),
        Some(gaps) => gaps.missing.iter().copied().filter(|&v| smoothed[v as usize].is_nan()).collect(),
    };
    let after = if unfilled.is_empty() {
        Side::new(operators, smoothed, x, watch)?
    } else {
        match Part::without(&operators.mesh, &unfilled, operators.options, watch)? {
            Some(part) => Side::of_part(&part, smoothed, x, watch)?,
            None => return Err(MeshError::EmptyMesh { vertices: 0, triangles: 0 }.into()),
        }
    };
    let kept = about.constraints.as_ref().map(|set| Kept::new(set, &before.points, &after.points));
    let l2 = norm(&difference);
    Ok(SmoothReport {
        method: about.method,
        equation: about.equation,
        epsilon: about.epsilon,
        constraint_count: about.constraints.as_ref().map_or(0, |set| set.vertices.len()),
        before: before.points.counts,
        after: after.points.counts,
        l_infinity: largest(&difference),
        l2,
        metric_norm: facts.measures.metric_norm.unwrap_or(l2),
        laplacian_norm: after.energies.laplacian_norm,
        sobolev_before: before.energies.sobolev,
        sobolev_after: after.energies.sobolev,
        constrained_critical_points: kept.as_ref().map(|kept| kept.constrained),
        preserved: kept.as_ref().map(|kept| kept.preserved),
        free_extrema: kept.as_ref().map(|kept| kept.free_extrema),
        perturbation_factor: facts.perturbation_factor,
        choice: None,
        prescribed: facts.measures.prescribed,
        maximum_principle: facts.measures.maximum_principle,
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
    /// How one channel of a system was solved.
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

    /// What a method reports that solves no system.
    pub(super) fn none(iterations: usize) -> Self {
        Self {
            route: Route::None,
            precision: UsedPrecision::Double,
            unknowns: 0,
            factor_nonzeros: 0,
            relative_residual: 0.0,
            refinement_steps: 0,
            iterations,
        }
    }
}
