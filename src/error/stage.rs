//! The macro that declares the errors of a stage.

/// Declares a stage's error enum once: variants, fields and messages; code and details follow from the names. Fields behind a
/// semicolon are for the message alone.
macro_rules! stage_error {
    ($(#[$meta:meta])* $name:ident {
        $($(#[$variant_meta:meta])* $variant:ident {
            $($(#[$field_meta:meta])* $field:ident : $ty:ty),* $(,)?
            $(; $($(#[$hidden_meta:meta])* $hidden:ident : $hidden_ty:ty),* $(,)?)?
        } => $message:literal,)*
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq)]
        #[non_exhaustive]
        pub enum $name {
            $($(#[$variant_meta])* $variant {
                $($(#[$field_meta])* $field: $ty,)*
                $($($(#[$hidden_meta])* $hidden: $hidden_ty,)*)?
            },)*
        }

        impl $name {
            /// The variant's name: stable, for programs.
            #[must_use]
            pub fn code(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => stringify!($variant),)*
                }
            }

            /// The variant's fields by name.
            #[must_use]
            pub fn detail(&self) -> Vec<(&'static str, Detail)> {
                match self {
                    $(Self::$variant { $($field,)* .. } => vec![$((stringify!($field), Detail::from($field.clone()))),*],)*
                }
            }
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self {
                    $(Self::$variant { $($field,)* $($($hidden,)*)? } => {
                        $(let _ = $field;)*
                        write!(f, $message)
                    })*
                }
            }
        }

        impl core::error::Error for $name {}
    };
}

pub(super) use stage_error;
