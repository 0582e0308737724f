//! The factor of all four kinds against dense algebra and other solvers, its size, and that it is reproducible.

use faer::linalg::solvers::Solve;
use morse_smooth::Watch;
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::{MassScale, cotan_laplacian, galerkin_mass};
use morse_smooth::solve::{CholeskyAnalysis, Permutation, gram, nested_dissection};
use nalgebra::{Complex, DMatrix, DVector};
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::pattern::SparsityPattern;
use nalgebra_sparse::{CooMatrix, CscMatrix};
use proptest::prelude::*;

use crate::support::{
    Kind, column_counts, dense, distance, dominant, jittered, product_of, random_column, random_spd, random_surface,
    shuffle,
};

/// Numbers of right-hand sides: single ones, whole blocks of four and eight, and rests of all sizes.
const COLUMNS: [usize; 9] = [1, 2, 3, 4, 5, 7, 8, 9, 17];

/// The values of a definite matrix of another kind: symmetric imaginary parts of up to `share` of the real ones. Whatever
/// they are, a definite real part is enough.
fn values_of<K: Kind>(matrix: &CscMatrix<f64>, share: f64, seed: u64) -> Vec<K::Wide> {
    matrix
        .triplet_iter()
        .map(|(i, j, &value)| {
            let pair = (i.min(j) * matrix.nrows() + i.max(j)) as u64;
            K::entry(value, share * value * Random::new(seed ^ (pair << 8)).signed())
        })
        .collect()
}

/// Solves for many right-hand sides at once and compares with dense elimination with pivoting; the error.
fn compare_with_dense<K: Kind>(matrix: &CscMatrix<f64>, share: f64, columns: &[usize], seed: u64) -> f64 {
    let n = matrix.nrows();
    let values = values_of::<K>(matrix, share, seed);
    let mut full = DMatrix::<K::Wide>::zeros(n, n);
    for ((column, row), &value) in matrix.pattern().entries().zip(&values) {
        full[(row, column)] = value;
    }
    let most = columns.iter().copied().max().unwrap_or(1);
    let right = random_column::<K>(n * most, &mut Random::new(seed));
    let expected = full.lu().solve(&DMatrix::from_column_slice(n, most, &right)).expect("regular");
    let factor = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none())
        .unwrap()
        .factor::<K>(&values, &Watch::none())
        .expect("definite");
    let wrong = columns.iter().map(|&columns| {
        let found = factor.solve(&right[..n * columns], &Watch::none()).unwrap();
        distance::<K>(&found, &expected.as_slice()[..n * columns])
    });
    wrong.fold(0.0, f64::max)
}

fn check<K: Kind>(name: &str, matrix: &CscMatrix<f64>, share: f64, columns: &[usize], seed: u64) {
    let wrong = compare_with_dense::<K>(matrix, share, columns, seed);
    assert!(wrong <= K::ACCURACY, "{name}, {}: {wrong:e}", K::NAME);
}

fn check_all_kinds(name: &str, matrix: &CscMatrix<f64>, columns: &[usize], seed: u64) {
    check::<f64>(name, matrix, 0.0, columns, seed);
    check::<f32>(name, matrix, 0.0, columns, seed);
    check::<Complex<f64>>(name, matrix, 0.7, columns, seed);
    check::<Complex<f32>>(name, matrix, 0.7, columns, seed);
}

/// BᵀB + I/4 for a random B with a few entries a row: definite, but far from dominant.
fn random_gram(seed: u64, n: usize, per_row: usize) -> CscMatrix<f64> {
    let mut random = Random::new(seed);
    let mut coo = CooMatrix::new(2 * n, n);
    for i in 0..n {
        coo.push(i, i, 0.5);
        for _ in 0..per_row {
            coo.push(n + i, (random.uniform() * n as f64) as usize, random.signed());
        }
    }
    gram(&CscMatrix::from(&coo), &Watch::none()).unwrap()
}

fn dense_pairs(range: core::ops::Range<usize>) -> Vec<(usize, usize, f64)> {
    let mut random = Random::new(range.end as u64);
    range.clone().flat_map(|i| (range.start..i).map(move |j| (i, j))).map(|(i, j)| (i, j, random.signed())).collect()
}

fn full(n: usize) -> CscMatrix<f64> {
    dominant(n, &dense_pairs(0..n))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn random_matrices_of_all_kinds(seed: u64, n in 1_usize..80, density in 0.0..1.0_f64) {
        // From diagonal to full, most of them sparse.
        let pairs = (density.powi(3) * (n * n) as f64) as usize;
        check_all_kinds("dominant", &random_spd(seed, n, pairs), &COLUMNS, seed);
        check_all_kinds("gram", &random_gram(seed, n, 1 + seed as usize % 4), &[1, 6], seed);
    }

    #[test]
    fn any_order_gives_the_same_solution(seed: u64, n in 2_usize..60, density in 0.0..3.0) {
        let matrix = random_spd(seed, n, (density * n as f64) as usize);
        let mut order: Vec<u32> = (0..n as u32).collect();
        shuffle(&mut order, &mut Random::new(seed));
        let permutation = Permutation::new(order.clone()).unwrap();
        for (new, &old) in order.iter().enumerate() {
            prop_assert_eq!(permutation.old_to_new()[old as usize] as usize, new);
        }
        let analysis = CholeskyAnalysis::with_permutation(matrix.pattern().clone(), &permutation, &Watch::none()).unwrap();
        let x = DVector::from_fn(n, |i, _| 1.0 + i as f64);
        let found = analysis.factor::<f64>(matrix.values(), &Watch::none()).unwrap().solve((dense(&matrix) * &x).as_slice(), &Watch::none()).unwrap();
        prop_assert!((DVector::from_vec(found) - &x).abs().max() <= 1e-11 * n as f64);
    }

    #[test]
    fn sizes_are_those_of_elimination(seed: u64, n in 1_usize..90, density in 0.0..2.5) {
        // With few pairs there are several components, hence several roots.
        let matrix = random_spd(seed, n, (density * n as f64) as usize);
        let mut shuffled: Vec<u32> = (0..n as u32).collect();
        shuffle(&mut shuffled, &mut Random::new(seed));
        for order in [shuffled, (0..n as u32).collect(), nested_dissection(matrix.pattern(), &Watch::none()).unwrap()] {
            check_size(matrix.pattern(), &order);
        }
    }
}

fn check_size(pattern: &SparsityPattern, order: &[u32]) {
    let permutation = Permutation::new(order.to_vec()).unwrap();
    let size = CholeskyAnalysis::with_permutation(pattern.clone(), &permutation, &Watch::none()).unwrap().size();
    let counts = column_counts(pattern, order);
    assert_eq!(size.nonzeros, counts.iter().sum::<u64>());
    assert_eq!(size.flops, counts.iter().map(|count| count * count).sum::<u64>());
}

#[test]
fn matrices_of_special_shape_in_all_kinds() {
    let path = |n: usize| (0..n - 1).map(|i| (i, i + 1, -1.0)).collect::<Vec<_>>();
    let band = |n: usize, width: usize| -> Vec<(usize, usize, f64)> {
        (0..n).flat_map(|i| (i + 1..n.min(i + width + 1)).map(move |j| (i, j, 1.0 / (i + j) as f64 - 0.5))).collect()
    };
    let arrow = |n: usize, tip: usize| (0..n).map(|i| (i, tip, -1.0)).collect::<Vec<_>>();
    let blocks: Vec<(usize, usize, f64)> =
        [0..1, 1..4, 4..9, 9..25, 25..26, 26..91, 91..100].into_iter().flat_map(dense_pairs).collect();
    // Two cliques that share a few columns: a front with rows below, and one above it.
    let overlapping: Vec<(usize, usize, f64)> = [dense_pairs(0..70), dense_pairs(60..150)].concat();
    for (name, matrix) in [
        ("one unknown", dominant(1, &[])),
        ("diagonal", dominant(37, &[])),
        ("path", dominant(90, &path(90))),
        ("band", dominant(120, &band(120, 6))),
        ("wide band", dominant(200, &band(200, 70))),
        ("arrow to the end", dominant(70, &arrow(70, 69))),
        ("arrow to the beginning", dominant(70, &arrow(70, 0))),
        ("star", dominant(300, &arrow(300, 150))),
        ("blocks", dominant(100, &blocks)),
        ("overlapping cliques", dominant(150, &overlapping)),
        ("several components", dominant(60, &[path(20), vec![(30, 31, 2.0), (31, 55, 1.0)]].concat())),
    ] {
        check_all_kinds(name, &matrix, &COLUMNS, 5);
    }
}

#[test]
fn dense_matrices_around_the_sizes_of_tiles_and_panels() {
    for n in [2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 66, 71, 72, 73, 127, 128, 129, 130, 260, 300] {
        let columns = if n < 100 { &COLUMNS[..] } else { &[1, 5, 8] };
        check_all_kinds(&format!("full matrix of {n}"), &full(n), columns, n as u64);
    }
}

/// Solves for the image of a known vector: dense elimination would take long.
fn check_image<K: Kind>(name: &str, matrix: &CscMatrix<f64>) {
    let mut random = Random::new(4);
    let values = values_of::<K>(matrix, 0.5, 9);
    let n = matrix.nrows();
    let x = random_column::<K>(n * 9, &mut random);
    let b: Vec<K::Wide> = x.chunks(n).flat_map(|x| product_of::<K>(matrix.pattern(), &values, x)).collect();
    let factor = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none())
        .unwrap()
        .factor::<K>(&values, &Watch::none())
        .unwrap();
    let wrong = distance::<K>(&factor.solve(&b, &Watch::none()).unwrap(), &x);
    let alone = distance::<K>(&factor.solve(&b[..n], &Watch::none()).unwrap(), &x[..n]);
    assert!(wrong.max(alone) <= K::ACCURACY, "{name}, {}: {wrong:e} {alone:e}", K::NAME);
}

#[test]
fn fronts_much_larger_than_panel_and_depth() {
    let dense = full(700);
    // A front of 300 columns with 300 rows below, twice.
    let cliques = dominant(900, &[dense_pairs(0..600), dense_pairs(300..900)].concat());
    for (name, matrix) in [("full", dense), ("cliques", cliques)] {
        check_image::<f64>(name, &matrix);
        check_image::<f32>(name, &matrix);
        check_image::<Complex<f64>>(name, &matrix);
        check_image::<Complex<f32>>(name, &matrix);
    }
}

/// The screened Laplacian and eq. (5).
fn systems(mesh: &TriMesh) -> [(&'static str, CscMatrix<f64>); 3] {
    let laplacian = cotan_laplacian(mesh).unwrap();
    let mass = galerkin_mass(mesh, MassScale::MeanOne).unwrap();
    let square = gram(&laplacian, &Watch::none()).unwrap();
    [("screened", &laplacian + &mass * 0.1), ("ε = 1", &square + &mass), ("ε = 1e-2", &square + &mass * 1e-2)]
}

fn oracle_meshes() -> Vec<(&'static str, TriMesh)> {
    vec![
        ("torus", shapes::torus(60, 34, 0.4).unwrap()),
        ("poles of high valence", shapes::irregular_sphere(19, 100, 3).unwrap()),
        ("random surface", random_surface(8, &jittered(&shapes::sphere(4).unwrap(), 0.01, 2), 0.1)),
    ]
}

#[test]
fn other_sparse_solvers_give_the_same() {
    for (mesh_name, mesh) in oracle_meshes() {
        let n = mesh.vertex_count();
        for (name, mut matrix) in systems(&mesh) {
            // Isolated vertices have no row.
            let missing: Vec<usize> =
                (0..n).filter(|&i| matrix.get_entry(i, i).is_none_or(|d| d.into_value() == 0.0)).collect();
            if !missing.is_empty() {
                let mut coo = CooMatrix::new(n, n);
                missing.iter().for_each(|&i| coo.push(i, i, 1.0));
                matrix = &matrix + &CscMatrix::from(&coo);
            }
            let b = random_column::<f64>(n, &mut Random::new(1));
            let ours = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none())
                .unwrap()
                .factor::<f64>(matrix.values(), &Watch::none())
                .unwrap();
            let ours = ours.solve(&b, &Watch::none()).unwrap();
            let theirs = CscCholesky::factor(&matrix).unwrap().solve(&DMatrix::from_column_slice(n, 1, &b));
            let wrong = distance::<f64>(&ours, theirs.as_slice());
            assert!(wrong < 1e-9, "{mesh_name}, {name}, nalgebra-sparse: {wrong:e}");
            let triplets: Vec<_> =
                matrix.triplet_iter().map(|(i, j, &v)| faer::sparse::Triplet::new(i, j, v)).collect();
            let sparse = faer::sparse::SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets).unwrap();
            let theirs = sparse.sp_cholesky(faer::Side::Lower).unwrap().solve(faer::Col::from_fn(n, |i| b[i]));
            let theirs: Vec<f64> = theirs.iter().copied().collect();
            let wrong = distance::<f64>(&ours, &theirs);
            assert!(wrong < 1e-9, "{mesh_name}, {name}, faer: {wrong:e}");
        }
    }
}

fn check_memory<K: Kind>(name: &str, analysis: &CholeskyAnalysis) {
    let least = analysis.size().nonzeros * size_of::<K>() as u64;
    let memory = analysis.memory::<K>();
    // Tiles and merged columns store some zeros, updates wait on a stack.
    assert!(memory >= least && memory <= 3 * least, "{name}, {}: {memory} for {least}", K::NAME);
}

#[test]
fn memory_is_a_small_multiple_of_the_entries() {
    for (mesh_name, mesh) in oracle_meshes() {
        for (name, matrix) in systems(&mesh) {
            let analysis = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap();
            let name = format!("{mesh_name}, {name}");
            check_memory::<f64>(&name, &analysis);
            check_memory::<f32>(&name, &analysis);
            check_memory::<Complex<f64>>(&name, &analysis);
            check_memory::<Complex<f32>>(&name, &analysis);
        }
    }
}

#[test]
fn sizes_on_meshes_are_those_of_elimination() {
    for (_, mesh) in crate::support::every_kind() {
        let laplacian = cotan_laplacian(&mesh).unwrap();
        for pattern in [laplacian.pattern().clone(), gram(&laplacian, &Watch::none()).unwrap().pattern().clone()] {
            check_size(&pattern, &nested_dissection(&pattern, &Watch::none()).unwrap());
        }
    }
}

fn check_reproducible<K: Kind>(matrix: &CscMatrix<f64>) {
    let n = matrix.nrows();
    let values = values_of::<K>(matrix, 0.4, 2);
    let other: Vec<K::Wide> = values.iter().map(|&v| v * K::entry(2.5, 0.0)).collect();
    let b = random_column::<K>(n * 17, &mut Random::new(6));
    let analysis = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none()).unwrap();
    let mut factor = analysis.factor::<K>(&values, &Watch::none()).unwrap();
    let first = factor.solve(&b, &Watch::none()).unwrap();
    // Nothing of another matrix is left behind, and neither the memory nor a new analysis matters.
    factor.refactor(&other, &Watch::none()).unwrap();
    factor.refactor(&values, &Watch::none()).unwrap();
    assert_eq!(factor.solve(&b, &Watch::none()).unwrap(), first, "{}", K::NAME);
    assert_eq!(factor.clone().solve(&b, &Watch::none()).unwrap(), first, "{}", K::NAME);
    let again = CholeskyAnalysis::new(matrix.pattern().clone(), &Watch::none())
        .unwrap()
        .factor::<K>(&values, &Watch::none())
        .unwrap();
    assert_eq!(again.solve(&b, &Watch::none()).unwrap(), first, "{}", K::NAME);
    // Columns do not touch each other; only the order of summation differs.
    let alone: Vec<K::Wide> = b.chunks(n).flat_map(|b| factor.solve(b, &Watch::none()).unwrap()).collect();
    let wrong = distance::<K>(&alone, &first);
    assert!(wrong <= 0.1 * K::ACCURACY, "{}: {wrong:e}", K::NAME);
}

#[test]
fn factors_are_reproducible() {
    let torus = systems(&shapes::torus(24, 17, 0.3).unwrap());
    for matrix in [random_spd(5, 200, 500), full(130), torus[1].1.clone()] {
        check_reproducible::<f64>(&matrix);
        check_reproducible::<f32>(&matrix);
        check_reproducible::<Complex<f64>>(&matrix);
        check_reproducible::<Complex<f32>>(&matrix);
    }
}
