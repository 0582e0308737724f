//! Surfaces and draw lists as plain objects.

use js_sys::{Array, Object};
use wasm_bindgen::JsValue;

use crate::error::OutOfMemory;
use crate::render::{Axis, DrawList, Lines, Rgb, Role, Solids, Surface};
use crate::wasm::shared::answer::Answer;

/// How many colors a map with steps is tabulated with: a step is then at most a four-thousandth of the range off its level.
const STEPPED: usize = 2048;

pub(super) fn surface(surface: &Surface) -> Result<Object, OutOfMemory> {
    let up = match surface.up {
        Axis::Y => "y",
        Axis::Z => "z",
    };
    let answer = Answer::new();
    singles(&answer, "positions", &surface.positions);
    singles(&answer, "normals", &surface.normals);
    answer.array("triangles", surface.triangles.as_flattened());
    answer.array("vertices", &surface.vertices);
    answer.text("up", up);
    answer.set("center", &numbers(&surface.center));
    answer.number("scale", 1.0 / surface.size);
    answer.finish()
}

pub(super) fn draw_list(list: &DrawList) -> Result<Object, OutOfMemory> {
    let colors: Vec<Rgb> = if list.step_colors.is_empty() {
        list.colors.clone()
    } else {
        (0..STEPPED).map(|k| list.color(k as f64 / (STEPPED - 1) as f64)).collect()
    };
    let size = Answer::new();
    size.number("cover", list.size.cover);
    size.number("least", list.size.least);
    size.number("most", list.size.most);
    let light = Answer::new();
    light.number("ambient", list.light.ambient);
    light.number("diffuse", list.light.diffuse);
    light.set("direction", &numbers(&list.light.direction));
    let answer = Answer::new();
    singles(&answer, "shades", &list.shades);
    answer.array("colors", colors.as_flattened());
    match list.gap {
        None => answer.set("gap", &JsValue::NULL),
        Some([red, green, blue]) => answer.number("gap", f64::from(u32::from_be_bytes([0, red, green, blue]))),
    }
    answer.set("range", &numbers(&list.range));
    answer.array("levels", &list.levels);
    let lines: Array = list.lines.iter().map(lines).collect::<Result<_, _>>()?;
    let solids: Array = list.solids.iter().map(solids).collect::<Result<_, _>>()?;
    answer.set("lines", &lines);
    answer.set("solids", &solids);
    answer.part("size", size);
    answer.part("light", light);
    answer.finish()
}

fn lines(lines: &Lines) -> Result<Object, OutOfMemory> {
    let stroke = Answer::new();
    color(&stroke, lines.stroke.color);
    stroke.number("width", lines.stroke.width);
    stroke.number("opacity", lines.stroke.opacity);
    match lines.stroke.casing {
        None => stroke.set("casing", &JsValue::NULL),
        Some(given) => {
            let casing = Answer::new();
            color(&casing, given.color);
            casing.number("width", given.width);
            stroke.part("casing", casing);
        }
    }
    let answer = Answer::new();
    kind(&answer, lines.role);
    singles(&answer, "points", &lines.points);
    answer.array("offsets", &lines.offsets);
    answer.column("closed", lines.closed.len(), &|k| u8::from(lines.closed[k]));
    answer.part("stroke", stroke);
    answer.finish()
}

fn solids(solids: &Solids) -> Result<Object, OutOfMemory> {
    let shape = Answer::new();
    singles(&shape, "positions", solids.shape.positions.as_flattened());
    singles(&shape, "normals", solids.shape.normals.as_flattened());
    shape.array("triangles", solids.shape.triangles.as_flattened());
    let rim = Answer::new();
    color(&rim, solids.rim.color);
    rim.number("scale", solids.rim.scale);
    let answer = Answer::new();
    kind(&answer, solids.role);
    answer.part("shape", shape);
    color(&answer, solids.color);
    answer.part("rim", rim);
    answer.number("glow", solids.glow);
    answer.array("vertices", &solids.vertices);
    singles(&answer, "places", solids.places.as_flattened());
    singles(&answer, "axes", solids.axes.as_flattened());
    answer.column("bothSides", solids.both_sides.len(), &|k| u8::from(solids.both_sides[k]));
    answer.number("radius", solids.radius);
    answer.number("lift", solids.lift);
    answer.finish()
}

fn kind(answer: &Answer, role: Role) {
    let name = match role {
        Role::Levels => "levels",
        Role::Descending => "descending",
        Role::Ascending => "ascending",
        Role::Minima => "minima",
        Role::Saddles => "saddles",
        Role::Maxima => "maxima",
    };
    answer.text("kind", name);
}

fn color(answer: &Answer, [red, green, blue]: Rgb) {
    let color = u32::from_be_bytes([0, red, green, blue]);
    answer.number("color", f64::from(color));
}

/// Few numbers, as an ordinary array.
fn numbers(values: &[f64]) -> Array {
    values.iter().copied().map(JsValue::from_f64).collect()
}

/// In the precision of graphics cards.
fn singles(answer: &Answer, name: &str, values: &[f64]) {
    answer.column(name, values.len(), &|k| values[k] as f32);
}
