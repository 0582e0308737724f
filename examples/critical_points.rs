//! Reads a mesh with its fields and prints the critical points of one: `cargo run --example critical_points -- file field`.
#![allow(clippy::print_stdout, reason = "it is what the example is for")]

use morse_smooth::{Watch, field::*, load::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let path = arguments.next().unwrap_or_else(|| "www/public/examples/torus_irregular.ply".to_owned());
    let name = arguments.next().unwrap_or_else(|| "clean".to_owned());
    let file = load(&std::fs::read(path)?, &LoadOptions::default())?;
    let (_, values) = file.fields.iter().find(|(known, _)| *known == name).ok_or("no such field")?;

    let field = ScalarField::new(&file.mesh, values)?;
    let found = critical_points(&field, &DeltaOptions::default(), &Watch::none())?;
    for point in &found.points {
        println!("{:?} at vertex {}, value {}", point.kind, point.vertex, values[point.vertex as usize]);
    }
    // Each saddle as often as its multiplicity says.
    let CriticalCounts { minima, saddles, maxima, .. } = found.counts;
    let sum = i64::from(minima) - i64::from(saddles) + i64::from(maxima);
    assert_eq!(sum, file.mesh.topology()?.euler_characteristic);
    Ok(())
}
