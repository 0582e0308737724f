//! Fields with several values per vertex: taken apart, normalised, and put together again.

use std::sync::Arc;

use crate::error::{FieldError, OptionError, Result};
use crate::field::{ValueRange, value_range};
use crate::mesh::{LinkKind, TriMesh};
use crate::support::memory;

/// Channels that are solved for at once: as many as a factor in double precision takes together. Any number of channels
/// takes the memory of so many.
pub(super) const TOGETHER: usize = 4;

/// One channel of the input.
#[derive(Debug)]
pub(super) struct Channel {
    /// NaN where values are missing.
    pub(super) values: Vec<f64>,
    pub(super) range: ValueRange,
    /// (value − min)/(max − min); zero for a constant, where values are missing, and at isolated vertices, which take no part in the
    /// range.
    pub(super) normalized: Vec<f64>,
}

impl Channel {
    fn new(mesh: &TriMesh, values: Vec<f64>, range: ValueRange) -> Self {
        let mut channel = Self { values: Vec::new(), range, normalized: Vec::new() };
        channel.normalized = channel.normalize(mesh, &values);
        Self { values, ..channel }
    }

    /// Values in the units of the input, scaled by its range.
    pub(super) fn normalize(&self, mesh: &TriMesh, values: &[f64]) -> Vec<f64> {
        let length = self.range.length();
        let kinds = mesh.connectivity().link_kinds();
        let counts = |kind: LinkKind| length > 0.0 && kind != LinkKind::Isolated;
        let scaled = |(v, &kind): (&f64, &LinkKind)| {
            if counts(kind) && !v.is_nan() { (v - self.range.min) / length } else { 0.0 }
        };
        values.iter().zip(kinds).map(scaled).collect()
    }

    /// Normalised values back in the units of the input. Only `changed` vertices can have new ones: the others keep theirs to the
    /// last bit.
    ///
    /// # Errors
    /// `RangeOverflow` where a new value is beyond the range of doubles: what is smoothed can overshoot.
    pub(super) fn restored<'a>(
        &self,
        x: &[f64],
        changed: impl Iterator<Item = &'a u32>,
    ) -> Result<Vec<f64>, FieldError> {
        let mut values = self.values.clone();
        let mut is_finite = true;
        for &v in changed {
            let value = self.range.min + self.range.length() * x[v as usize];
            is_finite &= value.is_finite();
            values[v as usize] = value;
        }
        if is_finite { Ok(values) } else { Err(FieldError::RangeOverflow {}) }
    }
}

/// All channels of a call, checked.
#[derive(Debug)]
pub(super) struct Channels<'a> {
    interleaved: &'a [f64],
    ranges: Vec<ValueRange>,
    /// The vertices whose values are missing in some channel, ascending; nothing where none may be.
    missing: Arc<[u32]>,
}

impl<'a> Channels<'a> {
    /// Checks the values. `missing` are the vertices that have none, ascending.
    ///
    /// # Errors
    /// `InvalidOption` for no channels at all; `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`.
    pub(super) fn new(mesh: &TriMesh, values: &'a [f64], channels: usize, missing: Arc<[u32]>) -> Result<Self> {
        let n = mesh.vertex_count();
        if channels == 0 {
            return Err(OptionError::invalid("channels", "a positive integer").into());
        }
        memory::ensure(16 * n as u64)?;
        if n.checked_mul(channels) != Some(values.len()) {
            let expected = n.saturating_mul(channels);
            return Err(FieldError::length_mismatch(expected, values.len(), mesh.triangle_count()).into());
        }
        let mut all = Self { interleaved: values, ranges: Vec::new(), missing };
        all.ranges = (0..channels).map(|c| all.range(mesh, c, channels)).collect::<Result<_>>()?;
        Ok(all)
    }

    /// The range of the values that there are.
    fn range(&self, mesh: &TriMesh, channel: usize, channels: usize) -> Result<ValueRange> {
        let mut values = column(self.interleaved, channel, channels);
        if let Some(&first) = self.missing.first() {
            // Another value stands for each one that is missing: that of a vertex of a triangle, if there is one.
            let kinds = mesh.connectivity().link_kinds();
            let has = |&v: &usize| self.missing.binary_search(&(v as u32)).is_err();
            let example = (0..values.len()).filter(has).max_by_key(|&v| kinds[v] != LinkKind::Isolated);
            let Some(example) = example else { return Err(FieldError::NonFiniteValue { vertex: first }.into()) };
            let value = values[example];
            self.missing.iter().for_each(|&v| values[v as usize] = value);
        }
        Ok(value_range(mesh.connectivity(), &values)?)
    }

    pub(super) fn count(&self) -> usize {
        self.ranges.len()
    }

    /// The values of one channel, NaN where they are missing.
    pub(super) fn values(&self, channel: usize) -> Vec<f64> {
        let mut values = column(self.interleaved, channel, self.count());
        self.missing.iter().for_each(|&v| values[v as usize] = f64::NAN);
        values
    }

    /// A few channels at a time: the first one's number, and the channels.
    pub(super) fn groups(&self, mesh: &TriMesh) -> impl Iterator<Item = (usize, Vec<Channel>)> {
        (0..self.count()).step_by(TOGETHER).map(move |first| {
            let numbers = first..self.count().min(first + TOGETHER);
            (first, numbers.map(|c| Channel::new(mesh, self.values(c), self.ranges[c])).collect())
        })
    }

    /// The most channels of a group.
    pub(super) fn most_together(&self) -> usize {
        self.count().min(TOGETHER)
    }

    /// How many groups there are.
    pub(super) fn group_count(&self) -> usize {
        self.count().div_ceil(TOGETHER)
    }

    /// The input, for results to be written over it.
    pub(super) fn to_interleaved(&self) -> Vec<f64> {
        self.interleaved.to_vec()
    }

    /// Writes one channel's values over the interleaved ones.
    pub(super) fn write(&self, channel: usize, values: &[f64], interleaved: &mut [f64]) {
        for (place, &value) in interleaved.iter_mut().skip(channel).step_by(self.count()).zip(values) {
            *place = value;
        }
    }
}

/// One channel of interleaved values.
fn column(values: &[f64], channel: usize, channels: usize) -> Vec<f64> {
    values.iter().skip(channel).step_by(channels).copied().collect()
}
