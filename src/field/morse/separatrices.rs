//! The arcs of the Morse complex as lines on the mesh.

use super::NONE;
use super::cancellations::Cancellations;
use super::paths::Paths;
use crate::error::{FieldError, OutOfMemory, Result};
use crate::field::arrays::{filled, push};
use crate::field::critical::CriticalKind;
use crate::field::order::Threshold;
use crate::field::scalar_field::{OnMesh, Part, ScalarField};
use crate::support::memory;
use crate::support::named::named;
use crate::support::watch::{Phase, Watch};

/// How far the lines of a Morse complex are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PathStyle {
    /// Every line from its saddle to its extremum. The default.
    #[default]
    Whole,
    /// A line ends at the first vertex that an earlier one of the same direction has passed: they go on together. Only the
    /// first edge of a line can be there already.
    Merged,
}

named! { PathStyle { Whole = "whole", Merged = "merged" } }

/// Lines along edges from saddles to extrema: line k has the vertices `offsets[k]..offsets[k + 1]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MorseComplex {
    /// The vertices of the lines, from the saddle on.
    pub vertices: Vec<u32>,
    /// Where each line starts, and the number of vertices at the end.
    pub offsets: Vec<u32>,
    /// The saddle of each line.
    pub saddles: Vec<u32>,
    /// The extremum that each line leads to.
    pub extrema: Vec<u32>,
    /// Minimum or maximum.
    pub kinds: Vec<CriticalKind>,
}

impl OnMesh for MorseComplex {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        part.vertices(&mut self.vertices);
        part.vertices(&mut self.saddles);
        part.vertices(&mut self.extrema);
        Ok(())
    }
}

/// Traces the steepest paths from each saddle: one for each component of its lower and of its upper link.
///
/// An extremum whose link is in several pieces is an extremum, as [`critical_points`](crate::field::critical_points) says, but
/// components join there: it has lines as a saddle has, to the other side alone.
///
/// # Definition
/// A path starts with the steepest edge into its component of the link, and goes on along the steepest edge of every
/// vertex, (difference of values) / length, until there is none. Of equally steep edges the one to the lowest (highest)
/// (value, id) is taken. Where pairs of persistence up to `persistence` are cancelled
/// \[Edelsbrunner03\], paths that led to a cancelled extremum go on from there, along the path from its saddle backwards, and
/// down (up) the other path of that saddle; at 0 none are.
///
/// # Properties
/// A saddle of multiplicity k inside a surface has 2(k + 1) lines. Values are monotone along each line, as long as
/// nothing is cancelled. Paths of the same direction that meet go on together.
///
/// # Errors
/// `InvalidOption` where `persistence` is negative or not finite;
/// `OutOfMemory` where whole lines have more points than fit.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
/// let height = field::ScalarField::new(&torus, &height)?;
/// let nothing = field::Threshold::default();
/// let complex = field::morse_complex(&height, nothing, field::PathStyle::Whole, &Watch::none())?;
/// assert_eq!(complex.saddles.len(), 8);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn morse_complex(
    field: &ScalarField<'_>,
    persistence: Threshold,
    style: PathStyle,
    watch: &Watch<'_>,
) -> Result<MorseComplex> {
    let threshold = persistence.absolute(field.range(), "persistence")?;
    let n = field.values().len() as u64;
    let mut plan = watch.plan(&[(Phase::Field, 5.0), (Phase::Field, 2.0), (Phase::Field, 3.0)]);
    plan.begin(0)?;
    let cancelled = Cancellations::new(field.mesh(), field.order(), threshold, watch)?;
    plan.begin(30 * n)?;
    let alive = cancelled.alive(threshold)?;
    let all_paths = cancelled.paths(threshold, watch)?;
    let mut complex = MorseComplex::default();
    let simple_saddles = &cancelled.simple_saddles;
    let mut starts = [Vec::new(), Vec::new()];
    let mut simple = 0;
    while simple < simple_saddles.len() {
        // Simple saddles of one vertex share paths, and paths that come back over it may become the same.
        watch.tick(100)?;
        let vertex = simple_saddles.vertices[simple];
        let mut begins = [Vec::new(), Vec::new()];
        while simple < simple_saddles.len() && simple_saddles.vertices[simple] == vertex {
            for (side, paths) in [simple_saddles.down[simple], simple_saddles.up[simple]].into_iter().enumerate() {
                for first in paths.into_iter().filter(|&first| alive[simple] && first != NONE) {
                    begins[side].push(all_paths[side].beginning(vertex, first, watch)?);
                }
            }
            simple += 1;
        }
        for (starts, begins) in starts.iter_mut().zip(&mut begins) {
            begins.sort_unstable();
            begins.dedup();
            for &begin in begins.iter() {
                push(starts, (vertex, begin))?;
            }
        }
    }
    complex.reserve(&starts, &all_paths, style, watch)?;
    plan.begin(TRACE * complex.vertices.capacity() as u64)?;
    complex.offsets.push(0);
    for (side, kind) in [CriticalKind::Minimum, CriticalKind::Maximum].into_iter().enumerate() {
        let paths = &all_paths[side];
        let merged = style == PathStyle::Merged;
        let mut passed = filled(false, if merged { paths.len() } else { 0 })?;
        let ends = if merged { paths.ends(watch)? } else { Vec::new() };
        for &(saddle, begin) in &starts[side] {
            let before = complex.vertices.len();
            let last = complex.trace(paths, saddle, begin, &mut passed);
            watch.tick(TRACE * (complex.vertices.len() - before) as u64)?;
            complex.saddles.push(saddle);
            complex.extrema.push(if merged { ends[begin as usize] } else { last });
            complex.kinds.push(kind);
        }
    }
    plan.finish()?;
    Ok(field.on_whole(complex)?)
}

/// The work with one vertex of a line.
const TRACE: u64 = 6;

impl MorseComplex {
    /// Lines can share long ways: their points are counted before there is memory for them.
    fn reserve(
        &mut self,
        starts: &[Vec<(u32, u32)>; 2],
        all_paths: &[Paths<'_>; 2],
        style: PathStyle,
        watch: &Watch<'_>,
    ) -> Result<(), FieldError> {
        let lines = starts[0].len() + starts[1].len();
        let mut points = 0;
        match style {
            PathStyle::Merged => points = (all_paths[0].len() + all_paths[1].len() + 2 * lines) as u64,
            PathStyle::Whole => {
                for (starts, paths) in starts.iter().zip(all_paths) {
                    let lengths = paths.lengths(watch)?;
                    points += starts.iter().map(|&(_, first)| 1 + u64::from(lengths[first as usize])).sum::<u64>();
                }
            }
        }
        // A vertex, and for every line where it starts, its saddle, its extremum and its kind.
        let bytes = 4 * points + 13 * lines as u64 + 4;
        if points > u64::from(u32::MAX) {
            return Err(FieldError::OutOfMemory { bytes });
        }
        memory::ensure(bytes)?;
        self.vertices.reserve_exact(points as usize);
        self.offsets.reserve_exact(lines + 1);
        self.saddles.reserve_exact(lines);
        self.extrema.reserve_exact(lines);
        self.kinds.reserve_exact(lines);
        Ok(())
    }

    /// Adds a line and returns its last vertex.
    fn trace(&mut self, paths: &Paths<'_>, saddle: u32, begin: u32, passed: &mut [bool]) -> u32 {
        self.vertices.push(saddle);
        if !passed.is_empty() && paths.next(saddle) == Some(begin) {
            passed[saddle as usize] = true;
        }
        let (mut vertex, mut at) = (saddle, begin);
        let last = loop {
            // Over a cancelled saddle a path may come to one vertex twice in a row.
            let next_vertex = paths.vertex(at);
            if next_vertex != vertex {
                vertex = next_vertex;
                self.vertices.push(vertex);
            }
            if !passed.is_empty() && core::mem::replace(&mut passed[at as usize], true) {
                break at;
            }
            match paths.next(at) {
                Some(next) => at = next,
                None => break at,
            }
        };
        self.offsets.push(self.vertices.len() as u32);
        paths.vertex(last)
    }
}
