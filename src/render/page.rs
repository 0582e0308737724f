//! Pictures with their titles and color bars on one sheet.

use super::camera::{Camera, Rectangle, View};
use super::draw_list::DrawList;
use super::legend::{draw_legend, legend_widths};
use super::png::Picture;
use super::raster::paint;
use super::style;
use super::surface::Surface;
use super::text::{Anchor, capital_height, draw_text, fitted};
use crate::error::{Error, FieldError};

/// Strokes are as wide as they say in pictures of so many pixels.
const USUAL: f64 = 900.0;
/// Thinner strokes and smaller text could not be made out.
const SMALLEST: f64 = 0.55;
/// Height of text in pictures of the usual size.
const TEXT: f64 = 24.0;
/// Height of a line of text with the room around it, by the height of text.
const LINE: f64 = 2.2;
/// Room beside a color bar, above and below it, by the height of text.
const BESIDE: f64 = 0.8;
const ABOVE: f64 = 1.6;
/// A bar takes at most this part of a picture's width, and is at least so high by the height of text.
const WIDEST: f64 = 0.3;
const LOWEST: f64 = 8.0;

/// Sizes of strokes and text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Text {
    unit: f64,
    size: f64,
}

impl Text {
    pub(super) fn for_picture(width: f64, height: f64) -> Self {
        let unit = (width.min(height) / USUAL).max(SMALLEST);
        Self { unit, size: TEXT * unit }
    }

    /// The height that a line above a picture takes; none where nothing is written, or the picture is too low.
    pub(super) fn line(&self, text: &str, height: f64) -> f64 {
        if text.is_empty() || height < LOWEST * self.size { 0.0 } else { (LINE * self.size).round() }
    }

    /// The width that a color bar takes; none where the picture is too small for one.
    pub(super) fn bar(&self, list: &DrawList, width: f64, height: f64) -> f64 {
        let inner = legend_widths(list, height - 2.0 * ABOVE * self.size, self.size);
        let bars = inner.map(|inner| (inner + 2.0 * BESIDE * self.size).round());
        let fitting = bars.into_iter().find(|&bar| bar <= WIDEST * width && height >= LOWEST * self.size);
        fitting.unwrap_or(0.0)
    }
}

/// A sheet that is being drawn.
pub(super) struct Page {
    picture: Picture,
    text: Text,
}

impl Page {
    pub(super) fn new(width: f64, height: f64, text: Text) -> Result<Self, FieldError> {
        Ok(Self { picture: Picture::new(width as u32, height as u32, style::BACKGROUND)?, text })
    }

    /// Writes into the middle of a line of that height, as much of it as there is room for.
    pub(super) fn title(&mut self, title: &str, [left, top, width, height]: [f64; 4]) {
        let size = self.text.size;
        if height <= 0.0 {
            return;
        }
        let title = fitted(title, size, width - size);
        let baseline = top + 0.5 * (height + capital_height(size));
        if let Some(mut pixmap) = self.picture.pixmap() {
            draw_text(&mut pixmap, &title, left + 0.5 * width, baseline, size, Anchor::Middle, style::INK);
        }
    }

    pub(super) fn picture(
        &mut self,
        surface: &Surface,
        list: &DrawList,
        camera: &Camera,
        [x, y, width, height]: [f64; 4],
    ) -> Result<(), Error> {
        // Of a picture that its title fills, nothing is left; but what is wrong with its camera is still said.
        let rectangle = Rectangle { x, y, width: width.max(1.0), height: height.max(1.0) };
        let view = View::framing(surface, camera, &rectangle)?;
        if let Some(mut pixmap) = self.picture.pixmap() {
            paint(&mut pixmap, &rectangle, surface, list, &view, self.text.unit)?;
        }
        Ok(())
    }

    pub(super) fn legend(&mut self, list: &DrawList, [x, y, width, height]: [f64; 4]) {
        let size = self.text.size;
        if width <= 0.0 {
            return;
        }
        let rectangle = Rectangle {
            x: x + BESIDE * size,
            y: y + ABOVE * size,
            width: width - 2.0 * BESIDE * size,
            height: height - 2.0 * ABOVE * size,
        };
        if let Some(mut pixmap) = self.picture.pixmap() {
            draw_legend(&mut pixmap, &rectangle, list, size);
        }
    }

    pub(super) fn to_png(&self) -> Result<Vec<u8>, FieldError> {
        self.picture.to_png()
    }
}
