//! The comparison of a picture with its golden file, and what is left for the eye where they differ.

use std::path::PathBuf;

use crate::pictures::image::{Image, Rgb, WHITE, distance};

/// Pixels of white between the parts of a strip.
pub(super) const GAP: usize = 8;
/// How a difference of one step is shown, and how much more each further one adds.
const LEAST: u32 = 64;
const MORE: u32 = 8;

/// Where golden pictures are, and where strips go.
pub(super) struct Folders {
    pub(super) golden: PathBuf,
    pub(super) artifacts: PathBuf,
}

/// Says what is wrong, if anything is. With `update` the golden picture is made anew, and that is wrong, too: a run that compares
/// nothing must not pass.
pub(super) fn check(name: &str, file: &[u8], folders: &Folders, update: bool) -> Result<(), String> {
    let path = folders.golden.join(format!("{name}.png"));
    let shown = path.display();
    let golden = std::fs::read(&path).ok();
    if update {
        if golden.as_deref() == Some(file) {
            return Err(format!("{shown} is as it was; nothing is compared with UPDATE_GOLDEN"));
        }
        std::fs::write(&path, file).map_err(|error| format!("{shown}: {error}"))?;
        return Err(format!("{shown} is new: look at it, and run again without UPDATE_GOLDEN"));
    }
    let strip = folders.artifacts.join(format!("{name}.png"));
    let Some(golden) = golden else {
        return Err(format!("{shown} is missing: UPDATE_GOLDEN=1 cargo test --features render golden makes it"));
    };
    if golden == file {
        // What an earlier run has left would mislead.
        let _ = std::fs::remove_file(&strip);
        return Ok(());
    }
    let actual = Image::try_decode(file).map_err(|error| format!("{name}: what was drawn is no picture: {error}"))?;
    let expected = Image::try_decode(&golden).map_err(|error| format!("{shown} is no picture: {error}"))?;
    let (count, most) = difference(&expected, &actual);
    if count == 0 {
        return Err(format!("{shown} has the same pixels, but other bytes: PNG files are written differently"));
    }
    std::fs::create_dir_all(&folders.artifacts).map_err(|error| format!("{}: {error}", folders.artifacts.display()))?;
    let side_by_side = side_by_side(&expected, &actual);
    std::fs::write(&strip, encode(&side_by_side)).map_err(|error| format!("{}: {error}", strip.display()))?;
    Err(format!(
        "{shown}: {count} pixels differ, by up to {most} of 255; see {} (expected | difference | actual)",
        strip.display()
    ))
}

/// The number of pixels that differ, those of one picture only included, and the largest difference.
fn difference(expected: &Image, actual: &Image) -> (usize, u8) {
    let (width, height) = (expected.width.max(actual.width), expected.height.max(actual.height));
    let differences = (0..width * height).map(|k| difference_at(expected, actual, k % width, k / width));
    differences.fold((0, 0), |(count, most), d| (count + usize::from(d > 0), most.max(d)))
}

fn difference_at(expected: &Image, actual: &Image, x: usize, y: usize) -> u8 {
    match (pixel(expected, x, y), pixel(actual, x, y)) {
        (Some(p), Some(q)) => distance(p, q),
        (None, None) => 0,
        _ => 255,
    }
}

fn pixel(image: &Image, x: usize, y: usize) -> Option<Rgb> {
    (x < image.width && y < image.height).then(|| image.at(x, y))
}

/// Expected | difference | actual; the difference in black where there is none.
fn side_by_side(expected: &Image, actual: &Image) -> Image {
    let (width, height) = (expected.width.max(actual.width), expected.height.max(actual.height));
    let mut strip = Image { width: 3 * width + 2 * GAP, height, pixels: Vec::new() };
    strip.pixels.resize(strip.width * height, WHITE);
    for y in 0..height {
        for x in 0..width {
            let d = u32::from(difference_at(expected, actual, x, y));
            let shown = if d > 0 { (LEAST + MORE * d).min(255) as u8 } else { 0 };
            let row = y * strip.width;
            strip.pixels[row + x] = pixel(expected, x, y).unwrap_or(WHITE);
            strip.pixels[row + width + GAP + x] = [shown; 3];
            strip.pixels[row + 2 * (width + GAP) + x] = pixel(actual, x, y).unwrap_or(WHITE);
        }
    }
    strip
}

pub(crate) fn encode(image: &Image) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, image.width as u32, image.height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(image.pixels.as_flattened()).expect("pixels");
    writer.finish().expect("an end");
    file
}
