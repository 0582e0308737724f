//! What a threshold leaves of the Morse complex is what simplification leaves of the field.
use morse_smooth::{Watch, field::*, load::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bytes = std::fs::read("www/public/examples/torus_irregular.ply")?;
    let file = load(&bytes, &LoadOptions::default())?;
    let (_, values) = file.fields.iter().find(|(name, _)| name == "noisy").ok_or("no such field")?;
    let (field, watch) = (ScalarField::new(&file.mesh, values)?, Watch::none());
    let hierarchy = morse_hierarchy(&field, &watch)?;
    for relative in [0.05, 0.1, 0.5] {
        let threshold = relative * field.range().length();
        let alive = (0..hierarchy.nodes.len() as u32).filter(|&node| hierarchy.is_alive(node, threshold)).count();
        let keep = Keep::Above(Threshold::Relative(relative));
        let simple = simplify(&field, keep, &watch)?.values;
        let simple = ScalarField::new(&file.mesh, &simple)?;
        let counts = critical_points(&simple, &DeltaOptions::default(), &watch)?.counts;
        assert_eq!(alive as u32, counts.minima + counts.maxima + counts.saddles);
        let lines = morse_complex(&field, Threshold::Relative(relative), PathStyle::Whole, &watch)?;
        let is_left = |v: u32| hierarchy.nodes.iter().any(|node| node.vertex == v && node.cancelled_at > threshold);
        assert!(lines.saddles.iter().chain(&lines.extrema).all(|&v| is_left(v)));
    }
    // Far above the noise: the textbook's torus, a minimum, a maximum and two saddles with four lines each.
    let lines = morse_complex(&field, Threshold::Relative(0.5), PathStyle::Whole, &watch)?;
    assert_eq!(lines.saddles.len(), 8);
    Ok(())
}
