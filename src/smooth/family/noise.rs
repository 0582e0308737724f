//! How much noise a field has, told from the field.

use super::Family;
use crate::error::OutOfMemory;
use crate::mesh::Connectivity;
use crate::support::counting_sort::{Buckets, grouped};
use crate::support::memory;
use crate::support::named::named;

/// How far two ways of finding the level of the noise agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Confidence {
    /// To within 15 %.
    High,
    /// To within a factor of 1.5.
    Medium,
    /// No better: the noise of neighbouring vertices is alike, or the mesh is too coarse for the field.
    Low,
}

named! { Confidence { High = "high", Medium = "medium", Low = "low" } }

/// The level of the noise of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct NoiseLevel {
    /// The standard deviation in the units of the field, from what smoothing takes away at the ε of cross-validation, over the degrees of
    /// freedom that it takes away: the high end of the spectrum.
    pub standard_deviation: f64,
    /// The same from second differences along edges, by their median: robust, but too large where the mesh is coarse for the field.
    pub by_differences: f64,
    /// How far the two agree.
    pub confidence: Confidence,
}

impl NoiseLevel {
    pub(super) fn new(standard_deviation: f64, by_differences: f64) -> Self {
        let quotient = if standard_deviation > by_differences {
            standard_deviation / by_differences
        } else {
            by_differences / standard_deviation
        };
        let confidence = match quotient {
            quotient if quotient <= 1.15 => Confidence::High,
            quotient if quotient <= 1.5 => Confidence::Medium,
            _ => Confidence::Low,
        };
        Self { standard_deviation, by_differences, confidence }
    }
}

/// The median of |x| for a normal distribution of standard deviation 1.
const MEDIAN: f64 = 0.674_489_750_196_081_7;

impl Family {
    /// The standard deviation of noise by second differences, in the normalised units of a channel.
    ///
    /// With D the difference of a vertex from the mean of its neighbours, D² takes away what varies slowly; the values of D²f over the
    /// norms of the rows of D² are normal where the noise is, and their median tells its standard deviation.
    pub(super) fn noise_by_differences(&self, channel: usize) -> Result<f64, OutOfMemory> {
        let field = &self.field;
        let connectivity = field.operators.mesh.connectivity();
        // Neighbours, twice in between; differences, a row, and what it is all about.
        memory::ensure(24 * connectivity.edges().len() as u64 + 40 * connectivity.vertex_count() as u64)?;
        let neighbours = Neighbours::new(connectivity);
        let values = &field.channels[channel].normalized;
        let n = values.len();
        let first: Vec<f64> = (0..n)
            .map(|v| {
                let around = neighbours.of(v);
                values[v] - around.iter().map(|&w| values[w as usize]).sum::<f64>() / around.len().max(1) as f64
            })
            .collect();
        let mut row = vec![0.0; n];
        let mut sizes = Vec::with_capacity(n);
        for v in 0..n {
            let around = neighbours.of(v);
            let reaches = |w: u32| field.is_missing(w as usize) || neighbours.of(w as usize).is_empty();
            if around.is_empty() || field.is_missing(v) || around.iter().any(|&w| reaches(w)) {
                continue;
            }
            if around.iter().any(|&w| neighbours.of(w as usize).iter().any(|&u| field.is_missing(u as usize))) {
                continue;
            }
            let share = 1.0 / around.len() as f64;
            let second = first[v] - share * around.iter().map(|&w| first[w as usize]).sum::<f64>();
            // The row of D²: each element once, then taken back.
            row[v] += 1.0;
            for &w in around {
                row[w as usize] -= 2.0 * share;
                let others = neighbours.of(w as usize);
                others.iter().for_each(|&u| row[u as usize] += share / others.len() as f64);
            }
            let mut square = 0.0;
            let mut take = |u: u32| {
                square += row[u as usize] * row[u as usize];
                row[u as usize] = 0.0;
            };
            take(v as u32);
            for &w in around {
                take(w);
                neighbours.of(w as usize).iter().for_each(|&u| take(u));
            }
            if square > 0.0 {
                sizes.push((second / square.sqrt()).abs());
            }
        }
        if sizes.is_empty() {
            return Ok(0.0);
        }
        let middle = sizes.len() / 2;
        let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
        Ok(*median / MEDIAN)
    }
}

/// The neighbours of every vertex.
struct Neighbours(Buckets);

impl Neighbours {
    fn new(connectivity: &Connectivity) -> Self {
        let edges = connectivity.edges();
        let mut ends = grouped(edges.as_flattened(), connectivity.vertex_count());
        for end in &mut ends.items {
            let [a, b] = edges[*end as usize / 2];
            *end = if end.is_multiple_of(2) { b } else { a };
        }
        Self(ends)
    }

    fn of(&self, v: usize) -> &[u32] {
        self.0.bucket(v as u32)
    }
}
