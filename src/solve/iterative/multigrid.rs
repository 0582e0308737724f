//! Algebraic multigrid.

use nalgebra_sparse::CscMatrix;

use super::aggregation::prolongation;
use super::cg::{Limits, descend};
use super::elimination::Elimination;

use super::preconditioner::Preconditioner;
use super::rows::{Rows, SymmetricRows};
use crate::error::{Cancelled, SolveError};
use crate::solve::matrix::norm;
use crate::support::memory;
use crate::{Phase, Watch};

/// This many unknowns are solved for directly, in less time than another level would take.
const COARSEST: usize = 120;
/// Aggregation that leaves more than this fraction of the unknowns is not worth another level.
const STALLED: f64 = 0.8;
/// Pivots below this fraction of the diagonal are rounding of zeros.
const ROUNDING: f64 = 1e-14;

/// An entry of a level's matrix or prolongation in one sweep.
const TICKS_PER_ENTRY: u64 = 5;
/// What the set-up takes for each entry of the matrix, and for each unknown.
const BYTES_PER_ENTRY: usize = 90;
const BYTES_PER_UNKNOWN: usize = 150;

/// What the set-up is expected to take.
pub(super) fn setup_ticks(matrix: &CscMatrix<f64>) -> u64 {
    400 * matrix.nnz() as u64
}

/// One symmetric V-cycle of smoothed aggregation multigrid \[Vanek96\]: set-up, memory and application take time
/// proportional to the entries of the matrix, and the iterations of conjugate gradients hardly grow with its size.
///
/// # Definition
/// Unknowns at the obtuse corners of needle triangles are eliminated first, exactly. Levels: aggregates of strongly coupled
/// unknowns, prolongation from their indicators smoothed by one Jacobi step, coarse matrix PᵀAP. Smoother: Gauss–Seidel, forward before and backward after the coarse correction \[Adams03\]. On the
/// coarsest level: dense Cholesky.
///
/// # Properties
/// Symmetric, and positive definite for every symmetric positive definite A, because Gauss–Seidel converges for it. Meant
/// for discrete Laplacians, with rows and columns removed or a diagonal added, whose smooth errors are near constants.
#[derive(Debug, Clone)]
pub struct Multigrid {
    elimination: Elimination,
    size: usize,
    levels: Vec<Level>,
    coarsest: DenseCholesky,
}

#[derive(Debug, Clone)]
struct Level {
    matrix: SymmetricRows,
    /// Reciprocals of the diagonal.
    inverse: Vec<f64>,
    /// From the next level.
    prolongation: Rows,
}

impl Multigrid {
    /// For a symmetric matrix that stores both triangles.
    ///
    /// # Errors
    /// `DimensionMismatch` where it is not square; `NotSymmetric`, by the pattern; `NonFiniteEntry`; `NotPositiveDefinite`
    /// where a diagonal entry, of a coarse level too, or a pivot on the coarsest is not positive; `Cancelled`; `OutOfMemory`,
    /// also past 2³² entries.
    pub fn new(matrix: &CscMatrix<f64>, watch: &Watch<'_>) -> Result<Self, SolveError> {
        let mut plan = watch.plan(&[(Phase::Analysis, 1.0)]);
        plan.begin(setup_ticks(matrix))?;
        let multigrid = Self::from_rows(SymmetricRows::new(matrix, watch)?, watch)?;
        plan.finish()?;
        Ok(multigrid)
    }

    pub(super) fn from_rows(matrix: SymmetricRows, watch: &Watch<'_>) -> Result<Self, SolveError> {
        let size = matrix.size();
        memory::ensure((BYTES_PER_ENTRY * matrix.rows.values.len() + BYTES_PER_UNKNOWN * size) as u64)?;
        let (elimination, matrix) = Elimination::new(matrix, watch)?;
        let (levels, coarsest) = hierarchy(matrix, watch).map_err(|error| elimination.name_unknown(error))?;
        Ok(Self { elimination, size, levels, coarsest })
    }

    /// Number of levels, the finest and the coarsest included.
    #[must_use]
    pub fn levels(&self) -> usize {
        self.levels.len() + 1
    }

    /// Entries of the matrices of all levels over those of the finest.
    #[must_use]
    pub fn complexity(&self) -> f64 {
        let entries = |level: &Level| level.matrix.rows.values.len() as f64;
        let all: f64 = self.levels.iter().map(entries).sum();
        all / self.levels.first().map_or(1.0, |level| entries(level).max(1.0))
    }

    /// x with A x = r to a relative residual of `tolerance`, of the system without what is eliminated.
    pub(super) fn solve(
        &self,
        mut r: Vec<f64>,
        tolerance: f64,
        most: usize,
        watch: &Watch<'_>,
    ) -> Result<Vec<f64>, SolveError> {
        let mut residual = self.elimination.forward(&mut r);
        let mut x = vec![0.0; residual.len()];
        let target = tolerance * norm(&residual);
        descend(
            &mut |x| self.product(x),
            &Reduced(self),
            &mut residual,
            &mut x,
            target,
            Limits { most, patience: most },
            watch,
        )?;
        self.elimination.backward(&x, &mut r);
        Ok(r)
    }

    fn product(&self, x: &[f64]) -> Vec<f64> {
        self.levels.first().map_or_else(Vec::new, |level| level.matrix.product(x))
    }

    fn cycle(&self, depth: usize, r: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, Cancelled> {
        let level = self.levels.get(depth).filter(|level| !level.prolongation.offsets.is_empty());
        let Some(level) = level else {
            watch.tick((r.len() * r.len()) as u64)?;
            return Ok(self.coarsest.solve(r));
        };
        let sweep = TICKS_PER_ENTRY * (level.matrix.rows.values.len() + level.prolongation.values.len()) as u64;
        watch.tick(sweep)?;
        let (mut x, coarse) = level.descend(r);
        if !coarse.is_empty() {
            level.prolong(&self.cycle(depth + 1, &coarse, watch)?, &mut x);
        }
        watch.tick(sweep)?;
        level.ascend(r, &mut x);
        Ok(x)
    }
}

impl Preconditioner for Multigrid {
    fn size(&self) -> usize {
        self.size
    }

    fn apply(&self, r: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        let mut z = r.to_vec();
        let reduced = self.elimination.forward(&mut z);
        self.elimination.backward(&self.cycle(0, &reduced, watch)?, &mut z);
        Ok(z)
    }
}

/// The cycle on the unknowns that are not eliminated.
struct Reduced<'a>(&'a Multigrid);

impl Preconditioner for Reduced<'_> {
    fn size(&self) -> usize {
        self.0.elimination.kept.len()
    }

    fn apply(&self, r: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        Ok(self.0.cycle(0, r, watch)?)
    }
}

impl Level {
    fn new(matrix: SymmetricRows, prolongation: Rows) -> Self {
        let inverse = (0..matrix.size()).map(|i| 1.0 / matrix.diagonal(i)).collect();
        Self { matrix, inverse, prolongation }
    }

    /// A forward sweep from zero, and the residual after it on the next level. Entries left of the diagonal suffice for
    /// the sweep, those right of it for the residual: the sweep made the rest of it zero.
    #[inline(never)]
    fn descend(&self, r: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let matrix = &self.matrix;
        let mut x = vec![0.0; r.len()];
        for i in 0..r.len() {
            x[i] = (r[i] - matrix.rows.gather(matrix.lower(i), &x)) * self.inverse[i];
        }
        let mut coarse = vec![0.0; self.prolongation.width];
        for i in 0..r.len() {
            let residual = matrix.rows.gather(matrix.upper(i), &x);
            for (aggregate, weight) in self.prolongation.row(i) {
                coarse[aggregate] -= weight * residual;
            }
        }
        (x, coarse)
    }

    #[inline(never)]
    fn prolong(&self, coarse: &[f64], x: &mut [f64]) {
        for (i, x) in x.iter_mut().enumerate() {
            *x += self.prolongation.gather(self.prolongation.range(i), coarse);
        }
    }

    /// A backward sweep.
    #[inline(never)]
    fn ascend(&self, r: &[f64], x: &mut [f64]) {
        for i in (0..r.len()).rev() {
            x[i] += (r[i] - self.matrix.rows.gather(self.matrix.rows.range(i), x)) * self.inverse[i];
        }
    }
}

/// The levels from the finest on.
fn hierarchy(mut matrix: SymmetricRows, watch: &Watch<'_>) -> Result<(Vec<Level>, DenseCholesky), SolveError> {
    let mut levels: Vec<Level> = Vec::new();
    while matrix.size() > COARSEST {
        let prolongation = prolongation(&matrix, watch)?;
        if prolongation.width as f64 > STALLED * matrix.size() as f64 {
            break;
        }
        let coarse =
            galerkin(&matrix, &prolongation, watch).map_err(|error| name_unknown(error, &levels, &prolongation))?;
        levels.push(Level::new(core::mem::replace(&mut matrix, coarse), prolongation));
    }
    if matrix.size() > COARSEST {
        // Not coarsened any further: smoothed.
        let nothing = Rows { offsets: vec![0; matrix.size() + 1], ..Rows::default() };
        levels.push(Level::new(matrix, nothing));
        return Ok((levels, DenseCholesky::default()));
    }
    let coarsest = DenseCholesky::new(&matrix).map_err(|error| name_unknown(error, &levels, &Rows::default()))?;
    if levels.is_empty() {
        // The product with the matrix is asked for as well.
        levels.push(Level::new(matrix, Rows::default()));
    }
    Ok((levels, coarsest))
}

/// PᵀAP, its columns sorted.
fn galerkin(matrix: &SymmetricRows, prolongation: &Rows, watch: &Watch<'_>) -> Result<SymmetricRows, SolveError> {
    let product = prolongation.transposed(watch)?.times(&matrix.rows.times(prolongation, watch)?, watch)?;
    // Symmetric but for rounding, so transposing does no more than sort.
    SymmetricRows::from_rows(product.transposed(watch)?)
}

/// Replaces a coarse unknown in an error by a fine one of its aggregate.
fn name_unknown(error: SolveError, levels: &[Level], last: &Rows) -> SolveError {
    let SolveError::NotPositiveDefinite { mut column } = error else { return error };
    for prolongation in core::iter::once(last).chain(levels.iter().rev().map(|level| &level.prolongation)) {
        let found = (0..prolongation.height()).find(|&i| {
            // The aggregate is the one of largest weight.
            let weight =
                |range: core::ops::Range<usize>| prolongation.values[range].iter().fold(0.0_f64, |a, &b| a.max(b));
            let most = weight(prolongation.range(i));
            prolongation.row(i).any(|(j, value)| j == column && value >= most)
        });
        column = found.unwrap_or(column);
    }
    SolveError::NotPositiveDefinite { column }
}

/// G of A = G Gᵀ by rows, packed, with the reciprocals of its diagonal.
#[derive(Debug, Clone, Default)]
struct DenseCholesky {
    factor: Vec<f64>,
    size: usize,
}

impl DenseCholesky {
    fn new(matrix: &SymmetricRows) -> Result<Self, SolveError> {
        let n = matrix.size();
        let start = |i: usize| i * (i + 1) / 2;
        let mut factor = vec![0.0; start(n)];
        for i in 0..n {
            for (j, value) in matrix.rows.row(i).take_while(|&(j, _)| j <= i) {
                factor[start(i) + j] = value;
            }
            for j in 0..=i {
                let (before, row) = factor.split_at_mut(start(i));
                if j < i {
                    let other = &before[start(j)..];
                    let sum: f64 = row[..j].iter().zip(other).map(|(a, b)| a * b).sum();
                    row[j] = (row[j] - sum) * other[j];
                } else {
                    let diagonal = row[i];
                    let pivot = diagonal - row[..i].iter().map(|a| a * a).sum::<f64>();
                    // Singular but for rounding: any small positive pivot keeps this definite, and conjugate gradients
                    // find out what the matrix is like there.
                    let least = ROUNDING * diagonal;
                    if !(pivot >= -least && diagonal.is_finite()) {
                        return Err(SolveError::NotPositiveDefinite { column: i });
                    }
                    row[i] = 1.0 / pivot.max(least).sqrt();
                }
            }
        }
        Ok(Self { factor, size: n })
    }

    fn solve(&self, r: &[f64]) -> Vec<f64> {
        let mut x = r.to_vec();
        let mut rest = &self.factor[..];
        for i in 0..self.size {
            let (row, after) = rest.split_at(i + 1);
            rest = after;
            let sum: f64 = row[..i].iter().zip(&x).map(|(a, b)| a * b).sum();
            x[i] = (x[i] - sum) * row[i];
        }
        let mut rest = &self.factor[..];
        for i in (0..self.size).rev() {
            let (before, row) = rest.split_at(rest.len() - i - 1);
            rest = before;
            x[i] *= row[i];
            let scale = x[i];
            x[..i].iter_mut().zip(row).for_each(|(x, a)| *x -= a * scale);
        }
        x
    }
}
