//! A mesh that is drawn, once or more often.

use super::draw_list::DrawList;
use super::options::{DrawOptions, SheetOptions, SnapshotOptions};
use super::page::{Page, Text};
use super::surface::Surface;
use crate::error::{Error, FieldError};
use crate::field::{Missing, ScalarField};
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

    /// Draws a field as [`snapshot`] does.
    ///
    /// # Errors
    /// As [`snapshot`].
    pub fn snapshot(&self, values: &[f64], options: &SnapshotOptions<'_>) -> Result<Vec<u8>, Error> {
        options.check()?;
        let list = self.draw_list(values, &options.draw)?;
        let (width, height) = (f64::from(options.width), f64::from(options.height));
        let text = Text::for_picture(width, height);
        let above = text.line(options.title, height);
        let bar = if options.color_bar { text.bar(&list, width, height - above) } else { 0.0 };
        let mut page = Page::new(width, height, text)?;
        page.title(options.title, [0.0, 0.0, width, above]);
        let picture = [0.0, above, width - bar, height - above];
        page.picture(&self.surface, &list, &options.camera, picture)?;
        page.legend(&list, [width - bar, above, bar, height - above]);
        Ok(page.to_png()?)
    }

    /// Draws two fields and their difference as [`sheet`] does.
    ///
    /// # Errors
    /// As [`sheet`].
    pub fn sheet(&self, before: &[f64], after: &[f64], options: &SheetOptions<'_>) -> Result<Vec<u8>, Error> {
        options.check()?;
        let picture = &options.picture;
        let draw = DrawOptions { range: Some(self.common_range(before, after, &picture.draw)?), ..picture.draw };
        // A constant has no range to divide.
        let draw = DrawOptions { range: draw.range.filter(|[low, high]| low < high), ..draw };
        let (difference, largest) = self.difference(before, after, draw.missing)?;
        let largest = options.largest_difference.unwrap_or(largest);
        let change = options.difference(if largest > 0.0 { Some([-largest, largest]) } else { None });
        let mut lists =
            [self.draw_list(before, &draw)?, self.draw_list(after, &draw)?, self.draw_list(&difference, &change)?];
        // The first two share a bar.
        lists[1].gap = lists[1].gap.or(lists[0].gap);

        let (width, height) = (f64::from(picture.width), f64::from(picture.height));
        let text = Text::for_picture(width, height);
        let above = text.line(picture.title, height);
        let title = options.titles.iter().map(|title| text.line(title, height)).fold(0.0, f64::max);
        let bar = |list| if picture.color_bar { text.bar(list, f64::INFINITY, height) } else { 0.0 };
        let bars = [0.0, bar(&lists[1]), bar(&lists[2])];
        let total = [3.0 * width + bars[1] + bars[2], above + title + height];
        options.check_total(total)?;
        let mut page = Page::new(total[0], total[1], text)?;
        page.title(picture.title, [0.0, 0.0, total[0], above]);
        let mut left = 0.0;
        for ((list, title_of), bar) in lists.iter().zip(options.titles).zip(bars) {
            page.title(title_of, [left, above, width, title]);
            page.picture(&self.surface, list, &picture.camera, [left, above + title, width, height])?;
            page.legend(list, [left + width, above + title, bar, height]);
            left += width + bar;
        }
        Ok(page.to_png()?)
    }

    /// The given range, or that of both fields.
    fn common_range(&self, before: &[f64], after: &[f64], options: &DrawOptions<'_>) -> Result<[f64; 2], Error> {
        let range_of = |values| Ok::<_, Error>(ScalarField::with_missing(&self.mesh, values, options.missing)?.range());
        let (f, g) = (range_of(before)?, range_of(after)?);
        let range = options.range.unwrap_or([f.min.min(g.min), f.max.max(g.max)]);
        if (range[1] - range[0]).is_finite() { Ok(range) } else { Err(FieldError::RangeOverflow {}.into()) }
    }

    /// after − before, and the largest difference on the surface. What misses a value in either has none in the difference.
    fn difference(&self, before: &[f64], after: &[f64], missing: Missing) -> Result<(Vec<f64>, f64), FieldError> {
        let difference: Vec<f64> = before.iter().zip(after).map(|(f, g)| g - f).collect();
        let largest = self.surface.vertices.iter().map(|&v| difference[v as usize].abs()).fold(0.0, f64::max);
        let is_known = |x: &f64| x.is_finite() || (missing == Missing::Omit && x.is_nan());
        if (2.0 * largest).is_finite() && difference.iter().all(is_known) {
            Ok((difference, largest))
        } else {
            Err(FieldError::RangeOverflow {})
        }
    }
}

/// Draws a field on a mesh, as a PNG file: a shaded surface with the colors of the values, level sets, critical points, on demand
/// bands and the Morse complex, and a bar that says which color is which value.
///
/// # Properties
/// The same bytes on every platform. Red, green and blue, eight bits each, on white. Level sets are drawn within a pixel of where
/// they are. O(vertices + triangles + pixels), and what the lines are long.
///
/// # Errors
/// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`; `NonFiniteLevel`; `IndexOutOfBounds` for a vertex that does not exist;
/// `InvalidOption`; `OutOfMemory`.
///
/// # Example
/// See [`Scene`].
pub fn snapshot(mesh: &TriMesh, values: &[f64], options: &SnapshotOptions<'_>) -> Result<Vec<u8>, Error> {
    Scene::new(mesh).snapshot(values, options)
}

/// Draws two fields on a mesh and after − before, side by side, as one PNG file: the two with the same colors and levels, the
/// difference with colors around zero and nothing else.
///
/// # Errors
/// As [`snapshot`], and `InapplicableOption` for lines or points of one field.
pub fn sheet(mesh: &TriMesh, before: &[f64], after: &[f64], options: &SheetOptions<'_>) -> Result<Vec<u8>, Error> {
    Scene::new(mesh).sheet(before, after, options)
}
