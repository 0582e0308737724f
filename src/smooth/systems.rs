//! The systems of the last calls, kept for the next ones.

use std::sync::Arc;

use super::data_term::DataTerm;
use super::operators::Operators;
use super::system::{Energy, ReducedSystem, RegularizedSystem};
use crate::error::Result;
use crate::support::watch::Watch;

/// The last system of each kind, with its analyses. They are borrowed apart from the [`Operators`] that they are made from.
#[derive(Debug, Default)]
pub(super) struct Systems {
    /// With all active vertices as unknowns.
    all: Option<RegularizedSystem>,
    /// Without the components that the last constraints did not reach.
    partial: Option<RegularizedSystem>,
    /// With the vertices that the last constraints left free.
    reduced: Option<ReducedSystem>,
}

impl Systems {
    /// The regularised system with these unknowns and this data term. Other systems lose their factors, as each can take most of the
    /// memory; analyses stay.
    pub(super) fn regularized(
        &mut self,
        operators: &Operators,
        unknowns: &[u32],
        term: &Arc<DataTerm>,
        watch: &Watch<'_>,
    ) -> Result<&mut RegularizedSystem> {
        self.reduced.iter_mut().for_each(ReducedSystem::drop_factor);
        let has_all = unknowns.len() == operators.active.list().len();
        let (slot, other) =
            if has_all { (&mut self.all, &mut self.partial) } else { (&mut self.partial, &mut self.all) };
        other.iter_mut().for_each(RegularizedSystem::drop_factor);
        if slot.as_ref().is_some_and(|system| **system.unknowns() != *unknowns) {
            *slot = None;
        }
        match slot {
            Some(system) => {
                system.set_term(operators, term, watch)?;
                Ok(system)
            }
            none => Ok(none.insert(RegularizedSystem::new(operators, unknowns, term, watch)?)),
        }
    }

    /// Whether some regularised system has been solved before, so that a pattern is analysed.
    pub(super) fn is_analysed(&self) -> bool {
        self.all.is_some() || self.partial.is_some()
    }

    /// The reduced system with these free vertices. Other systems lose their factors.
    pub(super) fn reduced(
        &mut self,
        operators: &Operators,
        energy: Energy,
        free: &[u32],
        watch: &Watch<'_>,
    ) -> Result<&mut ReducedSystem> {
        self.all.iter_mut().for_each(RegularizedSystem::drop_factor);
        self.partial.iter_mut().for_each(RegularizedSystem::drop_factor);
        if self.reduced.as_ref().is_some_and(|system| !system.is_for(energy, free)) {
            self.reduced = None;
        }
        match &mut self.reduced {
            Some(system) => Ok(system),
            none => Ok(none.insert(ReducedSystem::new(operators, energy, free, watch)?)),
        }
    }
}
