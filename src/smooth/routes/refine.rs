//! Iterative refinement: what every solver's solution is brought to full accuracy with.

use crate::error::SolveError;
use crate::solve::norm;
use crate::support::watch::{Phase, Watch};

const MOST_STEPS: usize = 12;
/// Relative corrections of this size are rounding.
const ROUNDING: f64 = 1e-13;
/// Relative errors that are certainly no larger than this are not worth a correction.
const PROVEN: f64 = 1e-14;
/// Corrections of this size that shrink no more are rounding too, on a badly conditioned system.
const ROUGH_ROUNDING: f64 = 1e-10;

/// How much longer a residual in twice the precision takes.
const TWOFOLD: u64 = 10;

/// The shares of the solution and of its corrections, of which two are usual.
const ROUNDS: [(Phase, f64); 5] =
    [(Phase::Solve, 4.0), (Phase::Solve, 3.0), (Phase::Solve, 2.0), (Phase::Solve, 1.0), (Phase::Solve, 1.0)];

/// One solved right-hand side.
#[derive(Debug, Clone, Default)]
pub(in crate::smooth) struct Iterate {
    pub(in crate::smooth) x: Vec<f64>,
    pub(in crate::smooth) refinement_steps: usize,
    pub(in crate::smooth) iterations: usize,
}

/// What [`refine`] works on.
pub(super) struct Refinement<'a> {
    /// Number of right-hand sides.
    pub(super) count: usize,
    /// Length of each solution.
    pub(super) length: usize,
    /// The relative error that is small enough; infinite where the first solution is.
    pub(super) tolerance: f64,
    /// A bound of the norm of the matrix's inverse, where one is known: with it a residual tells that no correction is needed.
    pub(super) inverse_norm: Option<f64>,
    /// About how long a residual takes, in ticks.
    pub(super) ticks: u64,
    /// An approximate solution to start from, in place of zero.
    pub(super) start: Option<&'a dyn Fn(usize) -> Vec<f64>>,
    /// The residual of a right-hand side at an approximate solution; at zero, which may be empty, it is the right-hand side itself.
    pub(super) residual: &'a Residual<'a>,
    /// The same in twice the precision, for corrections that shrink no more with the other one.
    pub(super) precise: Option<&'a Residual<'a>>,
    /// Solves for right-hand sides stored one after the other, and adds to their counts of iterations.
    pub(super) solve: &'a mut Solve<'a>,
}

pub(super) type Residual<'a> = dyn Fn(usize, &[f64]) -> Vec<f64> + 'a;
type Solve<'a> = dyn FnMut(&[f64], &mut [usize]) -> Result<Vec<f64>, SolveError> + 'a;

/// Starts from zero, or what is given, and adds the solution for the residual until little is added, for each right-hand side for as long as
/// it needs.
///
/// A step leaves an error of about the correction times the factor by which corrections shrink; the first correction,
/// relative to the solution, is such a factor too.
///
/// # Errors
/// `NotConverged` where corrections do not shrink; `Cancelled`; those of the solver.
pub(super) fn refine(task: Refinement<'_>, watch: &Watch<'_>) -> Result<Vec<Iterate>, SolveError> {
    let Refinement { count, length: n, tolerance, inverse_norm, ticks, start, residual, precise, solve } = task;
    let mut plan = watch.plan(&ROUNDS);
    let x = |c: usize| start.map_or_else(|| vec![0.0; n], |start| start(c));
    let mut iterates: Vec<Iterate> = (0..count).map(|c| Iterate { x: x(c), ..Iterate::default() }).collect();
    let mut open: Vec<usize> = (0..count).collect();
    let (mut previous, mut slowest) = (vec![1.0; count], vec![0.0_f64; count]);
    let mut is_precise = vec![false; count];
    for step in 0..=MOST_STEPS {
        plan.begin(0)?;
        let times = open.iter().map(|&c| if is_precise[c] { TWOFOLD } else { 1 }).sum::<u64>();
        watch.tick(ticks * times)?;
        let mut residuals = Vec::with_capacity(open.len() * n);
        open.retain(|&c| {
            let rest = match precise.filter(|_| is_precise[c]) {
                Some(precise) => precise(c, &iterates[c].x),
                None if tolerance.is_finite() || start.is_some() => residual(c, &iterates[c].x),
                None => residual(c, &[]),
            };
            let error = inverse_norm.map_or(f64::INFINITY, |inverse| inverse * norm(&rest));
            let is_open = step == 0 || error.is_nan() || error > PROVEN * norm(&iterates[c].x);
            if is_open {
                residuals.extend_from_slice(&rest);
            }
            is_open
        });
        if open.is_empty() {
            return Ok(iterates);
        }
        let mut iterations = vec![0; open.len()];
        let corrections = solve(&residuals, &mut iterations)?;
        let mut still_open = Vec::new();
        for ((&c, correction), iterations) in open.iter().zip(corrections.chunks_exact(n)).zip(iterations) {
            let iterate = &mut iterates[c];
            iterate.iterations += iterations;
            iterate.refinement_steps = step;
            let size = norm(correction) / norm(&iterate.x).max(f64::MIN_POSITIVE);
            iterate.x.iter_mut().zip(correction).for_each(|(x, d)| *x += d);
            // The first solution is no correction: what it is corrected by tells how good it was.
            if step == 0 {
                still_open.extend(tolerance.is_finite().then_some(c));
                continue;
            }
            let shrunk = size / previous[c];
            if !(size.is_finite() && shrunk < 0.5) {
                if size <= ROUGH_ROUNDING {
                    continue;
                }
                if precise.is_some() && !is_precise[c] && size.is_finite() {
                    is_precise[c] = true;
                    // The next one takes away what rounding left, and so is no smaller.
                    previous[c] = 1.0;
                    still_open.push(c);
                    continue;
                }
                return Err(SolveError::NotConverged { iterations: step, residual: size });
            }
            previous[c] = size;
            slowest[c] = if is_precise[c] { shrunk } else { slowest[c].max(shrunk) };
            if size > ROUNDING && size * slowest[c] > tolerance {
                still_open.push(c);
            }
        }
        open = still_open;
        if open.is_empty() {
            return Ok(iterates);
        }
    }
    let residual = open.iter().map(|&c| previous[c]).fold(0.0, f64::max);
    Err(SolveError::NotConverged { iterations: MOST_STEPS, residual })
}
