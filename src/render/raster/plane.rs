//! One projected triangle: which samples are inside, and how deep it is there. Plain numbers, as this runs for every triangle.

use super::facets::{Corner, Facets, GRID};

/// Half-planes of a triangle and its depth, over places in steps of the grid.
pub(super) struct Plane {
    /// Edge k is opposite to corner k: `a·x + b·y + c` is not negative inside.
    pub(super) edges: [[i64; 3]; 3],
    /// One over twice the area.
    scale: f64,
    /// The depth at the first corner, and where that is.
    depth: f64,
    place: [f64; 2],
    /// The change of depth along x and along y.
    pub(super) slopes: [f64; 2],
    /// The bounds of the depth.
    least: f64,
    most: f64,
    /// Whether the corners go round as they do in the mesh, seen from outside.
    pub(super) is_front: bool,
}

impl Plane {
    /// Nothing where the triangle has no area.
    pub(super) fn of(facets: &Facets, triangle: u32) -> Option<Self> {
        let [i, j, k] = facets.triangles[triangle as usize];
        let (p, q, r) = (facets.corners[i as usize], facets.corners[j as usize], facets.corners[k as usize]);
        let area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        if area == 0 {
            return None;
        }
        // The picture's y points downwards.
        let is_front = area < 0;
        let sign = if is_front { -1 } else { 1 };
        let [a, b, c] = [half_plane(q, r, sign), half_plane(r, p, sign), half_plane(p, q, sign)];
        let scale = 1.0 / (sign * area) as f64;
        let slope =
            |axis: usize| (a[axis] as f64 * p.depth + b[axis] as f64 * q.depth + c[axis] as f64 * r.depth) * scale;
        Some(Self {
            edges: [a, b, c],
            scale,
            depth: p.depth,
            place: [p.x as f64, p.y as f64],
            slopes: [slope(0), slope(1)],
            least: p.depth.min(q.depth).min(r.depth),
            most: p.depth.max(q.depth).max(r.depth),
            is_front,
        })
    }

    /// The depth in a point. Of slivers, the plane is only known between the corners.
    #[inline]
    pub(super) fn depth(&self, x: f64, y: f64) -> f64 {
        let depth = self.depth + self.slopes[0] * (x - self.place[0]) + self.slopes[1] * (y - self.place[1]);
        if depth < self.least {
            self.least
        } else if depth > self.most {
            self.most
        } else {
            depth
        }
    }

    /// The parts of the corners in a point; outside some are negative.
    pub(super) fn parts(&self, x: f64, y: f64) -> [f64; 3] {
        let [e, f, g] = self.edges;
        [
            (e[0] as f64 * x + e[1] as f64 * y + e[2] as f64) * self.scale,
            (f[0] as f64 * x + f[1] as f64 * y + f[2] as f64) * self.scale,
            (g[0] as f64 * x + g[1] as f64 * y + g[2] as f64) * self.scale,
        ]
    }

    /// How much the depth changes over a sample.
    pub(super) fn steepness(&self) -> f64 {
        (self.slopes[0].abs() + self.slopes[1].abs()) * GRID as f64
    }
}

/// Where `a·x + b·y + c` is not negative is to one side of the line from p to q.
#[inline]
fn half_plane(p: Corner, q: Corner, sign: i64) -> [i64; 3] {
    let (a, b) = (sign * (p.y - q.y), sign * (q.x - p.x));
    [a, b, -(a * p.x + b * p.y)]
}

/// The middle of a sample, in steps of the grid.
#[inline]
pub(super) fn middle(sample: usize) -> i64 {
    sample as i64 * GRID + GRID / 2
}

/// The samples from `first` up to `end` whose middles lie between the smallest and the largest of three places.
#[inline]
pub(super) fn samples([a, b, c]: [i64; 3], first: usize, end: usize) -> (usize, usize) {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    // Shifts round downwards, of negative numbers too.
    let from = ((low + GRID / 2 - 1) >> BITS).max(first as i64);
    let to = ((high - GRID / 2) >> BITS).min(end as i64 - 1);
    if from <= to { (from as usize, to as usize + 1) } else { (first, first) }
}

/// How many bits the grid's steps to a sample take.
const BITS: u32 = GRID.trailing_zeros();
