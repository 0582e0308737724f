//! Fields.

use super::detail::Detail;
use super::stage::stage_error;

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
        } => "the value at vertex {vertex} is not finite; where NaN stands for a missing value, the option `missing` says what becomes of it: \"omit\" leaves a hole there, \"fill\" has smoothing find a value",
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
