//! Errors against solutions of twice the precision. Residuals would mislead: LᵀL squares the condition number, and a small
//! residual of it tells little about the error.

use morse_smooth::TriMesh;
use morse_smooth::Watch;
use morse_smooth::operators::{MassScale, cotan_laplacian, galerkin_mass, lumped_mass, lumped_mass_diagonal};
use morse_smooth::solve::{gram, norm, transposed_product};
use nalgebra::Complex;
use nalgebra_sparse::CscMatrix;
use nalgebra_sparse::pattern::SparsityPattern;

use super::extended::Extended;
use super::ours::{Analysis, Factor, Precision, order};
use super::systems::{Values, field, shifted};

/// Refinement steps whose errors are reported.
const STEPS: usize = 4;
/// What refinement aims at: an order of magnitude below what is asked of it.
const TOLERANCE: f64 = 1e-12;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Metric {
    Identity,
    Lumped,
    Galerkin,
}

pub(crate) const METRICS: [(&str, Metric); 3] =
    [("identity", Metric::Identity), ("lumped", Metric::Lumped), ("mass", Metric::Galerkin)];

/// One mesh and field; patterns are analysed once.
pub(crate) struct Accuracy {
    mesh: TriMesh,
    laplacian: CscMatrix<f64>,
    field: Vec<f64>,
    squared: (CscMatrix<f64>, Analysis),
    single: Analysis,
}

impl Accuracy {
    pub(crate) fn new(mesh: TriMesh) -> Self {
        let laplacian = cotan_laplacian(&mesh).expect("enough memory");
        let analyze = |matrix: &CscMatrix<f64>| Analysis::new(matrix.pattern().clone(), &order(matrix.pattern()));
        let squared = gram(&laplacian, &Watch::none()).expect("it fits");
        let analysis = analyze(&squared);
        let single = analyze(&laplacian);
        Self { field: field(&mesh, 0), squared: (squared, analysis), single, laplacian, mesh }
    }

    /// Relative errors of the solution of (LᵀL + εB)x = εBf by a real factor, after 0, 1, … steps of refinement with the
    /// residual εB(f − x) − Lᵀ(Lx). None where the matrix is not positive definite to that precision.
    pub(crate) fn real(&self, metric: Metric, epsilon: f64, precision: Precision) -> Option<Vec<f64>> {
        let (gram, analysis) = &self.squared;
        let mass = match metric {
            Metric::Identity => Ok(CscMatrix::identity(self.field.len())),
            Metric::Lumped => lumped_mass(&self.mesh, MassScale::MeanOne),
            Metric::Galerkin => galerkin_mass(&self.mesh, MassScale::MeanOne),
        };
        let mass = mass.expect("a mesh with area");
        let values = Values::Real((gram + &(&mass * epsilon)).values().to_vec());
        let exact_residual = |x: &[Extended]| -> Vec<f64> {
            let difference: Vec<Extended> = self.field.iter().zip(x).map(|(&f, &x)| Extended::from(f) - x).collect();
            let forced = extended_product(&mass, &difference);
            let smooth = extended_product(&self.laplacian, &extended_product(&self.laplacian, x));
            forced.iter().zip(smooth).map(|(b, l)| (b.times(epsilon) - l).rounded()).collect()
        };
        let residual = |x: &[f64]| -> Vec<f64> {
            let difference: Vec<f64> = self.field.iter().zip(x).map(|(f, x)| f - x).collect();
            let smooth = transposed_product(&self.laplacian, &transposed_product(&self.laplacian, x));
            transposed_product(&mass, &difference).iter().zip(smooth).map(|(b, l)| epsilon * b - l).collect()
        };
        let double = analysis.factor(&values, Precision::Double)?;
        let solve = |factor: &Factor, b: Vec<f64>| factor.solve(&Values::Real(b)).real().to_vec();
        let reference = reference(self.field.len(), exact_residual, |b| solve(&double, b));
        let factor = if precision == Precision::Double { double } else { analysis.factor(&values, precision)? };
        let mut x = vec![0.0; reference.len()];
        let mut errors = Vec::new();
        for _ in 0..=STEPS {
            let correction = solve(&factor, residual(&x));
            x.iter_mut().zip(correction).for_each(|(x, d)| *x += d);
            errors.push(relative_error(&x, &reference));
        }
        Some(errors)
    }

    /// Relative errors of x = −s Im((L + isM)⁻¹Mf), s = √ε, M lumped, after 0, 1, … steps of refinement with the residual of
    /// the complex system; then steps and error of [`refined`]. None where the matrix is not positive definite to that precision.
    pub(crate) fn complex(&self, epsilon: f64, precision: Precision) -> Option<Vec<f64>> {
        let mass = lumped_mass_diagonal(&self.mesh, MassScale::MeanOne).expect("a mesh with area");
        let shift = epsilon.sqrt();
        let values = shifted(&self.laplacian, &mass, epsilon);
        let n = mass.len();
        let right_hand_side: Vec<f64> = mass.iter().zip(&self.field).map(|(m, f)| m * f).collect();
        // Real and imaginary parts one after the other.
        let exact_residual = |z: &[Extended]| -> Vec<f64> {
            let (re, im) = z.split_at(n);
            let diagonal = |v: usize, x: Extended| x.times(shift * mass[v]);
            let (lre, lim) = (extended_product(&self.laplacian, re), extended_product(&self.laplacian, im));
            let above = (0..n).map(|v| {
                let forced = Extended::from(mass[v]).times(self.field[v]);
                (forced - lre[v] + diagonal(v, im[v])).rounded()
            });
            above.chain((0..n).map(|v| (-lim[v] - diagonal(v, re[v])).rounded())).collect()
        };
        let matrix = Values::Complex(values);
        let solve = |factor: &Factor, b: &[f64]| -> Vec<f64> {
            let joined = (0..n).map(|v| Complex::new(b[v], b[n + v])).collect();
            let Values::Complex(z) = factor.solve(&Values::Complex(joined)) else { return Vec::new() };
            z.iter().map(|z| z.re).chain(z.iter().map(|z| z.im)).collect()
        };
        let double = self.single.factor(&matrix, Precision::Double)?;
        let smoothed = |z: &[f64]| -> Vec<f64> { z[n..].iter().map(|z| -shift * z).collect() };
        let reference = smoothed(&reference(2 * n, exact_residual, |b| solve(&double, &b)));
        let factor = if precision == Precision::Double { double } else { self.single.factor(&matrix, precision)? };

        let b: Vec<Complex<f64>> = right_hand_side.iter().map(|&b| Complex::new(b, 0.0)).collect();
        let Values::Complex(values) = &matrix else { return None };
        let mut errors = Vec::new();
        let error = |z: &[Complex<f64>]| {
            let x: Vec<f64> = z.iter().map(|z| -shift * z.im).collect();
            relative_error(&x, &reference)
        };
        let mut z = vec![Complex::default(); n];
        for _ in 0..=STEPS {
            correct(self.laplacian.pattern(), values, &b, &factor, &mut z);
            errors.push(error(&z));
        }
        let (z, steps) = refined(self.laplacian.pattern(), values, &b, &factor);
        errors.extend([steps as f64, error(&z)]);
        Some(errors)
    }
}

/// Solves a complex system by a factor that may be in single precision, and refines until what is left is expected to be below
/// [`TOLERANCE`]: corrections shrink by about the same factor every time. Returns the solution and the number of steps.
pub(crate) fn refined(
    pattern: &SparsityPattern,
    values: &[Complex<f64>],
    b: &[Complex<f64>],
    factor: &Factor,
) -> (Vec<Complex<f64>>, usize) {
    const MOST_STEPS: usize = 20;
    let mut z = vec![Complex::default(); b.len()];
    let imaginary = |z: &[Complex<f64>]| norm(&z.iter().map(|z| z.im).collect::<Vec<f64>>());
    // Both parts of a correction count: what is wrong with one goes over to the other.
    let size = |z: &[Complex<f64>]| norm(&z.iter().flat_map(|z| [z.re, z.im]).collect::<Vec<f64>>());
    let mut previous = size(&correct(pattern, values, b, factor, &mut z));
    for step in 1..=MOST_STEPS {
        let correction = size(&correct(pattern, values, b, factor, &mut z));
        if correction * (correction / previous) <= TOLERANCE * imaginary(&z) {
            return (z, step);
        }
        previous = correction;
    }
    (z, MOST_STEPS)
}

/// Adds to z what the factor makes of the residual, and returns it.
fn correct(
    pattern: &SparsityPattern,
    values: &[Complex<f64>],
    b: &[Complex<f64>],
    factor: &Factor,
    z: &mut [Complex<f64>],
) -> Vec<Complex<f64>> {
    let mut start = 0;
    let residual = (0..b.len()).map(|j| {
        // Symmetric, so columns are rows.
        let rows = pattern.lane(j);
        let entries = rows.iter().zip(&values[start..start + rows.len()]);
        start += rows.len();
        b[j] - entries.map(|(&i, value)| value * z[i]).sum::<Complex<f64>>()
    });
    let residual = Values::Complex(residual.collect());
    let Values::Complex(correction) = factor.solve(&residual) else { return Vec::new() };
    z.iter_mut().zip(&correction).for_each(|(z, d)| *z += d);
    correction
}

/// Solves by a factor, with residuals and solution in twice the precision, until nothing changes; not a number where that does
/// not come about.
fn reference(n: usize, residual: impl Fn(&[Extended]) -> Vec<f64>, solve: impl Fn(Vec<f64>) -> Vec<f64>) -> Vec<f64> {
    let mut x = vec![Extended::default(); n];
    for _ in 0..100 {
        let correction = solve(residual(&x));
        x.iter_mut().zip(&correction).for_each(|(x, &d)| *x += Extended::from(d));
        let rounded: Vec<f64> = x.iter().map(|x| x.rounded()).collect();
        if norm(&correction) <= 1e-18 * norm(&rounded) {
            return rounded;
        }
    }
    vec![f64::NAN; n]
}

/// A x for a symmetric A.
fn extended_product(matrix: &CscMatrix<f64>, x: &[Extended]) -> Vec<Extended> {
    let column = |column: nalgebra_sparse::csc::CscCol<'_, f64>| {
        let entries = column.row_indices().iter().zip(column.values());
        entries.fold(Extended::default(), |sum, (&row, &value)| sum + x[row].times(value))
    };
    matrix.col_iter().map(column).collect()
}

fn relative_error(x: &[f64], reference: &[f64]) -> f64 {
    let difference: Vec<f64> = x.iter().zip(reference).map(|(x, r)| x - r).collect();
    norm(&difference) / norm(reference)
}
