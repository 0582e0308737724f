//! Polygons become triangles: a fan of the first corner where that is right, else by cutting off ears.

use super::scan::{push, reserve};
use crate::error::ParseError;

/// How far corners may lie from the plane of their polygon, as a part of its size, before a warning says so: quadrilaterals of
/// curved surfaces are never quite flat.
const FLAT: f64 = 0.02;

/// Tests of a corner against a triangle, for each corner of a polygon, after which the rest becomes a fan: no polygon that a
/// surface is made of needs so many, and reading must end.
const TESTS: usize = 1000;

/// How many sides of a polygon are compared with each other.
const MOST_SIDES: usize = 200;

/// What was found about a polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// It lies in a plane and does not cross itself.
    Flat,
    /// Its triangles are a guess.
    Irregular,
}

/// A corner in the plane of its polygon.
type Point = [f64; 2];

/// Puts right the fan that stands in `triangles` for one polygon of four corners or more.
pub(super) fn triangulate(triangles: &mut [u32], positions: &[f64]) -> Result<Shape, ParseError> {
    let count = triangles.len() / 3 + 2;
    let corner = |place: usize| match place {
        0 => triangles[0],
        1 => triangles[1],
        _ => triangles[3 * (place - 2) + 2],
    };
    let point = |place: usize| {
        let start = 3 * corner(place) as usize;
        [positions[start], positions[start + 1], positions[start + 2]]
    };
    // Relative to the first corner, or far from the origin nothing would be left of small polygons.
    let origin = point(0);
    let relative = |place: usize| {
        let p = point(place % count);
        [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]
    };
    let mut normal = [0.0; 3];
    for place in 0..count {
        let (p, q) = (relative(place), relative(place + 1));
        for axis in 0..3 {
            let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
            normal[axis] += p[b] * q[c] - p[c] * q[b];
        }
    }
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return Ok(Shape::Irregular);
    }
    let dominant = (0..3).fold(0, |best, axis| if normal[axis].abs() > normal[best].abs() { axis } else { best });
    let (mut u, mut v) = ((dominant + 1) % 3, (dominant + 2) % 3);
    if normal[dominant] < 0.0 {
        (u, v) = (v, u);
    }
    let mut points: Vec<Point> = Vec::new();
    reserve(&mut points, count)?;
    let (mut size, mut off_plane) = (0.0_f64, 0.0_f64);
    for place in 0..count {
        let p = relative(place);
        let height = (p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2]) / length;
        size = size.max(p[0].abs()).max(p[1].abs()).max(p[2].abs());
        off_plane = off_plane.max(height.abs());
        points.push([p[u], p[v]]);
    }
    let mut shape = if off_plane > FLAT * size { Shape::Irregular } else { Shape::Flat };
    if is_fan(&points) {
        return Ok(shape);
    }
    let mut corners = Vec::new();
    reserve(&mut corners, count)?;
    corners.extend((0..count).map(corner));
    let mut ears = Vec::new();
    if !cut_ears(&points, &mut ears)? || crosses_itself(&points) {
        shape = Shape::Irregular;
    }
    for (triangle, ear) in triangles.chunks_exact_mut(3).zip(ears) {
        for (slot, place) in triangle.iter_mut().zip(ear) {
            *slot = corners[place as usize];
        }
    }
    Ok(shape)
}

/// Twice the signed area of a triangle.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether the fan of the first corner covers the polygon: its rays turn one way, and less than once round.
fn is_fan(points: &[Point]) -> bool {
    let rays = points.windows(2).skip(1);
    let forward = rays.clone().all(|pair| turn(points[0], pair[0], pair[1]) > 0.0);
    // The angle at the first corner comes to a half turn or more only where the rays leave the half-plane of the first one, and
    // a polygon that crosses itself comes back.
    let sides = points.iter().skip(2).map(|&point| turn(points[0], points[1], point) > 0.0);
    let changes = sides.clone().zip(sides.skip(1)).filter(|(a, b)| a != b).count();
    forward && changes <= 1
}

/// Whether two sides cross. Of polygons with very many corners only the first are looked at, for it takes the square of their number.
fn crosses_itself(points: &[Point]) -> bool {
    let count = points.len();
    let looked_at = count.min(MOST_SIDES);
    let side = |place: usize| [points[place], points[(place + 1) % count]];
    (0..looked_at).any(|first| {
        let [a, b] = side(first);
        (first + 2..looked_at).any(|second| {
            let [c, d] = side(second);
            let is_apart = |p, q, r, s| turn(p, q, r) * turn(p, q, s) >= 0.0;
            (second + 1) % count != first && !is_apart(a, b, c, d) && !is_apart(c, d, a, b)
        })
    })
}

/// Cuts off ears until a triangle is left; false where none was found and the rest became a fan.
fn cut_ears(points: &[Point], ears: &mut Vec<[u32; 3]>) -> Result<bool, ParseError> {
    let count = points.len();
    reserve(ears, count - 2)?;
    let mut left: Vec<u32> = Vec::new();
    reserve(&mut left, count)?;
    left.extend(0..count as u32);
    let at = |id: u32| points[id as usize];
    let mut tests = TESTS.saturating_mul(count);
    // Where the next ear is looked for, and how many corners have been looked at without finding one.
    let (mut place, mut looked) = (0, 0);
    // Ears without area only where there are no others.
    let mut is_strict = true;
    while left.len() > 3 {
        let length = left.len();
        let ids = [left[(place + length - 1) % length], left[place % length], left[(place + 1) % length]];
        let [a, b, c] = ids.map(at);
        let area = turn(a, b, c);
        let is_convex = if is_strict { area > 0.0 } else { area >= 0.0 };
        let mut is_ear = is_convex;
        if is_convex && area > 0.0 {
            for &other in &left {
                let p = at(other);
                tests = tests.saturating_sub(1);
                let is_inside = turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
                if is_inside && !ids.contains(&other) && p != a && p != b && p != c {
                    is_ear = false;
                    break;
                }
            }
        }
        if is_ear {
            push(ears, ids)?;
            left.remove(place % length);
            (looked, is_strict) = (0, true);
            // Every second corner, or long thin triangles would gather at one.
            place = if place >= left.len() { 0 } else { place + 1 };
        } else {
            place += 1;
            looked += 1;
        }
        place %= left.len();
        if tests == 0 || (looked > left.len() && !is_strict) {
            for pair in left[1..].windows(2) {
                push(ears, [left[0], pair[0], pair[1]])?;
            }
            return Ok(false);
        }
        if looked > left.len() {
            (looked, is_strict) = (0, false);
        }
    }
    push(ears, [left[0], left[1], left[2]])?;
    // The last one may lie the wrong way round.
    Ok(ears.iter().all(|ear| {
        let [a, b, c] = ear.map(at);
        turn(a, b, c) >= 0.0
    }))
}
