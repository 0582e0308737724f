//! The total order of the vertices by (value, id): simulation of simplicity \[Edelsbrunner90\].

use crate::error::{FieldError, OptionError};
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
            return Err(FieldError::length_mismatch(vertices, values.len(), 0));
        }
        // The sum of v·0 is zero unless a value is not finite: one pass without branches; the search is for the message.
        let (mut nothing, mut min, mut max) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
        for &v in values {
            nothing += v * 0.0;
            min = if v < min { v } else { min };
            max = if v > max { v } else { max };
        }
        if nothing != 0.0 {
            let vertex = values.iter().position(|v| !v.is_finite()).unwrap_or(0) as u32;
            return Err(FieldError::NonFiniteValue { vertex });
        }
        if values.is_empty() || (max - min).is_finite() {
            Ok(Self { values })
        } else {
            Err(FieldError::RangeOverflow {})
        }
    }

    /// The order of values that were checked before.
    pub(crate) fn of_checked(values: &'a [f64]) -> Self {
        Self { values }
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
/// Those of [`VertexOrder::new`].
pub fn value_range(connectivity: &Connectivity, values: &[f64]) -> Result<ValueRange, FieldError> {
    let (vertices, triangles) = (connectivity.vertex_count(), connectivity.triangles().len());
    if values.len() != vertices {
        return Err(FieldError::length_mismatch(vertices, values.len(), triangles));
    }
    let values = VertexOrder::new(values, vertices)?.values();
    let kinds = connectivity.link_kinds();
    let (mut min, mut max) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..values.len() {
        if kinds[i] != LinkKind::Isolated {
            min = if values[i] < min { values[i] } else { min };
            max = if values[i] > max { values[i] } else { max };
        }
    }
    Ok(ValueRange { min, max })
}

/// A difference of values that divides what matters from what does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// A fraction of the range of the field.
    Relative(f64),
    /// In the units of the values.
    Absolute(f64),
}

impl Default for Threshold {
    fn default() -> Self {
        Self::Relative(0.0)
    }
}

impl Threshold {
    /// In the units of the values. `option` is its name in errors.
    pub(crate) fn absolute(self, range: ValueRange, option: &str) -> Result<f64, OptionError> {
        let (Self::Relative(threshold) | Self::Absolute(threshold)) = self;
        if !(threshold.is_finite() && threshold >= 0.0) {
            return Err(OptionError::invalid(option, "a finite number that is not negative"));
        }
        Ok(match self {
            Self::Absolute(_) => threshold,
            // A product that overflows is beyond all differences.
            Self::Relative(_) => (threshold * range.length()).min(f64::MAX),
        })
    }
}
