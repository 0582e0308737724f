//! The ways that a smoother solves its systems: which one it takes, that all give the same, and what is kept in between.

use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale};
use morse_smooth::smooth::{
    Metric, Operator, Precision, Smoothed, Smoother, SmootherOptions, SolverChoice, TikhonovOptions,
};
use nalgebra::DMatrix;

use crate::exact;
use crate::iterative::{needles, slivers};
use crate::operators::{ALL_WEIGHTS, reference_laplacian, reference_mass};
use crate::support::{annulus, islands, jittered, mesh, noise, random_surface};

const METRICS: [Metric; 3] = [Metric::Identity, Metric::Mass, Metric::Lumped];
const SOLVERS: [SolverChoice; 3] = [SolverChoice::Auto, SolverChoice::Cholesky, SolverChoice::ConjugateGradient];
const PRECISIONS: [Precision; 2] = [Precision::Double, Precision::Single];

fn at(epsilon: f64, metric: Metric) -> TikhonovOptions {
    TikhonovOptions { epsilon, metric, ..TikhonovOptions::default() }
}

fn smoother(mesh: &TriMesh, options: SmootherOptions) -> Smoother {
    Smoother::new(mesh, options).unwrap()
}

fn direct(precision: Precision) -> SmootherOptions {
    SmootherOptions { solver: SolverChoice::Cholesky, precision, ..SmootherOptions::default() }
}

/// Meshes with everything that a system can be made of, small enough for dense elimination with 32 digits.
fn meshes() -> Vec<(&'static str, TriMesh)> {
    let flat = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.5, 0.5, 0.0], [2.0, 0.5, 0.1]];
    vec![
        ("sphere", jittered(&shapes::sphere(2).unwrap(), 0.03, 2)),
        ("torus", shapes::torus(11, 7, 0.4).unwrap()),
        ("boundary", annulus()),
        ("components and isolated vertices", islands()),
        ("holes", random_surface(4, &shapes::grid(9, 9).unwrap(), 0.2)),
        ("zero-area triangle", mesh(&flat, &[[0, 1, 2], [0, 2, 3], [0, 2, 4], [1, 5, 2]])),
    ]
}

/// The solution of eq. (3) or (5), or with the finite-element operator, on the vertices that have an area; the others keep
/// their value.
pub(crate) fn reference(
    mesh: &TriMesh,
    weights: LaplacianWeights,
    operator: Operator,
    metric: Metric,
    epsilon: f64,
    f: &[f64],
) -> Vec<f64> {
    let n = mesh.vertex_count();
    let areas = reference_mass(mesh, MassScale::Raw).column_sum();
    let laplacian = reference_laplacian(mesh, weights);
    let mass = match (operator, metric) {
        (Operator::Fem, _) => DMatrix::from_diagonal(&areas),
        (_, Metric::Identity) => DMatrix::identity(n, n),
        (_, Metric::Mass) => reference_mass(mesh, MassScale::MeanOne),
        (_, Metric::Lumped) => DMatrix::from_diagonal(&reference_mass(mesh, MassScale::MeanOne).column_sum()),
    };
    let kept: Vec<usize> = (0..n).filter(|&v| areas[v] > 0.0 || laplacian[(v, v)] != 0.0).collect();
    let part = |matrix: &DMatrix<f64>| matrix.select_rows(&kept).select_columns(&kept);
    let weights: Vec<f64> = kept.iter().map(|&v| if operator == Operator::Fem { areas[v] } else { 1.0 }).collect();
    let known: Vec<f64> = kept.iter().map(|&v| f[v]).collect();
    let solution = exact::weighted_tikhonov(&part(&laplacian), &weights, &part(&mass), epsilon, &known);
    let mut expected = f.to_vec();
    kept.iter().zip(&solution).for_each(|(&v, &x)| expected[v] = x);
    expected
}

/// Largest difference as a fraction of the largest value of the input.
pub(crate) fn error(f: &[f64], found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = f.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    found
        .iter()
        .zip(expected)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, |m: f64, d| if d > m || d.is_nan() { d } else { m })
        / size
}

/// The routes that may be taken, and the precisions they may report.
fn expected_routes(options: &SmootherOptions, metric: Metric) -> (&'static [&'static str], &'static str) {
    let symmetric = options.weights.is_symmetric();
    let splits = symmetric && (metric == Metric::Identity || options.operator == Operator::Fem);
    let single = options.precision == Precision::Single;
    let precision = if single { "single" } else { "double" };
    match options.solver {
        SolverChoice::ConjugateGradient => (if symmetric { &["cgMultigrid"] } else { &["cgJacobi"] }, "double"),
        _ if splits => (&["complexCholesky"], precision),
        // A single-precision factor may serve conjugate gradients better than refinement.
        _ if symmetric && single => (&["cholesky", "cgComplexCholesky"], precision),
        _ => (&["cholesky"], precision),
    }
}

/// Every combination of weights, operator, solver and precision that there is.
fn combinations() -> Vec<SmootherOptions> {
    let mut all = Vec::new();
    for weights in ALL_WEIGHTS {
        for operator in [Operator::Paper, Operator::Fem] {
            for solver in SOLVERS {
                for precision in PRECISIONS {
                    if operator == Operator::Paper || weights == LaplacianWeights::Cotangent {
                        all.push(SmootherOptions { weights, operator, solver, precision, bounds: false });
                    }
                }
            }
        }
    }
    all
}

fn metrics_of(options: &SmootherOptions) -> &'static [Metric] {
    if options.operator == Operator::Fem { &[Metric::Mass] } else { &METRICS }
}

#[test]
fn all_routes_agree_with_dense_algebra_and_are_reported() {
    for (name, mesh) in meshes() {
        let n = mesh.vertex_count();
        let f = noise(n, 7);
        let areas = reference_mass(&mesh, MassScale::Raw).column_sum();
        for weights in ALL_WEIGHTS {
            for operator in [Operator::Paper, Operator::Fem] {
                let all = combinations();
                let all: Vec<_> = all.iter().filter(|o| o.weights == weights && o.operator == operator).collect();
                for &metric in all.first().map_or(&[][..], |options| metrics_of(options)) {
                    for epsilon in [1.0, 1e-2, 1e-4, 1e-6] {
                        let expected = reference(&mesh, weights, operator, metric, epsilon, &f);
                        for &options in &all {
                            let context = format!("{name} {options:?} {metric:?} ε = {epsilon:e}");
                            let found = smoother(&mesh, *options).tikhonov(&f, &at(epsilon, metric));
                            let found = found.unwrap_or_else(|problem| panic!("{context}: {problem}"));
                            let solver = &found.reports[0].solver;
                            let wrong = error(&f, &found.values, &expected);
                            let (route, used) = (solver.route.name(), solver.precision.name());
                            let accuracy = if used == "single" { 1e-9 } else { 1e-11 };
                            assert!(wrong < accuracy, "{context}: {wrong:e}");

                            let (routes, precision) = expected_routes(options, metric);
                            assert!(routes.contains(&route), "{context}: {route}");
                            let fell_back = precision == "single" && used == "doubleAfterSingle";
                            assert!(used == precision || fell_back, "{context}: {used}");
                            assert!(!fell_back || epsilon < 1e-3, "{context}: {used}");
                            assert_eq!(solver.factor_nonzeros > 0, route.ends_with("holesky"), "{context}");
                            assert_eq!(solver.iterations > 0, route.starts_with("cg"), "{context}");
                            assert!(solver.refinement_steps <= 12, "{context}: {}", solver.refinement_steps);
                            let reached = (0..n).filter(|&v| areas[v] > 0.0).count();
                            if weights != LaplacianWeights::Uniform {
                                assert_eq!(solver.unknowns, reached, "{context}");
                            }
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn nothing_to_solve_is_a_route_of_its_own() {
    let line = mesh(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]);
    let f = [0.0, 1.0, 5.0];
    for options in combinations().into_iter().filter(|o| o.weights == LaplacianWeights::Cotangent) {
        let metric = if options.operator == Operator::Fem { Metric::Mass } else { Metric::Identity };
        let found = smoother(&line, options).tikhonov(&f, &at(1.0, metric)).unwrap();
        assert_eq!(found.values, f);
        let report = &found.reports[0].solver;
        assert_eq!((report.route.name(), report.precision.name(), report.unknowns), ("none", "double", 0));
        assert_eq!((report.factor_nonzeros, report.iterations, report.relative_residual), (0, 0, 0.0));
    }
}

// ---- single precision ----

#[test]
fn single_precision_is_refined_to_double_accuracy() {
    for (name, mesh) in [
        ("sphere", jittered(&shapes::sphere(2).unwrap(), 0.02, 5)),
        ("torus", shapes::torus(16, 9, 0.4).unwrap()),
        ("terrain", shapes::terrain(12, 11, 4).unwrap()),
        ("poles", shapes::irregular_sphere(7, 16, 4).unwrap()),
    ] {
        let f: Vec<f64> = noise(mesh.vertex_count(), 3).iter().map(|x| 20.0 * x + 7.0).collect();
        for (operator, metric) in [
            (Operator::Paper, Metric::Identity),
            (Operator::Paper, Metric::Mass),
            (Operator::Paper, Metric::Lumped),
            (Operator::Fem, Metric::Mass),
        ] {
            let mut single = smoother(&mesh, SmootherOptions { operator, ..direct(Precision::Single) });
            for epsilon in [1.0, 1e-2, 1e-4] {
                let expected = reference(&mesh, LaplacianWeights::Cotangent, operator, metric, epsilon, &f);
                let found = single.tikhonov(&f, &at(epsilon, metric)).unwrap();
                let wrong = error(&f, &found.values, &expected);
                let context = format!("{name} {operator:?} {metric:?} ε = {epsilon:e}");
                assert!(wrong <= 1e-9, "{context}: {wrong:e}");
                if epsilon >= 1e-2 {
                    assert_eq!(found.reports[0].solver.precision.name(), "single", "{context}");
                }
            }
        }
    }
}

/// Both precisions for a system that may be too much for the single one.
fn never_wrong(name: &str, mesh: &TriMesh, epsilon: f64, metric: Metric, accuracy: f64) -> Option<&'static str> {
    let f = noise(mesh.vertex_count(), 5);
    let options = at(epsilon, metric);
    let double = smoother(mesh, direct(Precision::Double)).tikhonov(&f, &options);
    let single = smoother(mesh, direct(Precision::Single)).tikhonov(&f, &options);
    let context = format!("{name} {metric:?} ε = {epsilon:e}");
    match (double, single) {
        (Ok(double), Ok(single)) => {
            let wrong = error(&f, &single.values, &double.values);
            let precision = single.reports[0].solver.precision.name();
            assert!(wrong < accuracy, "{context}, {precision}: {wrong:e}");
            assert!(["single", "doubleAfterSingle"].contains(&precision), "{context}: {precision}");
            Some(precision)
        }
        (Err(double), Err(single)) => {
            assert!(["NotPositiveDefinite", "NotConverged"].contains(&single.code()), "{context}: {double}, {single}");
            None
        }
        (Ok(_), Err(problem)) => panic!("{context}: {problem}, but double precision does"),
        // A preconditioner of little precision may do where refinement does not.
        (Err(_), Ok(single)) => Some(single.reports[0].solver.precision.name()),
    }
}

#[test]
fn single_precision_gives_way_where_it_is_not_enough() {
    let mut fallen_back = 0;
    for (name, mesh) in [
        ("torus", shapes::torus(30, 20, 0.4).unwrap()),
        ("grid", shapes::grid(22, 22).unwrap()),
        ("needles", needles(15)),
        ("slivers", slivers(20, 1e-5)),
    ] {
        for metric in METRICS {
            for epsilon in [1.0, 1e-4, 1e-8, 1e-12] {
                let precision = never_wrong(name, &mesh, epsilon, metric, 1e-7);
                fallen_back += usize::from(precision == Some("doubleAfterSingle"));
                let regular = ["torus", "grid"].contains(&name);
                let least = if regular { 1e-9 } else { 0.1 };
                assert!(precision.is_some() || epsilon < least, "{name} {metric:?} {epsilon:e}");
            }
        }
    }
    assert!(fallen_back > 0, "the way back was not tried");
}

// ---- kept between calls ----

fn same(used: &Smoothed, fresh: &Smoothed, context: &str) {
    let wrong = error(&fresh.values, &used.values, &fresh.values);
    assert!(wrong <= 1e-12, "{context}: {wrong:e}");
    let (used, fresh) = (&used.reports[0].solver, &fresh.reports[0].solver);
    assert_eq!(
        (used.route, used.precision, used.factor_nonzeros),
        (fresh.route, fresh.precision, fresh.factor_nonzeros)
    );
}

#[test]
fn a_used_smoother_gives_what_a_fresh_one_gives() {
    let mesh = shapes::torus(20, 13, 0.3).unwrap();
    let (f, g) = (noise(mesh.vertex_count(), 3), noise(mesh.vertex_count(), 4));
    let mut broken = f.clone();
    broken[5] = f64::INFINITY;
    // ε near and far, the same again, and one that is too much for single precision or for any.
    let calls = [
        (1.0, Metric::Mass),
        (1e-3, Metric::Mass),
        (1e-3, Metric::Identity),
        (1e-13, Metric::Identity),
        (1e-3, Metric::Identity),
        (1e-3, Metric::Lumped),
        (1e-300, Metric::Lumped),
        (1e-3, Metric::Lumped),
        (1e-13, Metric::Mass),
        (1e6, Metric::Mass),
        (1e-2, Metric::Identity),
        (1.0, Metric::Mass),
    ];
    for options in combinations().into_iter().filter(|o| o.solver != SolverChoice::ConjugateGradient) {
        let mut used = smoother(&mesh, options);
        for (epsilon, metric) in calls {
            let metric = if options.operator == Operator::Fem { Metric::Mass } else { metric };
            for field in [&f, &g, &f] {
                let context = format!("{options:?} {metric:?} ε = {epsilon:e}");
                let fresh = smoother(&mesh, options).tikhonov(field, &at(epsilon, metric));
                match (used.tikhonov(field, &at(epsilon, metric)), fresh) {
                    (Ok(used), Ok(fresh)) => same(&used, &fresh, &context),
                    (Err(used), Err(fresh)) => assert_eq!(used, fresh, "{context}"),
                    (used, fresh) => panic!("{context}: {:?} {:?}", used.map(|_| ()), fresh.map(|_| ())),
                }
            }
            assert!(used.tikhonov(&broken, &at(epsilon, metric)).is_err());
            assert!(used.tikhonov(&f, &at(-1.0, metric)).is_err());
        }
    }
}

#[test]
fn many_channels_are_solved_as_one_by_one() {
    let mesh = shapes::torus(14, 9, 0.3).unwrap();
    let n = mesh.vertex_count();
    for options in combinations() {
        for &metric in metrics_of(&options) {
            let mut smoother = smoother(&mesh, options);
            let fields: Vec<Vec<f64>> = (0..11).map(|c| noise(n, c)).collect();
            let together: Vec<f64> = (0..11 * n).map(|i| fields[i % 11][i / 11]).collect();
            let found = smoother.tikhonov(&together, &TikhonovOptions { channels: 11, ..at(0.01, metric) }).unwrap();
            for (c, field) in fields.iter().enumerate() {
                let alone = smoother.tikhonov(field, &at(0.01, metric)).unwrap().values;
                let channel: Vec<f64> = found.values.iter().skip(c).step_by(11).copied().collect();
                let wrong = error(field, &channel, &alone);
                let accuracy = if options.precision == Precision::Single { 1e-10 } else { 1e-12 };
                assert!(wrong < accuracy, "{options:?} {metric:?} channel {c}: {wrong:e}");
            }
        }
    }
}

// ---- errors ----

#[test]
fn a_system_that_fails_names_a_vertex_of_the_mesh() {
    // Isolated vertices come first, so an unknown and its vertex have different numbers.
    let torus = shapes::torus(9, 7, 0.3).unwrap();
    let isolated = 100;
    let mut positions = vec![0.5; 3 * isolated as usize];
    positions.extend_from_slice(torus.positions());
    let triangles = torus.connectivity().triangles().as_flattened().iter().map(|v| v + isolated).collect();
    let mesh = TriMesh::new(positions, triangles).unwrap();
    let f = noise(mesh.vertex_count(), 2);
    let mut refused = 0;
    for solver in [SolverChoice::Auto, SolverChoice::Cholesky] {
        for weights in ALL_WEIGHTS {
            for metric in METRICS {
                for epsilon in [1e-18, 1e-20, 1e-30, 1e-60, 1e-300] {
                    let options = SmootherOptions { solver, weights, ..SmootherOptions::default() };
                    let Err(problem) = smoother(&mesh, options).tikhonov(&f, &at(epsilon, metric)) else { continue };
                    if problem.code() != "NotPositiveDefinite" {
                        continue;
                    }
                    let [("column", morse_smooth::error::Detail::Integer(vertex))] = problem.detail()[..] else {
                        panic!("{problem}: {:?}", problem.detail())
                    };
                    let used = u64::from(isolated)..mesh.vertex_count() as u64;
                    assert!(used.contains(&vertex), "{weights:?} {metric:?} ε = {epsilon:e}: vertex {vertex}");
                    assert!(problem.to_string().contains(&vertex.to_string()), "{problem}");
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > 20, "{refused} refused");
}

/// Triangles between any vertices fill a factor up: it would take far longer than iterations, which are taken instead, and for the next ε
/// without an analysis. The error is at most the residual over ε, as B = I.
#[test]
fn a_factor_that_fills_up_is_not_computed() {
    let n = 3000_u32;
    let positions: Vec<f64> = noise(3 * n as usize, 4).to_vec();
    let mut random = shapes::Random::new(9);
    let triangles: Vec<u32> = (0..2 * n)
        .flat_map(|_| {
            let a = (random.uniform() * f64::from(n)) as u32;
            let [b, c] = [1, 1000].map(|first| a + first + (random.uniform() * 900.0) as u32);
            [a, b % n, c % n]
        })
        .collect();
    let mesh = TriMesh::new(positions, triangles).unwrap();
    let f = noise(mesh.vertex_count(), 3);
    let mut smoother = smoother(&mesh, SmootherOptions::default());
    let laplacian = smoother.laplacian().clone();
    for epsilon in [1.0, 30.0] {
        let smoothed = smoother.tikhonov(&f, &at(epsilon, Metric::Identity)).unwrap();
        assert_eq!(smoothed.reports[0].solver.route.name(), "cgMultigrid");
        let times = |x: &[f64]| &laplacian * &DMatrix::from_column_slice(x.len(), 1, x);
        let image = times(times(&smoothed.values).as_slice());
        let rest = image.iter().zip(&smoothed.values).zip(&f).map(|((l, x), f)| l + epsilon * (x - f));
        let error = rest.map(|r| r * r).sum::<f64>().sqrt() / epsilon;
        assert!(error < 1e-9, "ε = {epsilon}: {error:e}");
    }
    // A surface is no such thing.
    let torus = shapes::torus(60, 50, 0.3).unwrap();
    let smoothed =
        self::smoother(&torus, SmootherOptions::default()).tikhonov(&noise(3000, 1), &at(1.0, Metric::Identity));
    assert_eq!(smoothed.unwrap().reports[0].solver.route.name(), "complexCholesky");
}
