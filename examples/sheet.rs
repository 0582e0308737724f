//! Draws a field before and after smoothing, and the difference, side by side:
//! `cargo run --release --features render --example sheet -- sheet.png`.
use morse_smooth::{load::*, render::*, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let output = std::env::args().skip(1).find(|argument| argument.ends_with(".png"));
    let bytes = std::fs::read("www/public/examples/genus22.ply")?;
    let file = load(&bytes, &LoadOptions::default())?;
    let (_, before) = file.fields.iter().find(|(name, _)| name == "noisy").ok_or("no such field")?;
    let mut smoother = Smoother::new(&file.mesh, SmootherOptions::default())?;
    let after = smoother.tikhonov(before, &TikhonovOptions { epsilon: 0.1, ..Default::default() })?.values;

    let mut options = SheetOptions::default();
    (options.picture.width, options.picture.height) = (500, 440);
    options.picture.camera.direction = Some([0.15, 0.8, 0.8]);
    let png = sheet(&file.mesh, before, &after, &options)?;
    assert!(png.starts_with(b"\x89PNG"));
    if let Some(path) = output {
        std::fs::write(path, png)?;
    }
    Ok(())
}
