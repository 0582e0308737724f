//! How a call's time is divided among its steps: the one table of shares for all methods and routes.

use super::{SmootherOptions, SolverChoice};
use crate::error::Cancelled;
use crate::support::watch::{Phase, Plan, Watch};

/// What is done for the channels that are solved for together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Work {
    /// A factor on the pattern of L: complex, or real for harmonic interpolation.
    FactorOfLaplacian,
    /// A factor on the pattern of LᵀL.
    FactorOfSquare,
    /// Conjugate gradients that a factor on the pattern of L preconditions.
    PreconditionedByFactor,
    /// Iterations without a factor.
    Iterations,
    /// The steps of a filter.
    Filter,
    /// An interior-point method, which divides its work itself.
    Exact,
}

impl Work {
    /// The shares of analysis, factorisation, solving and reporting: hundredths of a second at 100,000 vertices in WebAssembly.
    fn shares(self) -> [f64; 4] {
        match self {
            Self::FactorOfLaplacian => [25.0, 31.0, 12.0, 4.0],
            Self::FactorOfSquare => [50.0, 56.0, 20.0, 4.0],
            Self::PreconditionedByFactor => [25.0, 31.0, 80.0, 4.0],
            Self::Iterations => [0.0, 0.0, 200.0, 4.0],
            Self::Filter => [0.0, 0.0, 95.0, 5.0],
            Self::Exact => [0.0, 0.0, 500.0, 5.0],
        }
    }
}

impl Work {
    /// What the work with a constrained system is likely to be: `is_squared` where its matrix is the square of another one.
    pub(super) fn expected(options: SmootherOptions, is_symmetric: bool, is_squared: bool) -> Self {
        match options.solver {
            SolverChoice::ConjugateGradient => Self::Iterations,
            _ if is_squared || !is_symmetric => Self::FactorOfSquare,
            _ => Self::FactorOfLaplacian,
        }
    }
}

/// The share of a rule that finds the constraints.
const RULE: f64 = 10.0;

/// What a call has before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forecast {
    /// Whether a rule has to find the constraints.
    pub(super) rule: bool,
    pub(super) work: Work,
    /// Whether a pattern has to be analysed first.
    pub(super) analysis: bool,
    /// Whether a factor has to be computed.
    pub(super) factorization: bool,
    /// How many groups of channels there are.
    pub(super) groups: usize,
}

/// The steps of a call with their shares, for [`Stages`] to go through.
pub(super) struct Schedule(Vec<(Phase, f64)>);

impl Schedule {
    pub(super) fn new(forecast: &Forecast) -> Self {
        let [analysis, factorization, solve, report] = forecast.work.shares();
        let once = |needed: bool, share: f64| if needed { share } else { 0.0 };
        let mut steps = vec![(Phase::Field, once(forecast.rule, RULE))];
        for group in 0..forecast.groups {
            // What is analysed and factored serves all groups.
            let first = group == 0;
            steps.push((Phase::Analysis, once(first && forecast.analysis, analysis)));
            steps.push((Phase::Factorization, once(first && forecast.factorization, factorization)));
            steps.push((Phase::Solve, solve));
            steps.push((Phase::Report, report));
        }
        Self(steps)
    }

    /// The steps of a filter for so many groups of channels.
    pub(super) fn of_filter(groups: usize) -> Self {
        Self::new(&Forecast { rule: false, work: Work::Filter, analysis: false, factorization: false, groups })
    }

    /// What all steps take together, in the units of [`Work::shares`].
    pub(super) fn time(&self) -> f64 {
        self.0.iter().map(|(_, share)| share).sum()
    }

    /// Goes through the steps.
    pub(super) fn stages<'w, 'a>(&'w self, watch: &'w Watch<'a>) -> Stages<'w, 'a> {
        Stages { watch, plan: watch.plan(&self.0), group: 0 }
    }
}

/// Where a call is in its schedule.
pub(super) struct Stages<'w, 'a> {
    pub(super) watch: &'w Watch<'a>,
    plan: Plan<'w, 'a>,
    group: usize,
}

impl Stages<'_, '_> {
    /// Begins a step for the group at hand, in which about so many ticks are counted. A step that is taken once more, because a
    /// route failed, tells its phase and leaves the fraction where it is.
    ///
    /// # Errors
    /// `Cancelled` where the watcher stops the work.
    pub(super) fn begin(&mut self, phase: Phase, ticks: u64) -> Result<(), Cancelled> {
        let step = match phase {
            Phase::Field => 0,
            Phase::Analysis => 4 * self.group + 1,
            Phase::Factorization => 4 * self.group + 2,
            Phase::Solve => 4 * self.group + 3,
            Phase::Report => 4 * self.group + 4,
        };
        self.plan.skip_to(step);
        self.plan.begin(ticks)
    }

    /// Goes on to the next channels.
    pub(super) fn next_group(&mut self) {
        self.group += 1;
    }

    /// Tells that the call is done.
    ///
    /// # Errors
    /// `Cancelled` where the watcher stops even now.
    pub(super) fn finish(self) -> Result<(), Cancelled> {
        self.plan.finish()
    }
}
