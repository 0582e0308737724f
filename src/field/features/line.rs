//! Values on a line, with the sums that k-means needs of any interval.

use crate::error::FieldError;
use crate::field::arrays::{collected, with_room};
use crate::field::scalar_field::ScalarField;
use crate::field::sorting::sort_by_value;
use crate::mesh::LinkKind;
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// The values of the vertices that belong to a triangle, by ascending (value, id), as integers: (f − min) 2^e, rounded down.
///
/// With n ≤ 2^L they are below 2^B for B = (127 − L)/2, so that sums of squared distances stay below 2^(2B + L + 1) ≤ 2^128:
/// nothing is rounded, nothing cancels. A power of two leaves differences of short numbers what they are, and ties with them.
pub(super) struct Line {
    ids: Vec<u32>,
    places: Vec<u64>,
    /// Σ x over the places before each, and over all.
    sums: Vec<u128>,
    /// Σ x² over the same.
    squares: Vec<u128>,
}

impl Line {
    pub(super) fn new(field: &ScalarField<'_>, watch: &Watch<'_>) -> Result<Self, FieldError> {
        let (values, range) = (field.values(), field.range());
        let kinds = field.mesh().connectivity().link_kinds();
        let connected = (0..values.len() as u32).filter(|&v| kinds[v as usize] != LinkKind::Isolated);
        let mut ids = collected(field.mesh().connectivity().referenced_vertex_count(), connected)?;
        sort_by_value(&mut ids, values, watch)?;
        let bits = (127 - (usize::BITS - ids.len().leading_zeros()) as i32) / 2;
        let scale = bits - 1 - exponent(range.length());
        // 2^e need not be a number where the range is small; its two halves are.
        let (first, second) = (power_of_two(scale / 2), power_of_two(scale - scale / 2));
        let mut this = Self {
            places: with_room(ids.len())?,
            sums: with_room(ids.len() + 1)?,
            squares: with_room(ids.len() + 1)?,
            ids: Vec::new(),
        };
        let (mut sum, mut square) = (0_u128, 0_u128);
        this.sums.push(sum);
        this.squares.push(square);
        for piece in ranges(ids.len(), 20, watch) {
            for &id in &ids[piece?] {
                let place = ((values[id as usize] - range.min) * first * second) as u64;
                sum += u128::from(place);
                square += u128::from(place) * u128::from(place);
                this.places.push(place);
                this.sums.push(sum);
                this.squares.push(square);
            }
        }
        this.ids = ids;
        Ok(this)
    }

    pub(super) fn len(&self) -> usize {
        self.ids.len()
    }

    pub(super) fn ids(&self) -> &[u32] {
        &self.ids
    }

    pub(super) fn place(&self, index: usize) -> u64 {
        self.places[index]
    }

    /// Σ x over an interval.
    pub(super) fn sum(&self, start: usize, end: usize) -> u128 {
        self.sums[end] - self.sums[start]
    }

    /// The mean over an interval that is not empty, rounded down.
    pub(super) fn mean(&self, start: usize, end: usize) -> u64 {
        (self.sum(start, end) / (end - start) as u128) as u64
    }

    /// Σ (x − c)² over an interval.
    #[inline(never)]
    pub(super) fn spread(&self, start: usize, end: usize, centre: u64) -> u128 {
        let (squares, c) = (self.squares[end] - self.squares[start], u128::from(centre));
        squares + (end - start) as u128 * c * c - 2 * c * self.sum(start, end)
    }

    /// The first of an interval that lies above a place; its end where there is none.
    #[inline(never)]
    pub(super) fn first_above(&self, start: usize, end: usize, place: u64) -> usize {
        start + self.places[start..end].partition_point(|&other| other <= place)
    }
}

/// ⌊log₂⌋ of a number that is not negative; that of the least one for 0.
fn exponent(number: f64) -> i32 {
    let bits = number.to_bits();
    match bits >> 52 {
        0 => -1074 + 63 - (bits | 1).leading_zeros() as i32,
        biased => biased as i32 - 1023,
    }
}

/// For exponents of normal numbers.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}
