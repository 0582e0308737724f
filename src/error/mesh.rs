//! Meshes.

use super::detail::Detail;
use super::stage::stage_error;

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
