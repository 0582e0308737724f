//! What pictures show, against what they should: projections, light and coverage computed anew, and facts that need no computing.

mod framing;
mod gaps;
mod glyphs;
pub(crate) mod image;
mod invariance;
mod lines;
mod maps;
mod planes;
mod random;
mod refused;
mod shapes;
mod sheets;
mod surfaces;
mod tracer;
