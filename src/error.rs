//! Errors and warnings: one enum per stage, each variant with the ids that a user needs to find the trouble.
//!
//! The name of a variant is its stable code ([`Error::code`]) in Rust and in JavaScript alike.

use core::fmt;

/// A value that an error carries: an id, a number, or a name.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Detail {
    /// An id, a line, a length or a number of bytes.
    Integer(u64),
    /// A signed index as it stands in the input.
    Signed(i64),
    /// A number.
    Real(f64),
    /// A name or a piece of the input.
    Text(String),
}

impl From<u32> for Detail {
    fn from(value: u32) -> Self {
        Self::Integer(u64::from(value))
    }
}
impl From<u64> for Detail {
    fn from(value: u64) -> Self {
        Self::Integer(value)
    }
}
impl From<usize> for Detail {
    fn from(value: usize) -> Self {
        Self::Integer(value as u64)
    }
}
impl From<i64> for Detail {
    fn from(value: i64) -> Self {
        Self::Signed(value)
    }
}
impl From<f64> for Detail {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}
impl From<String> for Detail {
    fn from(value: String) -> Self {
        Self::Text(value)
    }
}
impl From<&'static str> for Detail {
    fn from(value: &'static str) -> Self {
        Self::Text(value.to_owned())
    }
}

/// The work was stopped by whoever watches it ([`Watch`](crate::Watch)). Every stage's error has a variant for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cancelled;

/// Memory that cannot be had. Every stage's error has a variant for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutOfMemory {
    /// Bytes needed.
    pub bytes: u64,
}

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

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
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

#[cfg(feature = "files")]
stage_error! {
    /// A file could not be read.
    ParseError {
        /// There are no bytes.
        EmptyFile {} => "the file is empty",
        /// Neither the option, the content nor the file name tells the format.
        UnknownFormat {} => "the format could not be recognised from the content or the file name; name it with the option `format`",
        /// The format is known but not built yet.
        UnsupportedFormat {
            /// Its name.
            format: String,
        } => "reading or writing `{format}` is not supported",
        /// The format is known, but not this variety of it.
        UnsupportedFeature {
            /// The format's name.
            format: String,
            /// What the file holds or asks for.
            feature: String,
        } => "`{format}` files with {feature} are not supported",
        /// The file ends before what its header promises.
        Truncated {
            /// Bytes that the header asks for, from the place where they should start.
            expected: u64,
            /// Bytes that are there.
            available: u64,
        } => "the file is truncated: {expected} bytes are needed where {available} are left",
        /// A text file ends before what its header promises.
        UnexpectedEnd {
            /// 1-based number of the last line.
            line: u64,
            /// What was being read.
            expected: String,
        } => "the file ends at line {line} where {expected} was expected",
        /// Something else stands where a number should.
        InvalidNumber {
            /// 1-based line.
            line: u64,
            /// What stands there (shortened).
            text: String,
        } => "line {line}: `{text}` is not a number",
        /// The header or a keyword is malformed.
        InvalidSyntax {
            /// 1-based line.
            line: u64,
            /// What is wrong.
            problem: String,
        } => "line {line}: {problem}",
        /// The file holds no vertices or no faces.
        MissingElement {
            /// Which element.
            element: String,
        } => "the file has no {element}",
        /// A face names a vertex that does not exist.
        FaceIndexOutOfBounds {
            /// 0-based face.
            face: u64,
            /// The index as written.
            index: i64,
            /// Number of vertices.
            vertices: u64,
        } => "face {face} names vertex {index}, but there are {vertices} vertices",
        /// The column asked for is not there.
        UnknownColumn {
            /// Its name or number.
            column: String,
        } => "there is no column `{column}`",
        /// More vertices or faces than a 32-bit id can name.
        TooLarge {
            /// Which element.
            element: String,
            /// How many.
            count: u64,
        } => "{count} {element} are more than 32-bit ids can name",
        /// The memory that the content needs cannot be had.
        OutOfMemory {
            /// Bytes needed.
            bytes: u64,
        } => "{bytes} bytes of memory are needed, more than can be had here",
        /// A field or array has not one value per vertex (or is no multiple of what it should be).
        LengthMismatch {
            /// The field's name, or `positions` or `triangles`.
            field: String,
            /// Length that fits.
            expected: u64,
            /// Length that came.
            actual: u64,
        } => "`{field}` needs {expected} values, but there are {actual}",
        /// The format has no place for fields, which would be lost.
        FieldsNotSupported {
            /// The format's name.
            format: String,
        } => "`{format}` files cannot hold fields; write PLY or VTK, or no fields",
        /// The format has no binary variety that can be written.
        BinaryNotSupported {
            /// The format's name.
            format: String,
        } => "`{format}` files are written as text only",
        /// A coordinate to write is NaN or infinite.
        NonFinitePosition {
            /// The vertex.
            vertex: u32,
        } => "vertex {vertex} has a coordinate that is not finite",
        /// A value to write is NaN or infinite.
        NonFiniteValue {
            /// The field.
            field: String,
            /// The vertex.
            vertex: u32,
        } => "the value of `{field}` at vertex {vertex} is not finite",
    }
}

stage_error! {
    /// Positions and triangles do not make a mesh.
    MeshError {
        /// No vertices or no triangles.
        EmptyMesh {
            /// Number of vertices.
            vertices: usize,
            /// Number of usable triangles.
            triangles: usize,
        } => "a mesh needs vertices and triangles; there are {vertices} vertices and {triangles} usable triangles",
        /// The length of the positions is no multiple of three.
        PositionsNotTriples {
            /// Length of the array.
            length: usize,
        } => "positions come in triples x, y, z, but there are {length} numbers",
        /// The length of the triangles is no multiple of three.
        TrianglesNotTriples {
            /// Length of the array.
            length: usize,
        } => "triangles have three vertices each, but there are {length}",
        /// More vertices or triangles than ids can name.
        TooManyElements {
            /// How many.
            count: usize,
        } => "{count} elements are more than 32-bit ids can name",
        /// A coordinate is NaN or infinite.
        NonFinitePosition {
            /// The vertex.
            vertex: u32,
        } => "vertex {vertex} has a coordinate that is not finite",
        /// A coordinate is so large that areas overflow.
        PositionOverflow {
            /// The vertex.
            vertex: u32,
        } => "vertex {vertex} has a coordinate beyond 1e75: areas would overflow; use larger units",
        /// A triangle names a vertex that does not exist.
        IndexOutOfBounds {
            /// The triangle.
            triangle: u32,
            /// The vertex it names.
            index: u32,
            /// Number of vertices.
            vertices: usize,
        } => "triangle {triangle} names vertex {index}, but there are {vertices} vertices",
        /// The mesh has no area, so the step asked for is not defined.
        ZeroArea {} => "all triangles have zero area",
        /// A row of weights sums to zero and cannot be normalised.
        ZeroWeightSum {
            /// The vertex.
            vertex: u32,
        } => "the weights around vertex {vertex} sum to zero, so its row cannot be normalised",
        /// The work was stopped by its watcher.
        Cancelled {} => "stopped, as asked; everything is as it was before the call",
        /// The memory that the work needs cannot be had.
        OutOfMemory {
            /// Bytes needed.
            bytes: u64,
        } => "{bytes} bytes of memory are needed, more than can be had here",
    }
}

stage_error! {
    /// Values do not make a field on the mesh.
    FieldError {
        /// Not one value per vertex (and channel).
        LengthMismatch {
            /// Length that fits.
            expected: usize,
            /// Length that came.
            actual: usize;
            /// What may have been meant.
            hint: &'static str,
        } => "{expected} values are needed, one per vertex and channel, but there are {actual}{hint}",
        /// A value is NaN or infinite.
        NonFiniteValue {
            /// The vertex.
            vertex: u32,
        } => "the value at vertex {vertex} is not finite",
        /// The differences of the values overflow.
        RangeOverflow {} => "the range of the values overflows double precision; rescale them",
        /// A level is NaN or infinite.
        NonFiniteLevel {
            /// Its place in the list.
            index: usize,
        } => "level {index} is not finite",
        /// A vertex that was asked for does not exist.
        IndexOutOfBounds {
            /// Its id.
            index: u32,
            /// Number of vertices.
            vertices: usize,
        } => "there is no vertex {index}: there are {vertices} vertices, numbered from 0",
        /// A vertex that was asked for has no value, or none of its triangles has three values.
        MissingValue {
            /// The vertex.
            vertex: u32,
        } => "vertex {vertex} was asked for, but values are missing there or all around it",
        /// A vertex that was to stay an extremum is none.
        NotAnExtremum {
            /// The vertex.
            vertex: u32,
        } => "vertex {vertex} is to be kept, but is neither a minimum nor a maximum of the field",
        /// Nothing is kept where something must be.
        Unconstrained {
            /// The component, numbered by its least vertex.
            component: usize,
            /// That vertex.
            vertex: u32,
        } => "component {component} of the mesh, with vertex {vertex}, needs at least one minimum and one maximum to be kept",
        /// The mesh has no field with the wanted extrema and no others.
        UnavoidableExtremum {
            /// A vertex that would be one all the same.
            vertex: u32,
        } => "vertex {vertex} stays an extremum: the mesh hangs together in single vertices, and has no room for a field without it",
        /// The memory that the result needs cannot be had.
        OutOfMemory {
            /// Bytes needed.
            bytes: u64,
        } => "{bytes} bytes of memory are needed, more than can be had here",
        /// The work was stopped by its watcher.
        Cancelled {} => "stopped, as asked; everything is as it was before the call",
    }
}

stage_error! {
    /// A linear system could not be solved.
    SolveError {
        /// The matrix is not square, or a vector does not fit it.
        DimensionMismatch {
            /// Size that fits.
            expected: usize,
            /// Size that came.
            actual: usize,
        } => "the system has {expected} unknowns, but {actual} were given",
        /// An entry whose mirror image is not stored.
        NotSymmetric {
            /// Its row.
            row: usize,
            /// Its column.
            column: usize,
        } => "the matrix has an entry at ({row}, {column}), but none at ({column}, {row})",
        /// Another sparsity pattern than the one analysed.
        PatternMismatch {} => "the matrix has another pattern than the one that was analysed",
        /// A matrix entry or right-hand side is NaN or infinite.
        NonFiniteEntry {
            /// Its row.
            row: usize,
        } => "row {row} of the system holds a number that is not finite",
        /// A pivot, a diagonal entry or a curvature is not positive.
        NotPositiveDefinite {
            /// The column, hence the unknown.
            column: usize,
        } => "the matrix is not numerically positive definite at unknown {column}",
        /// A preconditioner turned a residual by a right angle or more.
        IndefinitePreconditioner {
            /// Iterations done.
            iterations: usize,
        } => "the preconditioner is not positive definite: found after {iterations} iterations",
        /// An iteration or refinement stopped before its tolerance.
        NotConverged {
            /// Iterations done.
            iterations: usize,
            /// Relative residual or correction reached.
            residual: f64,
        } => "not converged after {iterations} iterations: {residual:e} reached",
        /// The memory needed is more than there is.
        OutOfMemory {
            /// Bytes needed.
            bytes: u64,
        } => "{bytes} bytes of memory are needed, more than can be had here",
        /// The work was stopped by its watcher.
        Cancelled {} => "stopped, as asked; everything is as it was before the call",
    }
}

stage_error! {
    /// A field cannot be smoothed as asked.
    SmoothError {
        /// A component of the mesh has no constrained vertex, so that the equations do not determine its values.
        Unconstrained {
            /// The component, numbered by its least vertex.
            component: usize,
            /// That vertex.
            vertex: u32,
        } => "component {component} of the mesh, with vertex {vertex}, has no constrained vertex, or no value where missing ones are to be filled in; constrain one of its vertices, or choose to keep its values or their mean (option `unconstrained`)",
        /// Not one weight per constrained vertex.
        LengthMismatch {
            /// Number of constrained vertices.
            expected: usize,
            /// Number of weights.
            actual: usize,
        } => "{expected} vertices are constrained, but there are {actual} weights",
        /// The weight of a constraint is not positive and finite.
        InvalidWeight {
            /// Its place among the weights.
            index: usize,
            /// The constrained vertex.
            vertex: u32,
        } => "the weight of vertex {vertex} (number {index}) is not positive and finite",
        /// The system of a smoothing is not positive definite to the precision of a factor.
        NotPositiveDefinite {
            /// A vertex where that is seen.
            column: usize,
        } => "the system is not numerically positive definite at vertex {column}; a larger epsilon helps, where triangles are very thin the weights `intrinsicDelaunay`, and where vertices are closer than a millionth of the mesh's diagonal to weld them with a tolerance",
        /// The solution of a smoothing did not come to its accuracy.
        NotConverged {
            /// Iterations, or steps of refinement, done.
            iterations: usize,
            /// Relative residual or correction reached.
            residual: f64,
        } => "not converged after {iterations} iterations: {residual:e} reached; a larger epsilon helps, where triangles are very thin the weights `intrinsicDelaunay`, and where vertices are closer than a millionth of the mesh's diagonal to weld them with a tolerance",
        /// No ε of a range leaves so few critical points as were asked for.
        TooManyCriticalPoints {
            /// The most that were wanted, saddles with multiplicity.
            wanted: usize,
            /// The fewest that some ε leaves.
            least: usize,
            /// That ε.
            epsilon: f64,
        } => "no epsilon of the range leaves {wanted} critical points or fewer: the fewest are {least}, at epsilon = {epsilon:e}; a range that reaches lower may help",
        /// The steps of a filter make values grow beyond all bounds.
        Diverged {
            /// Steps taken.
            iterations: usize,
        } => "the values grow beyond bounds after {iterations} iterations; a smaller step or weights without negative ones help",
        /// The work was stopped by its watcher.
        Cancelled {} => "stopped, as asked; everything is as it was before the call",
        /// The memory that the work needs cannot be had.
        OutOfMemory {
            /// Bytes needed.
            bytes: u64,
        } => "{bytes} bytes of memory are needed, more than can be had here",
    }
}

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

impl FieldError {
    /// So many values are no field on a mesh with so many vertices and triangles.
    pub(crate) fn length_mismatch(expected: usize, actual: usize, triangles: usize) -> Self {
        let hint = if actual == triangles && triangles > 0 {
            ": one per triangle; average the values of the triangles around each vertex"
        } else {
            ""
        };
        Self::LengthMismatch { expected, actual, hint }
    }
}

impl OptionError {
    /// An option out of its range.
    pub(crate) fn invalid(option: &str, expected: &str) -> Self {
        Self::InvalidOption { option: option.to_owned(), expected: expected.to_owned() }
    }
}

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
