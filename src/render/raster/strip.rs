//! The depth buffer of some rows of the picture.

use tiny_skia::{PixmapMut, PremultipliedColorU8};

use super::brush::{Brush, Group};
use super::facets::{Facets, GRID, Material};
use super::frame::{Frame, SAMPLES};
use super::light::Lamp;
use super::lines::Probe;
use super::plane::{Plane, middle, samples};
use crate::error::FieldError;
use crate::render::draw_list::DrawList;
use crate::render::style;
use crate::support::memory::with_room;

const NOTHING: u32 = u32::MAX;
/// How far a line may lie behind the surface that it is drawn on: relative, for rounding; as a part of what the depth changes over
/// the width of a sample, for corners that lie on a grid; the latter up to a limit, for triangles that are seen edge-on.
const ROUNDING: f64 = 3e-5;
const SNAP: f64 = 0.05;
const STEEPEST: f64 = 0.02;

pub(super) struct Strip {
    left: usize,
    top: usize,
    width: usize,
    /// Rows of pixels: at most, and below the last.
    rows: usize,
    end: usize,
    first: usize,
    /// The depth of the nearest triangle at each sample; 0 at infinity.
    depths: Vec<f32>,
    triangles: Vec<u32>,
    lamp: Option<Lamp>,
}

/// The samples of a line that are inside: from the first one, where `sides` are, they change by `steps`.
#[inline(never)]
fn inside(sides: [i64; 3], steps: [i64; 3], count: usize) -> (usize, usize) {
    let [mut a, mut b, mut c] = sides;
    let mut k = 0;
    while k < count && a | b | c < 0 {
        a += steps[0];
        b += steps[1];
        c += steps[2];
        k += 1;
    }
    let first = k;
    while k < count && a | b | c >= 0 {
        a += steps[0];
        b += steps[1];
        c += steps[2];
        k += 1;
    }
    (first, k)
}

/// Enters a triangle at samples in a row where it is the nearest.
#[inline(never)]
fn fill(depths: &mut [f32], ids: &mut [u32], triangle: u32, start: f32, step: f32) {
    let count = depths.len().min(ids.len());
    for k in 0..count {
        let depth = start + step * k as f32;
        if depth > depths[k] {
            depths[k] = depth;
            ids[k] = triangle;
        }
    }
}

impl Strip {
    pub(super) fn new(frame: &Frame, rows: usize) -> Result<Self, FieldError> {
        let rows = rows.min(frame.height.max(1));
        let count = rows * frame.width * SAMPLES * SAMPLES;
        let (mut depths, mut triangles) = (with_room(count)?, with_room(count)?);
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
        let Some(plane) = Plane::of(facets, triangle) else { return };
        let is_hidden = match facets.material(triangle) {
            Material::Values => false,
            Material::Solid(..) => !plane.is_front,
            Material::Rim(_) => plane.is_front,
        };
        if is_hidden {
            return;
        }
        let [i, j, k] = facets.triangles[triangle as usize];
        let (p, q, r) = (facets.corners[i as usize], facets.corners[j as usize], facets.corners[k as usize]);
        let above = self.first * SAMPLES;
        let (left, right) = samples([p.x, q.x, r.x], 0, self.width * SAMPLES);
        let (top, bottom) = samples([p.y, q.y, r.y], above, above + self.rows_here() * SAMPLES);
        let [e, f, g] = plane.edges;
        let steps = [e[0] * GRID, f[0] * GRID, g[0] * GRID];
        let x = middle(left);
        for line in top..bottom {
            let y = middle(line);
            let sides = [e[0] * x + e[1] * y + e[2], f[0] * x + f[1] * y + f[2], g[0] * x + g[1] * y + g[2]];
            let (first, end) = inside(sides, steps, right - left);
            if first == end {
                continue;
            }
            let (from, to) = (left + first, left + end - 1);
            let start = plane.depth(middle(from) as f64, y as f64);
            let step = (plane.depth(middle(to) as f64, y as f64) - start) / (to - from).max(1) as f64;
            let row = (line - above) * self.width * SAMPLES;
            let places = row + from..row + to + 1;
            let (depths, ids) = (&mut self.depths[places.clone()], &mut self.triangles[places]);
            fill(depths, ids, triangle, start as f32, step as f32);
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
                    for c in 0..3 {
                        sum[c] += group.count * u32::from(color[c]);
                    }
                    left -= group.count;
                }
                let all = (SAMPLES * SAMPLES) as u32;
                let mean = |c: usize| ((sum[c] + left * u32::from(style::BACKGROUND[c]) + all / 2) / all) as u8;
                let place = (self.top + self.first + row) * stride + self.left + column;
                if let Some(color) = PremultipliedColorU8::from_rgba(mean(0), mean(1), mean(2), 255) {
                    pixmap.pixels_mut()[place] = color;
                }
            }
        }
        self.lamp = Some(lamp);
    }

    /// The triangles in a pixel; each sample by itself where colors have steps.
    #[inline(never)]
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
                let mut at = if one_by_one { groups.len() } else { 0 };
                while at < groups.len() && groups[at].triangle != triangle {
                    at += 1;
                }
                if at == groups.len() {
                    groups.push(Group { triangle, count: 0, x: 0, y: 0 });
                }
                groups[at].count += 1;
                groups[at].x += x;
                groups[at].y += y;
            }
        }
    }

    /// Whether a point on the surface is not hidden: from one of the four samples around it at least.
    #[inline(never)]
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
            // Its depth where the point is: if the point is on it, the same but for rounding.
            let Some(plane) = Plane::of(facets, triangle) else { return true };
            let grid = GRID as f64;
            let depth = plane.depth(x * grid, y * grid);
            let tolerance = ROUNDING * depth + (SNAP * plane.steepness()).min(STEEPEST * depth);
            f64::from(probe.depth) >= depth - tolerance
        })
    }
}
