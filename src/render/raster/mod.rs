//! From a draw list to pixels.
//!
//! Surface and solids go through a depth buffer with sixteen samples for each pixel, strip by strip, so that depths take no more
//! memory in larger pictures. While a strip's depths are there, lines ask them which of their pieces are seen; those are drawn as
//! smooth strokes at the end.

mod brush;
mod facets;
mod light;
mod lines;
mod plane;
mod strip;

use tiny_skia::PixmapMut;

use super::camera::{Rectangle, View};
use super::draw_list::DrawList;
use super::surface::Surface;
use crate::error::FieldError;
use facets::Facets;
use lines::Tracks;
use strip::Strip;

/// Samples along each side of a pixel.
const SAMPLES: usize = 4;
/// Samples of a strip: few enough for the caches that are there.
const STRIP: usize = 1 << 19;

/// Draws into a rectangle of the picture. `unit`: pixels for each pixel of a stroke's width.
pub(super) fn paint(
    pixmap: &mut PixmapMut<'_>,
    rectangle: &Rectangle,
    surface: &Surface,
    list: &DrawList,
    view: &View,
    unit: f64,
) -> Result<(), FieldError> {
    let frame = Frame::of(pixmap, rectangle);
    let facets = Facets::new(surface, list, view, &frame)?;
    let mut tracks = Tracks::new(list, view)?;
    if frame.width > 0 && frame.height > 0 {
        let mut strip = Strip::new(&frame, (STRIP / (SAMPLES * SAMPLES * frame.width)).max(1))?;
        let rows = strip.rows();
        let binned = facets.by_strip(&frame, rows)?;
        let probes = tracks.by_strip(&frame, rows)?;
        for (place, first) in (0..frame.height).step_by(rows).enumerate() {
            strip.clear(first);
            for &triangle in binned.of(place) {
                strip.add(&facets, triangle);
            }
            strip.resolve(&facets, list, pixmap);
            for &probe in probes.of(place) {
                let is_seen = strip.sees(&facets, tracks.probe(probe));
                tracks.set(probe, is_seen);
            }
        }
    }
    lines::stroke(pixmap, &tracks, list, unit);
    Ok(())
}

/// Whole pixels.
struct Frame {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

impl Frame {
    fn of(pixmap: &PixmapMut<'_>, rectangle: &Rectangle) -> Self {
        let [width, height] = [pixmap.width() as usize, pixmap.height() as usize];
        let (left, top) = ((rectangle.x.max(0.0) as usize).min(width), (rectangle.y.max(0.0) as usize).min(height));
        let right = ((rectangle.x + rectangle.width).max(0.0).ceil() as usize).min(width);
        let bottom = ((rectangle.y + rectangle.height).max(0.0).ceil() as usize).min(height);
        Self { left, top, width: right.saturating_sub(left), height: bottom.saturating_sub(top) }
    }
}

/// Things by the strip that they are in, in compressed rows.
struct Binned {
    offsets: Vec<usize>,
    items: Vec<u32>,
}

impl Binned {
    /// `strips`: the first and last strip of a thing, nothing where it is in none.
    fn new(count: usize, strip_count: usize, strips: impl Fn(usize) -> Option<[usize; 2]>) -> Result<Self, FieldError> {
        let mut offsets = vec![0_usize; strip_count + 1];
        for [first, last] in (0..count).filter_map(&strips) {
            (first..=last).for_each(|strip| offsets[strip + 1] += 1);
        }
        for strip in 0..strip_count {
            offsets[strip + 1] += offsets[strip];
        }
        let mut next = offsets.clone();
        let mut items = room(offsets[strip_count])?;
        items.resize(offsets[strip_count], 0);
        for item in 0..count {
            if let Some([first, last]) = strips(item) {
                for strip in first..=last {
                    items[next[strip]] = item as u32;
                    next[strip] += 1;
                }
            }
        }
        Ok(Self { offsets, items })
    }

    fn of(&self, strip: usize) -> &[u32] {
        &self.items[self.offsets[strip]..self.offsets[strip + 1]]
    }
}

/// An empty vector with room, or an error.
fn room<T>(count: usize) -> Result<Vec<T>, FieldError> {
    let mut items = Vec::new();
    match items.try_reserve_exact(count) {
        Ok(()) => Ok(items),
        Err(_) => Err(FieldError::OutOfMemory { bytes: (count as u64).saturating_mul(size_of::<T>() as u64) }),
    }
}
