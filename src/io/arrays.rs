//! Arrays of several components become one field for each.

use super::scan::{push, reserve};
use crate::error::ParseError;
use crate::support::memory;

/// What a field's name takes at most in two lists that double, besides its letters.
const BYTES_PER_NAME: u64 = 512;

/// The components of an array in the making: `v_0`, `v_1`, … of an array `v`.
pub(super) struct Components {
    name: String,
    columns: Vec<Vec<f64>>,
    /// The column of the next number.
    place: usize,
    has_magnitude: bool,
}

impl Components {
    /// Room for `components × tuples` numbers, whose bytes must have been checked.
    pub(super) fn new(name: &str, components: u64, tuples: u64) -> Result<Self, ParseError> {
        // There are no more components and tuples than numbers, and those are there.
        let mut columns: Vec<Vec<f64>> = Vec::new();
        reserve(&mut columns, components as usize)?;
        // The names of many short columns take more than these.
        memory::ensure(components.saturating_mul(BYTES_PER_NAME + 2 * name.len() as u64))?;
        for _ in 0..components {
            let mut column = Vec::new();
            reserve(&mut column, tuples as usize)?;
            columns.push(column);
        }
        Ok(Self { name: name.to_owned(), columns, place: 0, has_magnitude: false })
    }

    /// Gives three components their length, too, as the field `v_magnitude`.
    pub(super) fn with_magnitude(mut self) -> Self {
        self.has_magnitude = self.columns.len() == 3;
        self
    }

    /// Takes the next number of the array.
    #[inline]
    pub(super) fn push(&mut self, value: f64) {
        self.columns[self.place].push(value);
        self.place = if self.place + 1 == self.columns.len() { 0 } else { self.place + 1 };
    }

    /// Hands on the fields.
    pub(super) fn finish(self, take: &mut dyn FnMut(&str, Vec<f64>)) -> Result<(), ParseError> {
        let Self { name, columns, has_magnitude, .. } = self;
        if columns.len() == 1 {
            columns.into_iter().for_each(|values| take(&name, values));
            return Ok(());
        }
        let mut lengths = Vec::new();
        if let ([x, y, z], true) = (columns.as_slice(), has_magnitude) {
            for ((x, y), z) in x.iter().zip(y).zip(z) {
                push(&mut lengths, length([*x, *y, *z]))?;
            }
        }
        for (component, values) in columns.into_iter().enumerate() {
            take(&format!("{name}_{component}"), values);
        }
        if has_magnitude {
            take(&format!("{name}_magnitude"), lengths);
        }
        Ok(())
    }
}

/// The length of a vector, also of one whose square would be beyond double precision.
fn length(vector: [f64; 3]) -> f64 {
    let largest = vector.iter().fold(0.0_f64, |largest, part| largest.max(part.abs()));
    if largest == 0.0 || !largest.is_finite() || vector.iter().any(|part| part.is_nan()) {
        return vector.iter().map(|part| part.abs()).sum();
    }
    let [x, y, z] = vector.map(|part| part / largest);
    largest * (x * x + y * y + z * z).sqrt()
}
