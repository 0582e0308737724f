//! Prescribed extrema beside Clarabel, a solver of others for quadratic programs.

use clarabel::algebra::CscMatrix as Sparse;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT::NonnegativeConeT,
};
use morse_smooth::Watch;
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassOptions, laplacian, mass};
use morse_smooth::smooth::{
    Extrema, Functional, PersistenceOf, PrescribeOptions, PrescribeRoute, Smoother, SmootherOptions, TikhonovOptions,
};
use nalgebra_sparse::CscMatrix;

use crate::prescribe::{check, told};
use crate::support::noise;

const MARGIN: f64 = 1e-6;

/// H and c of Tikhonov smoothing: H = LᵀL + εB, c = εBf.
fn functional(mesh: &TriMesh, epsilon: f64, f: &[f64]) -> (CscMatrix<f64>, Vec<f64>) {
    let l = laplacian(mesh, LaplacianWeights::Cotangent, &Watch::none()).expect("a Laplacian");
    let b = mass(mesh, &MassOptions::default(), &Watch::none()).expect("a mass matrix");
    let h = l.transpose() * &l + &b * epsilon;
    let c = (&b * &nalgebra::DMatrix::from_column_slice(f.len(), 1, f)).column(0) * epsilon;
    (h, c.as_slice().to_vec())
}

/// The least ½xᵀHx − cᵀx with rises of at least `margin` from a to b for all edges.
fn by_clarabel(h: &CscMatrix<f64>, c: &[f64], edges: &[(usize, usize, f64)]) -> Vec<f64> {
    let n = c.len();
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for (i, j, v) in h.triplet_iter().filter(|(i, j, _)| i <= j) {
        rows.push(i);
        columns.push(j);
        values.push(*v);
    }
    let p = Sparse::new_from_triplets(n, n, rows, columns, values);
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for (k, &(a, b, _)) in edges.iter().enumerate() {
        rows.extend([k, k]);
        columns.extend([a, b]);
        values.extend([1.0, -1.0]);
    }
    let a = Sparse::new_from_triplets(edges.len(), n, rows, columns, values);
    let b: Vec<f64> = edges.iter().map(|&(_, _, margin)| -margin).collect();
    let q: Vec<f64> = c.iter().map(|c| -c).collect();
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-12)
        .tol_gap_rel(1e-9)
        .tol_feas(1e-10)
        .build()
        .expect("settings");
    let mut solver = DefaultSolver::new(&p, &q, &a, &b, &[NonnegativeConeT(edges.len())], settings).expect("a program");
    solver.solve();
    assert!(matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved));
    solver.solution.x.clone()
}

/// Of all fields that rise along all edges as the result does, none has less energy: these are fewer than those it was chosen from.
#[test]
fn optima_are_those_of_clarabel() {
    use PersistenceOf::{Input, Smoothed};
    let mut routes = Vec::new();
    for (mesh, epsilon, minima, maxima, of) in [
        (shapes::sphere(3).expect("a sphere"), 0.05, 3, 2, Input),
        (shapes::sphere(4).expect("a sphere"), 0.02, 9, 12, Input),
        (shapes::torus(60, 40, 0.2).expect("a torus"), 0.3, 1, 2, Input),
        (shapes::sphere(4).expect("a sphere"), 30.0, 9, 12, Input),
        (shapes::sphere(4).expect("a sphere"), 10.0, 2, 1, Smoothed),
        (shapes::sphere(4).expect("a sphere"), 0.002, 2, 2, Smoothed),
        (shapes::torus(60, 40, 0.2).expect("a torus"), 0.02, 1, 2, Smoothed),
        (shapes::torus(60, 40, 0.2).expect("a torus"), 0.3, 3, 3, Smoothed),
    ] {
        let random = noise(mesh.vertex_count(), 6);
        let field: Vec<f64> =
            mesh.positions().chunks_exact(3).zip(random).map(|(p, e)| p[0] * p[2] + 0.2 * e).collect();
        let functional_of = Functional::Tikhonov(TikhonovOptions { epsilon, ..TikhonovOptions::default() });
        let extrema = Extrema::Most { minima, maxima, of };
        let options = PrescribeOptions { functional: functional_of, extrema, ..PrescribeOptions::default() };
        let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
        let smoothed = smoother.prescribe(&field, &options).expect("a field");
        check(&mesh, &smoothed);
        routes.push(told(&smoothed).route);
        let [low, high] = [f64::min, f64::max].map(|of| field.iter().copied().fold(field[0], of));
        let normalized = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| (v - low) / (high - low)).collect() };
        let (f, x) = (normalized(&field), normalized(&smoothed.values));
        let edges: Vec<(usize, usize, f64)> = mesh
            .connectivity()
            .edges()
            .iter()
            .map(|&[a, b]| {
                let (a, b) = (a as usize, b as usize);
                let (a, b) = if x[a] < x[b] { (a, b) } else { (b, a) };
                (a, b, (x[b] - x[a]).min(MARGIN))
            })
            .collect();
        let (h, c) = functional(&mesh, epsilon, &f);
        let best = by_clarabel(&h, &c, &edges);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let energy = |x: &[f64]| {
            let image = &h * &nalgebra::DMatrix::from_column_slice(x.len(), 1, x);
            dot(x, image.as_slice()) - 2.0 * dot(&c, x) + dot(&c, &f)
        };
        let (ours, theirs) = (energy(&x), energy(&best));
        assert!((ours - theirs).abs() <= 1e-5 * theirs, "{ours} against {theirs}");
        assert!((ours - told(&smoothed).energy).abs() <= 1e-8 * ours);
    }
    for route in [PrescribeRoute::Dual, PrescribeRoute::InteriorPoint] {
        assert!(routes.iter().filter(|taken| **taken == route).count() >= 2, "{route:?} is tested: {routes:?}");
    }
}
