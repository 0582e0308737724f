//! Warnings.

/// Something in the input that was put right or left out, and that the user should know.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct Diagnostic {
    /// Stable name, such as `"DegenerateTriangle"`.
    pub code: &'static str,
    /// One sentence for people.
    pub message: String,
    /// How many were found.
    pub count: usize,
    /// Ids of the first few (at most [`Diagnostic::EXAMPLES`]).
    pub examples: Vec<u32>,
}

impl Diagnostic {
    /// How many ids [`Diagnostic::examples`] holds at most.
    pub const EXAMPLES: usize = 8;

    /// Adds a warning about the ids that were found, unless there are none. The message is told how many they are.
    pub(crate) fn report(
        warnings: &mut Vec<Self>,
        code: &'static str,
        ids: &mut dyn Iterator<Item = u32>,
        message: &dyn Fn(usize) -> String,
    ) {
        let examples: Vec<u32> = ids.take(Self::EXAMPLES).collect();
        let count = examples.len() + ids.count();
        if count > 0 {
            warnings.push(Self { code, message: message(count), count, examples });
        }
    }

    /// Adds a warning about the values of a field that are not finite.
    #[cfg(feature = "files")]
    pub(crate) fn report_not_finite(warnings: &mut Vec<Self>, name: &str, values: &[f64]) {
        let not_finite = (0_u32..).zip(values).filter(|(_, value)| !value.is_finite()).map(|(place, _)| place);
        Self::report(warnings, "NonFiniteValue", &mut { not_finite }, &|count| {
            format!(
                "{count} values of `{name}` are not finite; NaN can stand for a missing value, by the option `missing`"
            )
        });
    }
}
