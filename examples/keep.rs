//! Smooths a field, keeps its important critical points and writes both fields with their mesh:
//! `cargo run --release --example keep -- kept.ply`.
#![allow(clippy::print_stdout, reason = "it is what the example is for")]

use morse_smooth::{field::*, io::*, load::*, operators::LaplacianWeights, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let output = std::env::args().skip(1).find(|argument| argument.ends_with(".ply"));
    let bytes = std::fs::read("www/public/examples/lysozyme_potential.ply")?;
    let file = load(&bytes, &LoadOptions::default())?;
    let (name, field) = file.fields.first().ok_or("no field")?;

    let weights = LaplacianWeights::IntrinsicDelaunay;
    let mut smoother = Smoother::new(&file.mesh, SmootherOptions { weights, ..Default::default() })?;
    let features = Features::Persistence(Threshold::Relative(0.1));
    let constraints = Constraints { features, stars: true, unconstrained: Unconstrained::Error };
    let options = InterpolateOptions { constraints, energy: Energy::Harmonic, channels: 1 };
    let smoothed = smoother.interpolate(field, &options)?;
    let report = &smoothed.reports[0];
    println!(
        "{name}: minima {} → {}, maxima {} → {}",
        report.before.minima, report.after.minima, report.before.maxima, report.after.maxima
    );
    assert_eq!(report.preserved, report.constrained_critical_points);

    let fields: [(&str, &[f64]); 2] = [(name, field), ("smooth", &smoothed.values)];
    let triangles = file.mesh.connectivity().triangles().as_flattened();
    let written =
        write_mesh(file.mesh.positions(), triangles, &fields, &WriteOptions { binary: true, ..Default::default() })?;
    assert_eq!(read_mesh(&written, &ReadOptions::default())?.fields[1].1, smoothed.values);
    if let Some(path) = output {
        std::fs::write(path, written)?;
    }
    Ok(())
}
