//! Smoothing where values are missing: left out as a hole would be, or filled in.

use morse_smooth::field::{DeltaOptions, Features, Missing, ScalarField, Threshold};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale, laplacian};
use morse_smooth::smooth::{
    BilateralOptions, Constraints, Energy, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Method, Metric,
    Operator, Smoothed, Smoother, SmootherOptions, SolverChoice, TikhonovOptions, Unconstrained, constrained_vertices,
    smoothness,
};
use morse_smooth::{Error, Watch};
use nalgebra::{DMatrix, DVector};

use crate::dense_reference::{Reference, error, meshes, settings, smoother, squared, together};
use crate::operators::reference_mass;
use crate::support::{every_kind, noise, random_surface};

/// All methods, each with its own choice of constraints.
fn methods(missing: Missing, channels: usize, listed: &[u32]) -> Vec<Method<'_>> {
    let keep = |features| Constraints { features, stars: true, unconstrained: Unconstrained::Keep };
    let few = Constraints { stars: false, unconstrained: Unconstrained::Mean, ..keep(Features::Vertices(listed)) };
    let critical = keep(Features::CriticalPoints(DeltaOptions::default()));
    let pairs = keep(Features::Persistence(Threshold::Relative(0.2)));
    let clusters = keep(Features::KMeans { clusters: 3, seed: 1 });
    let tikhonov = |metric| TikhonovOptions { metric, epsilon: 0.3, channels, missing, ..TikhonovOptions::default() };
    let interpolate = |constraints, energy| InterpolateOptions { constraints, energy, channels, missing };
    let fit = |constraints| LeastSquaresOptions { constraints, epsilon: 0.3, weights: None, channels, missing };
    vec![
        Method::Tikhonov(tikhonov(Metric::Mass)),
        Method::Tikhonov(tikhonov(Metric::Identity)),
        Method::Interpolate(interpolate(few, Energy::Harmonic)),
        Method::Interpolate(interpolate(critical, Energy::Biharmonic)),
        Method::LeastSquares(fit(few)),
        Method::LeastSquares(fit(pairs)),
        Method::LeastSquares(fit(clusters)),
        Method::LowPass(LowPassOptions { iterations: 3, channels, missing, ..LowPassOptions::default() }),
        Method::Bilateral(BilateralOptions {
            iterations: 2,
            radius: 0.6,
            sigma_distance: 0.3,
            sigma_value: 0.5,
            channels,
            missing,
        }),
    ]
}

/// The triangles whose vertices all have values, renumbered; and the old id of each vertex.
fn submesh(mesh: &TriMesh, has: &dyn Fn(u32) -> bool) -> Option<(TriMesh, Vec<u32>)> {
    let kept: Vec<[u32; 3]> =
        mesh.connectivity().triangles().iter().copied().filter(|t| t.iter().all(|&v| has(v))).collect();
    let mut vertices: Vec<u32> = kept.as_flattened().to_vec();
    vertices.sort_unstable();
    vertices.dedup();
    let triangles = kept.as_flattened().iter().map(|v| vertices.binary_search(v).unwrap() as u32).collect();
    let positions = vertices.iter().flat_map(|&v| mesh.position(v)).collect();
    TriMesh::new(positions, triangles).ok().map(|part| (part, vertices))
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn omitting_is_smoothing_the_rest() {
    let mut kinds = every_kind();
    kinds.push(("two components", together(&[shapes::torus(13, 10, 0.2).unwrap(), shapes::sphere(2).unwrap()])));
    kinds.push(("holes", random_surface(9, &shapes::torus(18, 14, 0.2).unwrap(), 0.2)));
    let options = SmootherOptions::default();
    for (name, mesh) in kinds {
        let n = mesh.vertex_count();
        for channels in [1, 2] {
            let mut values = noise(n * channels, 3);
            for v in (0..n).filter(|v| v % 9 == 4) {
                values[v * channels + v % channels] = f64::NAN;
            }
            let has = |v: u32| !values[v as usize * channels..][..channels].iter().any(|x| x.is_nan());
            let mut whole = Smoother::new(&mesh, options).unwrap();
            let Some((part, vertices)) = submesh(&mesh, &has) else {
                let refused = whole.apply(&values, &methods(Missing::Omit, channels, &[])[0], &Watch::none());
                assert_eq!(refused.map_err(|error| error.code()).err(), Some("EmptyMesh"), "{name}");
                continue;
            };
            let of_part: Vec<f64> =
                vertices.iter().flat_map(|&v| values[v as usize * channels..][..channels].to_vec()).collect();
            let local: Vec<u32> = (0..vertices.len() as u32).step_by(5).collect();
            let listed: Vec<u32> = local.iter().map(|&v| vertices[v as usize]).collect();
            let mut alone = Smoother::new(&part, options).unwrap();
            let pairs = methods(Missing::Omit, channels, &listed).into_iter();
            for (ours, theirs) in pairs.zip(methods(Missing::Error, channels, &local)) {
                let context = format!("{name}, {channels} channels, {}", ours.name().name());
                let expected = alone.apply(&of_part, &theirs, &Watch::none());
                let found = whole.apply(&values, &ours, &Watch::none());
                let (expected, found) = match (expected, found) {
                    (Ok(expected), Ok(found)) => (expected, found),
                    (expected, found) => {
                        let code = |outcome: Result<Smoothed, Error>| outcome.map_err(|error| error.code()).err();
                        assert_eq!(code(expected), code(found), "{context}");
                        continue;
                    }
                };
                assert_eq!(found.reports, expected.reports, "{context}");
                let mut wanted = values.clone();
                for (&v, x) in vertices.iter().zip(expected.values.chunks_exact(channels)) {
                    wanted[v as usize * channels..][..channels].copy_from_slice(x);
                }
                assert_eq!(bits(&found.values), bits(&wanted), "{context}");
            }
        }
    }
}

/// The constraints that are compared, with stars and without: vertices by number and every rule.
fn constraint_kinds(listed: &[u32]) -> Vec<Constraints<'_>> {
    let rules = [
        Features::Vertices(listed),
        Features::CriticalPoints(DeltaOptions::default()),
        Features::CriticalPoints(DeltaOptions { delta: 0.1, ..DeltaOptions::default() }),
        Features::Persistence(Threshold::Relative(0.2)),
        Features::KMeans { clusters: 3, seed: 1 },
    ];
    let both = |features| [true, false].map(|stars| Constraints { features, stars, ..Constraints::default() });
    rules.into_iter().flat_map(both).collect()
}

#[test]
fn constrained_vertices_are_those_of_the_rest() {
    let mut kinds = every_kind();
    kinds.push(("two components", together(&[shapes::torus(13, 10, 0.2).unwrap(), shapes::sphere(2).unwrap()])));
    let find = |mesh: &TriMesh, values: &[f64], channels, missing, constraints: &Constraints<'_>| {
        constrained_vertices(mesh, values, channels, missing, constraints, &Watch::none())
    };
    for (name, mesh) in kinds {
        let n = mesh.vertex_count();
        for channels in [1, 2] {
            let mut values = noise(n * channels, 8);
            for v in (0..n).filter(|v| v % 9 == 4) {
                values[v * channels + v % channels] = f64::NAN;
            }
            let has = |v: u32| !values[v as usize * channels..][..channels].iter().any(|x| x.is_nan());
            let Some((part, vertices)) = submesh(&mesh, &has) else {
                let refused = find(&mesh, &values, channels, Missing::Omit, &constraint_kinds(&[])[2]).unwrap_err();
                assert_eq!(refused.code(), "EmptyMesh", "{name}");
                continue;
            };
            let of_part: Vec<f64> =
                vertices.iter().flat_map(|&v| values[v as usize * channels..][..channels].to_vec()).collect();
            let local: Vec<u32> = (0..vertices.len() as u32).step_by(5).collect();
            let listed: Vec<u32> = local.iter().map(|&v| vertices[v as usize]).collect();
            for (ours, theirs) in constraint_kinds(&listed).iter().zip(constraint_kinds(&local)) {
                let mut expected = find(&part, &of_part, channels, Missing::Error, &theirs).unwrap();
                expected.iter_mut().for_each(|v| *v = vertices[*v as usize]);
                let context = format!("{name}, {channels} channels, {ours:?}");
                assert_eq!(find(&mesh, &values, channels, Missing::Omit, ours).unwrap(), expected, "{context}");
                // Filling constrains the same features; stars are those of the whole mesh, as far as there are values.
                let filled = find(&mesh, &values, channels, Missing::Fill, ours).unwrap();
                let plain = Constraints { stars: false, ..*ours };
                let mut features = find(&mesh, &values, channels, Missing::Omit, &plain).unwrap();
                if ours.stars {
                    features = morse_smooth::field::with_stars(mesh.connectivity(), &features);
                    features.retain(|&v| has(v));
                }
                assert_eq!(filled, features, "{context}");
            }
            // Vertices by number must have values.
            let gone = (0..n as u32).find(|&v| !has(v));
            for missing in [Missing::Omit, Missing::Fill] {
                if let Some(gone) = gone {
                    let listed = [gone];
                    let refused = find(&mesh, &values, channels, missing, &constraint_kinds(&listed)[0]).unwrap_err();
                    assert_eq!((refused.code(), refused.detail()), ("MissingValue", vec![("vertex", gone.into())]));
                }
            }
            let refused = find(&mesh, &values, channels, Missing::Error, &constraint_kinds(&[0])[0]);
            assert_eq!(refused.map_err(|error| error.code()).err(), gone.map(|_| "NonFiniteValue"), "{name}");
        }
    }
}

/// Smoothing says how many vertices it constrained: as many as are found beforehand with the same choice.
#[test]
fn constrained_vertices_are_those_of_smoothing() {
    let mesh = shapes::torus(13, 10, 0.2).unwrap();
    let mut values = noise(mesh.vertex_count(), 6);
    values.iter_mut().step_by(7).for_each(|value| *value = f64::NAN);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    for missing in [Missing::Omit, Missing::Fill] {
        for constraints in constraint_kinds(&[1, 30, 100]) {
            let options = LeastSquaresOptions { constraints, missing, ..LeastSquaresOptions::default() };
            let report = smoother.least_squares(&values, &options).unwrap().reports.remove(0);
            let found = constrained_vertices(&mesh, &values, 1, missing, &constraints, &Watch::none()).unwrap();
            assert_eq!(report.constraint_count, found.len(), "{missing:?} {constraints:?}");
        }
    }
}

#[test]
fn smoothness_is_that_of_the_rest() {
    for (name, mesh) in every_kind() {
        let mut values = noise(mesh.vertex_count(), 12);
        values.iter_mut().skip(4).step_by(9).for_each(|value| *value = f64::NAN);
        let has = |v: u32| !values[v as usize].is_nan();
        let Some((part, vertices)) = submesh(&mesh, &has) else { continue };
        let of_part: Vec<f64> = vertices.iter().map(|&v| values[v as usize]).collect();
        let field = ScalarField::with_missing(&mesh, &values, Missing::Omit).unwrap();
        let plain = ScalarField::new(&part, &of_part).unwrap();
        for &weights in LaplacianWeights::ALL {
            let of = |field: &ScalarField<'_>| {
                let laplacian = laplacian(field.mesh(), weights, &Watch::none()).ok()?;
                let energies = smoothness(&laplacian, field).unwrap();
                Some([energies.sobolev.to_bits(), energies.laplacian_norm.to_bits()])
            };
            assert_eq!(of(&field), of(&plain), "{name} {weights:?}");
        }
        let whole = laplacian(&mesh, LaplacianWeights::Uniform, &Watch::none()).unwrap();
        if vertices.len() < mesh.vertex_count() {
            assert_eq!(smoothness(&whole, &field).unwrap_err().code(), "LengthMismatch", "{name}");
        }
    }
}

#[test]
fn nothing_missing_changes_nothing() {
    let mesh = shapes::torus(13, 10, 0.2).unwrap();
    let f = noise(mesh.vertex_count(), 5);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    for missing in [Missing::Omit, Missing::Fill] {
        let pairs = methods(missing, 1, &[0, 7, 30]).into_iter().zip(methods(Missing::Error, 1, &[0, 7, 30]));
        for (ours, theirs) in pairs {
            match smoother.apply(&f, &ours, &Watch::none()) {
                Ok(found) => assert_eq!(found, smoother.apply(&f, &theirs, &Watch::none()).unwrap()),
                Err(refused) => assert_eq!((missing, refused.code()), (Missing::Fill, "InapplicableOption")),
            }
        }
    }
}

/// (LᵀWL + εB) x = εBf by elimination, for the vertices of components with data.
fn tikhonov(reference: &Reference, b: &DMatrix<f64>, known: &[u32], f: &[f64], epsilon: f64) -> Vec<f64> {
    let unknowns = reference.reached(known);
    let a = reference.laplacian.select_rows(&unknowns).select_columns(&unknowns);
    let weights: Vec<f64> = unknowns.iter().map(|&v| reference.weights[v]).collect();
    let b = b.select_rows(&unknowns).select_columns(&unknowns) * epsilon;
    let right = &b * DVector::from_iterator(unknowns.len(), unknowns.iter().map(|&v| f[v]));
    let x = (squared(&a, &weights) + b).lu().solve(&right).unwrap();
    let mut all = f.to_vec();
    unknowns.iter().zip(x.iter()).for_each(|(&v, &x)| all[v] = x);
    all
}

#[test]
fn filling_agrees_with_dense_algebra() {
    for (name, mesh) in meshes() {
        let n = mesh.vertex_count();
        let f = noise(n, 11);
        let known: Vec<u32> = (0..n as u32).filter(|v| v % 4 != 1).collect();
        let is_known = |v: &u32| known.contains(v);
        let mut values = f.clone();
        let mut zeroed = f.clone();
        for v in (0..n as u32).filter(|v| !is_known(v)) {
            values[v as usize] = f64::NAN;
            zeroed[v as usize] = 0.0;
        }
        for setting in settings() {
            for solver in [SolverChoice::Auto, SolverChoice::Cholesky, SolverChoice::ConjugateGradient] {
                if solver == SolverChoice::ConjugateGradient && !setting.0.is_symmetric() {
                    continue;
                }
                let mut smoother = smoother(&mesh, setting, solver);
                let reference = Reference::new(&smoother);
                let reached = reference.reached(&known);
                let check = |found: Result<Smoothed, Error>, expected: &[f64], reached: &[usize], what: &str| {
                    let context = format!("{name} {setting:?} {solver:?} {what}");
                    let found = found.unwrap_or_else(|problem| panic!("{context}: {problem}"));
                    let at = |x: &[f64]| -> Vec<f64> { reached.iter().map(|&v| x[v]).collect() };
                    let wrong = error(&f, &at(&found.values), &at(expected));
                    assert!(wrong <= 1e-10, "{context}: {wrong:e}");
                    for v in (0..n).filter(|v| !reached.contains(v)) {
                        assert_eq!(found.values[v].to_bits(), values[v].to_bits(), "{context}");
                    }
                };
                let metrics = [Metric::Mass, Metric::Identity, Metric::Lumped];
                for metric in metrics.into_iter().filter(|&m| setting.1 == Operator::Paper || m == Metric::Mass) {
                    let scale = if setting.1 == Operator::Fem { MassScale::Raw } else { MassScale::MeanOne };
                    let full = reference_mass(&mesh, scale);
                    let mut b = match metric {
                        Metric::Mass if setting.1 == Operator::Paper => full,
                        Metric::Identity => DMatrix::identity(n, n),
                        _ => DMatrix::from_diagonal(&full.column_sum()),
                    };
                    for v in (0..n).filter(|&v| !is_known(&(v as u32))) {
                        b.row_mut(v).fill(0.0);
                        b.column_mut(v).fill(0.0);
                    }
                    let at = TikhonovOptions {
                        epsilon: 0.5,
                        metric,
                        missing: Missing::Fill,
                        unconstrained: Unconstrained::Keep,
                        ..TikhonovOptions::default()
                    };
                    let expected = tikhonov(&reference, &b, &known, &zeroed, 0.5);
                    check(smoother.tikhonov(&values, &at), &expected, &reached, &format!("{metric:?}"));
                }
                let listed: Vec<u32> = known.iter().copied().step_by(7).collect();
                let features = Features::Vertices(&listed);
                let constraints = Constraints { features, stars: false, unconstrained: Unconstrained::Keep };
                let reached = reference.reached(&listed);
                for energy in [Energy::Harmonic, Energy::Biharmonic] {
                    let at = InterpolateOptions { constraints, energy, channels: 1, missing: Missing::Fill };
                    let expected = reference.interpolated(&zeroed, &listed, energy);
                    check(smoother.interpolate(&values, &at), &expected, &reached, &format!("{energy:?}"));
                }
                let at = LeastSquaresOptions {
                    constraints,
                    epsilon: 0.5,
                    missing: Missing::Fill,
                    ..LeastSquaresOptions::default()
                };
                let mut weights = vec![0.0; n];
                listed.iter().for_each(|&v| weights[v as usize] = 1.0);
                let expected = reference.least_squares(&zeroed, &weights, 0.5);
                check(smoother.least_squares(&values, &at), &expected, &reached, "least squares");
            }
        }
    }
}

#[test]
fn components_without_values() {
    let (torus, sphere) = (shapes::torus(13, 10, 0.2).unwrap(), shapes::sphere(2).unwrap());
    let mesh = together(&[torus.clone(), sphere.clone()]);
    let first = torus.vertex_count() + 1;
    let n = mesh.vertex_count();
    let f = noise(n, 2);
    let mut values = f.clone();
    let gone: Vec<usize> = (first..first + sphere.vertex_count()).collect();
    gone.iter().for_each(|&v| values[v] = f64::NAN);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let at = |unconstrained| TikhonovOptions {
        missing: Missing::Fill,
        unconstrained,
        metric: Metric::Identity,
        ..TikhonovOptions::default()
    };
    let refused = smoother.tikhonov(&values, &at(Unconstrained::Error)).unwrap_err();
    assert_eq!(refused.code(), "Unconstrained");
    assert_eq!(refused.detail()[1], ("vertex", (first as u64).into()));
    let kept = smoother.tikhonov(&values, &at(Unconstrained::Keep)).unwrap();
    let filled = smoother.tikhonov(&values, &at(Unconstrained::Mean)).unwrap();
    // The triangle without area hangs at the first edge, but L does not know of it; the vertices of neither keep their values.
    let known: Vec<f64> = (0..torus.vertex_count()).map(|v| f[v]).collect();
    let mean = known.iter().sum::<f64>() / known.len() as f64;
    for &v in &gone {
        assert!(kept.values[v].is_nan());
        assert!((filled.values[v] - mean).abs() < 1e-12, "{} {mean}", filled.values[v]);
    }
    for v in 0..torus.vertex_count() {
        assert_eq!(kept.values[v].to_bits(), filled.values[v].to_bits());
    }
    assert_eq!(kept.reports[0].before, filled.reports[0].before);
}

#[test]
fn what_missing_values_refuse() {
    let mesh = shapes::torus(13, 10, 0.2).unwrap();
    let n = mesh.vertex_count();
    let mut values = noise(n, 2);
    values[17] = f64::NAN;
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let code = |outcome: Result<Smoothed, Error>| outcome.map_err(|error| (error.code(), error.detail())).unwrap_err();
    for missing in [Missing::Omit, Missing::Fill] {
        let listed = [3, 17];
        let constraints = Constraints { features: Features::Vertices(&listed), ..Constraints::default() };
        let at = InterpolateOptions { constraints, missing, ..InterpolateOptions::default() };
        assert_eq!(code(smoother.interpolate(&values, &at)), ("MissingValue", vec![("vertex", 17_u32.into())]));
        let listed = [3, 400];
        let constraints = Constraints { features: Features::Vertices(&listed), ..Constraints::default() };
        let at = LeastSquaresOptions { constraints, missing, ..LeastSquaresOptions::default() };
        assert_eq!(code(smoother.least_squares(&values, &at)).0, "IndexOutOfBounds");
        let mut infinite = values.clone();
        infinite[40] = f64::INFINITY;
        let at = TikhonovOptions { missing, ..TikhonovOptions::default() };
        assert_eq!(code(smoother.tikhonov(&infinite, &at)), ("NonFiniteValue", vec![("vertex", 40_u32.into())]));
    }
    let at = TikhonovOptions::default();
    assert_eq!(code(smoother.tikhonov(&values, &at)), ("NonFiniteValue", vec![("vertex", 17_u32.into())]));
    let at = TikhonovOptions { unconstrained: Unconstrained::Keep, missing: Missing::Omit, ..at };
    assert_eq!(code(smoother.tikhonov(&values, &at)).0, "InapplicableOption");
    let filter = LowPassOptions { missing: Missing::Fill, ..LowPassOptions::default() };
    assert_eq!(code(smoother.low_pass(&values, &filter)).0, "InapplicableOption");
    let all = vec![f64::NAN; n];
    for missing in [Missing::Omit, Missing::Fill] {
        let at = TikhonovOptions { missing, ..TikhonovOptions::default() };
        let expected = if missing == Missing::Omit { "EmptyMesh" } else { "NonFiniteValue" };
        assert_eq!(code(smoother.tikhonov(&all, &at)).0, expected);
    }
}
