//! An ε that was chosen, and why.

#[cfg(doc)]
use super::EpsilonRule;
use crate::support::named::named;

/// What a rule is called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RuleName {
    /// [`EpsilonRule::Gcv`].
    Gcv,
    /// [`EpsilonRule::LCurve`].
    LCurve,
    /// [`EpsilonRule::Discrepancy`].
    Discrepancy,
    /// [`EpsilonRule::AtMostCriticalPoints`].
    AtMostCriticalPoints,
}

named! { RuleName {
    Gcv = "gcv", LCurve = "lCurve", Discrepancy = "discrepancy", AtMostCriticalPoints = "atMostCriticalPoints",
} }

/// An ε that a rule chose.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct ChosenEpsilon {
    /// ε.
    pub epsilon: f64,
    /// The rule.
    pub rule: RuleName,
    /// Why, in a sentence.
    pub reason: String,
    /// The values of ε that came next: other minima or corners, the best one first.
    pub runners_up: Vec<f64>,
    /// The level of the noise, by the rules that need it.
    pub noise: Option<NoiseLevel>,
}

/// How far two ways of finding the level of the noise agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Confidence {
    /// To within 15 %.
    High,
    /// To within a factor of 1.5.
    Medium,
    /// No better: the noise of neighbouring vertices is alike, or the mesh is too coarse for the field.
    Low,
}

named! { Confidence { High = "high", Medium = "medium", Low = "low" } }

/// The level of the noise of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct NoiseLevel {
    /// The standard deviation in the units of the field, from what smoothing takes away at the ε of cross-validation, over the degrees of
    /// freedom that it takes away: the high end of the spectrum.
    pub standard_deviation: f64,
    /// The same from second differences along edges, by their median: robust, but too large where the mesh is coarse for the field.
    pub by_differences: f64,
    /// How far the two agree.
    pub confidence: Confidence,
}

impl NoiseLevel {
    /// What two ways of finding it came to.
    pub(super) fn new(standard_deviation: f64, by_differences: f64) -> Self {
        let quotient = if standard_deviation > by_differences {
            standard_deviation / by_differences
        } else {
            by_differences / standard_deviation
        };
        let confidence = match quotient {
            quotient if quotient <= 1.15 => Confidence::High,
            quotient if quotient <= 1.5 => Confidence::Medium,
            _ => Confidence::Low,
        };
        Self { standard_deviation, by_differences, confidence }
    }
}
