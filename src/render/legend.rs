//! The color bar: which color is which value.

use tiny_skia::{Paint, PixmapMut, Rect, Transform};

use super::camera::Rectangle;
use super::colormap::Rgb;
use super::draw_list::DrawList;
use super::style;
use super::text::{Anchor, capital_height, draw_text, text_width};
use super::ticks::{round_ticks, tick_label};

/// Widths of the bar, of a mark beside it, and from there to the labels, in sizes of the text.
const BAR: f64 = 1.1;
const MARK: f64 = 0.3;
const GAP: f64 = 0.25;
/// Width of all lines in sizes of the text, and length of a level's mark in the bar, of the bar's width.
const LINE: f64 = 1.0 / 16.0;
const LEVEL: f64 = 0.4;
/// How far two labels are apart at least, and usually.
const CLOSE: f64 = 1.3;
const APART: f64 = 2.6;
/// More labels than one reads.
const MOST_LABELS: usize = 9;
/// More levels than can be told apart, and how many lines' widths of the bar each of them takes at least.
const MOST_LEVELS: usize = 60;
const LEVEL_ROOM: f64 = 4.0;
/// The ends of a range are written to such a part of its width, and a single value to such a part of itself.
const FINE: f64 = 1e-2;
const FINE_ALONE: f64 = 1e-6;

/// What stands beside the color of gaps, where that is below the bar, and how high it is, in sizes of the text.
const NO_VALUE: &str = "no value";
const GAP_BELOW: f64 = 0.9;
const GAP_HEIGHT: f64 = 0.8;

/// The width that [`draw_legend`] needs for a list in a rectangle of that height, and what it needs without naming gaps; 0 where
/// it draws nothing.
pub(super) fn legend_widths(list: &DrawList, height: f64, text_size: f64) -> [f64; 2] {
    let labels = labels(list.range, bar_height(height, text_size), text_size);
    if labels.is_empty() {
        return [0.0; 2];
    }
    let widest = labels.iter().fold(0.0_f64, |widest, label| widest.max(text_width(&label.text, text_size)));
    let no_value = if list.gap.is_some() { text_width(NO_VALUE, text_size) } else { 0.0 };
    [widest.max(no_value), widest].map(|widest| (before_labels(text_size) + widest).ceil())
}

/// Draws the bar at the left of a rectangle and its labels at the right, all inside, and the color of gaps, where there are any and
/// there is room to name them, right below the rectangle. Labels that are too wide are left out, and so is everything where the
/// rectangle is too low for the labels of both ends.
pub(super) fn draw_legend(pixmap: &mut PixmapMut<'_>, rectangle: &Rectangle, list: &DrawList, text_size: f64) {
    let labels = labels(list.range, bar_height(rectangle.height, text_size), text_size);
    // Whole pixels keep edges sharp.
    let frame = (LINE * text_size).round().max(1.0);
    let (left, top) = (rectangle.x.round(), (rectangle.y + 0.5 * capital_height(text_size)).round());
    let width = (BAR * text_size).round().min(rectangle.width.floor());
    let height = bar_height(rectangle.height, text_size).round();
    if labels.is_empty() || width.is_nan() || width <= 2.0 * frame {
        return;
    }
    let (right, bottom) = (left + width, top + height);
    // The upper edge of a line at a place; the ends' lines are the frame's.
    let at = |place: f64| (bottom - frame - place * (height - frame)).round();
    fill(pixmap, [left, top, right, bottom], style::INK);
    let (inner_left, inner_right) = (left + frame, right - frame);
    let mut y = (top + frame).max(0.0);
    while y < (bottom - frame).min(f64::from(pixmap.height())) {
        let color = list.color((bottom - (y + 0.5)) / height);
        fill(pixmap, [inner_left, y, inner_right, y + 1.0], color);
        y += 1.0;
    }
    let room = LEVEL_ROOM * frame * list.levels.len() as f64;
    if list.levels.len() <= MOST_LEVELS && room <= height {
        let end = inner_left + (LEVEL * width).round();
        for &level in &list.levels {
            let y = at(place(level, list.range));
            if y > top + frame && y + frame < bottom - frame {
                fill(pixmap, [inner_left, y, end, y + frame], style::LEVELS.color);
            }
        }
    }
    let labels_start = left + before_labels(text_size);
    let fits = |text: &str| labels_start + text_width(text, text_size) <= (rectangle.x + rectangle.width).ceil();
    if let Some(color) = list.gap.filter(|_| fits(NO_VALUE)) {
        let upper = bottom + (GAP_BELOW * text_size).round();
        let lower = upper + (GAP_HEIGHT * text_size).round();
        fill(pixmap, [left, upper, right, lower], style::INK);
        fill(pixmap, [inner_left, upper + frame, inner_right, lower - frame], color);
        let baseline = 0.5 * (upper + lower + capital_height(text_size));
        draw_text(pixmap, NO_VALUE, labels_start, baseline, text_size, Anchor::Start, style::INK);
    }
    let mark = right + (MARK * text_size).round();
    for Label { place, text } in labels {
        let y = at(place);
        fill(pixmap, [right, y, mark, y + frame], style::INK);
        if fits(&text) {
            let baseline = y + 0.5 * (frame + capital_height(text_size));
            draw_text(pixmap, &text, labels_start, baseline, text_size, Anchor::Start, style::INK);
        }
    }
}

/// Half the height of a label stands out at either end.
fn bar_height(height: f64, text_size: f64) -> f64 {
    height - capital_height(text_size)
}

fn before_labels(text_size: f64) -> f64 {
    ((BAR + MARK + GAP) * text_size).ceil()
}

/// What is written beside the bar, at a place from 0 (low) to 1 (high).
struct Label {
    place: f64,
    text: String,
}

/// The ends of the range, and round numbers between them; one label for one value. None where there is no room for two.
fn labels(range: [f64; 2], height: f64, text_size: f64) -> Vec<Label> {
    let close = CLOSE * text_size;
    // Written so that what is not a number is too small.
    if !(text_size > 0.0 && height >= close) {
        return Vec::new();
    }
    let [low, high] = range;
    let label = |value: f64, step: f64| Label { place: place(value, range), text: tick_label(value, range, step) };
    if low >= high {
        return vec![label(low, FINE_ALONE * low.abs())];
    }
    let fine = FINE * (high - low);
    let ticks = round_ticks(low, high, MOST_LABELS.min((height / (APART * text_size)) as usize));
    let step = if ticks.len() > 1 { ticks[1] - ticks[0] } else { fine };
    let mut labels = vec![label(low, fine), label(high, fine)];
    for tick in ticks {
        let above = height * place(tick, range);
        if above >= close && height - above >= close {
            labels.push(label(tick, step));
        }
    }
    labels
}

/// The place of a value in a range, from 0 to 1; the middle where the range is one value.
fn place(value: f64, [low, high]: [f64; 2]) -> f64 {
    if low < high { (value - low) / (high - low) } else { 0.5 }
}

/// Left, top, right, bottom. What is outside the picture is cut off before tiny-skia computes in single precision.
fn fill(pixmap: &mut PixmapMut<'_>, [left, top, right, bottom]: [f64; 4], color: Rgb) {
    let (width, height) = (f64::from(pixmap.width()), f64::from(pixmap.height()));
    let cut = |x: f64, most: f64| x.clamp(0.0, most) as f32;
    let rectangle = Rect::from_ltrb(cut(left, width), cut(top, height), cut(right, width), cut(bottom, height));
    let Some(rectangle) = rectangle.filter(|r| r.width() > 0.0 && r.height() > 0.0) else { return };
    let mut paint = Paint::default();
    paint.set_color_rgba8(color[0], color[1], color[2], 255);
    pixmap.fill_rect(rectangle, &paint, Transform::identity(), None);
}
