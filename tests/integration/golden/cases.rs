//! What the golden pictures show: `tests/golden/cases.json`, with options as JavaScript has them.

use std::path::Path;

use morse_smooth::field::{Missing, Threshold};
use morse_smooth::load::{LoadOptions, load};
use morse_smooth::render::{
    Camera, Colormap, DrawOptions, Glyphs, Levels, Separatrices, SheetOptions, SnapshotOptions, sheet, snapshot,
};
use serde_json::{Map, Value};

pub(super) struct Case {
    pub(super) name: String,
    mesh: String,
    /// One for a snapshot, two for a sheet.
    fields: Vec<String>,
    options: Map<String, Value>,
}

pub(super) fn read(folder: &Path) -> Vec<Case> {
    let text = std::fs::read_to_string(folder.join("cases.json")).expect("a file of cases");
    let cases: Value = serde_json::from_str(&text).expect("cases");
    let string = |value: &Value| value.as_str().expect("a text").to_owned();
    let read = |case: &Value| Case {
        name: string(&case["name"]),
        mesh: string(&case["mesh"]),
        fields: case["fields"].as_array().expect("names of fields").iter().map(string).collect(),
        options: case["options"].as_object().expect("options").clone(),
    };
    cases.as_array().expect("a list of cases").iter().map(read).collect()
}

impl Case {
    pub(super) fn draw(&self, folder: &Path) -> Vec<u8> {
        let bytes = std::fs::read(folder.join(format!("{}.ply", self.mesh))).expect("a mesh");
        let file = load(&bytes, &LoadOptions::default()).expect("a mesh");
        let field =
            |name: &String| &file.fields.iter().find(|(known, _)| known == name).expect("a field of that name").1;
        let levels = self.options.get("levels").and_then(Value::as_array).map(|list| numbers(list)).unwrap_or_default();
        match self.fields.as_slice() {
            [name] => {
                let options = self.picture(SnapshotOptions::default(), &levels, &[]);
                snapshot(&file.mesh, field(name), &options).expect("a picture")
            }
            [before, after] => {
                let defaults = SheetOptions::default();
                let mut options = SheetOptions {
                    picture: self.picture(
                        defaults.picture,
                        &levels,
                        &["titles", "differenceColormap", "largestDifference"],
                    ),
                    ..defaults
                };
                if let Some(titles) = self.options.get("titles") {
                    options.titles = [0, 1, 2].map(|k| titles[k].as_str().expect("a title"));
                }
                if let Some(name) = self.options.get("differenceColormap") {
                    options.difference_colormap = colormap(name);
                }
                options.largest_difference = self.options.get("largestDifference").map(number);
                sheet(&file.mesh, field(before), field(after), &options).expect("a sheet")
            }
            other => panic!("{}: {} fields", self.name, other.len()),
        }
    }

    /// The options of a picture; those in `others` are read elsewhere.
    fn picture<'a>(&'a self, defaults: SnapshotOptions<'a>, levels: &'a [f64], others: &[&str]) -> SnapshotOptions<'a> {
        let mut options = defaults;
        for (name, value) in &self.options {
            let draw: &mut DrawOptions<'_> = &mut options.draw;
            match name.as_str() {
                "width" => options.width = number(value) as u32,
                "height" => options.height = number(value) as u32,
                "colorBar" => options.color_bar = value.as_bool().expect("yes or no"),
                "title" => options.title = value.as_str().expect("a title"),
                "camera" => options.camera = camera(value),
                "colormap" => draw.colormap = colormap(value),
                "range" => draw.range = Some([number(&value[0]), number(&value[1])]),
                "bands" => draw.bands = value.as_bool().expect("yes or no"),
                "levels" if value.is_array() => draw.levels = Levels::At(levels),
                "levels" => draw.levels = Levels::Count(number(&value["count"]) as u32),
                "missing" => draw.missing = Missing::from_name(value.as_str().expect("a name")).expect("a meaning"),
                "criticalPoints" => {
                    draw.critical_points = if value == &Value::Bool(true) { Glyphs::Found } else { Glyphs::None };
                }
                "morseComplex" => {
                    let above = |persistence| Separatrices::Above(Threshold::Relative(persistence));
                    draw.morse_complex = match value {
                        Value::Bool(false) => Separatrices::None,
                        Value::Bool(true) => above(0.0),
                        _ => above(number(&value["persistence"])),
                    };
                }
                other => assert!(others.contains(&other), "{}: no option is called {other}", self.name),
            }
        }
        options
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(list: &[Value]) -> Vec<f64> {
    list.iter().map(number).collect()
}

fn colormap(value: &Value) -> Colormap {
    Colormap::named(value.as_str().expect("a name")).expect("a color map")
}

fn camera(value: &Value) -> Camera {
    let vector = |name: &str| value.get(name).map(|list| [0, 1, 2].map(|i| number(&list[i])));
    Camera { direction: vector("direction"), up: vector("up") }
}
