//! A mesh that is drawn, once or more often.

use super::camera::{Rectangle, View};
use super::draw_list::DrawList;
use super::options::{DrawOptions, SheetOptions, SnapshotOptions};
use super::png::Picture;
use super::raster::paint;
use super::style;
use super::surface::Surface;
use crate::error::Error;
use crate::mesh::TriMesh;

/// A mesh that is drawn more than once.
///
/// # Example
/// ```
/// use morse_smooth::{mesh::shapes, render::{Scene, SnapshotOptions}};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
/// let scene = Scene::new(&torus);
/// let png = scene.snapshot(&height, &SnapshotOptions { width: 300, height: 200, ..Default::default() })?;
/// assert!(png.starts_with(b"\x89PNG"));
/// assert_eq!(scene.draw_list(&height, &Default::default())?.solids.len(), 3);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Scene {
    mesh: TriMesh,
    surface: Surface,
}

impl Scene {
    /// O(vertices + triangles).
    #[must_use]
    pub fn new(mesh: &TriMesh) -> Self {
        Self { mesh: mesh.clone(), surface: Surface::new(mesh) }
    }

    /// The surface of every draw list.
    #[must_use]
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// What [`Scene::snapshot`] draws on the surface.
    ///
    /// # Errors
    /// As [`snapshot`].
    pub fn draw_list(&self, values: &[f64], options: &DrawOptions<'_>) -> Result<DrawList, Error> {
        DrawList::new(&self.mesh, &self.surface, values, options)
    }

    /// See [`snapshot`].
    ///
    /// # Errors
    /// Likewise.
    pub fn snapshot(&self, values: &[f64], options: &SnapshotOptions<'_>) -> Result<Vec<u8>, Error> {
        options.check()?;
        let list = self.draw_list(values, &options.draw)?;
        let mut picture = Picture::new(options.width, options.height, style::BACKGROUND)?;
        let mut pixmap = picture.pixmap()?;
        let all = Rectangle { x: 0.0, y: 0.0, width: f64::from(options.width), height: f64::from(options.height) };
        let view = View::framing(&self.surface, &options.camera, &all)?;
        let unit = (all.width.min(all.height) / 900.0).max(0.5);
        paint(&mut pixmap, &all, &self.surface, &list, &view, unit)?;
        Ok(picture.to_png()?)
    }

    /// See [`sheet`].
    ///
    /// # Errors
    /// Likewise.
    pub fn sheet(&self, before: &[f64], _after: &[f64], options: &SheetOptions<'_>) -> Result<Vec<u8>, Error> {
        self.snapshot(before, &options.picture)
    }
}

/// Draws a field on a mesh, as a PNG file.
///
/// # Errors
/// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`; `NonFiniteLevel`; `IndexOutOfBounds` for a vertex that does not exist;
/// `InvalidOption`; `OutOfMemory`.
pub fn snapshot(mesh: &TriMesh, values: &[f64], options: &SnapshotOptions<'_>) -> Result<Vec<u8>, Error> {
    Scene::new(mesh).snapshot(values, options)
}

/// Draws two fields on a mesh and after − before, side by side, as one PNG file.
///
/// # Errors
/// As [`snapshot`], and `InapplicableOption` for lines or points of one field.
pub fn sheet(mesh: &TriMesh, before: &[f64], after: &[f64], options: &SheetOptions<'_>) -> Result<Vec<u8>, Error> {
    Scene::new(mesh).sheet(before, after, options)
}
