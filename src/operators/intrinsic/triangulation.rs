//! Triangles that know the lengths of their sides and no positions, and flips of their edges.
//!
//! The surface is glued of triangles side by side, and nothing else is asked of it: a triangle may be glued to itself, have a
//! vertex at several corners, or share several sides with another. Neither need it be oriented.

use super::lengths::{EQUILATERAL, area, four_areas_cotangent};
use crate::error::Cancelled;
use crate::mesh::Connectivity;
use crate::support::pieces::{pieces, ranges};
use crate::support::watch::Watch;

/// No side.
const NONE: u32 = u32::MAX;

/// An edge is Delaunay where cot α + cot β is not less than zero by more than its rounding: some units in the last place of
/// the squared sides over the areas. Without a tolerance, four vertices on a circle could be flipped to and fro.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Flips per edge at most. Without rounding the algorithm ends by itself, since every flip lowers the sum of squared sides
/// over the area of all triangles \[Bobenko07\]; with rounding that is no proof. In the plane no edge comes back, so n
/// vertices need n²/2 flips at most and a mesh of up to 1000 edges is never cut short; usual surfaces need a few
/// flips per edge. Where flips run out, edges that are not Delaunay keep their negative weights.
const FLIPS_PER_EDGE: u64 = 1000;

/// Areas up to this share of the squared longest side are taken for none, and what stands for them in weights: as if the triangle were
/// 2e-5 times as high as long. Vertices that coincide are held together with a weight of 25,000.
const NOTHING: f64 = 1e-15;
const SUBSTITUTE: f64 = 1e-5;
/// Squares of lengths below this are lost, where the largest difference of coordinates is about 1.
const POINT: f64 = 1e-140;

/// The work with a triangle that is copied or weighed, with an edge that is looked at, and with a flip.
const TRIANGLE: u64 = 80;
const LOOK: u64 = 60;
const FLIP: u64 = 150;

/// A side is `3t + c` as a half-edge of `Connectivity` is: from corner c of triangle t to corner (c + 1) % 3.
pub(super) struct Triangulation {
    corners: Vec<[u32; 3]>,
    /// The edge of every side.
    edges: Vec<[u32; 3]>,
    /// The two sides at an edge; `NONE` at a boundary and where more than two meet, which is never flipped.
    sides: Vec<[u32; 2]>,
    /// Whether the two sides of an edge run the same way. The vertices at its ends do not tell where they are one.
    same_way: Vec<bool>,
    lengths: Vec<f64>,
    areas: Vec<f64>,
    /// Whether a triangle has no area, or one that only rounding tells of: `areas` then has a tiny one in its place.
    is_flat: Vec<bool>,
}

impl Triangulation {
    /// The bytes that a triangulation of `m` triangles takes, with what is needed to flip and to weigh its edges.
    pub(super) fn bytes(edges: usize, m: usize) -> u64 {
        // Corners, edges and areas of the triangles; sides and lengths of the edges, and how the sides run. Besides, while edges
        // are flipped, two rounds of them and whether they are in one, or after that their weights.
        33 * m as u64 + 17 * edges as u64 + 9 * edges as u64
    }

    pub(super) fn new(
        connectivity: &Connectivity,
        (lengths, areas): (Vec<f64>, Vec<f64>),
        watch: &Watch<'_>,
    ) -> Result<Self, Cancelled> {
        let corners = connectivity.triangles().to_vec();
        let edges = connectivity.triangle_edges().to_vec();
        let mut sides = vec![[NONE; 2]; lengths.len()];
        let mut same_way = vec![false; lengths.len()];
        for range in ranges(corners.len(), TRIANGLE, watch) {
            for t in range? {
                for c in 0..3 {
                    let edge = edges[t][c] as usize;
                    if connectivity.triangles_of_edge(edge as u32).len() == 2 {
                        let upwards = corners[t][c] < corners[t][(c + 1) % 3];
                        let second = usize::from(sides[edge][0] != NONE);
                        sides[edge][second] = (3 * t + c) as u32;
                        same_way[edge] = if second == 1 { same_way[edge] == upwards } else { upwards };
                    }
                }
            }
        }
        let mut triangulation = Self { corners, edges, sides, same_way, lengths, areas, is_flat: Vec::new() };
        triangulation.is_flat = (0..triangulation.areas.len()).map(|t| triangulation.is_without_area(t)).collect();
        Ok(triangulation)
    }

    /// Flips edges until all that have two triangles are Delaunay.
    ///
    /// In rounds over all edges that a flip of the last round has touched: on a fan of n triangles, one edge after the other
    /// to its end would take about n² flips, where rounds divide it again and again.
    pub(super) fn make_delaunay(&mut self, watch: &Watch<'_>) -> Result<(), Cancelled> {
        let count = self.sides.len();
        let mut left = FLIPS_PER_EDGE * count as u64;
        let mut queued = vec![true; count];
        let mut round: Vec<u32> = (0..count as u32).collect();
        // A round has no edge twice.
        let mut next = Vec::with_capacity(count);
        while !round.is_empty() {
            for piece in pieces(&round, LOOK, watch) {
                let mut flips = 0;
                for &edge in piece? {
                    queued[edge as usize] = false;
                    if left == 0 || self.is_delaunay(edge) {
                        continue;
                    }
                    let Some(around) = self.flip(edge) else { continue };
                    flips += 1;
                    left -= 1;
                    for near in around {
                        if !queued[near as usize] {
                            queued[near as usize] = true;
                            next.push(near);
                        }
                    }
                }
                watch.tick(FLIP * flips)?;
            }
            round.clear();
            core::mem::swap(&mut round, &mut next);
        }
        Ok(())
    }

    /// Whether the angles opposite to an edge add up to π at most. Edges that cannot be flipped are left as they are; one
    /// whose sides belong to the same triangle always is Delaunay, as two equal sides are opposite to acute angles.
    fn is_delaunay(&self, edge: u32) -> bool {
        let [side, other] = self.sides[edge as usize];
        if side == NONE || side / 3 == other / 3 {
            return true;
        }
        let [first, second] = [side, other].map(|side| self.opposite(side));
        let [s, t] = [side, other].map(|side| self.areas[side as usize / 3]);
        let sum = first.four_areas_cotangent * t + second.four_areas_cotangent * s;
        sum >= -ROUNDING * (first.squares * t + second.squares * s)
    }

    fn opposite(&self, side: u32) -> Opposite {
        let [r, p, q] =
            rotated(self.edges[side as usize / 3], side as usize % 3).map(|edge| self.lengths[edge as usize]);
        Opposite { four_areas_cotangent: four_areas_cotangent(r, p, q), squares: p * p + q * q + r * r }
    }

    /// Exchanges an edge between two different triangles for the other diagonal of their union, and returns the edges
    /// around. Does nothing where a triangle of the result would have no area, which only rounding can bring about.
    fn flip(&mut self, edge: u32) -> Option<[u32; 4]> {
        let e = edge as usize;
        if self.same_way[e] {
            self.mirror(self.sides[e][1] / 3);
        }
        let [side, other] = self.sides[e].map(|side| side as usize);
        let ((t, c), (u, d)) = ((side / 3, side % 3), (other / 3, other % 3));
        // The triangles (i, j, k) and (j, i, m) become (k, i, m) and (m, j, k).
        let ([i, j, k], [_, _, m]) = (rotated(self.corners[t], c), rotated(self.corners[u], d));
        let ([_, jk, ki], [_, im, mj]) = (rotated(self.edges[t], c), rotated(self.edges[u], d));
        let [a, b, p, q] = [ki, jk, im, mj].map(|edge| self.lengths[edge as usize]);
        // With the edge as axis from i to j, k lies above it and m below.
        let axis = self.lengths[e];
        let [above, below] = [self.areas[t], self.areas[u]].map(|area| 2.0 * area / axis);
        let along = |to_i: f64, to_j: f64| 0.5 * (axis + (to_i - to_j) * (to_i + to_j) / axis);
        let [from_i_to_k, from_i_to_m] = [along(a, b), along(p, q)];
        let [from_j_to_k, from_j_to_m] = [along(b, a), along(q, p)];
        let (across, shift) = (above + below, ((a - b) * (a + b) - (p - q) * (p + q)) / (2.0 * axis));
        let length = (shift * shift + across * across).sqrt();
        // By the lengths where these tell the area well, so that neither strays from the other in many flips.
        let areas = [
            area([a, p, length]).unwrap_or(0.5 * (from_i_to_k * below + from_i_to_m * above)),
            area([q, b, length]).unwrap_or(0.5 * (from_j_to_k * below + from_j_to_m * above)),
        ];
        if !(areas[0] > 0.0 && areas[1] > 0.0) {
            return None;
        }
        self.relocate([
            (ki, 3 * t + (c + 2) % 3, 3 * t),
            (im, 3 * u + (d + 1) % 3, 3 * t + 1),
            (mj, 3 * u + (d + 2) % 3, 3 * u),
            (jk, 3 * t + (c + 1) % 3, 3 * u + 1),
        ]);
        self.corners[t] = [k, i, m];
        self.corners[u] = [m, j, k];
        self.edges[t] = [ki, im, edge];
        self.edges[u] = [mj, jk, edge];
        self.sides[e] = [3 * t + 2, 3 * u + 2].map(|side| side as u32);
        self.lengths[e] = length;
        self.areas[t] = areas[0];
        self.areas[u] = areas[1];
        let are_flat = self.is_flat[t] && self.is_flat[u];
        for triangle in [t, u] {
            self.is_flat[triangle] = are_flat || self.is_without_area(triangle);
        }
        Some([ki, im, mj, jk])
    }

    /// Gives a triangle the other orientation.
    fn mirror(&mut self, triangle: u32) {
        let t = triangle as usize;
        let [_, second, third] = self.edges[t];
        self.relocate([(second, 3 * t + 1, 3 * t + 2), (third, 3 * t + 2, 3 * t + 1)]);
        self.corners[t].swap(0, 1);
        self.edges[t].swap(1, 2);
        // Where two of its sides are glued to each other, both turn round and nothing changes.
        for edge in self.edges[t] {
            self.same_way[edge as usize] ^= true;
        }
    }

    /// Tells edges that a side of theirs has another place now: (edge, old, new). All old places are looked up first, since
    /// the sides may be glued to each other.
    fn relocate<const N: usize>(&mut self, moves: [(u32, usize, usize); N]) {
        let places = moves.map(|(edge, old, _)| {
            let [first, second] = self.sides[edge as usize];
            if first as usize == old {
                Some(0)
            } else if second as usize == old {
                Some(1)
            } else {
                None
            }
        });
        for ((edge, _, new), place) in moves.into_iter().zip(places) {
            if let Some(place) = place {
                self.sides[edge as usize][place] = new as u32;
            }
        }
    }

    fn longest(&self, t: usize) -> f64 {
        self.edges[t].iter().fold(0.0, |longest, &edge| self.lengths[edge as usize].max(longest))
    }

    fn is_without_area(&self, t: usize) -> bool {
        let longest = self.longest(t);
        longest < POINT || self.areas[t] <= NOTHING * longest * longest
    }

    /// Half the cotangents of a triangle's angles, by the opposite edges. Where it has no area, or where only rounding tells of one,
    /// another area stands for it; one that is all but a point is equilateral.
    fn half_cotangents(&self, t: usize) -> [f64; 3] {
        let longest = self.longest(t);
        if longest < POINT {
            return [0.125 / EQUILATERAL; 3];
        }
        let area = if self.is_flat[t] { SUBSTITUTE * longest * longest } else { self.areas[t] };
        [0, 1, 2].map(|c| self.opposite((3 * t + c) as u32).four_areas_cotangent / (8.0 * area))
    }

    /// Half the cotangents opposite to every edge, summed; not negative where an edge has two triangles and is Delaunay.
    pub(super) fn weights(&self, watch: &Watch<'_>) -> Result<Vec<f64>, Cancelled> {
        let mut weights = vec![0.0; self.sides.len()];
        for range in ranges(self.edges.len(), TRIANGLE, watch) {
            for t in range? {
                for (half_cotangent, &edge) in self.half_cotangents(t).into_iter().zip(&self.edges[t]) {
                    weights[edge as usize] += half_cotangent;
                }
            }
        }
        watch.tick(weights.len() as u64)?;
        for (edge, weight) in weights.iter_mut().enumerate() {
            let [side, other] = self.sides[edge];
            if *weight < 0.0 && side != NONE {
                // By rounding, or beside a triangle whose area is made up.
                let is_made_up = [side, other].iter().any(|side| self.is_flat[*side as usize / 3]);
                if is_made_up || self.is_delaunay(edge as u32) {
                    *weight = 0.0;
                }
            }
        }
        Ok(weights)
    }

    /// The vertices at the ends of an edge with two triangles, the smaller id first.
    pub(super) fn ends(&self, edge: u32) -> Option<[u32; 2]> {
        let [side, _] = self.sides[edge as usize];
        if side == NONE {
            return None;
        }
        let [a, b, _] = rotated(self.corners[side as usize / 3], side as usize % 3);
        Some([a.min(b), a.max(b)])
    }
}

/// What a triangle contributes to the angle opposite to one of its sides.
struct Opposite {
    four_areas_cotangent: f64,
    /// The squares of its sides, summed.
    squares: f64,
}

/// The items of a triangle, beginning at one of them.
fn rotated<T: Copy>(items: [T; 3], first: usize) -> [T; 3] {
    [items[first], items[(first + 1) % 3], items[(first + 2) % 3]]
}
