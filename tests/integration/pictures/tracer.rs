//! Pictures against a tracer of rays that tries every triangle, with a camera of its own.

use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{Camera, DrawList, Scene, Surface};

use super::image::{Image, WHITE, bare, coordinate, error, lit};
use crate::support;

type Point = [f64; 3];

/// Half of the angle that the camera sees of the shorter side.
const ANGLE: f64 = 15.0;
/// The room that is left: a ball around every vertex, and from there this part of the distance.
const BALL: f64 = 0.05;
const MARGIN: f64 = 1.03;

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn unit(a: Point) -> Point {
    a.map(|x| x / dot(a, a).sqrt())
}

/// Right, up and towards the camera.
pub(crate) fn axes(towards: Point, up: Point) -> [Point; 3] {
    let right = unit(cross(up, towards));
    [right, cross(unit(towards), right), unit(towards)]
}

/// A camera that sees the whole surface.
pub(crate) struct Eye {
    pub(crate) axes: [Point; 3],
    pub(crate) place: Point,
    focus: f64,
    middle: [f64; 2],
}

impl Eye {
    /// The nearest one, and from there back by the margin.
    pub(crate) fn framing(surface: &Surface, axes: [Point; 3], width: f64, height: f64) -> Self {
        let focus = 0.5 * width.min(height) / ANGLE.to_radians().tan();
        let points: Vec<Point> =
            surface.positions.chunks_exact(3).map(|p| axes.map(|axis| dot([p[0], p[1], p[2]], axis))).collect();
        // At height 0 below the eye's, both sides of the picture have moved in until they touch.
        let side = |axis: usize, half: f64| {
            let slope = half / focus;
            let right = points.iter().map(|p| p[axis] + slope * p[2]).fold(f64::MIN, f64::max);
            let left = points.iter().map(|p| p[axis] - slope * p[2]).fold(f64::MAX, f64::min);
            let sine = slope / slope.hypot(1.0);
            ((right - left) / (2.0 * slope) + BALL / sine, 0.5 * (left + right))
        };
        let [(across, x), (along, y)] = [side(0, 0.5 * width), side(1, 0.5 * height)];
        let z = MARGIN * across.max(along);
        let place = [0, 1, 2].map(|i| x * axes[0][i] + y * axes[1][i] + z * axes[2][i]);
        Self { axes, place, focus, middle: [0.5 * width, 0.5 * height] }
    }

    pub(crate) fn project(&self, point: Point) -> [f64; 2] {
        let [x, y, z] = self.axes.map(|axis| dot(minus(point, self.place), axis));
        [self.middle[0] - self.focus * x / z, self.middle[1] + self.focus * y / z]
    }

    /// Of the ray through a place of the picture.
    pub(crate) fn direction(&self, at: [f64; 2]) -> Point {
        let (x, y) = ((at[0] - self.middle[0]) / self.focus, (self.middle[1] - at[1]) / self.focus);
        [0, 1, 2].map(|i| x * self.axes[0][i] + y * self.axes[1][i] - self.axes[2][i])
    }

    pub(crate) fn middle_of(&self, points: &[[f64; 2]]) -> [f64; 2] {
        [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / points.len() as f64)
    }

    /// A vector as the camera sees it.
    pub(crate) fn turn(&self, vector: Point) -> Point {
        self.axes.map(|axis| dot(vector, axis))
    }
}

/// How much of the pixel at (x, y) a triangle covers: its polygon, cut by the four sides.
pub(crate) fn coverage(corners: &[[f64; 2]; 3], x: f64, y: f64) -> f64 {
    let mut polygon = corners.to_vec();
    for (axis, bound, sign) in [(0, x, 1.0), (0, x + 1.0, -1.0), (1, y, 1.0), (1, y + 1.0, -1.0)] {
        let inside = |p: [f64; 2]| sign * (p[axis] - bound);
        let mut cut = Vec::new();
        for k in 0..polygon.len() {
            let (p, q) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            if inside(p) >= 0.0 {
                cut.push(p);
            }
            if (inside(p) > 0.0) != (inside(q) > 0.0) && inside(p) != inside(q) {
                let part = inside(p) / (inside(p) - inside(q));
                cut.push([0, 1].map(|i| p[i] + part * (q[i] - p[i])));
            }
        }
        polygon = cut;
    }
    let area: f64 = (0..polygon.len())
        .map(|k| {
            let (p, q) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            0.5 * (p[0] * q[1] - p[1] * q[0])
        })
        .sum();
    area.abs()
}

/// Where a ray meets a triangle (Cramer's rule): how far, and the parts of the corners.
fn meet(eye: Point, direction: Point, corners: [Point; 3]) -> Option<(f64, Point)> {
    let (u, v) = (minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    let normal = cross(u, v);
    let facing = dot(direction, normal);
    if facing.abs() < 1e-14 {
        return None;
    }
    let from = minus(eye, corners[0]);
    let far = -dot(from, normal) / facing;
    let at = [0, 1, 2].map(|i| from[i] + far * direction[i]);
    let (b, c) = (dot(cross(at, v), normal) / dot(normal, normal), dot(cross(u, at), normal) / dot(normal, normal));
    let parts = [1.0 - b - c, b, c];
    (far > 0.0 && parts.iter().all(|&part| part >= 0.0)).then_some((far, parts))
}

/// The triangle that a ray meets first, and where in it.
fn first(surface: &Surface, candidates: &[usize], eye: &Eye, at: [f64; 2]) -> Option<(usize, Point)> {
    let direction = eye.direction(at);
    let mut found: Option<(f64, usize, Point)> = None;
    for &t in candidates {
        let corners = surface.triangles[t].map(|corner| point(&surface.positions, corner));
        if let Some((far, parts)) = meet(eye.place, direction, corners)
            && found.is_none_or(|(least, ..)| far < least)
        {
            found = Some((far, t, parts));
        }
    }
    found.map(|(_, t, parts)| (t, parts))
}

fn point(list: &[f64], corner: u32) -> Point {
    [0, 1, 2].map(|i| list[3 * corner as usize + i])
}

/// The color of a place of the surface; from behind, it is lit from behind.
fn shaded(surface: &Surface, list: &DrawList, eye: &Eye, triangle: usize, parts: Point) -> [f64; 3] {
    let corners = surface.triangles[triangle];
    let mix = |value: &dyn Fn(u32) -> f64| (0..3).map(|k| parts[k] * value(corners[k])).sum::<f64>();
    let normal = [0, 1, 2].map(|i| mix(&|corner| point(&surface.normals, corner)[i]));
    let places = corners.map(|corner| point(&surface.positions, corner));
    let outwards = cross(minus(places[1], places[0]), minus(places[2], places[0]));
    let sign = if dot(outwards, minus(eye.place, places[0])) < 0.0 { -1.0 } else { 1.0 };
    let shade = mix(&|corner| list.shades[corner as usize]).clamp(0.0, 1.0) * (list.colors.len() - 1) as f64;
    lit(list.colors[shade.round() as usize], &list.light, unit(eye.turn(normal.map(|x| sign * x))))
}

/// Compares all pixels that lie inside a triangle, or outside of all.
fn compare(name: &str, mesh: &TriMesh, direction: Point, up: Point, size: [u32; 2]) {
    let values = coordinate(mesh, 0);
    let camera = Camera { direction: Some(direction), up: Some(up) };
    let options = morse_smooth::render::SnapshotOptions { camera, ..bare(size[0], size[1]) };
    let scene = Scene::new(mesh);
    let image = Image::decode(&scene.snapshot(&values, &options).unwrap());
    let (surface, list) = (scene.surface(), scene.draw_list(&values, &options.draw).unwrap());
    let eye = Eye::framing(surface, axes(direction, up), f64::from(size[0]), f64::from(size[1]));
    let boxes: Vec<[f64; 4]> = surface
        .triangles
        .iter()
        .map(|corners| {
            let at = corners.map(|corner| eye.project(point(&surface.positions, corner)));
            let (x, y) = (at.map(|p| p[0]), at.map(|p| p[1]));
            let least = |list: [f64; 3]| list[0].min(list[1]).min(list[2]);
            let most = |list: [f64; 3]| list[0].max(list[1]).max(list[2]);
            [least(x), most(x), least(y), most(y)]
        })
        .collect();
    let (mut inside, mut outside) = (0, 0);
    for y in 0..image.height {
        let band: Vec<usize> =
            (0..boxes.len()).filter(|&t| boxes[t][2] <= y as f64 + 1.0 && boxes[t][3] >= y as f64).collect();
        for x in 0..image.width {
            let near: Vec<usize> =
                band.iter().copied().filter(|&t| boxes[t][0] <= x as f64 + 1.0 && boxes[t][1] >= x as f64).collect();
            let at = |u: f64, v: f64| first(surface, &near, &eye, [x as f64 + u, y as f64 + v]);
            let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(u, v)| at(u, v));
            let expected = match at(0.5, 0.5) {
                Some((t, parts)) if corners.iter().all(|other| other.is_some_and(|(s, _)| s == t)) => {
                    inside += 1;
                    shaded(surface, &list, &eye, t, parts)
                }
                None if near.is_empty() => {
                    outside += 1;
                    WHITE.map(f64::from)
                }
                _ => continue,
            };
            let found = image.at(x, y);
            let by = error(found, expected);
            // A triangle that is smaller than what lies between the corners may still be in front: none of these meshes has one.
            assert!(by <= 3.0, "{name} from {direction:?}, at {x}, {y}: {found:?}, not {expected:?}");
        }
    }
    assert!(inside > 300 && outside > 400, "{name}: {inside} pixels inside triangles, {outside} outside");
}

#[test]
fn pixels_are_what_rays_meet() {
    let meshes = [
        ("tetrahedron", shapes::tetrahedron().unwrap()),
        ("sphere", shapes::sphere(2).unwrap()),
        ("torus", shapes::torus(14, 9, 0.3).unwrap()),
        ("Möbius strip", shapes::moebius(15, 3).unwrap()),
        ("Klein bottle", shapes::klein_bottle(13, 9).unwrap()),
        ("terrain", shapes::terrain(7, 9, 4).unwrap()),
        ("holes", support::random_surface(7, &shapes::sphere(2).unwrap(), 0.4)),
        ("any triangles", support::random_complex(4, 8, 12)),
        ("book", support::book_of_three()),
    ];
    let mut random = shapes::Random::new(5);
    for (name, mesh) in &meshes {
        for size in [[240, 180], [120, 200]] {
            let direction = [random.signed(), random.signed(), random.signed()];
            let up = [random.signed(), random.signed(), random.signed()];
            compare(name, mesh, direction, up, size);
        }
    }
}

#[test]
fn a_wide_picture_sees_along_its_shorter_side() {
    let mesh = shapes::torus(12, 8, 0.0).unwrap();
    for size in [[400, 60], [50, 380]] {
        compare("torus", &mesh, [0.3, 1.0, 0.5], [0.0, 0.0, 1.0], size);
    }
}
