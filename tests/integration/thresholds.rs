//! What lies just on one side of a threshold: a threshold that is moved by some orders of magnitude takes it to the other side.

use morse_smooth::Watch;
use morse_smooth::error::SolveError;
use morse_smooth::operators::normalized_cotan_laplacian;
use morse_smooth::smooth::{InterpolateOptions, Smoother, SmootherOptions, Unconstrained};
use morse_smooth::solve::CholeskyAnalysis;
use nalgebra::DMatrix;
use nalgebra_sparse::CscMatrix;

use crate::dense_reference::named;
use crate::support::{dense, mesh};

/// Weights that cancel to a millionth of their size still make an average. In a triangle cot A + cot B = sin C/(sin A sin B), so that those
/// of its far corner are sin A cos B/sin C and sin B cos A/sin C.
#[test]
fn weights_that_nearly_cancel_are_normalized() {
    for angle in [1e-3_f64, 1e-6, 1e-9] {
        let [a, b] = [120_f64.to_radians(), 60_f64.to_radians() - angle];
        let far = b.sin() / angle.sin();
        let corner = [far * a.cos(), far * a.sin(), 0.0];
        let normalized =
            dense(&normalized_cotan_laplacian(&mesh(&[[0.0; 3], [1.0, 0.0, 0.0], corner], &[[0, 1, 2]])).unwrap());
        let expected = [-a.sin() * b.cos() / angle.sin(), -b.sin() * a.cos() / angle.sin()];
        for (found, expected) in [normalized[(2, 0)], normalized[(2, 1)]].into_iter().zip(expected) {
            let error = (found / expected - 1.0).abs();
            assert!(error < 1e-14 / angle, "angle {angle:e}: {found:e}, not {expected:e}");
        }
    }
}

/// A pivot of a thousandth of its entry has four digits in single precision. One of a ten-millionth has none.
#[test]
fn small_pivots_in_single_precision() {
    let factor = |pivot: f64| {
        let beside = (1.0 - pivot).sqrt();
        let matrix = CscMatrix::from(&DMatrix::from_row_slice(2, 2, &[1.0, beside, beside, 1.0]));
        let analysis = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap();
        let factor = analysis.factor::<f32>(matrix.values(), &Watch::none())?;
        factor.solve(&[1.0, -1.0], &Watch::none())
    };
    for pivot in [1e-2_f64, 1e-3, 1e-4] {
        // (1, −1) is an eigenvector.
        let expected = 1.0 / (1.0 - (1.0 - pivot).sqrt());
        let found = factor(pivot).unwrap();
        assert!((found[0] / expected - 1.0).abs() < 1e-6 / pivot, "{pivot:e}: {found:?}, not {expected}");
    }
    assert!(matches!(factor(1e-8), Err(SolveError::NotPositiveDefinite { .. })));
}

/// A weight below zero makes a free vertex lower than all around it, by a billionth of the range.
#[test]
fn a_slight_violation_of_the_maximum_principle_is_told() {
    let positions = [
        [0.9, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 0.3, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -0.3, 0.0],
        [5.0, 0.0, 0.0],
        [6.0, 0.0, 0.0],
        [5.0, 1.0, 0.0],
    ];
    let mesh = mesh(&positions, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [5, 6, 7]]);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let weights = dense(smoother.laplacian());
    assert!(weights[(0, 3)] > 0.5, "the weight of the far neighbour is below zero");
    for (height, extrema) in [(1e-9, 1), (1e-16, 0)] {
        let f = [0.0, 0.0, 0.0, height, 0.0, 0.0, 1.0, 0.5];
        let constraints = named(&[1, 2, 3, 4, 5, 6, 7], Unconstrained::Error);
        let smoothed =
            smoother.interpolate(&f, &InterpolateOptions { constraints, ..InterpolateOptions::default() }).unwrap();
        let expected = -weights[(0, 3)] / weights[(0, 0)] * height;
        assert!((smoothed.values[0] - expected).abs() <= 1e-15, "{:e}, not {expected:e}", smoothed.values[0]);
        assert_eq!(smoothed.reports[0].maximum_principle.unwrap().extrema, extrema, "{height:e}");
    }
}
