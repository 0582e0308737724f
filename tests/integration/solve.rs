//! The linear solvers against dense algebra.

use morse_smooth::Watch;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::uniform_laplacian;
use morse_smooth::solve::{
    CholeskyAnalysis, Permutation, gram, minimum_degree, norm, product, submatrix, transposed_product,
};
use nalgebra::{DMatrix, DVector};
use nalgebra_sparse::CscMatrix;
use proptest::prelude::*;

use crate::support::{column_counts, dense, dominant, quadratic_form, random_spd};

fn star(n: usize) -> CscMatrix<f64> {
    // The hub is in the middle of the numbering.
    dominant(n, &(0..n).map(|i| (i, n / 2, -1.0 - i as f64 / n as f64)).collect::<Vec<_>>())
}

/// Entries of the factor when the unknowns are eliminated in this order.
fn played_out(matrix: &CscMatrix<f64>, order: &[u32]) -> u64 {
    column_counts(matrix.pattern(), order).iter().sum()
}

fn check_order(matrix: &CscMatrix<f64>) -> Vec<u32> {
    let order = minimum_degree(matrix.pattern(), &Watch::none()).unwrap();
    let mut sorted = order.clone();
    sorted.sort_unstable();
    assert!(sorted.iter().copied().eq(0..matrix.nrows() as u32), "a permutation");
    order
}

fn check_solver(matrix: &CscMatrix<f64>, seed: u64, columns: usize) {
    let n = matrix.nrows();
    let mut random = Random::new(seed);
    let right: Vec<f64> = (0..n * columns).map(|_| random.signed()).collect();
    let expected = dense(matrix).cholesky().expect("definite").solve(&DMatrix::from_column_slice(n, columns, &right));
    let analysis = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap();
    let found = analysis.factor::<f64>(matrix.values(), &Watch::none()).unwrap().solve(&right, &Watch::none()).unwrap();
    let difference = (DMatrix::from_column_slice(n, columns, &found) - &expected).abs().max();
    assert!(difference <= 1e-12 * expected.abs().max(), "{difference:e}");
    assert_eq!(analysis.unknowns(), n);
    let order = check_order(matrix);
    let permutation = Permutation::new(order.clone()).unwrap();
    let analysis = CholeskyAnalysis::with_permutation(matrix.pattern().clone(), &permutation, &Watch::none()).unwrap();
    assert_eq!(analysis.size().nonzeros, played_out(matrix, &order));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn cholesky_agrees_with_dense_algebra(seed: u64, n in 1_usize..40, density in 0.0..3.0, columns in 1_usize..4) {
        check_solver(&random_spd(seed, n, (density * n as f64) as usize), seed, columns);
    }

    #[test]
    fn products_agree_with_dense_algebra(seed: u64, rows in 1_usize..12, columns in 1_usize..12) {
        let mut random = Random::new(seed);
        let full = DMatrix::from_fn(rows, columns, |_, _| if random.uniform() < 0.4 { random.signed() } else { 0.0 });
        let sparse = CscMatrix::from(&full);
        let (x, y) = (DVector::from_fn(columns, |_, _| random.signed()), DVector::from_fn(rows, |_, _| random.signed()));
        let close = |a: Vec<f64>, b: DVector<f64>| (DVector::from_vec(a) - b).abs().max() < 1e-14;
        prop_assert!(close(product(&sparse, x.as_slice()), &full * &x));
        prop_assert!(close(transposed_product(&sparse, y.as_slice()), full.transpose() * &y));
        prop_assert!((dense(&gram(&sparse, &Watch::none()).unwrap()) - full.transpose() * &full).abs().max() < 1e-14);
        let square = &full * full.transpose();
        let form = quadratic_form(&CscMatrix::from(&square), y.as_slice());
        prop_assert!((form - (&square * &y).dot(&y)).abs() < 1e-13);
        let kept: Vec<u32> = (0..rows as u32).filter(|_| random.uniform() < 0.6).collect();
        let part = submatrix(&CscMatrix::from(&square), &kept);
        for (i, &a) in kept.iter().enumerate() {
            for (j, &b) in kept.iter().enumerate() {
                prop_assert_eq!(dense(&part)[(i, j)], square[(a as usize, b as usize)]);
            }
        }
    }
}

#[test]
fn matrices_of_special_shape() {
    check_solver(&dominant(1, &[]), 1, 2);
    check_solver(&dominant(7, &[]), 2, 3);
    check_solver(&dominant(6, &[(0, 1, 1.0), (2, 3, -2.0), (3, 4, 0.5)]), 3, 1);
    check_solver(&dominant(20, &(0..19).map(|i| (i, i + 1, -1.0)).collect::<Vec<_>>()), 4, 1);
    let full: Vec<(usize, usize, f64)> = (0..12).flat_map(|i| (0..i).map(move |j| (i, j, 0.1))).collect();
    check_solver(&dominant(12, &full), 5, 1);
    check_solver(&star(40), 6, 2);
    // Past the threshold for dense rows the hub is put off to the end, and the factor has no fill at all.
    let large = star(300);
    let analysis = CholeskyAnalysis::new(large.pattern().clone(), &Watch::none()).unwrap();
    assert_eq!(analysis.size().nonzeros, 599);
    assert_eq!(played_out(&large, &check_order(&large)), 599);
    // Two hubs that are linked, and a path beside them.
    let mut pairs: Vec<(usize, usize, f64)> = (2..250).flat_map(|i| [(i, 0, -1.0), (i, 1, 0.5)]).collect();
    pairs.push((0, 1, 1.0));
    pairs.extend((250..279).map(|i| (i, i + 1, -1.0)));
    check_solver(&dominant(280, &pairs), 7, 1);
}

#[test]
fn minimum_degree_saves_fill() {
    // A tree needs no fill.
    let tree: Vec<(usize, usize, f64)> = (1..127).map(|i| (i, (i - 1) / 2, 1.0)).collect();
    let tree = dominant(127, &tree);
    assert_eq!(played_out(&tree, &check_order(&tree)), 127 + 126);
    // On grids about what the exact minimum degree gives, and far less than the natural order's band.
    for side in [12, 20] {
        let laplacian = uniform_laplacian(&shapes::grid(side, side).unwrap()).unwrap();
        for matrix in [laplacian.clone(), gram(&laplacian, &Watch::none()).unwrap()] {
            let natural: Vec<u32> = (0..side * side).collect();
            let natural = played_out(&matrix, &natural);
            let exact = played_out(&matrix, &exact_minimum_degree(&matrix));
            let found = played_out(&matrix, &check_order(&matrix));
            assert!((found as f64) < 1.15 * exact as f64, "{side}: {found} where {exact} entries do");
            assert!((found as f64) < 0.85 * natural as f64, "{side}: {found} of {natural}");
        }
    }
}

/// Eliminates a vertex of the smallest degree, by brute force.
fn exact_minimum_degree(matrix: &CscMatrix<f64>) -> Vec<u32> {
    let n = matrix.nrows();
    let mut linked = vec![std::collections::BTreeSet::new(); n];
    for (i, j, _) in matrix.triplet_iter().filter(|&(i, j, _)| i != j) {
        linked[i].insert(j);
    }
    let mut left: Vec<usize> = (0..n).collect();
    let mut order = Vec::new();
    while let Some(place) = (0..left.len()).min_by_key(|&i| linked[left[i]].len()) {
        let pivot = left.remove(place);
        order.push(pivot as u32);
        let clique = core::mem::take(&mut linked[pivot]);
        for &v in &clique {
            linked[v].remove(&pivot);
            linked[v].extend(clique.iter().copied().filter(|&u| u != v));
        }
    }
    order
}

#[test]
fn lengths_at_the_ends_of_double_precision() {
    // The squares of these leave the range.
    for size in [1e-300, 1e-170, 1e170, 1e300] {
        assert!((norm(&[3.0 * size, 4.0 * size]) / (5.0 * size) - 1.0).abs() < 1e-15, "norm at {size:e}");
    }
}
