//! Names of choices: each choice has one name, which options, reports, messages and the command line all use.

/// What has names, for code that reads choices of any kind.
#[cfg_attr(not(feature = "bindings"), allow(dead_code, reason = "the bindings read choices"))]
pub(crate) trait Named: Copy + 'static {
    /// All choices.
    const CHOICES: &'static [Self];

    /// The name of a choice.
    fn label(self) -> &'static str;

    /// The choice with this name.
    fn labelled(name: &str) -> Option<Self>;
}

/// Gives an enum of plain variants its names: `ALL`, `name` and `from_name`. Where names are written in whatever case, as endings of
/// files are, `any case` stands before them. The feature `serde` writes them as their names.
///
/// ```ignore
/// named! { Metric { Mass = "mass", Identity = "identity", Lumped = "lumped" } }
/// named! { MeshFormat any case { Obj = "obj", Off = "off" } }
/// ```
macro_rules! named {
    ($type:ident { $($names:tt)* }) => {
        named! { @ $type, |name, other| name == other, { $($names)* } }
    };
    ($type:ident any case { $($names:tt)* }) => {
        named! { @ $type, str::eq_ignore_ascii_case, { $($names)* } }
    };
    (@ $type:ident, $same:expr, { $($variant:ident = $name:literal),* $(,)? }) => {
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
                let same: fn(&str, &str) -> bool = $same;
                Self::ALL.iter().copied().find(|choice| same(choice.name(), name))
            }
        }

        #[cfg(feature = "serde")]
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> core::result::Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }

        impl crate::support::named::Named for $type {
            const CHOICES: &'static [Self] = Self::ALL;

            fn label(self) -> &'static str {
                self.name()
            }

            fn labelled(name: &str) -> Option<Self> {
                Self::from_name(name)
            }
        }
    };
}
pub(crate) use named;
