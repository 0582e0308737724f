//! A priority queue for small keys.

use super::ids::{NONE, filled};

/// Items in buckets by key: doubly linked lists, so that every operation but finding the next minimum is O(1).
pub(super) struct BucketQueue {
    heads: Vec<u32>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// `NONE` for an item that is not in the queue.
    keys: Vec<u32>,
    smallest: usize,
}

impl BucketQueue {
    /// For items below `items` with keys below `keys`; larger ones share the last bucket.
    #[inline(never)]
    pub(super) fn new(items: usize, keys: usize) -> Self {
        Self { heads: filled(keys), next: filled(items), previous: filled(items), keys: filled(items), smallest: 0 }
    }

    pub(super) fn key(&self, item: u32) -> u32 {
        self.keys[item as usize]
    }

    pub(super) fn holds(&self, item: u32) -> bool {
        self.keys[item as usize] != NONE
    }

    /// Adds an item that is not in the queue.
    #[inline(never)]
    pub(super) fn insert(&mut self, item: u32, key: u32) {
        let key = (key as usize).min(self.heads.len() - 1);
        let head = self.heads[key];
        self.next[item as usize] = head;
        self.previous[item as usize] = NONE;
        if head != NONE {
            self.previous[head as usize] = item;
        }
        self.heads[key] = item;
        self.keys[item as usize] = key as u32;
        self.smallest = self.smallest.min(key);
    }

    /// Takes out an item that is in the queue.
    #[inline(never)]
    pub(super) fn remove(&mut self, item: u32) {
        let (next, previous) = (self.next[item as usize], self.previous[item as usize]);
        if next != NONE {
            self.previous[next as usize] = previous;
        }
        if previous == NONE {
            self.heads[self.keys[item as usize] as usize] = next;
        } else {
            self.next[previous as usize] = next;
        }
        self.keys[item as usize] = NONE;
    }

    /// The item that came last among those of the smallest key.
    pub(super) fn first(&mut self) -> Option<u32> {
        while self.smallest < self.heads.len() {
            let head = self.heads[self.smallest];
            if head != NONE {
                return Some(head);
            }
            self.smallest += 1;
        }
        None
    }

    pub(super) fn pop(&mut self) -> Option<u32> {
        let first = self.first()?;
        self.remove(first);
        Some(first)
    }
}
