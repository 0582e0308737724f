//! Smoothing by conjugate gradients where it is hard: tiny ε, needles, vertices with very many neighbours.

use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::LaplacianWeights;
use morse_smooth::smooth::{Metric, Smoothed, Smoother, SmootherOptions, SolverChoice, TikhonovOptions};

use crate::iterative::{needles, slivers, wheel};

const METRICS: [Metric; 3] = [Metric::Identity, Metric::Mass, Metric::Lumped];

fn noise(mesh: &TriMesh) -> Vec<f64> {
    let mut random = Random::new(3);
    (0..mesh.vertex_count()).map(|_| random.signed()).collect()
}

fn smooth(mesh: &TriMesh, weights: LaplacianWeights, solver: SolverChoice, options: &TikhonovOptions) -> Smoothed {
    let mut smoother = Smoother::new(mesh, SmootherOptions { weights, solver, ..SmootherOptions::default() }).unwrap();
    smoother.tikhonov(&noise(mesh), options).unwrap_or_else(|error| panic!("{options:?}: {error}"))
}

/// Compares with the direct solver; the number of iterations.
fn compare(mesh: &TriMesh, epsilon: f64, metric: Metric, accuracy: f64) -> usize {
    let options = TikhonovOptions { epsilon, metric, ..TikhonovOptions::default() };
    let direct = smooth(mesh, LaplacianWeights::Cotangent, SolverChoice::Cholesky, &options);
    let found = smooth(mesh, LaplacianWeights::Cotangent, SolverChoice::ConjugateGradient, &options);
    let wrong = direct.values.iter().zip(&found.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(wrong < accuracy, "{epsilon:e} {metric:?}: {wrong:e}");
    found.reports[0].solver.iterations
}

#[test]
fn few_iterations_for_every_epsilon() {
    let torus = shapes::torus(50, 30, 0.4).unwrap();
    for metric in METRICS {
        for epsilon in [1e2, 1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
            let iterations = compare(&torus, epsilon, metric, 1e-11);
            assert!(iterations < 60, "{epsilon:e} {metric:?}: {iterations}");
        }
    }
}

#[test]
fn needles_do_not_stop_it() {
    for epsilon in [1.0, 1e-3] {
        for metric in METRICS {
            let iterations = compare(&slivers(40, 1e-5), epsilon, metric, 1e-8);
            assert!(iterations < 60, "{epsilon:e} {metric:?}: {iterations}");
            compare(&needles(25), epsilon, metric, 1e-8);
        }
    }
}

#[test]
fn a_vertex_with_very_many_neighbours() {
    // LᵀL would have 400 million entries.
    let wheel = wheel(20_000);
    for weights in [LaplacianWeights::Cotangent, LaplacianWeights::Uniform] {
        for metric in METRICS {
            let options = TikhonovOptions { epsilon: 1e-2, metric, ..TikhonovOptions::default() };
            let report = &smooth(&wheel, weights, SolverChoice::ConjugateGradient, &options).reports[0];
            assert!(report.solver.iterations < 60, "{metric:?}: {}", report.solver.iterations);
        }
    }
}
