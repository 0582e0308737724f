//! A family of smoothed fields, and its members.

use std::sync::Arc;

use super::growth::Growth;
use super::space::{Space, Which};
use crate::error::{OptionError, Result};
use crate::field::Missing;
use crate::smooth::channels::{Channel, Channels};
use crate::smooth::input::Input;
use crate::smooth::missing::{Gaps, Part};
use crate::smooth::names::{Route, UsedPrecision};
use crate::smooth::operators::Operators;
use crate::smooth::report::{About, Measures, Smoothed, SolverReport};
use crate::smooth::routes::RightHandSide;
use crate::smooth::run::{Found, Procedure, Solution, run, whole};
use crate::smooth::schedule::{Schedule, Stages};
use crate::smooth::system::Matrices;
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// The smoothed fields for all ε of a range: see [`Smoother::family`](crate::smooth::Smoother::family).
#[derive(Debug)]
pub struct Family {
    pub(super) field: Field,
    pub(super) matrices: Arc<Matrices>,
    pub(super) range: (f64, f64),
    pub(super) growth: Growth,
    /// One for each channel.
    pub(super) spaces: Vec<Space>,
}

/// [`Gaps`] that outlive a call.
#[derive(Debug)]
pub(super) struct KeptGaps {
    pub(super) missing: Arc<[u32]>,
    pub(super) part: Option<Arc<Part>>,
}

/// What is smoothed, and what is known of it.
#[derive(Debug)]
pub(super) struct Field {
    /// Those of the smoother, by which it is known.
    pub(super) home: Arc<Operators>,
    /// The same, or those of the part that is smoothed.
    pub(super) operators: Arc<Operators>,
    pub(super) about: About,
    /// Interleaved.
    pub(super) values: Vec<f64>,
    pub(super) channels: Vec<Channel>,
    /// The vertices whose values are to be filled in, and the part of the mesh that has values.
    pub(super) gaps: Option<KeptGaps>,
    /// Where missing values were left out: the part that is smoothed, and the values on the whole mesh.
    pub(super) left_out: Option<(Arc<Part>, Vec<f64>)>,
}

impl Family {
    /// The range of ε.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        self.range
    }

    /// The dimension of the space, for all channels together.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.spaces.iter().map(Space::dimension).sum()
    }

    /// The ε that a factor was computed for, in the order in which they were.
    #[must_use]
    pub fn shifts(&self) -> &[f64] {
        &self.growth.shifts
    }

    /// The largest estimated relative error ‖x − x_ε‖₂/‖x_ε‖₂ over the range, of normalised fields.
    #[must_use]
    pub fn error_estimate(&self) -> f64 {
        self.growth.worst.1
    }

    /// Whether it has reached its tolerance, or more shifts would make it no better.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.growth.is_complete
    }

    /// The estimated relative error for one ε.
    ///
    /// # Errors
    /// `InvalidOption` for an ε outside of the range.
    pub fn error_at(&self, epsilon: f64) -> Result<f64, OptionError> {
        self.check(epsilon)?;
        Ok(self.growth.error(&self.spaces, epsilon))
    }

    /// How many degrees of freedom the field of an ε has: the trace of the matrix (S + εB)⁻¹εB that smooths, between the number of components
    /// (ε → 0) and that of the values that the data term knows (ε → ∞).
    ///
    /// It is known at the shifts, by a few vectors with random signs, and interpolated between them. Every channel has as many.
    ///
    /// # Errors
    /// `InvalidOption` for an ε outside of the range.
    pub fn degrees_of_freedom(&self, epsilon: f64) -> Result<f64, OptionError> {
        self.check(epsilon)?;
        Ok(self.traces().at(epsilon))
    }

    /// The smoothed values for an ε, interleaved as the input: one product with the basis of the space.
    ///
    /// # Errors
    /// `InvalidOption` for an ε outside of the range; `OutOfMemory`.
    pub fn values(&self, epsilon: f64) -> Result<Vec<f64>> {
        self.check(epsilon)?;
        let field = &self.field;
        // The result, that of the whole mesh, and what one channel takes.
        memory::ensure(8 * (field.values.len() + field.count_before()) as u64 + self.channel_bytes())?;
        let mut values = field.values.clone();
        for c in 0..field.channels.len() {
            let restored = self.channel_values(epsilon, c)?;
            for (place, value) in values.iter_mut().skip(c).step_by(field.channels.len()).zip(restored) {
                *place = value;
            }
        }
        Ok(field.to_whole(values))
    }

    /// The smoothed values for an ε with the reports that smoothing by the method gives; the route is [`Route::Family`].
    ///
    /// # Errors
    /// `InvalidOption` for an ε outside of the range; `Cancelled`; `OutOfMemory`.
    pub fn at(&self, epsilon: f64, watch: &Watch<'_>) -> Result<Smoothed> {
        self.check(epsilon)?;
        let field = &self.field;
        // The result, that of the whole mesh, and what is said of all ε alike.
        let n = field.operators.mesh.vertex_count();
        memory::ensure(8 * (field.values.len() + field.count_before() + 2 * n) as u64)?;
        let gaps = field.gaps();
        let channels = Channels::new(
            &field.operators.mesh,
            &field.values,
            field.channels.len(),
            gaps.as_ref().map_or_else(Arc::default, |gaps| Arc::clone(&gaps.missing)),
        )?;
        let input = Input { operators: &field.operators, channels, gaps };
        let about = About { epsilon: Some(epsilon), ..field.about.clone() };
        let schedule = Schedule::of_filter(input.channels.group_count());
        let mut member = Member { family: self, epsilon, next: 0 };
        let smoothed = run(&input, &about, &mut member, schedule.stages(watch))?;
        Ok(Smoothed { values: field.to_whole(smoothed.values), reports: smoothed.reports })
    }

    /// What the values of one channel take: at the unknowns, normalised, and in the units of the input; and lists of vertices.
    pub(super) fn channel_bytes(&self) -> u64 {
        32 * self.field.operators.mesh.vertex_count() as u64
    }

    /// The smoothed values of one channel.
    pub(super) fn channel_values(&self, epsilon: f64, channel: usize) -> Result<Vec<f64>> {
        Ok(self.whole(channel, &self.spaces[channel].solution(epsilon, Which::Full))?.1)
    }

    /// The values of a channel from those of its unknowns: normalised, and in the units of the input.
    pub(super) fn whole(&self, channel: usize, solution: &[f64]) -> Result<(Vec<f64>, Vec<f64>)> {
        let Field { operators, about, channels, .. } = &self.field;
        Ok(whole(operators, about, &channels[channel], self.matrices.unknowns(), solution)?)
    }

    fn check(&self, epsilon: f64) -> Result<(), OptionError> {
        check_epsilon(self.range, epsilon)
    }
}

/// # Errors
/// `InvalidOption` for an ε outside of the range of a family.
pub(super) fn check_epsilon(range: (f64, f64), epsilon: f64) -> Result<(), OptionError> {
    if (range.0..=range.1).contains(&epsilon) {
        return Ok(());
    }
    let expected = format!("a number from {:e} to {:e}, the range of the family", range.0, range.1);
    Err(OptionError::InvalidOption { option: "epsilon".to_owned(), expected })
}

impl Field {
    /// Whether a value is to be filled in.
    pub(super) fn is_missing(&self, vertex: usize) -> bool {
        self.gaps.as_ref().is_some_and(|gaps| gaps.missing.binary_search(&(vertex as u32)).is_ok())
    }

    /// How many values there are on the whole mesh, where missing ones were left out.
    pub(super) fn count_before(&self) -> usize {
        self.left_out.as_ref().map_or(0, |(_, before)| before.len())
    }

    /// What NaN means in smoothed values: components without any value may have kept it.
    pub(super) fn missing_after(&self) -> Missing {
        if self.gaps.is_some() { Missing::Omit } else { Missing::Error }
    }

    pub(super) fn gaps(&self) -> Option<Gaps<'_>> {
        let KeptGaps { missing, part } = self.gaps.as_ref()?;
        Some(Gaps { missing: Arc::clone(missing), part: part.as_ref() })
    }

    /// Values of the part that was smoothed among those of the whole mesh.
    pub(super) fn to_whole(&self, values: Vec<f64>) -> Vec<f64> {
        match &self.left_out {
            None => values,
            Some((part, before)) => {
                let mut whole = before.clone();
                part.known.scatter(&values, self.channels.len(), &mut whole);
                whole
            }
        }
    }
}

/// The fields of a family for one ε, to be reported.
struct Member<'a> {
    family: &'a Family,
    epsilon: f64,
    /// The channel that comes next.
    next: usize,
}

impl Procedure for Member<'_> {
    fn solve(&mut self, group: &[Channel], _: bool, stages: &mut Stages<'_, '_>) -> Result<Found> {
        stages.begin(Phase::Solve, 0)?;
        let Family { matrices, spaces, .. } = self.family;
        let problem = matrices.problem(self.epsilon);
        let spaces = &spaces[self.next..self.next + group.len()];
        self.next += group.len();
        memory::ensure(64 * (matrices.unknowns().len() * group.len()) as u64)?;
        let mut solutions = Vec::with_capacity(group.len());
        for space in spaces {
            stages.watch.tick(2 * (space.dimension() * matrices.unknowns().len()) as u64)?;
            let x = space.solution(self.epsilon, Which::Full);
            let side = RightHandSide { field: space.field().to_vec(), offset: Vec::new() };
            let solver = SolverReport {
                route: Route::Family,
                precision: UsedPrecision::Double,
                unknowns: space.dimension(),
                factor_nonzeros: 0,
                relative_residual: problem.relative_residual(&side, &x),
                refinement_steps: 0,
                iterations: 0,
            };
            solutions.push(Solution { vertices: Arc::clone(matrices.unknowns()), x, values: None, solver });
        }
        Ok(Found { solutions, perturbation_factor: None })
    }

    fn measures(&mut self, x: &[f64], f: &[f64]) -> Measures {
        let matrices = &self.family.matrices;
        let moved: Vec<f64> = matrices.unknowns().iter().map(|&v| x[v as usize] - f[v as usize]).collect();
        Measures { metric_norm: Some(matrices.mass().norm(&moved)), ..Measures::default() }
    }
}
