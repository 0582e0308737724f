//! Choosing ε.

use core::f64::consts::LN_10;

use super::estimate::logarithmic;
use super::members::Family;
use super::space::Space;
use super::traces::Traces;
use crate::error::{OptionError, Result, SmoothError};
use crate::smooth::choice::{ChosenEpsilon, NoiseLevel, RuleName};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// A rule that chooses ε.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum EpsilonRule {
    /// Generalised cross-validation \[Golub79\]: the ε that predicts values that are left out best, by ‖x − f‖²/(n − tr)² with the trace
    /// of the matrix that smooths. Right where the noise of neighbours is independent. The default.
    #[default]
    Gcv,
    /// The corner of the L-curve \[Hansen93\], (ln ‖x − f‖_B, ln ‖Lx‖): the point of largest curvature; of several that are nearly as sharp
    /// the one nearest to the data.
    LCurve,
    /// The discrepancy principle: the largest ε for which the residual is as large as noise of this standard deviation makes it, in the units
    /// of the field: ‖x − f‖² = σ²(n − tr) \[Turchin67\], where n − tr degrees of freedom are left for the noise.
    Discrepancy {
        /// σ; nothing where it is to be estimated from the field.
        noise: Option<f64>,
    },
    /// The largest ε of a fine grid for which the smoothed field has no more critical points than so many, saddles with multiplicity.
    AtMostCriticalPoints {
        /// The number.
        count: usize,
    },
}

/// ε are compared on this grid.
const PER_DECADE: f64 = 100.0;
/// Critical points are counted on this one.
const COUNTS_PER_DECADE: f64 = 20.0;
/// Corners with this share of the largest curvature are nearly as sharp.
const NEARLY: f64 = 0.3;
/// How many runners-up are told.
const RUNNERS_UP: usize = 3;

/// What comparing ε on a grid takes: the grid, what is compared, points of curves, and their order.
pub(super) fn grid_bytes(range: (f64, f64)) -> u64 {
    96 * (PER_DECADE * libm::log10(range.1 / range.0)) as u64 + 1024
}

impl EpsilonRule {
    /// What it is called.
    #[must_use]
    pub fn name(&self) -> RuleName {
        match self {
            Self::Gcv => RuleName::Gcv,
            Self::LCurve => RuleName::LCurve,
            Self::Discrepancy { .. } => RuleName::Discrepancy,
            Self::AtMostCriticalPoints { .. } => RuleName::AtMostCriticalPoints,
        }
    }

    fn chosen(&self, epsilon: f64, reason: String, runners_up: Vec<f64>) -> ChosenEpsilon {
        ChosenEpsilon { epsilon, rule: self.name(), reason, runners_up, noise: None }
    }
}

impl Family {
    /// Chooses ε by a rule, for all channels together. The rules compare what the family tells at no cost; only counting critical points takes
    /// a while.
    ///
    /// # Errors
    /// `InvalidOption` for a level of noise that is not positive and finite; `TooManyCriticalPoints` where no ε has so few; `Cancelled`.
    pub fn choose(&self, rule: EpsilonRule, watch: &Watch<'_>) -> Result<ChosenEpsilon> {
        if let EpsilonRule::Discrepancy { noise: Some(noise) } = rule
            && !(noise.is_finite() && noise > 0.0)
        {
            return Err(OptionError::invalid("noise", "a positive finite number in the units of the field").into());
        }
        if self.field.channels.iter().all(|channel| channel.range.length() == 0.0) {
            let reason = "The field is constant, and so is what becomes of it for every ε.".to_owned();
            return Ok(rule.chosen(self.range.1, reason, Vec::new()));
        }
        let mut plan = watch.plan(&[(Phase::Report, 1.0)]);
        plan.begin(0)?;
        memory::ensure(grid_bytes(self.range))?;
        match rule {
            EpsilonRule::Gcv => Ok(self.by_cross_validation()),
            EpsilonRule::LCurve => Ok(self.by_l_curve()),
            EpsilonRule::Discrepancy { noise } => self.by_discrepancy(noise, watch),
            EpsilonRule::AtMostCriticalPoints { count } => self.by_count(count, watch),
        }
    }

    /// The traces of the matrix that smooths.
    pub(super) fn traces(&self) -> Traces {
        let (by_probes, components) = self.growth.kernel;
        let corrected: Vec<f64> = self.growth.traces.iter().map(|trace| trace - by_probes + components).collect();
        Traces::new(&self.growth.shifts, &corrected, components, self.growth.known as f64)
    }

    /// ‖x − f‖² over the known values of all channels, each in its normalised units and with a weight.
    fn residual(&self, epsilon: f64, weights: &[f64]) -> f64 {
        self.spaces.iter().zip(weights).map(|(space, weight)| weight * space.counted_misfit(epsilon)).sum()
    }

    /// The ε of the grid at which cross-validation has its minima, the least first.
    fn minima_of_cross_validation(&self, traces: &Traces) -> Vec<f64> {
        let known = self.growth.known as f64;
        let ones = vec![1.0; self.spaces.len()];
        let grid = logarithmic(self.range, PER_DECADE);
        let score = |epsilon: &f64| {
            let rest = known - traces.at(*epsilon);
            if rest > 0.0 { self.residual(*epsilon, &ones) / (rest * rest) } else { f64::INFINITY }
        };
        let scores: Vec<f64> = grid.iter().map(score).collect();
        let opposite: Vec<f64> = scores.iter().map(|score| -score).collect();
        let places = peaks(&opposite);
        // At the ends both parts of the quotient vanish, or are known badly: an end is taken only where there is nothing between.
        let is_end = |place: &usize| *place == 0 || *place + 1 == grid.len();
        let (ends, between): (Vec<usize>, Vec<usize>) = places.into_iter().partition(is_end);
        between.into_iter().chain(ends).map(|place| grid[place]).collect()
    }

    fn by_cross_validation(&self) -> ChosenEpsilon {
        let traces = self.traces();
        let minima = self.minima_of_cross_validation(&traces);
        let epsilon = minima.first().copied().unwrap_or(self.range.1);
        let reason = format!(
            "Generalised cross-validation is least at ε = {}, where the smoothed field has {} of {} degrees of freedom{}.",
            rounded(epsilon),
            traces.at(epsilon).round() as u64,
            self.growth.known,
            self.at_the_end(epsilon),
        );
        EpsilonRule::Gcv.chosen(epsilon, reason, runners_up(&minima))
    }

    /// What is said of an ε that is an end of the range, beyond which a better one may lie.
    fn at_the_end(&self, epsilon: f64) -> &'static str {
        if epsilon == self.range.0 || epsilon == self.range.1 {
            "; this is the end of the range of the family, and the best one may lie beyond"
        } else {
            ""
        }
    }

    fn by_l_curve(&self) -> ChosenEpsilon {
        let corners = l_curve_corners(&self.spaces, self.range);
        match corners.first() {
            Some(&epsilon) => {
                let reason = format!(
                    "The L-curve of ‖x − f‖ and ‖Lx‖ has its corner, the point of largest curvature, at ε = {}{}.",
                    rounded(epsilon),
                    self.at_the_end(epsilon),
                );
                EpsilonRule::LCurve.chosen(epsilon, reason, runners_up(&corners))
            }
            None => {
                let epsilon = self.range.1;
                let reason = format!(
                    "The L-curve has no corner between ε = {} and {}: nothing tells noise from field, and the least is changed.",
                    rounded(self.range.0),
                    rounded(epsilon),
                );
                EpsilonRule::LCurve.chosen(epsilon, reason, Vec::new())
            }
        }
    }

    fn by_discrepancy(&self, noise: Option<f64>, watch: &Watch<'_>) -> Result<ChosenEpsilon> {
        let traces = self.traces();
        let known = self.growth.known as f64;
        let lengths: Vec<f64> = self.field.channels.iter().map(|channel| channel.range.length()).collect();
        // σ of each channel in its normalised units.
        let levels: Vec<f64> = match noise {
            Some(noise) => lengths.iter().map(|length| noise / length).collect(),
            None => {
                let best = self.minima_of_cross_validation(&traces).first().copied().unwrap_or(self.range.1);
                let rest = (known - traces.at(best)).max(1.0);
                self.spaces.iter().map(|space| (space.counted_misfit(best) / rest).sqrt()).collect()
            }
        };
        let weight =
            |(sigma, length): (&f64, &f64)| if *length > 0.0 && *sigma > 0.0 { 1.0 / (sigma * sigma) } else { 0.0 };
        let weights: Vec<f64> = levels.iter().zip(&lengths).map(weight).collect();
        let counted = weights.iter().filter(|weight| **weight > 0.0).count() as f64;
        let grid = logarithmic(self.range, PER_DECADE);
        let is_reached =
            |epsilon: &&f64| self.residual(**epsilon, &weights) >= counted * (known - traces.at(**epsilon));
        let found = grid.iter().rev().find(is_reached).copied();
        let epsilon = found.unwrap_or(self.range.0);
        let level = levels[0] * lengths[0];
        let (what, noise) = match noise {
            Some(_) => ("the given noise", None),
            None => {
                let by_differences = self.noise_by_differences(0, watch)? * lengths[0];
                ("the noise estimated from the field", Some(NoiseLevel::new(level, by_differences)))
            }
        };
        let reason = match found {
            Some(_) => format!(
                "At ε = {} and no larger one, what smoothing takes away is as large as {what}, of standard deviation {}{}.",
                rounded(epsilon),
                rounded(level),
                self.at_the_end(epsilon),
            ),
            None => format!(
                "Even the least ε takes away less than {what}, of standard deviation {}: the field varies less.",
                rounded(level),
            ),
        };
        Ok(ChosenEpsilon { noise, ..EpsilonRule::Discrepancy { noise: None }.chosen(epsilon, reason, Vec::new()) })
    }

    fn by_count(&self, most: usize, watch: &Watch<'_>) -> Result<ChosenEpsilon> {
        let mut fewest = (usize::MAX, self.range.0);
        for epsilon in logarithmic(self.range, COUNTS_PER_DECADE).into_iter().rev() {
            let mut count = 0;
            for channel in 0..self.spaces.len() {
                let counts = self.counts(epsilon, channel, watch)?;
                count = count.max(counts.iter().map(|&count| count as usize).sum());
            }
            if count < fewest.0 {
                fewest = (count, epsilon);
            }
            if count <= most {
                let reason = format!(
                    "ε = {} is the largest one, of {COUNTS_PER_DECADE} in each decade, whose field has no more than {most} critical points: it has {count}.",
                    rounded(epsilon),
                );
                return Ok(EpsilonRule::AtMostCriticalPoints { count: most }.chosen(epsilon, reason, Vec::new()));
            }
        }
        Err(SmoothError::TooManyCriticalPoints { wanted: most, least: fewest.0, epsilon: fewest.1 }.into())
    }
}

/// The corners of the L-curve, the chosen one first: of those nearly as sharp as the sharpest that with the largest ε, then the others by
/// their curvature.
pub(super) fn l_curve_corners(spaces: &[Space], range: (f64, f64)) -> Vec<f64> {
    let grid = logarithmic(range, PER_DECADE / 2.0);
    let mut curve = Vec::with_capacity(grid.len());
    for &epsilon in &grid {
        let misfit: f64 = spaces.iter().map(|space| space.metric_norm(epsilon) * space.metric_norm(epsilon)).sum();
        let smoothness: f64 = spaces.iter().map(|space| space.smoothness_energy(epsilon)).sum();
        if !(misfit > 0.0 && smoothness > 0.0) {
            return Vec::new();
        }
        curve.push([0.5 * libm::log(misfit), 0.5 * libm::log(smoothness)]);
    }
    let mut curvature = vec![f64::NEG_INFINITY; grid.len()];
    for k in 1..grid.len().saturating_sub(1) {
        let [before, here, after] = [curve[k - 1], curve[k], curve[k + 1]];
        let first = [0.5 * (after[0] - before[0]), 0.5 * (after[1] - before[1])];
        let second = [after[0] - 2.0 * here[0] + before[0], after[1] - 2.0 * here[1] + before[1]];
        let speed = (first[0] * first[0] + first[1] * first[1]).sqrt();
        if speed > 0.0 {
            curvature[k] = (second[0] * first[1] - first[0] * second[1]) / (speed * speed * speed);
        }
    }
    let mut corners: Vec<usize> = peaks(&curvature).into_iter().filter(|&k| curvature[k] > 0.0).collect();
    let Some(&sharpest) = corners.first() else { return Vec::new() };
    let nearly = corners.iter().copied().filter(|&k| curvature[k] >= NEARLY * curvature[sharpest]).max();
    let chosen = nearly.unwrap_or(sharpest);
    corners.retain(|&k| k != chosen);
    corners.insert(0, chosen);
    corners.into_iter().map(|k| grid[k]).collect()
}

/// The places of local maxima, ends included, the largest first.
fn peaks(values: &[f64]) -> Vec<usize> {
    let below = |k: Option<usize>, value: f64, or_equal: bool| match k.and_then(|k| values.get(k)) {
        Some(&other) => other < value || or_equal && other == value,
        None => true,
    };
    let is_peak = |&k: &usize| {
        values[k].is_finite() && below(k.checked_sub(1), values[k], false) && below(Some(k + 1), values[k], true)
    };
    let mut places: Vec<usize> = Vec::new();
    for k in (0..values.len()).filter(is_peak) {
        places.insert(places.partition_point(|&other| values[other] >= values[k]), k);
    }
    places
}

/// A number with four digits, for people.
fn rounded(number: f64) -> String {
    if !(number > 0.0 && number.is_finite()) {
        return number.to_string();
    }
    let mut exponent = (libm::log(number) / LN_10).floor() as i32;
    let shifted = |exponent: i32| {
        let power = (0..exponent.abs()).fold(1.0, |power, _| power * 10.0);
        if exponent > 0 { number / power } else { number * power }
    };
    let mut digits = (1000.0 * shifted(exponent)).round();
    if digits >= 10_000.0 {
        exponent += 1;
        digits = (1000.0 * shifted(exponent)).round();
    }
    if !(1.0..10_000.0).contains(&digits) {
        return format!("{number:e}");
    }
    let digits = (digits as u32).to_string();
    let text = match exponent {
        0..=2 => format!("{}.{}", &digits[..=exponent as usize], &digits[exponent as usize + 1..]),
        -3..=-1 => format!("0.{}{digits}", &"00"[..(-1 - exponent) as usize]),
        _ => return format!("{}.{}e{exponent}", &digits[..1], &digits[1..]),
    };
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn runners_up(all: &[f64]) -> Vec<f64> {
    all.iter().copied().skip(1).take(RUNNERS_UP).collect()
}
