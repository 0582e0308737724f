//! What several modules have: arrays and options in, objects and errors out.

pub(super) mod answer;
pub(super) mod arrays;
pub(super) mod error;
pub(super) mod record;
pub(super) mod reserve;
pub(super) mod warnings;
pub(super) mod weld;
