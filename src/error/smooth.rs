//! Smoothing.

use super::detail::Detail;
use super::stage::stage_error;

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
        /// A constant field is to get extrema.
        ConstantField {} => "the field is constant, so that nothing says how high its extrema should be; prescribe extrema of a field that varies",
        /// A vertex is to be a minimum and a maximum.
        ConflictingExtremum {
            /// The vertex.
            vertex: u32,
        } => "vertex {vertex} is to be a minimum and a maximum; choose one of them",
        /// Neighbours are to be extrema of one kind.
        AdjacentExtrema {
            /// One of them.
            first: u32,
            /// The other one.
            second: u32,
            /// `minima` or `maxima`.
            kind: &'static str,
        } => "vertices {first} and {second} are neighbours, and cannot both be {kind}; choose one of them",
        /// More extrema are wanted than a field has.
        TooFewExtrema {
            /// `minima` or `maxima`.
            kind: &'static str,
            /// How many are wanted.
            wanted: usize,
            /// How many there are.
            found: usize,
        } => "{wanted} {kind} are wanted, but the field whose persistence chooses has {found}; a larger epsilon leaves the smoothed field more of them, and the input may have more",
        /// The values that are to be kept leave no room for a field with the chosen extrema.
        Infeasible {
            /// A vertex from which steps lead up.
            from: u32,
            /// A vertex that they lead to.
            to: u32,
        } => "steps lead up from vertex {from} to vertex {to}, whose values, or the range, leave no room for them; free values (option `values`), a smaller margin or prominence, or other extrema help",
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
