//! Sorting by small keys: items are gathered in buckets, one for each key, in the order in which they come.

/// The items of each bucket, one bucket after the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Buckets {
    /// Where each bucket starts among the items; one more for the end of the last one.
    pub(crate) offsets: Vec<u32>,
    /// The items, in the order of their buckets.
    pub(crate) items: Vec<u32>,
}

impl Buckets {
    /// The items of one bucket.
    #[inline]
    pub(crate) fn bucket(&self, key: u32) -> &[u32] {
        &self.items[self.offsets[key as usize] as usize..self.offsets[key as usize + 1] as usize]
    }
}

/// Sorts the numbers from 0 into `buckets` buckets by their keys, which a slice holds. Stable: within a bucket the
/// numbers ascend.
#[inline(never)]
pub(crate) fn grouped(keys: &[u32], buckets: usize) -> Buckets {
    let mut offsets = vec![0_u32; buckets + 1];
    for &key in keys {
        offsets[key as usize] += 1;
    }
    let mut sum = 0;
    for offset in &mut offsets {
        sum += *offset;
        *offset = sum;
    }
    let mut items = vec![0; keys.len()];
    for (item, &key) in keys.iter().enumerate().rev() {
        offsets[key as usize] -= 1;
        items[offsets[key as usize] as usize] = item as u32;
    }
    Buckets { offsets, items }
}

/// Where each bucket starts, and the end of the last one, for items with these keys.
pub(crate) fn offsets(buckets: usize, keys: &mut dyn Iterator<Item = u32>) -> Vec<u32> {
    let mut offsets = vec![0_u32; buckets + 1];
    for key in keys {
        offsets[key as usize + 1] += 1;
    }
    for bucket in 0..buckets {
        offsets[bucket + 1] += offsets[bucket];
    }
    offsets
}

/// Brings offsets that were moved to the ends of their buckets, as items were put there, back to the starts.
pub(crate) fn rewind(offsets: &mut [u32]) {
    for bucket in (1..offsets.len()).rev() {
        offsets[bucket] = offsets[bucket - 1];
    }
    if let Some(first) = offsets.first_mut() {
        *first = 0;
    }
}
