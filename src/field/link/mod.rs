//! The link of a vertex, whatever graph it is: its lower and upper part, counted, measured or named.

mod components;
mod graph;
mod sides;

pub(super) use components::{FEW, LinkScratch};
pub(super) use graph::opposite;
pub(super) use sides::LinkSides;
