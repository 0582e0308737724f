//! The smoothest field that has exactly the chosen extrema, beside the one that it comes from:
//! `cargo run --release --features render --example prescribe -- exact.png`.
#![allow(clippy::print_stdout, reason = "it is what the example is for")]

use morse_smooth::{Watch, field::*, load::*, render::*, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let output = std::env::args().skip(1).find(|argument| argument.ends_with(".png"));
    let bytes = std::fs::read("www/public/examples/jacksboro_dem.ply")?;
    let file = load(&bytes, &LoadOptions::default())?;
    let (name, field) = file.fields.first().ok_or("no field")?;

    let functional = Functional::Tikhonov(TikhonovOptions { epsilon: 0.02, ..Default::default() });
    let extrema = Extrema::Above { threshold: Threshold::Relative(0.05), of: PersistenceOf::Smoothed };
    let options = PrescribeOptions { functional, extrema, ..Default::default() };
    let smoothed = Smoother::new(&file.mesh, SmootherOptions::default())?.prescribe(field, &options)?;
    let prescribed = smoothed.reports[0].prescribed.as_ref().ok_or("no report")?;
    println!("{name}: minima {:?}, maxima {:?}", prescribed.minima, prescribed.maxima);
    let rise = 100.0 * (prescribed.energy / prescribed.unconstrained_energy - 1.0);
    println!("energy {rise:.2} % above that of the smoothed field");
    // There are no others.
    let after = ScalarField::new(&file.mesh, &smoothed.values)?;
    let points = critical_points(&after, &DeltaOptions::default(), &Watch::none())?.points;
    let of_kind =
        |kind| points.iter().filter(|point| point.kind == kind).map(|point| point.vertex).collect::<Vec<u32>>();
    assert_eq!(of_kind(CriticalKind::Minimum), prescribed.minima);
    assert_eq!(of_kind(CriticalKind::Maximum), prescribed.maxima);

    let mut options = SheetOptions::default();
    (options.picture.width, options.picture.height) = (500, 440);
    options.picture.camera.direction = Some([0.0, -0.5, 1.0]);
    options.titles = ["before", "exact", "difference"];
    let png = sheet(&file.mesh, field, &smoothed.values, &options)?;
    assert!(png.starts_with(b"\x89PNG"));
    if let Some(path) = output {
        std::fs::write(path, png)?;
    }
    Ok(())
}
