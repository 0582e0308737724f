//! The bindings of `morse-smooth`.

mod critical;
mod family;
mod files;
mod levels;
mod mesh;
mod options;
mod persistence;
mod reading;
mod reports;
mod smoother;
mod watching;

pub use files::{read_field, read_mesh, write_mesh};
pub use mesh::RawTriMesh;
pub use smoother::{RawSmoother, smooth};
