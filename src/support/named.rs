//! Names of choices: each choice has one name, which options, reports, messages and the command line all use.

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
    };
}
pub(crate) use named;
