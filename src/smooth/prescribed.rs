//! What is told of a field with prescribed extrema.

use crate::support::named::named;

/// How a field with prescribed extrema was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PrescribeRoute {
    /// By an interior-point method, to the optimum.
    InteriorPoint,
    /// By multipliers of the few steps that the smoothed field lacks, to the optimum, with the factor of the functional alone.
    Dual,
    /// The smoothed field, flooded until it has no other extrema: exact, and not the smoothest.
    Preview,
}

named! { PrescribeRoute { InteriorPoint = "interiorPoint", Dual = "dual", Preview = "preview" } }

/// The extrema of a field that were prescribed, and how near to the smoothest such field it is.
///
/// Energies are ‖Lx‖² + ε‖x − f‖² of the normalised field, in the operator and the norm of the method.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
#[non_exhaustive]
pub struct PrescribedReport {
    /// The minima of the result, ascending: the chosen ones and those that are unavoidable.
    pub minima: Vec<u32>,
    /// Its maxima, ascending.
    pub maxima: Vec<u32>,
    /// Extrema that were not chosen, but that no field on the mesh can do without: parts of it hang on by a single vertex. Ascending.
    pub unavoidable: Vec<u32>,
    /// The energy of the result.
    pub energy: f64,
    /// The energy of the field that is smoothed without prescribed extrema: no other field has less.
    pub unconstrained_energy: f64,
    /// The least rise over a prescribed step, over the one that is asked for: at least 0.9.
    pub least_slack: f64,
    /// The margin between neighbours of prescribed steps, relative to the range of the input.
    pub margin: f64,
    /// The energy lies above that of the best field with these steps by no more than this share of itself; for a preview, above
    /// that of any field.
    pub gap: f64,
    /// Steps of the interior-point method, each with one factorisation; or rounds of the dual method, with none.
    pub iterations: usize,
    /// Solves with those factors.
    pub solves: usize,
    /// How the field was found.
    pub route: PrescribeRoute,
}
