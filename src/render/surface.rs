//! The mesh as it is drawn: in the unit ball, facing outwards, with smooth normals where the surface is smooth.

use crate::mesh::{Connectivity, TriMesh, cross, difference, dot, norm};

/// Cosine of the angle between two triangles from which on their edge is a crease: 80°. The edges of boxes are sharp then, and
/// rough surfaces are not.
const CREASE: f64 = 0.173_6;
/// Height over the smaller width below which something lies flat, so that z is up.
const FLAT: f64 = 0.75;
/// Thickness over width below which something is plane, and seen straight from the front.
const PLANE: f64 = 0.02;
/// Three times the enclosed volume over area and radius is about 1 for a ball and 0 for a sheet, which has no inside.
const INSIDE: f64 = 0.1;
/// The same of closed surfaces: they have an inside, however thin.
const ROUNDING: f64 = 1e-9;

const NONE: u32 = u32::MAX;

/// An axis that points upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The second coordinate.
    Y,
    /// The third coordinate.
    Z,
}

/// The triangles of a mesh for drawing.
///
/// # Properties
/// Moved and scaled so that the middle of the bounding box is the origin and the farthest vertex at distance 1. Neighbouring
/// triangles are turned alike, outwards where there is an inside. A vertex of the mesh is there once for each sheet that meets in it:
/// at creases, where more than two triangles share an edge, and where a surface with one side comes back turned over.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// x, y, z of every corner.
    pub positions: Vec<f64>,
    /// Unit vectors: the mean direction of the triangles at each corner, by area.
    pub normals: Vec<f64>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
    /// The vertex of the mesh that each corner is.
    pub vertices: Vec<u32>,
    /// What points up: z for things that lie flat, else y.
    pub up: Axis,
    /// The coordinate along which a plane mesh has no thickness.
    pub plane: Option<usize>,
    /// The point of the mesh that is drawn at the origin.
    pub center: [f64; 3],
    /// The length in the mesh that is drawn with length 1.
    pub size: f64,
    /// Area, as drawn.
    pub area: f64,
    /// Where the corners of each vertex start; they follow one another.
    first_corner: Vec<u32>,
    /// Whether each triangle belongs to a closed part of the surface, whose inside nobody sees.
    closed: Vec<bool>,
}

impl Surface {
    /// O(vertices + triangles).
    #[must_use]
    pub fn new(mesh: &TriMesh) -> Self {
        let extent = Extent::of(mesh);
        let connectivity = mesh.connectivity();
        let placed: Vec<[f64; 3]> = (0..mesh.vertex_count() as u32).map(|v| extent.place(mesh.position(v))).collect();
        let mut faces: Vec<[f64; 3]> = connectivity.triangles().iter().map(|t| face(&placed, t)).collect();
        let Turned { turned, closed } = turned(connectivity, &placed, &faces);
        for (face, &turned) in faces.iter_mut().zip(&turned) {
            if turned {
                *face = face.map(|x| -x);
            }
        }
        let mut surface = Self {
            positions: Vec::new(),
            normals: Vec::new(),
            triangles: connectivity.triangles().to_vec(),
            vertices: Vec::new(),
            up: extent.up(),
            plane: extent.plane(),
            center: extent.center,
            size: extent.size,
            // Not the mesh's, which is too small a number for what is tiny.
            area: faces.iter().map(|&face| 0.5 * norm(face)).sum(),
            first_corner: Vec::new(),
            closed,
        };
        surface.split(connectivity, &faces, &turned);
        for (corners, &turned) in surface.triangles.iter_mut().zip(&turned) {
            if turned {
                corners.swap(0, 1);
            }
        }
        for &v in &surface.vertices {
            surface.positions.extend(placed[v as usize]);
        }
        surface
    }

    /// Where a point of the mesh is drawn.
    #[must_use]
    pub fn place(&self, point: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = difference(point, self.center);
        [x / self.size, y / self.size, z / self.size]
    }

    /// What stands upright on the surface at a vertex: the mean of its normals.
    pub(super) fn normal_at(&self, vertex: u32) -> [f64; 3] {
        let corners = self.first_corner[vertex as usize] as usize..self.first_corner[vertex as usize + 1] as usize;
        let sum = self.normals.as_chunks::<3>().0[corners].iter().fold([0.0; 3], |sum, &normal| plus(sum, normal));
        unit_or_up(sum)
    }

    /// Whether both sides of the surface can be seen at a vertex.
    pub(super) fn is_open_at(&self, mesh: &TriMesh, vertex: u32) -> bool {
        mesh.connectivity().star(vertex).iter().any(|&t| !self.closed[t as usize])
    }

    /// Gives every fan of triangles that hang together smoothly around a vertex a corner of its own, with its normal.
    fn split(&mut self, connectivity: &Connectivity, faces: &[[f64; 3]], turned: &[bool]) {
        let is_smooth = smooth_edges(connectivity, faces, turned);
        let mut corners = vec![[NONE; 3]; faces.len()];
        let mut fan = Vec::new();
        for v in 0..connectivity.vertex_count() as u32 {
            self.first_corner.push(self.vertices.len() as u32);
            for &start in connectivity.star(v) {
                let place = place_of(connectivity, start, v);
                if corners[start as usize][place] != NONE {
                    continue;
                }
                let corner = self.vertices.len() as u32;
                corners[start as usize][place] = corner;
                fan.push(start);
                let mut sum = [0.0; 3];
                while let Some(t) = fan.pop() {
                    sum = plus(sum, faces[t as usize]);
                    let place = place_of(connectivity, t, v);
                    let sides = connectivity.triangle_edges()[t as usize];
                    for edge in [sides[place], sides[(place + 2) % 3]] {
                        let Some(next) = connectivity.across(t, edge).filter(|_| is_smooth[edge as usize]) else {
                            continue;
                        };
                        let place = place_of(connectivity, next, v);
                        if corners[next as usize][place] == NONE {
                            corners[next as usize][place] = corner;
                            fan.push(next);
                        }
                    }
                }
                self.vertices.push(v);
                self.normals.extend(unit_or_up(sum));
            }
        }
        self.first_corner.push(self.vertices.len() as u32);
        self.triangles = corners;
    }
}

/// Where the mesh is, and how large.
struct Extent {
    center: [f64; 3],
    /// From the center to the farthest vertex.
    size: f64,
    widths: [f64; 3],
}

impl Extent {
    /// The bounding box of the vertices that belong to a triangle.
    fn of(mesh: &TriMesh) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let vertices = || mesh.connectivity().triangles().as_flattened().iter().map(|&v| mesh.position(v));
        for point in vertices() {
            for i in 0..3 {
                low[i] = low[i].min(point[i]);
                high[i] = high[i].max(point[i]);
            }
        }
        let center = [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]));
        let widths = [0, 1, 2].map(|i| high[i] - low[i]);
        // Scaled first, so that squares of small lengths are not lost.
        let widest = widths[0].max(widths[1]).max(widths[2]);
        if widest <= 0.0 {
            return Self { center, size: 1.0, widths };
        }
        let farthest = vertices().map(|p| norm(difference(p, center).map(|x| x / widest))).fold(0.0, f64::max);
        Self { center, size: (widest * farthest).max(f64::MIN_POSITIVE), widths }
    }

    fn place(&self, point: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = difference(point, self.center);
        [x / self.size, y / self.size, z / self.size]
    }

    fn up(&self) -> Axis {
        let [x, y, z] = self.widths;
        if z < FLAT * x.min(y) { Axis::Z } else { Axis::Y }
    }

    fn plane(&self) -> Option<usize> {
        let widths = self.widths;
        (0..3).find(|&i| widths[i] <= PLANE * widths[(i + 1) % 3].min(widths[(i + 2) % 3]))
    }
}

/// Twice the area of a triangle, along its normal.
fn face(placed: &[[f64; 3]], corners: &[u32; 3]) -> [f64; 3] {
    let [p, q, r] = corners.map(|v| placed[v as usize]);
    cross(difference(q, p), difference(r, p))
}

/// Which triangles are turned over, and which belong to a closed part.
struct Turned {
    turned: Vec<bool>,
    closed: Vec<bool>,
}

/// Turns triangles over, so that neighbours agree and what has an inside faces outwards.
fn turned(connectivity: &Connectivity, placed: &[[f64; 3]], faces: &[[f64; 3]]) -> Turned {
    let mut turned = vec![false; faces.len()];
    let mut closed = vec![false; faces.len()];
    let mut seen = vec![false; faces.len()];
    let mut patch = Vec::new();
    for first in 0..faces.len() as u32 {
        if seen[first as usize] {
            continue;
        }
        seen[first as usize] = true;
        patch.clear();
        patch.push(first);
        let (mut next, mut is_closed) = (0, true);
        while next < patch.len() {
            let t = patch[next];
            next += 1;
            for edge in connectivity.triangle_edges()[t as usize] {
                let Some(other) = connectivity.across(t, edge) else {
                    is_closed = false;
                    continue;
                };
                let differ = is_forward(connectivity, t, edge) == is_forward(connectivity, other, edge);
                let turn = turned[t as usize] != differ;
                if seen[other as usize] {
                    is_closed &= turned[other as usize] == turn;
                } else {
                    seen[other as usize] = true;
                    turned[other as usize] = turn;
                    patch.push(other);
                }
            }
        }
        // Patches of one component with different insides are rare, and only the solids on them would show it.
        let (mut volume, mut area, mut count) = (0.0, 0.0, 0);
        for &t in &patch {
            let corner = placed[connectivity.triangles()[t as usize][0] as usize];
            let sign = if turned[t as usize] { -1.0 } else { 1.0 };
            volume += sign * dot(corner, faces[t as usize]);
            area += norm(faces[t as usize]);
            count += usize::from(turned[t as usize]);
            closed[t as usize] = is_closed;
        }
        let has_inside = volume.abs() > if is_closed { ROUNDING } else { INSIDE } * area;
        // What has no inside is left as most of it is given.
        if if has_inside { volume < 0.0 } else { 2 * count > patch.len() } {
            for &t in &patch {
                turned[t as usize] = !turned[t as usize];
            }
        }
    }
    Turned { turned, closed }
}

/// Whether normals are averaged across each edge.
fn smooth_edges(connectivity: &Connectivity, faces: &[[f64; 3]], turned: &[bool]) -> Vec<bool> {
    let is_smooth = |edge: u32| {
        let &[s, t] = connectivity.triangles_of_edge(edge) else { return false };
        let (n, m) = (faces[s as usize], faces[t as usize]);
        let differ = is_forward(connectivity, s, edge) == is_forward(connectivity, t, edge);
        let agree = (turned[s as usize] != turned[t as usize]) == differ;
        agree && dot(n, m) >= CREASE * norm(n) * norm(m)
    };
    (0..connectivity.edges().len() as u32).map(is_smooth).collect()
}

/// Whether a triangle passes one of its edges from the smaller vertex to the larger.
fn is_forward(connectivity: &Connectivity, t: u32, edge: u32) -> bool {
    let place = connectivity.triangle_edges()[t as usize].iter().position(|&side| side == edge).unwrap_or_default();
    connectivity.triangles()[t as usize][place] == connectivity.edges()[edge as usize][0]
}

fn place_of(connectivity: &Connectivity, t: u32, v: u32) -> usize {
    connectivity.triangles()[t as usize].iter().position(|&corner| corner == v).unwrap_or_default()
}

pub(super) fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn unit_or_up(vector: [f64; 3]) -> [f64; 3] {
    let length = norm(vector);
    if length > 0.0 { vector.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}
