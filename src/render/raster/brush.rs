//! The color of a triangle in a point.

use super::facets::{Facets, Material};
use super::light::Lamp;
use super::plane::Plane;
use crate::render::colormap::Rgb;
use crate::render::draw_list::DrawList;
use crate::render::style;

/// Samples of one pixel in one triangle.
pub(super) struct Group {
    pub(super) triangle: u32,
    pub(super) count: u32,
    /// Sums of their places, in steps of the grid.
    pub(super) x: i64,
    pub(super) y: i64,
}

pub(super) struct Brush<'a> {
    pub(super) facets: &'a Facets,
    pub(super) list: &'a DrawList,
    pub(super) lamp: &'a Lamp,
}

impl Brush<'_> {
    /// In the middle of some samples.
    #[inline(never)]
    pub(super) fn color(&self, group: &Group) -> Rgb {
        let material = self.facets.material(group.triangle);
        if let Material::Rim(color) = material {
            return color;
        }
        let Some(plane) = Plane::of(self.facets, group.triangle) else { return style::BACKGROUND };
        let [i, j, k] = self.facets.triangles[group.triangle as usize];
        let (i, j, k) = (i as usize, j as usize, k as usize);
        let corners = &self.facets.corners;
        let count = f64::from(group.count);
        let parts = plane.parts(group.x as f64 / count, group.y as f64 / count);
        // Straight lines of the picture are not evenly long in space.
        let (a, b, c) = (parts[0] * corners[i].depth, parts[1] * corners[j].depth, parts[2] * corners[k].depth);
        let scale = 1.0 / (a + b + c);
        let (a, b, c) = (a * scale, b * scale, c * scale);
        let (n, m, o) = (self.facets.normals[i], self.facets.normals[j], self.facets.normals[k]);
        let sign = if plane.is_front { 1.0 } else { -1.0 };
        let normal = [
            sign * (a * n[0] + b * m[0] + c * o[0]),
            sign * (a * n[1] + b * m[1] + c * o[1]),
            sign * (a * n[2] + b * m[2] + c * o[2]),
        ];
        match material {
            Material::Solid(color, glow) => self.lamp.lit(color, glow, normal),
            _ => {
                let shades = &self.list.shades;
                self.lamp.lit(self.list.color(a * shades[i] + b * shades[j] + c * shades[k]), 0.0, normal)
            }
        }
    }
}
