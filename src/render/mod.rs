//! Pictures of fields on meshes, without a graphics card: a shaded surface with the colors of the values, level sets, critical
//! points, the Morse complex. The same bytes on every platform.
//!
//! Data flows one way: [`Surface`] (the mesh as it is drawn) → [`DrawList`] (what is drawn on it, for this renderer and any
//! other) → pixels → PNG.

mod camera;
mod colormap;
mod draw_list;
mod font;
mod legend;
mod options;
mod page;
mod png;
mod raster;
mod scene;
mod solids;
mod style;
mod surface;
mod text;
mod ticks;

pub use camera::Camera;
pub use colormap::{Colormap, Rgb};
pub use draw_list::{DrawList, Lines, Role, Solids};
pub use options::{DrawOptions, Glyphs, Levels, Separatrices, SheetOptions, SnapshotOptions};
pub use scene::{Scene, sheet, snapshot};
pub use solids::Shape;
pub use style::{Casing, Light, Rim, SolidSize, Stroke};
pub use surface::{Axis, Surface};
pub use ticks::{round_ticks, tick_label};
