use morse_smooth::{load::*, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = load(&std::fs::read("www/public/examples/torus_irregular.ply")?, &LoadOptions::default())?;
    let (_, field) = file.fields.iter().find(|(name, _)| name == "noisy").ok_or("no such field")?;
    let mut smoother = Smoother::new(&file.mesh, SmootherOptions::default())?;
    let smoothed = smoother.tikhonov(field, &TikhonovOptions { epsilon: 0.05, ..Default::default() })?;
    assert_eq!((smoothed.reports[0].after.minima, smoothed.reports[0].after.maxima), (2, 1)); // of 571 and 574
    Ok(())
}
