//! The depth buffer of some rows of the picture.

use tiny_skia::{PixmapMut, PremultipliedColorU8};

use super::facets::{Corner, Facets, GRID, Material};
use super::light::Lamp;
use super::lines::Probe;
use super::{Frame, SAMPLES, room};
use crate::error::FieldError;
use crate::render::colormap::Rgb;
use crate::render::draw_list::DrawList;
use crate::render::style;

const NOTHING: u32 = u32::MAX;
/// How far a line may lie behind the surface that it is drawn on: relative, for rounding, and as a part of what the depth changes
/// over the width of a sample, up to a limit for triangles that are seen edge-on.
const ROUNDING: f64 = 3e-4;
const STEEPEST: f64 = 0.02;

pub(super) struct Strip {
    left: usize,
    top: usize,
    width: usize,
    /// Rows of pixels: at most, and below the last.
    rows: usize,
    end: usize,
    first: usize,
    /// Of the nearest triangle at each sample; 0 at infinity.
    depths: Vec<f32>,
    triangles: Vec<u32>,
    lamp: Option<Lamp>,
}

/// One line of samples: `sides` of the first sample and their `steps`, likewise the depth with its bounds. Of plain numbers, as this is
/// the innermost loop.
#[inline(never)]
fn fill(depths: &mut [f32], ids: &mut [u32], triangle: u32, sides: [i64; 3], steps: [i64; 3], depth: [f64; 4]) {
    let [mut a, mut b, mut c] = sides;
    let [start, step, least, most] = depth;
    for (k, (nearest, id)) in depths.iter_mut().zip(ids).enumerate() {
        if a | b | c >= 0 {
            // Of slivers, the plane is only known between the corners.
            let depth = (start + step * k as f64).max(least).min(most) as f32;
            if depth > *nearest {
                *nearest = depth;
                *id = triangle;
            }
        }
        a += steps[0];
        b += steps[1];
        c += steps[2];
    }
}

/// Half-planes and depth of a projected triangle.
struct Plane {
    /// Edge k is opposite to corner k: `a·x + b·y + c`, in steps of the grid, is not negative inside.
    edges: [[i64; 3]; 3],
    /// Twice the area in squared steps.
    area: i64,
    /// Whether the corners go round as they do in the mesh, seen from outside.
    is_front: bool,
}

impl Plane {
    /// Nothing where the triangle has no area.
    fn of(corners: [Corner; 3]) -> Option<Self> {
        let mut edges = [[0; 3]; 3];
        for k in 0..3 {
            let (p, q) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
            let (a, b) = (p.y - q.y, q.x - p.x);
            edges[k] = [a, b, -(a * p.x + b * p.y)];
        }
        let area = edges[0][0] * corners[0].x + edges[0][1] * corners[0].y + edges[0][2];
        if area == 0 {
            return None;
        }
        // The picture's y points downwards.
        let is_front = area < 0;
        if is_front {
            edges = edges.map(|edge| edge.map(|x| -x));
        }
        Some(Self { edges, area: area.abs(), is_front })
    }

    /// The parts of the corners in a point, in steps of the grid; outside some are negative.
    fn parts(&self, x: f64, y: f64) -> [f64; 3] {
        let area = self.area as f64;
        self.edges.map(|[a, b, c]| (a as f64 * x + b as f64 * y + c as f64) / area)
    }
}

/// The middle of a sample, in steps of the grid.
fn middle(sample: usize) -> i64 {
    sample as i64 * GRID + GRID / 2
}

impl Strip {
    pub(super) fn new(frame: &Frame, rows: usize) -> Result<Self, FieldError> {
        let rows = rows.min(frame.height.max(1));
        let count = rows * frame.width * SAMPLES * SAMPLES;
        let (mut depths, mut triangles) = (room(count)?, room(count)?);
        depths.resize(count, 0.0);
        triangles.resize(count, NOTHING);
        let &Frame { left, top, width, height } = frame;
        Ok(Self { left, top, width, rows, end: height, first: 0, depths, triangles, lamp: None })
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Begins anew, at that row of the frame.
    pub(super) fn clear(&mut self, first: usize) {
        self.first = first;
        self.depths.fill(0.0);
        self.triangles.fill(NOTHING);
    }

    fn rows_here(&self) -> usize {
        self.rows.min(self.end - self.first)
    }

    /// Enters a triangle wherever it is the nearest.
    #[inline(never)]
    pub(super) fn add(&mut self, facets: &Facets, triangle: u32) {
        let corners = facets.triangles[triangle as usize].map(|corner| facets.corners[corner as usize]);
        let Some(plane) = Plane::of(corners) else { return };
        let hidden = match facets.material(triangle) {
            Material::Values => false,
            Material::Solid(..) => !plane.is_front,
            Material::Rim(_) => plane.is_front,
        };
        if hidden {
            return;
        }
        let range = |values: [i64; 3], first: usize, end: usize| {
            let (low, high) = (values[0].min(values[1]).min(values[2]), values[0].max(values[1]).max(values[2]));
            // Samples whose middle is not outside.
            let from = (low - GRID / 2).div_euclid(GRID) + i64::from((low - GRID / 2).rem_euclid(GRID) > 0);
            let to = (high - GRID / 2).div_euclid(GRID);
            from.max(first as i64)..(to + 1).min(end as i64)
        };
        let above = self.first * SAMPLES;
        let columns = range(corners.map(|c| c.x), 0, self.width * SAMPLES);
        let lines = range(corners.map(|c| c.y), above, above + self.rows_here() * SAMPLES);
        if columns.is_empty() || lines.is_empty() {
            return;
        }
        let depths = corners.map(|corner| corner.depth);
        let (least, most) = (depths[0].min(depths[1]).min(depths[2]), depths[0].max(depths[1]).max(depths[2]));
        let start = middle(columns.start as usize);
        let origin = plane.parts(start as f64, 0.0);
        let at = |parts: [f64; 3]| parts[0] * depths[0] + parts[1] * depths[1] + parts[2] * depths[2];
        let right = at(plane.edges.map(|[a, _, _]| (a * GRID) as f64 / plane.area as f64));
        let down = at(plane.edges.map(|[_, b, _]| b as f64 / plane.area as f64));
        let depth_of_column = at(origin);
        let span = (columns.end - columns.start) as usize;
        let steps = plane.edges.map(|[a, _, _]| a * GRID);
        for line in lines {
            let y = middle(line as usize);
            let sides = plane.edges.map(|[a, b, c]| a * start + b * y + c);
            let row = (line as usize - above) * self.width * SAMPLES + columns.start as usize;
            let (depths, ids) = (&mut self.depths[row..row + span], &mut self.triangles[row..row + span]);
            fill(depths, ids, triangle, sides, steps, [depth_of_column + down * y as f64, right, least, most]);
        }
    }

    /// Mixes the samples of each pixel.
    #[inline(never)]
    pub(super) fn resolve(&mut self, facets: &Facets, list: &DrawList, pixmap: &mut PixmapMut<'_>) {
        let lamp = self.lamp.take().unwrap_or_else(|| Lamp::new(list.light));
        let brush = Brush { facets, list, lamp: &lamp };
        let stride = pixmap.width() as usize;
        let mut groups: Vec<Group> = Vec::with_capacity(SAMPLES * SAMPLES);
        for row in 0..self.rows_here() {
            for column in 0..self.width {
                groups.clear();
                self.gather(row, column, &mut groups, !list.steps.is_empty());
                if groups.is_empty() {
                    continue;
                }
                let mut sum = [0_u32; 3];
                let mut left = (SAMPLES * SAMPLES) as u32;
                for group in &groups {
                    let color = brush.color(group);
                    (0..3).for_each(|c| sum[c] += group.count * u32::from(color[c]));
                    left -= group.count;
                }
                let all = (SAMPLES * SAMPLES) as u32;
                let mean = [0, 1, 2].map(|c| ((sum[c] + left * u32::from(style::BACKGROUND[c]) + all / 2) / all) as u8);
                let place = (self.top + self.first + row) * stride + self.left + column;
                if let Some(color) = PremultipliedColorU8::from_rgba(mean[0], mean[1], mean[2], 255) {
                    pixmap.pixels_mut()[place] = color;
                }
            }
        }
        self.lamp = Some(lamp);
    }

    #[inline(never)]
    /// The triangles in a pixel; each sample by itself where colours have steps.
    fn gather(&self, row: usize, column: usize, groups: &mut Vec<Group>, one_by_one: bool) {
        for j in 0..SAMPLES {
            let line = row * SAMPLES + j;
            for i in 0..SAMPLES {
                let sample = column * SAMPLES + i;
                let triangle = self.triangles[line * self.width * SAMPLES + sample];
                if triangle == NOTHING {
                    continue;
                }
                let (x, y) = (middle(sample), middle(self.first * SAMPLES + line));
                match groups.iter_mut().find(|group| group.triangle == triangle && !one_by_one) {
                    Some(group) => {
                        group.count += 1;
                        group.x += x;
                        group.y += y;
                    }
                    None => groups.push(Group { triangle, count: 1, x, y }),
                }
            }
        }
    }

    #[inline(never)]
    /// Whether a point on the surface is not hidden: from one of the four samples around it at least.
    pub(super) fn sees(&self, facets: &Facets, probe: Probe) -> bool {
        let samples = SAMPLES as f64;
        let (x, y) =
            ((f64::from(probe.x) - self.left as f64) * samples, (f64::from(probe.y) - self.top as f64) * samples);
        let within = |place: f64, count: usize| (place.max(0.0) as usize).min(count - 1);
        let above = (self.first * SAMPLES) as f64;
        let (width, height) = (self.width * SAMPLES, self.rows_here() * SAMPLES);
        [(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)].into_iter().any(|(i, j)| {
            let (column, line) = (within(x + i, width), within(y + j - above, height));
            let place = line * width + column;
            let triangle = self.triangles[place];
            if triangle == NOTHING {
                return true;
            }
            let depth = f64::from(self.depths[place]);
            let tolerance = ROUNDING * depth + slope(facets, triangle).min(STEEPEST * depth);
            f64::from(probe.depth) >= depth - tolerance
        })
    }
}

/// How much the depth of a triangle changes over a sample.
fn slope(facets: &Facets, triangle: u32) -> f64 {
    let corners = facets.triangles[triangle as usize].map(|corner| facets.corners[corner as usize]);
    let Some(plane) = Plane::of(corners) else { return 0.0 };
    let along = |axis: usize| {
        let parts = plane.edges.map(|edge| (edge[axis] * GRID) as f64 / plane.area as f64);
        (0..3).map(|k| parts[k] * corners[k].depth).sum::<f64>().abs()
    };
    along(0) + along(1)
}

/// Samples of one pixel in one triangle.
struct Group {
    triangle: u32,
    count: u32,
    /// Sums of their places, in steps of the grid.
    x: i64,
    y: i64,
}

struct Brush<'a> {
    facets: &'a Facets,
    list: &'a DrawList,
    lamp: &'a Lamp,
}

impl Brush<'_> {
    #[inline(never)]
    fn color(&self, group: &Group) -> Rgb {
        let material = self.facets.material(group.triangle);
        if let Material::Rim(color) = material {
            return color;
        }
        let ids = self.facets.triangles[group.triangle as usize].map(|corner| corner as usize);
        let corners = ids.map(|corner| self.facets.corners[corner]);
        let Some(plane) = Plane::of(corners) else { return style::BACKGROUND };
        let count = f64::from(group.count);
        let parts = plane.parts(group.x as f64 / count, group.y as f64 / count);
        // Straight lines of the picture are not evenly long in space.
        let mut weights = [0, 1, 2].map(|k| parts[k] * corners[k].depth);
        let sum = weights[0] + weights[1] + weights[2];
        weights = weights.map(|weight| weight / sum);
        let sign = if plane.is_front { 1.0 } else { -1.0 };
        let normal = [0, 1, 2].map(|i| sign * (0..3).map(|k| weights[k] * self.facets.normals[ids[k]][i]).sum::<f64>());
        match material {
            Material::Solid(color, glow) => self.lamp.lit(color, glow, normal),
            _ => {
                let shade = (0..3).map(|k| weights[k] * self.list.shades[ids[k]]).sum::<f64>();
                self.lamp.lit(self.list.color(shade), 0.0, normal)
            }
        }
    }
}
