//! From a draw list to pixels.
//!
//! Surface and solids go through a depth buffer with sixteen samples for each pixel, strip by strip, so that depths take no more
//! memory in larger pictures. While a strip's depths are there, lines ask them which of their pieces are seen; those are drawn as
//! smooth strokes at the end.

mod binned;
mod brush;
mod facets;
mod frame;
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
use frame::{Frame, SAMPLES};
use lines::Tracks;
use strip::Strip;

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
