//! Typed arrays. They are copied both ways: a view of wasm memory dies when the memory grows.

use js_sys::{Float64Array, Uint8Array, Uint32Array};

use crate::error::OutOfMemory;
use crate::support::memory;

#[inline(never)]
pub(in crate::wasm) fn floats(array: &Float64Array) -> Result<Vec<f64>, OutOfMemory> {
    copied(array.length(), |copy| array.copy_to(copy))
}

#[inline(never)]
pub(in crate::wasm) fn ids(array: &Uint32Array) -> Result<Vec<u32>, OutOfMemory> {
    copied(array.length(), |copy| array.copy_to(copy))
}

#[inline(never)]
pub(in crate::wasm) fn bytes(array: &Uint8Array) -> Result<Vec<u8>, OutOfMemory> {
    copied(array.length(), |copy| array.copy_to(copy))
}

/// A copy of a typed array.
pub(in crate::wasm) fn copied<T: Clone + Default>(
    length: u32,
    copy_to: impl FnOnce(&mut [T]),
) -> Result<Vec<T>, OutOfMemory> {
    let mut copy = memory::filled(T::default(), length as usize)?;
    // An array whose buffer was transferred has length 0, and JavaScript refuses to copy from it.
    if length > 0 {
        copy_to(&mut copy);
    }
    Ok(copy)
}
