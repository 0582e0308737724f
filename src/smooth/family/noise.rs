//! How much noise a field has, told from the field.

use super::members::Family;
use crate::error::FieldError;
use crate::field::sort_by_value;
use crate::mesh::Connectivity;
use crate::support::counting_sort::{Buckets, grouped};
use crate::support::memory;
use crate::support::watch::Watch;

/// The median of |x| for a normal distribution of standard deviation 1.
const MEDIAN: f64 = 0.674_489_750_196_081_7;

impl Family {
    /// The standard deviation of noise by second differences, in the normalised units of a channel.
    ///
    /// With D the difference of a vertex from the mean of its neighbours, D² takes away what varies slowly; the values of D²f over the
    /// norms of the rows of D² are normal where the noise is, and their median tells its standard deviation.
    pub(super) fn noise_by_differences(&self, channel: usize, watch: &Watch<'_>) -> Result<f64, FieldError> {
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
        let mut order: Vec<u32> = (0..sizes.len() as u32).collect();
        sort_by_value(&mut order, &sizes, watch)?;
        Ok(sizes[order[order.len() / 2] as usize] / MEDIAN)
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
