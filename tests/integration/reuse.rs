//! One smoother for many calls and many channels.

use core::ops::ControlFlow;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::LaplacianWeights;

use morse_smooth::smooth::{Method, Metric, Precision, Smoother, SmootherOptions, SolverChoice, TikhonovOptions};
use morse_smooth::{Phase, Progress, Watch};

#[test]
fn a_fallback_is_remembered() {
    // An unsymmetric operator and a tiny ε: single precision fails, and double precision has to step in; but only once.
    let mesh = shapes::torus(40, 30, 0.35).unwrap();
    let options = SmootherOptions {
        weights: LaplacianWeights::MeanValue,
        precision: Precision::Single,
        ..SmootherOptions::default()
    };
    let mut smoother = Smoother::new(&mesh, options).unwrap();
    let at = TikhonovOptions { epsilon: 1e-8, metric: Metric::Identity, ..TikhonovOptions::default() };
    let mut factorizations = Vec::new();
    for seed in 1..4 {
        let mut random = Random::new(seed);
        let field: Vec<f64> = (0..mesh.vertex_count()).map(|_| random.signed()).collect();
        // A factorisation is told of several times in a row, and followed by a solution that is tried.
        let (mut count, mut last) = (0, Phase::Report);
        let mut tell = |progress: Progress| {
            count += usize::from(progress.phase == Phase::Factorization && last != Phase::Factorization);
            last = progress.phase;
            ControlFlow::Continue(())
        };
        let found = smoother.apply(&field, &Method::Tikhonov(at), &Watch::new(&mut tell)).unwrap();
        assert_eq!(found.reports[0].solver.precision.name(), "doubleAfterSingle");
        factorizations.push(count);
    }
    assert_eq!(factorizations, [2, 0, 0]);
}

#[test]
fn single_precision_ends_where_double_precision_does() {
    let mesh = shapes::torus(80, 60, 0.35).unwrap();
    let mut random = Random::new(5);
    let field: Vec<f64> = (0..mesh.vertex_count()).map(|_| 1.5 * random.signed()).collect();
    for metric in [Metric::Identity, Metric::Lumped, Metric::Mass] {
        for solver in [SolverChoice::Auto, SolverChoice::Cholesky] {
            for epsilon in [1.0, 1e-2, 1e-4] {
                let at = TikhonovOptions { epsilon, metric, ..TikhonovOptions::default() };
                let [single, double] = [Precision::Single, Precision::Double].map(|precision| {
                    let options = SmootherOptions { solver, precision, ..SmootherOptions::default() };
                    Smoother::new(&mesh, options).unwrap().tikhonov(&field, &at).unwrap().values
                });
                let difference = single.iter().zip(&double).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                let size = double.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                assert!(difference <= 1e-11 * size, "{metric:?} {solver:?} ε = {epsilon:e}: {:e}", difference / size);
            }
        }
    }
}

#[test]
fn many_channels_equal_each_alone() {
    let mesh = shapes::sphere(2).unwrap();
    let n = mesh.vertex_count();
    let mut random = Random::new(8);
    let channels = 11;
    let values: Vec<f64> = (0..n * channels).map(|_| random.signed()).collect();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let at = TikhonovOptions { epsilon: 0.1, channels, ..TikhonovOptions::default() };
    let together = smoother.tikhonov(&values, &at).unwrap();
    assert_eq!(together.reports.len(), channels);
    for c in 0..channels {
        let field: Vec<f64> = values.iter().skip(c).step_by(channels).copied().collect();
        let alone = smoother.tikhonov(&field, &TikhonovOptions { channels: 1, ..at }).unwrap();
        for (v, x) in alone.values.iter().enumerate() {
            assert!((x - together.values[v * channels + c]).abs() < 1e-13);
        }
        assert_eq!(together.reports[c].after, alone.reports[0].after);
    }
    // A bad value in a late channel is refused before anything is solved.
    let mut bad = values;
    bad[7 * channels + 10] = f64::NAN;
    let mut phases = 0;
    let mut tell = |_: Progress| {
        phases += 1;
        ControlFlow::Continue(())
    };
    assert!(smoother.apply(&bad, &Method::Tikhonov(at), &Watch::new(&mut tell)).is_err());
    assert_eq!(phases, 0);
}
