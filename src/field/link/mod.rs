//! The link of a vertex, whatever graph it is: its lower and upper part, counted, measured or named.

mod graph;
mod levels;
mod sides;

pub(super) use graph::opposite;
pub(super) use levels::{FEW, LinkScratch};
pub(super) use sides::LinkSides;
