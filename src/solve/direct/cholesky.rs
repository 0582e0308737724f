//! The direct solver: order and analyse a pattern once, factorise it for any values, solve for any right-hand sides.

use std::sync::Arc;

use nalgebra_sparse::pattern::SparsityPattern;

use super::front::Stopped;
use super::multifrontal::{ScaledMatrix, Workspace, factorization_ticks, reserve, reserve_fronts, storage};
use super::scalar::{LaneBlock, Scalar};
use super::symbolic::{FactorSize, Symbolic};
use super::triangular::{solve_block, solve_one};
use crate::error::{Cancelled, SolveError};
use crate::solve::matrix::ADDRESS_SPACE;
use crate::solve::ordering::{Permutation, nested_dissection};
use crate::support::memory;
use crate::support::watch::Plan;
use crate::{Phase, Watch};

/// The ordering and symbolic analysis of a symmetric pattern. Cheap to clone.
#[derive(Debug, Clone)]
pub struct CholeskyAnalysis {
    shared: Arc<Analysis>,
}

#[derive(Debug)]
struct Analysis {
    pattern: SparsityPattern,
    symbolic: Symbolic,
}

impl CholeskyAnalysis {
    /// Orders the unknowns by [`nested_dissection`] and analyses the pattern of a symmetric matrix, both triangles stored.
    ///
    /// # Errors
    /// `DimensionMismatch` where the pattern is not square; `NotSymmetric`; `Cancelled`; `OutOfMemory`.
    pub fn new(pattern: SparsityPattern, watch: &Watch<'_>) -> Result<Self, SolveError> {
        check_symmetric(&pattern)?;
        let mut plan = watch.plan(&[(Phase::Analysis, ORDERING_SHARE), (Phase::Analysis, 1.0 - ORDERING_SHARE)]);
        plan.begin(ordering_ticks(&pattern))?;
        let permutation = Permutation::from_valid(nested_dissection(&pattern, watch)?);
        plan.begin(symbolic_ticks(&pattern))?;
        let analysis = Self::analyze(pattern, &permutation, watch)?;
        plan.finish()?;
        Ok(analysis)
    }

    /// As [`CholeskyAnalysis::new`], with an ordering of the caller's. The order of elimination is an equivalent one, with
    /// the same entries in the factor.
    ///
    /// # Errors
    /// As [`CholeskyAnalysis::new`]; `DimensionMismatch` where the permutation has another size.
    pub fn with_permutation(
        pattern: SparsityPattern,
        permutation: &Permutation,
        watch: &Watch<'_>,
    ) -> Result<Self, SolveError> {
        check_symmetric(&pattern)?;
        let (expected, actual) = (pattern.major_dim(), permutation.new_to_old().len());
        if expected != actual {
            return Err(SolveError::DimensionMismatch { expected, actual });
        }
        let mut plan = watch.plan(&[(Phase::Analysis, 1.0)]);
        plan.begin(symbolic_ticks(&pattern))?;
        let analysis = Self::analyze(pattern, permutation, watch)?;
        plan.finish()?;
        Ok(analysis)
    }

    fn analyze(pattern: SparsityPattern, permutation: &Permutation, watch: &Watch<'_>) -> Result<Self, SolveError> {
        let symbolic = Symbolic::new(&pattern, permutation, watch)?;
        Ok(Self { shared: Arc::new(Analysis { pattern, symbolic }) })
    }

    /// Number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.shared.pattern.major_dim()
    }

    /// The pattern analysed.
    #[must_use]
    pub fn pattern(&self) -> &SparsityPattern {
        &self.shared.pattern
    }

    /// About how long a factorisation takes, in ticks.
    pub(crate) fn ticks<T: Scalar>(&self) -> u64 {
        factorization_ticks::<T::Block>(&self.shared.symbolic)
    }

    /// What the factor holds.
    #[must_use]
    pub fn size(&self) -> FactorSize {
        self.shared.symbolic.size
    }

    /// Bytes that a factor of this type and its computation take.
    #[must_use]
    pub fn memory<T: Scalar>(&self) -> u64 {
        let (factor, stack) = storage::<T::Block>(&self.shared.symbolic);
        factor.saturating_add(stack).saturating_mul(size_of::<T::Block>() as u64)
    }

    /// Factorises the matrix with the analysed pattern and the given values, in the order of the pattern: A = L Lᵀ up to
    /// the ordering, for complex values too (the transpose, without conjugation).
    ///
    /// Real matrices must be positive definite; complex ones symmetric with a real part that is positive semi-definite. Only
    /// one triangle is read: that the values are symmetric is for the caller to know.
    ///
    /// # Errors
    /// `PatternMismatch`, `NonFiniteEntry`, `NotPositiveDefinite` with the column, `Cancelled`, and `OutOfMemory` with the
    /// number of bytes, before anything is computed.
    pub fn factor<T: Scalar>(&self, values: &[T::Wide], watch: &Watch<'_>) -> Result<CholeskyFactor<T>, SolveError> {
        self.factored(values, false, watch)
    }

    /// Factorises as [`CholeskyAnalysis::factor`], but raises pivots that are no more than rounding to the least that are more: the factor
    /// of a matrix nearby, with more on its diagonal, for iterations to be preconditioned by.
    ///
    /// # Errors
    /// Those of [`CholeskyAnalysis::factor`]; `NotPositiveDefinite` where raising a pivot is of no use.
    pub(crate) fn factor_raised(&self, values: &[f64], watch: &Watch<'_>) -> Result<CholeskyFactor<f64>, SolveError> {
        self.factored(values, true, watch)
    }

    fn factored<T: Scalar>(
        &self,
        values: &[T::Wide],
        raises: bool,
        watch: &Watch<'_>,
    ) -> Result<CholeskyFactor<T>, SolveError> {
        self.check::<T>(values)?;
        let mut plan = watch.plan(&[(Phase::Factorization, 1.0)]);
        plan.begin(self.ticks::<T>())?;
        let mut factor = self.allocate::<T>(watch).map_err(|error| match error {
            // All that is needed is told, not the piece that could not be had.
            SolveError::OutOfMemory { .. } => SolveError::OutOfMemory { bytes: self.memory::<T>() },
            other => other,
        })?;
        factor.compute(values, raises, plan, watch)?;
        Ok(factor)
    }

    /// Room for a factor and its computation.
    fn allocate<T: Scalar>(&self, watch: &Watch<'_>) -> Result<CholeskyFactor<T>, SolveError> {
        let symbolic = &self.shared.symbolic;
        // What cannot fit must not be tried: WebAssembly never gives memory back.
        if self.memory::<T>() > ADDRESS_SPACE {
            return Err(SolveError::OutOfMemory { bytes: self.memory::<T>() });
        }
        // The largest block first.
        let workspace = Workspace::new(symbolic, storage::<T::Block>(symbolic).1, watch)?;
        let fronts = reserve_fronts(symbolic, watch)?;
        // Vectors that will be needed beside the factor must find room too.
        drop(reserve::<u8>(HEADROOM * self.unknowns() as u64)?);
        Ok(CholeskyFactor { analysis: self.clone(), fronts, workspace, scale: 1.0, state: State::Stopped })
    }

    fn check<T: Scalar>(&self, values: &[T::Wide]) -> Result<(), SolveError> {
        if values.len() != self.shared.pattern.nnz() {
            return Err(SolveError::PatternMismatch {});
        }
        if let Some(place) = values.iter().position(|&value| !T::is_finite(value)) {
            let row = self.shared.pattern.major_offsets().partition_point(|&start| start <= place) - 1;
            return Err(SolveError::NonFiniteEntry { row });
        }
        Ok(())
    }
}

/// The part of an analysis that finding the order takes.
const ORDERING_SHARE: f64 = 0.85;
/// A value that is put in the order of elimination, and its solution back.
const TICKS_PER_UNKNOWN: u64 = 10;

/// What [`nested_dissection`] is expected to take: all entries are looked at on each level of dissection.
fn ordering_ticks(pattern: &SparsityPattern) -> u64 {
    let unknowns = pattern.major_dim() as u64;
    (320 * unknowns + 9 * pattern.nnz() as u64) * u64::from((unknowns / 64).max(2).ilog2())
}

/// What the symbolic analysis is expected to take.
fn symbolic_ticks(pattern: &SparsityPattern) -> u64 {
    400 * pattern.major_dim() as u64 + 30 * pattern.nnz() as u64
}

/// Bytes per unknown that must be left beside a factor, for a few dozen vectors.
const HEADROOM: u64 = 512;

/// A numeric factor.
#[derive(Debug, Clone)]
pub struct CholeskyFactor<T: Scalar> {
    analysis: CholeskyAnalysis,
    /// Every front's part of the factor.
    fronts: Vec<Vec<T::Block>>,
    workspace: Workspace<T::Block>,
    /// The matrix was multiplied by this, to be within the range of single precision.
    scale: f64,
    state: State,
}

/// How far a factorisation has come.
#[derive(Debug, Clone, Copy)]
enum State {
    Done,
    /// It failed at this column.
    Failed(usize),
    /// It was stopped before its end.
    Stopped,
}

impl<T: Scalar> CholeskyFactor<T> {
    /// Factorises other values on the same pattern, in the memory of this factor.
    ///
    /// # Errors
    /// `PatternMismatch`, `NonFiniteEntry`, `NotPositiveDefinite` with the column, `Cancelled`; after the last two, solving
    /// gives the same error until the next factorisation.
    pub fn refactor(&mut self, values: &[T::Wide], watch: &Watch<'_>) -> Result<(), SolveError> {
        self.analysis.check::<T>(values)?;
        self.state = State::Stopped;
        let mut plan = watch.plan(&[(Phase::Factorization, 1.0)]);
        plan.begin(self.analysis.ticks::<T>())?;
        self.compute(values, false, plan, watch)
    }

    /// Computes what `plan` has begun.
    fn compute(
        &mut self,
        values: &[T::Wide],
        raises: bool,
        plan: Plan<'_, '_>,
        watch: &Watch<'_>,
    ) -> Result<(), SolveError> {
        let Analysis { pattern, symbolic } = &*self.analysis.shared;
        [self.scale, _] = scales::<T>(values);
        let matrix = ScaledMatrix { pattern, values, scale: self.scale };
        match self.workspace.factorize(symbolic, &matrix, &mut self.fronts, raises, watch) {
            Ok(()) => {
                plan.finish()?;
                self.state = State::Done;
            }
            Err(Stopped::At(place)) => self.state = State::Failed(symbolic.permutation.new_to_old()[place] as usize),
            Err(Stopped::Cancelled(cancelled)) => return Err(cancelled.into()),
        }
        self.check_done()
    }

    /// Fails where there is no factor, with what the factorisation failed with.
    fn check_done(&self) -> Result<(), SolveError> {
        match self.state {
            State::Done => Ok(()),
            State::Failed(column) => Err(SolveError::NotPositiveDefinite { column }),
            State::Stopped => Err(SolveError::Cancelled {}),
        }
    }

    /// Solves A X = B for right-hand sides stored one after the other.
    ///
    /// # Errors
    /// `DimensionMismatch` where the length is no multiple of the number of unknowns; `NonFiniteEntry`; `Cancelled`, and
    /// `OutOfMemory`.
    pub fn solve(&self, right_hand_sides: &[T::Wide], watch: &Watch<'_>) -> Result<Vec<T::Wide>, SolveError> {
        let n = self.analysis.unknowns();
        if right_hand_sides.is_empty() && n == 0 {
            return Ok(Vec::new());
        }
        if n == 0 || !right_hand_sides.len().is_multiple_of(n) {
            return Err(SolveError::DimensionMismatch { expected: n, actual: right_hand_sides.len() });
        }
        if let Some(place) = right_hand_sides.iter().position(|&value| !T::is_finite(value)) {
            return Err(SolveError::NonFiniteEntry { row: place % n });
        }
        self.check_done()?;
        // The solutions, the right-hand sides at hand in the order of elimination, and sums for the columns of a front.
        let symbolic = &self.analysis.shared.symbolic;
        let widest = (0..symbolic.fronts()).map(|s| symbolic.columns(s).len()).max().unwrap_or(0);
        let few = right_hand_sides.len() / n <= T::Block::LANES / 4;
        let each = if few { size_of::<T>() } else { size_of::<T::Block>() };
        let bytes = size_of_val(right_hand_sides) + each * n + size_of::<T::Block>() * (widest + T::Block::LANES);
        memory::ensure(bytes as u64)?;
        let mut solutions = vec![T::Wide::default(); right_hand_sides.len()];
        let block = n * T::Block::LANES;
        for (b, x) in right_hand_sides.chunks(block).zip(solutions.chunks_mut(block)) {
            // A block costs as much as a few single solves, however many of its lanes are used.
            if b.len() / n <= T::Block::LANES / 4 {
                for (b, x) in b.chunks_exact(n).zip(x.chunks_exact_mut(n)) {
                    self.solve_one(b, x, watch)?;
                }
            } else {
                self.solve_block(b, x, watch)?;
            }
        }
        Ok(solutions)
    }

    fn solve_one(&self, b: &[T::Wide], x: &mut [T::Wide], watch: &Watch<'_>) -> Result<(), Cancelled> {
        let symbolic = &self.analysis.shared.symbolic;
        let new_to_old = symbolic.permutation.new_to_old();
        let [shrink, grow] = scales::<T>(b);
        let mut permuted: Vec<T> =
            new_to_old.iter().map(|&old| T::narrow(T::scaled(b[old as usize], shrink))).collect();
        solve_one(symbolic, &self.fronts, &mut permuted, watch)?;
        for (value, &old) in permuted.iter().zip(new_to_old) {
            x[old as usize] = T::scaled(value.wide(), grow * self.scale);
        }
        watch.tick(TICKS_PER_UNKNOWN * b.len() as u64)
    }

    fn solve_block(&self, b: &[T::Wide], x: &mut [T::Wide], watch: &Watch<'_>) -> Result<(), Cancelled> {
        let symbolic = &self.analysis.shared.symbolic;
        let new_to_old = symbolic.permutation.new_to_old();
        let n = new_to_old.len();
        let mut permuted = vec![T::Block::ZERO; n];
        for (lane, b) in b.chunks_exact(n).enumerate() {
            let [shrink, _] = scales::<T>(b);
            for (block, &old) in permuted.iter_mut().zip(new_to_old) {
                block.set_lane(lane, T::narrow(T::scaled(b[old as usize], shrink)));
            }
        }
        solve_block(symbolic, &self.fronts, &mut permuted, watch)?;
        for (lane, (b, x)) in b.chunks_exact(n).zip(x.chunks_exact_mut(n)).enumerate() {
            let [_, grow] = scales::<T>(b);
            for (block, &old) in permuted.iter().zip(new_to_old) {
                x[old as usize] = T::scaled(block.lane(lane).wide(), grow * self.scale);
            }
        }
        watch.tick(TICKS_PER_UNKNOWN * b.len() as u64)
    }

    /// The analysis this factor was made with.
    #[must_use]
    pub fn analysis(&self) -> &CholeskyAnalysis {
        &self.analysis
    }
}

/// What brings numbers to about 1 and back: single precision has a small range.
fn scales<T: Scalar>(b: &[T::Wide]) -> [f64; 2] {
    if !T::SINGLE {
        return [1.0, 1.0];
    }
    let largest = b.iter().fold(0.0, |largest: f64, &value| largest.max(T::magnitude(value)));
    if largest >= f64::MIN_POSITIVE { [largest.recip(), largest] } else { [1.0, 1.0] }
}

fn check_symmetric(pattern: &SparsityPattern) -> Result<(), SolveError> {
    let (expected, actual) = (pattern.major_dim(), pattern.minor_dim());
    if expected != actual {
        return Err(SolveError::DimensionMismatch { expected, actual });
    }
    memory::ensure((size_of::<usize>() * expected) as u64)?;
    // Reading the columns in order meets the entries of every row in order too: one step in each row's own list.
    let mut next = pattern.major_offsets()[..expected].to_vec();
    let (offsets, indices) = (pattern.major_offsets(), pattern.minor_indices());
    for column in 0..expected {
        for &row in pattern.lane(column) {
            let place = next[row];
            if place == offsets[row + 1] || indices[place] != column {
                return Err(one_sided(pattern));
            }
            next[row] = place + 1;
        }
    }
    Ok(())
}

/// The first entry without a mirror image.
fn one_sided(pattern: &SparsityPattern) -> SolveError {
    let missing = (0..pattern.major_dim()).find_map(|column| {
        let row = pattern.lane(column).iter().find(|&&row| pattern.lane(row).binary_search(&column).is_err());
        row.map(|&row| SolveError::NotSymmetric { row, column })
    });
    missing.unwrap_or(SolveError::PatternMismatch {})
}
