//! Ordering, factorising, solving and preconditioning.

use morse_smooth::Watch;
use morse_smooth::error::SolveError;
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::cotan_laplacian;
use morse_smooth::solve::{
    CgOptions, CholeskyAnalysis, Multigrid, Preconditioner, Scalar, SquaredSum, conjugate_gradient, gram,
    minimum_degree, nested_dissection, transposed_product,
};
use nalgebra::Complex;
use nalgebra_sparse::CscMatrix;

use crate::{SMALL, check, limited, usage};

/// L + 0.1 I of a few surfaces of different sizes, and of a fan around one vertex.
fn matrices() -> Vec<(String, CscMatrix<f64>)> {
    let around = |i: u32| (f64::from(i) * core::f64::consts::TAU / 3000.0).sin_cos();
    let rim = (0..3000).flat_map(|i| [around(i).0, around(i).1, 0.0]);
    let triangles = (1..3000).flat_map(|i| [0, i, i + 1]).collect();
    let meshes = [
        ("torus of 3,200", shapes::torus(80, 40, 0.3)),
        ("torus of 45,000", shapes::torus(300, 150, 0.3)),
        ("long torus", shapes::torus(4000, 5, 0.3)),
        ("sphere", shapes::sphere(5)),
        ("fan", TriMesh::new([0.0; 3].into_iter().chain(rim).collect(), triangles)),
    ];
    let mut all = Vec::new();
    for (name, mesh) in meshes {
        let mut matrix = cotan_laplacian(&mesh.unwrap()).unwrap();
        matrix.triplet_iter_mut().filter(|(i, j, _)| i == j).for_each(|(_, _, value)| *value += 0.1);
        all.push((name.to_owned(), matrix));
    }
    all
}

/// The matrices and their squares, but for the one that would be full.
fn squares() -> Vec<(String, CscMatrix<f64>)> {
    let mut all = matrices();
    for (name, matrix) in matrices().into_iter().filter(|(name, _)| name != "fan") {
        all.push((format!("square of the {name}"), gram(&matrix, &Watch::none()).unwrap()));
    }
    all
}

#[test]
fn products_and_orderings() {
    for (name, matrix) in matrices().iter().filter(|(name, _)| name != "fan") {
        check(&format!("gram, {name}"), 1.5, || gram(matrix, &Watch::none()).unwrap());
    }
    for (name, matrix) in &squares() {
        let pattern = matrix.pattern();
        check(&format!("nested dissection, {name}"), 2.5, || nested_dissection(pattern, &Watch::none()).unwrap());
        check(&format!("minimum degree, {name}"), 2.5, || minimum_degree(pattern, &Watch::none()).unwrap());
        let copy = pattern.clone();
        check(&format!("analysis, {name}"), 2.5, || CholeskyAnalysis::new(copy, &Watch::none()).unwrap());
    }
}

#[test]
fn iterations() {
    for (name, matrix) in &matrices() {
        let multigrid = check(&format!("multigrid, {name}"), 4.0, || Multigrid::new(matrix, &Watch::none()).unwrap());
        let diagonal = vec![0.1; matrix.nrows()];
        let squared = check(&format!("for squares, {name}"), 4.0, || {
            SquaredSum::new(matrix, &diagonal, 0.1, &Watch::none()).unwrap()
        });
        let b: Vec<f64> = (0..matrix.nrows()).map(|i| (i % 7) as f64).collect();
        for preconditioner in [&multigrid as &dyn Preconditioner, &squared] {
            let mut x = vec![0.0; b.len()];
            let apply = &mut |x: &[f64]| transposed_product(matrix, x);
            let options = CgOptions { max_iterations: 200, tolerance: 1e-6, ..CgOptions::default() };
            check(&format!("iterations, {name}"), 2.5, || {
                // Whether it converges does not matter here.
                drop(conjugate_gradient(apply, preconditioner, &b, &mut x, &options, &Watch::none()));
            });
        }
    }
}

/// A call that is given more and more memory gives a result or `OutOfMemory`, the former where there is enough.
fn check_limits<T>(what: &str, mut call: impl FnMut(i64) -> Result<T, SolveError>) -> T {
    let (result, all) = usage(|| call(i64::MAX >> 1).unwrap());
    let most = all.peak.max(all.ensured) + SMALL;
    for part in 0..25 {
        match call(most * part / 25) {
            Ok(_) => assert!(part > 0, "{what}: with no memory at all"),
            Err(SolveError::OutOfMemory { bytes }) => assert!(bytes > 0),
            Err(error) => panic!("{what}: {error}"),
        }
    }
    assert!(call(most).is_ok(), "{what}");
    result
}

fn factors<T: Scalar>(value: impl Fn(f64) -> T::Wide) {
    for (name, matrix) in &squares() {
        let values: Vec<T::Wide> = matrix.values().iter().map(|&v| value(v)).collect();
        let analysis = check_limits(name, |bytes| {
            let pattern = matrix.pattern().clone();
            limited(bytes, || CholeskyAnalysis::new(pattern, &Watch::none()))
        });
        if matches!(analysis.factor::<T>(&values, &Watch::none()), Err(SolveError::NotPositiveDefinite { .. })) {
            // Single precision does not do for every square.
            continue;
        }
        let mut factor = check_limits(name, |bytes| limited(bytes, || analysis.factor::<T>(&values, &Watch::none())));
        let ((), used) = usage(|| factor.refactor(&values, &Watch::none()).unwrap());
        assert!(used.peak <= SMALL, "{name}: {} bytes to factorise again", used.peak);
        for columns in [1, 5, 9] {
            let b: Vec<T::Wide> = (0..columns * matrix.nrows()).map(|i| value((i % 7) as f64)).collect();
            check(&format!("solve, {name}"), 2.0, || factor.solve(&b, &Watch::none()).unwrap());
            check_limits(name, |bytes| limited(bytes, || factor.solve(&b, &Watch::none())));
        }
    }
}

#[test]
fn factorisations_and_solves() {
    factors::<f64>(|value| value);
    factors::<f32>(|value| value);
    factors::<Complex<f64>>(|value| Complex::new(value, 0.0));
    factors::<Complex<f32>>(|value| Complex::new(value, 0.0));
}

#[test]
fn shortages_of_everything_else() {
    for (name, matrix) in &matrices() {
        if name != "fan" {
            check_limits(name, |bytes| limited(bytes, || gram(matrix, &Watch::none())));
        }
        check_limits(name, |bytes| limited(bytes, || Multigrid::new(matrix, &Watch::none())));
        let diagonal = vec![0.1; matrix.nrows()];
        check_limits(name, |bytes| limited(bytes, || SquaredSum::new(matrix, &diagonal, 0.1, &Watch::none())));
    }
}
