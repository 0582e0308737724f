//! The meshes: one that is easy to cut, one that is not, one with poles, one with a boundary.

use morse_smooth::TriMesh;
use morse_smooth::mesh::shapes;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    Torus,
    Knot,
    Sphere,
    Terrain,
}

pub(crate) const SHAPES: [(&str, Shape); 4] =
    [("torus", Shape::Torus), ("knot", Shape::Knot), ("sphere", Shape::Sphere), ("terrain", Shape::Terrain)];

/// Makes the largest lumped mass of the torus 26 times the smallest at 100,000 vertices.
const TORUS_JITTER: f64 = 0.58;
/// Irregular, but no harder than the torus: the knot is there for its shape.
const KNOT_JITTER: f64 = 0.4;
/// Any; the meshes stay what they are from run to run.
const SEED: u64 = 1;

/// About `size` vertices, in cells that are about square (but for the poles of the sphere, of valence 1440 at a million).
pub(crate) fn build(shape: Shape, size: u32) -> TriMesh {
    let split = |ratio: f64| {
        let long = (ratio * f64::from(size)).sqrt().round() as u32;
        (long, (f64::from(size) / f64::from(long)).round() as u32)
    };
    let mesh = match shape {
        // Around by across: 2π by 0.4 · 2π.
        Shape::Torus => split(2.5),
        // 28.5, the length of the knot, by 0.4 · 2π.
        Shape::Knot => split(11.3),
        Shape::Sphere => split(1.44 * 1.44),
        Shape::Terrain => split(1.0),
    };
    let mesh = match (shape, mesh) {
        (Shape::Torus, (around, across)) => shapes::torus(around, across, TORUS_JITTER),
        (Shape::Knot, (around, across)) => shapes::trefoil_tube(around, across, KNOT_JITTER),
        (Shape::Sphere, (sectors, rings)) => shapes::irregular_sphere(rings, sectors, SEED),
        (Shape::Terrain, (columns, rows)) => shapes::terrain(columns, rows, SEED),
    };
    mesh.expect("sizes are large enough")
}
