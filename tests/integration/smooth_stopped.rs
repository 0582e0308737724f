//! Smoothing that is stopped: it ends at once, and what comes after is right to the last bit.

use std::ops::ControlFlow;

use morse_smooth::field::{Features, Missing, Threshold};
use morse_smooth::mesh::shapes;
use morse_smooth::operators::LaplacianWeights;
use morse_smooth::smooth::{
    BilateralOptions, Constraints, Energy, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Method, Metric,
    Precision, Smoother, SmootherOptions, SolverChoice, TikhonovOptions, Unconstrained,
};
use morse_smooth::{Phase, Progress, Watch};

use crate::support::noise;

fn methods() -> Vec<Method<'static>> {
    let rule = Features::Persistence(Threshold::Relative(0.3));
    let constraints = Constraints { features: rule, stars: true, unconstrained: Unconstrained::Error };
    let tikhonov = |metric| TikhonovOptions { metric, channels: 5, ..TikhonovOptions::default() };
    let interpolate = |energy| InterpolateOptions { constraints, energy, channels: 5, ..InterpolateOptions::default() };
    vec![
        Method::Tikhonov(tikhonov(Metric::Mass)),
        Method::Tikhonov(tikhonov(Metric::Identity)),
        Method::Tikhonov(TikhonovOptions { missing: Missing::Omit, ..tikhonov(Metric::Mass) }),
        Method::Interpolate(interpolate(Energy::Harmonic)),
        Method::Interpolate(interpolate(Energy::Biharmonic)),
        Method::LeastSquares(LeastSquaresOptions { constraints, channels: 5, ..LeastSquaresOptions::default() }),
        Method::LowPass(LowPassOptions { iterations: 40, channels: 5, ..LowPassOptions::default() }),
        Method::Bilateral(BilateralOptions {
            radius: 0.3,
            sigma_distance: 0.2,
            sigma_value: 0.5,
            channels: 5,
            ..BilateralOptions::default()
        }),
    ]
}

fn settings() -> Vec<SmootherOptions> {
    let plain = SmootherOptions::default();
    vec![
        SmootherOptions { bounds: true, ..plain },
        SmootherOptions { precision: Precision::Single, ..plain },
        SmootherOptions { solver: SolverChoice::ConjugateGradient, bounds: true, ..plain },
        SmootherOptions { weights: LaplacianWeights::MeanValue, ..plain },
    ]
}

/// Assembling is stopped before anything is made, and asks as often for every kind of weights.
#[test]
fn a_smoother_that_is_being_made_stops() {
    let mesh = shapes::torus(400, 200, 0.2).unwrap();
    for &weights in LaplacianWeights::ALL {
        let options = SmootherOptions { weights, ..SmootherOptions::default() };
        let mut told = Vec::new();
        let mut tell = |progress: Progress| {
            told.push((progress.phase, progress.fraction));
            ControlFlow::Continue(())
        };
        let watched = Smoother::watched(&mesh, options, &Watch::new(&mut tell)).unwrap();
        assert_eq!(watched.laplacian(), Smoother::new(&mesh, options).unwrap().laplacian(), "{weights:?}");
        assert!(told.len() >= 3, "{weights:?}: {}", told.len());
        // Nothing of what the smoother is made for is done.
        assert!(told.iter().all(|&told| told == (Phase::Analysis, 0.0)), "{weights:?}: {told:?}");
        for last in 0..told.len() {
            let mut asked = 0;
            let mut stop = |_: Progress| {
                asked += 1;
                if asked > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let refused = Smoother::watched(&mesh, options, &Watch::new(&mut stop)).unwrap_err();
            assert_eq!((refused.code(), asked), ("Cancelled", last + 1), "{weights:?}");
        }
    }
}

#[test]
fn stopped_work_leaves_no_trace() {
    let mesh = shapes::torus(40, 30, 0.2).unwrap();
    let values = noise(5 * mesh.vertex_count(), 4);
    for options in settings() {
        let mut stopped = Smoother::new(&mesh, options).unwrap();
        for method in methods() {
            let context = format!("{options:?} {}", method.name().name());
            let mut fresh = Smoother::new(&mesh, options).unwrap();
            let mut told = Vec::new();
            let mut tell = |progress: Progress| {
                told.push(progress.fraction);
                ControlFlow::Continue(())
            };
            let expected = fresh.apply(&values, &method, &Watch::new(&mut tell)).unwrap();
            assert!(told.windows(2).all(|pair| pair[0] <= pair[1]), "{context}: {told:?}");
            assert_eq!(told.last(), Some(&1.0), "{context}");
            let questions = told.len();
            for last in (0..questions).step_by(1 + questions / 12) {
                let mut asked = 0;
                let mut stop = |_: Progress| {
                    asked += 1;
                    if asked > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                };
                let outcome = stopped.apply(&values, &method, &Watch::new(&mut stop));
                let refused = outcome.map_err(|error| error.code()).err();
                // What is kept from before can spare questions.
                assert!(refused == Some("Cancelled") || asked <= last, "{context}: {refused:?}");
                assert!(asked <= last + 1, "{context}: asked again after it was stopped");
            }
            let found = stopped.apply(&values, &method, &Watch::none()).unwrap();
            assert_eq!(found, expected, "{context}");
        }
    }
}
