//! Prescribed extrema on small meshes beside a dense barrier method, in which nothing of the crate is.

use morse_smooth::Watch;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::mesh::{LinkKind, TriMesh};
use morse_smooth::operators::{LaplacianWeights, MassOptions, laplacian, mass};
use morse_smooth::smooth::{
    Extrema, Functional, PersistenceOf, PrescribeOptions, Smoother, SmootherOptions, TikhonovOptions,
};
use nalgebra::{DMatrix, DVector};

use crate::prescribe::{check, told};
use crate::support::random_surface;

/// ½xᵀHx − cᵀx of Tikhonov smoothing with the identity, dense.
fn dense(mesh: &TriMesh, weights: LaplacianWeights, epsilon: f64, f: &[f64]) -> (DMatrix<f64>, DVector<f64>) {
    let n = mesh.vertex_count();
    let l = laplacian(mesh, weights, &Watch::none()).expect("a Laplacian");
    let b = mass(mesh, &MassOptions::default(), &Watch::none()).expect("a mass matrix");
    let (mut dense_l, mut dense_b) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    l.triplet_iter().for_each(|(i, j, v)| dense_l[(i, j)] += v);
    b.triplet_iter().for_each(|(i, j, v)| dense_b[(i, j)] += v);
    let h = dense_l.transpose() * &dense_l + epsilon * &dense_b;
    let c = epsilon * dense_b * DVector::from_column_slice(f);
    (h, c)
}

/// The least ½xᵀHx − cᵀx with rises of at least `margin` from a to b for all of `edges`, by Newton's method with a barrier that is
/// lowered step by step: `start` takes all rises. Nothing of the crate is in it.
fn by_barrier(h: &DMatrix<f64>, c: &DVector<f64>, edges: &[(usize, usize, f64)], start: DVector<f64>) -> DVector<f64> {
    let mut x = start;
    let mut mu = 1.0;
    while mu * edges.len() as f64 > 1e-11 {
        for _ in 0..80 {
            let mut hessian = h.clone();
            let mut gradient = h * &x - c;
            for &(a, b, margin) in edges {
                let slack = x[b] - x[a] - margin;
                let (first, second) = (mu / slack, mu / (slack * slack));
                gradient[b] -= first;
                gradient[a] += first;
                for (i, j, sign) in [(a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)] {
                    hessian[(i, j)] += sign * second;
                }
            }
            let step = hessian.cholesky().expect("a convex barrier").solve(&-&gradient);
            let decrease = -gradient.dot(&step);
            let mut length = 1.0_f64;
            for &(a, b, margin) in edges {
                let (slack, change) = (x[b] - x[a] - margin, step[b] - step[a]);
                if change < 0.0 {
                    length = length.min(0.9 * slack / -change);
                }
            }
            x += length * &step;
            if decrease < 1e-4 * mu {
                break;
            }
        }
        mu *= 0.2;
    }
    x
}

#[test]
fn small_optima_are_those_of_a_dense_barrier_method() {
    for seed in 0..24 {
        let mut random = Random::new(seed);
        let base = shapes::grid(7, 7).expect("a grid");
        let mesh =
            if seed % 2 == 0 { shapes::octahedron().expect("an octahedron") } else { random_surface(seed, &base, 0.1) };
        if mesh.connectivity().link_kinds().contains(&LinkKind::Isolated) {
            continue;
        }
        let field: Vec<f64> = (0..mesh.vertex_count()).map(|_| random.uniform()).collect();
        let [low, high] = [f64::min, f64::max].map(|of| field.iter().copied().fold(field[0], of));
        let normalized: Vec<f64> = field.iter().map(|v| (v - low) / (high - low)).collect();
        let epsilon = [0.02, 0.3, 4.0][(seed % 3) as usize];
        let functional = Functional::Tikhonov(TikhonovOptions { epsilon, ..TikhonovOptions::default() });
        let options = PrescribeOptions {
            functional,
            extrema: Extrema::Most { minima: 1, maxima: 1, of: PersistenceOf::Input },
            complete: true,
            margin: 1e-3,
            ..PrescribeOptions::default()
        };
        let smoothed =
            Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother").prescribe(&field, &options);
        let smoothed = smoothed.expect("a field");
        check(&mesh, &smoothed);
        let report = told(&smoothed);
        let x: Vec<f64> = smoothed.values.iter().map(|v| (v - low) / (high - low)).collect();
        // The result is the best one of all that rise along all edges as it does: these are fewer than it was chosen from.
        let mut ranks: Vec<usize> = (0..x.len()).collect();
        ranks.sort_by(|&a, &b| x[a].total_cmp(&x[b]));
        let edges: Vec<(usize, usize, f64)> = mesh
            .connectivity()
            .edges()
            .iter()
            .map(|&[a, b]| {
                let (a, b) = if x[a as usize] <= x[b as usize] { (a, b) } else { (b, a) };
                let (a, b) = (a as usize, b as usize);
                // A little less, so that there are fields between: neighbours may have the same value, each a step above a third one.
                (a, b, (x[b] - x[a]).min(1e-3) - 1e-9)
            })
            .collect();
        let mut start = DVector::zeros(x.len());
        for (rank, &v) in ranks.iter().enumerate() {
            start[v] = rank as f64;
        }
        let (h, c) = dense(&mesh, LaplacianWeights::Cotangent, epsilon, &normalized);
        let best = by_barrier(&h, &c, &edges, start);
        let constant = c.dot(&DVector::from_column_slice(&normalized));
        let energy = |x: &DVector<f64>| (x.transpose() * &h * x)[(0, 0)] - 2.0 * c.dot(x) + constant;
        let (ours, least) = (energy(&DVector::from_column_slice(&x)), energy(&best));
        assert!((ours - least).abs() <= 1e-6 * least.abs().max(1e-3), "seed {seed}: {ours} against {least}");
        assert!(report.gap <= 1e-6, "seed {seed}: gap {}", report.gap);
        assert!((ours - report.energy).abs() <= 1e-9 * ours, "seed {seed}: energy {ours} told as {}", report.energy);
        assert!(report.unconstrained_energy <= report.energy * (1.0 + 1e-12));
    }
}
