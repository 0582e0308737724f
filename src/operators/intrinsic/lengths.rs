//! Lengths of edges and areas of triangles.

use crate::mesh::{TriMesh, cross, difference, norm};

/// The length of every edge and the area of every triangle, in an arbitrary unit. Where all vertices coincide there is nothing to
/// measure, and all triangles are equilateral.
pub(super) fn measured(mesh: &TriMesh) -> (Vec<f64>, Vec<f64>) {
    let connectivity = mesh.connectivity();
    let mut largest = 0.0_f64;
    for &[a, b] in connectivity.edges() {
        for x in difference(mesh.position(b), mesh.position(a)) {
            largest = largest.max(x.abs());
        }
    }
    if largest == 0.0 {
        return (vec![1.0; mesh.edge_count()], vec![EQUILATERAL; mesh.triangle_count()]);
    }
    let scale = inverse_power_of_two(largest);
    let side = |a: u32, b: u32| difference(mesh.position(b), mesh.position(a)).map(|x| x * scale);
    let lengths: Vec<f64> = connectivity.edges().iter().map(|&[a, b]| norm(side(a, b))).collect();
    let mut areas = Vec::with_capacity(mesh.triangle_count());
    for (&[a, b, c], edges) in connectivity.triangles().iter().zip(connectivity.triangle_edges()) {
        // The two shorter sides span the area with the least rounding: in needles and slivers, where the lengths of the sides tell
        // next to nothing of it.
        let [ab, bc, ca] = edges.map(|e| lengths[e as usize]);
        let [p, q] = if ab >= bc && ab >= ca {
            [side(c, a), side(c, b)]
        } else if bc >= ca {
            [side(a, b), side(a, c)]
        } else {
            [side(b, c), side(b, a)]
        };
        let longest = ab.max(bc).max(ca);
        areas.push((0.5 * norm(cross(p, q))).max(FLAT * longest * longest));
    }
    (lengths, areas)
}

/// What triangles without area have of their squared longest side, so that edges between two of them can be flipped: far less than
/// shows in any length.
const FLAT: f64 = 1e-18;

/// The area of a triangle with sides of length 1.
pub(super) const EQUILATERAL: f64 = 0.433_012_701_892_219_3;

/// The power of two that brings `x` > 0 to between 1 and 2 (a subnormal number below that), so that no product of lengths
/// leaves the range of double precision. Powers of two scale without rounding.
fn inverse_power_of_two(x: f64) -> f64 {
    // Exponents are stored with 1023 added.
    f64::from_bits((2046 - (x.to_bits() >> 52)) << 52)
}

/// What two sides must have more than the third, relative to the longest, for lengths to tell the area: to twelve digits then.
const SLACK: f64 = 1e-4;

/// The area of a triangle with these sides by the formula that keeps its digits in needles \[Kahan14\]; nothing in slivers, where none
/// does.
pub(super) fn area([a, b, c]: [f64; 3]) -> Option<f64> {
    let (a, b) = (a.max(b), a.min(b));
    let (b, c) = (b.max(c), b.min(c));
    let (a, b) = (a.max(b), a.min(b));
    let slack = c - (a - b);
    (slack > SLACK * a).then(|| 0.25 * ((a + (b + c)) * slack * (c + (a - b)) * (a + (b - c))).sqrt())
}

/// (p² + q² − r²), that is 4 times the area times the cotangent of the angle between the sides p and q, opposite to r.
pub(super) fn four_areas_cotangent(r: f64, p: f64, q: f64) -> f64 {
    let (p, q) = (p.max(q), p.min(q));
    q * q + (p - r) * (p + r)
}
