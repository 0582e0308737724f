//! The solutions for all ε at once: a rational Krylov space.
//!
//! x(ε) = (S + εB)⁻¹εBf, with S = LᵀWL, lies for all ε in a range, to high accuracy, in the space that a few of these solutions
//! and their first five derivatives by ε span. Each shift, as the ε of these solutions are called, takes one factor and a few solves
//! with it. Projected onto the space, the system of any ε is a small one, which one diagonalisation solves for all of them
//! \[Guettel13\].

mod block;
mod build;
mod choose;
mod curves;
mod eigen;
mod estimate;
mod growth;
mod lives;
mod members;
mod noise;
mod options;
mod pencil;
mod reach;
mod small;
mod space;
mod traces;

pub use choose::EpsilonRule;
pub use curves::{Sweep, SweepOptions};
pub use lives::ExtremumLife;
pub use members::Family;
pub use options::FamilyOptions;
