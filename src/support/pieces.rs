//! Long loops piece by piece, each of which is counted as work.

use core::ops::Range;

use super::watch::Watch;
use crate::error::Cancelled;

/// So many elements are gone through between two counts of the work: some microseconds.
const PIECE: usize = 4096;

/// The elements in pieces, each counted as work before it is handed out. `ticks` is the work with one element.
#[inline]
pub(crate) fn pieces<'a, T>(
    elements: &'a [T],
    ticks: u64,
    watch: &'a Watch<'_>,
) -> impl Iterator<Item = Result<&'a [T], Cancelled>> {
    elements.chunks(PIECE).map(move |piece| watch.tick(ticks * piece.len() as u64).map(|()| piece))
}

/// The numbers from 0 below `count` in pieces, each counted as work before it is handed out.
#[inline]
pub(crate) fn ranges<'a>(
    count: usize,
    ticks: u64,
    watch: &'a Watch<'_>,
) -> impl Iterator<Item = Result<Range<usize>, Cancelled>> + 'a {
    (0..count).step_by(PIECE).map(move |start| {
        let end = count.min(start + PIECE);
        watch.tick(ticks * (end - start) as u64).map(|()| start..end)
    })
}
