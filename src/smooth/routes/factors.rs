//! Factors that are kept from one call to the next.

use super::refine::Iterate;
use super::task::{Answer, FactorKey};
use crate::error::SolveError;
use crate::smooth::Precision;
use crate::smooth::names::{Route, UsedPrecision};
use crate::smooth::schedule::Stages;
use crate::solve::{CholeskyAnalysis, CholeskyFactor, Scalar};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// A factor in double or single precision.
#[derive(Debug)]
pub(super) enum Factor<D: Scalar, S: Scalar<Wide = D::Wide>> {
    Double(CholeskyFactor<D>),
    Single(CholeskyFactor<S>),
}

impl<D: Scalar, S: Scalar<Wide = D::Wide>> Factor<D, S> {
    pub(super) fn solve(&self, right_hand_sides: &[D::Wide], watch: &Watch<'_>) -> Result<Vec<D::Wide>, SolveError> {
        match self {
            Self::Double(factor) => factor.solve(right_hand_sides, watch),
            Self::Single(factor) => factor.solve(right_hand_sides, watch),
        }
    }

    fn precision(&self) -> Precision {
        match self {
            Self::Double(_) => Precision::Double,
            Self::Single(_) => Precision::Single,
        }
    }
}

/// An analysis and the last factor made with it.
#[derive(Debug)]
pub(super) struct Factors<D: Scalar, S: Scalar<Wide = D::Wide>> {
    analysis: CholeskyAnalysis,
    last: Option<(FactorKey, Factor<D, S>)>,
    /// Whether pivots of the last factor may have been raised: then it only preconditions.
    is_raised: bool,
}

impl<D: Scalar, S: Scalar<Wide = D::Wide>> Factors<D, S> {
    pub(super) fn new(analysis: CholeskyAnalysis) -> Self {
        Self { analysis, last: None, is_raised: false }
    }

    /// Takes the factor of the matrix with these values: the last one if it has the same key, or a new one, in its memory
    /// if it has the same precision. [`Factors::answer`] puts it back.
    pub(super) fn take(
        &mut self,
        key: &FactorKey,
        precision: Precision,
        values: &dyn Fn(&CholeskyAnalysis) -> Vec<D::Wide>,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Factor<D, S>, SolveError> {
        let is_raised = core::mem::take(&mut self.is_raised);
        let last = match self.last.take() {
            Some((known, factor)) if known == *key && factor.precision() == precision && !is_raised => {
                return Ok(factor);
            }
            last => last,
        };
        stages.begin(Phase::Factorization, 0)?;
        let watch = stages.watch;
        memory::ensure((size_of::<D::Wide>() * self.analysis.pattern().nnz()) as u64)?;
        let values = values(&self.analysis);
        Ok(match (last, precision) {
            (Some((_, Factor::Double(mut factor))), Precision::Double) => {
                factor.refactor(&values, watch)?;
                Factor::Double(factor)
            }
            (Some((_, Factor::Single(mut factor))), Precision::Single) => {
                factor.refactor(&values, watch)?;
                Factor::Single(factor)
            }
            (other, _) => {
                // Its memory is needed for the new one.
                drop(other);
                match precision {
                    Precision::Double => Factor::Double(self.analysis.factor(&values, watch)?),
                    Precision::Single => Factor::Single(self.analysis.factor(&values, watch)?),
                }
            }
        })
    }

    /// Keeps a factor that proved good, and says where the solutions come from.
    pub(super) fn answer(
        &mut self,
        key: &FactorKey,
        factor: Factor<D, S>,
        iterates: Vec<Iterate>,
        route: Route,
        smallest_eigenvalue: Option<f64>,
    ) -> Answer {
        let precision = match factor.precision() {
            Precision::Single => UsedPrecision::Single,
            Precision::Double => UsedPrecision::Double,
        };
        self.keep(key, factor);
        Answer { iterates, route, precision, factor_nonzeros: self.analysis.size().nonzeros, smallest_eigenvalue }
    }

    /// Keeps a factor for the next call.
    pub(super) fn keep(&mut self, key: &FactorKey, factor: Factor<D, S>) {
        self.last = Some((key.clone(), factor));
    }

    /// About how long a factorisation in double or single precision takes, in ticks.
    pub(super) fn ticks(&self, single: bool) -> u64 {
        if single { self.analysis.ticks::<S>() } else { self.analysis.ticks::<D>() }
    }

    pub(super) fn analysis(&self) -> &CholeskyAnalysis {
        &self.analysis
    }

    /// Gives away the last factor, if it is one in double precision; any other is dropped.
    pub(super) fn take_double(&mut self) -> Option<CholeskyFactor<D>> {
        self.is_raised = false;
        match self.last.take() {
            Some((_, Factor::Double(factor))) => Some(factor),
            _ => None,
        }
    }

    /// Whether the last factor has this key, and is that of the matrix itself.
    pub(super) fn has(&self, key: &FactorKey) -> bool {
        !self.is_raised && self.last.as_ref().is_some_and(|(known, _)| known == key)
    }

    /// Gives the memory of the last factor back.
    pub(super) fn drop_factor(&mut self) {
        self.last = None;
        self.is_raised = false;
    }
}

impl Factors<f64, f32> {
    /// Takes a factor whose lost pivots are raised: the last one if it has the same key, or a new one. [`Factors::answer_raised`] puts it
    /// back.
    pub(super) fn take_raised(
        &mut self,
        key: &FactorKey,
        values: &dyn Fn(&CholeskyAnalysis) -> Vec<f64>,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Factor<f64, f32>, SolveError> {
        let is_raised = core::mem::take(&mut self.is_raised);
        match self.last.take() {
            Some((known, factor)) if known == *key && is_raised => Ok(factor),
            last => {
                // Its memory is needed for the new one.
                drop(last);
                stages.begin(Phase::Factorization, 0)?;
                memory::ensure((size_of::<f64>() * self.analysis.pattern().nnz()) as u64)?;
                Ok(Factor::Double(self.analysis.factor_raised(&values(&self.analysis), stages.watch)?))
            }
        }
    }

    /// As [`Factors::answer`], of a factor with lost pivots raised.
    pub(super) fn answer_raised(
        &mut self,
        key: &FactorKey,
        factor: Factor<f64, f32>,
        iterates: Vec<Iterate>,
        smallest_eigenvalue: Option<f64>,
    ) -> Answer {
        let answer = self.answer(key, factor, iterates, Route::CgCholesky, smallest_eigenvalue);
        self.is_raised = true;
        answer
    }
}
