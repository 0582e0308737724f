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
        let mut disagrees = vec![false; joined.len()];
        for (&new, &value) in self.new_ids.iter().zip(values) {
            match joined[new as usize] {
                None => joined[new as usize] = Some(value),
                Some(first) if first != value => disagrees[new as usize] = true,
                Some(_) => {}
            }
        }
        let disagreeing = (0..disagrees.len() as u32).filter(|&new| disagrees[new as usize]).collect();
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
    // Half a hash of the position above, the id below: equal positions come to lie side by side, by ascending id.
    let mut order: Vec<u64> = (0..n as u32).map(|v| (hash(at(v)) >> 32) << 32 | u64::from(v)).collect();
    order.sort_unstable();
    let mut first = vec![0_u32; n];
    let mut distinct: Vec<u32> = Vec::new();
    for group in order.chunk_by(|a, b| a >> 32 == b >> 32) {
        distinct.clear();
        for &packed in group {
            let v = packed as u32;
            // More than one round only where different positions share a hash.
            let known = distinct.iter().copied().find(|&other| at(other) == at(v));
            first[v as usize] = known.unwrap_or_else(|| {
                distinct.push(v);
                v
            });
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

/// Mixes the bits of three coordinates (the finisher of `MurmurHash3` \[Appleby11\], once for each).
fn hash(position: [f64; 3]) -> u64 {
    position.iter().fold(0, |hash: u64, x| {
        let mut mixed = hash.rotate_left(23) ^ x.to_bits();
        mixed = (mixed ^ (mixed >> 33)).wrapping_mul(0xFF51_AFD7_ED55_8CCD);
        mixed = (mixed ^ (mixed >> 33)).wrapping_mul(0xC4CE_B9FE_1A85_EC53);
        mixed ^ (mixed >> 33)
    })
}
