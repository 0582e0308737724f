//! Components without a constrained vertex, about which the equations say nothing.

use super::active::ActiveVertices;
use super::constraints::{ConstraintSet, Unconstrained};
use crate::error::SmoothError;

/// The components that have no constrained vertex: their vertices are no unknowns.
#[derive(Debug)]
pub(super) struct UnconstrainedComponents {
    /// Per component.
    is_unconstrained: Vec<bool>,
    takes_mean: bool,
}

impl UnconstrainedComponents {
    /// # Errors
    /// `Unconstrained` with the first such component, where that is an error.
    pub(super) fn new(active: &ActiveVertices, set: &ConstraintSet, unconstrained: Unconstrained) -> Result<Self, SmoothError> {
        let mut is_unconstrained = vec![true; active.first_vertices().len()];
        for &v in &set.vertices {
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

    /// Writes what becomes of unconstrained components into normalised values.
    pub(super) fn write(&self, active: &ActiveVertices, x: &mut [f64]) {
        if !self.takes_mean || self.is_empty() {
            return;
        }
        let mut sums = vec![(0.0, 0_u32); self.is_unconstrained.len()];
        for &v in active.list() {
            if let Some(component) = active.component(v) {
                let (sum, count) = &mut sums[component];
                *sum += x[v as usize];
                *count += 1;
            }
        }
        for &v in active.list() {
            if let Some(component) = active.component(v)
                && self.is_unconstrained[component]
            {
                let (sum, count) = sums[component];
                x[v as usize] = sum / f64::from(count);
            }
        }
    }

    /// Whether a vertex gets another value than it had, though it is no unknown.
    pub(super) fn moves(&self, active: &ActiveVertices, vertex: u32) -> bool {
        self.takes_mean && active.component(vertex).is_some_and(|component| self.is_unconstrained[component])
    }
}
