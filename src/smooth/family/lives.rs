//! The life of extrema along ε: which ones stay as the field is smoothed more, and for how long.

use super::choose;
use super::estimate::logarithmic;
use super::members::Family;
use crate::error::{OptionError, Result};
use crate::field::{Basins, ScalarField, Threshold, ascending_bits, basins, sort_by_key};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// An extremum followed along ε, from the largest ε at which it is there to the least.
///
/// From one ε to the next smaller one an extremum goes to where the steepest path from its vertex ends. Where several end at one
/// vertex, the one lives on that has lived longest, and the others die.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct ExtremumLife {
    /// Whether it is a maximum; a minimum otherwise.
    pub is_maximum: bool,
    /// The vertex at the largest ε at which it is there.
    pub first_vertex: u32,
    /// The vertex at the least such ε.
    pub last_vertex: u32,
    /// The largest ε at which it is there.
    pub largest: f64,
    /// The least.
    pub least: f64,
}

impl Family {
    /// The lives of all extrema of a channel on `per_decade` values of ε in each decade, the longest first: a ranking of features by the
    /// range of scales in which they are there. Of equally long ones that come first which are there at the smaller ε.
    ///
    /// # Errors
    /// `InvalidOption` for the channel, and for a number per decade that is not from 1 to 100; `Cancelled`; `OutOfMemory`.
    pub fn lives(&self, channel: usize, per_decade: usize, watch: &Watch<'_>) -> Result<Vec<ExtremumLife>> {
        if channel >= self.spaces.len() {
            return Err(OptionError::invalid("channel", "the number of a channel, from 0").into());
        }
        if !(1..=100).contains(&per_decade) {
            return Err(OptionError::invalid("perDecade", "an integer from 1 to 100").into());
        }
        memory::ensure(choose::grid_bytes(self.range))?;
        let grid = logarithmic(self.range, per_decade as f64);
        let mesh = &self.field.operators.mesh;
        let n = mesh.vertex_count();
        let mut plan = watch.plan(&[(Phase::Report, 1.0)]);
        plan.begin((100 * grid.len() * n) as u64)?;
        let mut ended: Vec<ExtremumLife> = Vec::new();
        let mut living: Vec<ExtremumLife> = Vec::new();
        for &epsilon in grid.iter().rev() {
            memory::ensure(self.channel_bytes())?;
            let values = self.channel_values(epsilon, channel)?;
            let field = ScalarField::with_missing(mesh, &values, self.field.missing_after())?;
            let Basins { descending, ascending } = basins(&field, Threshold::Relative(0.0), watch)?;
            // Marks; the extrema of this ε, and the lists of lives, which are moved as they grow, and sorted.
            let is_extremum = |ends: &[u32]| ends.iter().enumerate().filter(|(v, end)| **end as usize == *v).count();
            let now = is_extremum(&descending) + is_extremum(&ascending);
            let lives = now + 2 * living.len() + 3 * (ended.len() + living.len());
            memory::ensure((2 * n + lives * size_of::<ExtremumLife>()) as u64)?;
            // Who is at each vertex that is an extremum now; the first to come has lived longest, as those born later were put after it.
            let mut next: Vec<ExtremumLife> = Vec::with_capacity(now);
            let mut is_taken = vec![false; 2 * n];
            for life in living.drain(..) {
                let ends = if life.is_maximum { &ascending } else { &descending };
                let end = ends[life.last_vertex as usize];
                let taken = is_taken.get_mut(2 * end as usize + usize::from(life.is_maximum));
                match taken {
                    Some(taken) if !*taken => {
                        *taken = true;
                        next.push(ExtremumLife { last_vertex: end, least: epsilon, ..life });
                    }
                    _ => ended.push(life),
                }
            }
            for (is_maximum, ends) in [(false, &descending), (true, &ascending)] {
                for (v, &end) in ends.iter().enumerate() {
                    if end as usize == v && !is_taken[2 * v + usize::from(is_maximum)] {
                        let vertex = v as u32;
                        let (largest, least) = (epsilon, epsilon);
                        next.push(ExtremumLife {
                            is_maximum,
                            first_vertex: vertex,
                            last_vertex: vertex,
                            largest,
                            least,
                        });
                    }
                }
            }
            living = next;
        }
        memory::ensure((4 * (ended.len() + living.len()) * size_of::<ExtremumLife>()) as u64)?;
        ended.append(&mut living);
        let mut ranking: Vec<u32> = (0..ended.len() as u32).collect();
        let life = |place: u32| &ended[place as usize];
        // From the last criterion to the first: each sort leaves the order of what is equal.
        sort_by_key(&mut ranking, &|place| u64::from(life(place).first_vertex), watch)?;
        sort_by_key(&mut ranking, &|place| ascending_bits(life(place).least), watch)?;
        sort_by_key(&mut ranking, &|place| ascending_bits(-life(place).largest / life(place).least), watch)?;
        let mut ended: Vec<ExtremumLife> = ranking.iter().map(|&place| *life(place)).collect();
        if let Some((part, _)) = &self.field.left_out {
            for life in &mut ended {
                life.first_vertex = part.known.vertices[life.first_vertex as usize];
                life.last_vertex = part.known.vertices[life.last_vertex as usize];
            }
        }
        plan.finish()?;
        Ok(ended)
    }
}
