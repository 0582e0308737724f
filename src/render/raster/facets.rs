//! All triangles of a picture, projected: those of the surface, then those of the solids.

use super::binned::Binned;
use super::frame::{Frame, SAMPLES};
use crate::error::{FieldError, OutOfMemory};
use crate::mesh::dot;
use crate::render::camera::View;
use crate::render::colormap::Rgb;
use crate::render::draw_list::{DrawList, Solids};
use crate::render::surface::Surface;
use crate::support::memory::with_room;

/// Corners lie on a grid, so many to a sample: in whole numbers it is exact on which side of an edge a sample is, and neighbours
/// leave no gap.
pub(super) const GRID: i64 = 256;

/// Where a corner is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// From the frame's upper left corner, in steps of the grid.
    pub(super) x: i64,
    pub(super) y: i64,
    pub(super) depth: f64,
}

/// What triangles are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Material {
    /// The surface: colors of the values.
    Values,
    /// A solid: one color, with what shines of it without light.
    Solid(Rgb, f64),
    /// A rim: one color, without light.
    Rim(Rgb),
}

pub(super) struct Facets {
    pub(super) corners: Vec<Corner>,
    /// As the camera sees them.
    pub(super) normals: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// From which triangle on which material.
    materials: Vec<(usize, Material)>,
}

impl Facets {
    pub(super) fn new(surface: &Surface, list: &DrawList, view: &View, frame: &Frame) -> Result<Self, FieldError> {
        let solids = || list.solids.iter().map(|solids| (solids.vertices.len(), &solids.shape));
        // Each solid twice, with its rim.
        let corners: usize = solids().map(|(count, shape)| 2 * count * shape.positions.len()).sum();
        let triangles: usize = solids().map(|(count, shape)| 2 * count * shape.triangles.len()).sum();
        let (points, normals) = (surface.positions.as_chunks::<3>().0, surface.normals.as_chunks::<3>().0);
        let mut this = Self {
            corners: with_room(points.len() + corners)?,
            normals: with_room(points.len() + corners)?,
            triangles: with_room(surface.triangles.len() + triangles)?,
            materials: vec![(0, Material::Values)],
        };
        for (&point, &normal) in points.iter().zip(normals) {
            this.corner(view, frame, point, normal);
        }
        this.triangles.extend(&surface.triangles);
        for solids in &list.solids {
            this.instances(view, frame, solids, solids.rim.scale, Material::Rim(solids.rim.color));
            this.instances(view, frame, solids, 1.0, Material::Solid(solids.color, solids.glow));
        }
        Ok(this)
    }

    fn corner(&mut self, view: &View, frame: &Frame, point: [f64; 3], normal: [f64; 3]) {
        let at = view.project(point);
        let steps = (GRID * SAMPLES as i64) as f64;
        // Nothing leaves the frame by more than a solid's width; far more than that would overflow.
        let snap = |x: f64, first: usize| ((x - first as f64) * steps).clamp(-1e9, 1e9).round() as i64;
        self.corners.push(Corner { x: snap(at.x, frame.left), y: snap(at.y, frame.top), depth: at.depth });
        self.normals.push(view.turn(normal));
    }

    fn instances(&mut self, view: &View, frame: &Frame, solids: &Solids, scale: f64, material: Material) {
        self.materials.push((self.triangles.len(), material));
        let shape = &solids.shape;
        for (k, (&place, &axis)) in solids.places.iter().zip(&solids.axes).enumerate() {
            let is_away = solids.both_sides[k] && view.is_away(place, axis);
            let axis = if is_away { [-axis[0], -axis[1], -axis[2]] } else { axis };
            let first = self.corners.len() as u32;
            let turn = |point: [f64; 3]| turned(point, axis);
            for (&point, &normal) in shape.positions.iter().zip(&shape.normals) {
                let point = turn(point);
                let at = |i: usize| place[i] + solids.radius * (solids.lift * axis[i] + scale * point[i]);
                let at = [at(0), at(1), at(2)];
                self.corner(view, frame, at, turn(normal));
            }
            self.triangles.extend(shape.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
        }
    }

    pub(super) fn material(&self, triangle: u32) -> Material {
        let place = self.materials.partition_point(|&(first, _)| first <= triangle as usize);
        self.materials[place - 1].1
    }

    /// The triangles of each strip of so many rows.
    pub(super) fn by_strip(&self, frame: &Frame, rows: usize) -> Result<Binned, OutOfMemory> {
        let height = (rows * SAMPLES) as i64 * GRID;
        let count = frame.height.div_ceil(rows);
        Binned::new(self.triangles.len(), count, |t| {
            let ys = self.triangles[t].map(|corner| self.corners[corner as usize].y);
            let (low, high) = (ys[0].min(ys[1]).min(ys[2]), ys[0].max(ys[1]).max(ys[2]));
            if high < 0 || low >= count as i64 * height {
                return None;
            }
            Some([(low.max(0) / height) as usize, ((high / height) as usize).min(count - 1)])
        })
    }
}

/// A vector turned the shortest way that takes y to `axis`.
fn turned([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> [f64; 3] {
    // Straight down, every way is the shortest.
    if b < -0.999_999 {
        return [x, -y, -z];
    }
    // Half round about y, then half round about the middle between y and the axis.
    let along = dot([-x, y, -z], [a, 1.0 + b, c]) / (1.0 + b);
    [along * a + x, along * (1.0 + b) - y, along * c + z]
}
