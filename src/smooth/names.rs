//! Names that reports carry.

use crate::support::named::named;

/// A method of smoothing, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MethodName {
    /// Tikhonov smoothing: eqs. (3) and (5) of \[Patane09\].
    Tikhonov,
    /// Interpolation of constrained values: eq. (6).
    Interpolate,
    /// Least squares with constraints: eq. (7).
    LeastSquares,
    /// Diffusion, and the low-pass filter of \[Taubin95\].
    LowPass,
    /// The bilateral filter.
    Bilateral,
    /// The smoothest field with prescribed extrema.
    Prescribe,
}

named! { MethodName {
    Tikhonov = "tikhonov", Interpolate = "interpolate", LeastSquares = "leastSquares", LowPass = "lowPass", Bilateral = "bilateral",
    Prescribe = "prescribe",
} }

/// What a method solves: an equation of \[Patane09\], or the reference of a filter there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Equation {
    /// Eq. (3): Tikhonov smoothing with the identity.
    Identity,
    /// Eq. (5): Tikhonov smoothing with a mass matrix.
    Mass,
    /// Eq. (6): interpolation.
    Interpolation,
    /// Eq. (7): least squares with constraints.
    LeastSquares,
    /// Tikhonov smoothing with the finite-element operator.
    Fem,
    /// References 18 and 24: diffusion and the low-pass filter.
    LowPass,
    /// Reference 15: the bilateral filter.
    Bilateral,
}

named! { Equation {
    Identity = "(3)", Mass = "(5)", Interpolation = "(6)", LeastSquares = "(7)", Fem = "fem", LowPass = "[18, 24]",
    Bilateral = "[15]",
} }

/// How a system was solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Route {
    /// By a complex factor on the pattern of L.
    ComplexCholesky,
    /// By a real factor: on the pattern of LᵀL, or of L for harmonic interpolation.
    Cholesky,
    /// By conjugate gradients that a complex factor preconditions.
    CgComplexCholesky,
    /// By conjugate gradients that the real factor of a matrix nearby preconditions: where rounding takes a pivot.
    CgCholesky,
    /// By conjugate gradients that multigrid preconditions, without a factor.
    CgMultigrid,
    /// By conjugate gradients that the diagonal preconditions, without a factor.
    CgJacobi,
    /// From the space of a family, without a factor.
    Family,
    /// There was nothing to solve.
    None,
}

named! { Route {
    ComplexCholesky = "complexCholesky", Cholesky = "cholesky", CgComplexCholesky = "cgComplexCholesky",
    CgCholesky = "cgCholesky", CgMultigrid = "cgMultigrid", CgJacobi = "cgJacobi", Family = "family", None = "none",
} }

/// The precision of the factor that a system was solved with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UsedPrecision {
    /// Double precision, as asked for, or for want of a factor.
    Double,
    /// Single precision, as asked for.
    Single,
    /// Double precision: single was asked for, and was not enough.
    DoubleAfterSingle,
}

named! { UsedPrecision { Double = "double", Single = "single", DoubleAfterSingle = "doubleAfterSingle" } }
