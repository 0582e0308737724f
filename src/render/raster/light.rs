//! Colors under light. Light adds up in linear colors, and pixels hold sRGB.

use crate::mesh::{dot, norm};
use crate::render::colormap::Rgb;
use crate::render::style::Light;

/// Steps of linear light: the darkest are less than half a step of sRGB apart.
const STEPS: usize = 8192;

pub(super) struct Lamp {
    light: Light,
    linear: Vec<f64>,
    encoded: Vec<u8>,
}

impl Lamp {
    pub(super) fn new(light: Light) -> Self {
        let linear = (0..256).map(|byte| to_linear(f64::from(byte) / 255.0)).collect();
        let encode = |step: usize| (255.0 * to_srgb(step as f64 / STEPS as f64)).round() as u8;
        Self { light, linear, encoded: (0..=STEPS).map(encode).collect() }
    }

    /// `normal` as the camera sees it, of any length.
    pub(super) fn lit(&self, color: Rgb, glow: f64, normal: [f64; 3]) -> Rgb {
        let length = norm(normal);
        let facing = if length > 0.0 { (dot(normal, self.light.direction) / length).max(0.0) } else { 0.0 };
        let light = glow + self.light.ambient + self.light.diffuse * facing;
        let lit = |byte: u8| {
            let linear = light * self.linear[usize::from(byte)];
            self.encoded[if linear < 1.0 { (linear * STEPS as f64 + 0.5) as usize } else { STEPS }]
        };
        [lit(color[0]), lit(color[1]), lit(color[2])]
    }
}

/// IEC 61966-2-1.
fn to_linear(x: f64) -> f64 {
    if x <= 0.040_45 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}

fn to_srgb(x: f64) -> f64 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 }
}
