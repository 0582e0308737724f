//! From where one looks, and where that puts points into the picture.

use super::surface::{Axis, Surface};
use crate::error::OptionError;
use crate::mesh::{cross, dot, norm};

/// Tangent of half the angle that the camera sees of the shorter side of a square picture: 15°.
const TANGENT: f64 = 0.267_949_192_431_122_7;
/// Room around every point of the mesh for solids on its rim, and around all of it for the eye.
const PAD: f64 = 0.05;
const MARGIN: f64 = 1.03;
/// Towards the camera, where things stand on y: x right, y up, z to the front.
const STANDING: [f64; 3] = [0.55, 0.5, 0.9];
/// The same of what lies flat, with z up.
const LYING: [f64; 3] = [0.25, -0.75, 0.95];
/// Sine of the angle between two directions from which on they are not one.
const APART: f64 = 1e-6;

/// From where to look. The whole mesh is in the picture, whatever the direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Camera {
    /// From the middle of the mesh towards the camera, of any length. Default: from the front and above; straight on what is
    /// plane.
    pub direction: Option<[f64; 3]>,
    /// What points upwards in the picture; not along the direction. Default: y, or z for what lies flat; where that is along the
    /// direction, another axis.
    pub up: Option<[f64; 3]>,
}

/// A camera in front of a surface: where points are in the picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct View {
    /// Right, up and towards the camera, in the surface's coordinates.
    axes: [[f64; 3]; 3],
    /// Where the camera is, along the axes.
    eye: [f64; 3],
    /// Pixels of a length of 1 at distance 1, and the picture's middle.
    focus: f64,
    middle: [f64; 2],
}

/// Where a point is in the picture, in pixels from its upper left corner; `depth` is one over the distance from the camera's plane,
/// which is linear along straight lines of the picture and larger for what is nearer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Projected {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) depth: f64,
}

impl View {
    /// As near as the whole surface fits into the picture's rectangle.
    pub(super) fn framing(surface: &Surface, camera: &Camera, rectangle: &Rectangle) -> Result<Self, OptionError> {
        let axes = axes(surface, camera)?;
        let (width, height) = (rectangle.width, rectangle.height);
        let focus = 0.5 * width.min(height) / TANGENT;
        let tangents = [0.5 * width / focus, 0.5 * height / focus];
        // A ball of radius r around (x, y, z) is inside the right edge of a camera at (a, b, d) if
        // x + z·tan + r·√(1 + tan²) ≤ a + d·tan; and so for the others.
        let mut reach = [[f64::NEG_INFINITY; 2]; 2];
        for point in surface.positions.as_chunks::<3>().0 {
            let z = dot(*point, axes[2]);
            for i in 0..2 {
                let along = dot(*point, axes[i]);
                reach[i][0] = reach[i][0].max(z * tangents[i] + along);
                reach[i][1] = reach[i][1].max(z * tangents[i] - along);
            }
        }
        for i in 0..2 {
            let pad = PAD * (1.0 + tangents[i] * tangents[i]).sqrt();
            reach[i] = [reach[i][0] + pad, reach[i][1] + pad];
        }
        let distances = [0, 1].map(|i| (reach[i][0] + reach[i][1]) / (2.0 * tangents[i]));
        let distance = MARGIN * distances[0].max(distances[1]).max(0.1);
        let shifts = [0, 1].map(|i| 0.5 * (reach[i][0] - reach[i][1]));
        let middle = [rectangle.x + 0.5 * width, rectangle.y + 0.5 * height];
        Ok(Self { axes, eye: [shifts[0], shifts[1], distance], focus, middle })
    }

    pub(super) fn project(&self, point: [f64; 3]) -> Projected {
        let depth = 1.0 / (self.eye[2] - dot(point, self.axes[2]));
        let scale = self.focus * depth;
        let x = self.middle[0] + scale * (dot(point, self.axes[0]) - self.eye[0]);
        let y = self.middle[1] - scale * (dot(point, self.axes[1]) - self.eye[1]);
        Projected { x, y, depth }
    }

    /// Whether a vector at a point leads away from the camera.
    pub(super) fn is_away(&self, place: [f64; 3], vector: [f64; 3]) -> bool {
        let ([x, y, z], at, along) = (self.eye, self.turn(place), self.turn(vector));
        dot([x - at[0], y - at[1], z - at[2]], along) < 0.0
    }

    /// A vector as the camera sees it: right, up, towards the camera.
    pub(super) fn turn(&self, vector: [f64; 3]) -> [f64; 3] {
        [dot(vector, self.axes[0]), dot(vector, self.axes[1]), dot(vector, self.axes[2])]
    }
}

/// A part of a picture, in pixels from its upper left corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

fn axes(surface: &Surface, camera: &Camera) -> Result<[[f64; 3]; 3], OptionError> {
    let expected = "three finite numbers that are not all zero";
    let towards = match camera.direction {
        Some(direction) => unit(direction).ok_or_else(|| OptionError::invalid("camera.direction", expected))?,
        None => default_direction(surface),
    };
    let usual = match surface.up {
        Axis::Y => [0.0, 1.0, 0.0],
        Axis::Z => [0.0, 0.0, 1.0],
    };
    let wanted = match camera.up {
        Some(up) => Some(unit(up).ok_or_else(|| OptionError::invalid("camera.up", expected))?),
        None => None,
    };
    let sideways = |up: [f64; 3]| {
        let right = cross(up, towards);
        (norm(right) > APART).then(|| unit(right)).flatten()
    };
    let right = match wanted {
        Some(up) => sideways(up)
            .ok_or_else(|| OptionError::invalid("camera.up", "a direction that is not along `camera.direction`"))?,
        // Seen from above or below, what was at the back is up.
        None => sideways(usual)
            .or_else(|| sideways(if surface.up == Axis::Z { [0.0, 1.0, 0.0] } else { [0.0, 0.0, -1.0] }))
            .unwrap_or([1.0, 0.0, 0.0]),
    };
    Ok([right, cross(towards, right), towards])
}

fn default_direction(surface: &Surface) -> [f64; 3] {
    let direction = match (surface.plane, surface.up) {
        (Some(axis), _) => {
            let mut direction = [0.0; 3];
            direction[axis] = 1.0;
            direction
        }
        (None, Axis::Y) => STANDING,
        (None, Axis::Z) => LYING,
    };
    unit(direction).unwrap_or([0.0, 0.0, 1.0])
}

/// Nothing where the vector has no direction. Scaled first, so that neither large nor small lengths are lost.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let largest = vector.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    if !(largest > 0.0 && vector.iter().all(|x| x.is_finite())) {
        return None;
    }
    let scaled = vector.map(|x| x / largest);
    let length = norm(scaled);
    Some(scaled.map(|x| x / length))
}
