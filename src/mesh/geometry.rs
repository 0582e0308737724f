//! Lengths and areas, without trigonometry.

/// Where twice the area is below this fraction of the longest side squared, the corners lie on one line up to the
/// rounding of the cross product (a few units in the last place of products of two sides), and cotangents are noise.
const ZERO_AREA: f64 = 8.0 * f64::EPSILON;

/// Below this, the squared cross product loses digits to underflow.
const SMALLEST_AREA: f64 = 1e-150;

pub(crate) type Vector = [f64; 3];

#[inline]
pub(crate) fn position(positions: &[f64], vertex: u32) -> Vector {
    let i = 3 * vertex as usize;
    [positions[i], positions[i + 1], positions[i + 2]]
}

#[inline]
pub(crate) fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline]
pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The diagonal of the bounding box of some positions.
pub(crate) fn diagonal(positions: &[f64]) -> f64 {
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for point in positions.chunks_exact(3) {
        for axis in 0..3 {
            bounds[0][axis] = bounds[0][axis].min(point[axis]);
            bounds[1][axis] = bounds[1][axis].max(point[axis]);
        }
    }
    let sides = difference(bounds[1], bounds[0]);
    let longest = sides[0].max(sides[1]).max(sides[2]);
    // The squares of very small sides would be zero.
    if longest > 0.0 { longest * norm(sides.map(|side| side / longest)) } else { 0.0 }
}

/// Areas of the triangles, exactly zero for those whose corners lie on one line up to rounding.
pub(super) fn areas(positions: &[f64], triangles: &[[u32; 3]]) -> Vec<f64> {
    triangles
        .iter()
        .map(|&[i, j, k]| {
            let (p, q, r) = (position(positions, i), position(positions, j), position(positions, k));
            let (a, b, c) = (difference(q, p), difference(r, q), difference(p, r));
            let longest = dot(a, a).max(dot(b, b)).max(dot(c, c));
            let twice = norm(cross(a, b));
            if twice <= ZERO_AREA * longest || twice < SMALLEST_AREA { 0.0 } else { 0.5 * twice }
        })
        .collect()
}
