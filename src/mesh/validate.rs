//! From raw arrays to triangles that can be trusted: every index in range, every vertex id at most once a triangle,
//! every triangle once.

use crate::error::{Diagnostic, MeshError};

/// Beyond this, fourth powers (squared cross products of sides) leave the range of double precision.
const LARGEST_COORDINATE: f64 = 1e75;

pub(super) struct Checked {
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) repeated_id_triangles: usize,
    pub(super) warnings: Vec<Diagnostic>,
}

pub(super) fn check(positions: &[f64], triangles: &[u32]) -> Result<Checked, MeshError> {
    check_positions(positions)?;
    let n = positions.len() / 3;
    if !triangles.len().is_multiple_of(3) {
        return Err(MeshError::TrianglesNotTriples { length: triangles.len() });
    }
    // Half-edges 3t + c are u32 too, with one value left to mean "none".
    if triangles.len() >= u32::MAX as usize {
        return Err(MeshError::TooManyElements { count: triangles.len() });
    }
    let mut kept = Vec::with_capacity(triangles.len() / 3);
    let mut repeated_ids = Vec::new();
    let mut ids = Vec::new();
    for (t, corners) in triangles.chunks_exact(3).enumerate() {
        let corners = [corners[0], corners[1], corners[2]];
        if let Some(&index) = corners.iter().find(|&&v| v as usize >= n) {
            return Err(MeshError::IndexOutOfBounds { triangle: t as u32, index, vertices: n });
        }
        if corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0] {
            repeated_ids.push(t as u32);
        } else {
            kept.push(corners);
            ids.push(t as u32);
        }
    }
    let is_duplicate = duplicates(n, &kept);
    let duplicate_ids: Vec<u32> =
        ids.iter().zip(&is_duplicate).filter(|&(_, &duplicate)| duplicate).map(|(&id, _)| id).collect();
    if !duplicate_ids.is_empty() {
        let mut flags = is_duplicate.iter();
        kept.retain(|_| flags.next() == Some(&false));
    }
    if n == 0 || kept.is_empty() {
        return Err(MeshError::EmptyMesh { vertices: n, triangles: kept.len() });
    }
    let mut warnings = Vec::new();
    Diagnostic::report(&mut warnings, "DegenerateTriangle", &mut repeated_ids.iter().copied(), &|count| {
        format!("{count} triangles name a vertex twice and were left out")
    });
    Diagnostic::report(&mut warnings, "DuplicateTriangle", &mut duplicate_ids.iter().copied(), &|count| {
        format!("{count} triangles repeat another one and were left out")
    });
    Ok(Checked { triangles: kept, repeated_id_triangles: repeated_ids.len(), warnings })
}

pub(super) fn check_positions(positions: &[f64]) -> Result<(), MeshError> {
    if !positions.len().is_multiple_of(3) {
        return Err(MeshError::PositionsNotTriples { length: positions.len() });
    }
    if positions.len() / 3 >= u32::MAX as usize {
        return Err(MeshError::TooManyElements { count: positions.len() / 3 });
    }
    for (i, &x) in positions.iter().enumerate() {
        let vertex = (i / 3) as u32;
        if !x.is_finite() {
            return Err(MeshError::NonFinitePosition { vertex });
        }
        if x.abs() > LARGEST_COORDINATE {
            return Err(MeshError::PositionOverflow { vertex });
        }
    }
    Ok(())
}

/// For every triangle whether an earlier one has the same vertices.
fn duplicates(n: usize, triangles: &[[u32; 3]]) -> Vec<bool> {
    // Bucket by the smallest vertex; buckets are small, so sorting them is nearly linear.
    let smallest = |t: &[u32; 3]| t[0].min(t[1]).min(t[2]);
    let mut offsets = vec![0_u32; n + 1];
    for t in triangles {
        offsets[smallest(t) as usize + 1] += 1;
    }
    for v in 0..n {
        offsets[v + 1] += offsets[v];
    }
    let mut next = offsets.clone();
    let mut bucketed = vec![0_u32; triangles.len()];
    for (id, t) in triangles.iter().enumerate() {
        let place = &mut next[smallest(t) as usize];
        bucketed[*place as usize] = id as u32;
        *place += 1;
    }
    let mut found = vec![false; triangles.len()];
    let mut keys: Vec<u64> = Vec::new();
    for v in 0..n {
        let bucket = &bucketed[offsets[v] as usize..offsets[v + 1] as usize];
        let key = |id: u32| {
            let t = triangles[id as usize];
            let largest = t[0].max(t[1]).max(t[2]);
            // Wrapping sums recover the middle id without branches.
            let middle = t[0].wrapping_add(t[1]).wrapping_add(t[2]).wrapping_sub(v as u32).wrapping_sub(largest);
            (u64::from(middle) << 32) | u64::from(largest)
        };
        keys.clear();
        keys.extend(bucket.iter().map(|&id| key(id)));
        keys.sort_unstable();
        if keys.windows(2).any(|pair| pair[0] == pair[1]) {
            // Rare, so a second look tells which triangles they are: all but the first of every key.
            keys.dedup();
            let mut seen = vec![false; keys.len()];
            for &id in bucket {
                let place = keys.partition_point(|&other| other < key(id));
                if core::mem::replace(&mut seen[place], true) {
                    found[id as usize] = true;
                }
            }
        }
    }
    found
}
