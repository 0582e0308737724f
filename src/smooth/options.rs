//! What a [`Smoother`] is made with.

#[cfg(doc)]
use super::Smoother;
use crate::operators::LaplacianWeights;
use crate::support::named::named;

/// Which solver a [`Smoother`] uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SolverChoice {
    /// The fastest route that is exact for the system at hand, and leaner ones where memory is short. The default.
    #[default]
    Auto,
    /// Sparse Cholesky with iterative refinement, complex where that is exact (see `SolverReport::route`).
    Cholesky,
    /// Conjugate gradients on the system in factored form, preconditioned by multigrid where L is symmetric: little memory.
    ConjugateGradient,
}

named! { SolverChoice { Auto = "auto", Cholesky = "cholesky", ConjugateGradient = "cg" } }

/// The operator whose square is the smoothness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Operator {
    /// LᵀL, as in \[Patane09\]: what ε does depends on how fine the mesh is. The default.
    #[default]
    Paper,
    /// L M⁻¹ L beside εM, with the cotangent Laplacian L and the lumped masses M in the mesh's own units: finite elements
    /// for the Laplace–Beltrami operator, so that what ε does depends on the surface alone. Its eigenfunctions are damped
    /// by ε/(λ² + ε).
    Fem,
}

named! { Operator { Paper = "paper", Fem = "fem" } }

/// The precision of factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// Double. The default.
    #[default]
    Double,
    /// Single, refined to double accuracy: half the memory, and faster where the system is well conditioned. Where it is
    /// not, the factor is computed in double precision after all.
    Single,
}

named! { Precision { Double = "double", Single = "single" } }

/// What a [`Smoother`] is made with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SmootherOptions {
    /// The weights of L. Default cotangent.
    pub weights: LaplacianWeights,
    /// The operator. Default the paper's.
    pub operator: Operator,
    /// The solver. Default automatic.
    pub solver: SolverChoice,
    /// The precision of factors; conjugate gradients without a factor are always in double. Default double.
    pub precision: Precision,
    /// Whether reports tell how far results move when the input does, which costs some more solves. Default false.
    pub bounds: bool,
}

/// The matrix B that measures ‖x − f‖.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// B = I: eq. (3).
    Identity,
    /// B is the Galerkin mass matrix: eq. (5). The default.
    #[default]
    Mass,
    /// B is the lumped mass matrix: eq. (5) with a diagonal.
    Lumped,
}

named! { Metric { Mass = "mass", Identity = "identity", Lumped = "lumped" } }
