//! The options of pictures.

use wasm_bindgen::JsValue;

use super::ingredients::{ComplexInput, LevelInput, PointInput};
use crate::error::{Error, OptionError, Result};
use crate::field::Missing;
use crate::render::{Camera, Colormap, DrawOptions, SheetOptions, SnapshotOptions};
use crate::wasm::shared::record::{Record, read};

/// What is asked for: each has more options than the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd)]
pub(super) enum Kind {
    DrawList,
    Picture,
    Sheet,
}

/// What options were read to; owns what the options of `render` borrow.
#[derive(Default)]
pub(super) struct Input {
    colormap: Option<Colormap>,
    range: Option<[f64; 2]>,
    levels: Option<LevelInput>,
    bands: Option<bool>,
    critical_points: Option<PointInput>,
    morse_complex: Option<ComplexInput>,
    missing: Option<Missing>,
    width: Option<u32>,
    height: Option<u32>,
    color_bar: Option<bool>,
    title: Option<String>,
    camera: Camera,
    titles: Option<[String; 3]>,
    difference_colormap: Option<Colormap>,
    largest_difference: Option<f64>,
}

impl Input {
    pub(super) fn read(options: &JsValue, kind: Kind) -> Result<Self> {
        read("", options, |record| {
            let mut input = Self {
                colormap: colormap(record, "colormap"),
                range: record.numbers("range", "two finite numbers, the smaller one first"),
                levels: record.part("levels", LevelInput::read),
                bands: record.boolean("bands"),
                critical_points: record.part("criticalPoints", PointInput::read),
                morse_complex: record.part("morseComplex", ComplexInput::read),
                missing: record.choice("missing"),
                ..Self::default()
            };
            if kind >= Kind::Picture {
                input.read_picture(record);
            }
            if kind >= Kind::Sheet {
                input.titles = record.texts("titles", "three texts");
                input.difference_colormap = colormap(record, "differenceColormap");
                input.largest_difference = record.number("largestDifference");
            }
            input
        })
    }

    fn read_picture(&mut self, record: &Record) {
        let pixels = "an integer from 1 to 8192";
        self.width = record.integer_of("width", pixels);
        self.height = record.integer_of("height", pixels);
        self.color_bar = record.boolean("colorBar");
        self.title = record.text("title");
        self.camera = record.part("camera", camera).unwrap_or_default();
    }

    pub(super) fn draw(&self) -> DrawOptions<'_> {
        let defaults = DrawOptions::default();
        DrawOptions {
            colormap: self.colormap.unwrap_or(defaults.colormap),
            range: self.range,
            levels: self.levels.as_ref().map_or(defaults.levels, LevelInput::levels),
            bands: self.bands.unwrap_or(defaults.bands),
            critical_points: self.critical_points.as_ref().map_or(defaults.critical_points, PointInput::glyphs),
            morse_complex: self.morse_complex.as_ref().map_or(defaults.morse_complex, ComplexInput::separatrices),
            missing: self.missing.unwrap_or(defaults.missing),
        }
    }

    pub(super) fn snapshot(&self) -> SnapshotOptions<'_> {
        self.picture(SnapshotOptions::default())
    }

    fn picture<'a>(&'a self, defaults: SnapshotOptions<'a>) -> SnapshotOptions<'a> {
        SnapshotOptions {
            draw: self.draw(),
            width: self.width.unwrap_or(defaults.width),
            height: self.height.unwrap_or(defaults.height),
            color_bar: self.color_bar.unwrap_or(defaults.color_bar),
            title: self.title.as_deref().unwrap_or(defaults.title),
            camera: self.camera,
        }
    }

    pub(super) fn sheet(&self) -> SheetOptions<'_> {
        let defaults = SheetOptions::default();
        let titles = self.titles.as_ref();
        SheetOptions {
            picture: self.picture(defaults.picture),
            titles: titles.map_or(defaults.titles, |titles| titles.each_ref().map(String::as_str)),
            difference_colormap: self.difference_colormap.unwrap_or(defaults.difference_colormap),
            largest_difference: self.largest_difference,
        }
    }
}

fn colormap(record: &Record, option: &'static str) -> Option<Colormap> {
    let name = record.text(option)?;
    record.taken(Colormap::named(&name).map_err(|error| match error {
        OptionError::InvalidOption { expected, .. } => OptionError::invalid(option, &expected),
        other => other,
    }))
}

fn camera(value: &JsValue) -> Result<Camera> {
    let expected = "three finite numbers that are not all zero";
    read("camera", value, |record| Camera {
        direction: record.numbers("direction", expected),
        up: record.numbers("up", expected),
    })
}

/// Says where the option stands that `field` refuses.
pub(super) fn placed(error: Error) -> Error {
    match error {
        Error::Option(OptionError::InvalidOption { option, expected }) if option == "persistence" => {
            OptionError::invalid("morseComplex.persistence", &expected).into()
        }
        other => other,
    }
}
