//! Families of all ε against dense algebra, with every metric, operator and kind of data, and fields and meshes that leave little to
//! smooth.

use morse_smooth::Watch;
use morse_smooth::field::{Features, Missing};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale};
use morse_smooth::smooth::{
    Constraints, EpsilonRule, Family, FamilyOptions, Functional, LeastSquaresOptions, Metric, Operator, Smoother,
    SmootherOptions, SolverChoice, SweepOptions, TikhonovOptions, Unconstrained,
};
use nalgebra::DMatrix;

use crate::dense_reference::{Reference, named, settings, smoother, sparse_set, together};
use crate::operators::reference_mass;
use crate::support::{annulus, complex, every_kind, jittered, noise, random_complex, two_tetrahedra_at_an_edge};

/// ε in equal steps of their logarithms, both ends included.
pub(crate) fn epsilons(range: (f64, f64), count: usize) -> Vec<f64> {
    let quotient = (range.1 / range.0).ln();
    let at = |k: usize| range.0 * (quotient * k as f64 / (count - 1) as f64).exp();
    (0..count).map(|k| at(k).clamp(range.0, range.1)).collect()
}

pub(crate) fn tikhonov(options: TikhonovOptions) -> FamilyOptions<'static> {
    FamilyOptions { method: Functional::Tikhonov(options), ..FamilyOptions::default() }
}

pub(crate) fn built(smoother: &mut Smoother, values: &[f64], options: &FamilyOptions<'_>) -> Family {
    smoother.family(values, options, &Watch::none()).unwrap_or_else(|problem| panic!("{options:?}: {problem}"))
}

/// ‖x − y‖/‖y‖ of fields that are normalised by the range of f, at some vertices.
pub(crate) fn relative(f: &[f64], found: &[f64], expected: &[f64], at: &[usize]) -> f64 {
    let (min, max) =
        at.iter().map(|&v| f[v]).filter(|x| !x.is_nan()).fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    let sum = |of: &dyn Fn(usize) -> f64| at.iter().map(|&v| (of(v) / (max - min)).powi(2)).sum::<f64>().sqrt();
    sum(&|v| found[v] - expected[v]) / sum(&|v| expected[v] - min)
}

fn small_meshes() -> Vec<(&'static str, TriMesh)> {
    let torus = |around, across| shapes::torus(around, across, 0.35).unwrap();
    vec![
        ("tetrahedron", shapes::tetrahedron().unwrap()),
        ("sphere", jittered(&shapes::sphere(2).unwrap(), 0.04, 2)),
        ("torus", torus(11, 9)),
        ("annulus", annulus()),
        ("klein bottle", shapes::klein_bottle(7, 6).unwrap()),
        ("two components", together(&[torus(8, 6), shapes::sphere(1).unwrap()])),
        ("random complex", random_complex(11, 9, 30)),
        ("two tetrahedra at an edge", two_tetrahedra_at_an_edge()),
    ]
}

/// B of a metric on the whole mesh, with zeros where values are missing.
fn data_matrix(mesh: &TriMesh, operator: Operator, metric: Metric, scale: MassScale, known: &[u32]) -> DMatrix<f64> {
    let n = mesh.vertex_count();
    let mut b = match (operator, metric) {
        (Operator::Fem, _) => DMatrix::from_diagonal(&reference_mass(mesh, MassScale::Raw).column_sum()),
        (_, Metric::Identity) => DMatrix::identity(n, n),
        (_, Metric::Mass) => reference_mass(mesh, scale),
        (_, Metric::Lumped) => DMatrix::from_diagonal(&reference_mass(mesh, scale).column_sum()),
    };
    for v in (0..n).filter(|&v| !known.contains(&(v as u32))) {
        b.row_mut(v).fill(0.0);
        b.column_mut(v).fill(0.0);
    }
    b
}

fn metrics(operator: Operator) -> Vec<(Metric, MassScale)> {
    match operator {
        Operator::Fem => vec![(Metric::Mass, MassScale::MeanOne)],
        Operator::Paper => vec![
            (Metric::Identity, MassScale::MeanOne),
            (Metric::Mass, MassScale::MeanOne),
            (Metric::Lumped, MassScale::MeanOne),
            (Metric::Mass, MassScale::Raw),
        ],
    }
}

/// Compares a family of one channel with dense solutions, and tells the largest error.
fn check(family: &Family, context: &str, values: &[f64], at: &[usize], expected: &dyn Fn(f64) -> Vec<f64>) -> f64 {
    let mut worst = (0.0, 0.0);
    for epsilon in epsilons(family.range(), 11) {
        let found = family.values(epsilon).unwrap();
        let wrong = relative(values, &found, &expected(epsilon), at);
        worst = if wrong > worst.0 || wrong.is_nan() { (wrong, epsilon) } else { worst };
        for v in (0..values.len()).filter(|v| !at.contains(v)) {
            assert_eq!(found[v].to_bits(), values[v].to_bits(), "{context}: vertex {v} has changed");
        }
    }
    let (wrong, epsilon) = worst;
    assert!(
        wrong <= 1e-6,
        "{context}: {wrong:e} at ε = {epsilon:e}, estimated {:e} and at worst {:e}, {} shifts, dimension {}",
        family.error_at(epsilon).unwrap(),
        family.error_estimate(),
        family.shifts().len(),
        family.dimension(),
    );
    wrong
}

#[test]
fn tikhonov_agrees_with_dense_algebra() {
    for (name, mesh) in small_meshes() {
        let n = mesh.vertex_count();
        let f: Vec<f64> = noise(n, 7).iter().map(|x| 40.0 * x - 300.0).collect();
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            let all: Vec<u32> = (0..n as u32).collect();
            let some: Vec<u32> = all.iter().copied().filter(|v| v % 4 != 1).collect();
            for known in [&all, &some] {
                let missing = if known.len() == n { Missing::Error } else { Missing::Fill };
                let mut values = vec![f64::NAN; n];
                known.iter().for_each(|&v| values[v as usize] = f[v as usize]);
                let at = reference.reached(known);
                for (metric, mass_scale) in metrics(setting.1) {
                    let unconstrained =
                        if missing == Missing::Fill { Unconstrained::Keep } else { Unconstrained::Error };
                    let options =
                        TikhonovOptions { metric, mass_scale, missing, unconstrained, ..TikhonovOptions::default() };
                    let family = built(&mut smoother, &values, &tikhonov(options));
                    let b = data_matrix(&mesh, setting.1, metric, mass_scale, known);
                    let context = format!("{name} {setting:?} {metric:?} {mass_scale:?} {missing:?}");
                    check(&family, &context, &values, &at, &|epsilon| reference.regularized(&f, &b, &at, epsilon));
                }
            }
        }
    }
}

#[test]
fn least_squares_agree_with_dense_algebra() {
    for (name, mesh) in small_meshes() {
        let n = mesh.vertex_count();
        let f = noise(n, 11);
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            for (every, weighted) in [(1, true), (5, true), (7, false)] {
                let listed = sparse_set(&reference, every);
                let weights: Vec<f64> = (0..listed.len()).map(|k| 0.25 + (k % 5) as f64).collect();
                let mut pull = vec![0.0; n];
                for (&v, weight) in listed.iter().zip(&weights) {
                    pull[v as usize] = if weighted { *weight } else { 1.0 };
                }
                let method = LeastSquaresOptions {
                    constraints: named(&listed, Unconstrained::Keep),
                    weights: weighted.then_some(&weights),
                    ..LeastSquaresOptions::default()
                };
                let options = FamilyOptions { method: Functional::LeastSquares(method), ..FamilyOptions::default() };
                let family = built(&mut smoother, &f, &options);
                let at = reference.reached(&listed);
                let context = format!("{name} {setting:?}, every {every}, weighted {weighted}");
                check(&family, &context, &f, &at, &|epsilon| reference.least_squares(&f, &pull, epsilon));
            }
        }
    }
}

#[test]
fn other_ranges_agree_with_dense_algebra() {
    let mesh = shapes::torus(11, 9, 0.35).unwrap();
    let f = noise(mesh.vertex_count(), 3);
    for operator in [Operator::Paper, Operator::Fem] {
        let mut smoother = smoother(&mesh, (LaplacianWeights::Cotangent, operator), SolverChoice::Auto);
        let reference = Reference::new(&smoother);
        let all: Vec<u32> = (0..f.len() as u32).collect();
        let at: Vec<usize> = (0..f.len()).collect();
        let b = data_matrix(&mesh, operator, Metric::Mass, MassScale::MeanOne, &all);
        for range in [(1e-6, 1e10), (0.01, 0.02), (1.0, 1e9), (1e-10, 1e-4)] {
            let options = FamilyOptions { range, ..tikhonov(TikhonovOptions::default()) };
            let family = built(&mut smoother, &f, &options);
            assert_eq!(family.range(), range);
            check(&family, &format!("{operator:?} {range:?}"), &f, &at, &|epsilon| {
                reference.regularized(&f, &b, &at, epsilon)
            });
        }
    }
}

#[test]
fn missing_values_left_out_agree_with_exact_solutions() {
    let mesh = shapes::torus(12, 9, 0.3).unwrap();
    let n = mesh.vertex_count();
    for channels in [1, 2] {
        let f = noise(n * channels, 5);
        let mut values = f.clone();
        for v in (0..n).filter(|v| v % 9 == 4) {
            values[v * channels + v % channels] = f64::NAN;
        }
        let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
        let at = TikhonovOptions { missing: Missing::Omit, channels, metric: Metric::Identity, ..Default::default() };
        let family = built(&mut smoother, &values, &tikhonov(at));
        for epsilon in epsilons(family.range(), 11) {
            let expected = smoother.tikhonov(&values, &TikhonovOptions { epsilon, ..at }).unwrap();
            let found = family.at(epsilon, &Watch::none()).unwrap();
            for c in 0..channels {
                let of = |x: &[f64]| -> Vec<f64> { x.iter().skip(c).step_by(channels).copied().collect() };
                let there: Vec<usize> = (0..n)
                    .filter(|v| !values[v * channels..][..channels].iter().any(|x| x.is_nan()))
                    .filter(|&v| expected.values[v * channels + c].to_bits() != values[v * channels + c].to_bits())
                    .collect();
                let wrong = relative(&of(&values), &of(&found.values), &of(&expected.values), &there);
                assert!(wrong <= 1e-6, "{channels} channels, ε = {epsilon:e}: {wrong:e}");
                assert_eq!(found.reports[c].after, expected.reports[c].after);
                assert_eq!(found.reports[c].before, expected.reports[c].before);
            }
            // Those that have no value, and those left without a triangle, stay.
            for (i, x) in expected.values.iter().enumerate().filter(|(i, x)| x.to_bits() == values[*i].to_bits()) {
                assert_eq!(found.values[i].to_bits(), x.to_bits());
            }
        }
    }
}

#[test]
fn channels_are_families_of_their_own() {
    let mesh = shapes::torus(13, 10, 0.3).unwrap();
    let n = mesh.vertex_count();
    let fields: Vec<Vec<f64>> = vec![
        noise(n, 1),
        vec![2.5; n],
        mesh.positions().chunks_exact(3).map(|p| 1e8 * p[0]).collect(),
        noise(n, 2).iter().map(|x| 1e-9 * x + 7.0).collect(),
        noise(n, 3),
        mesh.positions().chunks_exact(3).map(|p| p[2] * p[1]).collect(),
    ];
    let channels = fields.len();
    let interleaved: Vec<f64> = (0..channels * n).map(|i| fields[i % channels][i / channels]).collect();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let family =
        built(&mut smoother, &interleaved, &tikhonov(TikhonovOptions { channels, ..TikhonovOptions::default() }));
    assert!(family.error_estimate() <= 1e-6);
    let there: Vec<usize> = (0..n).collect();
    for epsilon in epsilons(family.range(), 11) {
        let found = family.at(epsilon, &Watch::none()).unwrap();
        assert_eq!(found.reports.len(), channels);
        for (c, field) in fields.iter().enumerate() {
            let values: Vec<f64> = found.values.iter().skip(c).step_by(channels).copied().collect();
            let expected = smoother.tikhonov(field, &TikhonovOptions { epsilon, ..Default::default() }).unwrap();
            if c == 1 {
                assert_eq!(values, *field);
                continue;
            }
            let wrong = relative(field, &values, &expected.values, &there);
            assert!(wrong <= 1e-6, "channel {c}, ε = {epsilon:e}: {wrong:e}");
            assert_eq!(found.reports[c].after, expected.reports[0].after, "channel {c}, ε = {epsilon:e}");
        }
    }
}

/// Looks at everything that a family has to say, for NaN and panics.
fn ask_everything(family: &Family, context: &str, may_have_nan: bool) {
    let watch = Watch::none();
    assert!(family.error_estimate().is_finite(), "{context}");
    let sweep = family.sweep(&SweepOptions { counts: true, ..Default::default() }, &watch).unwrap();
    let curves = [&sweep.l_infinity, &sweep.metric_norm, &sweep.laplacian_norm, &sweep.sobolev];
    assert!(curves.iter().all(|curve| curve.iter().all(|x| x.is_finite())), "{context}: {sweep:?}");
    for epsilon in epsilons(family.range(), 5) {
        assert!(may_have_nan || family.values(epsilon).unwrap().iter().all(|x| x.is_finite()), "{context}");
        assert!(family.error_at(epsilon).unwrap().is_finite(), "{context}");
        assert!(family.degrees_of_freedom(epsilon).unwrap().is_finite(), "{context}");
        let found = family.at(epsilon, &watch).unwrap();
        let report = &found.reports[0];
        assert!(report.solver.relative_residual.is_finite() && report.l2.is_finite(), "{context}: {report:?}");
    }
    family.lives(0, 4, &watch).unwrap();
    let rules = [
        EpsilonRule::Gcv,
        EpsilonRule::LCurve,
        EpsilonRule::Discrepancy { noise: None },
        EpsilonRule::Discrepancy { noise: Some(0.1) },
        EpsilonRule::AtMostCriticalPoints { count: usize::MAX },
    ];
    for rule in rules {
        let chosen = family.choose(rule, &watch).unwrap();
        let (least, largest) = family.range();
        assert!((least..=largest).contains(&chosen.epsilon), "{context}: {chosen:?}");
        assert!(!chosen.reason.contains("NaN") && !chosen.reason.contains("inf"), "{context}: {}", chosen.reason);
        if let Some(noise) = chosen.noise {
            assert!(noise.standard_deviation.is_finite() && noise.by_differences.is_finite(), "{context}: {noise:?}");
        }
    }
}

#[test]
fn every_kind_of_mesh_and_field_has_a_family() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        let mut spike = vec![0.0; n];
        spike[mesh.connectivity().triangles()[0][0] as usize] = 3.0;
        let ramp = (0..n).map(|v| v as f64).collect();
        let fields = [("constant", vec![-4.5; n]), ("spike", spike), ("ramp", ramp), ("noise", noise(n, 6))];
        for (metric, operator) in
            [(Metric::Mass, Operator::Paper), (Metric::Identity, Operator::Paper), (Metric::Mass, Operator::Fem)]
        {
            let mut smoother =
                Smoother::new(&mesh, SmootherOptions { operator, ..SmootherOptions::default() }).unwrap();
            for (field, values) in &fields {
                let context = format!("{name} {field} {metric:?} {operator:?}");
                let options = TikhonovOptions { metric, ..TikhonovOptions::default() };
                let family = built(&mut smoother, values, &tikhonov(options));
                assert!(family.is_complete(), "{context}");
                ask_everything(&family, &context, false);
                for epsilon in epsilons(family.range(), 7) {
                    let found = family.values(epsilon).unwrap();
                    let expected = smoother.tikhonov(values, &TikhonovOptions { epsilon, ..options }).unwrap().values;
                    let size = values.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                    let wrong = found.iter().zip(&expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                    assert!(wrong <= 1e-6 * size, "{context} ε = {epsilon:e}: {wrong:e}");
                }
                if *field == "constant" {
                    assert_eq!(family.values(0.05).unwrap(), *values, "{context}");
                    assert_eq!(family.shifts().len(), 1, "{context}");
                }
            }
        }
    }
}

#[test]
fn all_vertices_constrained_or_hardly_any() {
    for (name, mesh) in [("triangle", complex(3, &[[0, 1, 2]])), ("torus", shapes::torus(9, 7, 0.3).unwrap())] {
        let n = mesh.vertex_count();
        let f = noise(n, 4);
        let all: Vec<u32> = (0..n as u32).collect();
        let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
        for listed in [&all[..], &all[..1], &all[1..3]] {
            let constraints = Constraints { features: Features::Vertices(listed), ..Constraints::default() };
            let method = LeastSquaresOptions { constraints, ..LeastSquaresOptions::default() };
            let options = FamilyOptions { method: Functional::LeastSquares(method), ..FamilyOptions::default() };
            let family = built(&mut smoother, &f, &options);
            let context = format!("{name}, {} constrained", listed.len());
            ask_everything(&family, &context, false);
            for epsilon in epsilons(family.range(), 7) {
                let found = family.values(epsilon).unwrap();
                let expected = smoother.least_squares(&f, &LeastSquaresOptions { epsilon, ..method }).unwrap().values;
                let wrong = found.iter().zip(&expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                assert!(wrong <= 1e-6, "{context}, ε = {epsilon:e}: {wrong:e}");
                // A single value is fitted by a constant.
                assert!(listed.len() > 1 || found.iter().all(|x| (x - f[0]).abs() < 1e-9), "{context}");
            }
        }
    }
}

#[test]
fn components_without_values_stay_or_take_the_mean() {
    let (torus, sphere) = (shapes::torus(9, 7, 0.2).unwrap(), shapes::sphere(1).unwrap());
    let mesh = together(&[torus.clone(), sphere.clone()]);
    let mut values = noise(mesh.vertex_count(), 2);
    let first = torus.vertex_count() + 1;
    values[first..first + sphere.vertex_count()].fill(f64::NAN);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    for unconstrained in [Unconstrained::Keep, Unconstrained::Mean] {
        let at = TikhonovOptions { missing: Missing::Fill, unconstrained, ..TikhonovOptions::default() };
        let family = built(&mut smoother, &values, &tikhonov(at));
        ask_everything(&family, &format!("{unconstrained:?}"), unconstrained == Unconstrained::Keep);
        for epsilon in epsilons(family.range(), 5) {
            let expected = smoother.tikhonov(&values, &TikhonovOptions { epsilon, ..at }).unwrap();
            let found = family.at(epsilon, &Watch::none()).unwrap();
            assert_eq!(found.reports[0].after, expected.reports[0].after);
            for (v, (x, y)) in found.values.iter().zip(&expected.values).enumerate() {
                assert!(x.is_nan() == y.is_nan() && (x.is_nan() || (x - y).abs() < 1e-6), "vertex {v}: {x} {y}");
            }
        }
    }
}
