//! What the direct solver refuses without looking at a single pivot, and that a failure leaves nothing behind.

use morse_smooth::Watch;
use morse_smooth::error::SolveError;
use morse_smooth::solve::{CholeskyAnalysis, Permutation};
use nalgebra::{Complex, DMatrix};
use nalgebra_sparse::pattern::SparsityPattern;
use nalgebra_sparse::{CooMatrix, CscMatrix};

use crate::support::{Kind, random_spd, relative_residual};

#[test]
fn refactoring_equals_a_new_factor() {
    let first = random_spd(3, 50, 120);
    let mut second = first.clone();
    second.values_mut().iter_mut().for_each(|v| *v *= 3.0);
    let b: Vec<f64> = (0..100).map(f64::from).collect();
    let analysis = CholeskyAnalysis::new(first.pattern().clone(), &Watch::none()).unwrap();
    let mut factor = analysis.factor::<f64>(first.values(), &Watch::none()).unwrap();
    let original = factor.solve(&b, &Watch::none()).unwrap();
    factor.refactor(second.values(), &Watch::none()).unwrap();
    assert_eq!(
        factor.solve(&b, &Watch::none()).unwrap(),
        analysis.factor::<f64>(second.values(), &Watch::none()).unwrap().solve(&b, &Watch::none()).unwrap()
    );
    // After a matrix that cannot be factorised it takes the next one.
    let mut indefinite = first.clone();
    indefinite.values_mut().iter_mut().for_each(|v| *v = -*v);
    let refused = factor.refactor(indefinite.values(), &Watch::none());
    assert!(matches!(refused, Err(SolveError::NotPositiveDefinite { .. })));
    assert_eq!(factor.solve(&b, &Watch::none()).map(|_| ()), refused);
    factor.refactor(first.values(), &Watch::none()).unwrap();
    assert_eq!(factor.solve(&b, &Watch::none()).unwrap(), original);
    let x = &original[..50];
    assert!(relative_residual(&first, x, &b[..50]) < 1e-14);
    assert_eq!(relative_residual(&first, &[0.0; 50], &b[..50]), 1.0);
    assert_eq!(relative_residual(&first, &[0.0; 50], &[0.0; 50]), 0.0);
}

#[test]
fn the_direct_solver_refuses_by_name() {
    let matrix = random_spd(9, 10, 20);
    let wide = CscMatrix::from(&DMatrix::<f64>::from_element(3, 4, 1.0));
    let code = |error: SolveError| error.code();
    assert_eq!(
        CholeskyAnalysis::new(wide.pattern().clone(), &Watch::none()).map(|_| ()).map_err(code),
        Err("DimensionMismatch")
    );
    let analysis = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap();
    let factor = analysis.factor::<f64>(matrix.values(), &Watch::none()).unwrap();
    assert_eq!(factor.solve(&[1.0; 9], &Watch::none()).map_err(code), Err("DimensionMismatch"));
    assert_eq!(factor.solve(&[1.0; 15], &Watch::none()).map_err(code), Err("DimensionMismatch"));
    let mut right = vec![1.0; 20];
    right[13] = f64::NAN;
    assert_eq!(factor.solve(&right, &Watch::none()), Err(SolveError::NonFiniteEntry { row: 3 }));
    assert_eq!(
        analysis.factor::<f64>(&matrix.values()[1..], &Watch::none()).map(|_| ()).map_err(code),
        Err("PatternMismatch")
    );
    // The row named is that of the matrix.
    for (place, (row, _, _)) in matrix.triplet_iter().enumerate() {
        let mut values = matrix.values().to_vec();
        values[place] = f64::INFINITY;
        match analysis.factor::<f64>(&values, &Watch::none()).map(|_| ()) {
            Err(SolveError::NonFiniteEntry { row: named }) => {
                let column = matrix.col_offsets().partition_point(|&start| start <= place) - 1;
                assert!(named == row || named == column, "entry {place} is in row {row}, not {named}");
            }
            other => panic!("{other:?}"),
        }
    }
    let mut values = matrix.values().to_vec();
    values.iter_mut().for_each(|v| *v = 0.0);
    assert_eq!(analysis.factor::<f64>(&values, &Watch::none()).map(|_| ()).map_err(code), Err("NotPositiveDefinite"));
    assert!(matches!(Permutation::new(vec![0, 2, 2]), Err(SolveError::DimensionMismatch { .. })));
    assert!(matches!(Permutation::new(vec![0, 3, 1]), Err(SolveError::DimensionMismatch { .. })));
    let short = Permutation::new(vec![1, 0]).unwrap();
    assert!(matches!(
        CholeskyAnalysis::with_permutation(matrix.pattern().clone(), &short, &Watch::none()),
        Err(SolveError::DimensionMismatch { expected: 10, actual: 2 })
    ));
}

#[test]
fn an_entry_without_a_mirror_image_is_refused() {
    let mut coo = CooMatrix::new(3, 3);
    for (row, column) in [(0, 0), (1, 1), (2, 2), (2, 0)] {
        coo.push(row, column, 1.0);
    }
    let matrix = CscMatrix::from(&coo);
    let refused = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).expect_err("not symmetric");
    assert_eq!(refused, SolveError::NotSymmetric { row: 2, column: 0 });
}

fn check_refusals<K: Kind>() {
    let matrix = random_spd(9, 30, 60);
    let values: Vec<K::Wide> = matrix.values().iter().map(|&v| K::entry(v, 0.1 * v)).collect();
    let analysis = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap();
    let mut factor = analysis.factor::<K>(&values, &Watch::none()).unwrap();
    let b: Vec<K::Wide> = (0..60).map(|i| K::entry(f64::from(i), 1.0)).collect();
    let good = factor.solve(&b, &Watch::none()).unwrap();
    // Arguments that do not fit leave the factor as it was.
    assert_eq!(factor.refactor(&values[1..], &Watch::none()), Err(SolveError::PatternMismatch {}));
    for bad in [
        K::entry(f64::NAN, 0.0),
        K::entry(f64::NEG_INFINITY, 0.0),
        K::entry(1.0, 0.0) * K::entry(f64::MAX, 0.0) * K::entry(2.0, 0.0),
    ] {
        let mut broken = values.clone();
        broken[0] = bad;
        assert_eq!(factor.refactor(&broken, &Watch::none()), Err(SolveError::NonFiniteEntry { row: 0 }), "{}", K::NAME);
        let mut broken = b.clone();
        broken[31] = bad;
        assert_eq!(factor.solve(&broken, &Watch::none()), Err(SolveError::NonFiniteEntry { row: 1 }), "{}", K::NAME);
    }
    assert_eq!(factor.solve(&b, &Watch::none()).unwrap(), good);
    assert_eq!(factor.solve(&[], &Watch::none()).unwrap(), []);
    for length in [1, 29, 31] {
        let refused = factor.solve(&vec![K::Wide::default(); length], &Watch::none());
        assert_eq!(refused, Err(SolveError::DimensionMismatch { expected: 30, actual: length }));
    }
    // Every diagonal entry made negative in turn: the same error again when solving, and good results after.
    for (place, (row, column, _)) in matrix.triplet_iter().enumerate().filter(|(_, (i, j, _))| i == j) {
        assert_eq!(row, column);
        let mut broken = values.clone();
        broken[place] = -broken[place];
        let refused = factor.refactor(&broken, &Watch::none()).expect_err("a negative diagonal entry");
        assert!(matches!(refused, SolveError::NotPositiveDefinite { .. }), "{}: {refused}", K::NAME);
        assert_eq!(factor.solve(&b, &Watch::none()), Err(refused.clone()));
        assert_eq!(factor.solve(&b[..30], &Watch::none()), Err(refused.clone()));
        assert_eq!(analysis.factor::<K>(&broken, &Watch::none()).map(|_| ()), Err(refused));
        factor.refactor(&values, &Watch::none()).unwrap();
        assert_eq!(factor.solve(&b, &Watch::none()).unwrap(), good, "{}", K::NAME);
    }
}

#[test]
fn a_failure_leaves_nothing_behind() {
    check_refusals::<f64>();
    check_refusals::<f32>();
    check_refusals::<Complex<f64>>();
    check_refusals::<Complex<f32>>();
}

#[test]
fn imaginary_parts_that_are_not_finite_are_refused() {
    let analysis = CholeskyAnalysis::new(random_spd(1, 3, 0).pattern().clone(), &Watch::none()).unwrap();
    let one = Complex::new(1.0, 0.0);
    for bad in [f64::NAN, f64::INFINITY] {
        let values = [one, one, Complex::new(1.0, bad)];
        let refused = SolveError::NonFiniteEntry { row: 2 };
        assert_eq!(analysis.factor::<Complex<f64>>(&values, &Watch::none()).map(|_| ()), Err(refused.clone()));
        assert_eq!(analysis.factor::<Complex<f32>>(&values, &Watch::none()).map(|_| ()), Err(refused.clone()));
        assert_eq!(
            analysis.factor::<Complex<f64>>(&[one; 3], &Watch::none()).unwrap().solve(&values, &Watch::none()),
            Err(refused)
        );
    }
}

#[test]
fn nothing_is_a_matrix_too() {
    let analysis = CholeskyAnalysis::new(SparsityPattern::zeros(0, 0), &Watch::none()).unwrap();
    assert_eq!((analysis.unknowns(), analysis.size().nonzeros, analysis.size().flops), (0, 0, 0));
    let factor = analysis.factor::<f64>(&[], &Watch::none()).unwrap();
    assert_eq!(factor.solve(&[], &Watch::none()), Ok(Vec::new()));
    assert_eq!(factor.solve(&[1.0], &Watch::none()), Err(SolveError::DimensionMismatch { expected: 0, actual: 1 }));
}

#[test]
fn a_diagonal_that_is_not_stored_is_zero() {
    let analysis = CholeskyAnalysis::new(SparsityPattern::zeros(4, 4), &Watch::none()).unwrap();
    assert_eq!(analysis.size().nonzeros, 4);
    assert!(matches!(
        analysis.factor::<f64>(&[], &Watch::none()).map(|_| ()),
        Err(SolveError::NotPositiveDefinite { .. })
    ));
    // Two unknowns with nothing but a tie: indefinite.
    let tie = SparsityPattern::try_from_offsets_and_indices(2, 2, vec![0, 1, 2], vec![1, 0]).unwrap();
    let analysis = CholeskyAnalysis::new(tie, &Watch::none()).unwrap();
    assert!(matches!(
        analysis.factor::<f32>(&[1.0, 1.0], &Watch::none()).map(|_| ()),
        Err(SolveError::NotPositiveDefinite { .. })
    ));
}

#[test]
fn a_factor_beyond_all_memory_is_refused_by_its_size() {
    // A star whose hub is eliminated first: a few million unknowns, and a factor that fills 2⁴⁷ bytes, which is more than a
    // process can address. A pattern without a diagonal saves some memory here.
    const N: usize = 4_400_000;
    let offsets = (0..=N).map(|i| if i == 0 { 0 } else { N - 2 + i }).collect();
    let indices = (1..N).chain(core::iter::repeat_n(0, N - 1)).collect();
    let pattern = SparsityPattern::try_from_offsets_and_indices(N, N, offsets, indices).unwrap();
    let permutation = Permutation::new((0..N as u32).collect()).unwrap();
    let values = vec![Complex::new(1.0, 0.0); pattern.nnz()];
    let analysis = CholeskyAnalysis::with_permutation(pattern, &permutation, &Watch::none()).unwrap();
    drop(permutation);
    let n = N as u64;
    assert_eq!(analysis.size().nonzeros, n * (n + 1) / 2);
    let bytes = analysis.memory::<Complex<f64>>();
    assert!(bytes >= 1 << 47 && bytes >= 16 * analysis.size().nonzeros);
    assert_eq!(
        analysis.factor::<Complex<f64>>(&values, &Watch::none()).map(|_| ()),
        Err(SolveError::OutOfMemory { bytes })
    );
}
