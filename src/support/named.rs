//! Names of choices: each choice has one name, which options, reports, messages and the command line all use.

/// What has names, for code that reads choices of any kind.
pub(crate) trait Named: Copy + 'static {
    /// All choices.
    const CHOICES: &'static [Self];

    /// The name of a choice.
    fn label(self) -> &'static str;
}

/// Gives an enum of plain variants its names: `ALL`, `name` and `from_name`.
///
/// ```ignore
/// named! { Metric { Mass = "mass", Identity = "identity", Lumped = "lumped" } }
/// ```
macro_rules! named {
    ($type:ident { $($variant:ident = $name:literal),* $(,)? }) => {
        #[allow(dead_code, reason = "not every choice is found by its name, or listed, everywhere")]
        impl $type {
            /// All of them, in the order in which they are listed to users.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The name that options, reports and messages use; stable.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// The one with this name.
            #[must_use]
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|choice| choice.name() == name)
            }
        }

        impl crate::support::named::Named for $type {
            const CHOICES: &'static [Self] = Self::ALL;

            fn label(self) -> &'static str {
                self.name()
            }
        }
    };
}
pub(crate) use named;
