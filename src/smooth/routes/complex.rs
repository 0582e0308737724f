//! The complex routes: L² + εI = (L + i√ε)(L − i√ε), with one complex solve on the pattern of L where the real route needs
//! the pattern of LᵀL, and with the condition number of L instead of its square.
//!
//! With D = √ε·B for a diagonal B, and W = B⁻¹, partial fractions give (LWL + εB)⁻¹ εBf = −Im((L + iD)⁻¹ D f). Where the
//! product does not hold, for eq. (5), (L + iD)(L − iD) is still an excellent preconditioner.

use nalgebra::Complex;
use nalgebra_sparse::CscMatrix;

use super::factors::{Factor, Factors};
use super::iterative;
use super::refine::{Iterate, Refinement, refine};
use super::task::{Answer, Task};
use crate::error::SolveError;
use crate::smooth::Precision;
use crate::smooth::names::Route;
use crate::smooth::schedule::Stages;
use crate::solve::{CholeskyAnalysis, Preconditioner, Twofold, transposed_product, transposed_product_twofold};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// The analysis of L, and the last factor of L + iD. A family of all ε will take one factor after the other from the same analysis,
/// each with a key of its own.
pub(super) type ComplexFactors = Factors<Complex<f64>, Complex<f32>>;

type ComplexFactor = Factor<Complex<f64>, Complex<f32>>;

/// Analyses the pattern of L.
pub(super) fn analyse(task: &Task<'_>, watch: &Watch<'_>) -> Result<ComplexFactors, SolveError> {
    memory::ensure((2 * size_of::<usize>() * task.problem.matrix.nnz()) as u64)?;
    Ok(Factors::new(CholeskyAnalysis::new(task.problem.matrix.pattern().clone(), watch)?))
}

/// Solves with the factor itself where the system is a product, else by conjugate gradients.
pub(super) fn solve(
    factors: &mut ComplexFactors,
    task: &Task<'_>,
    precision: Precision,
    stages: &mut Stages<'_, '_>,
) -> Result<Answer, SolveError> {
    let shift = task.shift();
    let values = |_: &CholeskyAnalysis| shifted(task.problem.matrix, &shift);
    let factor = factors.take(task.key, precision, &values, stages)?;
    stages.begin(Phase::Solve, 0)?;
    let watch = stages.watch;
    if task.problem.is_product() {
        let iterates = product(task, &factor, &shift, precision, watch)?;
        return Ok(factors.answer(task.key, factor, iterates, Route::ComplexCholesky, None));
    }
    let pair = Pair { factor: &factor, size: shift.len() };
    let iterates = iterative::refined(task, &pair, watch)?;
    let eigenvalue = iterative::eigenvalue(task, &pair, watch)?;
    Ok(factors.answer(task.key, factor, iterates, Route::CgComplexCholesky, eigenvalue))
}

/// The values of L + iD.
fn shifted(laplacian: &CscMatrix<f64>, shift: &[f64]) -> Vec<Complex<f64>> {
    let mut values = Vec::with_capacity(laplacian.nnz());
    for (row, column, &value) in laplacian.triplet_iter() {
        values.push(Complex::new(value, if row == column { shift[row] } else { 0.0 }));
    }
    values
}

/// x = −Im z with (L + iD) z = D f, refined in complex numbers; z is kept as its real parts, then its imaginary parts.
fn product(
    task: &Task<'_>,
    factor: &ComplexFactor,
    shift: &[f64],
    precision: Precision,
    watch: &Watch<'_>,
) -> Result<Vec<Iterate>, SolveError> {
    let (laplacian, n) = (task.problem.matrix, shift.len());
    let residual = |c: usize, z: &[f64]| {
        let f: &[f64] = &task.right_hand_sides[c].field;
        if z.is_empty() {
            let mut rest: Vec<f64> = shift.iter().zip(f).map(|(d, f)| d * f).collect();
            rest.resize(2 * n, 0.0);
            return rest;
        }
        let (re, im) = z.split_at(n);
        let (real, imaginary) = (transposed_product(laplacian, re), transposed_product(laplacian, im));
        let mut rest = Vec::with_capacity(2 * n);
        for i in 0..n {
            rest.push(shift[i] * (f[i] + im[i]) - real[i]);
        }
        for i in 0..n {
            rest.push(-(imaginary[i] + shift[i] * re[i]));
        }
        rest
    };
    let precise = |c: usize, z: &[f64]| precise_residual(laplacian, shift, &task.right_hand_sides[c].field, z);
    let refinement = Refinement {
        count: task.right_hand_sides.len(),
        length: 2 * n,
        tolerance: task.tolerance(precision),
        // L is positive semi-definite, so |⟨z, (L + iD) z⟩| ≥ min D · ‖z‖².
        inverse_norm: shift.iter().copied().reduce(f64::min).map(f64::recip),
        start: None,
        ticks: task.problem.ticks(),
        residual: &residual,
        // A factor in single precision gives way to one in double.
        precise: if precision == Precision::Double { Some(&precise) } else { None },
        solve: &mut |residuals, _| {
            let mut b = Vec::with_capacity(residuals.len() / 2);
            for r in residuals.chunks_exact(2 * n) {
                for i in 0..n {
                    b.push(Complex::new(r[i], r[n + i]));
                }
            }
            let solved = factor.solve(&b, watch)?;
            let mut planar = vec![0.0; residuals.len()];
            for (c, z) in solved.chunks_exact(n).enumerate() {
                for i in 0..n {
                    planar[2 * c * n + i] = z[i].re;
                    planar[(2 * c + 1) * n + i] = z[i].im;
                }
            }
            Ok(planar)
        },
    };
    let mut iterates = refine(refinement, watch)?;
    for iterate in &mut iterates {
        iterate.x = iterate.x[n..].iter().map(|im| -im).collect();
    }
    Ok(iterates)
}

/// D f − (L + iD) z, its real parts and then its imaginary ones, with sums in twice the precision.
fn precise_residual(laplacian: &CscMatrix<f64>, shift: &[f64], f: &[f64], z: &[f64]) -> Vec<f64> {
    let (re, im) = z.split_at(shift.len());
    let image = |part: &[f64]| {
        let wide: Vec<Twofold> = part.iter().map(|&x| x.into()).collect();
        // L is symmetric, and the product with the transpose gathers, which is faster.
        transposed_product_twofold(laplacian, &wide)
    };
    let real = image(re).into_iter().enumerate();
    let imaginary = image(im).into_iter().enumerate();
    let mut rest: Vec<f64> =
        real.map(|(i, l)| Twofold::difference(f[i], -im[i]).times(shift[i]).minus(l).value()).collect();
    rest.extend(imaginary.map(|(i, l)| -Twofold::from(re[i]).times(shift[i]).plus(l).value()));
    rest
}

/// The real part of ((L + iD)(L − iD))⁻¹, which is symmetric positive definite as the product is Hermitian so.
struct Pair<'a> {
    factor: &'a ComplexFactor,
    size: usize,
}

impl Preconditioner for Pair<'_> {
    fn size(&self) -> usize {
        self.size
    }

    fn apply(&self, r: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        let r: Vec<Complex<f64>> = r.iter().map(|&r| Complex::new(r, 0.0)).collect();
        // (L − iD)⁻¹ y is the conjugate of (L + iD)⁻¹ applied to the conjugate of y.
        let conjugate: Vec<Complex<f64>> = self.factor.solve(&r, watch)?.iter().map(|y| y.conj()).collect();
        Ok(self.factor.solve(&conjugate, watch)?.iter().map(|z| z.re).collect())
    }
}
