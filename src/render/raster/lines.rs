//! Lines on the surface: which of their pieces are seen, and smooth strokes along these.

use tiny_skia::{LineCap, LineJoin, Paint, Path, PathBuilder, PixmapMut, Stroke, Transform};

use super::binned::Binned;
use super::frame::Frame;
use crate::error::{FieldError, OutOfMemory};
use crate::render::camera::View;
use crate::render::colormap::Rgb;
use crate::render::draw_list::{DrawList, Lines};
use crate::support::memory::with_room;

/// Pixels between two places at which a line is looked at.
const STEP: f64 = 0.5;
/// Gaps of so many places, where rounding hides a line that is seen before and after, are closed; pieces of so many are dropped.
const GAP: usize = 3;
const SPECK: usize = 2;
/// Points nearer than this to the last one, in pixels, do not show.
const NEAR: f64 = 0.3;
/// How far rounded corners may be from the line's own, in pixels.
const TOLERANCE: f64 = 0.6;

/// A place on a line, in pixels of the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) depth: f32,
}

/// The lines of a draw list in the picture, with places along them.
pub(super) struct Tracks {
    /// In the order of the list.
    lines: Vec<Track>,
    probes: Vec<Probe>,
    seen: Vec<bool>,
}

struct Track {
    /// Which of the draw list's lines.
    kind: usize,
    closed: bool,
    points: Vec<[f64; 2]>,
    /// Where the probes of each segment start; a closed line has one segment more.
    probes: Vec<usize>,
}

impl Tracks {
    pub(super) fn new(list: &DrawList, view: &View) -> Result<Self, FieldError> {
        let mut this = Self { lines: Vec::new(), probes: Vec::new(), seen: Vec::new() };
        for (kind, lines) in list.lines.iter().enumerate() {
            for line in 0..lines.closed.len() {
                this.add(kind, lines, line, view)?;
            }
        }
        this.seen = with_room(this.probes.len())?;
        this.seen.resize(this.probes.len(), false);
        Ok(this)
    }

    fn add(&mut self, kind: usize, lines: &Lines, line: usize, view: &View) -> Result<(), FieldError> {
        let points = &lines.points[3 * lines.offsets[line] as usize..3 * lines.offsets[line + 1] as usize];
        let projected: Vec<_> = points.as_chunks::<3>().0.iter().map(|&point| view.project(point)).collect();
        if projected.len() < 2 {
            return Ok(());
        }
        let closed = lines.closed[line];
        let mut track = Track { kind, closed, points: Vec::new(), probes: vec![self.probes.len()] };
        for (k, &from) in projected.iter().enumerate() {
            track.points.push([from.x, from.y]);
            if k + 1 == projected.len() && !closed {
                break;
            }
            let to = projected[(k + 1) % projected.len()];
            let (dx, dy) = (to.x - from.x, to.y - from.y);
            let count = ((dx * dx + dy * dy).sqrt() / STEP).ceil().clamp(1.0, 1e6) as usize;
            if self.probes.try_reserve(count).is_err() {
                let bytes = ((self.probes.len() + count) * size_of::<Probe>()) as u64;
                return Err(FieldError::OutOfMemory { bytes });
            }
            for i in 0..count {
                let part = (i as f64 + 0.5) / count as f64;
                let depth = from.depth + part * (to.depth - from.depth);
                let (x, y) = (from.x + part * dx, from.y + part * dy);
                self.probes.push(Probe { x: x as f32, y: y as f32, depth: depth as f32 });
            }
            track.probes.push(self.probes.len());
        }
        self.lines.push(track);
        Ok(())
    }

    pub(super) fn by_strip(&self, frame: &Frame, rows: usize) -> Result<Binned, OutOfMemory> {
        let count = frame.height.div_ceil(rows);
        Binned::new(self.probes.len(), count, |probe| {
            let Probe { x, y, .. } = self.probes[probe];
            let (x, y) = (f64::from(x) - frame.left as f64, f64::from(y) - frame.top as f64);
            let is_inside = x >= 0.0 && y >= 0.0 && x < frame.width as f64 && y < frame.height as f64;
            is_inside.then(|| [y as usize / rows; 2])
        })
    }

    pub(super) fn probe(&self, probe: u32) -> Probe {
        self.probes[probe as usize]
    }

    pub(super) fn set(&mut self, probe: u32, is_seen: bool) {
        self.seen[probe as usize] = is_seen;
    }
}

/// A piece of a line that is seen: its points, and whether it is the whole of a closed line.
struct Piece {
    points: Vec<[f64; 2]>,
    closed: bool,
}

impl Track {
    /// The pieces that are seen.
    fn pieces(&self, seen: &[bool]) -> Vec<Piece> {
        let first = self.probes[0];
        let last = self.probes[self.probes.len() - 1];
        let mut seen = seen[first..last].to_vec();
        tidy(&mut seen, self.closed);
        if seen.iter().all(|&seen| seen) {
            return vec![Piece { points: self.points.clone(), closed: self.closed }];
        }
        // A closed line begins where it is hidden, so that no piece is cut at its start.
        let start = if self.closed { seen.iter().position(|&seen| !seen).unwrap_or_default() } else { 0 };
        let count = seen.len();
        let mut pieces = Vec::new();
        let mut points: Vec<[f64; 2]> = Vec::new();
        // How far a piece has come within a segment: what is between its corners need not be kept.
        let mut reached = None;
        let mut segment = self.probes.partition_point(|&place| place <= first + start) - 1;
        for k in 0..count {
            let place = (start + k) % count;
            if k > 0 && place == 0 {
                segment = 0;
            }
            while self.probes[segment + 1] <= first + place {
                segment += 1;
            }
            if seen[place] {
                let [from, to] = self.ends(segment, first + place);
                if points.is_empty() {
                    points.push(from);
                }
                reached = Some(to);
                if first + place + 1 == self.probes[segment + 1] {
                    points.extend(reached.take());
                }
            } else if !points.is_empty() {
                points.extend(reached.take());
                pieces.push(Piece { points: core::mem::take(&mut points), closed: false });
            }
        }
        points.extend(reached);
        if !points.is_empty() {
            pieces.push(Piece { points, closed: false });
        }
        pieces
    }

    /// The part of a segment that a probe stands for.
    fn ends(&self, segment: usize, probe: usize) -> [[f64; 2]; 2] {
        let (first, end) = (self.probes[segment], self.probes[segment + 1]);
        let (from, to) = (self.points[segment], self.points[(segment + 1) % self.points.len()]);
        let at = |k: usize| {
            let part = k as f64 / (end - first) as f64;
            [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])]
        };
        // The ends of segments exactly, as corners are known by them.
        [
            if probe == first { from } else { at(probe - first) },
            if probe + 1 == end { to } else { at(probe + 1 - first) },
        ]
    }
}

/// Closes short gaps and drops specks.
fn tidy(seen: &mut [bool], closed: bool) {
    for (value, longest) in [(false, GAP), (true, SPECK)] {
        let count = seen.len();
        let mut at = 0;
        while at < count {
            let length = seen[at..].iter().take_while(|&&seen| seen == value).count();
            // What touches an end may go on beyond it.
            let is_inside = closed || value || (at > 0 && at + length < count);
            if seen[at] == value && length <= longest && length < count && is_inside {
                seen[at..at + length].fill(!value);
            }
            at += length.max(1);
        }
    }
}

/// Draws all that is seen.
pub(super) fn stroke(pixmap: &mut PixmapMut<'_>, tracks: &Tracks, list: &DrawList, unit: f64) {
    let mut tracks_of = vec![Vec::new(); list.lines.len()];
    for track in &tracks.lines {
        for piece in track.pieces(&tracks.seen) {
            if let Some(path) = rounded(&piece) {
                tracks_of[track.kind].push(path);
            }
        }
    }
    // All casings lie under all lines, so that lines that meet are not cut by each other's.
    for (lines, paths) in list.lines.iter().zip(&tracks_of) {
        if let Some(casing) = lines.stroke.casing {
            paths.iter().for_each(|path| draw(pixmap, path, casing.color, casing.width * unit, 1.0));
        }
    }
    for (lines, paths) in list.lines.iter().zip(&tracks_of) {
        let stroke = lines.stroke;
        paths.iter().for_each(|path| draw(pixmap, path, stroke.color, stroke.width * unit, stroke.opacity));
    }
}

fn draw(pixmap: &mut PixmapMut<'_>, path: &Path, color: Rgb, width: f64, opacity: f64) {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(color[0], color[1], color[2], (255.0 * opacity).round() as u8);
    let stroke =
        Stroke { width: width as f32, line_cap: LineCap::Butt, line_join: LineJoin::Round, ..Stroke::default() };
    pixmap.stroke_path(path, &paint, &stroke, Transform::identity(), None);
}

/// A smooth path along a piece: its corners are rounded, without leaving the line by more than the tolerance.
fn rounded(piece: &Piece) -> Option<Path> {
    let points = thinned(piece);
    let count = points.len();
    if count < 2 {
        return None;
    }
    let mut path = PathBuilder::new();
    let is_closed = piece.closed && count > 2;
    let corners = if is_closed { 0..count } else { 1..count - 1 };
    if !is_closed {
        path.move_to(points[0][0] as f32, points[0][1] as f32);
    }
    for k in corners {
        let (before, corner, after) = (points[(k + count - 1) % count], points[k], points[(k + 1) % count]);
        let (u, length_before) = direction(corner, before);
        let (v, length_after) = direction(corner, after);
        let bend = ((u[0] + v[0]) * (u[0] + v[0]) + (u[1] + v[1]) * (u[1] + v[1])).sqrt();
        // A quadratic curve between points at distance d along both sides passes the corner at distance d·|u + v| / 4.
        let reach = (0.5 * length_before.min(length_after)).min(4.0 * TOLERANCE / bend.max(1e-9));
        let [from, to] = [u, v].map(|side| [corner[0] + reach * side[0], corner[1] + reach * side[1]]);
        if is_closed && k == 0 {
            path.move_to(from[0] as f32, from[1] as f32);
        } else {
            path.line_to(from[0] as f32, from[1] as f32);
        }
        path.quad_to(corner[0] as f32, corner[1] as f32, to[0] as f32, to[1] as f32);
    }
    if is_closed {
        path.close();
    } else {
        path.line_to(points[count - 1][0] as f32, points[count - 1][1] as f32);
    }
    path.finish()
}

/// Without points that hardly differ from the last one; the ends stay.
fn thinned(piece: &Piece) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = Vec::with_capacity(piece.points.len());
    let is_near = |p: [f64; 2], q: [f64; 2]| direction(p, q).1 < NEAR;
    for &point in &piece.points {
        if !points.last().is_some_and(|&last| is_near(last, point)) {
            points.push(point);
        }
    }
    let end = if piece.closed { piece.points.first() } else { piece.points.last() };
    if let Some(&end) = end {
        while points.len() > 1 && points.last().is_some_and(|&last| is_near(last, end)) {
            points.pop();
        }
        if !piece.closed {
            points.push(end);
        }
    }
    points
}

/// The unit vector from a point to another, and their distance.
fn direction(from: [f64; 2], to: [f64; 2]) -> ([f64; 2], f64) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = (dx * dx + dy * dy).sqrt();
    if length > 0.0 { ([dx / length, dy / length], length) } else { ([0.0; 2], 0.0) }
}
