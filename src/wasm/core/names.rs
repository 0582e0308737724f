//! Names of choices whose rooms do not give them names yet.

use crate::field::{DeltaScale, ExtremumRule, LinkReading, PathStyle};
use crate::smooth::{Energy, Metric, Operator, Precision, SolverChoice, Unconstrained};
use crate::support::named::named;

named! { DeltaScale { Relative = "relative", Absolute = "absolute" } }
named! { LinkReading { Consecutive = "consecutive", Skip = "skip" } }
named! { ExtremumRule { Strict = "strict", Literal = "literal" } }
named! { PathStyle { Whole = "whole", Merged = "merged" } }
named! { Operator { Paper = "paper", Fem = "fem" } }
named! { SolverChoice { Auto = "auto", Cholesky = "cholesky", ConjugateGradient = "cg" } }
named! { Precision { Double = "double", Single = "single" } }
named! { Metric { Mass = "mass", Identity = "identity", Lumped = "lumped" } }
named! { Energy { Harmonic = "harmonic", Biharmonic = "biharmonic" } }
named! { Unconstrained { Error = "error", Keep = "keep", Mean = "mean" } }
