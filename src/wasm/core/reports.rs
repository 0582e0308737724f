//! Reports as plain objects; what there is none of is null.

use js_sys::{Array, Object};
use nalgebra_sparse::CscMatrix;
use wasm_bindgen::JsValue;

use crate::error::OutOfMemory;
use crate::field::CriticalCounts;
use crate::mesh::MeshTopology;
use crate::smooth::{
    ChosenEpsilon, MaximumPrinciple, PrescribedReport, SmoothReport, SmoothnessEnergies, SolverReport,
};
use crate::wasm::shared::answer::Answer;

pub(super) fn topology(topology: &MeshTopology) -> Object {
    let answer = Answer::new();
    answer.number("eulerCharacteristic", topology.euler_characteristic as f64);
    answer.count("components", topology.components);
    answer.count("boundaryLoops", topology.boundary_loops);
    answer.flag("closed", topology.closed);
    answer.flag("orientable", topology.orientable);
    answer.optional("genus", topology.genus.map(|genus| genus as f64));
    answer.count("nonManifoldEdges", topology.non_manifold_edges);
    answer.count("nonManifoldVertices", topology.non_manifold_vertices);
    answer.count("isolatedVertices", topology.isolated_vertices);
    answer.count("degenerateTriangles", topology.degenerate_triangles);
    answer.object()
}

pub(super) fn counts(counts: &CriticalCounts) -> Answer {
    let answer = Answer::new();
    answer.number("minima", f64::from(counts.minima));
    answer.number("maxima", f64::from(counts.maxima));
    answer.number("saddles", f64::from(counts.saddles));
    answer.optional("indexSum", counts.index_sum.map(|sum| sum as f64));
    answer
}

pub(super) fn energies(energies: &SmoothnessEnergies) -> Object {
    let answer = Answer::new();
    answer.number("sobolev", energies.sobolev);
    answer.number("laplacianNorm", energies.laplacian_norm);
    answer.object()
}

pub(super) fn smoothing(report: &SmoothReport) -> Object {
    let answer = Answer::new();
    let optional_count = |name: &str, count: Option<usize>| answer.optional(name, count.map(|count| count as f64));
    answer.text("method", report.method.name());
    answer.text("equation", report.equation.name());
    answer.optional("epsilon", report.epsilon);
    answer.count("constraintCount", report.constraint_count);
    answer.part("before", counts(&report.before));
    answer.part("after", counts(&report.after));
    answer.number("lInfinity", report.l_infinity);
    answer.number("l2", report.l2);
    answer.number("metricNorm", report.metric_norm);
    answer.number("laplacianNorm", report.laplacian_norm);
    answer.number("sobolevBefore", report.sobolev_before);
    answer.number("sobolevAfter", report.sobolev_after);
    optional_count("constrainedCriticalPoints", report.constrained_critical_points);
    optional_count("preserved", report.preserved);
    optional_count("freeExtrema", report.free_extrema);
    answer.optional("perturbationFactor", report.perturbation_factor);
    match &report.maximum_principle {
        Some(principle) => answer.part("maximumPrinciple", maximum_principle(principle)),
        None => answer.set("maximumPrinciple", &JsValue::NULL),
    }
    match &report.choice {
        Some(choice) => answer.part("choice", chosen(choice)),
        None => answer.set("choice", &JsValue::NULL),
    }
    answer.part("solver", solver(&report.solver));
    answer.object()
}

/// An ε with the reason why it was chosen.
pub(super) fn chosen(choice: &ChosenEpsilon) -> Answer {
    let answer = Answer::new();
    answer.number("epsilon", choice.epsilon);
    answer.text("rule", choice.rule.name());
    answer.text("reason", &choice.reason);
    let runners_up: Array = choice.runners_up.iter().map(|&epsilon| JsValue::from_f64(epsilon)).collect();
    answer.set("runnersUp", &runners_up);
    match &choice.noise {
        Some(noise) => {
            let level = Answer::new();
            level.number("standardDeviation", noise.standard_deviation);
            level.number("byDifferences", noise.by_differences);
            level.text("confidence", noise.confidence.name());
            answer.part("noise", level);
        }
        None => answer.set("noise", &JsValue::NULL),
    }
    answer
}

/// What is told of prescribed extrema, beside the values.
pub(super) fn prescribed(answer: &Answer, report: &PrescribedReport) {
    answer.array("minima", &report.minima);
    answer.array("maxima", &report.maxima);
    answer.array("unavoidable", &report.unavoidable);
    answer.number("energy", report.energy);
    answer.number("unconstrainedEnergy", report.unconstrained_energy);
    answer.number("leastSlack", report.least_slack);
    answer.number("margin", report.margin);
    answer.number("gap", report.gap);
    answer.count("iterations", report.iterations);
    answer.count("solves", report.solves);
    answer.text("route", report.route.name());
}

fn maximum_principle(principle: &MaximumPrinciple) -> Answer {
    let answer = Answer::new();
    answer.number("smallestWeight", principle.smallest_weight);
    answer.count("extrema", principle.extrema);
    answer.count("meshExtrema", principle.mesh_extrema);
    answer
}

fn solver(report: &SolverReport) -> Answer {
    let answer = Answer::new();
    answer.text("route", report.route.name());
    answer.text("precision", report.precision.name());
    answer.count("unknowns", report.unknowns);
    answer.number("factorNonzeros", report.factor_nonzeros as f64);
    answer.number("relativeResidual", report.relative_residual);
    answer.count("refinementSteps", report.refinement_steps);
    answer.count("iterations", report.iterations);
    answer
}

/// Compressed sparse columns as in the types.
#[inline(never)]
pub(super) fn sparse(matrix: &CscMatrix<f64>) -> Result<Object, OutOfMemory> {
    let answer = Answer::new();
    answer.count("rows", matrix.nrows());
    answer.count("columns", matrix.ncols());
    narrow(&answer, "columnPointers", matrix.col_offsets());
    narrow(&answer, "rowIndices", matrix.row_indices());
    answer.array("values", matrix.values());
    answer.finish()
}

fn narrow(answer: &Answer, name: &str, values: &[usize]) {
    answer.column(name, values.len(), &|k| values[k] as u32);
}
