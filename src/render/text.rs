//! Text in pictures.

use std::borrow::Cow;

use tiny_skia::{FillRule, LineCap, LineJoin, Paint, PathBuilder, PixmapMut, Stroke, Transform};

use super::colormap::Rgb;
use super::font::{self, Step};

/// Height of capitals, of the size: in other fonts of that size they are about as high.
const CAPITALS: f64 = 1.0 / 1.4;
/// Width of strokes, of the size.
const STROKE: f64 = 1.0 / 11.0;
/// Where a quarter of a turn is halved, its tangent meets those of its ends at this part of the way to the corner: a circle has
/// 2 − √2. A little less is a little squarer, which makes small letters more open.
const ROUND: f64 = 0.57;

/// Sizes that are drawn, and how far away from the picture's corner, in pixels.
const SIZES: core::ops::RangeInclusive<f64> = 1.0..=1e4;
const FAR: f64 = 1e5;

/// Which point of a text is where it is put.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
}

/// Height of capitals and digits.
pub(super) fn capital_height(size: f64) -> f64 {
    CAPITALS * size
}

/// From the start of a text to where the next one would start, in pixels.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    text.chars().map(|character| font::advance(character) * unit(size)).sum()
}

/// The text, cut and ended by "…" where it would be wider than so many pixels; empty where not even that fits.
pub(super) fn fitted(text: &str, size: f64, width: f64) -> Cow<'_, str> {
    const CUT: char = '…';
    let unit = unit(size);
    let room = width - font::advance(CUT) * unit;
    // Where the text is cut if it turns out to be too wide.
    let (mut end, mut so_far) = (0, 0.0);
    for (start, character) in text.char_indices() {
        if so_far <= room {
            end = start;
        }
        so_far += font::advance(character) * unit;
        if so_far > width {
            if room < 0.0 {
                return Cow::Borrowed("");
            }
            let mut cut = text[..end].trim_end().to_owned();
            cut.push(CUT);
            return Cow::Owned(cut);
        }
    }
    Cow::Borrowed(text)
}

/// Writes one line of text with its anchor at x and its baseline at y. The size is 1.4 times the height of capitals.
///
/// Strokes along the lines that letters stand between are moved to whole pixels, so that they are sharp.
pub(super) fn draw_text(pixmap: &mut PixmapMut<'_>, text: &str, x: f64, y: f64, size: f64, anchor: Anchor, color: Rgb) {
    // Others are not seen, and single precision does not overflow. What is not a number is not drawn either.
    if !(SIZES.contains(&size) && x.abs() < FAR && y.abs() < FAR) {
        return;
    }
    let along = match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -0.5,
    };
    let grid = Grid::new(size, x + along * text_width(text, size), y);
    let mut builder = PathBuilder::new();
    let mut offset = 0.0;
    for character in text.chars() {
        let next = offset + font::advance(character);
        let [left, right] = [offset, next].map(|offset| grid.place(offset, [0.0; 2])[0]);
        if left > f64::from(pixmap.width()) {
            break;
        }
        if right >= 0.0 {
            draw_character(&mut builder, &grid, offset, character);
        }
        offset = next;
    }
    let stroke =
        Stroke { width: grid.stroke as f32, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
    // As an area: strokes of less than a pixel would be drawn by another rule.
    let Some(area) = builder.finish().and_then(|path| path.stroke(&stroke, 1.0)) else { return };
    let mut paint = Paint::default();
    paint.set_color_rgba8(color[0], color[1], color[2], 255);
    pixmap.fill_path(&area, &paint, FillRule::Winding, Transform::identity(), None);
}

fn draw_character(builder: &mut PathBuilder, grid: &Grid, offset: f64, character: char) {
    let mut at = [0.0; 2];
    for step in font::steps(character) {
        match step {
            Step::Begin(p) => {
                at = grid.place(offset, p);
                builder.move_to(at[0] as f32, at[1] as f32);
            }
            Step::Line(p) => {
                at = grid.place(offset, p);
                builder.line_to(at[0] as f32, at[1] as f32);
            }
            Step::Turn(corner, end) => {
                let (corner, end) = (grid.place(offset, corner), grid.place(offset, end));
                turn(builder, at, corner, end);
                at = end;
            }
        }
    }
}

fn unit(size: f64) -> f64 {
    CAPITALS * size / font::CAPITALS
}

/// Halved, because parabolas are no circles. tiny-skia's cubic curves are not the same on every platform.
fn turn(builder: &mut PathBuilder, start: [f64; 2], corner: [f64; 2], end: [f64; 2]) {
    let towards = |p: [f64; 2]| [0, 1].map(|i| corner[i] + ROUND * (p[i] - corner[i]));
    let (a, b) = (towards(start), towards(end));
    let middle = [0, 1].map(|i| 0.5 * (a[i] + b[i]));
    builder.quad_to(a[0] as f32, a[1] as f32, middle[0] as f32, middle[1] as f32);
    builder.quad_to(b[0] as f32, b[1] as f32, end[0] as f32, end[1] as f32);
}

/// From a font's units to pixels.
struct Grid {
    unit: f64,
    left: f64,
    stroke: f64,
    /// Where [`font::LINES`] are in the picture.
    lines: [f64; 4],
}

impl Grid {
    fn new(size: f64, left: f64, baseline: f64) -> Self {
        let (unit, stroke) = (unit(size), STROKE * size);
        // Strokes end on a whole pixel, below the baseline and above it.
        let half = 0.5 * stroke;
        let base = (baseline + half).round() - half;
        let lines = font::LINES.map(|line| {
            let y = base - unit * line;
            if line > 0.0 { (y - half).round() + half } else { (y + half).round() - half }
        });
        Self { unit, left, stroke, lines }
    }

    fn place(&self, offset: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        // Beyond the first and the last line as between the nearest two.
        let k = font::LINES.partition_point(|&line| line <= y).clamp(1, 3);
        let (low, high) = (font::LINES[k - 1], font::LINES[k]);
        let part = (y - low) / (high - low);
        let y = self.lines[k - 1] + part * (self.lines[k] - self.lines[k - 1]);
        [self.left + self.unit * (offset + x), y]
    }
}
