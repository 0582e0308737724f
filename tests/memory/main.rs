//! What is made sure of before work begins covers what the work takes: no allocation goes beyond it.
//!
//! `support::memory::ensure` asks for memory aligned to 64 bytes, as nothing else does: by that the allocator here knows it, and
//! compares all that is taken afterwards with it.
#![cfg(not(target_arch = "wasm32"))]
#![allow(unsafe_code, reason = "an allocator that counts")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

mod family;
mod field;
mod io;
mod mesh;
mod operators;
mod smooth;
mod solve;

use core::alloc::{GlobalAlloc, Layout};
use core::cell::Cell;
use std::alloc::System;

struct Counting;

thread_local! {
    static LIVE: Cell<i64> = const { Cell::new(0) };
    static ALLOWED: Cell<i64> = const { Cell::new(0) };
    static EXCESS: Cell<i64> = const { Cell::new(0) };
    static PEAK: Cell<i64> = const { Cell::new(0) };
    static LIMIT: Cell<i64> = const { Cell::new(i64::MAX) };
}

/// The alignment that only `ensure` asks for.
const MARK: usize = 64;

fn took(bytes: i64) {
    let live = LIVE.get() + bytes;
    LIVE.set(live);
    PEAK.set(PEAK.get().max(live));
    EXCESS.set(EXCESS.get().max(live - ALLOWED.get()));
}

/// Whether so much is not to be had. Small things are.
fn is_too_much(bytes: i64, align: usize) -> bool {
    let spare = if align == MARK || bytes > SMALL / 16 { 0 } else { SMALL };
    LIVE.get() + bytes > LIMIT.get().saturating_add(spare)
}

// SAFETY: every call goes to the system's allocator as it is; the counts are numbers of the thread, without allocation.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if is_too_much(layout.size() as i64, layout.align()) {
            return core::ptr::null_mut();
        }
        if layout.align() == MARK {
            ALLOWED.set(ALLOWED.get().max(LIVE.get() + layout.size() as i64));
        } else {
            took(layout.size() as i64);
        }
        // SAFETY: as this function is called.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        if layout.align() != MARK {
            LIVE.set(LIVE.get() - layout.size() as i64);
        }
        // SAFETY: as this function is called.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if is_too_much(size as i64, layout.align()) {
            return core::ptr::null_mut();
        }
        // The old and the new place can exist side by side.
        took(size as i64);
        LIVE.set(LIVE.get() - layout.size() as i64);
        // SAFETY: as this function is called.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How memory was used by a call.
pub struct Usage {
    /// Bytes beyond what was made sure of.
    pub excess: i64,
    /// The most bytes in use at once.
    pub peak: i64,
    /// The most bytes that were made sure of.
    pub ensured: i64,
}

/// Small things that no call makes sure of: texts, short lists, reports.
pub const SMALL: i64 = 64 << 10;

/// Runs a call and tells its use of memory, on top of what was there before.
pub fn usage<T>(call: impl FnOnce() -> T) -> (T, Usage) {
    let base = LIVE.get();
    ALLOWED.set(base);
    EXCESS.set(0);
    PEAK.set(base);
    let result = call();
    let usage = Usage { excess: EXCESS.get(), peak: PEAK.get() - base, ensured: ALLOWED.get() - base };
    (result, usage)
}

/// Runs a call and checks that it made sure of its memory before it took it, and of no more than `times` as much as it took.
///
/// # Panics
/// Where it did not.
#[track_caller]
pub fn check<T>(what: &str, times: f64, call: impl FnOnce() -> T) -> T {
    let (result, Usage { excess, peak, ensured }) = usage(call);
    assert!(excess <= SMALL, "{what}: {excess} bytes beyond the {ensured} made sure of (peak {peak})");
    let most = times * peak as f64 + SMALL as f64;
    assert!(ensured as f64 <= most, "{what}: {ensured} bytes made sure of where {peak} were taken");
    result
}

/// Runs a call that can have no more than so many bytes on top of what is in use. An allocation that fails without the call
/// being ready for it ends the whole test.
pub fn limited<T>(bytes: i64, call: impl FnOnce() -> T) -> T {
    LIMIT.set(LIVE.get().saturating_add(bytes));
    let result = call();
    LIMIT.set(i64::MAX);
    result
}
