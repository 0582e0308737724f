//! The part of the picture that is drawn into.

use tiny_skia::PixmapMut;

use crate::render::camera::Rectangle;

/// Samples along each side of a pixel.
pub(super) const SAMPLES: usize = 4;

/// Whole pixels.
pub(super) struct Frame {
    pub(super) left: usize,
    pub(super) top: usize,
    pub(super) width: usize,
    pub(super) height: usize,
}

impl Frame {
    pub(super) fn of(pixmap: &PixmapMut<'_>, rectangle: &Rectangle) -> Self {
        let [width, height] = [pixmap.width() as usize, pixmap.height() as usize];
        let (left, top) = ((rectangle.x.max(0.0) as usize).min(width), (rectangle.y.max(0.0) as usize).min(height));
        let right = ((rectangle.x + rectangle.width).max(0.0).ceil() as usize).min(width);
        let bottom = ((rectangle.y + rectangle.height).max(0.0).ceil() as usize).min(height);
        Self { left, top, width: right.saturating_sub(left), height: bottom.saturating_sub(top) }
    }
}
