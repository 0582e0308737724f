//! From raw arrays to triangles that can be trusted: every index in range, every vertex id at most once a triangle,
//! every triangle once.

use crate::error::{Cancelled, Diagnostic, MeshError};
use crate::support::counting_sort::{offsets, rewind};
use crate::support::watch::Watch;

/// Beyond this, fourth powers (squared cross products of sides) leave the range of double precision.
const LARGEST_COORDINATE: f64 = 1e75;

/// The work with a triangle that is put into its bucket, and with one in its bucket.
const TRIANGLE: u64 = 40;
const KEY: u64 = 30;

pub(super) struct Checked {
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) repeated_id_triangles: usize,
    pub(super) warnings: Vec<Diagnostic>,
}

/// The bytes that [`check`] takes at most, its result included.
pub(super) fn bytes(n: usize, m: usize) -> u64 {
    // The triangles kept; which of them are repetitions, and to find these: triangles in buckets, and the keys of one bucket.
    12 * m as u64 + 14 * m as u64 + 4 * n as u64
}

/// Finds the triangles that can be kept. They must have passed [`check_ids`].
pub(super) fn check(n: usize, triangles: &[u32], watch: &Watch<'_>) -> Result<Checked, MeshError> {
    let (all, _) = triangles.as_chunks::<3>();
    let names_twice = |[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
    let mut kept = Vec::with_capacity(all.len());
    kept.extend(all.iter().filter(|corners| !names_twice(corners)));
    let repeated_id_triangles = all.len() - kept.len();
    let is_duplicate = duplicates(n, &kept, watch)?;
    let mut flags = is_duplicate.iter();
    kept.retain(|_| flags.next() == Some(&false));
    if n == 0 || kept.is_empty() {
        return Err(MeshError::EmptyMesh { vertices: n, triangles: kept.len() });
    }
    let mut warnings = Vec::new();
    let numbered = || (0_u32..).zip(all);
    let mut repeated_ids = numbered().filter(|(_, corners)| names_twice(corners)).map(|(t, _)| t);
    Diagnostic::report(&mut warnings, "DegenerateTriangle", &mut repeated_ids, &|count| {
        format!("{count} triangles name a vertex twice and were left out")
    });
    let others = numbered().filter(|(_, corners)| !names_twice(corners)).map(|(t, _)| t);
    let mut duplicates = others.zip(&is_duplicate).filter(|&(_, &duplicate)| duplicate).map(|(t, _)| t);
    Diagnostic::report(&mut warnings, "DuplicateTriangle", &mut duplicates, &|count| {
        format!("{count} triangles repeat another one and were left out")
    });
    Ok(Checked { triangles: kept, repeated_id_triangles, warnings })
}

/// Fails unless positions and triangles fit together, as a mesh needs it.
pub(crate) fn check_arrays(positions: &[f64], triangles: &[u32]) -> Result<(), MeshError> {
    check_positions(positions)?;
    check_ids(triangles, positions.len() / 3)
}

/// Fails unless there are three ids for every triangle, all of them below `n`.
pub(super) fn check_ids(triangles: &[u32], n: usize) -> Result<(), MeshError> {
    if !triangles.len().is_multiple_of(3) {
        return Err(MeshError::TrianglesNotTriples { length: triangles.len() });
    }
    // Half-edges 3t + c are u32 too, with one value left to mean "none".
    if triangles.len() >= u32::MAX as usize {
        return Err(MeshError::TooManyElements { count: triangles.len() });
    }
    if let Some(place) = triangles.iter().position(|&v| v as usize >= n) {
        return Err(MeshError::IndexOutOfBounds { triangle: (place / 3) as u32, index: triangles[place], vertices: n });
    }
    Ok(())
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
fn duplicates(n: usize, triangles: &[[u32; 3]], watch: &Watch<'_>) -> Result<Vec<bool>, Cancelled> {
    // Bucket by the smallest vertex; buckets are small, so sorting them is nearly linear.
    let smallest = |t: &[u32; 3]| t[0].min(t[1]).min(t[2]);
    watch.tick(TRIANGLE * triangles.len() as u64)?;
    let mut offsets = offsets(n, &mut triangles.iter().map(smallest));
    let mut bucketed = vec![0_u32; triangles.len()];
    for (id, t) in triangles.iter().enumerate() {
        let place = &mut offsets[smallest(t) as usize];
        bucketed[*place as usize] = id as u32;
        *place += 1;
    }
    rewind(&mut offsets);
    let mut found = vec![false; triangles.len()];
    let longest = offsets.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0);
    let mut keys: Vec<u64> = Vec::with_capacity(longest as usize);
    let mut seen = Vec::new();
    for v in 0..n {
        let bucket = &bucketed[offsets[v] as usize..offsets[v + 1] as usize];
        let key = |id: u32| {
            let t = triangles[id as usize];
            let largest = t[0].max(t[1]).max(t[2]);
            // Wrapping sums recover the middle id without branches.
            let middle = t[0].wrapping_add(t[1]).wrapping_add(t[2]).wrapping_sub(v as u32).wrapping_sub(largest);
            (u64::from(middle) << 32) | u64::from(largest)
        };
        watch.tick(KEY * bucket.len() as u64)?;
        keys.clear();
        keys.extend(bucket.iter().map(|&id| key(id)));
        keys.sort_unstable();
        if keys.windows(2).any(|pair| pair[0] == pair[1]) {
            // Rare, so a second look tells which triangles they are: all but the first of every key.
            keys.dedup();
            seen.clear();
            seen.resize(keys.len(), false);
            for &id in bucket {
                let place = keys.partition_point(|&other| other < key(id));
                if core::mem::replace(&mut seen[place], true) {
                    found[id as usize] = true;
                }
            }
        }
    }
    Ok(found)
}
