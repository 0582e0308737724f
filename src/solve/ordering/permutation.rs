//! Renumberings of unknowns.

use crate::error::SolveError;

/// A renumbering of unknowns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Permutation {
    new_to_old: Vec<u32>,
    old_to_new: Vec<u32>,
}

impl Permutation {
    /// From the old ids in their new order.
    ///
    /// # Errors
    /// `DimensionMismatch` where an id is missing or comes twice.
    pub fn new(new_to_old: Vec<u32>) -> Result<Self, SolveError> {
        let n = new_to_old.len();
        let mut old_to_new = vec![u32::MAX; n];
        for (new, &old) in new_to_old.iter().enumerate() {
            match old_to_new.get_mut(old as usize) {
                Some(place) if *place == u32::MAX => *place = new as u32,
                _ => return Err(SolveError::DimensionMismatch { expected: n, actual: old as usize }),
            }
        }
        Ok(Self { new_to_old, old_to_new })
    }

    /// From ids that are known to be a permutation.
    pub(in crate::solve) fn from_valid(new_to_old: Vec<u32>) -> Self {
        let mut old_to_new = vec![0; new_to_old.len()];
        for (new, &old) in new_to_old.iter().enumerate() {
            old_to_new[old as usize] = new as u32;
        }
        Self { new_to_old, old_to_new }
    }

    /// The old id at every new place.
    #[must_use]
    pub fn new_to_old(&self) -> &[u32] {
        &self.new_to_old
    }

    /// The new place of every old id.
    #[must_use]
    pub fn old_to_new(&self) -> &[u32] {
        &self.old_to_new
    }
}
