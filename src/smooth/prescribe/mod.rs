//! The smoothest field that has exactly the chosen extrema.
//!
//! The fields that rise along the same steps, as one with these extrema does, form a convex set \[Bauer12\], in which the functional of
//! eqs. (3), (5) and (7) has one minimum. The steps are those of the smoothed field, flooded until the chosen extrema are left.

mod dual;
mod extrema;
mod incidence;
mod interior;
mod options;
mod procedure;
mod prominence;
mod quadratic;
mod ranking;
mod representative;
mod steps;

pub use extrema::{Extrema, PersistenceOf};
pub use options::{ExtremumValues, PrescribeOptions, ResultRange};
pub(super) use procedure::start;
