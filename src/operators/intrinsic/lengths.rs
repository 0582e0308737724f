//! Lengths of edges that make every triangle one of positive area.

use crate::mesh::{Connectivity, TriMesh, difference, norm};

/// What two sides of a triangle must have more than the third, as a fraction of the mean length \[Sharp20\].
const SLACK: f64 = 1e-5;

/// The length of every edge in an arbitrary unit, all of them longer by the same amount where some triangle is, or nearly
/// is, without area. Where all vertices coincide there is nothing to measure, and all lengths are 1.
pub(super) fn edge_lengths(mesh: &TriMesh) -> Vec<f64> {
    let connectivity = mesh.connectivity();
    let mut largest = 0.0_f64;
    for &[a, b] in connectivity.edges() {
        for x in difference(mesh.position(b), mesh.position(a)) {
            largest = largest.max(x.abs());
        }
    }
    if largest == 0.0 {
        return vec![1.0; mesh.edge_count()];
    }
    let scale = inverse_power_of_two(largest);
    let mut lengths = Vec::with_capacity(mesh.edge_count());
    for &[a, b] in connectivity.edges() {
        lengths.push(norm(difference(mesh.position(b), mesh.position(a)).map(|x| x * scale)));
    }
    mollify(connectivity, &mut lengths);
    lengths
}

/// The power of two that brings `x` > 0 to between 1 and 2 (a subnormal number below that), so that no product of lengths
/// leaves the range of double precision. Powers of two scale without rounding.
fn inverse_power_of_two(x: f64) -> f64 {
    // Exponents are stored with 1023 added.
    f64::from_bits((2046 - (x.to_bits() >> 52)) << 52)
}

/// Adds to all lengths the least number that gives every triangle its slack; nothing where all have it.
fn mollify(connectivity: &Connectivity, lengths: &mut [f64]) {
    let mut sum = 0.0;
    for &length in lengths.iter() {
        sum += length;
    }
    let delta = SLACK * sum / lengths.len() as f64;
    let mut epsilon = 0.0_f64;
    for edges in connectivity.triangle_edges() {
        let [a, b, c] = descending(edges.map(|e| lengths[e as usize]));
        epsilon = epsilon.max(delta - (c - (a - b)));
    }
    if epsilon > 0.0 {
        for length in lengths {
            *length += epsilon;
        }
    }
}

/// Three numbers, the largest first.
fn descending([a, b, c]: [f64; 3]) -> [f64; 3] {
    let (a, b) = (a.max(b), a.min(b));
    let (b, c) = (b.max(c), b.min(c));
    [a.max(b), a.min(b), c]
}

/// The area of a triangle with these sides by the formula that keeps its digits in needles \[Kahan14\]; zero where they are
/// no sides of a triangle.
pub(super) fn area(sides: [f64; 3]) -> f64 {
    let [a, b, c] = descending(sides);
    let square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    if square > 0.0 { 0.25 * square.sqrt() } else { 0.0 }
}

/// (p² + q² − r²), that is 4 times the area times the cotangent of the angle between the sides p and q, opposite to r.
pub(super) fn four_areas_cotangent(r: f64, p: f64, q: f64) -> f64 {
    let (p, q) = (p.max(q), p.min(q));
    q * q + (p - r) * (p + r)
}
