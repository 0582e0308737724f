//! Components without a constrained vertex, about which the equations say nothing.

use super::active::ActiveVertices;
use super::constraints::Unconstrained;
use crate::error::SmoothError;

/// The components that have no constrained vertex (no vertex with a value, where all of these count): their vertices are no unknowns.
#[derive(Debug, Clone)]
pub(super) struct UnconstrainedComponents {
    /// Per component.
    is_unconstrained: Vec<bool>,
    takes_mean: bool,
}

impl UnconstrainedComponents {
    /// `vertices`: the constrained ones.
    ///
    /// # Errors
    /// `Unconstrained` with the first such component, where that is an error.
    pub(super) fn new(
        active: &ActiveVertices,
        vertices: &[u32],
        unconstrained: Unconstrained,
    ) -> Result<Self, SmoothError> {
        let mut is_unconstrained = vec![true; active.first_vertices().len()];
        for &v in vertices {
            if let Some(component) = active.component(v) {
                is_unconstrained[component] = false;
            }
        }
        if unconstrained == Unconstrained::Error
            && let Some(component) = is_unconstrained.iter().position(|&unconstrained| unconstrained)
        {
            return Err(SmoothError::Unconstrained { component, vertex: active.first_vertices()[component] });
        }
        Ok(Self { is_unconstrained, takes_mean: unconstrained == Unconstrained::Mean })
    }

    /// Whether every component has a constrained vertex.
    pub(super) fn is_empty(&self) -> bool {
        !self.is_unconstrained.contains(&true)
    }

    /// The active vertices of components with a constrained vertex.
    pub(super) fn remaining(&self, active: &ActiveVertices) -> Vec<u32> {
        let remains = |v: u32| active.component(v).is_some_and(|component| !self.is_unconstrained[component]);
        active.list().iter().copied().filter(|&v| remains(v)).collect()
    }

    /// Writes what becomes of unconstrained components into normalised values: they stay, or all become the mean of the component's
    /// values, of all values where the component has none. `values` has NaN where values are missing.
    pub(super) fn write(&self, active: &ActiveVertices, values: &[f64], x: &mut [f64]) {
        if !self.takes_mean || self.is_empty() {
            return;
        }
        let mut sums = vec![(0.0, 0_u32); self.is_unconstrained.len()];
        for &v in active.list() {
            if let Some(component) = active.component(v)
                && !values[v as usize].is_nan()
            {
                let (sum, count) = &mut sums[component];
                *sum += x[v as usize];
                *count += 1;
            }
        }
        let (all, known) = sums.iter().fold((0.0, 0), |(all, known), &(sum, count)| (all + sum, known + count));
        for &v in active.list() {
            if let Some(component) = active.component(v)
                && self.is_unconstrained[component]
            {
                let (sum, count) = if sums[component].1 > 0 { sums[component] } else { (all, known) };
                x[v as usize] = sum / f64::from(count);
            }
        }
    }

    /// The vertices that get another value than they had, though they are no unknowns.
    pub(super) fn moved(&self, active: &ActiveVertices) -> Vec<u32> {
        let moves = |v: u32| active.component(v).is_some_and(|component| self.is_unconstrained[component]);
        if self.takes_mean { active.list().iter().copied().filter(|&v| moves(v)).collect() } else { Vec::new() }
    }
}
