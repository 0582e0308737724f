//! Minimises ½xᵀHx − cᵀx among the fields that take all prescribed steps: Dx ≥ τ, by a primal–dual interior-point method
//! \[Mehrotra92\], \[Gondzio96\].
//!
//! A step joins two vertices of one edge, so that H + DᵀWD has the pattern of H for all weights W = z/s: one analysis serves all
//! iterations, and every weight goes to the same four places.

use super::incidence::{Optimum, Steps};
use super::quadratic::Quadratic;
use crate::error::{Result, SmoothError, SolveError};
use crate::smooth::prescribed::PrescribeRoute;
use crate::solve::norm;
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// How far it goes.
const MOST_ITERATIONS: usize = 60;
/// So many are usual; progress is told as if there were so many.
const USUAL_ITERATIONS: usize = 9;
/// The duality gap that is left, relative to the energy; and the one that is good enough where rounding allows of no smaller one.
const GAP: f64 = 1e-6;
const LARGEST_GAP: f64 = 1e-4;
/// What the steps may lack of the slacks, relative to the least margin, and the gradient of what balances it, relative to it.
const PRIMAL: f64 = 0.1;
const DUAL: f64 = 1e-6;
/// The products of slacks and multipliers at the start add up to so many energies of the unconstrained field.
const START: f64 = 5.0;
/// The share of the way to the boundary that is gone.
const TO_BOUNDARY: f64 = 0.995;
/// Correctors beside Mehrotra's, and how far beyond the step they aim; a corrector counts that lets the step grow by this.
const CORRECTORS: usize = 2;
const AIM: f64 = 0.3;
const GAIN: f64 = 0.1;
/// Products of slacks and multipliers are kept within these multiples of their target.
const SMALLEST_PRODUCT: f64 = 0.1;
const LARGEST_PRODUCT: f64 = 10.0;
/// The work with one step of a field in one iteration.
const TICKS: u64 = 150;

/// A direction in all variables.
struct Direction {
    x: Vec<f64>,
    slacks: Vec<f64>,
    multipliers: Vec<f64>,
}

/// Where the method is.
struct Point {
    x: Vec<f64>,
    /// s and z.
    slacks: Vec<f64>,
    multipliers: Vec<f64>,
    /// c − Hx + Dᵀz, zero where variables are fixed.
    dual: Vec<f64>,
    /// Dx − s − τ.
    primal: Vec<f64>,
}

/// Minimises, from a start in which fixed variables have their values. `energy`: that of the field without prescribed steps.
///
/// # Errors
/// `NotConverged`, `Cancelled`, `OutOfMemory`.
pub(super) fn minimize(
    quadratic: &mut Quadratic<'_>,
    steps: &Steps,
    start: &[f64],
    energy: f64,
    watch: &Watch<'_>,
) -> Result<Optimum> {
    let (n, m) = (start.len(), steps.len());
    memory::ensure((8 * (8 * n + 14 * m)) as u64)?;
    let margin = steps.margin();
    let mut point = Point::new(quadratic, steps, start, energy, margin);
    let phases = [(Phase::Factorization, 1.0); USUAL_ITERATIONS];
    let mut plan = watch.plan(&phases);
    let load = norm(&quadratic.load).max(f64::MIN_POSITIVE);
    let mut solves = 0;
    for iteration in 0..=MOST_ITERATIONS {
        point.find_residuals(quadratic, steps);
        let energy = quadratic.energy(&point.x).max(f64::MIN_POSITIVE);
        let gap = 2.0 * point.product() / energy;
        let lacking = point.primal.iter().fold(0.0_f64, |most, p| most.max(p.abs()));
        let unbalanced = norm(&point.dual) / load.max(norm(&point.pull(steps)));
        if !(gap.is_finite() && lacking.is_finite()) {
            return Err(SmoothError::NotConverged { iterations: iteration, residual: gap }.into());
        }
        let is_balanced = lacking < PRIMAL * margin && unbalanced < DUAL;
        if gap < GAP && is_balanced {
            plan.finish()?;
            return Ok(point.optimum(gap, unbalanced, iteration, solves));
        }
        if iteration == MOST_ITERATIONS {
            return Err(SmoothError::NotConverged { iterations: iteration, residual: gap }.into());
        }
        plan.begin(0)?;
        watch.tick(TICKS * m as u64)?;
        match point.advance(quadratic, steps, watch) {
            Ok(taken) => solves += taken,
            // The weights of steps that are all but taken are so large that others are lost beside them.
            Err(SolveError::NotPositiveDefinite { .. } | SolveError::NonFiniteEntry { .. }) => {
                if gap < LARGEST_GAP && is_balanced {
                    plan.finish()?;
                    return Ok(point.optimum(gap, unbalanced, iteration, solves));
                }
                return Err(SmoothError::NotConverged { iterations: iteration, residual: gap }.into());
            }
            Err(other) => return Err(other.into()),
        }
    }
    Err(SmoothError::NotConverged { iterations: MOST_ITERATIONS, residual: f64::INFINITY }.into())
}

impl Point {
    fn new(quadratic: &Quadratic<'_>, steps: &Steps, start: &[f64], energy: f64, margin: f64) -> Self {
        let mut slacks = steps.rises(start);
        slacks.iter_mut().zip(&steps.steps).for_each(|(s, step)| *s -= step.least);
        let mean = slacks.iter().map(|s| s.abs()).sum::<f64>() / slacks.len() as f64;
        slacks.iter_mut().for_each(|s| *s = s.max(0.1 * mean).max(margin));
        // A field that costs nothing has no energy to compare with: about the least one that steps cost stands for it.
        let reference = energy.max(quadratic.mean_diagonal() * slacks.len() as f64 * margin * margin);
        let product = START * reference / slacks.len() as f64;
        let multipliers = slacks.iter().map(|s| product / s).collect();
        Self { x: start.to_vec(), slacks, multipliers, dual: Vec::new(), primal: Vec::new() }
    }

    fn optimum(self, gap: f64, unbalanced: f64, iterations: usize, solves: usize) -> Optimum {
        Optimum { x: self.x, route: PrescribeRoute::InteriorPoint, gap, unbalanced, iterations, solves }
    }

    /// sᵀz.
    fn product(&self) -> f64 {
        self.slacks.iter().zip(&self.multipliers).map(|(s, z)| s * z).sum()
    }

    /// Dᵀz.
    fn pull(&self, steps: &Steps) -> Vec<f64> {
        let mut pull = vec![0.0; self.x.len()];
        steps.add_transposed(&self.multipliers, &mut pull);
        pull
    }

    fn find_residuals(&mut self, quadratic: &Quadratic<'_>, steps: &Steps) {
        self.dual = quadratic.minus_gradient(&self.x);
        steps.add_transposed(&self.multipliers, &mut self.dual);
        quadratic.clear_fixed(&mut self.dual);
        self.primal = steps.rises(&self.x);
        for ((p, s), step) in self.primal.iter_mut().zip(&self.slacks).zip(&steps.steps) {
            *p -= s + step.least;
        }
    }

    /// Goes one step; how many solves it took.
    fn advance(
        &mut self,
        quadratic: &mut Quadratic<'_>,
        steps: &Steps,
        watch: &Watch<'_>,
    ) -> Result<usize, SolveError> {
        let m = self.slacks.len();
        let weights: Vec<f64> = self.multipliers.iter().zip(&self.slacks).map(|(z, s)| z / s).collect();
        quadratic.factor(&|values| steps.add_weights(&weights, values), watch)?;
        let mu = self.product() / m as f64;
        let products: Vec<f64> = self.slacks.iter().zip(&self.multipliers).map(|(s, z)| s * z).collect();
        // Mehrotra's predictor goes for products of zero, and tells how far they can come down.
        let predicted = self.direction(quadratic, steps, &weights, &products, true, watch)?;
        let reach = self.longest(&predicted);
        let after = self.product_after(&predicted, reach) / m as f64;
        let quotient = after / mu;
        let target = quotient * quotient * quotient * mu;
        let corrected: Vec<f64> = products
            .iter()
            .zip(predicted.slacks.iter().zip(&predicted.multipliers))
            .map(|(p, (ds, dz))| p + ds * dz - target)
            .collect();
        drop(predicted);
        let mut direction = self.direction(quadratic, steps, &weights, &corrected, true, watch)?;
        let mut solves = 2;
        let mut length = self.longest(&direction);
        // Gondzio's correctors bring products back that stray from the others, as long as that lets the step grow.
        for _ in 0..CORRECTORS {
            let aim = (length + AIM).min(1.0);
            let strays = self.strays(&direction, aim, target);
            let correction = self.direction(quadratic, steps, &weights, &strays, false, watch)?;
            solves += 1;
            let longer = direction.plus(&correction);
            let reached = self.longest(&longer);
            if reached < length + GAIN * (aim - length).max(0.05) {
                break;
            }
            (direction, length) = (longer, reached);
        }
        let length = (TO_BOUNDARY * length).min(1.0);
        add(&mut self.x, length, &direction.x);
        add(&mut self.slacks, length, &direction.slacks);
        add(&mut self.multipliers, length, &direction.multipliers);
        Ok(solves)
    }

    /// The direction that changes the products of slacks and multipliers by −`excess`, and, if it `mends`, takes all residuals away.
    fn direction(
        &self,
        quadratic: &Quadratic<'_>,
        steps: &Steps,
        weights: &[f64],
        excess: &[f64],
        mends: bool,
        watch: &Watch<'_>,
    ) -> Result<Direction, SolveError> {
        // Hdx − Dᵀdz = r, D dx − ds = −p, z ds + s dz = −e, without ds and dz.
        let lacking = |k: usize| if mends { self.primal[k] } else { 0.0 };
        let pulls: Vec<f64> =
            (0..self.slacks.len()).map(|k| -excess[k] / self.slacks[k] - weights[k] * lacking(k)).collect();
        let mut right = if mends { self.dual.clone() } else { vec![0.0; self.x.len()] };
        steps.add_transposed(&pulls, &mut right);
        quadratic.clear_fixed(&mut right);
        let x = quadratic.solve(&right, watch)?;
        let mut slacks = steps.rises(&x);
        slacks.iter_mut().enumerate().for_each(|(k, slack)| *slack += lacking(k));
        let multipliers = (0..slacks.len()).map(|k| -excess[k] / self.slacks[k] - weights[k] * slacks[k]).collect();
        Ok(Direction { x, slacks, multipliers })
    }

    /// How far a direction can be gone, at most 1, until a slack or a multiplier is zero.
    fn longest(&self, direction: &Direction) -> f64 {
        let mut longest = 1.0_f64;
        for (value, change) in
            self.slacks.iter().zip(&direction.slacks).chain(self.multipliers.iter().zip(&direction.multipliers))
        {
            if value + longest * change < 0.0 {
                longest = -value / change;
            }
        }
        longest
    }

    /// sᵀz after a step.
    fn product_after(&self, direction: &Direction, length: f64) -> f64 {
        let mut sum = 0.0;
        for k in 0..self.slacks.len() {
            sum += (self.slacks[k] + length * direction.slacks[k])
                * (self.multipliers[k] + length * direction.multipliers[k]);
        }
        sum
    }

    /// By how much the products after a step are beyond what they may be.
    fn strays(&self, direction: &Direction, length: f64, target: f64) -> Vec<f64> {
        let (least, most) = (SMALLEST_PRODUCT * target, LARGEST_PRODUCT * target);
        let stray = |k: usize| {
            let product = (self.slacks[k] + length * direction.slacks[k])
                * (self.multipliers[k] + length * direction.multipliers[k]);
            (product - product.clamp(least, most)).min(most)
        };
        (0..self.slacks.len()).map(stray).collect()
    }
}

impl Direction {
    fn plus(&self, other: &Self) -> Self {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect();
        Self {
            x: sum(&self.x, &other.x),
            slacks: sum(&self.slacks, &other.slacks),
            multipliers: sum(&self.multipliers, &other.multipliers),
        }
    }
}

/// x + scale·d.
fn add(x: &mut [f64], scale: f64, d: &[f64]) {
    x.iter_mut().zip(d).for_each(|(x, d)| *x += scale * d);
}
