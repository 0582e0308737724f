//! Which vertices constraints come to, what becomes of components without any, and what is refused.

use std::collections::BTreeSet;

use morse_smooth::Error;
use morse_smooth::error::SmoothError;
use morse_smooth::field::{DeltaOptions, DeltaScale, Features, Threshold, with_stars};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::LaplacianWeights;
use morse_smooth::smooth::{
    Constraints, Energy, InterpolateOptions, LeastSquaresOptions, Operator, Smoothed, Smoother, SmootherOptions,
    SolverChoice, Unconstrained, constrained_vertices,
};

use crate::analyses::feature_points;
use crate::dense_reference::{Reference, error, is_distinct, named, settings, smoother, together};
use crate::support::{islands, mesh, noise};

const DEFAULT: (LaplacianWeights, Operator) = (LaplacianWeights::Cotangent, Operator::Paper);

/// Both energies and least squares.
const METHODS: [Option<Energy>; 3] = [Some(Energy::Harmonic), Some(Energy::Biharmonic), None];

fn run(
    smoother: &mut Smoother,
    f: &[f64],
    method: Option<Energy>,
    constraints: Constraints<'_>,
    channels: usize,
) -> morse_smooth::Result<Smoothed> {
    match method {
        Some(energy) => smoother
            .interpolate(f, &InterpolateOptions { constraints, energy, channels, ..InterpolateOptions::default() }),
        None => {
            let options = LeastSquaresOptions {
                constraints,
                epsilon: 0.3,
                weights: None,
                channels,
                ..LeastSquaresOptions::default()
            };
            smoother.least_squares(f, &options)
        }
    }
}

fn two_components() -> TriMesh {
    together(&[shapes::torus(9, 7, 0.3).unwrap(), shapes::sphere(1).unwrap(), shapes::grid(4, 4).unwrap()])
}

#[test]
fn an_empty_set() {
    for mesh in [two_components(), islands(), shapes::grid(5, 4).unwrap()] {
        let f: Vec<f64> = noise(mesh.vertex_count(), 2).iter().map(|x| 5.0 * x + 2.0).collect();
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            for method in METHODS {
                let refused = run(&mut smoother, &f, method, named(&[], Unconstrained::Error), 1).unwrap_err();
                assert_eq!(refused, Error::from(SmoothError::Unconstrained { component: 0, vertex: 0 }));
                let kept = run(&mut smoother, &f, method, named(&[], Unconstrained::Keep), 1).unwrap();
                assert_eq!(kept.values, f);
                let report = &kept.reports[0];
                assert_eq!((report.before, report.l_infinity, report.l2), (report.after, 0.0, 0.0));
                assert_eq!((report.solver.route.name(), report.solver.unknowns), ("none", 0));
                let mean = run(&mut smoother, &f, method, named(&[], Unconstrained::Mean), 1).unwrap();
                assert!(error(&f, &mean.values, &means(&reference, &f, &[])) < 1e-14);
            }
        }
    }
}

/// Where all constrained values of a component are the same, so are all of its values, to the last bit: no rounding makes
/// critical points of it.
#[test]
fn equal_constraints_make_a_component_constant() {
    let mesh = two_components();
    let mut f = noise(mesh.vertex_count(), 4);
    f[3] = f[1];
    let last = mesh.vertex_count() as u32 - 3;
    for setting in settings() {
        let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
        for method in METHODS {
            for vertices in [vec![1], vec![3, 1], vec![1, last], vec![1, 2, last]] {
                let found = run(&mut smoother, &f, method, named(&vertices, Unconstrained::Keep), 1).unwrap();
                let count = |vertex: u32| found.values.iter().filter(|&&x| x == f[vertex as usize]).count();
                // The torus has 63 vertices, one more hangs on it by its weights alone; the grid has 16.
                assert_eq!(count(1) >= 63, !vertices.contains(&2), "{setting:?} {method:?} {vertices:?}");
                assert_eq!(count(last) == 16, vertices.contains(&last), "{setting:?} {method:?} {vertices:?}");
            }
        }
    }
}

/// Every component without a constrained vertex at its mean.
fn means(reference: &Reference, f: &[f64], constrained: &[u32]) -> Vec<f64> {
    let reached = reference.reached(constrained);
    let mean = |(v, component): (usize, &Option<usize>)| match component {
        Some(_) if !reached.contains(&v) => {
            let own: Vec<f64> = (0..f.len()).filter(|&u| reference.component[u] == *component).map(|u| f[u]).collect();
            own.iter().sum::<f64>() / own.len() as f64
        }
        _ => f[v],
    };
    reference.component.iter().enumerate().map(mean).collect()
}

#[test]
fn components_without_constraints() {
    let mesh = two_components();
    let n = mesh.vertex_count();
    let f: Vec<f64> = noise(n, 2).iter().map(|x| 5.0 * x + 2.0).collect();
    // The torus has 63 vertices and one isolated beside it, the sphere follows, then the grid.
    let (sphere, grid) = (64, 64 + 18 + 1);
    for (set, missing) in [
        (vec![3, 40], Some((1, sphere))),
        (vec![sphere + 2, 63], Some((0, 0))),
        (vec![5, grid + 1], Some((1, sphere))),
        (vec![5, sphere], Some((2, grid))),
        (vec![grid + 3, 1, sphere + 4], None),
    ] {
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            for method in METHODS {
                let context = format!("{setting:?} {method:?} {set:?}");
                let expected = |f: &[f64]| match method {
                    Some(energy) => reference.interpolated(f, &set, energy),
                    None => {
                        let pull: Vec<f64> = (0..n as u32).map(|v| f64::from(u8::from(set.contains(&v)))).collect();
                        reference.least_squares(f, &pull, 0.3)
                    }
                };
                let strict = run(&mut smoother, &f, method, named(&set, Unconstrained::Error), 1);
                let kept = run(&mut smoother, &f, method, named(&set, Unconstrained::Keep), 1).unwrap();
                let mean = run(&mut smoother, &f, method, named(&set, Unconstrained::Mean), 1).unwrap();
                assert!(error(&f, &kept.values, &expected(&f)) < 1e-11, "{context}");
                assert!(error(&f, &mean.values, &expected(&means(&reference, &f, &set))) < 1e-11, "{context}");
                let reached = reference.reached(&set);
                for v in 0..n {
                    assert!(reached.contains(&v) || kept.values[v] == f[v], "{context}: {v} is kept to the bit");
                }
                match missing {
                    None => assert_eq!(strict.unwrap(), kept, "{context}"),
                    Some((component, vertex)) => {
                        let error = SmoothError::Unconstrained { component, vertex };
                        assert_eq!(strict.unwrap_err(), Error::from(error), "{context}");
                    }
                }
            }
        }
    }
}

#[test]
fn all_vertices_and_all_but_one() {
    let mesh = two_components();
    let n = mesh.vertex_count() as u32;
    let f = noise(n as usize, 4);
    let all: Vec<u32> = (0..n).rev().collect();
    for setting in settings() {
        let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
        let reference = Reference::new(&smoother);
        for energy in [Energy::Harmonic, Energy::Biharmonic] {
            let found = run(&mut smoother, &f, Some(energy), named(&all, Unconstrained::Error), 1).unwrap();
            assert_eq!(found.values, f);
            let report = &found.reports[0];
            assert_eq!((report.constraint_count, report.solver.route.name()), (n as usize, "none"));
            let critical = (report.before.minima, report.before.maxima);
            assert_eq!(report.preserved, report.constrained_critical_points);
            assert_eq!(
                (report.after.minima, report.after.maxima, report.free_extrema),
                (critical.0, critical.1, Some(0))
            );
            for free in [0, n / 2] {
                let set: Vec<u32> = (0..n).filter(|&v| v != free).collect();
                let found = run(&mut smoother, &f, Some(energy), named(&set, Unconstrained::Error), 1).unwrap();
                assert!(error(&f, &found.values, &reference.interpolated(&f, &set, energy)) < 1e-13);
                assert!(found.reports[0].solver.unknowns <= 1);
            }
        }
    }
}

#[test]
fn repetitions_order_and_isolated_vertices_change_nothing() {
    let mesh = two_components();
    let n = mesh.vertex_count() as u32;
    let f = noise(n as usize, 5);
    let set = [70, 3, 30, 90];
    // 63 is isolated, the last vertex hangs on a triangle without area.
    let wild = [3, 90, 63, 70, n - 1, 3, 30, 63, 3];
    for method in METHODS {
        let mut smoother = smoother(&mesh, DEFAULT, SolverChoice::Auto);
        let tame = run(&mut smoother, &f, method, named(&set, Unconstrained::Error), 1).unwrap();
        let wild = run(&mut smoother, &f, method, named(&wild, Unconstrained::Error), 1).unwrap();
        assert_eq!(tame.values, wild.values);
        assert_eq!((tame.reports[0].constraint_count, wild.reports[0].constraint_count), (4, 6));
        assert_eq!((wild.values[63], wild.values[n as usize - 1]), (f[63], f[n as usize - 1]));
        // An isolated vertex constrains nothing.
        let refused = run(&mut smoother, &f, method, named(&[63], Unconstrained::Error), 1).unwrap_err();
        assert_eq!(refused.code(), "Unconstrained");
        let with_stars = Constraints { stars: true, ..named(&[63, 3, 70, 90], Unconstrained::Error) };
        assert!(run(&mut smoother, &f, method, with_stars, 1).is_ok());
        let refused = run(&mut smoother, &f, method, named(&[3, n, 70], Unconstrained::Error), 1).unwrap_err();
        assert_eq!(refused.code(), "IndexOutOfBounds");
        assert!(refused.to_string().contains(&format!("{n}")), "{refused}");
    }
}

#[test]
fn several_channels_have_the_constraints_of_all() {
    let mesh = two_components();
    let n = mesh.vertex_count();
    let fields: Vec<Vec<f64>> = (0..6)
        .map(|c| {
            mesh.positions().chunks_exact(3).zip(noise(n, c + 1)).map(|(p, e)| p[c as usize % 3] + 0.1 * e).collect()
        })
        .collect();
    let interleaved: Vec<f64> = (0..6 * n).map(|i| fields[i % 6][i / 6]).collect();
    for features in [
        Features::CriticalPoints(DeltaOptions { delta: 0.05, scale: DeltaScale::Relative, ..DeltaOptions::default() }),
        Features::Persistence(Threshold::Relative(0.3)),
        Features::KMeans { clusters: 5, seed: 3 },
        Features::Vertices(&[4, 80]),
    ] {
        for stars in [false, true] {
            let constraints = Constraints { features, stars, unconstrained: Unconstrained::Keep };
            let mut union = BTreeSet::new();
            for field in &fields {
                let chosen = feature_points(&mesh, field, &features).unwrap();
                union.extend(if stars { with_stars(mesh.connectivity(), &chosen) } else { chosen });
            }
            let union: Vec<u32> = union.into_iter().collect();
            assert_eq!(
                constrained_vertices(
                    &mesh,
                    &interleaved,
                    6,
                    morse_smooth::field::Missing::Error,
                    &constraints,
                    &morse_smooth::Watch::none()
                )
                .unwrap(),
                union
            );
            for method in METHODS {
                let mut smoother = smoother(&mesh, DEFAULT, SolverChoice::Auto);
                let found = run(&mut smoother, &interleaved, method, constraints, 6).unwrap();
                for (c, report) in found.reports.iter().enumerate() {
                    assert_eq!(report.constraint_count, union.len());
                    let alone = run(&mut smoother, &fields[c], method, named(&union, Unconstrained::Keep), 1).unwrap();
                    let channel: Vec<f64> = found.values.iter().skip(c).step_by(6).copied().collect();
                    assert!(error(&fields[c], &channel, &alone.values) < 1e-13);
                    if is_distinct(&mesh, &channel) {
                        let alone = &alone.reports[0];
                        assert_eq!((report.after, report.free_extrema), (alone.after, alone.free_extrema));
                    }
                }
            }
        }
    }
}

fn fit(
    smoother: &mut Smoother,
    f: &[f64],
    constraints: Constraints<'_>,
    weights: &[f64],
) -> morse_smooth::Result<Smoothed> {
    let options = LeastSquaresOptions {
        constraints,
        epsilon: 0.7,
        weights: Some(weights),
        channels: 1,
        ..LeastSquaresOptions::default()
    };
    smoother.least_squares(f, &options)
}

#[test]
fn weights_belong_to_vertices_as_they_are_listed() {
    let mesh = two_components();
    let f = noise(mesh.vertex_count(), 6);
    let mut smoother = smoother(&mesh, DEFAULT, SolverChoice::Auto);
    let reference = Reference::new(&smoother);
    let keep = |vertices| named(vertices, Unconstrained::Keep);
    let mut pull = vec![0.0; f.len()];
    for (v, weight) in [(70, 3.0), (8, 0.25), (2, 40.0)] {
        pull[v] = weight;
    }
    let expected = reference.least_squares(&f, &pull, 0.7);
    let plain = fit(&mut smoother, &f, keep(&[70, 8, 2]), &[3.0, 0.25, 40.0]).unwrap();
    assert!(error(&f, &plain.values, &expected) < 1e-12);
    // Of a vertex listed twice the larger weight counts, in whatever order.
    let twice = fit(&mut smoother, &f, keep(&[2, 70, 8, 70, 2]), &[40.0, 1.0, 0.25, 3.0, 1e-9]).unwrap();
    assert_eq!(twice.values, plain.values);
    // Isolated vertices take a weight and do nothing with it.
    let isolated = fit(&mut smoother, &f, keep(&[70, 63, 8, 2]), &[3.0, 1e9, 0.25, 40.0]).unwrap();
    assert_eq!(isolated.values, plain.values);
    // By a rule, or with stars: one for each constrained vertex, ascending.
    let stars = Constraints { stars: true, ..keep(&[70, 8]) };
    let vertices =
        constrained_vertices(&mesh, &f, 1, morse_smooth::field::Missing::Error, &stars, &morse_smooth::Watch::none())
            .unwrap();
    let weights: Vec<f64> = (1..=vertices.len()).map(|i| i as f64).collect();
    let mut pull = vec![0.0; f.len()];
    vertices.iter().zip(&weights).for_each(|(&v, w)| pull[v as usize] = *w);
    let found = fit(&mut smoother, &f, stars, &weights).unwrap();
    assert!(error(&f, &found.values, &reference.least_squares(&f, &pull, 0.7)) < 1e-12);
    let rule = Constraints { features: Features::KMeans { clusters: 4, seed: 1 }, ..keep(&[]) };
    let vertices =
        constrained_vertices(&mesh, &f, 1, morse_smooth::field::Missing::Error, &rule, &morse_smooth::Watch::none())
            .unwrap();
    let weights: Vec<f64> = (1..=vertices.len()).map(|i| i as f64).collect();
    let by_rule = fit(&mut smoother, &f, rule, &weights).unwrap();
    assert_eq!(by_rule.values, fit(&mut smoother, &f, keep(&vertices), &weights).unwrap().values);
}

#[test]
fn bad_weights_and_options_are_refused() {
    let mesh = shapes::torus(9, 7, 0.3).unwrap();
    let f = noise(mesh.vertex_count(), 6);
    let mut smoother = smoother(&mesh, DEFAULT, SolverChoice::Auto);
    let keep = named(&[7, 3, 7], Unconstrained::Keep);
    let good = fit(&mut smoother, &f, keep, &[1.0, 2.0, 3.0]).unwrap();
    for bad in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (index, vertex) in [(0, 7), (1, 3), (2, 7)] {
            let mut weights = [1.0, 2.0, 3.0];
            weights[index] = bad;
            let refused = fit(&mut smoother, &f, keep, &weights).unwrap_err();
            assert_eq!(refused, Error::from(SmoothError::InvalidWeight { index, vertex }));
        }
    }
    for weights in [&[][..], &[1.0, 2.0], &[1.0; 4]] {
        let refused = fit(&mut smoother, &f, keep, weights).unwrap_err();
        assert_eq!(refused, Error::from(SmoothError::LengthMismatch { expected: 3, actual: weights.len() }));
    }
    for epsilon in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = LeastSquaresOptions {
            constraints: keep,
            epsilon,
            weights: None,
            channels: 1,
            ..LeastSquaresOptions::default()
        };
        assert_eq!(smoother.least_squares(&f, &options).unwrap_err().code(), "InvalidOption");
    }
    for method in METHODS {
        assert_eq!(run(&mut smoother, &f, method, keep, 0).unwrap_err().code(), "InvalidOption");
        assert_eq!(run(&mut smoother, &f, method, keep, 2).unwrap_err().code(), "LengthMismatch");
        assert_eq!(run(&mut smoother, &f[1..], method, keep, 1).unwrap_err().code(), "LengthMismatch");
        let mut bad = f.clone();
        bad[9] = f64::NAN;
        assert_eq!(run(&mut smoother, &bad, method, keep, 1).unwrap_err().code(), "NonFiniteValue");
        bad[9] = f64::MAX;
        bad[8] = f64::MIN;
        assert_eq!(run(&mut smoother, &bad, method, keep, 1).unwrap_err().code(), "RangeOverflow");
        let features = Features::CriticalPoints(DeltaOptions { delta: -1.0, ..DeltaOptions::default() });
        let refused = run(&mut smoother, &f, method, Constraints { features, ..keep }, 1).unwrap_err();
        assert_eq!(refused.code(), "InvalidOption");
    }
    // All of which leaves the smoother as it was.
    assert_eq!(fit(&mut smoother, &f, keep, &[1.0, 2.0, 3.0]).unwrap(), good);
}

#[test]
fn extreme_weights_give_an_answer_or_an_error() {
    let mesh = shapes::torus(9, 7, 0.3).unwrap();
    let f = noise(mesh.vertex_count(), 6);
    for setting in settings() {
        for solver in [SolverChoice::Auto, SolverChoice::ConjugateGradient] {
            let mut smoother = smoother(&mesh, setting, solver);
            for scale in [1e-308, 1e-150, 1.0, 1e150, 1e308] {
                for epsilon in [1e-308, 1e-150, 1.0, 1e150, 1e308] {
                    let constraints = named(&[7, 3, 20], Unconstrained::Error);
                    let weights = [scale, 1.0, scale];
                    let options = LeastSquaresOptions {
                        constraints,
                        epsilon,
                        weights: Some(&weights),
                        channels: 1,
                        ..LeastSquaresOptions::default()
                    };
                    if let Ok(found) = smoother.least_squares(&f, &options) {
                        let worst = found.values.iter().fold(0.0_f64, |m, x| if x.abs() < m { m } else { x.abs() });
                        assert!(worst < 100.0, "{setting:?} {solver:?} {scale:e} {epsilon:e}: {worst:e}");
                        let report = &found.reports[0];
                        assert!(
                            report.metric_norm.is_finite() && report.solver.relative_residual.is_finite(),
                            "{report:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn meshes_without_anything_to_solve() {
    // Only a triangle without area: uniform weights tie its vertices together, the others leave them alone.
    let line = mesh(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]);
    let f = [0.0, 1.0, 5.0];
    for (weights, operator) in settings() {
        let Ok(mut smoother) =
            Smoother::new(&line, SmootherOptions { weights, operator, ..SmootherOptions::default() })
        else {
            continue;
        };
        for method in METHODS {
            let found = run(&mut smoother, &f, method, named(&[2], Unconstrained::Error), 1).unwrap().values;
            let tied = weights == LaplacianWeights::Uniform;
            assert!(error(&f, &found, if tied { &[5.0; 3] } else { &f }) < 1e-12, "{weights:?} {method:?} {found:?}");
        }
    }
}
