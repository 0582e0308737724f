//! Memory that is made sure of before work begins, so that a shortage is an error and not the end of the program.
//!
//! In WebAssembly an allocation that fails ends the module. What allocates in many places therefore estimates its peak
//! beforehand and calls [`ensure`]; what makes one large array reserves it by [`filled`] or [`with_room`].

use crate::error::OutOfMemory;

/// What memory is asked for in. Nothing else is aligned like this, by which `tests/memory/` knows what was made sure of.
#[repr(align(64))]
struct Block {
    _bytes: [u8; 64],
}

/// Makes sure that `bytes` can be had on top of what is in use: memory grows by so much, or nothing changes.
///
/// The memory is taken in one piece, or in a few where one cannot be so large, and given back at once. The allocator of WebAssembly
/// keeps it, as memory never shrinks, and cuts what is asked for next from it.
///
/// # Errors
/// `OutOfMemory` with the bytes that were asked for.
#[inline(never)]
pub(crate) fn ensure(bytes: u64) -> Result<(), OutOfMemory> {
    hold(bytes).map(drop)
}

/// Memory that is kept for later: what is made meanwhile has to do with the rest. It is given back when this is dropped.
pub(crate) struct Held {
    _rooms: [Vec<Block>; 4],
}

/// Takes `bytes`, as [`ensure`] does, and keeps them.
///
/// # Errors
/// `OutOfMemory` with the bytes that were asked for.
pub(crate) fn hold(bytes: u64) -> Result<Held, OutOfMemory> {
    // No allocation can be larger than half of the address space, which WebAssembly can have all of.
    const LARGEST: u64 = isize::MAX as u64 / 2 / size_of::<Block>() as u64;
    let mut rooms: [Vec<Block>; 4] = [const { Vec::new() }; 4];
    let mut blocks = bytes.div_ceil(size_of::<Block>() as u64);
    for room in &mut rooms {
        let next = blocks.min(LARGEST);
        if room.try_reserve_exact(next as usize).is_err() {
            return Err(OutOfMemory { bytes });
        }
        blocks -= next;
    }
    // An allocation that nothing reads could be left out by the compiler.
    core::hint::black_box(&rooms);
    if blocks == 0 { Ok(Held { _rooms: rooms }) } else { Err(OutOfMemory { bytes }) }
}

/// An empty vector with room for `count` elements.
///
/// # Errors
/// `OutOfMemory` with the bytes that the elements take.
pub(crate) fn with_room<T>(count: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut vector = Vec::new();
    match vector.try_reserve_exact(count) {
        Ok(()) => Ok(vector),
        Err(_) => Err(OutOfMemory { bytes: (count as u64).saturating_mul(size_of::<T>() as u64) }),
    }
}

/// `count` copies of an element.
///
/// # Errors
/// `OutOfMemory` with the bytes that the elements take.
pub(crate) fn filled<T: Clone>(element: T, count: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut vector = with_room(count)?;
    vector.resize(count, element);
    Ok(vector)
}

/// Makes room for `extra` more elements, by doubling, so that pushing them takes no memory.
///
/// # Errors
/// `OutOfMemory` with the bytes of the vector that cannot be had.
#[inline]
pub(crate) fn make_room<T>(vector: &mut Vec<T>, extra: usize) -> Result<(), OutOfMemory> {
    if vector.capacity() - vector.len() >= extra { Ok(()) } else { grow(vector, extra) }
}

#[cold]
#[inline(never)]
fn grow<T>(vector: &mut Vec<T>, extra: usize) -> Result<(), OutOfMemory> {
    let capacity = (vector.len() + extra).max(2 * vector.capacity()).max(64);
    // The old elements are there beside the new ones until they have moved.
    let bytes = (capacity as u64).saturating_mul(size_of::<T>() as u64);
    ensure(bytes)?;
    vector.try_reserve_exact(capacity - vector.len()).map_err(|_| OutOfMemory { bytes })
}
