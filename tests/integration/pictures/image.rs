//! Pictures as pixels, and the few things that tests ask of them.

use morse_smooth::error::Error;
use morse_smooth::mesh::TriMesh;
use morse_smooth::render::{Camera, DrawOptions, Glyphs, Levels, Light, SnapshotOptions, snapshot};

pub(crate) type Rgb = [u8; 3];

pub(crate) const WHITE: Rgb = [255; 3];

/// A decoded picture.
#[derive(Clone, PartialEq)]
pub(crate) struct Image {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<Rgb>,
}

impl Image {
    pub(crate) fn decode(file: &[u8]) -> Self {
        Self::try_decode(file).expect("a PNG file with eight bits of red, green and blue")
    }

    pub(crate) fn try_decode(file: &[u8]) -> Result<Self, String> {
        let mut reader =
            png::Decoder::new(std::io::Cursor::new(file)).read_info().map_err(|error| error.to_string())?;
        let mut bytes = vec![0; reader.output_buffer_size().ok_or("too large")?];
        let info = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
        if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
            return Err(format!("{:?} of {:?}", info.color_type, info.bit_depth));
        }
        let (width, height) = (info.width as usize, info.height as usize);
        Ok(Self { width, height, pixels: bytes.as_chunks::<3>().0.to_vec() })
    }

    pub(crate) fn at(&self, x: usize, y: usize) -> Rgb {
        self.pixels[y * self.width + x]
    }

    /// The pixels that a condition holds for.
    pub(crate) fn places(&self, is_meant: impl Fn(Rgb) -> bool) -> Vec<[usize; 2]> {
        let all = (0..self.pixels.len()).filter(|&k| is_meant(self.pixels[k]));
        all.map(|k| [k % self.width, k / self.width]).collect()
    }

    /// What is not background: the first and last column, the first and last row.
    pub(crate) fn extent(&self) -> Option<[usize; 4]> {
        let places = self.places(|pixel| pixel != WHITE);
        let columns = || places.iter().map(|place| place[0]);
        let rows = || places.iter().map(|place| place[1]);
        Some([columns().min()?, columns().max()?, rows().min()?, rows().max()?])
    }

    /// The number of pixels that differ, and by how much a channel differs at most.
    pub(crate) fn difference(&self, other: &Self) -> (usize, u8) {
        self.difference_above(other, 0)
    }

    /// Likewise, where smaller differences do not count.
    pub(crate) fn difference_above(&self, other: &Self, bound: u8) -> (usize, u8) {
        assert_eq!((self.width, self.height), (other.width, other.height));
        let differences = self.pixels.iter().zip(&other.pixels).map(|(p, q)| distance(*p, *q));
        differences.fold((0, 0), |(count, most), d| (count + usize::from(d > bound), most.max(d)))
    }
}

pub(crate) fn distance(p: Rgb, q: Rgb) -> u8 {
    (0..3).map(|c| p[c].abs_diff(q[c])).max().unwrap_or_default()
}

/// The surface and nothing else.
pub(crate) fn bare<'a>(width: u32, height: u32) -> SnapshotOptions<'a> {
    let draw = DrawOptions { levels: Levels::None, critical_points: Glyphs::None, ..DrawOptions::default() };
    SnapshotOptions { draw, width, height, color_bar: false, ..SnapshotOptions::default() }
}

pub(crate) fn from<'a>(direction: [f64; 3], options: SnapshotOptions<'a>) -> SnapshotOptions<'a> {
    SnapshotOptions { camera: Camera { direction: Some(direction), ..options.camera }, ..options }
}

pub(crate) fn draw(mesh: &TriMesh, values: &[f64], options: &SnapshotOptions<'_>) -> Image {
    Image::decode(&snapshot(mesh, values, options).expect("a picture"))
}

pub(crate) fn code(result: Result<Vec<u8>, Error>) -> &'static str {
    result.err().map_or("a picture", |error| error.code())
}

/// A color in the light of a lamp, where the surface faces along the unit vector `normal`: right, up, towards the camera.
pub(crate) fn lit(color: Rgb, light: &Light, normal: [f64; 3]) -> [f64; 3] {
    let facing: f64 = (0..3).map(|i| normal[i] * light.direction[i]).sum();
    let amount = light.ambient + light.diffuse * facing.max(0.0);
    // IEC 61966-2-1.
    color.map(|byte| {
        let x = f64::from(byte) / 255.0;
        let linear = if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
        let y = (amount * linear).min(1.0);
        255.0 * if y <= 0.0031308 { 12.92 * y } else { 1.055 * y.powf(1.0 / 2.4) - 0.055 }
    })
}

/// How far a pixel is from a color.
pub(crate) fn error(pixel: Rgb, expected: [f64; 3]) -> f64 {
    (0..3).map(|c| (f64::from(pixel[c]) - expected[c]).abs()).fold(0.0, f64::max)
}

/// Points and triangles.
pub(crate) type Part = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Two triangles: corners a, b, c, d in a row around.
pub(crate) fn quad(corners: [[f64; 3]; 4]) -> Part {
    (corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

/// The square around (x, y, z) with sides of length 2r, facing along z.
pub(crate) fn tile(x: f64, y: f64, z: f64, r: f64) -> Part {
    quad([[x - r, y - r, z], [x + r, y - r, z], [x + r, y + r, z], [x - r, y + r, z]])
}

/// One mesh of several parts.
pub(crate) fn united(parts: &[Part]) -> TriMesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for (points, corners) in parts {
        let first = positions.len() as u32;
        positions.extend_from_slice(points);
        triangles.extend(corners.iter().map(|t| t.map(|v| v + first)));
    }
    crate::support::mesh(&positions, &triangles)
}

/// One coordinate as the field.
pub(crate) fn coordinate(mesh: &TriMesh, axis: usize) -> Vec<f64> {
    mesh.positions().chunks_exact(3).map(|p| p[axis]).collect()
}
