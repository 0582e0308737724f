//! Conjugate gradients and their preconditioners against dense algebra and a direct solver.

use morse_smooth::Watch;
use morse_smooth::error::SolveError;
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::{MassScale, cotan_laplacian, galerkin_mass, lumped_mass_diagonal, uniform_laplacian};
use morse_smooth::solve::{
    CgInfo, CgOptions, IncompleteCholesky, Jacobi, Multigrid, Preconditioner, SquaredSum, conjugate_gradient, norm,
    product, submatrix, transposed_product,
};
use nalgebra::{DMatrix, DVector};
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};
use proptest::prelude::*;

use crate::support::{dense, dominant, mesh, random_spd};

fn diagonal(matrix: &CscMatrix<f64>) -> Vec<f64> {
    (0..matrix.nrows()).map(|i| matrix.get_entry(i, i).map_or(0.0, |entry| entry.into_value())).collect()
}

fn noise(n: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..n).map(|_| random.signed()).collect()
}

/// The same matrix with `shift` times `mass` on top of its diagonal.
fn screened(matrix: &CscMatrix<f64>, mass: &[f64], shift: f64) -> CscMatrix<f64> {
    let mut sum = matrix.clone();
    sum.triplet_iter_mut().filter(|(i, j, _)| i == j).for_each(|(i, _, value)| *value += shift * mass[i]);
    sum
}

/// The Laplacian without the neighbourhoods of some vertices.
fn interior(mesh: &TriMesh, removed: usize) -> CscMatrix<f64> {
    let matrix = cotan_laplacian(mesh).unwrap();
    let mut random = Random::new(3);
    let mut keep = vec![true; matrix.nrows()];
    for _ in 0..removed {
        let v = (random.uniform() * keep.len() as f64) as usize;
        matrix.col(v).row_indices().iter().for_each(|&j| keep[j] = false);
    }
    let kept: Vec<u32> = (0..keep.len() as u32).filter(|&v| keep[v as usize]).collect();
    submatrix(&matrix, &kept)
}

fn solve(
    matrix: &CscMatrix<f64>,
    preconditioner: &dyn Preconditioner,
    b: &[f64],
    options: &CgOptions,
) -> (Vec<f64>, Result<CgInfo, SolveError>) {
    let mut x = vec![0.0; b.len()];
    let info = conjugate_gradient(&mut |v| product(matrix, v), preconditioner, b, &mut x, options, &Watch::none());
    (x, info)
}

fn preconditioners(matrix: &CscMatrix<f64>) -> Vec<(&'static str, Box<dyn Preconditioner>)> {
    vec![
        ("Jacobi", Box::new(Jacobi::new(&diagonal(matrix)).unwrap())),
        ("incomplete Cholesky", Box::new(IncompleteCholesky::new(matrix).unwrap())),
        ("multigrid", Box::new(Multigrid::new(matrix, &Watch::none()).unwrap())),
    ]
}

/// Every preconditioner solves the system, is symmetric and positive.
fn check(matrix: &CscMatrix<f64>, accuracy: f64, name: &str) {
    let n = matrix.nrows();
    let b = noise(n, 1);
    let expected: Vec<f64> = if n <= 300 {
        dense(matrix).cholesky().expect("definite").solve(&DVector::from_vec(b.clone())).as_slice().to_vec()
    } else {
        let right = DMatrix::from_column_slice(n, 1, &b);
        CscCholesky::factor(matrix).expect("definite").solve(&right).as_slice().to_vec()
    };
    for (which, preconditioner) in preconditioners(matrix) {
        check_operator(preconditioner.as_ref(), 1e-9, &format!("{name}, {which}"));
        let (x, info) = solve(matrix, preconditioner.as_ref(), &b, &CgOptions::default());
        let info = info.unwrap_or_else(|error| panic!("{name}, {which}: {error}"));
        let residual: Vec<f64> = product(matrix, &x).iter().zip(&b).map(|(ax, b)| b - ax).collect();
        let relative = norm(&residual) / norm(&b);
        assert!(relative <= 1.01e-11, "{name}, {which}: {relative:e}");
        assert!((relative - info.relative_residual).abs() <= 1e-13, "{name}, {which}");
        let difference: Vec<f64> = x.iter().zip(&expected).map(|(a, b)| a - b).collect();
        let wrong = norm(&difference) / norm(&expected);
        assert!(wrong <= accuracy, "{name}, {which}: {wrong:e} after {} iterations", info.iterations);
    }
}

/// xᵀM⁻¹y = yᵀM⁻¹x and xᵀM⁻¹x > 0.
fn check_operator(preconditioner: &dyn Preconditioner, accuracy: f64, name: &str) {
    let n = preconditioner.size();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for seed in 0..4 {
        let (mut x, y) = (noise(n, 10 + seed), noise(n, 20 + seed));
        if seed == 3 {
            x.fill(1.0);
        }
        let (mx, my) =
            (preconditioner.apply(&x, &Watch::none()).unwrap(), preconditioner.apply(&y, &Watch::none()).unwrap());
        let (first, second) = (dot(&x, &my), dot(&y, &mx));
        let size = (dot(&x, &mx) * dot(&y, &my)).sqrt();
        assert!(dot(&x, &mx) > 0.0 && dot(&y, &my) > 0.0, "{name} is positive");
        assert!((first - second).abs() <= accuracy * size, "{name} is symmetric: {first:e} and {second:e}");
    }
}

/// A grid squeezed to needles: cotangents up to about 1e5, both signs.
pub(crate) fn needles(side: u32) -> TriMesh {
    let base = shapes::grid(side, side).unwrap();
    let mut random = Random::new(11);
    let mut positions = base.positions().to_vec();
    for p in positions.chunks_exact_mut(3) {
        // Every other row of vertices is moved close to the next.
        let row = (p[1] * f64::from(side - 1)).round() as u32;
        p[0] += 0.3 * random.signed() / f64::from(side - 1);
        if row % 2 == 1 && row + 1 < side {
            p[1] += (1.0 - 1e-5) / f64::from(side - 1);
        }
    }
    TriMesh::new(positions, base.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

/// A jittered grid some of whose vertices are moved to where the opposite edge of a triangle is, but for a trifle.
pub(crate) fn slivers(side: u32, trifle: f64) -> TriMesh {
    let base = shapes::grid(side, side).unwrap();
    let triangles = base.connectivity().triangles();
    let mut random = Random::new(12);
    let mut positions = base.positions().to_vec();
    positions.iter_mut().for_each(|p| *p += 0.2 * random.signed() / f64::from(side - 1));
    let mut moved = vec![false; base.vertex_count()];
    for t in triangles {
        if random.uniform() < 0.05 && !t.iter().any(|&v| moved[v as usize]) {
            t.iter().for_each(|&v| moved[v as usize] = true);
            let [a, b, c] = t.map(|v| 3 * v as usize);
            for k in 0..3 {
                let middle = 0.5 * (positions[b + k] + positions[c + k]);
                positions[a + k] = middle + trifle * (positions[a + k] - middle);
            }
        }
    }
    TriMesh::new(positions, triangles.as_flattened().to_vec()).unwrap()
}

/// A vertex with very many neighbours in the middle of a disk.
pub(crate) fn wheel(spokes: u32) -> TriMesh {
    // Above and below by turns, from left to right.
    let mut positions = vec![[0.0, 0.0, 0.0]];
    for i in 0..spokes {
        let t = 2.0 * f64::from(i) / f64::from(spokes) - 1.0;
        let s = (1.0 - t * t).sqrt() * if i % 2 == 0 { 1.0 } else { -1.0 };
        positions.push([t, s, 0.0]);
    }
    let upper = (1..=spokes).step_by(2);
    let lower = (2..=spokes).step_by(2).collect::<Vec<_>>().into_iter().rev();
    let ring: Vec<u32> = upper.chain(lower).collect();
    let triangles: Vec<[u32; 3]> = (0..ring.len()).map(|i| [0, ring[i], ring[(i + 1) % ring.len()]]).collect();
    mesh(&positions, &triangles)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn random_matrices(seed: u64, n in 1_usize..60, density in 0.0..4.0) {
        check(&random_spd(seed, n, (density * n as f64) as usize), 1e-9, "random");
    }

    /// Mᵀ M of a random sparse matrix: entries of either sign, no dominant diagonal.
    #[test]
    fn random_products(seed: u64, n in 1_usize..40, density in 0.5..3.0) {
        let mut random = Random::new(seed);
        let full = DMatrix::from_fn(n, n, |i, j| {
            if random.uniform() * n as f64 <= density || i == j { random.signed() } else { 0.0 }
        });
        let square = full.transpose() * &full + DMatrix::identity(n, n) * 0.05;
        check(&CscMatrix::from(&square), 1e-7, "product");
    }
}

#[test]
fn matrices_of_special_shape() {
    check(&dominant(1, &[]), 1e-14, "1 × 1");
    check(&dominant(300, &[]), 1e-14, "diagonal");
    let path: Vec<(usize, usize, f64)> = (0..399).filter(|i| i % 40 != 0).map(|i| (i, i + 1, -1.0)).collect();
    check(&dominant(400, &path), 1e-10, "paths and single unknowns");
    for hub in [0, 250, 499] {
        check(&dominant(500, &(0..500).map(|i| (i, hub, -1.0)).collect::<Vec<_>>()), 1e-10, "arrow");
    }
    let full: Vec<(usize, usize, f64)> = (0..200).flat_map(|i| (0..i).map(move |j| (i, j, -0.1))).collect();
    check(&dominant(200, &full), 1e-10, "full");
    let empty = CscMatrix::<f64>::zeros(0, 0);
    assert_eq!(
        solve(&empty, &Multigrid::new(&empty, &Watch::none()).unwrap(), &[], &CgOptions::default())
            .1
            .unwrap()
            .iterations,
        0
    );
}

#[test]
fn laplacians() {
    let torus = shapes::torus(60, 40, 0.4).unwrap();
    check(&interior(&torus, 12), 1e-8, "interior of a torus");
    check(&interior(&shapes::grid(50, 50).unwrap(), 10), 1e-8, "interior of a grid");
    let mass = lumped_mass_diagonal(&torus, MassScale::MeanOne).unwrap();
    for (shift, accuracy) in [(1.0, 1e-9), (1e-2, 1e-8), (1e-4, 1e-6)] {
        check(&screened(&cotan_laplacian(&torus).unwrap(), &mass, shift), accuracy, &format!("screened by {shift:e}"));
        check(&screened(&uniform_laplacian(&torus).unwrap(), &vec![1.0; mass.len()], shift), accuracy, "uniform");
    }
    let wheel = wheel(2000);
    check(&screened(&uniform_laplacian(&wheel).unwrap(), &vec![1.0; 2001], 1e-2), 1e-7, "wheel, uniform");
    check(&screened(&cotan_laplacian(&wheel).unwrap(), &vec![1.0; 2001], 1e-2), 1e-6, "wheel");
}

#[test]
fn several_components_and_isolated_rows() {
    // Two copies of a matrix and rows with nothing but a diagonal in between.
    let part = interior(&shapes::torus(30, 20, 0.3).unwrap(), 5);
    let n = part.nrows();
    let mut coo = CooMatrix::new(2 * n + 50, 2 * n + 50);
    for (i, j, &value) in part.triplet_iter() {
        coo.push(i, j, value);
        coo.push(n + 50 + i, n + 50 + j, 1e6 * value);
    }
    (0..50).for_each(|i| coo.push(n + i, n + i, 1e-3));
    let matrix = CscMatrix::from(&coo);
    check(&matrix, 1e-8, "components");
}

#[test]
fn nearly_singular_laplacians() {
    // Screened by √1e-10 and 1e-10 itself: the constants are all but in the kernel.
    let torus = shapes::torus(40, 30, 0.35).unwrap();
    let mass = lumped_mass_diagonal(&torus, MassScale::MeanOne).unwrap();
    for shift in [1e-5, 1e-10] {
        let matrix = screened(&cotan_laplacian(&torus).unwrap(), &mass, shift);
        let multigrid = Multigrid::new(&matrix, &Watch::none()).unwrap();
        check_operator(&multigrid, 1e-4, "nearly singular");
        // A right-hand side without the constants, for which the solution hardly feels the shift.
        let mut b = noise(mass.len(), 4);
        let mean = b.iter().sum::<f64>() / b.len() as f64;
        b.iter_mut().for_each(|b| *b -= mean);
        let info = solve(&matrix, &multigrid, &b, &CgOptions { tolerance: 1e-9, ..CgOptions::default() }).1.unwrap();
        assert!(info.iterations < 30, "{}", info.iterations);
    }
}

#[test]
fn needle_triangles() {
    // Whole rows of needles lock to one another; single ones are what elimination is for.
    for (name, mesh, most) in [("rows", needles(40), 500), ("single", slivers(60, 1e-5), 25)] {
        let matrix = interior(&mesh, 8);
        let largest = matrix.values().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        assert!(largest > 5e4, "{largest:e}");
        let b = noise(matrix.nrows(), 6);
        let exact = CscCholesky::factor(&matrix).unwrap().solve(&DMatrix::from_column_slice(b.len(), 1, &b));
        // The diagonal alone takes more than 20,000 iterations.
        for (which, preconditioner) in preconditioners(&matrix).into_iter().skip(1) {
            let options = CgOptions { tolerance: 1e-9, ..CgOptions::default() };
            let (x, info) = solve(&matrix, preconditioner.as_ref(), &b, &options);
            let info = info.unwrap_or_else(|error| panic!("{name}, {which}: {error}"));
            let wrong = (DVector::from_vec(x) - exact.column(0)).norm() / exact.norm();
            // The condition number is large, so the residual promises less about the solution.
            assert!(wrong < 1e-5, "{name}, {which}: {wrong:e}");
            assert!(which != "multigrid" || info.iterations < most, "{name}, {which}: {}", info.iterations);
        }
    }
}

#[test]
fn incomplete_cholesky_is_complete_without_fill() {
    let path: Vec<(usize, usize, f64)> = (0..99).map(|i| (i, i + 1, 0.3 - i as f64 / 50.0)).collect();
    // In this order the arrow has no fill; with the hub first it would.
    let arrow: Vec<(usize, usize, f64)> = (0..99).map(|i| (i, 99, 1.0 - i as f64 / 30.0)).collect();
    let tree: Vec<(usize, usize, f64)> = (0..98).map(|i| (i, 50 + i / 2, -1.0)).filter(|&(i, j, _)| i < j).collect();
    for pairs in [path, arrow, tree] {
        let matrix = dominant(100, &pairs);
        let incomplete = IncompleteCholesky::new(&matrix).unwrap();
        assert_eq!(incomplete.shift(), 0.0);
        let b = noise(100, 5);
        let expected = dense(&matrix).cholesky().unwrap().solve(&DVector::from_vec(b.clone()));
        let found = DVector::from_vec(incomplete.apply(&b, &Watch::none()).unwrap());
        assert!((found - &expected).norm() < 1e-13 * expected.norm());
    }
    // (G Gᵀ)_ij = a_ij on the pattern: M e_j differs from A e_j only where A has no entry.
    let matrix = random_spd(8, 40, 90);
    let incomplete = IncompleteCholesky::new(&matrix).unwrap();
    let unit = |j: usize| (0..40).map(|i| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
    let columns: Vec<DVector<f64>> =
        (0..40).map(|j| DVector::from_vec(incomplete.apply(&unit(j), &Watch::none()).unwrap())).collect();
    let product = DMatrix::from_columns(&columns).try_inverse().unwrap();
    for (i, j, value) in matrix.triplet_iter() {
        assert!((product[(i, j)] - value).abs() < 1e-11, "({i}, {j})");
    }
}

#[test]
fn incomplete_cholesky_shifts_where_it_breaks_down() {
    // Kershaw's example is definite, but its incomplete factor meets a negative pivot.
    let kershaw =
        DMatrix::from_row_slice(4, 4, &[3., -2., 0., 2., -2., 3., -2., 0., 0., -2., 3., -2., 2., 0., -2., 3.]);
    let matrix = CscMatrix::from(&kershaw);
    let incomplete = IncompleteCholesky::new(&matrix).unwrap();
    assert!(incomplete.shift() > 0.0);
    check(&matrix, 1e-10, "Kershaw");
}

#[test]
fn iterations_of_multigrid_hardly_grow() {
    let count = |matrix: &CscMatrix<f64>| {
        let options = CgOptions { tolerance: 1e-10, ..CgOptions::default() };
        let multigrid = Multigrid::new(matrix, &Watch::none()).unwrap();
        assert!(multigrid.complexity() < 1.8, "{}", multigrid.complexity());
        solve(matrix, &multigrid, &noise(matrix.nrows(), 2), &options).1.unwrap().iterations
    };
    for jitter in [0.0, 0.3, 0.45] {
        let (small, large) = (shapes::torus(80, 32, jitter).unwrap(), shapes::torus(320, 128, jitter).unwrap());
        let (few, many) = (count(&interior(&small, 13)), count(&interior(&large, 205)));
        assert!(many as f64 <= 1.6 * few as f64 && many < 30, "jitter {jitter}: {few} and {many}");
        let shifted = |mesh: &TriMesh| {
            screened(&cotan_laplacian(mesh).unwrap(), &lumped_mass_diagonal(mesh, MassScale::MeanOne).unwrap(), 1e-3)
        };
        let (few, many) = (count(&shifted(&small)), count(&shifted(&large)));
        assert!(many as f64 <= 1.6 * few as f64 && many < 30, "jitter {jitter}, screened: {few} and {many}");
    }
}

#[test]
fn squared_sums_take_few_iterations() {
    let torus = shapes::torus(60, 40, 0.4).unwrap();
    let laplacian = cotan_laplacian(&torus).unwrap();
    let (galerkin, lumped) =
        (galerkin_mass(&torus, MassScale::MeanOne).unwrap(), lumped_mass_diagonal(&torus, MassScale::MeanOne).unwrap());
    let n = lumped.len();
    for epsilon in [1e3_f64, 1.0, 1e-3, 1e-6, 1e-8] {
        for identity in [true, false] {
            let root: Vec<f64> = lumped.iter().map(|m| (epsilon * if identity { 1.0 } else { *m }).sqrt()).collect();
            let squared = SquaredSum::new(&laplacian, &root, SquaredSum::TOLERANCE, &Watch::none()).unwrap();
            let mut apply = |x: &[f64]| -> Vec<f64> {
                let smooth = product(&laplacian, &product(&laplacian, x));
                let mass = if identity { x.to_vec() } else { transposed_product(&galerkin, x) };
                smooth.iter().zip(mass).map(|(a, b)| a + epsilon * b).collect()
            };
            let (b, mut x) = (noise(n, 7), vec![0.0; n]);
            let options = CgOptions { tolerance: 1e-6, ..CgOptions::default() };
            let info = conjugate_gradient(&mut apply, &squared, &b, &mut x, &options, &Watch::none()).unwrap();
            assert!(info.iterations <= 20, "ε = {epsilon:e}, identity {identity}: {}", info.iterations);
        }
    }
    // With an exact inner solution it is what it says.
    let root = vec![0.3; n];
    let squared = SquaredSum::new(&laplacian, &root, 1e-12, &Watch::none()).unwrap();
    let sum = screened(&laplacian, &root, 1.0);
    let x = noise(n, 8);
    let mut image = product(&sum, &product(&sum, &x));
    let largest = diagonal(&sum).into_iter().fold(0.0, f64::max);
    image.iter_mut().for_each(|v| *v /= largest * largest);
    let found = squared.apply(&image, &Watch::none()).unwrap();
    let difference: Vec<f64> = found.iter().zip(&x).map(|(a, b)| a - b).collect();
    assert!(norm(&difference) < 1e-8 * norm(&x), "{:e}", norm(&difference));
    check_operator(&squared, 1e-8, "squared sum");
    let code = |diagonal: &[f64]| {
        SquaredSum::new(&laplacian, diagonal, 0.1, &Watch::none()).map(|_| ()).map_err(|error| error.code())
    };
    assert_eq!(code(&[1.0]), Err("DimensionMismatch"));
    assert_eq!(code(&vec![f64::NAN; n]), Err("NonFiniteEntry"));
    assert_eq!(code(&vec![-100.0; n]), Err("NotPositiveDefinite"));
}

/// Counts products with A, so that giving up early can be seen.
fn hopeless(matrix: &CscMatrix<f64>, preconditioner: &dyn Preconditioner, b: &[f64]) -> (usize, SolveError) {
    let mut products = 0;
    let mut x = vec![0.0; b.len()];
    let apply = &mut |v: &[f64]| {
        products += 1;
        product(matrix, v)
    };
    let options = CgOptions { patience: 300, ..CgOptions::default() };
    let error = conjugate_gradient(apply, preconditioner, b, &mut x, &options, &Watch::none()).expect_err("hopeless");
    (products, error)
}

#[test]
fn semi_definite_and_indefinite_matrices_end_in_an_error() {
    // A Laplacian with a right-hand side outside of its range.
    let laplacian = cotan_laplacian(&shapes::torus(30, 20, 0.3).unwrap()).unwrap();
    let n = laplacian.nrows();
    let mut all = vec![("Jacobi", Box::new(Jacobi::new(&diagonal(&laplacian)).unwrap()) as Box<dyn Preconditioner>)];
    if let Ok(incomplete) = IncompleteCholesky::new(&laplacian) {
        all.push(("incomplete Cholesky", Box::new(incomplete)));
    }
    if let Ok(multigrid) = Multigrid::new(&laplacian, &Watch::none()) {
        all.push(("multigrid", Box::new(multigrid)));
    }
    for (which, preconditioner) in all {
        let (products, error) = hopeless(&laplacian, preconditioner.as_ref(), &vec![1.0; n]);
        assert!(["NotConverged", "NotPositiveDefinite"].contains(&error.code()), "{which}: {error}");
        assert!(products < 1500, "{which}: {products}");
    }
    // Indefinite with a positive diagonal.
    let mut shifted = screened(&laplacian, &vec![1.0; n], -0.5);
    assert!(diagonal(&shifted).iter().all(|&d| d > 0.0));
    for (which, made) in [
        ("Jacobi", Jacobi::new(&diagonal(&shifted)).map(|p| Box::new(p) as Box<dyn Preconditioner>)),
        ("incomplete Cholesky", IncompleteCholesky::new(&shifted).map(|p| Box::new(p) as Box<dyn Preconditioner>)),
        ("multigrid", Multigrid::new(&shifted, &Watch::none()).map(|p| Box::new(p) as Box<dyn Preconditioner>)),
    ] {
        let error = match made {
            Ok(preconditioner) => {
                let (products, error) = hopeless(&shifted, preconditioner.as_ref(), &noise(n, 3));
                assert!(products < 1500, "{which}: {products}");
                error
            }
            Err(error) => error,
        };
        let expected = ["NotConverged", "NotPositiveDefinite", "IndefinitePreconditioner"];
        assert!(expected.contains(&error.code()), "{which}: {error}");
    }
    // A diagonal entry that is not positive has a name.
    let middle = shifted.col_offsets()[17] + shifted.col(17).row_indices().binary_search(&17).unwrap();
    for value in [0.0, -1.0] {
        shifted.values_mut()[middle] = value;
        let named = Some(SolveError::NotPositiveDefinite { column: 17 });
        assert_eq!(Jacobi::new(&diagonal(&shifted)).err(), named);
        assert_eq!(IncompleteCholesky::new(&shifted).err(), named);
        assert_eq!(Multigrid::new(&shifted, &Watch::none()).err(), named);
    }
}

/// Turns half of the residual around.
struct Turned(usize);

impl Preconditioner for Turned {
    fn size(&self) -> usize {
        self.0
    }

    fn apply(&self, r: &[f64], _watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        Ok(r.iter().map(|r| -r).collect())
    }
}

#[test]
fn conjugate_gradients_refuse_by_name() {
    // The Hilbert matrix: hopeless for a handful of iterations.
    let n = 30;
    let hilbert = DMatrix::from_fn(n, n, |i, j| 1.0 / (1 + i + j) as f64 + if i == j { 1e-9 } else { 0.0 });
    let mut apply = |v: &[f64]| (&hilbert * DVector::from_column_slice(v)).as_slice().to_vec();
    let jacobi = Jacobi::new(hilbert.diagonal().as_slice()).unwrap();
    let b = vec![1.0; n];
    let mut x = vec![0.0; n];
    let few = CgOptions { max_iterations: 3, ..CgOptions::default() };
    match conjugate_gradient(&mut apply, &jacobi, &b, &mut x, &few, &Watch::none()) {
        Err(SolveError::NotConverged { iterations: 3, residual }) => {
            let actual = (&hilbert * DVector::from_vec(x.clone()) - DVector::from_vec(b.clone())).norm() / norm(&b);
            assert!((residual / actual - 1.0).abs() < 1e-9, "{residual:e} {actual:e}");
        }
        other => panic!("{other:?}"),
    }
    let mut refused = |preconditioner: &dyn Preconditioner, b: &[f64], x: &mut [f64]| {
        conjugate_gradient(&mut apply, preconditioner, b, x, &CgOptions::default(), &Watch::none())
            .map(|_| ())
            .map_err(|e| e.code())
    };
    assert_eq!(refused(&Jacobi::new(&[1.0; 29]).unwrap(), &b, &mut x), Err("DimensionMismatch"));
    assert_eq!(refused(&jacobi, &b, &mut [0.0; 31]), Err("DimensionMismatch"));
    assert_eq!(refused(&Turned(n), &b, &mut [0.0; 30]), Err("IndefinitePreconditioner"));
    assert_eq!(refused(&jacobi, &[f64::NAN; 30], &mut x), Err("NonFiniteEntry"));
    assert_eq!(refused(&jacobi, &b, &mut [f64::INFINITY; 30]), Err("NonFiniteEntry"));
    let mut x = vec![5.0; n];
    assert_eq!(refused(&jacobi, &[0.0; 30], &mut x), Ok(()));
    assert!(x.iter().all(|&v| v == 0.0));
    let ones = Jacobi::new(&[1.0; 2]).unwrap();
    let options = CgOptions::default();
    let run = |apply: &mut dyn FnMut(&[f64]) -> Vec<f64>| {
        conjugate_gradient(apply, &ones, &[0.0, 1.0], &mut [0.0; 2], &options, &Watch::none())
    };
    assert_eq!(run(&mut |v| vec![v[0], -v[1]]), Err(SolveError::NotPositiveDefinite { column: 1 }));
    assert_eq!(run(&mut |v| vec![v[0], v[1] * f64::NAN]), Err(SolveError::NonFiniteEntry { row: 1 }));
    assert_eq!(run(&mut |v| vec![v[0]]), Err(SolveError::DimensionMismatch { expected: 2, actual: 1 }));
}

#[test]
fn preconditioners_refuse_by_name() {
    let codes = |matrix: &CscMatrix<f64>| {
        let codes = [IncompleteCholesky::new(matrix).err(), Multigrid::new(matrix, &Watch::none()).err()];
        assert_eq!(codes[0], codes[1]);
        codes[0].clone()
    };
    let wide = CscMatrix::from(&DMatrix::<f64>::from_element(3, 4, 1.0));
    assert_eq!(codes(&wide), Some(SolveError::DimensionMismatch { expected: 3, actual: 4 }));
    for (row, column) in [(2, 0), (0, 2), (1, 2), (2, 1)] {
        let mut coo = CooMatrix::new(3, 3);
        (0..3).for_each(|i| coo.push(i, i, 1.0));
        coo.push(row, column, 0.5);
        assert_eq!(codes(&CscMatrix::from(&coo)), Some(SolveError::NotSymmetric { row, column }));
    }
    let mut coo = CooMatrix::new(3, 3);
    [(0, 0), (2, 2), (1, 0), (0, 1)].iter().for_each(|&(i, j)| coo.push(i, j, 1.0));
    assert_eq!(codes(&CscMatrix::from(&coo)), Some(SolveError::NotPositiveDefinite { column: 1 }));
    let mut matrix = random_spd(4, 20, 40);
    let row = matrix.row_indices()[13];
    for value in [f64::NAN, f64::INFINITY] {
        matrix.values_mut()[13] = value;
        assert_eq!(codes(&matrix), Some(SolveError::NonFiniteEntry { row }));
    }
    assert_eq!(Jacobi::new(&[1.0, f64::NAN]).err(), Some(SolveError::NonFiniteEntry { row: 1 }));
    assert_eq!(Jacobi::new(&[1.0, 1e-310]).err(), Some(SolveError::NotPositiveDefinite { column: 1 }));
}

#[test]
fn sizes_at_the_ends_of_double_precision() {
    // Squares of these leave the range; the solution does not.
    for size in [1e-300, 1e-170, 1e170, 1e300] {
        let mut x = [0.0; 2];
        let mut apply = |v: &[f64]| vec![2.0 * v[0] + v[1], v[0] + 2.0 * v[1]];
        let b = [3.0 * size, 3.0 * size];
        let jacobi = Jacobi::new(&[2.0; 2]).unwrap();
        conjugate_gradient(&mut apply, &jacobi, &b, &mut x, &CgOptions::default(), &Watch::none()).unwrap();
        assert!(x.iter().all(|v| (v / size - 1.0).abs() < 1e-10), "{x:?} at {size:e}");
    }
    for size in [1e-200, 1e200] {
        let mut matrix = interior(&shapes::torus(20, 15, 0.3).unwrap(), 2);
        let expected = solve(
            &matrix,
            &Multigrid::new(&matrix, &Watch::none()).unwrap(),
            &noise(matrix.nrows(), 1),
            &CgOptions::default(),
        );
        matrix.values_mut().iter_mut().for_each(|v| *v *= size);
        for (which, preconditioner) in preconditioners(&matrix) {
            let b: Vec<f64> = noise(matrix.nrows(), 1).iter().map(|b| b * size).collect();
            let (x, info) = solve(&matrix, preconditioner.as_ref(), &b, &CgOptions::default());
            info.unwrap_or_else(|error| panic!("{which} at {size:e}: {error}"));
            let difference: Vec<f64> = x.iter().zip(&expected.0).map(|(a, b)| a - b).collect();
            assert!(norm(&difference) < 1e-8 * norm(&x), "{which} at {size:e}");
        }
    }
}
