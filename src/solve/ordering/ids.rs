//! Ids of vertices that may be none.

/// No vertex.
pub(super) const NONE: u32 = u32::MAX;

/// `NONE` everywhere. Like other functions of this module not inlined: the copies would only grow the wasm module.
#[inline(never)]
pub(super) fn filled(length: usize) -> Vec<u32> {
    vec![NONE; length]
}
