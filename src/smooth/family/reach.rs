//! What the data term reaches of a field.

use super::small::dot;
use crate::smooth::active::ActiveVertices;
use crate::smooth::data_term::Mass;
use crate::smooth::system::Matrices;

/// What counts of the unknowns where a field is compared with its data: all alike, or what the data term reaches, by its weights.
pub(super) fn counted(mass: &Mass) -> Option<Vec<f64>> {
    if !mass.has_gaps() {
        return None;
    }
    match mass {
        Mass::Diagonal(weights) => Some(weights.clone()),
        Mass::Identity | Mass::Matrix(_) => None,
        Mass::Partial(matrix) => {
            Some((0..matrix.ncols()).map(|i| f64::from(u8::from(mass.diagonal(i) > 0.0))).collect())
        }
    }
}

/// The limit of the solutions for ε → 0: on every component the mean of the field in the data term's norm.
pub(super) fn kernel(field_mass: &[f64], matrices: &Matrices, active: &ActiveVertices) -> Vec<f64> {
    let unknowns = matrices.unknowns();
    let ones = matrices.mass().times(&vec![1.0; unknowns.len()]);
    let mut sums = vec![(0.0, 0.0); active.first_vertices().len()];
    for ((&v, load), one) in unknowns.iter().zip(field_mass).zip(&ones) {
        if let Some(component) = active.component(v) {
            sums[component].0 += load;
            sums[component].1 += one;
        }
    }
    let mean = |&v: &u32| match active.component(v).map(|component| sums[component]) {
        Some((load, mass)) if mass > 0.0 => load / mass,
        _ => 0.0,
    };
    unknowns.iter().map(mean).collect()
}

/// What the means of the components have of the traces by these probes, on average, and what they have in truth.
pub(super) fn kernel_of_traces(probes: &[Vec<f64>], matrices: &Matrices, active: &ActiveVertices) -> (f64, f64) {
    let of_probe = |z: &Vec<f64>| dot(z, &kernel(&matrices.mass().times(z), matrices, active));
    let by_probes = probes.iter().map(of_probe).sum::<f64>() / probes.len().max(1) as f64;
    let mut is_there = vec![false; active.first_vertices().len()];
    for component in matrices.unknowns().iter().filter_map(|&v| active.component(v)) {
        is_there[component] = true;
    }
    (by_probes, is_there.into_iter().filter(|&there| there).count() as f64)
}
