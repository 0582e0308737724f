//! What the direct solver refuses, by name, and what it solves although it is nearly singular or badly scaled.

use morse_smooth::Watch;
use morse_smooth::error::SolveError;
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::{MassScale, cotan_laplacian, lumped_mass, uniform_laplacian};
use morse_smooth::solve::{CholeskyAnalysis, gram};
use nalgebra::{Complex, ComplexField};
use nalgebra_sparse::pattern::SparsityPattern;
use nalgebra_sparse::{CooMatrix, CscMatrix};
use proptest::prelude::*;

use crate::exact::Double;
use crate::iterative::{needles, slivers};
use crate::support::{
    Kind, dense, distance, dominant, every_kind, product_of, random_column, random_spd, random_surface,
};

fn analysis(matrix: &CscMatrix<f64>) -> CholeskyAnalysis {
    CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap()
}

fn real_values<K: Kind>(matrix: &CscMatrix<f64>) -> Vec<K::Wide> {
    matrix.values().iter().map(|&value| K::entry(value, 0.0)).collect()
}

/// The column that a matrix is refused for.
fn refused<K: Kind>(matrix: &CscMatrix<f64>) -> Option<usize> {
    match analysis(matrix).factor::<K>(&real_values::<K>(matrix), &Watch::none()) {
        Err(SolveError::NotPositiveDefinite { column }) => Some(column),
        Err(other) => panic!("{other}"),
        Ok(_) => None,
    }
}

fn diagonal(entries: &[f64]) -> CscMatrix<f64> {
    let mut coo = CooMatrix::new(entries.len(), entries.len());
    entries.iter().enumerate().for_each(|(i, &entry)| coo.push(i, i, entry));
    CscMatrix::from(&coo)
}

// ---- indefinite ----

fn check_diagonal<K: Kind>() {
    for n in [1, 2, 9, 40] {
        for bad in [0, n / 2, n - 1] {
            // In single precision nothing would be left of the others beside a number that is much larger.
            for value in [0.0, -1.0, -1e-300, if K::SINGLE { -1e30 } else { -1e300 }] {
                let mut entries: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
                entries[bad] = value;
                assert_eq!(refused::<K>(&diagonal(&entries)), Some(bad), "{}: {value:e} at {bad} of {n}", K::NAME);
            }
        }
    }
}

#[test]
fn a_diagonal_entry_that_is_not_positive_is_named() {
    check_diagonal::<f64>();
    check_diagonal::<f32>();
    check_diagonal::<Complex<f64>>();
    check_diagonal::<Complex<f32>>();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn indefinite_matrices_are_refused(seed: u64, n in 2_usize..50, density in 0.2..3.0, negative in 0.01..2.0) {
        // A definite matrix less enough to make its smallest eigenvalue negative.
        let matrix = random_spd(seed, n, (density * n as f64) as usize);
        let eigenvalues = dense(&matrix).symmetric_eigenvalues();
        let shift = eigenvalues.min() + negative * eigenvalues.max();
        let matrix = &matrix - &CscMatrix::identity(n) * shift;
        prop_assert!(refused::<f64>(&matrix).is_some());
        prop_assert!(refused::<f32>(&matrix).is_some());
    }

    #[test]
    fn the_column_named_is_in_the_block_that_is_to_blame(seed: u64, blocks in 1_usize..6, bad in 0_usize..6) {
        let bad = bad % blocks;
        let mut coo = CooMatrix::new(12 * blocks, 12 * blocks);
        for block in 0..blocks {
            let part = random_spd(seed.wrapping_add(block as u64), 12, 30);
            for (i, j, &value) in part.triplet_iter() {
                // All eigenvalues of one block are positive but one: a strong tie between its first and last unknown.
                coo.push(12 * block + i, 12 * block + j, value);
            }
            let tie = if block == bad { 100.0 } else { 0.0 };
            coo.push(12 * block, 12 * block + 11, tie);
            coo.push(12 * block + 11, 12 * block, tie);
        }
        let matrix = CscMatrix::from(&coo);
        for column in [refused::<f64>(&matrix), refused::<f32>(&matrix)] {
            prop_assert_eq!(column.map(|column| column / 12), Some(bad));
        }
        // In exact arithmetic the real part decides for complex matrices too, unless the imaginary part makes up for it.
        prop_assert_eq!(refused::<Complex<f64>>(&matrix).map(|column| column / 12), Some(bad));
    }
}

// ---- semi-definite ----

fn closed_and_open_surfaces() -> Vec<(String, TriMesh)> {
    let mut all: Vec<(String, TriMesh)> = Vec::new();
    let mut add = |name: String, mesh| all.push((name, mesh));
    for (name, mesh) in every_kind() {
        add(name.to_owned(), mesh);
    }
    for (around, across, jitter) in [(5, 4, 0.0), (20, 12, 0.0), (23, 17, 0.4), (40, 25, 0.5), (60, 34, 0.7)] {
        add(format!("torus {around} {jitter}"), shapes::torus(around, across, jitter).unwrap());
    }
    for subdivisions in 1..5 {
        add(format!("sphere {subdivisions}"), shapes::sphere(subdivisions).unwrap());
    }
    for side in [3, 8, 15, 25] {
        add(format!("moebius {side}"), shapes::moebius(2 * side, side).unwrap());
        add(format!("klein bottle {side}"), shapes::klein_bottle(2 * side, side).unwrap());
        add(format!("sphere with poles {side}"), shapes::irregular_sphere(side, 2 * side, 4).unwrap());
        add(format!("terrain {side}"), shapes::terrain(side, side + 3, 6).unwrap());
        add(format!("trefoil {side}"), shapes::trefoil_tube(3 * side, side, 0.3).unwrap());
    }
    for side in [3, 8, 15, 30, 50] {
        add(format!("grid {side}"), shapes::grid(side, side + 1).unwrap());
    }
    for seed in 0..12 {
        let base = shapes::torus(14 + 3 * seed as u32, 9 + seed as u32, 0.3).unwrap();
        add(format!("random surface {seed}"), random_surface(seed, &base, 0.05 * seed as f64));
    }
    all
}

/// A matrix without the rows and columns that are all zero, which say nothing about the others.
fn without_empty_rows(matrix: &CscMatrix<f64>) -> CscMatrix<f64> {
    let kept: Vec<u32> =
        (0..matrix.ncols()).filter(|&j| matrix.col(j).values().iter().any(|&v| v != 0.0)).map(|j| j as u32).collect();
    morse_smooth::solve::submatrix(matrix, &kept)
}

/// Where a singular matrix is accepted: its smallest pivot as a fraction of the diagonal.
fn accepted_pivot<K: Kind>(analysis: &CholeskyAnalysis, matrix: &CscMatrix<f64>) -> Option<f64> {
    let factor = match analysis.factor::<K>(&real_values::<K>(matrix), &Watch::none()) {
        Err(SolveError::NotPositiveDefinite { .. }) => return None,
        Err(other) => panic!("{other}"),
        Ok(factor) => factor,
    };
    // A pivot is the inverse of a diagonal entry of the inverse, where it is the last one.
    let n = matrix.ncols();
    let places: Vec<usize> = (0..n).step_by(1 + n / 24).collect();
    let mut units = vec![K::Wide::default(); n * places.len()];
    places.iter().enumerate().for_each(|(k, &i)| units[k * n + i] = K::entry(1.0, 0.0));
    let inverse = factor.solve(&units, &Watch::none()).unwrap();
    let pivots = places
        .iter()
        .enumerate()
        .map(|(k, &i)| 1.0 / (inverse[k * n + i].modulus() * matrix.get_entry(i, i).map_or(0.0, |d| d.into_value())));
    Some(pivots.fold(f64::INFINITY, f64::min))
}

/// How many singular matrices there are, and those of them that are taken for definite: a description of each, its smallest
/// pivot in roundings of the diagonal, and its size.
fn accepted_singular_matrices() -> (usize, Vec<(String, f64, usize)>) {
    let (mut all, mut accepted) = (0, Vec::new());
    for (name, mesh) in closed_and_open_surfaces() {
        for (weights, laplacian) in
            [("uniform", uniform_laplacian(&mesh).unwrap()), ("cotangent", cotan_laplacian(&mesh).unwrap())]
        {
            let laplacian = without_empty_rows(&laplacian);
            for (power, matrix) in [("L", laplacian.clone()), ("LᵀL", gram(&laplacian, &Watch::none()).unwrap())] {
                let analysis = analysis(&matrix);
                for (kind, unit, pivot) in [
                    ("f64", f64::EPSILON, accepted_pivot::<f64>(&analysis, &matrix)),
                    ("f32", f32::EPSILON.into(), accepted_pivot::<f32>(&analysis, &matrix)),
                ] {
                    all += 1;
                    let Some(pivot) = pivot else { continue };
                    accepted.push((format!("{name} {weights} {power} {kind}"), pivot / unit, matrix.ncols()));
                }
            }
        }
    }
    (all, accepted)
}

#[test]
fn singular_laplacians_and_their_squares_are_refused() {
    // In single precision their pivots are not small enough to tell them from sound ones.
    let (_, mut accepted) = accepted_singular_matrices();
    accepted.retain(|(name, ..)| name.ends_with("f64"));
    assert!(accepted.is_empty(), "{} accepted: {accepted:?}", accepted.len());
}

#[test]
fn what_is_left_of_a_singular_pivot_is_rounding() {
    let (all, accepted) = accepted_singular_matrices();
    assert!(5 * accepted.len() < 2 * all, "{} of {all} accepted", accepted.len());
    for (name, roundings, n) in accepted {
        assert!(roundings < n as f64 + 16.0, "{name}, {n} unknowns: {roundings} roundings");
    }
}

// ---- nearly singular ----

/// b with b = A x to about 32 digits: real and imaginary parts.
type Right = Vec<[Double; 2]>;

fn exact_product<K: Kind>(pattern: &SparsityPattern, values: &[K::Wide], x: &[K::Wide]) -> Right {
    let zero = Double::from(0.0);
    let mut result = vec![[zero; 2]; x.len()];
    for ((column, row), &value) in pattern.entries().zip(values) {
        let ([a, b], [c, d]) = (parts(value), parts(x[column]));
        let [re, im] = &mut result[row];
        *re = *re + a * c - b * d;
        *im = *im + a * d + b * c;
    }
    result
}

fn parts<T: Copy + ComplexField<RealField = f64>>(x: T) -> [Double; 2] {
    [Double::from(x.real()), Double::from(x.imaginary())]
}

/// The errors of a plain solve and after each step of refinement, with residuals of 32 digits, so that the factor alone
/// decides.
fn errors<K: Kind>(pattern: &SparsityPattern, values: &[K::Wide], steps: usize) -> Result<Vec<f64>, SolveError> {
    let n = pattern.major_dim();
    let x = random_column::<K>(n, &mut Random::new(n as u64));
    let b = exact_product::<K>(pattern, values, &x);
    let factor = CholeskyAnalysis::new(pattern.clone(), &Watch::none())?.factor::<K>(values, &Watch::none())?;
    let mut found = vec![K::Wide::default(); n];
    let mut errors = Vec::new();
    for _ in 0..=steps {
        let image = exact_product::<K>(pattern, values, &found);
        let residual: Vec<K::Wide> =
            b.iter().zip(&image).map(|(b, y)| K::entry((b[0] - y[0]).value(), (b[1] - y[1]).value())).collect();
        let correction = factor.solve(&residual, &Watch::none())?;
        found.iter_mut().zip(&correction).for_each(|(x, &d)| *x += d);
        errors.push(distance::<K>(&found, &x));
    }
    Ok(errors)
}

/// Checks that a solve is as good as the condition number allows, and a step of refinement the square of that.
fn check_condition<K: Kind>(name: &str, pattern: &SparsityPattern, values: &[K::Wide], condition: f64, unit: f64) {
    let errors = errors::<K>(pattern, values, 1).unwrap_or_else(|error| panic!("{name}, {}: {error}", K::NAME));
    let allowed = 3.0 * unit * condition;
    let after = (allowed * errors[0]).max(1e-14);
    assert!(errors[0] <= allowed, "{name}, {}: {:e} where {allowed:e} is the condition", K::NAME, errors[0]);
    assert!(errors[1] <= after, "{name}, {}: {errors:?} after refinement", K::NAME);
}

/// Largest sum of absolute values in a row, which bounds all eigenvalues.
fn row_norm(matrix: &CscMatrix<f64>) -> f64 {
    matrix.col_iter().map(|column| column.values().iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max)
}

#[test]
fn nearly_singular_matrices_are_solved() {
    for (name, mesh) in [
        ("torus", shapes::torus(30, 18, 0.4).unwrap()),
        ("terrain", shapes::terrain(40, 50, 2).unwrap()),
        ("sphere with poles", shapes::irregular_sphere(19, 60, 3).unwrap()),
    ] {
        let identity = CscMatrix::identity(mesh.vertex_count());
        for laplacian in [uniform_laplacian(&mesh).unwrap(), cotan_laplacian(&mesh).unwrap()] {
            let square = gram(&laplacian, &Watch::none()).unwrap();
            let systems = [
                (&laplacian, 1e-4),
                (&laplacian, 1e-7),
                (&laplacian, 1e-10),
                (&square, 1e-6),
                (&square, 1e-8),
                (&square, 1e-10),
            ];
            for (matrix, epsilon) in systems {
                let condition = row_norm(matrix) / epsilon;
                let matrix = matrix + &identity * epsilon;
                let name = format!("{name}, ε = {epsilon:e}");
                check_condition::<f64>(&name, matrix.pattern(), matrix.values(), condition, f64::EPSILON);
                let values = real_values::<Complex<f64>>(&matrix);
                check_condition::<Complex<f64>>(&name, matrix.pattern(), &values, condition, f64::EPSILON);
            }
            // As far as single precision goes.
            let matrix = &laplacian + &identity * 1e-3;
            let condition = row_norm(&laplacian) / 1e-3;
            let unit = f64::from(f32::EPSILON);
            check_condition::<f32>(name, matrix.pattern(), matrix.values(), condition, unit);
            let values = real_values::<Complex<f32>>(&matrix);
            check_condition::<Complex<f32>>(name, matrix.pattern(), &values, condition, unit);
        }
    }
}

/// L + i√ε·M on the pattern of L.
fn shifted(laplacian: &CscMatrix<f64>, mass: &CscMatrix<f64>, epsilon: f64) -> Vec<Complex<f64>> {
    let shift =
        |i: usize, j: usize| if i == j { epsilon.sqrt() * mass.get_entry(i, i).unwrap().into_value() } else { 0.0 };
    laplacian.triplet_iter().map(|(i, j, &value)| Complex::new(value, shift(i, j))).collect()
}

#[test]
fn complex_shifts_down_to_nothing() {
    for (name, mesh) in [
        ("sphere", shapes::sphere(3).unwrap()),
        ("torus", shapes::torus(30, 18, 0.3).unwrap()),
        ("grid", shapes::grid(30, 20).unwrap()),
        ("moebius", shapes::moebius(40, 12).unwrap()),
    ] {
        let laplacian = cotan_laplacian(&mesh).unwrap();
        let mass = lumped_mass(&mesh, MassScale::MeanOne).unwrap();
        let least = (0..mesh.vertex_count()).map(|i| mass.get_entry(i, i).unwrap().into_value()).fold(1.0, f64::min);
        for exponent in [4, 0, -4, -8, -12, -16, -20] {
            let epsilon = 10_f64.powi(exponent);
            let values = shifted(&laplacian, &mass, epsilon);
            let condition = row_norm(&laplacian) / (epsilon.sqrt() * least) + 100.0;
            let name = format!("{name}, ε = 1e{exponent}");
            check_condition::<Complex<f64>>(&name, laplacian.pattern(), &values, condition, f64::EPSILON);
            if exponent >= -4 {
                let unit = f64::from(f32::EPSILON);
                check_condition::<Complex<f32>>(&name, laplacian.pattern(), &values, condition, unit);
            }
        }
    }
}

#[test]
fn needles_with_huge_cotangents() {
    for (name, mesh) in [("needles", needles(25)), ("slivers", slivers(30, 1e-5))] {
        let laplacian = cotan_laplacian(&mesh).unwrap();
        let largest = laplacian.values().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(largest > 1e4, "{largest:e}");
        let identity = CscMatrix::identity(mesh.vertex_count());
        let screened = &laplacian + &identity;
        check_condition::<f64>(name, screened.pattern(), screened.values(), row_norm(&laplacian), f64::EPSILON);
        let square = gram(&laplacian, &Watch::none()).unwrap();
        let condition = row_norm(&square);
        let square = &square + &identity;
        check_condition::<f64>(name, square.pattern(), square.values(), condition, f64::EPSILON);
        let mass = CscMatrix::identity(mesh.vertex_count());
        let values = shifted(&laplacian, &mass, 1.0);
        check_condition::<Complex<f64>>(name, laplacian.pattern(), &values, row_norm(&laplacian), f64::EPSILON);
        // In single precision a solution of no digits or a refusal, but nothing that is not a number.
        match errors::<Complex<f32>>(laplacian.pattern(), &values, 0) {
            Ok(errors) => assert!(errors[0].is_finite()),
            Err(error) => assert_eq!(error.code(), "NotPositiveDefinite"),
        }
    }
}

// ---- scaling ----

fn check_scaling<K: Kind>(exponents: &[i32]) {
    let matrix = random_spd(12, 150, 400);
    let n = matrix.nrows();
    let analysis = analysis(&matrix);
    let x = random_column::<K>(n * 3, &mut Random::new(2));
    let plain: Vec<K::Wide> =
        matrix.triplet_iter().map(|(i, j, &v)| K::entry(v, if i == j { 0.3 * v } else { 0.1 * v })).collect();
    for &exponent in exponents {
        let scale = 10_f64.powi(exponent);
        let values: Vec<K::Wide> = plain.iter().map(|&v| v * K::entry(scale, 0.0)).collect();
        let factor = analysis.factor::<K>(&values, &Watch::none()).unwrap();
        for &other in exponents {
            // Columns of very different sizes side by side.
            let right_scales = [10_f64.powi(other), 1.0, 10_f64.powi(-other)];
            let scaled: Vec<K::Wide> =
                x.chunks(n).zip(right_scales).flat_map(|(x, s)| x.iter().map(move |&x| x * K::entry(s, 0.0))).collect();
            let b: Vec<K::Wide> = scaled.chunks(n).flat_map(|x| product_of::<K>(matrix.pattern(), &plain, x)).collect();
            for (found, (x, s)) in
                factor.solve(&b, &Watch::none()).unwrap().chunks(n).zip(scaled.chunks(n).zip(right_scales))
            {
                let back: Vec<K::Wide> = found.iter().map(|&x| x * K::entry(scale, 0.0) / K::entry(s, 0.0)).collect();
                let x: Vec<K::Wide> = x.iter().map(|&x| x / K::entry(s, 0.0)).collect();
                let wrong = distance::<K>(&back, &x);
                assert!(wrong <= K::ACCURACY, "{}: 1e{exponent}, 1e{other}: {wrong:e}", K::NAME);
            }
        }
    }
}

#[test]
fn matrices_and_right_hand_sides_of_any_size() {
    check_scaling::<f32>(&[-100, -30, -1, 1, 30, 100]);
    check_scaling::<Complex<f32>>(&[-100, -30, -1, 1, 30, 100]);
    check_scaling::<f64>(&[-100, -30, 30, 100]);
    check_scaling::<Complex<f64>>(&[-60, -30, 30, 60]);
}

fn check_small_entries<K: Kind>() {
    let mut random = Random::new(3);
    // Ties of any strength, and a block as a whole that is tiny beside the other.
    let pairs: Vec<(usize, usize, f64)> = (0..400)
        .map(|k| {
            let at = |x: f64| (x * 100.0) as usize;
            let size = [1.0, 1e-8, 1e-18, 1e-25, 1e-40, 1e-200][k % 6];
            (at(random.uniform()), at(random.uniform()), size * random.signed())
        })
        .collect();
    let ties = dominant(100, &pairs);
    let mut block = random_spd(4, 60, 200);
    block.values_mut().iter_mut().for_each(|v| *v *= 1e-25);
    let mut coo = CooMatrix::new(160, 160);
    ties.triplet_iter().for_each(|(i, j, &v)| coo.push(i, j, v));
    block.triplet_iter().for_each(|(i, j, &v)| coo.push(100 + i, 100 + j, v));
    let matrix = CscMatrix::from(&coo);
    let values = real_values::<K>(&matrix);
    // Right-hand sides in either part: in single precision both together would leave its range.
    for range in [0..100, 100..160] {
        let mut x = random_column::<K>(160, &mut random);
        x.iter_mut().enumerate().filter(|(i, _)| !range.contains(i)).for_each(|(_, x)| *x = K::entry(0.0, 0.0));
        let b = product_of::<K>(matrix.pattern(), &values, &x);
        let wrong = distance::<K>(
            &analysis(&matrix).factor::<K>(&values, &Watch::none()).unwrap().solve(&b, &Watch::none()).unwrap(),
            &x,
        );
        assert!(wrong <= K::ACCURACY, "{}: {wrong:e}", K::NAME);
    }
}

#[test]
fn very_small_entries_do_no_harm() {
    check_small_entries::<f64>();
    check_small_entries::<f32>();
    check_small_entries::<Complex<f64>>();
    check_small_entries::<Complex<f32>>();
}
