//! Minimises ½xᵀHx − cᵀx among the fields that take all prescribed steps, where few of them bind: by a dual active-set method
//! \[Goldfarb83\] on the factor of H alone.
//!
//! With multipliers λ of some steps the best field is x = H⁻¹(c + Dᵀλ), and it takes these steps by DH⁻¹Dᵀλ more than the smoothed
//! field does: a small dense matrix, each column of which is one solve. Steps are only looked at when the field at hand lacks them.

use super::incidence::{Optimum, Steps};
use super::quadratic::Quadratic;
use crate::error::{Result, SolveError};
use crate::smooth::prescribed::PrescribeRoute;
use crate::solve::norm;
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// It is tried where the smoothed field lacks no more steps than these, and given up where more have to be looked at: from there on
/// the interior-point method takes less time.
const MOST_LACKING: usize = 64;
const MOST_STEPS: usize = 128;
/// Where a round leaves more lacking than half of all that were looked at, and a few, there is no end in sight.
const FEW: usize = 4;
/// So many rounds are usual; progress is told as if there were so many.
const USUAL_ROUNDS: usize = 4;
/// And so many are the most.
const MOST_ROUNDS: usize = 10;
/// What a step may lack, relative to the margin, and what of it the multipliers leave.
const LACKING: f64 = 1e-4;
const LEFT: f64 = 0.1;
/// A step is a combination of others where less of its own is left than this share.
const DEPENDENT: f64 = 1e-9;
/// The gradient that is left, relative to what balances it, and the steps of refinement for it.
const UNBALANCED: f64 = 1e-9;
const REFINEMENTS: usize = 3;
/// Changes of the set of binding steps, for each step that is looked at.
const CHANGES: usize = 10;
/// Right-hand sides that are solved for together.
const TOGETHER: usize = 4;
/// The work with one step of a field in one round.
const TICKS: u64 = 20;

/// Minimises, from the field that is best without steps. Nothing where too many steps bind, or rounding is in the way.
///
/// # Errors
/// `Cancelled`, `OutOfMemory`, and what factoring fails with.
pub(super) fn minimize(
    quadratic: &mut Quadratic<'_>,
    steps: &Steps,
    start: &[f64],
    watch: &Watch<'_>,
) -> Result<Option<Optimum>> {
    let tolerance = LACKING * steps.margin();
    let mut lacking = steps.lacking(start, tolerance);

    if lacking.len() > MOST_LACKING {
        return Ok(None);
    }
    let n = start.len();
    memory::ensure((8 * ((3 + 2 * TOGETHER) * n + steps.len())) as u64)?;
    let phases = [(Phase::Solve, 1.0); USUAL_ROUNDS];
    let mut plan = watch.plan(&phases);
    plan.begin(0)?;
    match quadratic.factor_alone(watch) {
        Err(SolveError::NotPositiveDefinite { .. }) => return Ok(None),
        other => other?,
    }
    let mut binding = Binding::default();
    let mut x = start.to_vec();
    let mut solves = 0;
    for round in 1..=MOST_ROUNDS {
        let looked_at = binding.steps.len();
        let grows = round > 1 && lacking.len() > looked_at / 2 + FEW;
        if grows || looked_at + lacking.len() > MOST_STEPS {
            return Ok(None);
        }
        plan.begin(0)?;
        watch.tick(TICKS * steps.len() as u64)?;
        solves += binding.add(&lacking, quadratic, steps, start, watch)?;
        if !binding.solve(LEFT * tolerance) {
            return Ok(None);
        }
        let mut pull = vec![0.0; n];
        steps.add_few_transposed(binding.steps.iter().copied().zip(binding.multipliers.iter().copied()), &mut pull);
        quadratic.clear_fixed(&mut pull);
        let load = norm(&quadratic.load).max(norm(&pull)).max(f64::MIN_POSITIVE);
        let mut unbalanced = f64::INFINITY;
        x.copy_from_slice(start);
        for refinement in 0..=REFINEMENTS {
            let mut rest = quadratic.minus_gradient(&x);
            rest.iter_mut().zip(&pull).for_each(|(rest, pull)| *rest += pull);
            quadratic.clear_fixed(&mut rest);
            unbalanced = norm(&rest) / load;
            if unbalanced < UNBALANCED || refinement == REFINEMENTS {
                break;
            }
            let change = quadratic.solve(&rest, watch)?;
            x.iter_mut().zip(change).for_each(|(x, d)| *x += d);
            solves += 1;
        }
        if unbalanced.is_nan() || unbalanced >= UNBALANCED {
            return Ok(None);
        }
        lacking = steps.lacking(&x, tolerance);
        if lacking.is_empty() {
            let rises = steps.rises(&x);
            let product: f64 = binding
                .steps
                .iter()
                .zip(&binding.multipliers)
                .map(|(&k, z)| z * (rises[k] - steps.steps[k].least).abs())
                .sum();
            // Nothing summed up is −0.
            let gap = 2.0 * product.abs() / quadratic.energy(&x).max(f64::MIN_POSITIVE);
            plan.finish()?;
            return Ok(Some(Optimum { x, route: PrescribeRoute::Dual, gap, unbalanced, iterations: round, solves }));
        }
        // Steps that are among those looked at are taken as exactly as rounding allows: it does not allow enough.
        if lacking.iter().any(|k| binding.steps.contains(k)) {
            return Ok(None);
        }
    }
    Ok(None)
}

/// The steps that are looked at, and their multipliers.
#[derive(Default)]
struct Binding {
    steps: Vec<usize>,
    /// DH⁻¹Dᵀ between them.
    gram: Vec<Vec<f64>>,
    /// What the field without steps lacks of each: negative where it has it to spare.
    wanted: Vec<f64>,
    multipliers: Vec<f64>,
    /// The places among them of steps that are taken exactly: all others have no multiplier.
    active: Vec<usize>,
}

impl Binding {
    /// Looks at more steps; how many solves it took.
    fn add(
        &mut self,
        more: &[usize],
        quadratic: &Quadratic<'_>,
        steps: &Steps,
        start: &[f64],
        watch: &Watch<'_>,
    ) -> Result<usize> {
        let (n, known) = (start.len(), self.steps.len());
        self.steps.extend(more);
        for &k in more {
            self.wanted.push(steps.steps[k].least - steps.rise(start, k));
            self.multipliers.push(0.0);
        }
        let count = self.steps.len();
        self.gram.iter_mut().for_each(|row| row.resize(count, 0.0));
        self.gram.resize(count, vec![0.0; count]);
        for (chunk, first) in more.chunks(TOGETHER).zip((known..).step_by(TOGETHER)) {
            let mut right = vec![0.0; n * chunk.len()];
            for (&k, right) in chunk.iter().zip(right.chunks_exact_mut(n)) {
                steps.add_few_transposed([(k, 1.0)].into_iter(), right);
                quadratic.clear_fixed(right);
            }
            let columns = quadratic.solve(&right, watch)?;
            for (column, j) in columns.chunks_exact(n).zip(first..) {
                for i in 0..count {
                    let entry = steps.rise(column, self.steps[i]);
                    self.gram[i][j] = entry;
                    self.gram[j][i] = entry;
                }
            }
        }
        Ok(more.len())
    }

    /// What the field with the multipliers at hand lacks of a step.
    fn lacks(&self, i: usize) -> f64 {
        let taken: f64 = self.gram[i].iter().zip(&self.multipliers).map(|(g, z)| g * z).sum();
        self.wanted[i] - taken
    }

    /// Finds the multipliers: one step after the other is taken that is lacked most, and others are let go whose multiplier comes down
    /// to zero. Whether it came to an end.
    fn solve(&mut self, tolerance: f64) -> bool {
        let count = self.steps.len();
        for _ in 0..CHANGES * count.max(1) {
            let most = (0..count)
                .filter(|i| !self.active.contains(i))
                .map(|i| (i, self.lacks(i)))
                .filter(|&(_, lacks)| lacks > tolerance)
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((taken, _)) = most else {
                return true;
            };
            if !self.take(taken) {
                return false;
            }
        }
        false
    }

    /// Takes a step exactly; whether that is possible.
    fn take(&mut self, taken: usize) -> bool {
        loop {
            // The multipliers of the active steps that balance one of the new step.
            let right: Vec<f64> = self.active.iter().map(|&i| self.gram[i][taken]).collect();
            let Some(balance) = self.balanced(&right) else {
                return false;
            };
            let own = self.gram[taken][taken] - balance.iter().zip(&right).map(|(a, b)| a * b).sum::<f64>();
            let whole = if own > DEPENDENT * self.gram[taken][taken] { self.lacks(taken) / own } else { f64::INFINITY };
            let shortest = self
                .active
                .iter()
                .zip(&balance)
                .enumerate()
                .filter(|&(_, (_, &balance))| balance > 0.0)
                .map(|(place, (&i, &balance))| (place, self.multipliers[i] / balance))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            let length = shortest.map_or(whole, |(_, length)| length.min(whole));
            if !length.is_finite() {
                return false;
            }
            for (&i, &balance) in self.active.iter().zip(&balance) {
                self.multipliers[i] = (self.multipliers[i] - length * balance).max(0.0);
            }
            self.multipliers[taken] += length;
            match shortest {
                Some((place, shortest)) if shortest < whole => {
                    let let_go = self.active.remove(place);
                    self.multipliers[let_go] = 0.0;
                }
                _ => {
                    self.active.push(taken);
                    return true;
                }
            }
        }
    }

    /// Solves with the matrix of the active steps, by a dense Cholesky factor.
    fn balanced(&self, right: &[f64]) -> Option<Vec<f64>> {
        let count = self.active.len();
        let mut lower = vec![vec![0.0; count]; count];
        let mut x = right.to_vec();
        for i in 0..count {
            for j in 0..=i {
                let dot: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
                let rest = self.gram[self.active[i]][self.active[j]] - dot;
                lower[i][j] = if i > j { rest / lower[j][j] } else { rest.sqrt() };
            }
            if lower[i][i].is_nan() || lower[i][i] <= 0.0 {
                return None;
            }
            let dot: f64 = (0..i).map(|k| lower[i][k] * x[k]).sum();
            x[i] = (x[i] - dot) / lower[i][i];
        }
        for i in (0..count).rev() {
            let dot: f64 = (i + 1..count).map(|k| lower[k][i] * x[k]).sum();
            x[i] = (x[i] - dot) / lower[i][i];
        }
        Some(x)
    }
}
