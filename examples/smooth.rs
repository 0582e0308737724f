//! Of the noisy field's 571 minima and 574 maxima, smoothing with ε = 0.05 leaves 2 and 1.
use morse_smooth::{load::*, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = load(&std::fs::read("www/public/examples/torus_irregular.ply")?, &LoadOptions::default())?;
    let (_, field) = file.fields.iter().find(|(name, _)| name == "noisy").ok_or("no such field")?;
    let smoothed = Smoother::new(&file.mesh, Default::default())?.tikhonov(field, &Default::default())?;
    assert_eq!((smoothed.reports[0].after.minima, smoothed.reports[0].after.maxima), (2, 1));
    Ok(())
}
