//! Joins vertices that lie together: those of triangle soups (STL, exploded files), and seams and poles that were written more
//! than once.

use super::{geometry, validate};
use crate::error::{FieldError, MeshError, OptionError, Result};
use crate::support::memory;

/// Numbers that differ by no more than this fraction of the largest one are taken for the same number, rounded: a few units in
/// the last place of single precision, in which many files and renderers hold their values.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// Cells are so many times as wide as the tolerance: wide enough that few spheres of that radius reach into another cell, narrow
/// enough that few vertices that far apart fit into one.
const CELL: f64 = 4.0;

/// Whole numbers are exact up to here.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// No vertex.
const NONE: u32 = u32::MAX;

/// How to weld.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WeldOptions {
    /// How far a vertex may be from the one that it becomes, as a fraction of the diagonal of the bounding box: at least 0 and
    /// below 1. Default 0: vertices become one where their three coordinates are equal (−0 equals 0).
    pub tolerance: f64,
}

/// A mesh whose vertices have pairwise different positions, further apart than the tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Welded {
    /// x, y, z of the vertices that are left, as they were, in the order of their first appearance.
    pub positions: Vec<f64>,
    /// The triangles with the new ids. Where a triangle was smaller than the tolerance, it names a vertex twice now;
    /// [`TriMesh::new`](super::TriMesh::new) leaves it out with a warning.
    pub triangles: Vec<u32>,
    /// The new id of every old vertex.
    pub map: Vec<u32>,
}

/// A field on the vertices that are left.
#[derive(Debug, Clone, PartialEq)]
pub struct WeldedField {
    /// One value per new vertex.
    pub values: Vec<f64>,
    /// The new vertices whose old vertices disagreed by more than rounding; ascending.
    pub disagreeing: Vec<u32>,
}

impl Welded {
    /// Whether any vertices were joined. Where none were, old and new ids are the same.
    #[must_use]
    pub fn joins_any(&self) -> bool {
        self.positions.len() != 3 * self.map.len()
    }

    /// Carries a field from the old vertices to the new ones.
    ///
    /// # Definition
    /// Where all old vertices of a new one have the same value, it is that value, to the last bit; elsewhere it is the mean of
    /// their values. NaN stands for a value that is missing, and the mean is taken of the others. An infinite value stays.
    ///
    /// Values disagree by more than rounding where they differ by more than 2⁻²¹ of the largest absolute value of the field, or
    /// where only some of them are missing.
    ///
    /// # Errors
    /// `LengthMismatch` unless there is one value per old vertex; `OutOfMemory`.
    pub fn field(&self, values: &[f64]) -> Result<WeldedField, FieldError> {
        if values.len() != self.map.len() {
            return Err(FieldError::length_mismatch(self.map.len(), values.len(), 0));
        }
        let kept = self.positions.len() / 3;
        memory::ensure(9 * kept as u64)?;
        let mut joined = vec![f64::NAN; kept];
        let mut states = vec![State::Unseen; kept];
        let mut largest = 0.0_f64;
        for (&new, &value) in self.map.iter().zip(values) {
            let (first, state) = (&mut joined[new as usize], &mut states[new as usize]);
            if value.is_finite() {
                largest = largest.max(value.abs());
            }
            match state {
                State::Unseen => {
                    *first = value;
                    *state = State::Same;
                }
                // Two missing values are the same one.
                State::Same if *first != value && !(first.is_nan() && value.is_nan()) => *state = State::Different,
                State::Same | State::Different => {}
            }
        }
        let different = states.iter().filter(|&&state| state == State::Different).count();
        memory::ensure((size_of::<Spread>() + 8) as u64 * different as u64)?;
        let mut spreads = Vec::with_capacity(different);
        spreads.extend(
            (0_u32..).zip(&states).filter(|&(_, &state)| state == State::Different).map(|(new, _)| Spread::new(new)),
        );
        let mut each = |visit: fn(&mut Spread, f64)| {
            for (&new, &value) in self.map.iter().zip(values) {
                if states[new as usize] == State::Different
                    && let Ok(place) = spreads.binary_search_by_key(&new, |spread| spread.vertex)
                {
                    visit(&mut spreads[place], value);
                }
            }
        };
        each(Spread::measure);
        each(Spread::add);
        let mut disagreeing = Vec::with_capacity(different);
        for spread in &spreads {
            joined[spread.vertex as usize] = spread.value();
            if spread.disagrees(ROUNDING * largest) {
                disagreeing.push(spread.vertex);
            }
        }
        Ok(WeldedField { values: joined, disagreeing })
    }
}

/// What is known of the values of one new vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Unseen,
    Same,
    Different,
}

/// Values of one new vertex that are not all the same.
struct Spread {
    vertex: u32,
    missing: u32,
    known: u32,
    least: f64,
    largest: f64,
    mean: f64,
}

impl Spread {
    fn new(vertex: u32) -> Self {
        Self { vertex, missing: 0, known: 0, least: f64::INFINITY, largest: f64::NEG_INFINITY, mean: 0.0 }
    }

    fn measure(&mut self, value: f64) {
        if value.is_nan() {
            self.missing += 1;
        } else {
            self.known += 1;
            self.least = self.least.min(value);
            self.largest = self.largest.max(value);
        }
    }

    fn add(&mut self, value: f64) {
        if !value.is_nan() {
            // Divided before it is summed, so that nothing overflows.
            self.mean += value / f64::from(self.known);
        }
    }

    fn value(&self) -> f64 {
        if self.largest == f64::INFINITY {
            self.largest
        } else if self.least == f64::NEG_INFINITY || self.least == self.largest {
            self.least
        } else {
            self.mean
        }
    }

    fn disagrees(&self, rounding: f64) -> bool {
        self.missing > 0 || self.largest - self.least > rounding
    }
}

/// Joins vertices that lie within a tolerance of each other. Without `triangles` every three vertices are one.
///
/// # Definition
/// The vertices are taken in the order of their ids. Each becomes the first of the vertices kept so far that lies within the
/// tolerance; where none does, it is kept itself. So no vertex moves further than the tolerance, and vertices that are left
/// lie further apart than it: a long chain of near vertices becomes shorter, but never one vertex.
///
/// # Properties
/// O(n): vertices are looked up in a grid of cells that are a few tolerances wide.
///
/// # Units
/// The tolerance is a fraction of the diagonal of the bounding box of all positions.
///
/// # Errors
/// `InvalidOption` for a tolerance that is negative, NaN, or not below 1; `PositionsNotTriples`, `TooManyElements`,
/// `NonFinitePosition`, `PositionOverflow`, `TrianglesNotTriples`, `IndexOutOfBounds`, `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::mesh::{TriMesh, WeldOptions, weld};
/// // Two triangles of a soup, nearly with a common side.
/// let soup = [0., 0., 0., 1., 0., 0., 0., 1., 0., 1e-9, 1., 0., 1., 1e-9, 0., 1., 1., 0.];
/// let welded = weld(&soup, None, &WeldOptions { tolerance: 1e-6 })?;
/// assert_eq!(welded.map, [0, 1, 2, 2, 1, 3]);
/// assert_eq!(welded.field(&[0., 1., 2., 2., 1., 3.])?.values, [0., 1., 2., 3.]);
/// assert_eq!(TriMesh::new(welded.positions, welded.triangles)?.edge_count(), 5);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn weld(positions: &[f64], triangles: Option<&[u32]>, options: &WeldOptions) -> Result<Welded> {
    if !(0.0..1.0).contains(&options.tolerance) {
        return Err(OptionError::invalid("tolerance", "a number from 0 to below 1").into());
    }
    validate::check_positions(positions)?;
    let n = positions.len() / 3;
    match triangles {
        Some(triangles) => validate::check_ids(triangles, n)?,
        None if n.is_multiple_of(3) => {}
        None => return Err(MeshError::TrianglesNotTriples { length: n }.into()),
    }
    let buckets = n.next_power_of_two().max(2);
    memory::ensure(12 * n as u64 + 4 * buckets as u64)?;
    let mut grid = Grid::new(positions, options.tolerance * geometry::diagonal(positions), buckets);
    let mut map = Vec::with_capacity(n);
    for v in 0..n as u32 {
        map.push(grid.place(v));
    }
    let kept = core::mem::take(&mut grid.kept);
    drop(grid);
    let corners = triangles.map_or(n, <[u32]>::len);
    memory::ensure(24 * kept.len() as u64 + 4 * corners as u64)?;
    let mut left = Vec::with_capacity(3 * kept.len());
    kept.iter().for_each(|&v| left.extend(geometry::position(positions, v)));
    let mut renamed = Vec::with_capacity(corners);
    match triangles {
        Some(triangles) => renamed.extend(triangles.iter().map(|&v| map[v as usize])),
        None => renamed.extend_from_slice(&map),
    }
    Ok(Welded { positions: left, triangles: renamed, map })
}

/// The vertices kept so far, by the cells in which they lie.
///
/// Cells share buckets, as a hash of their place decides. That only costs time: every vertex found is compared.
struct Grid<'a> {
    positions: &'a [f64],
    tolerance: f64,
    /// How far from a coordinate those within the tolerance lie at most, with the rounding of the comparison.
    reach: f64,
    width: f64,
    /// The old ids of the vertices kept; a new id is a place in this list.
    kept: Vec<u32>,
    /// The last new id of every bucket, and for every new id the one before in its bucket.
    last: Vec<u32>,
    before: Vec<u32>,
    shift: u32,
}

impl<'a> Grid<'a> {
    /// `buckets` is a power of two, at least 2.
    fn new(positions: &'a [f64], tolerance: f64, buckets: usize) -> Self {
        let n = positions.len() / 3;
        Self {
            positions,
            tolerance,
            reach: tolerance * (1.0 + 64.0 * f64::EPSILON),
            width: CELL * tolerance,
            kept: Vec::with_capacity(n),
            last: vec![NONE; buckets],
            before: Vec::with_capacity(n),
            shift: 64 - buckets.trailing_zeros(),
        }
    }

    /// The new id of a vertex: that of the first kept vertex within the tolerance, or one of its own.
    fn place(&mut self, vertex: u32) -> u32 {
        let position = geometry::position(self.positions, vertex);
        let [x, y, z] = position.map(|x| self.cells(x));
        let mut found = NONE;
        for &x in x.all() {
            for &y in y.all() {
                for &z in z.all() {
                    found = found.min(self.first_within(position, self.bucket([x, y, z])));
                }
            }
        }
        if found == NONE {
            found = self.kept.len() as u32;
            let bucket = self.bucket([x.own, y.own, z.own]);
            self.kept.push(vertex);
            self.before.push(core::mem::replace(&mut self.last[bucket], found));
        }
        found
    }

    /// The first of a bucket's vertices that lies within the tolerance.
    fn first_within(&self, position: [f64; 3], bucket: usize) -> u32 {
        let mut found = NONE;
        let mut new = self.last[bucket];
        while new != NONE {
            let other = geometry::position(self.positions, self.kept[new as usize]);
            if self.is_within(geometry::difference(position, other)) {
                // New ids descend along the list.
                found = new;
            }
            new = self.before[new as usize];
        }
        found
    }

    fn is_within(&self, difference: [f64; 3]) -> bool {
        if self.tolerance == 0.0 {
            return difference == [0.0; 3];
        }
        // Divided before it is squared, so that no square leaves the range of double precision where it matters.
        let scaled = difference.map(|x| x / self.tolerance);
        geometry::dot(scaled, scaled) <= 1.0
    }

    /// The cell of a coordinate, which grows with it. Where numbers are so large that none but the coordinate itself lies within
    /// the tolerance, every number is a cell of its own, known by its bits.
    fn cell(&self, x: f64) -> u64 {
        let place = x / self.width;
        // Adding zero turns −0 into 0.
        if place.abs() < EXACT { place.floor() as i64 as u64 } else { (x + 0.0).to_bits() }
    }

    /// The cells in which a coordinate lies and all that are within the tolerance of it: mostly one, seldom three.
    fn cells(&self, x: f64) -> Cells {
        let own = self.cell(x);
        let mut cells = Cells { own, found: [own; 3], count: 1 };
        for near in [self.cell(x - self.reach), self.cell(x + self.reach)] {
            if near != own {
                cells.found[cells.count] = near;
                cells.count += 1;
            }
        }
        cells
    }

    fn bucket(&self, cell: [u64; 3]) -> usize {
        (hash(cell) >> self.shift) as usize
    }
}

/// Cells along an axis.
struct Cells {
    own: u64,
    found: [u64; 3],
    count: usize,
}

impl Cells {
    fn all(&self) -> &[u64] {
        &self.found[..self.count]
    }
}

/// Mixes the bits of three numbers (the finisher of `MurmurHash3` \[Appleby11\], once for each).
fn hash(numbers: [u64; 3]) -> u64 {
    numbers.iter().fold(0, |hash: u64, x| {
        let mut mixed = hash.rotate_left(23) ^ x;
        mixed = (mixed ^ (mixed >> 33)).wrapping_mul(0xFF51_AFD7_ED55_8CCD);
        mixed = (mixed ^ (mixed >> 33)).wrapping_mul(0xC4CE_B9FE_1A85_EC53);
        mixed ^ (mixed >> 33)
    })
}
