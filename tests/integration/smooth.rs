//! Tikhonov smoothing against dense algebra with 32 digits, and the invariants of the equations.

use morse_smooth::field::{DeltaOptions, ScalarField};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale};
use morse_smooth::smooth::{
    Metric, SmoothReport, Smoother, SmootherOptions, SolverChoice, TikhonovOptions, smoothness,
};
use nalgebra::{DMatrix, DVector};

use crate::analyses::critical_points;
use crate::exact;
use crate::operators::{ALL_WEIGHTS, reference_laplacian, reference_mass};
use crate::support::{
    annulus, dense, islands, jittered, mesh, noise, random_complex, random_surface, tied, two_tetrahedra_at_an_edge,
};

const METRICS: [(Metric, MassScale); 5] = [
    (Metric::Identity, MassScale::MeanOne),
    (Metric::Mass, MassScale::MeanOne),
    (Metric::Mass, MassScale::Raw),
    (Metric::Lumped, MassScale::MeanOne),
    (Metric::Lumped, MassScale::Raw),
];

fn options(epsilon: f64, metric: Metric, mass_scale: MassScale) -> TikhonovOptions {
    TikhonovOptions { epsilon, metric, mass_scale, channels: 1, ..TikhonovOptions::default() }
}

fn smoother(mesh: &TriMesh, weights: LaplacianWeights, solver: SolverChoice) -> Smoother {
    Smoother::new(mesh, SmootherOptions { weights, solver, ..SmootherOptions::default() }).unwrap()
}

fn cholesky(mesh: &TriMesh) -> Smoother {
    smoother(mesh, LaplacianWeights::Cotangent, SolverChoice::Auto)
}

fn reference_metric(mesh: &TriMesh, metric: Metric, scale: MassScale) -> DMatrix<f64> {
    let n = mesh.vertex_count();
    match metric {
        Metric::Identity => DMatrix::identity(n, n),
        Metric::Mass => reference_mass(mesh, scale),
        Metric::Lumped => DMatrix::from_diagonal(&reference_mass(mesh, scale).column_sum()),
    }
}

/// Largest difference as a fraction of the largest value.
fn error(found: &[f64], expected: &[f64]) -> f64 {
    error_for(expected, found, expected)
}

/// Largest difference as a fraction of the largest value of the input, for results much smaller than that.
fn error_for(f: &[f64], found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = f.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

/// Meshes where every vertex has area, so that the system is definite as it stands.
fn meshes() -> Vec<(&'static str, TriMesh)> {
    vec![
        ("tetrahedron", shapes::tetrahedron().unwrap()),
        ("sphere", jittered(&shapes::sphere(2).unwrap(), 0.05, 2)),
        ("torus", shapes::torus(9, 6, 0.4).unwrap()),
        ("grid", shapes::grid(7, 6).unwrap()),
        ("annulus", annulus()),
        ("moebius", shapes::moebius(11, 4).unwrap()),
        ("klein bottle", shapes::klein_bottle(7, 6).unwrap()),
        ("not a manifold", two_tetrahedra_at_an_edge()),
        ("random complex", random_complex(11, 9, 30)),
    ]
}

#[test]
fn solutions_agree_with_dense_algebra() {
    for (name, mesh) in meshes() {
        let f: Vec<f64> = noise(mesh.vertex_count(), 7).iter().map(|x| 40.0 * x - 300.0).collect();
        for weights in ALL_WEIGHTS {
            let laplacian = reference_laplacian(&mesh, weights);
            let mut smoother = smoother(&mesh, weights, SolverChoice::Auto);
            for (metric, scale) in METRICS {
                let mass = reference_metric(&mesh, metric, scale);
                for epsilon in [1e-6, 1e-3, 0.05, 10.0, 1e6] {
                    let expected = exact::tikhonov(&laplacian, &mass, epsilon, &f);
                    let found = smoother.tikhonov(&f, &options(epsilon, metric, scale)).unwrap();
                    let wrong = error(&found.values, &expected);
                    assert!(wrong < 1e-11, "{name} {weights:?} {metric:?} {scale:?} ε = {epsilon}: {wrong:e}");
                }
            }
        }
    }
}

#[test]
fn refinement_keeps_small_epsilons_accurate() {
    // Here LᵀL alone, in double precision, would lose from 8 to all digits.
    for (name, mesh) in [
        ("sphere", shapes::sphere(2).unwrap()),
        ("torus", shapes::torus(10, 7, 0.7).unwrap()),
        ("grid", shapes::grid(9, 8).unwrap()),
    ] {
        let f = noise(mesh.vertex_count(), 3);
        let mut smoother = cholesky(&mesh);
        let laplacian = dense(smoother.laplacian());
        for (metric, scale) in METRICS {
            let mass = match metric {
                Metric::Identity => DMatrix::identity(f.len(), f.len()),
                Metric::Mass => dense(&morse_smooth::operators::galerkin_mass(&mesh, scale).unwrap()),
                Metric::Lumped => dense(&morse_smooth::operators::lumped_mass(&mesh, scale).unwrap()),
            };
            for (epsilon, tolerance) in [(1e-6, 1e-14), (1e-8, 1e-13), (1e-10, 1e-11), (1e-12, 1e-8), (1e-14, 1e-7)] {
                let expected = exact::tikhonov(&laplacian, &mass, epsilon, &f);
                match smoother.tikhonov(&f, &options(epsilon, metric, scale)) {
                    Ok(found) => {
                        let wrong = error_for(&f, &found.values, &expected);
                        assert!(wrong < tolerance, "{name} {metric:?} {scale:?} ε = {epsilon:e}: {wrong:e}");
                    }
                    Err(problem) => {
                        assert!(epsilon < 1e-10, "{name} {metric:?} {scale:?} ε = {epsilon:e}: {problem}");
                        assert!(["NotConverged", "NotPositiveDefinite"].contains(&problem.code()), "{problem}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_spectral_form_gives_the_same() {
    // Eq. (4): x = Σ ε/(ε + λ²) ⟨f, v⟩ v over the eigenpairs of L.
    for (name, mesh) in meshes() {
        for weights in [LaplacianWeights::Cotangent, LaplacianWeights::Uniform] {
            let eigen = reference_laplacian(&mesh, weights).symmetric_eigen();
            let f = DVector::from_vec(noise(mesh.vertex_count(), 9));
            for epsilon in [1e-3, 0.05, 2.0] {
                let mut coefficients = eigen.eigenvectors.tr_mul(&f);
                for (c, lambda) in coefficients.iter_mut().zip(&eigen.eigenvalues) {
                    *c *= epsilon / (epsilon + lambda * lambda);
                }
                let expected = &eigen.eigenvectors * coefficients;
                let mut smoother = smoother(&mesh, weights, SolverChoice::Auto);
                let found = smoother.tikhonov(f.as_slice(), &options(epsilon, Metric::Identity, MassScale::MeanOne));
                let wrong = error(&found.unwrap().values, expected.as_slice());
                assert!(wrong < 1e-12, "{name} {weights:?} ε = {epsilon}: {wrong:e}");
            }
        }
    }
}

#[test]
fn invariants_of_the_equations() {
    for (name, mesh) in [
        ("torus", shapes::torus(16, 12, 0.4).unwrap()),
        ("grid", shapes::grid(13, 11).unwrap()),
        ("strip", shapes::moebius(14, 6).unwrap()),
    ] {
        let n = mesh.vertex_count();
        let f: Vec<f64> =
            mesh.positions().chunks_exact(3).zip(noise(n, 5)).map(|(p, e)| 3.0 + p[0] + 0.4 * e).collect();
        for weights in ALL_WEIGHTS {
            let laplacian = reference_laplacian(&mesh, weights);
            let mut smoother = smoother(&mesh, weights, SolverChoice::Auto);
            for (metric, scale) in METRICS {
                let context = format!("{name} {weights:?} {metric:?} {scale:?}");
                let mass = reference_metric(&mesh, metric, scale);
                let mut apply =
                    |f: &[f64], epsilon: f64| smoother.tikhonov(f, &options(epsilon, metric, scale)).unwrap();
                // Constants stay, to the last bit.
                assert_eq!(apply(&vec![7.3; n], 0.05).values, vec![7.3; n], "{context}");
                let x = apply(&f, 0.05).values;
                // 1ᵀBx = 1ᵀBf.
                let total = |v: &[f64]| (&mass * DVector::from_column_slice(v)).sum();
                assert!((total(&x) - total(&f)).abs() < 1e-12 * total(&f).abs(), "{context}");
                // T(af + b) = aT(f) + b, a negative included.
                let moved: Vec<f64> = f.iter().map(|v| -250.0 * v + 17.0).collect();
                let expected: Vec<f64> = x.iter().map(|v| -250.0 * v + 17.0).collect();
                assert!(error(&apply(&moved, 0.05).values, &expected) < 1e-12, "{context}");
                // Growing ε: nearer to f, less smooth; never beyond the ends.
                let mut previous: Option<(f64, f64)> = None;
                for step in 0..9 {
                    let x = DVector::from_vec(apply(&f, 1e-4 * 10.0_f64.powi(step)).values);
                    let d = &x - DVector::from_column_slice(&f);
                    let (distance, roughness) = ((&mass * &d).dot(&d).sqrt(), (&laplacian * &x).norm());
                    if let Some((d, r)) = previous {
                        assert!(distance <= d * (1.0 + 1e-9) && roughness >= r * (1.0 - 1e-9), "{context}");
                    }
                    previous = Some((distance, roughness));
                }
            }
        }
    }
}

#[test]
fn closed_surfaces_keep_the_euler_formula_and_mirror() {
    for (mesh, chi) in [(shapes::sphere(4).unwrap(), 2), (shapes::torus(24, 16, 0.5).unwrap(), 0)] {
        let mut smoother = cholesky(&mesh);
        for f in [noise(mesh.vertex_count(), 1), tied(mesh.vertex_count(), 2, 1.0)] {
            for epsilon in [1e-4, 0.05, 20.0] {
                let at = options(epsilon, Metric::Mass, MassScale::MeanOne);
                let up = smoother.tikhonov(&f, &at).unwrap();
                let mirrored: Vec<f64> = f.iter().map(|x| -x).collect();
                let down = smoother.tikhonov(&mirrored, &at).unwrap();
                let (a, b) = (up.reports[0].after, down.reports[0].after);
                assert_eq!((a.minima, a.maxima, a.saddles), (b.maxima, b.minima, b.saddles));
                assert_eq!(i64::from(a.minima) - i64::from(a.saddles) + i64::from(a.maxima), chi);
                assert_eq!(a.index_sum, Some(chi));
                assert_eq!(a, critical_points(&mesh, &up.values, &DeltaOptions::default()).unwrap().counts);
            }
        }
    }
}

fn check_report(
    mesh: &TriMesh,
    weights: LaplacianWeights,
    at: &TikhonovOptions,
    f: &[f64],
    x: &[f64],
    report: &SmoothReport,
) {
    let used: Vec<bool> =
        (0..f.len()).map(|v| mesh.connectivity().triangles().as_flattened().contains(&(v as u32))).collect();
    let range = f.iter().zip(&used).filter(|u| *u.1).fold((f64::MAX, f64::MIN), |r, (&x, _)| (r.0.min(x), r.1.max(x)));
    let normalized = |v: &[f64]| {
        let scaled = |(x, used): (&f64, &bool)| if *used { (x - range.0) / (range.1 - range.0) } else { 0.0 };
        DVector::from_iterator(v.len(), v.iter().zip(&used).map(scaled))
    };
    let (f, x) = (normalized(f), normalized(x));
    let (laplacian, mass) = (reference_laplacian(mesh, weights), reference_metric(mesh, at.metric, at.mass_scale));
    let d = &x - &f;
    for (name, found, expected) in [
        ("l∞", report.l_infinity, d.amax()),
        ("l2", report.l2, d.norm()),
        ("metric", report.metric_norm, (&mass * &d).dot(&d).sqrt()),
        ("‖Lx‖", report.laplacian_norm, (&laplacian * &x).norm()),
        ("S(f)", report.sobolev_before, (&laplacian * &f).dot(&f)),
        ("S(x)", report.sobolev_after, (&laplacian * &x).dot(&x)),
    ] {
        assert!((found - expected).abs() <= 1e-11 * expected.abs(), "{name}: {found} {expected}");
    }
    let right = &mass * &f;
    let residual = (&right - &mass * &x) * at.epsilon - laplacian.tr_mul(&(&laplacian * &x));
    let relative = residual.norm() / (right.norm() * at.epsilon);
    assert!(report.solver.relative_residual < 1e-10 && relative < 1e-10, "{relative:e}");
}

#[test]
fn reports_tell_what_happened() {
    for mesh in [shapes::torus(9, 7, 0.4).unwrap(), islands(), random_surface(4, &shapes::grid(8, 8).unwrap(), 0.2)] {
        let n = mesh.vertex_count();
        let f: Vec<f64> = noise(n, 8).iter().map(|x| 30.0 * x - 4.0).collect();
        for weights in ALL_WEIGHTS {
            for solver in [SolverChoice::Cholesky, SolverChoice::ConjugateGradient] {
                let mut smoother = smoother(&mesh, weights, solver);
                for (metric, scale) in METRICS {
                    let at = options(0.2, metric, scale);
                    let found = smoother.tikhonov(&f, &at).unwrap();
                    let report = &found.reports[0];
                    check_report(&mesh, weights, &at, &f, &found.values, report);
                    let counts = |v: &[f64]| critical_points(&mesh, v, &DeltaOptions::default()).unwrap().counts;
                    assert_eq!((report.before, report.after), (counts(&f), counts(&found.values)));
                    assert_eq!(report.epsilon, Some(0.2));
                    assert_eq!(report.equation.name(), if metric == Metric::Identity { "(3)" } else { "(5)" });
                    assert_eq!(report.solver.unknowns, n - mesh.topology().unwrap().isolated_vertices);
                    let direct = solver == SolverChoice::Cholesky;
                    let expected = match (direct, weights.is_symmetric()) {
                        (true, true) if metric == Metric::Identity => "complexCholesky",
                        (true, _) => "cholesky",
                        (false, true) => "cgMultigrid",
                        (false, false) => "cgJacobi",
                    };
                    assert_eq!((report.solver.route.name(), report.solver.precision.name()), (expected, "double"));
                    assert_eq!(report.solver.iterations > 0, !direct);
                }
            }
        }
        let energies = smoothness(cholesky(&mesh).laplacian(), &ScalarField::new(&mesh, &f).unwrap()).unwrap();
        let (laplacian, f) = (reference_laplacian(&mesh, LaplacianWeights::Cotangent), DVector::from_vec(f));
        let image = &laplacian * &f;
        assert!((energies.laplacian_norm - image.norm()).abs() < 1e-9 * image.norm());
        assert!((energies.sobolev - image.dot(&f)).abs() < 1e-5 * energies.sobolev.abs());
    }
}

#[test]
fn channels_and_routes_agree() {
    let mesh = shapes::torus(15, 11, 0.4).unwrap();
    let n = mesh.vertex_count();
    let fields =
        [noise(n, 1), vec![2.5; n], mesh.positions().chunks_exact(3).map(|p| 1e8 * p[0]).collect::<Vec<f64>>()];
    let interleaved: Vec<f64> = (0..3 * n).map(|i| fields[i % 3][i / 3]).collect();
    for (metric, scale) in METRICS {
        for solver in [SolverChoice::Auto, SolverChoice::ConjugateGradient] {
            let mut smoother = smoother(&mesh, LaplacianWeights::Cotangent, solver);
            let at = options(0.3, metric, scale);
            let together = smoother.tikhonov(&interleaved, &TikhonovOptions { channels: 3, ..at }).unwrap();
            assert_eq!((together.values.len(), together.reports.len()), (3 * n, 3));
            for (c, field) in fields.iter().enumerate() {
                let alone = smoother.tikhonov(field, &at).unwrap();
                let channel: Vec<f64> = together.values.iter().skip(c).step_by(3).copied().collect();
                assert!(error(&channel, &alone.values) < 1e-13, "{metric:?} channel {c}");
                assert_eq!(together.reports[c].after, alone.reports[0].after);
                let direct = cholesky(&mesh).tikhonov(field, &at).unwrap();
                let wrong = error(&alone.values, &direct.values);
                assert!(wrong < 1e-9, "{metric:?} {solver:?} channel {c}: {wrong:e}");
            }
        }
    }
}

#[test]
fn conjugate_gradients_reach_small_epsilon() {
    let mesh = shapes::torus(15, 11, 0.3).unwrap();
    let f = noise(mesh.vertex_count(), 21);
    for epsilon in [1e-2, 1e-4, 1e-6] {
        for (metric, scale) in METRICS {
            let at = options(epsilon, metric, scale);
            let direct = cholesky(&mesh).tikhonov(&f, &at).unwrap();
            let mut iterative = smoother(&mesh, LaplacianWeights::Cotangent, SolverChoice::ConjugateGradient);
            let wrong = error(&iterative.tikhonov(&f, &at).unwrap().values, &direct.values);
            assert!(wrong < 1e-9, "{metric:?} {scale:?} at {epsilon:e}: {wrong:e}");
        }
    }
}

#[test]
fn conjugate_gradients_where_rounding_is_above_their_tolerance() {
    let mesh = shapes::torus(40, 20, 0.0).unwrap();
    let f = noise(mesh.vertex_count(), 8);
    for epsilon in [1e-3, 1e-4, 1e-5] {
        let at = options(epsilon, Metric::Mass, MassScale::MeanOne);
        let found = smoother(&mesh, LaplacianWeights::Cotangent, SolverChoice::ConjugateGradient).tikhonov(&f, &at);
        let expected = cholesky(&mesh).tikhonov(&f, &at).unwrap().values;
        let wrong = error_for(&f, &found.unwrap().values, &expected);
        assert!(wrong < 1e-9, "{epsilon:e}: {wrong:e}");
    }
}

#[test]
fn every_component_is_smoothed_as_if_alone() {
    // Isolated vertices keep their value and take no part, however wild it is.
    let mesh = islands();
    let mut f = noise(mesh.vertex_count(), 6);
    f[4] = 1e12;
    f[5] = -7.0;
    let octahedron = shapes::octahedron().unwrap();
    let tetrahedron = shapes::tetrahedron().unwrap();
    for (metric, scale) in [METRICS[0], METRICS[2], METRICS[4]] {
        let at = options(0.3, metric, scale);
        let found = cholesky(&mesh).tikhonov(&f, &at).unwrap();
        assert_eq!((found.values[4], found.values[5]), (1e12, -7.0));
        let first = cholesky(&tetrahedron).tikhonov(&f[..4], &at).unwrap();
        let second = cholesky(&octahedron).tikhonov(&f[6..], &at).unwrap();
        assert!(error(&found.values[..4], &first.values) < 1e-13, "{metric:?}");
        assert!(error(&found.values[6..], &second.values) < 1e-13, "{metric:?}");
        assert!(found.reports[0].l_infinity <= 1.0);
    }
}

#[test]
fn vertices_without_area_keep_their_value() {
    // Vertex 4 hangs on a triangle without area.
    let positions = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.5, 0.5, 0.0]];
    let with = mesh(&positions, &[[0, 1, 2], [0, 2, 3], [0, 2, 4]]);
    let without = mesh(&positions[..4], &[[0, 1, 2], [0, 2, 3]]);
    let f = [0.0, 1.0, 0.3, 0.4, 0.9];
    for weights in [LaplacianWeights::Cotangent, LaplacianWeights::MeanValue, LaplacianWeights::NormalizedCotangent] {
        for (metric, scale) in [METRICS[0], METRICS[2], METRICS[4]] {
            for solver in [SolverChoice::Cholesky, SolverChoice::ConjugateGradient] {
                let at = options(0.3, metric, scale);
                let found = smoother(&with, weights, solver).tikhonov(&f, &at).unwrap().values;
                let expected = smoother(&without, weights, solver).tikhonov(&f[..4], &at).unwrap().values;
                assert_eq!(found[4], 0.9);
                assert!(error(&found[..4], &expected) < 1e-13, "{weights:?} {metric:?} {solver:?}");
            }
        }
    }
    // Nothing has an area: identity keeps everything, a mass scaled by the area is refused, uniform weights smooth.
    let line = mesh(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]);
    let f = [0.0, 1.0, 5.0];
    assert_eq!(cholesky(&line).tikhonov(&f, &options(1.0, Metric::Identity, MassScale::Raw)).unwrap().values, f);
    for metric in [Metric::Mass, Metric::Lumped] {
        let refused = cholesky(&line).tikhonov(&f, &options(1.0, metric, MassScale::MeanOne));
        assert_eq!(refused.expect_err("no area").code(), "ZeroArea");
    }
    let mut uniform = smoother(&line, LaplacianWeights::Uniform, SolverChoice::Auto);
    let found = uniform.tikhonov(&f, &options(1.0, Metric::Identity, MassScale::Raw)).unwrap().values;
    // L = 3I − 11ᵀ has eigenvalues 0, 3, 3: x = mean + (f − mean) · 1/(1 + 9).
    assert!(error(&found, &[1.8, 1.9, 2.3]) < 1e-14, "{found:?}");
}

#[test]
fn a_smoother_forgets_nothing_and_remembers_nothing() {
    let mesh = shapes::torus(13, 9, 0.4).unwrap();
    let f = noise(mesh.vertex_count(), 3);
    let mut used = cholesky(&mesh);
    let mut bad = f.clone();
    bad[11] = f64::NAN;
    for (metric, scale) in METRICS {
        for epsilon in [0.05, 3.0, 0.05] {
            let at = options(epsilon, metric, scale);
            let fresh = cholesky(&mesh).tikhonov(&f, &at).unwrap();
            assert_eq!(used.tikhonov(&f, &at).unwrap(), fresh);
            // Each refused in its own way, between good runs.
            let code = |smoother: &mut Smoother, f: &[f64], at| smoother.tikhonov(f, &at).expect_err("refused").code();
            for epsilon in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                assert_eq!(code(&mut used, &f, options(epsilon, metric, scale)), "InvalidOption");
            }
            assert_eq!(code(&mut used, &bad, at), "NonFiniteValue");
            assert_eq!(code(&mut used, &f[1..], at), "LengthMismatch");
            assert_eq!(code(&mut used, &f, TikhonovOptions { channels: 0, ..at }), "InvalidOption");
            assert_eq!(code(&mut used, &f, TikhonovOptions { channels: 2, ..at }), "LengthMismatch");
            assert_eq!(code(&mut used, &f, TikhonovOptions { channels: usize::MAX, ..at }), "LengthMismatch");
            let hopeless = used.tikhonov(&f, &options(1e-200, metric, scale));
            assert!(hopeless.is_err(), "{metric:?} {scale:?}");
        }
    }
}
