//! Interpolation and least squares with constraints against dense algebra, by every solver.

use morse_smooth::field::{DeltaOptions, Features};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::LaplacianWeights;
use morse_smooth::smooth::{
    Constraints, Energy, InterpolateOptions, LeastSquaresOptions, Operator, Precision, Smoothed, Smoother,
    SmootherOptions, SolverChoice, TikhonovOptions, Unconstrained, constrained_vertices,
};

use crate::dense_reference::{Reference, error, meshes, named, settings, smoother, sparse_set};
use crate::iterative::{needles, slivers};
use crate::support::noise;

type Call<'a> = dyn Fn(&mut Smoother, &[f64]) -> morse_smooth::Result<Smoothed> + 'a;

const ENERGIES: [Energy; 2] = [Energy::Harmonic, Energy::Biharmonic];

fn field(mesh: &TriMesh) -> Vec<f64> {
    noise(mesh.vertex_count(), 7).iter().map(|x| 40.0 * x - 300.0).collect()
}

fn interpolate(smoother: &mut Smoother, f: &[f64], vertices: &[u32], energy: Energy) -> morse_smooth::Result<Smoothed> {
    let constraints = named(vertices, Unconstrained::Keep);
    smoother.interpolate(f, &InterpolateOptions { constraints, energy, channels: 1, ..InterpolateOptions::default() })
}

fn fit(
    smoother: &mut Smoother,
    f: &[f64],
    vertices: &[u32],
    weights: Option<&[f64]>,
    epsilon: f64,
) -> morse_smooth::Result<Smoothed> {
    let constraints = named(vertices, Unconstrained::Keep);
    smoother.least_squares(
        f,
        &LeastSquaresOptions { constraints, epsilon, weights, channels: 1, ..LeastSquaresOptions::default() },
    )
}

/// Sparse vertices, and all critical points with their stars.
fn sets(mesh: &TriMesh, f: &[f64], reference: &Reference) -> [Vec<u32>; 2] {
    let features = Features::CriticalPoints(DeltaOptions { delta: 0.3, ..DeltaOptions::default() });
    let stars = Constraints { features, stars: true, unconstrained: Unconstrained::Keep };
    [
        sparse_set(reference, 29),
        constrained_vertices(mesh, f, 1, morse_smooth::field::Missing::Error, &stars, &morse_smooth::Watch::none())
            .unwrap(),
    ]
}

#[test]
fn interpolations_agree_with_dense_algebra() {
    for (name, mesh) in meshes() {
        let f = field(&mesh);
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            for set in sets(&mesh, &f, &reference) {
                for energy in ENERGIES {
                    let context = format!("{name} {setting:?} {energy:?} {} constraints", set.len());
                    let found = interpolate(&mut smoother, &f, &set, energy).expect(&context);
                    let expected = reference.interpolated(&f, &set, energy);
                    let wrong = error(&f, &found.values, &expected);
                    assert!(wrong < 1e-10, "{context}: {wrong:e}");
                    let solver = &found.reports[0].solver;
                    assert_eq!(solver.unknowns, reference.solved(&reference.free(&set), &set), "{context}");
                    assert_eq!(
                        solver.route.name(),
                        if solver.unknowns == 0 { "none" } else { "cholesky" },
                        "{context}"
                    );
                }
            }
        }
    }
}

#[test]
fn least_squares_agree_with_dense_algebra() {
    for (name, mesh) in meshes() {
        let f = field(&mesh);
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            for (number, set) in sets(&mesh, &f, &reference).into_iter().enumerate() {
                let weights: Vec<f64> = noise(set.len(), 5).iter().map(|x| 10.0_f64.powf(2.0 * x)).collect();
                for (epsilon, weights) in
                    [(1e-4, None), (1e-2, Some(&weights)), (1.0, None), (1e2, Some(&weights)), (1e4, None)]
                {
                    if number == 1 && epsilon == 1e2 {
                        continue;
                    }
                    let mut pull = vec![0.0; f.len()];
                    set.iter().enumerate().for_each(|(i, &v)| pull[v as usize] = weights.map_or(1.0, |w| w[i]));
                    let context = format!("{name} {setting:?} {} constraints, ε = {epsilon:e}", set.len());
                    let found = fit(&mut smoother, &f, &set, weights.map(Vec::as_slice), epsilon).expect(&context);
                    let expected = reference.least_squares(&f, &pull, epsilon);
                    let wrong = error(&f, &found.values, &expected);
                    assert!(wrong < 1e-10, "{context}: {wrong:e}");
                    let solved = reference.solved(&reference.reached(&set), &set);
                    assert_eq!(found.reports[0].solver.unknowns, solved, "{context}");
                }
            }
        }
    }
}

/// What solver and precision come to, or the code of the error.
fn outcome(
    mesh: &TriMesh,
    (weights, operator): (LaplacianWeights, Operator),
    (solver, precision): (SolverChoice, Precision),
    run: &dyn Fn(&mut Smoother) -> morse_smooth::Result<Smoothed>,
) -> Result<Smoothed, &'static str> {
    let options = SmootherOptions { weights, operator, solver, precision, ..SmootherOptions::default() };
    run(&mut Smoother::new(mesh, options).unwrap()).map_err(|error| error.code())
}

#[test]
fn every_solver_comes_to_the_same() {
    use Precision::{Double, Single};
    for (name, mesh) in meshes() {
        let f = field(&mesh);
        for setting in settings() {
            let reference = Reference::new(&smoother(&mesh, setting, SolverChoice::Auto));
            let set = sparse_set(&reference, 29);
            let pull: Vec<f64> = (0..f.len() as u32).map(|v| f64::from(u8::from(set.contains(&v)))).collect();
            let mut calls: Vec<(String, Vec<f64>, Box<Call<'_>>)> = Vec::new();
            for energy in ENERGIES {
                let (f, set) = (&f, &set);
                let call = Box::new(move |s: &mut Smoother, f: &[f64]| interpolate(s, f, set, energy));
                calls.push((format!("{energy:?}"), reference.interpolated(f, set, energy), call));
            }
            for epsilon in [1e-2, 1e2] {
                let (f, set) = (&f, &set);
                let call = Box::new(move |s: &mut Smoother, f: &[f64]| fit(s, f, set, None, epsilon));
                calls.push((format!("ε = {epsilon:e}"), reference.least_squares(f, &pull, epsilon), call));
            }
            for (call, expected, run) in &calls {
                for how in [
                    (SolverChoice::Auto, Single),
                    (SolverChoice::Cholesky, Double),
                    (SolverChoice::Cholesky, Single),
                    (SolverChoice::ConjugateGradient, Double),
                ] {
                    let context = format!("{name} {setting:?} {call} {how:?}");
                    let found = outcome(&mesh, setting, how, &|s| run(s, &f)).expect(&context);
                    let wrong = error(&f, &found.values, expected);
                    assert!(wrong < 1e-9, "{context}: {wrong:e}");
                    let iterates = how.0 == SolverChoice::ConjugateGradient && found.reports[0].solver.unknowns > 0;
                    assert_eq!(
                        found.reports[0].solver.route.name().starts_with("cg") && how.1 == Double,
                        iterates,
                        "{context}"
                    );
                }
            }
        }
    }
}

#[test]
fn alternating_calls_leave_nothing_behind() {
    let mesh = shapes::torus(13, 9, 0.4).unwrap();
    let f = noise(mesh.vertex_count(), 3);
    let mut bad = f.clone();
    bad[11] = f64::NAN;
    for setting in settings() {
        for solver in [SolverChoice::Auto, SolverChoice::ConjugateGradient] {
            let fresh = || smoother(&mesh, setting, solver);
            let mut used = fresh();
            let (few, many): (Vec<u32>, Vec<u32>) = (vec![0, 50, 99], (0..117).step_by(4).collect());
            let weights: Vec<f64> = (1..=many.len()).map(|i| i as f64).collect();
            let tikhonov = |epsilon: f64| {
                let at = TikhonovOptions { epsilon, ..TikhonovOptions::default() };
                move |s: &mut Smoother, f: &[f64]| s.tikhonov(f, &at)
            };
            let interpolation = |energy: Energy, set: &[u32]| {
                let set = set.to_vec();
                move |s: &mut Smoother, f: &[f64]| {
                    let constraints = named(&set, Unconstrained::Error);
                    s.interpolate(
                        f,
                        &InterpolateOptions { constraints, energy, channels: 1, ..InterpolateOptions::default() },
                    )
                }
            };
            let fitting = |set: &[u32], weights: Option<Vec<f64>>, epsilon: f64| {
                let set = set.to_vec();
                move |s: &mut Smoother, f: &[f64]| {
                    let (constraints, weights) = (named(&set, Unconstrained::Error), weights.as_deref());
                    s.least_squares(
                        f,
                        &LeastSquaresOptions {
                            constraints,
                            epsilon,
                            weights,
                            channels: 1,
                            ..LeastSquaresOptions::default()
                        },
                    )
                }
            };
            let calls: Vec<Box<Call<'_>>> = vec![
                Box::new(tikhonov(0.1)),
                Box::new(fitting(&few, None, 0.1)),
                Box::new(interpolation(Energy::Harmonic, &few)),
                Box::new(fitting(&many, None, 0.1)),
                Box::new(interpolation(Energy::Biharmonic, &few)),
                Box::new(fitting(&many, Some(weights), 0.1)),
                Box::new(tikhonov(1e-200)),
                Box::new(interpolation(Energy::Harmonic, &many)),
                Box::new(tikhonov(3.0)),
                Box::new(interpolation(Energy::Harmonic, &[])),
                Box::new(fitting(&many, Some(vec![0.0]), 0.1)),
                Box::new(fitting(&[], None, 0.1)),
            ];
            for order in [1, 5, 7] {
                for number in 0..2 * calls.len() {
                    let call = &calls[number * order % calls.len()];
                    assert_eq!(repeated(&mut used, call, &f), call(&mut fresh(), &f), "{setting:?} {number}");
                    assert_eq!(call(&mut used, &bad).unwrap_err().code(), "NonFiniteValue");
                }
            }
        }
    }
}

/// Twice by the used smoother, which must be the same.
fn repeated(used: &mut Smoother, call: &Call<'_>, f: &[f64]) -> morse_smooth::Result<Smoothed> {
    let first = call(used, f);
    assert_eq!(call(used, f), first);
    first
}

#[test]
fn iterations_on_needles_converge_or_say_that_they_do_not() {
    let (mut agreed, mut refused) = (0, 0);
    for (name, mesh) in [("slivers", slivers(20, 1e-5)), ("needles", needles(17))] {
        let f = field(&mesh);
        let n = f.len() as u32;
        for setting in settings() {
            for set in [vec![n / 2], (0..n).step_by(40).collect(), (0..n).filter(|v| v % 3 > 0).collect()] {
                let (f, set) = (&f, &set);
                let mut calls: Vec<(String, Box<Call<'_>>)> = Vec::new();
                for energy in ENERGIES {
                    calls.push((format!("{energy:?}"), Box::new(move |s, f| interpolate(s, f, set, energy))));
                }
                for epsilon in [1e-3, 10.0] {
                    calls.push((format!("ε = {epsilon:e}"), Box::new(move |s, f| fit(s, f, set, None, epsilon))));
                }
                for (call, run) in calls {
                    let context = format!("{name} {setting:?} {} constraints {call}", set.len());
                    let [direct, iterative] = [SolverChoice::Cholesky, SolverChoice::ConjugateGradient]
                        .map(|solver| outcome(&mesh, setting, (solver, Precision::Double), &|s| run(s, f)));
                    match (direct, iterative) {
                        (Ok(direct), Ok(found)) => {
                            let wrong = error(f, &found.values, &direct.values);
                            assert!(wrong < 1e-8, "{context}: {wrong:e}");
                            agreed += 1;
                        }
                        (direct, iterative) => {
                            for code in [direct, iterative].into_iter().filter_map(Result::err) {
                                assert!(["NotConverged", "NotPositiveDefinite"].contains(&code), "{context}: {code}");
                            }
                            refused += 1;
                        }
                    }
                }
            }
        }
    }
    // Without symmetry, and with a mass of needles.
    assert!(agreed > 80 && refused < 40, "{agreed} {refused}");
}

/// With a single constrained vertex in a component its value is the answer, on whatever triangles.
#[test]
fn one_constraint_makes_a_component_constant() {
    let thin = crate::support::mesh(&[[1.98e-4, 1.82, 0.], [2.07e-4, 2.9, 0.], [4.09e-4, 3.17, 0.]], &[[0, 1, 2]]);
    let thinner = crate::support::mesh(
        &[[5.31e-8, 0.531, 0.], [4.51e-8, 1.3, 0.], [1.28e-7, 0.271, 0.], [1.77e-7, 1.03, 0.]],
        &[[0, 2, 3], [0, 3, 1]],
    );
    let sphere = shapes::sphere(2).expect("a sphere");
    for (mesh, vertex) in [(&thin, 1), (&thinner, 0), (&sphere, 7)] {
        let f = field(mesh);
        let n = mesh.vertex_count() as f64;
        for operator in [Operator::Paper, Operator::Fem] {
            for weights in [LaplacianWeights::Cotangent, LaplacianWeights::MeanValue] {
                if operator == Operator::Fem && weights != LaplacianWeights::Cotangent {
                    continue;
                }
                let options = SmootherOptions { operator, weights, bounds: true, ..SmootherOptions::default() };
                let mut smoother = Smoother::new(mesh, options).expect("a smoother");
                let mut results: Vec<Smoothed> = ENERGIES
                    .map(|energy| interpolate(&mut smoother, &f, &[vertex], energy).expect("a constant field"))
                    .into();
                if operator == Operator::Paper {
                    results.push(fit(&mut smoother, &f, &[vertex], None, 1.0).expect("a constant field"));
                }
                for result in results {
                    assert!(result.values.iter().all(|x| x.to_bits() == f[vertex as usize].to_bits()), "constant");
                    // All move as far as the one does.
                    let factor = result.reports[0].perturbation_factor.expect("a factor");
                    assert!((n.sqrt()..n.sqrt() * (1.0 + 1e-5)).contains(&factor), "{factor}");
                }
            }
        }
    }
    // A component with one constraint beside one with several: each as if it were alone.
    let two = {
        let grid = shapes::grid(6, 5).expect("a grid");
        let count = grid.vertex_count() as u32;
        let shifted = grid.positions().chunks_exact(3).flat_map(|p| [p[0] + 9.0, p[1], p[2]]);
        let positions = grid.positions().iter().copied().chain(shifted).collect();
        let triangles = grid.connectivity().triangles().as_flattened();
        let triangles = triangles.iter().copied().chain(triangles.iter().map(|v| v + count)).collect();
        TriMesh::new(positions, triangles).expect("two grids")
    };
    let f = field(&two);
    let alone = shapes::grid(6, 5).expect("a grid");
    let mut smoother = Smoother::new(&alone, SmootherOptions::default()).expect("a smoother");
    let expected = interpolate(&mut smoother, &f[..30], &[0, 29, 12], Energy::Harmonic).expect("a field");
    let mut smoother = Smoother::new(&two, SmootherOptions::default()).expect("a smoother");
    let found = interpolate(&mut smoother, &f, &[0, 29, 12, 44], Energy::Harmonic).expect("a field");
    for v in 0..30 {
        assert!((found.values[v] - expected.values[v]).abs() <= 1e-9, "vertex {v}");
    }
    assert!(found.values[30..].iter().all(|x| x.to_bits() == f[44].to_bits()));
}

/// However large ε is, conjugate gradients find what the constraints leave open.
#[test]
fn large_epsilons_converge_by_conjugate_gradients() {
    let grid = shapes::grid(3, 3).expect("a grid");
    let sphere = shapes::sphere(2).expect("a sphere");
    for (mesh, vertices) in [(&grid, vec![0, 5, 6]), (&sphere, vec![0, 11, 25, 40, 60])] {
        let f = field(mesh);
        for weights in [LaplacianWeights::Cotangent, LaplacianWeights::MeanValue, LaplacianWeights::NormalizedCotangent]
        {
            let l = crate::support::dense(
                &morse_smooth::operators::laplacian(mesh, weights, &morse_smooth::Watch::none()).expect("a Laplacian"),
            );
            for epsilon in [1e-3, 1.0, 1e3, 1e6, 1e9, 1e12, 1e15] {
                let options =
                    SmootherOptions { weights, solver: SolverChoice::ConjugateGradient, ..SmootherOptions::default() };
                let mut smoother = Smoother::new(mesh, options).expect("a smoother");
                let found = fit(&mut smoother, &f, &vertices, None, epsilon);
                let found = found.unwrap_or_else(|error| panic!("{weights:?}, ε = {epsilon:e}: {error}"));
                let (n, k) = (f.len(), vertices.len());
                // From 1e12 on the constraints are met to eight digits; before, their rows are put first: so Householder's
                // reflections lose nothing of the light ones.
                let is_met = epsilon >= 1e12;
                let heavy = if is_met { 1e3 } else { epsilon.sqrt() };
                let mut rows = nalgebra::DMatrix::zeros(n + k, n);
                let mut right = nalgebra::DVector::zeros(n + k);
                for (row, &v) in vertices.iter().enumerate() {
                    rows[(row, v as usize)] = heavy;
                    right[row] = heavy * f[v as usize];
                }
                rows.view_mut((k, 0), (n, n)).copy_from(&l);
                if is_met {
                    // What the constrained vertices contribute is known.
                    for &v in &vertices {
                        for row in 0..n {
                            right[k + row] -= l[(row, v as usize)] * f[v as usize];
                            rows[(k + row, v as usize)] = 0.0;
                        }
                    }
                }
                let factored = rows.qr();
                let image = factored.q().transpose() * right;
                let expected = factored.r().solve_upper_triangular(&image).expect("a regular matrix");
                for v in 0..n {
                    assert!(
                        (found.values[v] - expected[v]).abs() <= 1e-6,
                        "{weights:?}, ε = {epsilon:e}, vertex {v}: {} {}",
                        found.values[v],
                        expected[v]
                    );
                }
            }
        }
    }
}
