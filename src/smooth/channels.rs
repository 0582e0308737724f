//! Fields with several values per vertex: taken apart, normalised, and put together again.

use super::{Phase, Progress};
use crate::error::{FieldError, OptionError, Result};
use crate::field::{ValueRange, value_range};
use crate::mesh::{LinkKind, TriMesh};

/// Channels that are solved for at once: as many as a factor in double precision takes together. Any number of channels
/// takes the memory of so many.
pub(super) const TOGETHER: usize = 4;

/// One channel of the input.
#[derive(Debug)]
pub(super) struct Channel {
    pub(super) values: Vec<f64>,
    pub(super) range: ValueRange,
    /// (value − min)/(max − min); zero for a constant, and at isolated vertices, which take no part in the range.
    pub(super) normalized: Vec<f64>,
}

impl Channel {
    fn new(mesh: &TriMesh, values: Vec<f64>, range: ValueRange) -> Self {
        let length = range.length();
        let kinds = mesh.connectivity().link_kinds();
        let counts = |kind: LinkKind| length > 0.0 && kind != LinkKind::Isolated;
        let scaled = |(v, &kind): (&f64, &LinkKind)| if counts(kind) { (v - range.min) / length } else { 0.0 };
        let normalized = values.iter().zip(kinds).map(scaled).collect();
        Self { values, range, normalized }
    }

    /// Normalised values back in the units of the input. Only `changed` vertices can have new ones: the others keep theirs to the
    /// last bit.
    pub(super) fn restored(&self, x: &[f64], changed: &[u32]) -> Vec<f64> {
        let mut values = self.values.clone();
        for &v in changed {
            values[v as usize] = self.range.min + self.range.length() * x[v as usize];
        }
        values
    }
}

/// All channels of a call, checked.
#[derive(Debug)]
pub(super) struct Channels<'a> {
    interleaved: &'a [f64],
    ranges: Vec<ValueRange>,
}

impl<'a> Channels<'a> {
    /// # Errors
    /// `InvalidOption` for no channels at all; `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`.
    pub(super) fn new(mesh: &TriMesh, values: &'a [f64], channels: usize) -> Result<Self> {
        let n = mesh.vertex_count();
        if channels == 0 {
            let expected = "a positive integer".to_owned();
            return Err(OptionError::InvalidOption { option: "channels".to_owned(), expected }.into());
        }
        if n.checked_mul(channels) != Some(values.len()) {
            let expected = n.saturating_mul(channels);
            return Err(FieldError::length_mismatch(expected, values.len(), mesh.triangle_count()).into());
        }
        let range = |c| Ok(value_range(mesh.connectivity(), &column(values, c, channels))?);
        let ranges = (0..channels).map(range).collect::<Result<_>>()?;
        Ok(Self { interleaved: values, ranges })
    }

    pub(super) fn count(&self) -> usize {
        self.ranges.len()
    }

    /// The values of one channel.
    pub(super) fn values(&self, channel: usize) -> Vec<f64> {
        column(self.interleaved, channel, self.count())
    }

    /// A few channels at a time: the first one's number, and the channels.
    pub(super) fn groups(&self, mesh: &TriMesh) -> impl Iterator<Item = (usize, Vec<Channel>)> {
        (0..self.count()).step_by(TOGETHER).map(move |first| {
            let numbers = first..self.count().min(first + TOGETHER);
            (first, numbers.map(|c| Channel::new(mesh, self.values(c), self.ranges[c])).collect())
        })
    }

    /// Tells the progress with some channels as that with all of them.
    pub(super) fn share_of_progress(
        &self,
        first: usize,
        count: usize,
        progress: Progress<'_>,
    ) -> impl FnMut(Phase, f64) {
        let all = self.count() as f64;
        move |phase, fraction| progress(phase, (first as f64 + fraction * count as f64) / all)
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
