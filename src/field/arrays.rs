//! Arrays whose memory is made sure of before it is taken.

use crate::error::OutOfMemory;
use crate::support::memory;

fn ensure<T>(count: usize) -> Result<(), OutOfMemory> {
    memory::ensure((count as u64).saturating_mul(size_of::<T>() as u64))
}

/// `count` copies of an element.
pub(super) fn filled<T: Clone>(element: T, count: usize) -> Result<Vec<T>, OutOfMemory> {
    ensure::<T>(count)?;
    Ok(vec![element; count])
}

/// An empty vector with room for `count` elements.
pub(super) fn with_room<T>(count: usize) -> Result<Vec<T>, OutOfMemory> {
    ensure::<T>(count)?;
    Ok(Vec::with_capacity(count))
}

/// The elements of an iterator that are at most `count`.
pub(super) fn collected<T>(count: usize, elements: impl Iterator<Item = T>) -> Result<Vec<T>, OutOfMemory> {
    let mut vector = with_room(count)?;
    vector.extend(elements);
    Ok(vector)
}

/// A copy.
pub(super) fn copied<T: Copy>(elements: &[T]) -> Result<Vec<T>, OutOfMemory> {
    collected(elements.len(), elements.iter().copied())
}

/// The numbers from 0 below `count`.
pub(super) fn numbers(count: usize) -> Result<Vec<u32>, OutOfMemory> {
    collected(count, 0..count as u32)
}

/// Adds an element to a vector whose length is not known beforehand.
#[inline]
pub(super) fn push<T>(vector: &mut Vec<T>, element: T) -> Result<(), OutOfMemory> {
    if vector.len() == vector.capacity() {
        grow(vector, 1)?;
    }
    vector.push(element);
    Ok(())
}

/// Adds elements to a vector whose length is not known beforehand.
pub(super) fn append<T: Copy>(vector: &mut Vec<T>, elements: &[T]) -> Result<(), OutOfMemory> {
    if vector.capacity() - vector.len() < elements.len() {
        grow(vector, elements.len())?;
    }
    vector.extend_from_slice(elements);
    Ok(())
}

/// Makes room for `more` elements, and for half as many again as there are, so that elements are moved seldom.
#[cold]
#[inline(never)]
fn grow<T>(vector: &mut Vec<T>, more: usize) -> Result<(), OutOfMemory> {
    let more = more.max(vector.len() / 2).max(256);
    ensure::<T>(vector.len() + more)?;
    vector.reserve_exact(more);
    Ok(())
}
