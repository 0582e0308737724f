//! A little memory that is set aside before each call, so that what is small can be made even where memory has run out: names of
//! options, errors, results.

use core::cell::Cell;

use wasm_bindgen::prelude::*;

use crate::support::memory;

/// Bytes that are enough for whatever is small.
const SMALL: usize = 32 << 10;

thread_local! {
    static RESERVE: Cell<Vec<u8>> = const { Cell::new(Vec::new()) };
}

/// Sets memory aside for the end of a call, and makes sure of as much for its beginning. Returns the bytes that cannot be had: 0 where
/// all is well.
#[must_use]
#[wasm_bindgen(js_name = setAside)]
pub fn set_aside() -> usize {
    let mut reserve = RESERVE.take();
    let is_there = reserve.capacity() > 0 || reserve.try_reserve_exact(SMALL).is_ok();
    RESERVE.set(reserve);
    if is_there && memory::ensure(SMALL as u64).is_ok() { 0 } else { SMALL }
}

/// Gives the memory back that was set aside: the work is done, and its result or error is to be handed over.
#[inline(never)]
pub(in crate::wasm) fn release() {
    drop(RESERVE.take());
}
