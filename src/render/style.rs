//! How things look: the one place for colors, widths and sizes, of the pictures and of the page.

use super::colormap::Rgb;

pub(super) const BACKGROUND: Rgb = [255, 255, 255];
/// The color of text, ticks and frames.
pub(super) const INK: Rgb = [38, 44, 56];
/// The color of level sets, and of what lies under other lines.
const DARK: Rgb = [13, 19, 32];

/// Where there is no value: a grey that no color map has at its ends, lighter than the middle of those that pass through grey and
/// darker than the middle of those that pass through white.
pub(super) const GAP: Rgb = [0xaa, 0xaa, 0xaa];

/// Shading shows the shape without hiding the colors: the light comes from beside the eye, and most of it from everywhere.
pub(super) const LIGHT: Light = Light { ambient: 0.73, diffuse: 0.48, direction: [-0.407_6, 0.611_4, 0.679_3] };

pub(super) const LEVELS: Stroke = Stroke { color: DARK, width: 1.5, opacity: 0.85, casing: None };
/// The strokes of the Morse complex, near to the colors of minima and maxima.
pub(super) const DESCENDING: Stroke =
    Stroke { color: [0x8f, 0xc1, 0xff], width: 2.0, opacity: 1.0, casing: Some(Casing { color: DARK, width: 4.0 }) };
pub(super) const ASCENDING: Stroke =
    Stroke { color: [0xff, 0x8a, 0x8f], width: 2.0, opacity: 1.0, casing: Some(Casing { color: DARK, width: 4.0 }) };

/// Minima are tetrahedra that point into the surface, saddles octahedra, maxima balls: triangles, squares and discs are told apart
/// without colors.
pub(super) const MINIMUM: Rgb = [0x2f, 0x6b, 0xff];
pub(super) const SADDLE: Rgb = [0xff, 0xff, 0xff];
pub(super) const MAXIMUM: Rgb = [0xe5, 0x26, 0x3c];
const RIM: Rgb = [0x10, 0x15, 0x1f];
/// Pointed solids need more of it, since their faces are nearer to their middle.
pub(super) const TETRAHEDRON_RIM: Rim = Rim { color: RIM, scale: 1.44 };
pub(super) const OCTAHEDRON_RIM: Rim = Rim { color: RIM, scale: 1.36 };
pub(super) const BALL_RIM: Rim = Rim { color: RIM, scale: 1.28 };
/// Sides that face away from the light keep their color.
pub(super) const GLOW: f64 = 0.35;
/// Radii above the surface at which solids stand, so that most of them is seen, and the rims all around them.
pub(super) const LIFT: f64 = 0.9;
/// Many solids cover about an eighth of a surface of area 1; a few are of a set size.
pub(super) const SIZE: SolidSize = SolidSize { cover: 0.04, least: 0.004, most: 0.02 };
/// From so many on, balls are seen with a few pixels each and need not be round.
pub(super) const CROWD: usize = 300;

/// How lines are drawn. Widths are pixels of the page, or of a picture 900 pixels high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// The color.
    pub color: Rgb,
    /// The width.
    pub width: f64,
    /// 0 to 1.
    pub opacity: f64,
    /// A line under it, so that it stands out from any color.
    pub casing: Option<Casing>,
}

/// The line under a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Casing {
    /// The color.
    pub color: Rgb,
    /// The width.
    pub width: f64,
}

/// The same solid, larger and seen from its inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rim {
    /// The color.
    pub color: Rgb,
    /// How much larger.
    pub scale: f64,
}

/// The radius of n solids is √(cover / n), within two bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidSize {
    /// The area that all solids cover together.
    pub cover: f64,
    /// The smallest radius.
    pub least: f64,
    /// The largest radius.
    pub most: f64,
}

impl SolidSize {
    /// The radius of so many.
    #[must_use]
    pub fn radius(&self, count: usize) -> f64 {
        (self.cover / count.max(1) as f64).sqrt().min(self.most).max(self.least)
    }
}

/// Light from everywhere, and from one direction as the camera sees it: right, up, towards the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// What of a color is seen without the other light.
    pub ambient: f64,
    /// What comes on top where the surface faces the light.
    pub diffuse: f64,
    /// A unit vector.
    pub direction: [f64; 3],
}
