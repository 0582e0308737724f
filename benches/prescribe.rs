//! Times of prescribed extrema beside Clarabel's on a quadratic program of the same size, natively:
//! `cargo bench --bench prescribe -- --size 10k,30k`.
//!
//! Clarabel gets H, c and the steps: from the lowest neighbour, to the highest one, and around the chosen extrema, in the order of the
//! result. `prescribe` finds these and smooths in its time, too.
#![allow(clippy::expect_used, clippy::print_stdout, reason = "a bench fails by panicking and prints what it measured")]

use std::time::Instant;

use clarabel::algebra::CscMatrix as Sparse;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SupportedConeT::NonnegativeConeT};
use morse_smooth::Watch;
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassOptions, laplacian, mass};
use morse_smooth::smooth::{
    Extrema, Functional, PersistenceOf, PrescribeOptions, Smoother, SmootherOptions, TikhonovOptions,
};
use nalgebra_sparse::CscMatrix;

const EPSILON: f64 = 0.05;
const MARGIN: f64 = 1e-6;
/// Rounds of which the shortest time counts.
const ROUNDS: usize = 3;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let place = arguments.iter().position(|argument| argument == "--size");
    let sizes = place.and_then(|place| arguments.get(place + 1)).map_or("10k,30k", |value| value);
    println!("ε = {EPSILON}, the most persistent extrema of the input; shortest of {ROUNDS}, in seconds");
    println!("vertices  extrema     route          prescribe  Clarabel  ratio  energies differ by");
    for size in sizes.split(',') {
        let thousands: f64 = size.trim_end_matches('k').parse().expect("--size: thousands of vertices, such as 10k");
        let across = (1000.0 * thousands / 1.6).sqrt().round() as u32;
        let mesh = shapes::torus(across * 8 / 5, across, 0.3).expect("a torus");
        measure(&mesh);
    }
}

/// Waves and noise.
fn field(mesh: &TriMesh) -> Vec<f64> {
    let mut state = 7_u64;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let wave = |p: &[f64]| (2.0 * p[0]).sin() + (3.0 * p[1]).cos() + 0.7 * p[2];
    let values: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| wave(p) + 0.3 * noise()).collect();
    let [low, high] = [f64::min, f64::max].map(|of| values.iter().copied().fold(values[0], of));
    values.iter().map(|value| (value - low) / (high - low)).collect()
}

fn measure(mesh: &TriMesh) {
    let field = field(mesh);
    let tikhonov = TikhonovOptions { epsilon: EPSILON, ..TikhonovOptions::default() };
    for (minima, maxima) in [(2, 2), (12, 9)] {
        let extrema = Extrema::Most { minima, maxima, of: PersistenceOf::Input };
        let options =
            PrescribeOptions { functional: Functional::Tikhonov(tikhonov), extrema, ..PrescribeOptions::default() };
        let mut ours = f64::INFINITY;
        let mut result = None;
        for _ in 0..ROUNDS {
            let since = Instant::now();
            let mut smoother = Smoother::new(mesh, SmootherOptions::default()).expect("a smoother");
            result = Some(smoother.prescribe(&field, &options).expect("a field"));
            ours = ours.min(since.elapsed().as_secs_f64());
        }
        let result = result.expect("a round");
        let report = result.reports[0].prescribed.as_ref().expect("a report");
        let steps = steps(mesh, &result.values, &report.minima, &report.maxima);
        let (h, c) = functional(mesh, &field);
        let mut theirs = f64::INFINITY;
        let mut best = Vec::new();
        for _ in 0..ROUNDS {
            let since = Instant::now();
            best = by_clarabel(&h, &c, &steps);
            theirs = theirs.min(since.elapsed().as_secs_f64());
        }
        let energy = |x: &[f64]| {
            let image = &h * &nalgebra::DMatrix::from_column_slice(x.len(), 1, x);
            dot(x, image.as_slice()) - 2.0 * dot(&c, x) + dot(&c, &field)
        };
        let difference = energy(&result.values) / energy(&best) - 1.0;
        println!(
            "{:8}  {:>3} + {:<3}   {:14} {ours:9.3} {theirs:9.3} {:6.2}  {difference:9.1e}",
            mesh.vertex_count(),
            report.minima.len(),
            report.maxima.len(),
            report.route.name(),
            ours / theirs,
        );
    }
}

/// From the lowest neighbour to every vertex, from every vertex to its highest one, and between chosen extrema and all neighbours.
fn steps(mesh: &TriMesh, x: &[f64], minima: &[u32], maxima: &[u32]) -> Vec<(usize, usize)> {
    let n = mesh.vertex_count();
    let mut around = vec![Vec::new(); n];
    for &[a, b] in mesh.connectivity().edges() {
        around[a as usize].push(b as usize);
        around[b as usize].push(a as usize);
    }
    let mut steps = Vec::new();
    for (v, around) in around.iter().enumerate() {
        let by_value = |a: &&usize, b: &&usize| x[**a].total_cmp(&x[**b]);
        if minima.contains(&(v as u32)) {
            steps.extend(around.iter().map(|&w| (v, w)));
        } else {
            steps.push((*around.iter().min_by(by_value).expect("a neighbour"), v));
        }
        if maxima.contains(&(v as u32)) {
            steps.extend(around.iter().map(|&w| (w, v)));
        } else {
            steps.push((v, *around.iter().max_by(by_value).expect("a neighbour")));
        }
    }
    steps.sort_unstable();
    steps.dedup();
    steps
}

/// H = LᵀL + εB, c = εBf.
fn functional(mesh: &TriMesh, f: &[f64]) -> (CscMatrix<f64>, Vec<f64>) {
    let l = laplacian(mesh, LaplacianWeights::Cotangent, &Watch::none()).expect("a Laplacian");
    let b = mass(mesh, &MassOptions::default(), &Watch::none()).expect("a mass matrix");
    let c = (&b * &nalgebra::DMatrix::from_column_slice(f.len(), 1, f)).column(0) * EPSILON;
    (l.transpose() * &l + &b * EPSILON, c.as_slice().to_vec())
}

fn by_clarabel(h: &CscMatrix<f64>, c: &[f64], steps: &[(usize, usize)]) -> Vec<f64> {
    let n = c.len();
    let upper: Vec<(usize, usize, f64)> =
        h.triplet_iter().filter(|(i, j, _)| i <= j).map(|(i, j, &v)| (i, j, v)).collect();
    let p = Sparse::new_from_triplets(
        n,
        n,
        upper.iter().map(|entry| entry.0).collect(),
        upper.iter().map(|entry| entry.1).collect(),
        upper.iter().map(|entry| entry.2).collect(),
    );
    let a = Sparse::new_from_triplets(
        steps.len(),
        n,
        (0..steps.len()).flat_map(|k| [k, k]).collect(),
        steps.iter().flat_map(|&(a, b)| [a, b]).collect(),
        steps.iter().flat_map(|_| [1.0, -1.0]).collect(),
    );
    let b = vec![-MARGIN; steps.len()];
    let q: Vec<f64> = c.iter().map(|c| -c).collect();
    // The gap that `prescribe` ends with.
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-12)
        .tol_gap_rel(1e-6)
        .build()
        .expect("settings");
    let mut solver = DefaultSolver::new(&p, &q, &a, &b, &[NonnegativeConeT(steps.len())], settings).expect("a program");
    solver.solve();
    solver.solution.x.clone()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
