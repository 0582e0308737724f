//! From values to colors.

use crate::error::OptionError;

/// Red, green and blue of the sRGB color space.
pub type Rgb = [u8; 3];

/// How many colors a map is tabulated with: steps that no eye tells apart.
pub(super) const SAMPLES: usize = 512;

/// A map of colors from the low end of a range to the high end.
///
/// The first five are perceptually uniform: equal steps of the value look like equal steps, also in grey and for most color-blind
/// people. The others diverge from their middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Colormap {
    /// Blue over green to yellow. The default.
    #[default]
    Viridis,
    /// Blue over grey to yellow, nearly the same for people who see no red or no green.
    Cividis,
    /// Black over red to white.
    Magma,
    /// Black over red to pale yellow.
    Inferno,
    /// Blue over red to yellow.
    Plasma,
    /// Blue over light grey to red \[Moreland09\].
    CoolWarm,
    /// Blue over pale yellow to red.
    BlueRed,
    /// Purple over white to green.
    PurpleGreen,
}

/// All maps with their names in JavaScript.
const MAPS: [(&str, Colormap); 8] = [
    ("viridis", Colormap::Viridis),
    ("cividis", Colormap::Cividis),
    ("magma", Colormap::Magma),
    ("inferno", Colormap::Inferno),
    ("plasma", Colormap::Plasma),
    ("coolWarm", Colormap::CoolWarm),
    ("blueRed", Colormap::BlueRed),
    ("purpleGreen", Colormap::PurpleGreen),
];

/// The cool-warm map at equal steps; straight lines lie between them.
const COOL_WARM: [Rgb; 9] = [
    [59, 76, 192],
    [98, 130, 234],
    [141, 176, 254],
    [184, 208, 249],
    [221, 221, 221],
    [245, 196, 173],
    [244, 154, 123],
    [222, 96, 77],
    [180, 4, 38],
];

impl Colormap {
    /// The map of that name.
    ///
    /// # Errors
    /// `InvalidOption` where there is none.
    pub fn named(name: &str) -> Result<Self, OptionError> {
        let found = MAPS.iter().find(|(known, _)| *known == name);
        found.map(|&(_, map)| map).ok_or_else(|| {
            let names: Vec<&str> = MAPS.iter().map(|&(name, _)| name).collect();
            OptionError::invalid("colormap", &format!("one of \"{}\"", names.join("\", \"")))
        })
    }

    /// The map's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        MAPS.iter().find(|&&(_, map)| map == self).map_or("", |&(name, _)| name)
    }

    /// The color at `t`: 0 is the low end and 1 the high end, beyond which the colors stay.
    #[must_use]
    pub fn color(self, t: f64) -> Rgb {
        let t = if t > 0.0 { t.min(1.0) } else { 0.0 };
        let gradient = match self {
            Self::Viridis => colorous::VIRIDIS,
            Self::Cividis => colorous::CIVIDIS,
            Self::Magma => colorous::MAGMA,
            Self::Inferno => colorous::INFERNO,
            Self::Plasma => colorous::PLASMA,
            Self::CoolWarm => return between(&COOL_WARM, t),
            Self::BlueRed => return colorous::RED_YELLOW_BLUE.eval_continuous(1.0 - t).as_array(),
            Self::PurpleGreen => colorous::PURPLE_GREEN,
        };
        gradient.eval_continuous(t).as_array()
    }

    /// The map at equal steps.
    pub(super) fn table(self) -> Vec<Rgb> {
        (0..SAMPLES).map(|k| self.color(k as f64 / (SAMPLES - 1) as f64)).collect()
    }
}

/// The color at a place of a table, 0 to 1.
pub(super) fn between(table: &[Rgb], t: f64) -> Rgb {
    let place = t * (table.len() - 1) as f64;
    let from = (place as usize).min(table.len() - 2);
    let (low, high) = (table[from], table[from + 1]);
    let part = place - from as f64;
    let mixed = |low: u8, high: u8| (f64::from(low) + part * (f64::from(high) - f64::from(low)) + 0.5) as u8;
    [mixed(low[0], high[0]), mixed(low[1], high[1]), mixed(low[2], high[2])]
}
