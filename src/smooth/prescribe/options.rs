//! What a field with prescribed extrema is asked for with.

use super::extrema::Extrema;
use crate::error::OptionError;
use crate::field::Missing;
use crate::smooth::methods::Functional;
use crate::support::named::named;

/// Options of [`Smoother::prescribe`](crate::smooth::Smoother::prescribe).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrescribeOptions<'a> {
    /// What is to be small. Default that of Tikhonov smoothing.
    pub functional: Functional<'a>,
    /// Which extrema the field shall have. Default those of the smoothed field of persistence above 5 % of the range of the input.
    pub extrema: Extrema<'a>,
    /// Whether components of the mesh without a chosen minimum or maximum get their lowest or highest vertex. Default false: they are
    /// an error.
    pub complete: bool,
    /// What becomes of the values at the chosen extrema. Default free.
    pub values: ExtremumValues,
    /// The least difference along the prescribed steps, relative to the range of the input: between 0 and 0.01, neither included.
    /// Default 1e-6, which survives rounding to single precision.
    pub margin: f64,
    /// The least height of every chosen extremum above or below the first other one of its kind that it meets, relative to the range of
    /// the input. Default none but the margin's.
    pub prominence: Option<f64>,
    /// Whether the result may leave the range of the input. Default free.
    pub range: ResultRange,
    /// From how many smoothed fields, 1 or 3, the order of the vertices is taken, of which the best result counts: those of ε, ε/8 and
    /// 8ε. Default 1.
    pub representatives: usize,
    /// Whether the order of the vertices is taken once more, from the result. Default false.
    pub again: bool,
    /// Whether the flooded smoothed field is enough: it has exactly the chosen extrema, but is not the smoothest such field. It comes in the time of
    /// one smoothing. `margin` means nothing to it, and what else would change its values is refused. Default false.
    pub preview: bool,
}

impl Default for PrescribeOptions<'_> {
    fn default() -> Self {
        Self {
            functional: Functional::default(),
            extrema: Extrema::default(),
            complete: false,
            values: ExtremumValues::default(),
            margin: 1e-6,
            prominence: None,
            range: ResultRange::default(),
            representatives: 1,
            again: false,
            preview: false,
        }
    }
}

/// What becomes of the values at chosen extrema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ExtremumValues {
    /// They are whatever is smoothest. The default.
    #[default]
    Free,
    /// They stay as they are in the input, to the last bit.
    Keep,
}

named! { ExtremumValues { Free = "free", Keep = "keep" } }

/// Which values a result may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ResultRange {
    /// Any. The default.
    #[default]
    Free,
    /// Those within the range of the input.
    Input,
}

named! { ResultRange { Free = "free", Input = "input" } }

/// The largest margin: with larger ones, steps along a path of a hundred vertices would take more than the range.
const LARGEST_MARGIN: f64 = 0.01;

impl PrescribeOptions<'_> {
    /// # Errors
    /// `InvalidOption`, `InapplicableOption`.
    pub(in crate::smooth) fn check(&self) -> Result<(), OptionError> {
        let inapplicable = |option: &str, reason: &str| {
            Err(OptionError::InapplicableOption { option: option.to_owned(), reason: reason.to_owned() })
        };
        if self.functional.channels() > 1 {
            return inapplicable("channels", "several channels have no extrema in common; prescribe them one by one");
        }
        if self.functional.missing() == Missing::Fill {
            let reason = "extrema are those of known values; fill missing ones by `tikhonov` first, or omit them";
            return inapplicable("missing", reason);
        }
        if !(self.margin > 0.0 && self.margin < LARGEST_MARGIN) {
            return Err(OptionError::invalid("margin", "a number above 0 and below 0.01"));
        }
        if self.prominence.is_some_and(|prominence| !(prominence > 0.0 && prominence.is_finite())) {
            return Err(OptionError::invalid("prominence", "a positive finite number"));
        }
        if self.representatives != 1 && self.representatives != 3 {
            return Err(OptionError::invalid("representatives", "1 or 3"));
        }
        let defaults = PrescribeOptions::default();
        let beyond_previews = [
            ("values", self.values != defaults.values),
            ("prominence", self.prominence.is_some()),
            ("range", self.range != defaults.range),
            ("representatives", self.representatives != defaults.representatives),
            ("again", self.again != defaults.again),
        ];
        if let Some((option, _)) = beyond_previews.into_iter().find(|&(_, asked)| self.preview && asked) {
            return inapplicable(option, "a preview is the flooded field as it is; ask for the whole optimum");
        }
        Ok(())
    }
}
