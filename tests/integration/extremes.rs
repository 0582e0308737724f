//! Inputs at the ends of double precision: a right result or an error with a code, never NaN, never a silent zero.

use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale};
use morse_smooth::smooth::{Metric, Smoother, SmootherOptions, SolverChoice, TikhonovOptions};
use nalgebra::{DMatrix, DVector};

use crate::exact;
use crate::support::{dense, noise};

const METRICS: [(Metric, MassScale); 3] =
    [(Metric::Identity, MassScale::MeanOne), (Metric::Mass, MassScale::MeanOne), (Metric::Lumped, MassScale::Raw)];
const SOLVERS: [SolverChoice; 2] = [SolverChoice::Cholesky, SolverChoice::ConjugateGradient];
const CODES: [&str; 4] = ["NotConverged", "NotPositiveDefinite", "RangeOverflow", "NonFiniteEntry"];

fn metric_matrix(mesh: &TriMesh, metric: Metric, scale: MassScale) -> DMatrix<f64> {
    let n = mesh.vertex_count();
    match metric {
        Metric::Identity => DMatrix::identity(n, n),
        Metric::Mass => dense(&morse_smooth::operators::galerkin_mass(mesh, scale).unwrap()),
        Metric::Lumped => dense(&morse_smooth::operators::lumped_mass(mesh, scale).unwrap()),
    }
}

/// The solution where ε dwarfs LᵀL or the other way round, else by elimination.
fn solution(laplacian: &DMatrix<f64>, mass: &DMatrix<f64>, epsilon: f64, f: &[f64]) -> Vec<f64> {
    if epsilon > 1e25 {
        f.to_vec()
    } else if epsilon < 1e-20 {
        // Only the constants are left, with 1ᵀBx = 1ᵀBf.
        let mean = (mass * DVector::from_column_slice(f)).sum() / mass.sum();
        vec![mean; f.len()]
    } else {
        exact::tikhonov(laplacian, mass, epsilon, f)
    }
}

#[test]
fn any_epsilon() {
    for mesh in [shapes::octahedron().unwrap(), shapes::torus(7, 6, 0.4).unwrap(), shapes::grid(6, 6).unwrap()] {
        let f = noise(mesh.vertex_count(), 2);
        for weights in [LaplacianWeights::Cotangent, LaplacianWeights::MeanValue, LaplacianWeights::Uniform] {
            for solver in SOLVERS {
                let mut smoother =
                    Smoother::new(&mesh, SmootherOptions { weights, solver, ..SmootherOptions::default() }).unwrap();
                let laplacian = dense(smoother.laplacian());
                for (metric, mass_scale) in METRICS {
                    let mass = metric_matrix(&mesh, metric, mass_scale);
                    for exponent in [
                        -323, -300, -200, -170, -154, -100, -30, -20, -18, -16, -15, -14, -12, 12, 20, 30, 154, 200,
                        300, 308,
                    ] {
                        let epsilon: f64 = format!("1e{exponent}").parse().unwrap();
                        let context = format!("{weights:?} {solver:?} {metric:?} ε = {epsilon:e}");
                        let options =
                            TikhonovOptions { epsilon, metric, mass_scale, channels: 1, ..TikhonovOptions::default() };
                        match smoother.tikhonov(&f, &options) {
                            Ok(found) => {
                                let expected = solution(&laplacian, &mass, epsilon, &f);
                                for (x, y) in found.values.iter().zip(&expected) {
                                    assert!((x - y).abs() < 1e-7, "{context}: {x} where {y} is right");
                                }
                                let report = &found.reports[0];
                                assert!(report.solver.relative_residual.is_finite(), "{context}");
                                assert!(
                                    report.metric_norm.is_finite() && report.laplacian_norm.is_finite(),
                                    "{context}"
                                );
                            }
                            Err(problem) => {
                                assert!(CODES.contains(&problem.code()), "{context}: {problem}");
                                let usual = if solver == SolverChoice::Cholesky { 1e-9 } else { 0.1 };
                                assert!(epsilon < usual, "{context}: {problem}");
                            }
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn any_scale_of_the_values() {
    let mesh = shapes::torus(7, 6, 0.4).unwrap();
    let f = noise(mesh.vertex_count(), 2);
    for solver in SOLVERS {
        let mut smoother = Smoother::new(&mesh, SmootherOptions { solver, ..SmootherOptions::default() }).unwrap();
        for (metric, mass_scale) in METRICS {
            let options =
                TikhonovOptions { epsilon: 0.05, metric, mass_scale, channels: 1, ..TikhonovOptions::default() };
            let plain = smoother.tikhonov(&f, &options).unwrap();
            for scale in [1e-320, 1e-310, 1e-300, 1e-160, 1e160, 1e300, 8e307] {
                let scaled: Vec<f64> = f.iter().map(|x| x * scale).collect();
                let found = smoother.tikhonov(&scaled, &options).unwrap();
                // Below 1e-308 there are fewer digits to keep.
                let tolerance = (4.0 * 5e-324 / scale).max(1e-12);
                for (x, y) in found.values.iter().zip(&plain.values) {
                    assert!((x / scale - y).abs() <= tolerance, "{metric:?} {scale:e}: {x:e} for {y}");
                }
            }
            // A small signal on a large constant: what can be kept is the last places of the constant.
            let shifted: Vec<f64> = f.iter().map(|x| 1e8 + x).collect();
            let found = smoother.tikhonov(&shifted, &options).unwrap();
            for (x, y) in found.values.iter().zip(&plain.values) {
                assert!((x - 1e8 - y).abs() < 1e-7);
            }
            let whole: Vec<f64> = f.iter().map(|x| x.signum() * f64::MAX).collect();
            assert_eq!(smoother.tikhonov(&whole, &options).expect_err("no range").code(), "RangeOverflow");
        }
    }
}

#[test]
fn any_unit_of_the_mesh() {
    let base = shapes::torus(7, 6, 0.4).unwrap();
    let f = noise(base.vertex_count(), 2);
    for unit in [1e-74, 1e-30, 1e-5, 1e5, 1e30, 7e74] {
        let mesh = TriMesh::new(
            base.positions().iter().map(|x| x * unit).collect(),
            base.connectivity().triangles().as_flattened().to_vec(),
        )
        .unwrap();
        for weights in [LaplacianWeights::Cotangent, LaplacianWeights::MeanValue] {
            for solver in SOLVERS {
                let options = SmootherOptions { weights, solver, ..SmootherOptions::default() };
                let mut plain = Smoother::new(&base, options).unwrap();
                let mut scaled = Smoother::new(&mesh, options).unwrap();
                for (metric, mass_scale) in METRICS {
                    let context = format!("{unit:e} {weights:?} {solver:?} {metric:?} {mass_scale:?}");
                    let options = TikhonovOptions {
                        epsilon: 0.05,
                        metric,
                        mass_scale,
                        channels: 1,
                        ..TikhonovOptions::default()
                    };
                    // A raw mass has the square of the unit, and ε undoes it.
                    let factor = if mass_scale == MassScale::Raw { unit * unit } else { 1.0 };
                    let expected = plain.tikhonov(&f, &options).unwrap().values;
                    let undone = TikhonovOptions { epsilon: 0.05 / factor, ..options };
                    match scaled.tikhonov(&f, &undone) {
                        Ok(found) => {
                            for (x, y) in found.values.iter().zip(&expected) {
                                assert!((x - y).abs() < 1e-9, "{context}: {x} {y}");
                            }
                        }
                        Err(problem) => panic!("{context}: {problem}"),
                    }
                    // The same ε with the raw mass in other units: whatever it means, it is finite or refused by name.
                    match scaled.tikhonov(&f, &options) {
                        Ok(found) => {
                            let mass = metric_matrix(&mesh, metric, mass_scale);
                            let size = mass.sum() / mesh.vertex_count() as f64;
                            let laplacian = dense(scaled.laplacian());
                            let right = solution(&laplacian, &(mass / size), 0.05 * size, &f);
                            for (x, y) in found.values.iter().zip(&right) {
                                assert!((x - y).abs() < 1e-7, "{context}: {x} where {y} is right");
                            }
                        }
                        Err(problem) => assert!(CODES.contains(&problem.code()) && unit < 1.0, "{context}: {problem}"),
                    }
                }
            }
        }
    }
}

/// A field between the ends of double precision overshoots them: the error is about its range, as every one of its values is finite.
#[test]
fn overshooting_the_range_of_doubles() {
    let mesh = shapes::grid(7, 7).unwrap();
    let mut refused = 0;
    for seed in 0..20 {
        let f: Vec<f64> = noise(49, seed).iter().map(|x| 8.9e307 * x.signum()).collect();
        let vertices: Vec<u32> = (0..8).map(|k| (11 * k + seed as u32 * 5) % 49).collect();
        let constraints = crate::dense_reference::named(&vertices, morse_smooth::smooth::Unconstrained::Error);
        let options = morse_smooth::smooth::InterpolateOptions {
            constraints,
            energy: morse_smooth::smooth::Energy::Biharmonic,
            ..Default::default()
        };
        match Smoother::new(&mesh, SmootherOptions::default()).unwrap().interpolate(&f, &options) {
            Ok(smoothed) => assert!(smoothed.values.iter().all(|x| x.is_finite())),
            Err(error) => {
                assert_eq!(error.code(), "RangeOverflow", "{error}");
                refused += 1;
            }
        }
    }
    assert!(refused > 3, "{refused}");
}
