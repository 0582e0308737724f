//! Small tools that several rooms share: they know nothing of meshes or fields.

pub(crate) mod counting_sort;
pub(crate) mod csc;
pub(crate) mod memory;
pub(crate) mod named;
pub(crate) mod pieces;
pub(crate) mod random;
pub(crate) mod union_find;
pub(crate) mod watch;
