//! Factors that are kept from one call to the next.

use super::refine::Iterate;
use super::{Answer, Key};
use crate::Watch;
use crate::error::SolveError;
use crate::smooth::{Phase, Precision, Progress};
use crate::solve::{CholeskyAnalysis, CholeskyFactor, Scalar};

/// A factor in double or single precision.
#[derive(Debug)]
pub(super) enum Factor<D: Scalar, S: Scalar<Wide = D::Wide>> {
    Double(CholeskyFactor<D>),
    Single(CholeskyFactor<S>),
}

impl<D: Scalar, S: Scalar<Wide = D::Wide>> Factor<D, S> {
    pub(super) fn solve(&self, right_hand_sides: &[D::Wide]) -> Result<Vec<D::Wide>, SolveError> {
        match self {
            Self::Double(factor) => factor.solve(right_hand_sides, &Watch::none()),
            Self::Single(factor) => factor.solve(right_hand_sides, &Watch::none()),
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
    last: Option<(Key, Factor<D, S>)>,
}

impl<D: Scalar, S: Scalar<Wide = D::Wide>> Factors<D, S> {
    pub(super) fn new(analysis: CholeskyAnalysis) -> Self {
        Self { analysis, last: None }
    }

    /// Takes the factor of the matrix with these values: the last one if it has the same key, or a new one, in its memory
    /// if it has the same precision. [`Factors::answer`] puts it back.
    pub(super) fn take(
        &mut self,
        key: Key,
        precision: Precision,
        values: &dyn Fn(&CholeskyAnalysis) -> Vec<D::Wide>,
        progress: Progress<'_>,
    ) -> Result<Factor<D, S>, SolveError> {
        let last = match self.last.take() {
            Some((known, factor)) if known == key && factor.precision() == precision => return Ok(factor),
            last => last,
        };
        progress(Phase::Factorization, 0.2);
        let values = values(&self.analysis);
        Ok(match (last, precision) {
            (Some((_, Factor::Double(mut factor))), Precision::Double) => {
                factor.refactor(&values, &Watch::none())?;
                Factor::Double(factor)
            }
            (Some((_, Factor::Single(mut factor))), Precision::Single) => {
                factor.refactor(&values, &Watch::none())?;
                Factor::Single(factor)
            }
            (other, _) => {
                // Its memory is needed for the new one.
                drop(other);
                match precision {
                    Precision::Double => Factor::Double(self.analysis.factor(&values, &Watch::none())?),
                    Precision::Single => Factor::Single(self.analysis.factor(&values, &Watch::none())?),
                }
            }
        })
    }

    /// Keeps a factor that proved good, and says where the solutions come from.
    pub(super) fn answer(
        &mut self,
        key: Key,
        factor: Factor<D, S>,
        iterates: Vec<Iterate>,
        route: &'static str,
        smallest_eigenvalue: Option<f64>,
    ) -> Answer {
        let precision = if factor.precision() == Precision::Single { "single" } else { "double" };
        self.last = Some((key, factor));
        Answer { iterates, route, precision, factor_nonzeros: self.analysis.size().nonzeros, smallest_eigenvalue }
    }

    /// Gives the memory of the last factor back.
    pub(super) fn drop_factor(&mut self) {
        self.last = None;
    }
}
