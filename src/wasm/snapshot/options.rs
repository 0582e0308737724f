//! The options of pictures.

use wasm_bindgen::JsValue;

use super::ingredients::{ComplexInput, LevelInput, PointInput};
use super::record::Record;
use crate::error::{Error, OptionError, Result};
use crate::field::Missing;
use crate::render::{Camera, Colormap, DrawOptions, SheetOptions, SnapshotOptions};

/// The names that all three functions take.
pub(super) const DRAW: &[&str] = &["colormap", "range", "levels", "bands", "criticalPoints", "morseComplex", "missing"];
/// The names that pictures take.
pub(super) const PICTURE: &[&str] = &["width", "height", "colorBar", "title", "camera"];
/// The names that sheets take.
pub(super) const SHEET: &[&str] = &["titles", "differenceColormap", "largestDifference"];

/// What options were read to; owns what the options of `render` borrow.
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
    /// `known` are the names that the function takes.
    pub(super) fn read(options: &JsValue, known: &[&[&str]]) -> Result<Self> {
        let record = Record::new("", options)?;
        record.only(known)?;
        let pixels = "an integer from 1 to 8192";
        Ok(Self {
            colormap: colormap(&record, "colormap")?,
            range: record.numbers("range", "two finite numbers, the smaller one first")?,
            levels: record.get("levels").map(LevelInput::read).transpose()?,
            bands: record.boolean("bands")?,
            critical_points: record.get("criticalPoints").map(PointInput::read).transpose()?,
            morse_complex: record.get("morseComplex").map(ComplexInput::read).transpose()?,
            missing: missing(&record)?,
            width: record.integer("width", pixels)?,
            height: record.integer("height", pixels)?,
            color_bar: record.boolean("colorBar")?,
            title: record.text("title")?,
            camera: record.get("camera").map(camera).transpose()?.unwrap_or_default(),
            titles: record.texts("titles", "three texts")?,
            difference_colormap: colormap(&record, "differenceColormap")?,
            largest_difference: record.number("largestDifference")?,
        })
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

fn colormap(record: &Record, option: &str) -> Result<Option<Colormap>, OptionError> {
    let named = |name: String| {
        Colormap::named(&name).map_err(|error| match error {
            OptionError::InvalidOption { expected, .. } => OptionError::invalid(option, &expected),
            other => other,
        })
    };
    record.text(option)?.map(named).transpose()
}

fn missing(record: &Record) -> Result<Option<Missing>, OptionError> {
    let named = |name: String| {
        Missing::from_name(&name).ok_or_else(|| record.invalid("missing", "one of \"error\", \"omit\", \"fill\""))
    };
    record.text("missing")?.map(named).transpose()
}

fn camera(value: &JsValue) -> Result<Camera, OptionError> {
    let record = Record::new("camera", value)?;
    record.only(&[&["direction", "up"]])?;
    let expected = "three finite numbers that are not all zero";
    Ok(Camera { direction: record.numbers("direction", expected)?, up: record.numbers("up", expected)? })
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
