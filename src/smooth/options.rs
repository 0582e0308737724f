//! What a [`Smoother`] is made with, and what it tells while it works.

#[cfg(doc)]
use super::Smoother;
use crate::operators::LaplacianWeights;

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

/// A step of the work, for progress displays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Ordering and analysing the pattern of L, or of LᵀL once that is assembled; again only where the route changes.
    Analysis,
    /// The numeric factorisation; once per ε and metric. Left out where a route has no factor, as analysis is.
    Factorization,
    /// Solving and refining.
    Solve,
    /// Counting critical points and norms.
    Report,
}

impl Phase {
    /// A short name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Analysis => "analysis",
            Self::Factorization => "factorization",
            Self::Solve => "solve",
            Self::Report => "report",
        }
    }
}

/// Told at the start of every phase, with the fraction of the work that is done; that goes back where a route is given up
/// for another one.
pub type Progress<'a> = &'a mut dyn FnMut(Phase, f64);
