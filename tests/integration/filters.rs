//! The filters against dense algebra, closed forms and a double loop over all vertices, and what they promise.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use morse_smooth::error::{Detail, Error};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::LaplacianWeights;
use morse_smooth::smooth::{BilateralOptions, LowPassOptions, Method, Smoother, SmootherOptions};
use morse_smooth::{Phase, Progress, Watch};
use nalgebra::{DMatrix, DVector};

use crate::operators::{ALL_WEIGHTS, reference_laplacian};
use crate::support::{every_kind, islands, jittered, jittered_plane, mesh, noise, random_surface};

pub(crate) fn smoother(mesh: &TriMesh, weights: LaplacianWeights) -> Smoother {
    Smoother::new(mesh, SmootherOptions { weights, bounds: true, ..SmootherOptions::default() }).unwrap()
}

pub(crate) fn low_pass(iterations: usize, lambda: f64, mu: f64) -> LowPassOptions {
    LowPassOptions { iterations, lambda, mu, channels: 1, ..LowPassOptions::default() }
}

pub(crate) fn bilateral(iterations: usize, radius: f64, sigma_distance: f64, sigma_value: f64) -> BilateralOptions {
    BilateralOptions { iterations, radius, sigma_distance, sigma_value, channels: 1, ..BilateralOptions::default() }
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, x| if x.abs() > m || x.is_nan() { x.abs() } else { m })
}

/// Largest difference as a fraction of the largest value of the input.
pub(crate) fn error(f: &[f64], found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let differences: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    largest(&differences) / largest(f)
}

pub(crate) fn length(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub(crate) fn affine(f: &[f64], a: f64, b: f64) -> Vec<f64> {
    f.iter().map(|x| a * x + b).collect()
}

/// A square with a triangle of zero area, two of whose corners hang on nothing else, and an isolated vertex.
fn degenerate() -> TriMesh {
    let positions =
        [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.5, 0.5, 0.0], [0.25, 0.25, 0.0], [3., 3., 3.]];
    mesh(&positions, &[[0, 1, 2], [0, 2, 3], [0, 4, 5]])
}

pub(crate) fn meshes() -> Vec<(&'static str, TriMesh)> {
    let mut all = every_kind();
    all.push(("degenerate", degenerate()));
    all.push(("jittered sphere", jittered(&shapes::sphere(2).unwrap(), 0.05, 3)));
    all.push(("jittered plane", jittered_plane(9, 8, 2)));
    all.push(("holes", random_surface(4, &shapes::grid(9, 9).unwrap(), 0.2)));
    all
}

/// D⁻¹L, with zero rows where D is zero.
fn row_normalized(mesh: &TriMesh, weights: LaplacianWeights) -> DMatrix<f64> {
    let mut matrix = reference_laplacian(mesh, weights);
    for i in 0..matrix.nrows() {
        let d = matrix[(i, i)];
        if d != 0.0 {
            matrix.row_mut(i).scale_mut(1.0 / d);
        }
    }
    matrix
}

/// ((I − μK)(I − λK))^N.
fn transfer(k: &DMatrix<f64>, options: &LowPassOptions) -> DMatrix<f64> {
    let identity = DMatrix::identity(k.nrows(), k.nrows());
    let one = (&identity - k * options.mu) * (&identity - k * options.lambda);
    (0..options.iterations).fold(identity, |power, _| &one * power)
}

#[test]
fn low_pass_agrees_with_dense_algebra() {
    let mut compared = 0;
    for (name, mesh) in meshes() {
        let f = affine(&noise(mesh.vertex_count(), 7), 40.0, -300.0);
        for weights in ALL_WEIGHTS {
            let k = row_normalized(&mesh, weights);
            let smoother = smoother(&mesh, weights);
            for options in [
                low_pass(1, 0.5, 0.0),
                low_pass(7, 1.0, 0.0),
                low_pass(1, 0.3, -1.0),
                low_pass(20, 0.33, -0.34),
                low_pass(100, 0.1, 0.0),
            ] {
                let matrix = transfer(&k, &options);
                // What grows by negative weights loses digits at the same rate.
                let growth = matrix.abs().column_sum().max().max(1.0);
                match smoother.low_pass(&f, &options) {
                    Ok(found) => {
                        let expected = &matrix * DVector::from_column_slice(&f);
                        let wrong = error(&f, &found.values, expected.as_slice());
                        assert!(wrong < 1e-12 * growth, "{name} {weights:?} {options:?}: {wrong:e} by {growth:e}");
                        let report = &found.reports[0];
                        assert_eq!((report.method.name(), report.equation.name()), ("lowPass", "[18, 24]"));
                        assert_eq!(
                            (report.solver.route.name(), report.solver.iterations),
                            ("none", options.iterations)
                        );
                        compared += 1;
                    }
                    Err(problem) => {
                        assert_eq!(problem.code(), "Diverged", "{name} {weights:?} {options:?}");
                        assert!(growth > 1e5, "{name} {weights:?} {options:?}: {growth:e}");
                    }
                }
            }
        }
    }
    assert!(compared > 350, "{compared}");
}

#[test]
fn waves_on_a_regular_torus_are_multiplied_by_the_transfer_function() {
    let (around, across) = (12_u32, 10_u32);
    let torus = shapes::torus(around, across, 0.0).unwrap();
    let smoother = smoother(&torus, LaplacianWeights::Uniform);
    for (p, q) in [(1_u32, 0_u32), (0, 1), (2, 3), (6, 5), (5, 1), (4, 8)] {
        let (a, b) = (TAU * f64::from(p) / f64::from(around), TAU * f64::from(q) / f64::from(across));
        // Every vertex has six neighbours, along the sides and one diagonal of the cells.
        let k = 1.0 - (a.cos() + b.cos() + (a + b).cos()) / 3.0;
        let wave: Vec<f64> =
            (0..around * across).map(|v| (a * f64::from(v / across) + b * f64::from(v % across) + 0.4).cos()).collect();
        for options in [low_pass(1, 0.5, 0.0), low_pass(12, 0.7, 0.0), low_pass(25, 0.5, -0.53), low_pass(3, 1.0, -1.0)]
        {
            let factor = ((1.0 - options.lambda * k) * (1.0 - options.mu * k)).powi(options.iterations as i32);
            let found = smoother.low_pass(&wave, &options).unwrap();
            let wrong = error(&wave, &found.values, &affine(&wave, factor, 0.0));
            assert!(wrong < 1e-12 * factor.abs().max(1.0), "({p}, {q}) {options:?}: {wrong:e}");
        }
    }
}

#[test]
fn diffusion_without_negative_weights_keeps_within_the_range() {
    for (name, mesh) in meshes() {
        let f = noise(mesh.vertex_count(), 9);
        for weights in [LaplacianWeights::Uniform, LaplacianWeights::MeanValue] {
            let smoother = smoother(&mesh, weights);
            for (iterations, lambda) in [(1, 1.0), (5, 0.5), (50, 1.0), (300, 0.9)] {
                let found = smoother.low_pass(&f, &low_pass(iterations, lambda, 0.0)).unwrap().values;
                let range = |x: &[f64]| {
                    (x.iter().copied().fold(f64::INFINITY, f64::min), x.iter().copied().fold(-1e9_f64, f64::max))
                };
                let (before, after) = (range(&f), range(&found));
                assert!(after.0 >= before.0 - 1e-14 && after.1 <= before.1 + 1e-14, "{name}: {before:?} {after:?}");
            }
        }
    }
}

#[test]
fn low_pass_keeps_constants_and_weighted_means() {
    for (name, mesh) in meshes() {
        let n = mesh.vertex_count();
        let f = noise(n, 5);
        for weights in ALL_WEIGHTS {
            let smoother = smoother(&mesh, weights);
            let options = low_pass(6, 0.4, -0.42);
            let constant = vec![-0.7; n];
            assert_eq!(smoother.low_pass(&constant, &options).unwrap().values, constant, "{name}");
            assert_eq!(smoother.low_pass(&f, &low_pass(0, 0.4, -0.42)).unwrap().values, f, "{name}");
            let Ok(found) = smoother.low_pass(&f, &options).map(|smoothed| smoothed.values) else { continue };
            let scaled = smoother.low_pass(&affine(&f, -3e7, 5e8), &options).unwrap().values;
            let wrong = error(&found, &affine(&scaled, -1.0 / 3e7, 5.0 / 0.3), &found);
            assert!(wrong < 1e-12, "{name} {weights:?}: {wrong:e}");
            if weights.is_symmetric() {
                let d = reference_laplacian(&mesh, weights).diagonal();
                let sum = |x: &[f64]| d.iter().zip(x).map(|(d, x)| d * x).sum::<f64>();
                let size: f64 = d.iter().zip(&found).map(|(d, x)| (d * x).abs()).sum();
                assert!((sum(&found) - sum(&f)).abs() <= 1e-12 * size.max(1e-9), "{name} {weights:?}");
            }
            // Nothing pulls at these.
            for (v, row) in row_normalized(&mesh, weights).row_iter().enumerate() {
                if row.iter().all(|&x| x == 0.0) {
                    assert_eq!(found[v], f[v], "{name} {weights:?} {v}");
                }
            }
        }
    }
}

#[test]
fn a_negative_step_keeps_low_frequencies() {
    let sphere = shapes::sphere(4).unwrap();
    let height: Vec<f64> = sphere.positions().chunks_exact(3).map(|p| p[2]).collect();
    let f: Vec<f64> = height.iter().zip(noise(height.len(), 3)).map(|(z, e)| z + 0.1 * e).collect();
    let amplitude = |x: &[f64]| {
        let product = |x: &[f64]| x.iter().zip(&height).map(|(a, b)| a * b).sum::<f64>();
        product(x) / product(&height)
    };
    for weights in ALL_WEIGHTS {
        let smoother = smoother(&sphere, weights);
        let diffused = smoother.low_pass(&f, &low_pass(200, 0.5, 0.0)).unwrap();
        let filtered = smoother.low_pass(&f, &low_pass(200, 0.5, -0.51)).unwrap();
        let (lost, kept) = (1.0 - amplitude(&diffused.values), 1.0 - amplitude(&filtered.values));
        assert!(lost > 0.15 && kept.abs() < 0.05 * lost, "{weights:?}: {lost} against {kept}");
        for smoothed in [diffused, filtered] {
            let report = &smoothed.reports[0];
            assert!(report.after.saddles * 4 < report.before.saddles, "{weights:?}: {report:?}");
        }
    }
}

/// A regular grid sheared so far that cotangents are negative.
fn sheared(shear: f64) -> TriMesh {
    let grid = shapes::grid(12, 12).unwrap();
    let mut positions = grid.positions().to_vec();
    positions.chunks_exact_mut(3).for_each(|p| p[0] -= shear * p[1]);
    TriMesh::new(positions, grid.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

#[test]
fn divergence_is_an_error() {
    let mesh = sheared(6.0);
    let k = row_normalized(&mesh, LaplacianWeights::Cotangent);
    let largest_k = k.complex_eigenvalues().iter().map(|k| k.norm()).fold(0.0, f64::max);
    assert!(largest_k > 2.2, "{largest_k}");
    let smoother = smoother(&mesh, LaplacianWeights::Cotangent);
    let f = noise(mesh.vertex_count(), 1);
    let stable = low_pass(10_000, 1.9 / largest_k, 0.0);
    assert!(largest(&smoother.low_pass(&f, &stable).unwrap().values) < 10.0);
    for iterations in [1_000, 10_000, usize::MAX] {
        let refused = smoother.low_pass(&f, &low_pass(iterations, 1.0, 0.0)).expect_err("divergence");
        assert_eq!(refused.code(), "Diverged");
        let [("iterations", Detail::Integer(taken))] = refused.detail()[..] else { panic!("{refused:?}") };
        // Noise has a share of about a tenth to a thousandth of the fastest wave.
        let rate = (largest_k - 1.0).ln();
        assert!((1e6_f64.ln() / rate..1e10_f64.ln() / rate).contains(&(taken as f64)), "{taken} steps at {rate}");
    }
    // Weights without negative ones do not diverge there.
    let options = SmootherOptions { weights: LaplacianWeights::MeanValue, ..SmootherOptions::default() };
    assert!(Smoother::new(&mesh, options).unwrap().low_pass(&f, &low_pass(10_000, 1.0, 0.0)).is_ok());
}

#[test]
fn perturbations_keep_to_the_factor() {
    for (name, mesh) in [
        ("sphere", jittered(&shapes::sphere(2).unwrap(), 0.05, 3)),
        ("plane", jittered_plane(8, 9, 4)),
        ("sheared", sheared(3.0)),
        ("components", islands()),
        ("degenerate", degenerate()),
    ] {
        let f = noise(mesh.vertex_count(), 21);
        for weights in ALL_WEIGHTS {
            let smoother = smoother(&mesh, weights);
            let k = row_normalized(&mesh, weights);
            for options in [low_pass(0, 0.5, 0.0), low_pass(10, 0.6, 0.0), low_pass(15, 0.4, -0.42)] {
                let Ok(found) = smoother.low_pass(&f, &options) else { continue };
                let factor = found.reports[0].perturbation_factor.expect("few steps");
                let norm = transfer(&k, &options).svd(false, false).singular_values.max();
                assert!(norm <= factor * (1.0 + 1e-12), "{name} {weights:?} {options:?}: {norm} > {factor}");
                // Sharp enough to say something where weights are not negative.
                if weights == LaplacianWeights::Uniform && options.mu == 0.0 {
                    assert!(factor < 3.0, "{name} {weights:?} {options:?}: {factor}");
                }
                for seed in 0..100 {
                    let e = affine(&noise(f.len(), 100 + seed), 10.0_f64.powi(-(seed as i32 % 8)), 0.0);
                    let shifted: Vec<f64> = f.iter().zip(&e).map(|(f, e)| f + e).collect();
                    let Ok(moved) = smoother.low_pass(&shifted, &options) else { continue };
                    let difference: Vec<f64> = moved.values.iter().zip(&found.values).map(|(a, b)| a - b).collect();
                    let (moved, limit) = (length(&difference), factor * length(&e));
                    assert!(moved <= limit * (1.0 + 1e-7), "{name} {weights:?} {options:?}: {moved} > {limit}");
                }
            }
        }
    }
    // So many steps that the bound overflows.
    let smoother = smoother(&sheared(3.0), LaplacianWeights::Cotangent);
    let options = low_pass(1_000_000, 1e-3, 0.0);
    let report = smoother.low_pass(&noise(144, 1), &options).unwrap().reports.remove(0);
    assert!(report.perturbation_factor.is_none_or(f64::is_finite));
}

#[test]
fn channels_are_filtered_by_themselves() {
    let mesh = jittered(&islands(), 0.05, 3);
    let n = mesh.vertex_count();
    let smoother = smoother(&mesh, LaplacianWeights::Cotangent);
    let fields: Vec<Vec<f64>> =
        (0..6_i32).map(|c| affine(&noise(n, 40 + c as u64), 10.0_f64.powi(3 * c - 6), f64::from(c))).collect();
    let interleaved: Vec<f64> = (0..n).flat_map(|v| fields.iter().map(move |f| f[v])).collect();
    let ours = low_pass(4, 0.5, -0.52);
    let theirs = bilateral(4, 2.0, 1.0, 0.7);
    let all = [
        smoother.low_pass(&interleaved, &LowPassOptions { channels: 6, ..ours }).unwrap(),
        smoother.bilateral(&interleaved, &BilateralOptions { channels: 6, ..theirs }).unwrap(),
    ];
    for (c, f) in fields.iter().enumerate() {
        let alone = [smoother.low_pass(f, &ours).unwrap(), smoother.bilateral(f, &theirs).unwrap()];
        for (all, alone) in all.iter().zip(&alone) {
            let channel: Vec<f64> = all.values.iter().skip(c).step_by(6).copied().collect();
            assert_eq!((&channel, &all.reports[c]), (&alone.values, &alone.reports[0]), "channel {c}");
        }
    }
}

#[test]
fn progress_goes_on() {
    let mesh = shapes::sphere(5).unwrap();
    let mut smoother = smoother(&mesh, LaplacianWeights::Cotangent);
    let f = noise(5 * mesh.vertex_count(), 1);
    for filter in [false, true] {
        let mut told = Vec::new();
        let mut tell = |progress: Progress| {
            told.push((progress.phase, progress.fraction));
            ControlFlow::Continue(())
        };
        if filter {
            let options = BilateralOptions { channels: 5, ..bilateral(1, 0.4, 0.2, 0.3) };
            smoother.apply(&f, &Method::Bilateral(options), &Watch::new(&mut tell)).unwrap();
        } else {
            let options = LowPassOptions { channels: 5, ..low_pass(200, 0.5, 0.0) };
            smoother.apply(&f, &Method::LowPass(options), &Watch::new(&mut tell)).unwrap();
        }
        assert_eq!(told[0], (Phase::Solve, 0.0));
        assert_eq!(told[told.len() - 1], (Phase::Report, 1.0));
        // Also within a step of the bilateral filter, and not with each of many small steps.
        assert!((50..250).contains(&told.len()), "{}", told.len());
        assert!(told.windows(2).all(|pair| pair[0].1 <= pair[1].1), "{told:?}");
    }
}

fn option_of(refused: &Error) -> (&'static str, String) {
    match refused.detail().into_iter().next() {
        Some(("option", Detail::Text(option))) => (refused.code(), option),
        other => panic!("{refused}: {other:?}"),
    }
}

#[test]
fn bad_options_and_values_are_refused_by_name() {
    let mesh = shapes::octahedron().unwrap();
    let smoother = smoother(&mesh, LaplacianWeights::Cotangent);
    let f = noise(6, 1);
    let good = low_pass(3, 0.5, 0.0);
    for lambda in [0.0, -0.5, 1.0 + 1e-15, 2.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = smoother.low_pass(&f, &LowPassOptions { lambda, ..good }).expect_err("lambda");
        assert_eq!(option_of(&refused), ("InvalidOption", "lambda".to_owned()));
    }
    for mu in [1e-300, 0.5, -1.0 - 1e-15, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = smoother.low_pass(&f, &LowPassOptions { mu, ..good }).expect_err("mu");
        assert_eq!(option_of(&refused), ("InvalidOption", "mu".to_owned()));
    }
    let fine = bilateral(2, 1.0, 1.0, 1.0);
    for bad in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (option, options) in [
            ("radius", BilateralOptions { radius: bad, ..fine }),
            ("sigmaDistance", BilateralOptions { sigma_distance: bad, ..fine }),
            ("sigmaValue", BilateralOptions { sigma_value: bad, ..fine }),
        ] {
            let refused = smoother.bilateral(&f, &options).expect_err(option);
            assert_eq!(option_of(&refused), ("InvalidOption", option.to_owned()));
        }
    }
    let run = |values: &[f64], channels: usize| {
        let low = smoother.low_pass(values, &LowPassOptions { channels, ..good }).expect_err("low-pass");
        let two = smoother.bilateral(values, &BilateralOptions { channels, ..fine }).expect_err("bilateral");
        assert_eq!(low, two);
        low
    };
    assert_eq!(option_of(&run(&f, 0)), ("InvalidOption", "channels".to_owned()));
    for (values, channels) in [(&f[1..], 1), (&f[..], 2), (&[][..], 1), (&f[..], usize::MAX)] {
        assert_eq!(run(values, channels).code(), "LengthMismatch");
    }
    let with = |v: usize, value: f64| f.iter().enumerate().map(|(i, &x)| if i == v { value } else { x }).collect();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let values: Vec<f64> = with(4, bad);
        let refused = run(&values, 1);
        assert_eq!((refused.code(), refused.detail()), ("NonFiniteValue", vec![("vertex", Detail::Integer(4))]));
    }
    let mut wide: Vec<f64> = with(2, 1.7e308);
    wide[3] = -1.7e308;
    assert_eq!(run(&wide, 1).code(), "RangeOverflow");
}
