//! Errors and warnings: one enum per stage, each variant with the ids that a user needs to find the trouble.
//!
//! The name of a variant is its stable code ([`Error::code`]) in Rust and in JavaScript alike.

mod detail;
mod diagnostic;
mod field;
mod interrupt;
mod mesh;
mod option;
#[cfg(feature = "files")]
mod parse;
mod smooth;
mod solve;
mod stage;

pub use detail::Detail;
#[cfg(feature = "files")]
pub use detail::NameList;
pub use diagnostic::Diagnostic;
pub use field::FieldError;
pub use interrupt::{Cancelled, OutOfMemory};
pub use mesh::MeshError;
pub use option::OptionError;
#[cfg(feature = "files")]
pub use parse::ParseError;
pub use smooth::SmoothError;
pub use solve::SolveError;

use core::fmt;

/// Any failure of this crate.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// While reading or writing a file.
    #[cfg(feature = "files")]
    Parse(ParseError),
    /// In the mesh.
    Mesh(MeshError),
    /// In the values of a field.
    Field(FieldError),
    /// In a linear system.
    Solve(SolveError),
    /// In what is asked of a smoothing.
    Smooth(SmoothError),
    /// In the options.
    Option(OptionError),
}

/// `Result` with this crate's [`Error`].
pub type Result<T, E = Error> = core::result::Result<T, E>;

macro_rules! wrap_stage {
    ($($(#[$meta:meta])* $variant:ident($stage:ident)),*) => {
        $($(#[$meta])* impl From<$stage> for Error {
            fn from(error: $stage) -> Self {
                Self::$variant(error)
            }
        })*

        impl Error {
            /// The name of the innermost variant, such as `"NonFiniteValue"`: stable, for programs.
            #[must_use]
            pub fn code(&self) -> &'static str {
                match self {
                    $($(#[$meta])* Self::$variant(error) => error.code(),)*
                }
            }

            /// What a program can use: the ids involved, by name.
            #[must_use]
            pub fn detail(&self) -> Vec<(&'static str, Detail)> {
                match self {
                    $($(#[$meta])* Self::$variant(error) => error.detail(),)*
                }
            }
        }

        impl fmt::Display for Error {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $($(#[$meta])* Self::$variant(error) => error.fmt(f),)*
                }
            }
        }

        impl core::error::Error for Error {
            fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
                match self {
                    $($(#[$meta])* Self::$variant(error) => Some(error),)*
                }
            }
        }
    };
}
wrap_stage!(
    #[cfg(feature = "files")]
    Parse(ParseError),
    Mesh(MeshError),
    Field(FieldError),
    Solve(SolveError),
    Smooth(SmoothError),
    Option(OptionError)
);

/// The errors of stages that can be stopped, or run out of memory.
macro_rules! interrupts {
    ($($stage:ident),*) => {
        $(
            impl From<Cancelled> for $stage {
                fn from(Cancelled: Cancelled) -> Self {
                    Self::Cancelled {}
                }
            }

            impl From<OutOfMemory> for $stage {
                fn from(OutOfMemory { bytes }: OutOfMemory) -> Self {
                    Self::OutOfMemory { bytes }
                }
            }
        )*
    };
}
interrupts!(MeshError, FieldError, SolveError, SmoothError);

#[cfg(feature = "files")]
impl From<OutOfMemory> for ParseError {
    fn from(OutOfMemory { bytes }: OutOfMemory) -> Self {
        Self::OutOfMemory { bytes }
    }
}

impl From<Cancelled> for Error {
    fn from(cancelled: Cancelled) -> Self {
        Self::Smooth(cancelled.into())
    }
}

impl From<OutOfMemory> for Error {
    fn from(shortage: OutOfMemory) -> Self {
        Self::Smooth(shortage.into())
    }
}
