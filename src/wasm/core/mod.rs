//! The bindings of `morse-smooth`.

mod critical;
mod family;
mod levels;
mod mesh;
mod options;
mod persistence;
mod reading;
mod reports;
mod smoother;
mod watching;

pub use mesh::RawTriMesh;
pub use smoother::{RawSmoother, smooth};
