//! The total order of the vertices by (value, id): simulation of simplicity \[Edelsbrunner90\].

use crate::error::FieldError;
use crate::mesh::{Connectivity, LinkKind};

/// One finite value per vertex, ordered by (value, id), so that no two vertices are ever equal.
#[derive(Debug, Clone, Copy)]
pub struct VertexOrder<'a> {
    values: &'a [f64],
}

impl<'a> VertexOrder<'a> {
    /// Checks that there is one finite value for each of the `vertices` and that differences do not overflow.
    ///
    /// # Errors
    /// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`.
    #[inline(never)]
    pub fn new(values: &'a [f64], vertices: usize) -> Result<Self, FieldError> {
        if values.len() != vertices {
            return Err(FieldError::LengthMismatch { expected: vertices, actual: values.len() });
        }
        // The sum of v·0 is zero unless a value is not finite: one pass without branches; the search is for the message.
        if values.iter().map(|v| v * 0.0).sum::<f64>() != 0.0 {
            let vertex = values.iter().position(|v| !v.is_finite()).unwrap_or(0) as u32;
            return Err(FieldError::NonFiniteValue { vertex });
        }
        let (min, max) = extent(values.iter().copied());
        if values.is_empty() || (max - min).is_finite() {
            Ok(Self { values })
        } else {
            Err(FieldError::RangeOverflow {})
        }
    }

    /// The values.
    #[must_use]
    pub fn values(self) -> &'a [f64] {
        self.values
    }

    /// Whether `a` comes before `b`.
    ///
    /// # Panics
    /// Where a vertex does not exist.
    #[inline]
    #[must_use]
    pub fn is_below(self, a: u32, b: u32) -> bool {
        let (x, y) = (self.values[a as usize], self.values[b as usize]);
        // Without branches: which of two neighbours is lower cannot be foretold where a field is rough.
        (x < y) | ((x == y) & (a < b))
    }
}

/// Smallest and largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueRange {
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
}

impl ValueRange {
    /// max − min.
    #[must_use]
    pub fn length(self) -> f64 {
        self.max - self.min
    }
}

/// The range of the values at the vertices that belong to a triangle.
///
/// # Errors
/// As [`VertexOrder::new`].
pub fn value_range(connectivity: &Connectivity, values: &[f64]) -> Result<ValueRange, FieldError> {
    let values = VertexOrder::new(values, connectivity.vertex_count())?.values();
    let kinds = connectivity.link_kinds();
    let (min, max) =
        extent(values.iter().zip(kinds).filter(|&(_, &kind)| kind != LinkKind::Isolated).map(|(&value, _)| value));
    Ok(ValueRange { min, max })
}

fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), v| {
        (if v < min { v } else { min }, if v > max { v } else { max })
    })
}
