//! The solids that mark critical points, about as large as the unit ball.

use crate::mesh::{cross, difference, norm};

/// One solid: flat faces have corners of their own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shape {
    /// x, y, z of every corner; the axis is y.
    pub positions: Vec<[f64; 3]>,
    /// Unit vectors.
    pub normals: Vec<[f64; 3]>,
    /// Three corners each, turned outwards.
    pub triangles: Vec<[u32; 3]>,
}

/// Radii of the spheres around the others: all look as large as the ball.
const TETRAHEDRON: f64 = 1.5;
const OCTAHEDRON: f64 = 1.25;

/// The signs of the eight octants.
const OCTANTS: [[f64; 3]; 8] = [
    [1., 1., 1.],
    [-1., 1., 1.],
    [1., -1., 1.],
    [1., 1., -1.],
    [-1., -1., 1.],
    [-1., 1., -1.],
    [1., -1., -1.],
    [-1., -1., -1.],
];

/// A tetrahedron that stands on a corner: a triangle from above and from most sides.
pub(super) fn tetrahedron() -> Shape {
    // Unit vectors with equal angles between them; √2/3, √6/3 and √8/3 are sines and cosines of these.
    let upper = TETRAHEDRON / 3.0;
    let (far, near, side) = (2.0 * 2.0_f64.sqrt() * upper, 2.0_f64.sqrt() * upper, 6.0_f64.sqrt() * upper);
    let corners = [[0.0, -TETRAHEDRON, 0.0], [0.0, upper, far], [side, upper, -near], [-side, upper, -near]];
    let mut shape = Shape::default();
    for face in [[1, 2, 3], [0, 2, 1], [0, 3, 2], [0, 1, 3]] {
        let points = face.map(|k: usize| corners[k]);
        let normal = cross(difference(points[1], points[0]), difference(points[2], points[0]));
        let length = norm(normal);
        let first = shape.positions.len() as u32;
        shape.positions.extend(points);
        shape.normals.extend([normal.map(|x| x / length); 3]);
        shape.triangles.push([first, first + 1, first + 2]);
    }
    shape
}

/// The corners of the octahedron's face in an octant, turned outwards.
fn octant([x, y, z]: [f64; 3]) -> [[f64; 3]; 3] {
    let corners = [[x, 0., 0.], [0., y, 0.], [0., 0., z]];
    if x * y * z > 0.0 { corners } else { [corners[1], corners[0], corners[2]] }
}

pub(super) fn octahedron() -> Shape {
    let mut shape = Shape::default();
    for signs in OCTANTS {
        let length = norm(signs);
        let first = shape.positions.len() as u32;
        shape.positions.extend(octant(signs).map(|p| p.map(|x| OCTAHEDRON * x)));
        shape.normals.extend([signs.map(|x| x / length); 3]);
        shape.triangles.push([first, first + 1, first + 2]);
    }
    shape
}

/// A ball of 8 · 4^`times` triangles.
pub(super) fn ball(times: usize) -> Shape {
    let mut faces: Vec<[[f64; 3]; 3]> = OCTANTS.map(octant).to_vec();
    for _ in 0..times {
        let middle = |p: [f64; 3], q: [f64; 3]| {
            let sum = [p[0] + q[0], p[1] + q[1], p[2] + q[2]];
            let length = norm(sum);
            sum.map(|x| x / length)
        };
        let parts = |[a, b, c]: [[f64; 3]; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        faces = faces.into_iter().flat_map(parts).collect();
    }
    let mut shape = Shape::default();
    for face in faces {
        let corners = face.map(|point| {
            let known = shape.positions.iter().position(|&p| p == point);
            known.unwrap_or_else(|| {
                shape.positions.push(point);
                shape.positions.len() - 1
            }) as u32
        });
        shape.triangles.push(corners);
    }
    shape.normals.clone_from(&shape.positions);
    shape
}
