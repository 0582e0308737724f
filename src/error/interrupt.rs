//! What can end the work of any stage.

/// The work was stopped by whoever watches it ([`Watch`](crate::Watch)). Every stage's error has a variant for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cancelled;

/// Memory that cannot be had. Every stage's error has a variant for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutOfMemory {
    /// Bytes needed.
    pub bytes: u64,
}
