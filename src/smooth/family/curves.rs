//! What becomes of norms and critical points along ε.

use super::choose;
use super::estimate::logarithmic;
use super::members::{Family, check_epsilon};
use super::space::Space;
use crate::error::{OptionError, Result};
use crate::field::{DeltaOptions, ScalarField, critical_points};
use crate::smooth::report::energies;
use crate::solve::Rows;
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// What [`Family::sweep`] looks at.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SweepOptions<'a> {
    /// The values of ε, each in the range of the family. Default 41 in equal steps of their logarithms, both ends of the range included.
    pub epsilons: Option<&'a [f64]>,
    /// Whether critical points are counted, too, which takes longer than all the rest. Default false.
    pub counts: bool,
    /// The channel. Default the first.
    pub channel: usize,
}

impl SweepOptions<'_> {
    /// What can be told before there is a family, of its range and channels.
    ///
    /// # Errors
    /// `InvalidOption` for an ε outside of the range, and for the channel.
    pub(crate) fn check(&self, range: (f64, f64), channels: usize) -> Result<(), OptionError> {
        if self.channel >= channels {
            return Err(OptionError::invalid("channel", "the number of a channel, from 0"));
        }
        self.epsilons.unwrap_or_default().iter().try_for_each(|&epsilon| check_epsilon(range, epsilon))
    }
}

/// Norms and critical points of the smoothed field for each of several ε. Norms are of the field normalised to [0, 1] by the range of the
/// input, as in [`SmoothReport`](crate::smooth::SmoothReport).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct Sweep {
    /// ε.
    pub epsilons: Vec<f64>,
    /// max |x − f|.
    pub l_infinity: Vec<f64>,
    /// ‖x − f‖_B in the metric used.
    pub metric_norm: Vec<f64>,
    /// ‖Lx‖₂.
    pub laplacian_norm: Vec<f64>,
    /// xᵀLx.
    pub sobolev: Vec<f64>,
    /// Numbers of minima, maxima, and saddles with multiplicity, at δ = 0; empty where they are not counted.
    pub minima: Vec<u32>,
    /// See `minima`.
    pub maxima: Vec<u32>,
    /// See `minima`.
    pub saddles: Vec<u32>,
    /// The place among these ε that is nearest to the corner of the L-curve.
    pub l_curve_corner: usize,
}

/// So many ε by default: four in each decade of the default range, and the last one.
const STEPS_PER_DECADE: f64 = 4.0;
/// The vertices that are looked at together for several ε.
const PIECE: usize = 64;

impl Family {
    /// Norms and critical points along ε, at any resolution. Without counts, each ε takes a pass over the space; with them, as long as
    /// counting critical points.
    ///
    /// # Errors
    /// `InvalidOption` for an ε outside of the range, and for the channel; `Cancelled`; `OutOfMemory`.
    pub fn sweep(&self, options: &SweepOptions<'_>, watch: &Watch<'_>) -> Result<Sweep> {
        options.check(self.range, self.spaces.len())?;
        let epsilons = match options.epsilons {
            Some(epsilons) => epsilons.to_vec(),
            None => logarithmic(self.range, STEPS_PER_DECADE),
        };
        let space = &self.spaces[options.channel];
        let steps = [(Phase::Report, 1.0), (Phase::Report, if options.counts { 10.0 } else { 0.0 })];
        let mut plan = watch.plan(&steps);
        let n = self.field.operators.mesh.vertex_count();
        plan.begin((2 * epsilons.len() * space.dimension() * n) as u64)?;
        let small = 8 * (epsilons.len() * (space.dimension() + 8)) as u64 + choose::grid_bytes(self.range);
        memory::ensure(64 * n as u64 + small)?;
        let (l_infinity, [laplacian, sobolev]) = self.elsewhere(options.channel)?;
        let is_known: Vec<bool> =
            self.matrices.unknowns().iter().map(|&v| !self.field.is_missing(v as usize)).collect();
        let mut sweep = Sweep {
            l_infinity: space.largest_differences(&epsilons, &is_known, l_infinity, watch)?,
            metric_norm: Vec::with_capacity(epsilons.len()),
            laplacian_norm: Vec::with_capacity(epsilons.len()),
            sobolev: Vec::with_capacity(epsilons.len()),
            minima: Vec::new(),
            maxima: Vec::new(),
            saddles: Vec::new(),
            l_curve_corner: 0,
            epsilons,
        };
        for &epsilon in &sweep.epsilons {
            let (squared, energy) = space.energies(epsilon);
            sweep.metric_norm.push(space.metric_norm(epsilon));
            sweep.laplacian_norm.push((squared + laplacian).sqrt());
            sweep.sobolev.push(energy + sobolev);
        }
        if let Some(corner) = choose::l_curve_corners(core::slice::from_ref(space), self.range).first() {
            let distance = |epsilon: f64| libm::log(epsilon / corner).abs();
            let places = (0..sweep.epsilons.len())
                .min_by(|&a, &b| distance(sweep.epsilons[a]).total_cmp(&distance(sweep.epsilons[b])));
            sweep.l_curve_corner = places.unwrap_or(0);
        }
        if options.counts {
            plan.begin((sweep.epsilons.len() * n) as u64 * 200)?;
            for &epsilon in &sweep.epsilons {
                let [minima, maxima, saddles] = self.counts(epsilon, options.channel, watch)?;
                sweep.minima.push(minima);
                sweep.maxima.push(maxima);
                sweep.saddles.push(saddles);
            }
        }
        plan.finish()?;
        Ok(sweep)
    }

    /// The numbers of minima, of maxima, and of saddles with multiplicity, of one channel.
    pub(super) fn counts(&self, epsilon: f64, channel: usize, watch: &Watch<'_>) -> Result<[u32; 3]> {
        memory::ensure(self.channel_bytes())?;
        let values = self.channel_values(epsilon, channel)?;
        let field = ScalarField::with_missing(&self.field.operators.mesh, &values, self.field.missing_after())?;
        let counts = critical_points(&field, &DeltaOptions::default(), watch)?.counts;
        Ok([counts.minima, counts.maxima, counts.saddles])
    }

    /// What vertices that are no unknowns add to the norms: max |x − f|, ‖Lx‖² and xᵀLx.
    fn elsewhere(&self, channel: usize) -> Result<(f64, [f64; 2])> {
        let zeros = vec![0.0; self.matrices.unknowns().len()];
        let (x, _) = self.whole(channel, &zeros)?;
        let normalized = &self.field.channels[channel].normalized;
        let mut is_unknown = vec![false; x.len()];
        self.matrices.unknowns().iter().for_each(|&v| is_unknown[v as usize] = true);
        let moves = |v: &usize| !is_unknown[*v] && !self.field.is_missing(*v);
        let largest = (0..x.len()).filter(moves).map(|v| (x[v] - normalized[v]).abs()).fold(0.0, f64::max);
        let energies = energies(&self.field.operators.laplacian, &x);
        Ok((largest, [energies.laplacian_norm * energies.laplacian_norm, energies.sobolev]))
    }
}

impl Space {
    /// max |x − f| over the unknowns whose values are known, for several ε, and no less than `least`.
    fn largest_differences(
        &self,
        epsilons: &[f64],
        is_known: &[bool],
        least: f64,
        watch: &Watch<'_>,
    ) -> Result<Vec<f64>> {
        // Those of four ε side by side.
        let mut groups = Vec::with_capacity(epsilons.len().div_ceil(4));
        for four in epsilons.chunks(4) {
            let mut group = vec![[0.0; 4]; self.dimension()];
            for (j, &epsilon) in four.iter().enumerate() {
                group.iter_mut().zip(self.coefficients_of(epsilon)).for_each(|(place, c)| place[j] = c);
            }
            groups.push(group);
        }
        let mut largest = vec![[least; 4]; groups.len()];
        let (mut rows, mut known) = (Rows::default(), Vec::with_capacity(PIECE / 4));
        for start in (0..is_known.len()).step_by(PIECE) {
            let count = PIECE.min(is_known.len() - start);
            watch.tick((epsilons.len() * self.dimension() * count / 4) as u64)?;
            rows.gather(self.basis(), start, count);
            // Nothing differs from NaN.
            let value = |i: usize| if i < count && is_known[start + i] { self.field()[start + i] } else { f64::NAN };
            known.clear();
            known.extend((0..count).step_by(4).map(|i| [value(i), value(i + 1), value(i + 2), value(i + 3)]));
            for (largest, group) in largest.iter_mut().zip(&groups) {
                for (sums, f) in rows.combinations(group).zip(&known) {
                    for (largest, x) in largest.iter_mut().zip(sums) {
                        for i in 0..4 {
                            let difference = (x[i] - f[i]).abs();
                            *largest = if difference > *largest { difference } else { *largest };
                        }
                    }
                }
            }
        }
        let mut largest = largest.into_flattened();
        largest.truncate(epsilons.len());
        Ok(largest)
    }
}
