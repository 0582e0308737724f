//! The solver stops where its watcher says so, and goes on as if nothing had happened.

use core::fmt::Debug;
use core::ops::ControlFlow;

use morse_smooth::Watch;
use morse_smooth::error::SolveError;
use morse_smooth::mesh::shapes;
use morse_smooth::operators::uniform_laplacian;
use morse_smooth::solve::{
    CgOptions, CholeskyAnalysis, IncompleteCholesky, Multigrid, Preconditioner, SquaredSum, conjugate_gradient, gram,
    minimum_degree, nested_dissection, transposed_product,
};
use morse_smooth::{Phase, Progress};
use nalgebra::Complex;
use nalgebra_sparse::CscMatrix;

use crate::support::Kind;

/// L + 0.01 I of a torus.
fn shifted_laplacian(around: u32, along: u32) -> CscMatrix<f64> {
    let mut matrix = uniform_laplacian(&shapes::torus(around, along, 0.3).unwrap()).unwrap();
    matrix.triplet_iter_mut().filter(|(i, j, _)| i == j).for_each(|(_, _, value)| *value += 0.01);
    matrix
}

/// What a watcher hears of a call that it lets run.
fn heard<T>(call: impl FnOnce(&Watch<'_>) -> Result<T, SolveError>) -> (T, Vec<Progress>) {
    let mut all = Vec::new();
    let mut watcher = |progress| {
        all.push(progress);
        ControlFlow::Continue(())
    };
    let result = call(&Watch::new(&mut watcher)).unwrap();
    (result, all)
}

/// Calls with a watcher that stops the work at the question of this number.
fn stopped<T>(question: usize, call: impl FnOnce(&Watch<'_>) -> Result<T, SolveError>) -> Result<T, SolveError> {
    let mut asked = 0;
    let mut watcher = |_| {
        asked += 1;
        if asked > question { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let result = call(&Watch::new(&mut watcher));
    assert!(asked <= question + 1, "asked again after the work was stopped");
    result
}

/// A call is stopped at some of its questions, each time with `Cancelled`, and gives the same result after all of them.
fn check<T: PartialEq + Debug>(
    what: &str,
    least: usize,
    mut call: impl FnMut(&Watch<'_>) -> Result<T, SolveError>,
) -> Vec<Progress> {
    let (expected, all) = heard(&mut call);
    assert!(all.len() >= least, "{what}: only {} questions", all.len());
    for pair in all.windows(2) {
        assert!(pair[0].fraction <= pair[1].fraction, "{what}: the fraction goes back");
    }
    assert!(all.iter().all(|progress| (0.0..=1.0).contains(&progress.fraction)), "{what}");
    for part in 0..8 {
        let question = (all.len() - 1) * part / 7;
        assert_eq!(stopped(question, &mut call), Err(SolveError::Cancelled {}), "{what}, question {question}");
    }
    assert!(call(&Watch::none()).unwrap() == expected, "{what}: another result after it was stopped");
    all
}

#[test]
fn orderings_and_products_stop() {
    let laplacian = shifted_laplacian(260, 130);
    let square = gram(&laplacian, &Watch::none()).unwrap();
    check("gram", 3, |watch| gram(&laplacian, watch));
    check("nested dissection", 5, |watch| nested_dissection(square.pattern(), watch));
    check("minimum degree", 2, |watch| minimum_degree(square.pattern(), watch));
    let analysis = |watch: &Watch<'_>| CholeskyAnalysis::new(square.pattern().clone(), watch).map(|a| a.size());
    let all = check("analysis", 8, analysis);
    assert!(all.iter().all(|progress| progress.phase == Phase::Analysis));
    assert_eq!(all.last().unwrap().fraction, 1.0);
}

fn factors_stop<K: Kind>() {
    let matrix = gram(&shifted_laplacian(160, 80), &Watch::none()).unwrap();
    let values: Vec<K::Wide> = matrix.values().iter().map(|&value| K::entry(value, 0.0)).collect();
    let other: Vec<K::Wide> = matrix.values().iter().map(|&value| K::entry(2.0 * value, 0.0)).collect();
    let b: Vec<K::Wide> = (0..9 * matrix.nrows()).map(|i| K::entry((i % 101) as f64, 1.0)).collect();
    let n = matrix.nrows();
    let analysis = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap();
    let x = analysis.factor::<K>(&values, &Watch::none()).unwrap().solve(&b, &Watch::none()).unwrap();
    let all = check(K::NAME, 6, |watch| {
        analysis.factor::<K>(&values, watch).map(|factor| factor.solve(&b[..n], &Watch::none()).unwrap())
    });
    assert!(all.iter().all(|progress| progress.phase == Phase::Factorization));
    // What was expected is what was counted.
    let before_end = all[all.len() - 2].fraction;
    assert!(before_end > 0.8, "{}: {before_end}", K::NAME);
    let mut factor = analysis.factor::<K>(&values, &Watch::none()).unwrap();
    check("solve", 1, |watch| factor.solve(&b, watch));
    let questions = heard(|watch| factor.refactor(&other, watch)).1.len();
    for question in [0, 1, questions / 2, questions - 1] {
        let refactor = |watch: &Watch<'_>| factor.refactor(&other, watch);
        assert_eq!(stopped(question, refactor), Err(SolveError::Cancelled {}));
        assert_eq!(factor.solve(&b[..n], &Watch::none()), Err(SolveError::Cancelled {}), "no factor is left");
        factor.refactor(&values, &Watch::none()).unwrap();
        assert_eq!(factor.solve(&b, &Watch::none()).unwrap(), x);
    }
}

#[test]
fn factorisations_and_solves_stop() {
    factors_stop::<f64>();
    factors_stop::<f32>();
    factors_stop::<Complex<f64>>();
    factors_stop::<Complex<f32>>();
}

#[test]
fn iterations_stop() {
    let matrix = shifted_laplacian(320, 160);
    let b: Vec<f64> = (0..matrix.nrows()).map(|i| (i % 89) as f64).collect();
    let options = CgOptions { tolerance: 1e-8, ..CgOptions::default() };
    let solve = |preconditioner: &dyn Preconditioner, watch: &Watch<'_>| {
        let mut x = vec![0.0; b.len()];
        let apply = &mut |x: &[f64]| transposed_product(&matrix, x);
        conjugate_gradient(apply, preconditioner, &b, &mut x, &options, watch)?;
        Ok(x)
    };
    check("set-up of multigrid", 3, |watch| Multigrid::new(&matrix, watch)?.apply(&b, &Watch::none()));
    check("incomplete Cholesky", 1, |watch| IncompleteCholesky::new(&matrix, watch)?.apply(&b, &Watch::none()));
    let multigrid = Multigrid::new(&matrix, &Watch::none()).unwrap();
    check("with multigrid", 3, |watch| solve(&multigrid, watch));
    let root = vec![0.1; b.len()];
    let squared = SquaredSum::new(&matrix, &root, 1e-6, &Watch::none()).unwrap();
    check("inner iterations", 3, |watch| squared.apply(&b, watch));
    check("set-up for squares", 3, |watch| SquaredSum::new(&matrix, &root, 1e-6, watch)?.apply(&b, &Watch::none()));
}
