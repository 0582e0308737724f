//! What to draw, and how.

use super::camera::Camera;
use super::colormap::Colormap;
use crate::error::OptionError;
use crate::field::{CriticalPoint, LevelSets, Missing, MorseComplex, Threshold};

/// More pixels along a side than any screen or page has; the bound keeps a slip from filling the memory.
pub(super) const LARGEST_SIDE: u32 = 8192;

/// Where level sets are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Levels<'a> {
    /// Nowhere.
    None,
    /// So many levels, evenly spaced inside the range of the colors. The default is 15.
    Count(u32),
    /// At these values.
    At(&'a [f64]),
    /// These lines, as [`level_sets`](crate::field::level_sets) gives them.
    Traced(&'a LevelSets),
}

/// Which critical points are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Glyphs<'a> {
    /// None.
    None,
    /// All of [`critical_points`](crate::field::critical_points) at δ = 0. The default.
    #[default]
    Found,
    /// These.
    Points(&'a [CriticalPoint]),
}

/// Whether the Morse complex is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Separatrices<'a> {
    /// It is not. The default.
    #[default]
    None,
    /// With pairs up to this persistence cancelled.
    Above(Threshold),
    /// These lines, as [`morse_complex`](crate::field::morse_complex) gives them.
    Traced(&'a MorseComplex),
}

/// What to draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawOptions<'a> {
    /// Colors of the values. Default [`Colormap::Viridis`].
    pub colormap: Colormap,
    /// The values that have the first and the last color; values beyond have them, too. Default: least and greatest value.
    pub range: Option<[f64; 2]>,
    /// Default: 15 levels.
    pub levels: Levels<'a>,
    /// One color between two levels instead of a continuous map. Default false.
    pub bands: bool,
    /// Default: all critical points.
    pub critical_points: Glyphs<'a>,
    /// Default: not drawn.
    pub morse_complex: Separatrices<'a>,
    /// What a value that is not a number means. With [`Missing::Omit`] its triangles are drawn grey, and lines and points are
    /// those of the field without them. Default [`Missing::Error`]; [`Missing::Fill`] does not apply.
    pub missing: Missing,
}

impl Default for DrawOptions<'_> {
    fn default() -> Self {
        Self {
            colormap: Colormap::default(),
            range: None,
            levels: Levels::Count(15),
            bands: false,
            critical_points: Glyphs::default(),
            morse_complex: Separatrices::default(),
            missing: Missing::default(),
        }
    }
}

impl DrawOptions<'_> {
    pub(super) fn check(&self) -> Result<(), OptionError> {
        match self.range {
            Some([low, high]) if !(low < high && (high - low).is_finite()) => {
                Err(OptionError::invalid("range", "two finite numbers, the smaller one first"))
            }
            _ => Ok(()),
        }
    }
}

/// What to draw, and how large and from where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SnapshotOptions<'a> {
    /// What to draw. Default: colors, 15 level sets, critical points.
    pub draw: DrawOptions<'a>,
    /// Pixels, 1 to 8192. Default 1200.
    pub width: u32,
    /// Pixels, 1 to 8192. Default 900.
    pub height: u32,
    /// A bar that says which color is which value; it is left out where the picture is too small for it. Default true.
    pub color_bar: bool,
    /// Written above the picture, where there is room; as much of it as fits. Letters are those of ASCII and some of Greek; others
    /// become boxes. Default: nothing.
    pub title: &'a str,
    /// From where to look. Default: from the front and a little from above, or from above on what lies flat.
    pub camera: Camera,
}

impl Default for SnapshotOptions<'_> {
    fn default() -> Self {
        Self {
            draw: DrawOptions::default(),
            width: 1200,
            height: 900,
            color_bar: true,
            title: "",
            camera: Camera::default(),
        }
    }
}

/// A sheet of three pictures side by side: before, after, difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetOptions<'a> {
    /// How each picture is drawn: `width` and `height` are those of one, the range is that of both fields, and the title is above them all.
    /// Default as for a snapshot, but 600 by 560 pixels.
    pub picture: SnapshotOptions<'a>,
    /// What is written above each picture. Default: before, after, difference.
    pub titles: [&'a str; 3],
    /// Colors of after − before. Default [`Colormap::CoolWarm`].
    pub difference_colormap: Colormap,
    /// The difference that has the last color; its negative has the first. Default: the largest that there is.
    pub largest_difference: Option<f64>,
}

impl Default for SheetOptions<'_> {
    fn default() -> Self {
        Self {
            picture: SnapshotOptions { width: 600, height: 560, ..SnapshotOptions::default() },
            titles: ["before", "after", "difference"],
            difference_colormap: Colormap::CoolWarm,
            largest_difference: None,
        }
    }
}

impl SnapshotOptions<'_> {
    pub(super) fn check(&self) -> Result<(), OptionError> {
        for (option, side) in [("width", self.width), ("height", self.height)] {
            if !(1..=LARGEST_SIDE).contains(&side) {
                return Err(OptionError::invalid(option, "an integer from 1 to 8192"));
            }
        }
        Ok(())
    }
}

impl SheetOptions<'_> {
    pub(super) fn check(&self) -> Result<(), OptionError> {
        self.picture.check()?;
        self.picture.draw.check()?;
        let draw = &self.picture.draw;
        for (option, is_of_one) in [
            ("levels", matches!(draw.levels, Levels::Traced(_))),
            ("criticalPoints", matches!(draw.critical_points, Glyphs::Points(_))),
            ("morseComplex", matches!(draw.morse_complex, Separatrices::Traced(_))),
        ] {
            if is_of_one {
                let reason = "a sheet shows several fields, and these lines or points belong to one".to_owned();
                return Err(OptionError::InapplicableOption { option: option.to_owned(), reason });
            }
        }
        match self.largest_difference {
            Some(largest) if !(largest > 0.0 && (2.0 * largest).is_finite()) => {
                Err(OptionError::invalid("largestDifference", "a positive finite number"))
            }
            _ => Ok(()),
        }
    }

    /// Checks the size of the sheet as a whole.
    pub(super) fn check_total(&self, [width, height]: [f64; 2]) -> Result<(), OptionError> {
        for (option, side) in [("width", width), ("height", height)] {
            if side > f64::from(LARGEST_SIDE) {
                return Err(OptionError::invalid(
                    option,
                    "a smaller number: the whole sheet may have 8192 pixels along a side",
                ));
            }
        }
        Ok(())
    }

    /// How the difference is drawn.
    pub(super) fn difference(&self, range: Option<[f64; 2]>) -> DrawOptions<'static> {
        DrawOptions {
            colormap: self.difference_colormap,
            range,
            levels: Levels::None,
            bands: false,
            critical_points: Glyphs::None,
            morse_complex: Separatrices::None,
            missing: self.picture.draw.missing,
        }
    }
}
