//! Surfaces and draw lists as plain objects.

use js_sys::{Array, Float32Array, Float64Array, Object, Uint8Array, Uint32Array};
use wasm_bindgen::JsValue;

use crate::render::{Axis, DrawList, Lines, Rgb, Role, Solids, Surface};
use crate::wasm::error::set;

/// How many colours a map with steps is tabulated with: a step is then at most a four-thousandth of the range off its level.
const STEPPED: usize = 2048;

pub(super) fn surface(surface: &Surface) -> Object {
    let up = match surface.up {
        Axis::Y => "y",
        Axis::Z => "z",
    };
    let object = Object::new();
    set(&object, "positions", &singles(&surface.positions));
    set(&object, "normals", &singles(&surface.normals));
    set(&object, "triangles", &Uint32Array::from(surface.triangles.as_flattened()));
    set(&object, "vertices", &Uint32Array::from(surface.vertices.as_slice()));
    set(&object, "up", &JsValue::from_str(up));
    set(&object, "centre", &numbers(&surface.center));
    number(&object, "scale", 1.0 / surface.size);
    object
}

pub(super) fn draw_list(list: &DrawList) -> Object {
    let colours: Vec<Rgb> = if list.step_colors.is_empty() {
        list.colors.clone()
    } else {
        (0..STEPPED).map(|k| list.color(k as f64 / (STEPPED - 1) as f64)).collect()
    };
    let size = Object::new();
    number(&size, "cover", list.size.cover);
    number(&size, "least", list.size.least);
    number(&size, "most", list.size.most);
    let light = Object::new();
    number(&light, "ambient", list.light.ambient);
    number(&light, "diffuse", list.light.diffuse);
    set(&light, "direction", &numbers(&list.light.direction));
    let object = Object::new();
    set(&object, "shades", &singles(&list.shades));
    set(&object, "colours", &Uint8Array::from(colours.as_flattened()));
    let gap = list.gap.map_or(JsValue::NULL, |[red, green, blue]| u32::from_be_bytes([0, red, green, blue]).into());
    set(&object, "gap", &gap);
    set(&object, "range", &numbers(&list.range));
    set(&object, "levels", &Float64Array::from(list.levels.as_slice()));
    set(&object, "lines", &list.lines.iter().map(lines).collect::<Array>());
    set(&object, "solids", &list.solids.iter().map(solids).collect::<Array>());
    set(&object, "size", &size);
    set(&object, "light", &light);
    object
}

fn lines(lines: &Lines) -> Object {
    let stroke = Object::new();
    colour(&stroke, lines.stroke.color);
    number(&stroke, "width", lines.stroke.width);
    number(&stroke, "opacity", lines.stroke.opacity);
    let casing = lines.stroke.casing.map_or(JsValue::NULL, |casing| {
        let object = Object::new();
        colour(&object, casing.color);
        number(&object, "width", casing.width);
        object.into()
    });
    set(&stroke, "casing", &casing);
    let closed: Vec<u8> = lines.closed.iter().map(|&closed| u8::from(closed)).collect();
    let object = Object::new();
    kind(&object, lines.role);
    set(&object, "points", &singles(&lines.points));
    set(&object, "offsets", &Uint32Array::from(lines.offsets.as_slice()));
    set(&object, "closed", &Uint8Array::from(closed.as_slice()));
    set(&object, "stroke", &stroke);
    object
}

fn solids(solids: &Solids) -> Object {
    let shape = Object::new();
    set(&shape, "positions", &singles(solids.shape.positions.as_flattened()));
    set(&shape, "normals", &singles(solids.shape.normals.as_flattened()));
    set(&shape, "triangles", &Uint32Array::from(solids.shape.triangles.as_flattened()));
    let rim = Object::new();
    colour(&rim, solids.rim.color);
    number(&rim, "scale", solids.rim.scale);
    let object = Object::new();
    kind(&object, solids.role);
    set(&object, "shape", &shape);
    colour(&object, solids.color);
    set(&object, "rim", &rim);
    number(&object, "glow", solids.glow);
    set(&object, "vertices", &Uint32Array::from(solids.vertices.as_slice()));
    set(&object, "places", &singles(solids.places.as_flattened()));
    set(&object, "axes", &singles(solids.axes.as_flattened()));
    let both_sides: Vec<u8> = solids.both_sides.iter().map(|&both| u8::from(both)).collect();
    set(&object, "bothSides", &Uint8Array::from(both_sides.as_slice()));
    number(&object, "radius", solids.radius);
    number(&object, "lift", solids.lift);
    object
}

fn kind(object: &Object, role: Role) {
    let name = match role {
        Role::Levels => "levels",
        Role::Descending => "descending",
        Role::Ascending => "ascending",
        Role::Minima => "minima",
        Role::Saddles => "saddles",
        Role::Maxima => "maxima",
    };
    set(object, "kind", &JsValue::from_str(name));
}

fn colour(object: &Object, [red, green, blue]: Rgb) {
    let colour = u32::from_be_bytes([0, red, green, blue]);
    number(object, "colour", f64::from(colour));
}

fn number(object: &Object, name: &str, value: f64) {
    set(object, name, &JsValue::from_f64(value));
}

/// Few numbers, as an ordinary array.
fn numbers(values: &[f64]) -> Array {
    values.iter().copied().map(JsValue::from_f64).collect()
}

/// In the precision of graphics cards.
fn singles(values: &[f64]) -> Float32Array {
    let singles: Vec<f32> = values.iter().map(|&value| value as f32).collect();
    Float32Array::from(singles.as_slice())
}
