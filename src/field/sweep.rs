//! The two directions in which a field is swept.

use super::order::VertexOrder;

/// Sweeps the vertices upwards (sublevel sets grow, from minima) or downwards (superlevel sets grow, from maxima), so that
/// one piece of code serves both.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sweep<'a> {
    order: VertexOrder<'a>,
    downwards: bool,
}

impl<'a> Sweep<'a> {
    pub(super) fn upwards(order: VertexOrder<'a>) -> Self {
        Self { order, downwards: false }
    }

    pub(super) fn downwards(order: VertexOrder<'a>) -> Self {
        Self { order, downwards: true }
    }

    /// Whether `a` is met before `b`.
    #[inline]
    pub(super) fn precedes(self, a: u32, b: u32) -> bool {
        self.order.is_below(a, b) != self.downwards
    }

    pub(super) fn values(self) -> &'a [f64] {
        self.order.values()
    }

    pub(super) fn is_downwards(self) -> bool {
        self.downwards
    }
}
