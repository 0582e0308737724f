//! Joins vertices at identical positions, as triangle soups (STL, exploded files) need.

use super::validate;
use crate::error::MeshError;

/// A mesh whose vertices have pairwise different positions.
#[derive(Debug, Clone, PartialEq)]
pub struct Welded {
    /// x, y, z of the vertices that are left, in the order of their first appearance.
    pub positions: Vec<f64>,
    /// The triangles with the new ids.
    pub triangles: Vec<u32>,
    /// The new id of every old vertex.
    pub new_ids: Vec<u32>,
}

impl Welded {
    /// One value per new vertex from one per old vertex: the value of the first old vertex there.
    ///
    /// The second result lists the new vertices whose old vertices disagreed.
    ///
    /// # Panics
    /// Where `values` has not one value per old vertex.
    #[must_use]
    pub fn field(&self, values: &[f64]) -> (Vec<f64>, Vec<u32>) {
        let mut joined = vec![None; self.positions.len() / 3];
        let mut disagreeing = Vec::new();
        for (&new, &value) in self.new_ids.iter().zip(values) {
            match joined[new as usize] {
                None => joined[new as usize] = Some(value),
                Some(first) if first != value => disagreeing.push(new),
                Some(_) => {}
            }
        }
        disagreeing.sort_unstable();
        disagreeing.dedup();
        (joined.into_iter().flatten().collect(), disagreeing)
    }
}

/// Joins vertices whose three coordinates are equal (−0 equals 0). O(n log n).
///
/// # Errors
/// `PositionsNotTriples`, `TooManyElements`, `NonFinitePosition`, `PositionOverflow`, `TrianglesNotTriples`,
/// `IndexOutOfBounds`.
pub fn weld(positions: &[f64], triangles: &[u32]) -> Result<Welded, MeshError> {
    validate::check_positions(positions)?;
    let n = positions.len() / 3;
    if !triangles.len().is_multiple_of(3) {
        return Err(MeshError::TrianglesNotTriples { length: triangles.len() });
    }
    if let Some(place) = triangles.iter().position(|&v| v as usize >= n) {
        return Err(MeshError::IndexOutOfBounds { triangle: (place / 3) as u32, index: triangles[place], vertices: n });
    }
    // Adding zero turns −0 into 0, so that the order of the numbers is the order of the positions.
    let at = |v: u32| {
        let i = 3 * v as usize;
        [positions[i] + 0.0, positions[i + 1] + 0.0, positions[i + 2] + 0.0]
    };
    let mut order: Vec<u32> = (0..n as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        let (p, q) = (at(a), at(b));
        p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(p[2].total_cmp(&q[2])).then(a.cmp(&b))
    });
    // The first of a group of equal positions has the smallest id, because ids break ties in the sort.
    let mut first = vec![0_u32; n];
    for group in order.chunk_by(|&a, &b| at(a) == at(b)) {
        for &v in group {
            first[v as usize] = group[0];
        }
    }
    let mut new_ids = vec![0_u32; n];
    let mut kept = Vec::new();
    for v in 0..n {
        if first[v] as usize == v {
            new_ids[v] = (kept.len() / 3) as u32;
            kept.extend_from_slice(&positions[3 * v..3 * v + 3]);
        } else {
            new_ids[v] = new_ids[first[v] as usize];
        }
    }
    let triangles = triangles.iter().map(|&v| new_ids[v as usize]).collect();
    Ok(Welded { positions: kept, triangles, new_ids })
}
