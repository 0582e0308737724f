//! What is smoothed: a checked field on its operators.

use std::sync::Arc;

use super::channels::Channels;
use super::missing::Gaps;
use super::operators::Operators;

/// The field to smooth.
pub(super) struct Input<'a> {
    pub(super) operators: &'a Arc<Operators>,
    pub(super) channels: Channels<'a>,
    /// Where values are missing and to be filled in.
    pub(super) gaps: Option<Gaps<'a>>,
}
