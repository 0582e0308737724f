//! What has to be drawn in each strip.

use crate::error::OutOfMemory;
use crate::support::memory::with_room;

/// Things by the strip that they are in, in compressed rows.
pub(super) struct Binned {
    offsets: Vec<usize>,
    items: Vec<u32>,
}

impl Binned {
    /// `strips`: the first and last strip of a thing, nothing where it is in none.
    pub(super) fn new(
        count: usize,
        strip_count: usize,
        strips: impl Fn(usize) -> Option<[usize; 2]>,
    ) -> Result<Self, OutOfMemory> {
        let mut offsets = vec![0_usize; strip_count + 1];
        for [first, last] in (0..count).filter_map(&strips) {
            (first..=last).for_each(|strip| offsets[strip + 1] += 1);
        }
        for strip in 0..strip_count {
            offsets[strip + 1] += offsets[strip];
        }
        let mut next = offsets.clone();
        let mut items = with_room(offsets[strip_count])?;
        items.resize(offsets[strip_count], 0);
        for item in 0..count {
            if let Some([first, last]) = strips(item) {
                for strip in first..=last {
                    items[next[strip]] = item as u32;
                    next[strip] += 1;
                }
            }
        }
        Ok(Self { offsets, items })
    }

    pub(super) fn of(&self, strip: usize) -> &[u32] {
        &self.items[self.offsets[strip]..self.offsets[strip + 1]]
    }
}
