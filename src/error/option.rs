//! Options and arguments.

use super::detail::Detail;
use super::stage::stage_error;

stage_error! {
    /// An option is unknown, out of range, or does not apply.
    OptionError {
        /// No option of that name.
        UnknownOption {
            /// The name.
            option: String,
        } => "there is no option `{option}`",
        /// A value outside of what the option takes.
        InvalidOption {
            /// The name.
            option: String,
            /// What it takes.
            expected: String,
        } => "option `{option}` takes {expected}",
        /// An option that has no meaning for the method chosen.
        InapplicableOption {
            /// The name.
            option: String,
            /// Why it does not apply.
            reason: String,
        } => "option `{option}` does not apply: {reason}",
        /// A value of an option that this version does not offer yet.
        UnsupportedOption {
            /// Its name.
            option: String,
            /// The value asked for.
            value: String,
        } => "option `{option}`: {value} is not available in this version",
        /// An argument of the wrong type.
        InvalidArgument {
            /// The name.
            argument: String,
            /// What it takes.
            expected: String,
        } => "`{argument}` must be {expected}",
    }
}

impl OptionError {
    /// An option out of its range.
    pub(crate) fn invalid(option: &str, expected: &str) -> Self {
        Self::InvalidOption { option: option.to_owned(), expected: expected.to_owned() }
    }
}
