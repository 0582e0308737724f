//! The smoothest field that has exactly the chosen extrema, beside the one that it comes from:
//! `cargo run --release --features render --example prescribe -- exact.png`.
#![allow(clippy::print_stdout, reason = "it is what the example is for")]

use morse_smooth::{Watch, field::*, load::*, render::*, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let output = std::env::args().skip(1).find(|argument| argument.ends_with(".png"));
    let bytes = std::fs::read("www/public/examples/egm96_geoid_2deg.ply")?;
    let file = load(&bytes, &LoadOptions::default())?;
    let (name, field) = file.fields.first().ok_or("no field")?;

    let functional = Functional::Tikhonov(TikhonovOptions { epsilon: 0.01, ..Default::default() });
    let extrema = Extrema::Most { minima: 4, maxima: 3, of: PersistenceOf::Smoothed };
    let options = PrescribeOptions { functional, extrema, ..Default::default() };
    let smoothed = Smoother::new(&file.mesh, SmootherOptions::default())?.prescribe(field, &options)?;
    let report = &smoothed.reports[0];
    let prescribed = report.prescribed.as_ref().ok_or("no report")?;
    println!("{name}: minima {:?}, maxima {:?}", prescribed.minima, prescribed.maxima);
    let rise = 100.0 * (prescribed.energy / prescribed.unconstrained_energy - 1.0);
    println!("energy: {rise:.2} % above the field without prescribed extrema");
    // On a sphere there are as many saddles as extrema, but for two.
    assert_eq!((report.after.minima, report.after.maxima, report.after.saddles), (4, 3, 5));
    let points =
        critical_points(&ScalarField::new(&file.mesh, &smoothed.values)?, &DeltaOptions::default(), &Watch::none())?;
    let is_chosen = |point: &&CriticalPoint| {
        [&prescribed.minima, &prescribed.maxima].iter().any(|list| list.contains(&point.vertex))
    };
    assert_eq!(points.points.iter().filter(is_chosen).count(), 7);

    let mut options = SheetOptions::default();
    (options.picture.width, options.picture.height) = (500, 440);
    options.picture.camera.direction = Some([0.6, 0.5, 0.6]);
    options.titles = ["before", "exact", "difference"];
    let png = sheet(&file.mesh, field, &smoothed.values, &options)?;
    assert!(png.starts_with(b"\x89PNG"));
    if let Some(path) = output {
        std::fs::write(path, png)?;
    }
    Ok(())
}
