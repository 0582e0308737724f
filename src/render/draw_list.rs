//! What is drawn, as one flat list for every renderer: the pictures here and the page's viewer.

use super::colormap::{Rgb, between};
use super::options::{DrawOptions, Glyphs, Levels, Separatrices};
use super::solids::{Shape, ball, octahedron, tetrahedron};
use super::style::{self, Light, Rim, SolidSize, Stroke};
use super::surface::Surface;
use crate::error::{Error, FieldError, OptionError};
use crate::field::{self, CriticalKind, CriticalPoint, DeltaOptions, LevelSets, MorseComplex, PathStyle, ScalarField};
use crate::mesh::TriMesh;
use crate::support::watch::Watch;

/// As many as [`field::level_sets`] takes.
const MOST_LEVELS: u32 = 10_000;

/// What is drawn on a surface. It does not depend on the camera.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawList {
    /// For every corner of the surface its place in the colors, 0 to 1; beyond, the color is the first or the last. Linear on
    /// triangles, as the field is. NaN where there is no value, and then the whole triangle has the color of gaps.
    pub shades: Vec<f64>,
    /// The colors, at equal steps from 0 to 1; linear between them where there are no steps.
    pub colors: Vec<Rgb>,
    /// Where one color goes over into the next at once, ascending; empty where colors are continuous.
    pub steps: Vec<f64>,
    /// The colors of the parts between the steps, one more than there are steps; empty where colors are continuous.
    pub step_colors: Vec<Rgb>,
    /// The color of triangles with a corner without a value; `None` where every corner has one.
    pub gap: Option<Rgb>,
    /// The values at the places 0 and 1.
    pub range: [f64; 2],
    /// The levels that lines are drawn at, ascending.
    pub levels: Vec<f64>,
    /// Level sets, then the Morse complex; later ones lie above earlier ones.
    pub lines: Vec<Lines>,
    /// Critical points, one entry for each kind that there is.
    pub solids: Vec<Solids>,
    /// The rule for the radius of solids, for whoever draws fewer of them.
    pub size: SolidSize,
    /// The light, the same for the surface and all solids.
    pub light: Light,
}

/// What a line or a solid stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Level sets.
    Levels,
    /// Lines of the Morse complex that lead to minima.
    Descending,
    /// Lines of the Morse complex that lead to maxima.
    Ascending,
    /// Minima.
    Minima,
    /// Saddles.
    Saddles,
    /// Maxima.
    Maxima,
}

/// Lines of one style: line k has the points `offsets[k]..offsets[k + 1]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Lines {
    /// What they are.
    pub role: Role,
    /// x, y, z of every point, as drawn.
    pub points: Vec<f64>,
    /// Where each line starts, and the number of points at the end.
    pub offsets: Vec<u32>,
    /// Whether a line closes; its first point is not repeated.
    pub closed: Vec<bool>,
    /// How they are drawn.
    pub stroke: Stroke,
}

/// Instances of one solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Solids {
    /// What they are.
    pub role: Role,
    /// The solid.
    pub shape: Shape,
    /// The color.
    pub color: Rgb,
    /// What surrounds it.
    pub rim: Rim,
    /// What shines of the color without light, 0 to 1.
    pub glow: f64,
    /// The vertex of every instance.
    pub vertices: Vec<u32>,
    /// Where it is on the surface.
    pub places: Vec<[f64; 3]>,
    /// Unit vectors along which the axes stand.
    pub axes: Vec<[f64; 3]>,
    /// Whether the surface is open there, so that the axis is turned to the side that is looked at.
    pub both_sides: Vec<bool>,
    /// The radius of one solid, as drawn.
    pub radius: f64,
    /// How many radii it stands above the surface.
    pub lift: f64,
}

impl DrawList {
    pub(super) fn new(
        mesh: &TriMesh,
        surface: &Surface,
        values: &[f64],
        options: &DrawOptions<'_>,
    ) -> Result<Self, Error> {
        options.check()?;
        let field = ScalarField::with_missing(mesh, values, options.missing)?;
        let found = field.range();
        let range = options.range.unwrap_or([found.min, found.max]);
        let shades: Vec<f64> = surface.vertices.iter().map(|&v| shade(values[v as usize], range)).collect();
        let gap = shades.iter().any(|shade| shade.is_nan()).then_some(style::GAP);
        let (levels, sets) = level_lines(&field, range, options.levels)?;
        let colors = options.colormap.table();
        let (mut steps, mut step_colors) = (Vec::new(), Vec::new());
        if options.bands {
            steps = levels.iter().map(|&level| shade(level, range)).filter(|&s| s > 0.0 && s < 1.0).collect();
            let ends: Vec<f64> = [0.0].into_iter().chain(steps.iter().copied()).chain([1.0]).collect();
            step_colors = ends.windows(2).map(|ends| between(&colors, 0.5 * (ends[0] + ends[1]))).collect();
        }
        let mut lines = Vec::new();
        if let Some(sets) = sets {
            lines.push(placed_levels(surface, &sets)?);
        }
        lines.extend(separatrices(&field, surface, options.morse_complex)?);
        let size = SolidSize { cover: style::SIZE.cover * surface.area, ..style::SIZE };
        let points = critical_points(&field, options.critical_points)?;
        let solids = solids(mesh, surface, &points, size);
        let light = style::LIGHT;
        Ok(Self { shades, colors, steps, step_colors, gap, range, levels, lines, solids, size, light })
    }

    /// The color at a place, 0 to 1; that of gaps where the place is NaN.
    #[must_use]
    pub fn color(&self, shade: f64) -> Rgb {
        if shade.is_nan() {
            style::GAP
        } else if self.step_colors.is_empty() {
            between(&self.colors, shade.clamp(0.0, 1.0))
        } else {
            self.step_colors[self.steps.partition_point(|&step| step <= shade)]
        }
    }
}

/// Where a value is in a range; in the middle where that is one value. NaN remains NaN.
fn shade(value: f64, [low, high]: [f64; 2]) -> f64 {
    // Triangles reach from inside a range to far outside: only what would not fit single precision is cut.
    if high > low {
        ((value - low) / (high - low)).clamp(-1e30, 1e30)
    } else if value.is_nan() {
        value
    } else {
        0.5
    }
}

/// The levels, ascending, and their lines.
fn level_lines<'a>(
    field: &ScalarField<'_>,
    [low, high]: [f64; 2],
    wanted: Levels<'a>,
) -> Result<(Vec<f64>, Option<std::borrow::Cow<'a, LevelSets>>), Error> {
    use std::borrow::Cow;
    let levels = match wanted {
        Levels::None => return Ok((Vec::new(), None)),
        Levels::Traced(sets) => {
            let mut levels = sets.levels.clone();
            if levels.len() != sets.closed.len() || levels.iter().any(|level| !level.is_finite()) {
                return Err(OptionError::invalid("levels", "lines with a finite level each").into());
            }
            levels.sort_by(f64::total_cmp);
            levels.dedup();
            return Ok((levels, Some(Cow::Borrowed(sets))));
        }
        Levels::Count(count) if count > MOST_LEVELS => {
            return Err(OptionError::invalid("levels.count", "an integer from 0 to 10000").into());
        }
        Levels::Count(count) if high > low => {
            let part = |k: u32| f64::from(k) / f64::from(count + 1);
            (1..=count).map(|k| low + part(k) * (high - low)).collect()
        }
        Levels::Count(_) => Vec::new(),
        Levels::At(levels) => levels.to_vec(),
    };
    let sets = field::level_sets(field, &levels, &Watch::none())?;
    let mut levels = levels;
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    Ok((levels, Some(Cow::Owned(sets))))
}

fn placed_levels(surface: &Surface, sets: &LevelSets) -> Result<Lines, Error> {
    let expected = "lines whose points are finite and whose offsets ascend from 0 to the number of points";
    let is_whole = are_offsets(&sets.offsets, sets.points.len() / 3) && sets.closed.len() + 1 == sets.offsets.len();
    let (points, rest) = sets.points.as_chunks::<3>();
    let points: Vec<f64> = points.iter().flat_map(|&point| surface.place(point)).collect();
    if !is_whole || !rest.is_empty() || points.iter().any(|x| !x.is_finite()) {
        return Err(OptionError::invalid("levels", expected).into());
    }
    let offsets = sets.offsets.clone();
    Ok(Lines { role: Role::Levels, points, offsets, closed: sets.closed.clone(), stroke: style::LEVELS })
}

fn are_offsets(offsets: &[u32], points: usize) -> bool {
    offsets.first() == Some(&0) && offsets.last().is_some_and(|&last| last as usize == points) && offsets.is_sorted()
}

/// The lines to minima and those to maxima.
fn separatrices(field: &ScalarField<'_>, surface: &Surface, wanted: Separatrices<'_>) -> Result<Vec<Lines>, Error> {
    let mesh = field.whole_mesh();
    let traced;
    let complex: &MorseComplex = match wanted {
        Separatrices::None => return Ok(Vec::new()),
        Separatrices::Traced(complex) => complex,
        Separatrices::Above(threshold) => {
            traced = field::morse_complex(field, threshold, PathStyle::Merged, &Watch::none())?;
            &traced
        }
    };
    let expected = "lines with a kind each, whose offsets ascend from 0 to the number of vertices";
    if !are_offsets(&complex.offsets, complex.vertices.len()) || complex.kinds.len() + 1 != complex.offsets.len() {
        return Err(OptionError::invalid("morseComplex", expected).into());
    }
    check_vertices(mesh, complex.vertices.iter().copied())?;
    let of_kind = |(kind, role, stroke)| {
        let mut lines = Lines { role, points: Vec::new(), offsets: vec![0], closed: Vec::new(), stroke };
        for line in (0..complex.kinds.len()).filter(|&line| complex.kinds[line] == kind) {
            let vertices = complex.offsets[line] as usize..complex.offsets[line + 1] as usize;
            for &v in &complex.vertices[vertices] {
                lines.points.extend(surface.place(mesh.position(v)));
            }
            lines.offsets.push((lines.points.len() / 3) as u32);
            lines.closed.push(false);
        }
        lines
    };
    let kinds = [
        (CriticalKind::Minimum, Role::Descending, style::DESCENDING),
        (CriticalKind::Maximum, Role::Ascending, style::ASCENDING),
    ];
    Ok(kinds.into_iter().map(of_kind).filter(|lines| !lines.points.is_empty()).collect())
}

fn critical_points<'a>(
    field: &ScalarField<'_>,
    wanted: Glyphs<'a>,
) -> Result<std::borrow::Cow<'a, [CriticalPoint]>, Error> {
    Ok(match wanted {
        Glyphs::None => Vec::new().into(),
        Glyphs::Found => field::critical_points(field, &DeltaOptions::default(), &Watch::none())?.points.into(),
        Glyphs::Points(points) => {
            check_vertices(field.whole_mesh(), points.iter().map(|point| point.vertex))?;
            points.into()
        }
    })
}

fn check_vertices(mesh: &TriMesh, mut vertices: impl Iterator<Item = u32>) -> Result<(), FieldError> {
    let count = mesh.vertex_count();
    let outside = vertices.find(|&v| v as usize >= count);
    outside.map_or(Ok(()), |index| Err(FieldError::IndexOutOfBounds { index, vertices: count }))
}

/// Vertices of no triangle have no place on the surface, and none is drawn there.
fn solids(mesh: &TriMesh, surface: &Surface, points: &[CriticalPoint], size: SolidSize) -> Vec<Solids> {
    let radius = size.radius(points.len());
    let mut all = Vec::new();
    for (kind, role, color) in [
        (CriticalKind::Minimum, Role::Minima, style::MINIMUM),
        (CriticalKind::Saddle, Role::Saddles, style::SADDLE),
        (CriticalKind::Maximum, Role::Maxima, style::MAXIMUM),
    ] {
        let of_kind = points.iter().filter(|point| point.kind == kind).map(|point| point.vertex);
        let vertices: Vec<u32> = of_kind.filter(|&v| !mesh.connectivity().star(v).is_empty()).collect();
        if vertices.is_empty() {
            continue;
        }
        let (shape, rim) = match kind {
            CriticalKind::Minimum => (tetrahedron(), style::TETRAHEDRON_RIM),
            CriticalKind::Saddle => (octahedron(), style::OCTAHEDRON_RIM),
            CriticalKind::Maximum => (ball(if vertices.len() > style::CROWD { 1 } else { 3 }), style::BALL_RIM),
        };
        let places = vertices.iter().map(|&v| surface.place(mesh.position(v))).collect();
        let axes = vertices.iter().map(|&v| surface.normal_at(v)).collect();
        let both_sides = vertices.iter().map(|&v| surface.is_open_at(mesh, v)).collect();
        let (glow, lift) = (style::GLOW, style::LIFT);
        all.push(Solids { role, shape, color, rim, glow, vertices, places, axes, both_sides, radius, lift });
    }
    all
}
